//! How the leaves of a circuit become nodes: its own, and those of the circuits inside it.

use super::Netlist;
use super::build::{PowerOn, builder, flat, node, signal};
use super::memory::{NetRam, NetShiftRegister, State};
use super::module::{Memory, Port, Register};
use super::node::Node;
use super::words::{NetBit, NetInt, NetUInt, Word};
use crate::kernel::{Field, Make, Path, Role};

/// Makes inputs and registers.
#[derive(Default)]
pub(super) struct Leaves {
    path: Path,
}

impl Leaves {
    fn word<W: Word>(&mut self, field: &'static Field) -> W {
        let name = self.path.name(field);
        let scopes = self.path.scopes().to_vec();
        let role = self.path.role();
        builder(|builder| {
            let mut signal = signal(flat(&scopes, &name), field, W::SHAPE);
            signal.role = role;
            if role == Role::Register {
                if let Some(PowerOn::Bits(bits)) = builder.power_on.get(builder.registers.len()) {
                    signal.power_on = *bits;
                }
                let register = Register::Signal(builder.signals.len());
                builder.registers.push(register);
            }
            let signal = builder.signal(signal, scopes);
            W::of(builder.node(Node::Signal(signal), W::SHAPE))
        })
    }

    fn memory(&mut self, field: &'static Field, words: usize, width: usize) -> usize {
        let name = self.path.name(field);
        let scopes = self.path.scopes().to_vec();
        builder(|builder| {
            let filled = match builder.power_on.get(builder.registers.len()) {
                Some(PowerOn::Words(words)) => words.iter().any(|word| *word != 0),
                _ => false,
            };
            builder.memories.push(Memory {
                name: flat(&scopes, &name),
                doc: field.doc,
                words,
                width,
                port: Port::Rom,
                filled,
                inner: false,
            });
            builder.memory_scopes.push(scopes);
            let memory = builder.memories.len() - 1;
            builder.registers.push(Register::Memory(memory));
            memory
        })
    }
}

impl Make<Netlist> for Leaves {
    fn enter(&mut self, field: &'static Field) {
        self.path.enter(field);
    }
    fn leave(&mut self) {
        self.path.leave();
    }
    fn element(&mut self, index: usize) {
        self.path.element(index);
    }
    fn bit(&mut self, field: &'static Field) -> NetBit {
        self.word(field)
    }
    fn unsigned<const N: usize>(&mut self, field: &'static Field) -> NetUInt<N> {
        self.word(field)
    }
    fn signed<const N: usize>(&mut self, field: &'static Field) -> NetInt<N> {
        self.word(field)
    }
    fn ram<const A: usize, const D: usize>(&mut self, field: &'static Field) -> NetRam<A, D> {
        NetRam {
            memory: self.memory(field, 1 << A, D),
            state: State::Before,
        }
    }
    fn shift_register<const K: usize, const D: usize>(
        &mut self,
        field: &'static Field,
    ) -> NetShiftRegister<K, D> {
        NetShiftRegister {
            memory: self.memory(field, K, D),
            state: State::Before,
        }
    }
}

/// Makes the nets of an instance.
pub(super) struct Ports {
    pub(super) instance: usize,
    pub(super) leaf: usize,
}

/// Makes the registers of an instance after the edge.
pub(super) struct NextRegisters {
    pub(super) place: usize,
}

/// A maker of words that are all nodes of one kind, and of memories after their edge.
macro_rules! make_leaves {
    ($maker:ty, $node:expr, $memory:expr) => {
        impl Make<Netlist> for $maker {
            fn enter(&mut self, _: &'static Field) {}
            fn leave(&mut self) {}
            fn element(&mut self, _: usize) {}
            fn bit(&mut self, _: &'static Field) -> NetBit {
                $node(self)
            }
            fn unsigned<const N: usize>(&mut self, _: &'static Field) -> NetUInt<N> {
                $node(self)
            }
            fn signed<const N: usize>(&mut self, _: &'static Field) -> NetInt<N> {
                $node(self)
            }
            fn ram<const A: usize, const D: usize>(&mut self, _: &'static Field) -> NetRam<A, D> {
                let (memory, state) = $memory(self);
                NetRam { memory, state }
            }
            fn shift_register<const K: usize, const D: usize>(
                &mut self,
                _: &'static Field,
            ) -> NetShiftRegister<K, D> {
                let (memory, state) = $memory(self);
                NetShiftRegister { memory, state }
            }
        }
    };
}

pub(super) use make_leaves;

make_leaves!(Ports, Ports::next, |_: &mut Ports| (0, State::Next));
make_leaves!(NextRegisters, NextRegisters::next, NextRegisters::memory);

impl Ports {
    fn next<W: Word>(&mut self) -> W {
        let port = Node::Port {
            instance: self.instance,
            leaf: self.leaf,
        };
        self.leaf += 1;
        W::of(node(port, W::SHAPE))
    }
}

impl NextRegisters {
    fn next<W: Word>(&mut self) -> W {
        self.place += 1;
        W::of(node(Node::Next(self.place - 1), W::SHAPE))
    }

    fn memory(&mut self) -> (usize, State) {
        self.place += 1;
        let place = self.place - 1;
        let memory = builder(|builder| match builder.registers.get(place) {
            Some(Register::Memory(memory)) => *memory,
            _ => usize::MAX,
        });
        (memory, State::Next)
    }
}
