//! The meaning [`Netlist`]: words are nodes, a circuit is a graph of them.
//!
//! [`elaborate`] runs a circuit's `comb` and `next` once and notes what they compute. Circuits
//! inside it become modules of their own.

mod build;
mod elaborate;
mod finish;
mod leaves;
mod memory;
mod module;
mod nets;
mod node;
mod outline;
mod properties;
mod unroll;
mod walk;
mod words;

pub use elaborate::elaborate;
pub use memory::{NetRam, NetShiftRegister};
pub(crate) use module::Register;
pub use module::{
    Assertion, Child, Design, Memory, Module, NetlistError, Parameter, Port, Setting, Signal, Value,
};
pub use node::{Id, Node, Operator};
pub(crate) use outline::{outline, parts, places};
pub(crate) use unroll::{Constants, combinational, nodes};
pub use words::{NetBit, NetInt, NetUInt};

use super::{Image, Logic};
use crate::kernel::Circuit;

/// Words are nodes of a netlist: the meaning that is printed as HDL.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Netlist;

impl Logic for Netlist {
    type Bit = NetBit;
    type U<const N: usize> = NetUInt<N>;
    type I<const N: usize> = NetInt<N>;
    type Ram<const A: usize, const D: usize> = NetRam<A, D>;
    type ShiftRegister<const K: usize, const D: usize> = NetShiftRegister<K, D>;

    fn rom<const A: usize, const D: usize>(image: &Image<A, D>, address: NetUInt<A>) -> NetUInt<D> {
        memory::read_rom(image, address)
    }

    fn parameter<const N: usize>(name: &'static str, value: u64) -> NetUInt<N> {
        build::parameter(name, value)
    }

    fn settle<C: Circuit>(circuit: &C, q: &C::Reg<Self>, i: &C::In<Self>) -> C::Net<Self> {
        elaborate::settle(circuit, q, i)
    }

    fn clock<C: Circuit>(
        circuit: &C,
        q: C::Reg<Self>,
        w: &C::Net<Self>,
        i: &C::In<Self>,
    ) -> C::Reg<Self> {
        elaborate::clock(circuit, q, w, i)
    }
}
