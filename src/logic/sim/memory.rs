use super::{Sim, UInt, Wire};
use crate::kernel::{Changed, Field, Make, STAGE, Signals, Visit, WORD, Words};
use crate::logic::{Image, Ram, ShiftRegister};
use std::any::Any;

/// A RAM whose bits lie in a `bitvec`.
#[derive(Debug, Clone)]
pub struct SimRam<const A: usize, const D: usize> {
    image: Image<A, D>,
    /// Words written since power-on.
    writes: u64,
    /// Where the last one was.
    written: usize,
}

/// A shift register as a ring: the head moves, the words stay; its stages are presented in order.
#[derive(Debug, Clone)]
pub struct SimShiftRegister<const K: usize, const D: usize> {
    ring: Box<[UInt<D>]>,
    head: usize,
    /// Shifts since power-on.
    shifts: u64,
}

impl<const A: usize, const D: usize> From<Image<A, D>> for SimRam<A, D> {
    fn from(image: Image<A, D>) -> Self {
        SimRam {
            image,
            writes: 0,
            written: 0,
        }
    }
}

impl<const A: usize, const D: usize> Ram<Sim, A, D> for SimRam<A, D> {
    #[inline(always)]
    fn read(&self, address: UInt<A>) -> UInt<D> {
        self.image.get(address.get() as usize).into()
    }

    #[inline(always)]
    fn read_when(&self, enable: Wire, address: UInt<A>, held: UInt<D>) -> UInt<D> {
        if enable.get() {
            self.read(address)
        } else {
            held
        }
    }

    #[inline(always)]
    fn write(mut self, enable: Wire, address: UInt<A>, data: UInt<D>) -> Self {
        if enable.get() {
            self.written = address.get() as usize;
            self.writes = self.writes.wrapping_add(1);
            self.image.set(self.written, data.get());
        }
        self
    }
}

impl<const A: usize, const D: usize> Words for SimRam<A, D> {
    fn width(&self) -> usize {
        D
    }
    fn len(&self) -> usize {
        Image::<A, D>::WORDS
    }
    fn word(&self, index: usize) -> u64 {
        self.image.get(index)
    }
    #[inline(always)]
    fn changed(&self, mark: &mut u64) -> Changed {
        let writes = self
            .writes
            .wrapping_sub(std::mem::replace(mark, self.writes));
        match writes {
            0 => Changed::None,
            1 => Changed::One(self.written),
            _ => Changed::All,
        }
    }
    fn label(&self) -> &'static Field {
        &WORD
    }
    fn whole(&self) -> Box<dyn Any> {
        Box::new(self.clone())
    }
}

impl<const A: usize, const D: usize> Signals<Sim> for SimRam<A, D> {
    #[inline(always)]
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
        let mut ring = vec![UInt::default(); K].into_boxed_slice();
        for (stage, word) in ring.iter_mut().zip(stages) {
            *stage = word.into();
        }
        SimShiftRegister {
            ring,
            head: 0,
            shifts: 0,
        }
    }
}

impl<const K: usize, const D: usize> ShiftRegister<Sim, K, D> for SimShiftRegister<K, D> {
    #[inline(always)]
    fn stage(&self, index: usize) -> UInt<D> {
        stage(&self.ring, self.head, index)
    }

    #[inline(always)]
    fn tap<const T: usize>(&self, tap: UInt<T>) -> UInt<D> {
        self.stage(usize::try_from(tap.get()).unwrap_or(usize::MAX))
    }

    #[inline(always)]
    fn shift(mut self, enable: Wire, input: UInt<D>) -> Self {
        if enable.get() && K > 0 {
            self.head = if self.head == 0 { K - 1 } else { self.head - 1 };
            if let Some(stage) = self.ring.get_mut(self.head) {
                *stage = input;
            }
            self.shifts = self.shifts.wrapping_add(1);
        }
        self
    }
}

impl<const K: usize, const D: usize> Words for SimShiftRegister<K, D> {
    fn width(&self) -> usize {
        D
    }
    fn len(&self) -> usize {
        K
    }
    fn word(&self, index: usize) -> u64 {
        stage(&self.ring, self.head, index).get()
    }
    #[inline(always)]
    fn changed(&self, mark: &mut u64) -> Changed {
        match std::mem::replace(mark, self.shifts) == self.shifts {
            true => Changed::None,
            false => Changed::All,
        }
    }
    fn label(&self) -> &'static Field {
        &STAGE
    }
    fn whole(&self) -> Box<dyn Any> {
        Box::new(self.clone())
    }
}

/// Stage `index` of a ring.
#[inline(always)]
fn stage<const D: usize>(ring: &[UInt<D>], head: usize, index: usize) -> UInt<D> {
    let stages = ring.len();
    if index >= stages {
        return UInt::default();
    }
    let place = head + index;
    let place = if place < stages {
        place
    } else {
        place - stages
    };
    ring.get(place).copied().unwrap_or_default()
}

impl<const K: usize, const D: usize> Signals<Sim> for SimShiftRegister<K, D> {
    #[inline(always)]
    fn visit<V: Visit<Sim>>(&self, field: &'static Field, visitor: &mut V) {
        visitor.shift_register(field, self);
    }
    fn make<M: Make<Sim>>(field: &'static Field, maker: &mut M) -> Self {
        maker.shift_register(field)
    }
}
