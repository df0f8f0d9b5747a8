//! The meaning [`Sim`]: words are numbers.

mod memory;
mod words;

pub use memory::{SimRam, SimShiftRegister};
pub use words::{Int, UInt, Wire};

use super::{Image, Logic};

/// Words are numbers, memories hold bits: the meaning that runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sim;

impl Logic for Sim {
    type Bit = Wire;
    type U<const N: usize> = UInt<N>;
    type I<const N: usize> = Int<N>;
    type Ram<const A: usize, const D: usize> = SimRam<A, D>;
    type ShiftRegister<const K: usize, const D: usize> = SimShiftRegister<K, D>;

    fn rom<const A: usize, const D: usize>(image: &Image<A, D>, address: UInt<A>) -> UInt<D> {
        image.get(address.get() as usize).into()
    }
}
