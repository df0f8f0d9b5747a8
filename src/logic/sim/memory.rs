use super::{Sim, UInt, Wire};
use crate::kernel::{Field, Make, STAGE, Signals, Visit, WORD, Words};
use crate::logic::{Image, Ram, ShiftRegister};
use std::sync::Arc;

/// The words of a RAM.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SimRam<const A: usize, const D: usize> {
    words: Arc<[u64]>,
}

/// The stages of a shift register, the newest first.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SimShiftRegister<const K: usize, const D: usize> {
    stages: Arc<[u64]>,
}

impl<const A: usize, const D: usize> From<Image<A, D>> for SimRam<A, D> {
    fn from(image: Image<A, D>) -> Self {
        let words = 0..Image::<A, D>::WORDS;
        SimRam {
            words: words.map(|address| image.get(address)).collect(),
        }
    }
}

impl<const A: usize, const D: usize> SimRam<A, D> {
    /// It with these words, of which there are as many as it has.
    pub(crate) fn of_words(words: Arc<[u64]>) -> Self {
        SimRam { words }
    }
}

impl<const A: usize, const D: usize> Ram<Sim, A, D> for SimRam<A, D> {
    fn read(&self, address: UInt<A>) -> UInt<D> {
        let word = usize::try_from(address.get()).ok();
        let word = word.and_then(|address| self.words.get(address));
        word.copied().unwrap_or(0).into()
    }

    fn read_when(&self, enable: Wire, address: UInt<A>, held: UInt<D>) -> UInt<D> {
        if enable.get() {
            self.read(address)
        } else {
            held
        }
    }

    fn write(mut self, enable: Wire, address: UInt<A>, data: UInt<D>) -> Self {
        let address = usize::try_from(address.get()).ok().filter(|_| enable.get());
        if let Some(address) = address
            && let Some(word) = Arc::make_mut(&mut self.words).get_mut(address)
        {
            *word = data.get();
        }
        self
    }
}

impl<const A: usize, const D: usize> Words for SimRam<A, D> {
    fn width(&self) -> usize {
        D
    }
    fn len(&self) -> usize {
        self.words.len()
    }
    fn word(&self, index: usize) -> u64 {
        self.words.get(index).copied().unwrap_or(0)
    }
    fn label(&self) -> &'static Field {
        &WORD
    }
}

impl<const A: usize, const D: usize> Signals<Sim> for SimRam<A, D> {
    fn visit<V: Visit<Sim>>(&self, field: &'static Field, visitor: &mut V) {
        visitor.ram(field, self);
    }
    fn make<M: Make<Sim>>(field: &'static Field, maker: &mut M) -> Self {
        maker.ram(field)
    }
}

impl<const K: usize, const D: usize> SimShiftRegister<K, D> {
    /// A register that holds the given words, stage 0 first, zeros where they end.
    pub fn new(stages: impl IntoIterator<Item = u64>) -> Self {
        let words = stages.into_iter().map(|word| UInt::<D>::from(word).get());
        SimShiftRegister {
            stages: words.chain(std::iter::repeat(0)).take(K).collect(),
        }
    }

    /// It with these stages, of which there are as many as it has.
    pub(crate) fn of_words(stages: Arc<[u64]>) -> Self {
        SimShiftRegister { stages }
    }
}

impl<const K: usize, const D: usize> ShiftRegister<Sim, K, D> for SimShiftRegister<K, D> {
    fn stage(&self, index: usize) -> UInt<D> {
        self.stages.get(index).copied().unwrap_or(0).into()
    }

    fn tap<const T: usize>(&self, tap: UInt<T>) -> UInt<D> {
        self.stage(usize::try_from(tap.get()).unwrap_or(usize::MAX))
    }

    fn shift(mut self, enable: Wire, input: UInt<D>) -> Self {
        if enable.get() && K > 0 {
            let stages = Arc::make_mut(&mut self.stages);
            stages.rotate_right(1);
            if let Some(first) = stages.first_mut() {
                *first = input.get();
            }
        }
        self
    }
}

impl<const K: usize, const D: usize> Words for SimShiftRegister<K, D> {
    fn width(&self) -> usize {
        D
    }
    fn len(&self) -> usize {
        self.stages.len()
    }
    fn word(&self, index: usize) -> u64 {
        self.stages.get(index).copied().unwrap_or(0)
    }
    fn label(&self) -> &'static Field {
        &STAGE
    }
}

impl<const K: usize, const D: usize> Signals<Sim> for SimShiftRegister<K, D> {
    fn visit<V: Visit<Sim>>(&self, field: &'static Field, visitor: &mut V) {
        visitor.shift_register(field, self);
    }
    fn make<M: Make<Sim>>(field: &'static Field, maker: &mut M) -> Self {
        maker.shift_register(field)
    }
}
