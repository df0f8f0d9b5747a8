use super::{Element, LaneBit, LaneUInt, Lanes};
use crate::kernel::{Field, Make, Signals, Visit};
use crate::logic::{Bit, Image, Ram, ShiftRegister};

/// A RAM in every lane, the lanes of a word side by side.
#[derive(Debug, Clone)]
pub struct LaneRam<const K: usize, E, const A: usize, const D: usize>(Box<[LaneUInt<K, E, D>]>);

/// A shift register in every lane; its lanes may shift in different ticks.
#[derive(Debug, Clone)]
pub struct LaneShiftRegister<const K: usize, E, const S: usize, const D: usize>(
    Box<[LaneUInt<K, E, D>]>,
);

/// The first `len` words, zeros where they end.
fn words<const K: usize, E: Element, const D: usize>(
    words: impl IntoIterator<Item = LaneUInt<K, E, D>>,
    len: usize,
) -> Box<[LaneUInt<K, E, D>]> {
    let zeros = std::iter::repeat(0.into());
    words.into_iter().chain(zeros).take(len).collect()
}

impl<const K: usize, E: Element, const A: usize, const D: usize> LaneRam<K, E, A, D> {
    /// A memory that holds the given words, zeros where they end.
    pub fn new(given: impl IntoIterator<Item = LaneUInt<K, E, D>>) -> Self {
        LaneRam(words(given, Image::<A, D>::WORDS))
    }

    /// The words by address.
    pub fn words(&self) -> &[LaneUInt<K, E, D>] {
        &self.0
    }
}

impl<const K: usize, E: Element, const A: usize, const D: usize> Ram<Lanes<K, E>, A, D>
    for LaneRam<K, E, A, D>
{
    #[inline]
    fn read(&self, address: LaneUInt<K, E, A>) -> LaneUInt<K, E, D> {
        LaneUInt::each(|k| self.0[address.get(k) as usize].get(k))
    }

    #[inline]
    fn read_when(
        &self,
        enable: LaneBit<K, E>,
        address: LaneUInt<K, E, A>,
        held: LaneUInt<K, E, D>,
    ) -> LaneUInt<K, E, D> {
        enable.mux(self.read(address), held)
    }

    #[inline]
    fn write(
        mut self,
        enable: LaneBit<K, E>,
        address: LaneUInt<K, E, A>,
        data: LaneUInt<K, E, D>,
    ) -> Self {
        for lane in (0..K).filter(|&k| enable.get(k)) {
            self.0[address.get(lane) as usize].set(lane, data);
        }
        self
    }
}

impl<const K: usize, E: Element, const A: usize, const D: usize> Signals<Lanes<K, E>>
    for LaneRam<K, E, A, D>
{
    fn visit<V: Visit<Lanes<K, E>>>(&self, field: &'static Field, visitor: &mut V) {
        visitor.ram(field, self);
    }
    fn make<M: Make<Lanes<K, E>>>(field: &'static Field, maker: &mut M) -> Self {
        maker.ram(field)
    }
}

impl<const K: usize, E: Element, const S: usize, const D: usize> LaneShiftRegister<K, E, S, D> {
    /// A register that holds the given words, stage 0 first, zeros where they end.
    pub fn new(given: impl IntoIterator<Item = LaneUInt<K, E, D>>) -> Self {
        LaneShiftRegister(words(given, S))
    }

    /// The stages, that of the input first.
    pub fn stages(&self) -> &[LaneUInt<K, E, D>] {
        &self.0
    }
}

impl<const K: usize, E: Element, const S: usize, const D: usize> ShiftRegister<Lanes<K, E>, S, D>
    for LaneShiftRegister<K, E, S, D>
{
    #[inline]
    fn stage(&self, index: usize) -> LaneUInt<K, E, D> {
        self.0.get(index).copied().unwrap_or(0.into())
    }

    #[inline]
    fn tap<const T: usize>(&self, tap: LaneUInt<K, E, T>) -> LaneUInt<K, E, D> {
        LaneUInt::each(|k| {
            let stage = usize::try_from(tap.get(k)).ok();
            stage
                .and_then(|stage| self.0.get(stage))
                .map_or(0, |stage| stage.get(k))
        })
    }

    #[inline]
    fn shift(mut self, enable: LaneBit<K, E>, input: LaneUInt<K, E, D>) -> Self {
        if (0..K).any(|k| enable.get(k)) {
            let mut before = input;
            for stage in &mut self.0 {
                let held = std::mem::replace(stage, enable.mux(before, *stage));
                before = held;
            }
        }
        self
    }
}

impl<const K: usize, E: Element, const S: usize, const D: usize> Signals<Lanes<K, E>>
    for LaneShiftRegister<K, E, S, D>
{
    fn visit<V: Visit<Lanes<K, E>>>(&self, field: &'static Field, visitor: &mut V) {
        visitor.shift_register(field, self);
    }
    fn make<M: Make<Lanes<K, E>>>(field: &'static Field, maker: &mut M) -> Self {
        maker.shift_register(field)
    }
}
