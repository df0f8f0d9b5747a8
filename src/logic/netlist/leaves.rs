//! How the leaves of a circuit become nodes: its own, and those of the circuits inside it.

use super::build::{PowerOn, builder, flat, node, signal};
use super::memory::State;
use super::module::{Memory, Port, Register};
use super::node::{Id, Node};
use super::walk::Give;
use crate::kernel::{Field, Path, Role, Shape};

/// Makes inputs and registers.
#[derive(Default)]
pub(super) struct Leaves {
    path: Path,
}

impl Give for Leaves {
    fn enter(&mut self, field: &'static Field) {
        self.path.enter(field);
    }
    fn leave(&mut self) {
        self.path.leave();
    }
    fn element(&mut self, index: usize) {
        self.path.element(index);
    }

    fn word(&mut self, field: &'static Field, shape: Shape) -> Id {
        let name = self.path.name(field);
        let scopes = self.path.scopes().to_vec();
        let role = self.path.role();
        builder(|builder| {
            let mut signal = signal(flat(&scopes, &name), field, shape);
            signal.role = role;
            if role == Role::Register {
                if let Some(PowerOn::Bits(bits)) = builder.power_on.get(builder.registers.len()) {
                    signal.power_on = *bits;
                }
                let register = Register::Signal(builder.signals.len());
                builder.registers.push(register);
            }
            let signal = builder.signal(signal, scopes);
            builder.node(Node::Signal(signal), shape)
        })
    }

    fn memory(
        &mut self,
        field: &'static Field,
        _: &'static Field,
        words: usize,
        width: usize,
    ) -> (usize, State) {
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
            (memory, State::Before)
        })
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

impl Give for Ports {
    fn word(&mut self, _: &'static Field, shape: Shape) -> Id {
        let port = Node::Port {
            instance: self.instance,
            leaf: self.leaf,
        };
        self.leaf += 1;
        node(port, shape)
    }
    fn memory(
        &mut self,
        _: &'static Field,
        _: &'static Field,
        _: usize,
        _: usize,
    ) -> (usize, State) {
        (0, State::Next)
    }
}

impl Give for NextRegisters {
    fn word(&mut self, _: &'static Field, shape: Shape) -> Id {
        self.place += 1;
        node(Node::Next(self.place - 1), shape)
    }
    fn memory(
        &mut self,
        _: &'static Field,
        _: &'static Field,
        _: usize,
        _: usize,
    ) -> (usize, State) {
        self.place += 1;
        let place = self.place - 1;
        let memory = builder(|builder| match builder.registers.get(place) {
            Some(Register::Memory(memory)) => *memory,
            _ => usize::MAX,
        });
        (memory, State::Next)
    }
}
