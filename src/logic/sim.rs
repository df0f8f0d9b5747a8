//! The meaning [`Sim`]: words are numbers.

mod memory;
mod words;

pub use memory::{RamWords, SimRam, SimShiftRegister, Stages};
pub use words::{Int, UInt, Wire};

use super::{Image, Logic};
use crate::kernel::Circuit;
use std::hint::cold_path;

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

    #[inline(always)]
    fn clock<C: Circuit>(
        circuit: &C,
        q: C::Reg<Self>,
        w: &C::Net<Self>,
        i: &C::In<Self>,
    ) -> C::Reg<Self> {
        match (circuit.coasting(&q, w, i), circuit.gated(&q, w, i)) {
            (None, None) => circuit.next(q, w, i),
            (Some(coasting), _) if coasting.get() => circuit.coast(q),
            (_, Some(gate)) if gate.get() => q,
            _ => {
                cold_path();
                // The nets once more: those that are read here only are computed here only.
                let w = circuit.comb(&q, i);
                circuit.next(q, &w, i)
            }
        }
    }
}
