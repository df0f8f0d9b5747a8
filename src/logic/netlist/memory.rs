use super::Netlist;
use super::build::{node, read_after_write, rom};
use super::node::{Id, Node, unsigned};
use super::words::{NetBit, NetUInt};
use crate::kernel::{Field, Make, Signals, Visit};
use crate::logic::{Bit, Image, Ram, ShiftRegister, Unsigned};

/// Where a memory of a netlist stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum State {
    /// As it was before the edge.
    Before,
    /// Written: enable, address and data.
    Written(Id, Id, Id),
    /// Shifted: enable and data.
    Shifted(Id, Id),
    /// As its instance makes it.
    Next,
}

/// A RAM of a netlist.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NetRam<const A: usize, const D: usize> {
    pub(super) memory: usize,
    pub(super) state: State,
}

/// A shift register of a netlist.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NetShiftRegister<const K: usize, const D: usize> {
    pub(super) memory: usize,
    pub(super) state: State,
}

/// Notes it where a memory is used after its edge.
fn before_edge(memory: usize, state: State) {
    if state != State::Before {
        read_after_write(memory);
    }
}

impl<const A: usize, const D: usize> Ram<Netlist, A, D> for NetRam<A, D> {
    fn read(&self, address: NetUInt<A>) -> NetUInt<D> {
        before_edge(self.memory, self.state);
        NetUInt(node(Node::Read(self.memory, address.0), unsigned(D)))
    }
    fn read_when(&self, enable: NetBit, address: NetUInt<A>, held: NetUInt<D>) -> NetUInt<D> {
        enable.mux(self.read(address), held)
    }
    fn write(self, enable: NetBit, address: NetUInt<A>, data: NetUInt<D>) -> Self {
        before_edge(self.memory, self.state);
        NetRam {
            state: State::Written(enable.0, address.0, data.0),
            ..self
        }
    }
}

impl<const K: usize, const D: usize> NetShiftRegister<K, D> {
    fn read(&self, stage: Id) -> Id {
        before_edge(self.memory, self.state);
        node(Node::Read(self.memory, stage), unsigned(D))
    }
}

impl<const K: usize, const D: usize> ShiftRegister<Netlist, K, D> for NetShiftRegister<K, D> {
    fn stage(&self, index: usize) -> NetUInt<D> {
        match index < K {
            true => NetUInt(self.read(NetUInt::<64>::from(index as u64).0)),
            false => 0.into(),
        }
    }
    fn tap<const T: usize>(&self, tap: NetUInt<T>) -> NetUInt<D> {
        // A single stage has no index.
        let stage = match K {
            0 | 1 => self.stage(0),
            _ => NetUInt(self.read(tap.0)),
        };
        // A tap that can name more stages than there are reads zero there.
        match (K as u64).checked_shr(T as u32).unwrap_or(0) {
            0 => tap.below((K as u64).into()).mux(stage, 0.into()),
            _ => stage,
        }
    }
    fn shift(self, enable: NetBit, input: NetUInt<D>) -> Self {
        before_edge(self.memory, self.state);
        NetShiftRegister {
            state: State::Shifted(enable.0, input.0),
            ..self
        }
    }
}

macro_rules! leaf {
    ($memory:ident, $walk:ident, $words:expr) => {
        impl<const K: usize, const D: usize> Signals<Netlist> for $memory<K, D> {
            fn visit<V: Visit<Netlist>>(&self, field: &'static Field, visitor: &mut V) {
                visitor.$walk(field, self);
            }
            fn make<M: Make<Netlist>>(field: &'static Field, maker: &mut M) -> Self {
                maker.$walk(field)
            }
        }
    };
}

leaf!(NetRam, ram, 1 << K);
leaf!(NetShiftRegister, shift_register, K);

/// A read of a memory that is never written.
pub(super) fn read_rom<const A: usize, const D: usize>(
    image: &Image<A, D>,
    address: NetUInt<A>,
) -> NetUInt<D> {
    let words = (0..Image::<A, D>::WORDS).map(|word| image.get(word));
    let memory = rom(D, words.collect());
    NetUInt(node(Node::Read(memory, address.0), unsigned(D)))
}
