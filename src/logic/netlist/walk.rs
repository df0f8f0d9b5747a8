//! The walks over signals of a netlist: compiled once for each bundle, whatever they are for.

use super::Netlist;
use super::memory::{NetRam, NetShiftRegister, State};
use super::node::{BIT, Id, signed, unsigned};
use super::words::{NetBit, NetInt, NetUInt};
use crate::kernel::{Field, Make, Role, STAGE, Shape, Signals, Visit, WORD, part};

/// What is done with the leaves of a bundle.
pub(super) trait Look {
    /// A struct begins.
    fn enter(&mut self, _field: &'static Field) {}
    /// The struct entered last ends.
    fn leave(&mut self) {}
    /// What comes next is element `index` of an array.
    fn element(&mut self, _index: usize) {}
    /// A word.
    fn word(&mut self, field: &'static Field, shape: Shape, id: Id);
    /// A memory or shift register.
    fn memory(&mut self, memory: usize, state: State);
}

/// Where the leaves of a bundle come from.
pub(super) trait Give {
    /// A struct begins.
    fn enter(&mut self, _field: &'static Field) {}
    /// The struct entered last ends.
    fn leave(&mut self) {}
    /// What comes next is element `index` of an array.
    fn element(&mut self, _index: usize) {}
    /// A word.
    fn word(&mut self, field: &'static Field, shape: Shape) -> Id;
    /// A memory or shift register of so many words, each of which is called `label`.
    fn memory(
        &mut self,
        field: &'static Field,
        label: &'static Field,
        words: usize,
        width: usize,
    ) -> (usize, State);
}

/// Shows a part of a circuit.
#[inline(never)]
pub(super) fn look<S: Signals<Netlist>>(signals: &S, role: Role, look: &mut dyn Look) {
    signals.visit(part(role), &mut Looking(look));
}

/// Makes a part of a circuit.
#[inline(never)]
pub(super) fn make<S: Signals<Netlist>>(role: Role, give: &mut dyn Give) -> S {
    S::make(part(role), &mut Giving(give))
}

struct Looking<'a>(&'a mut dyn Look);

impl Visit<Netlist> for Looking<'_> {
    fn enter(&mut self, field: &'static Field) {
        self.0.enter(field);
    }
    fn leave(&mut self) {
        self.0.leave();
    }
    fn element(&mut self, index: usize) {
        self.0.element(index);
    }
    fn bit(&mut self, field: &'static Field, value: NetBit) {
        self.0.word(field, BIT, value.0);
    }
    fn unsigned<const N: usize>(&mut self, field: &'static Field, value: NetUInt<N>) {
        self.0.word(field, unsigned(N), value.0);
    }
    fn signed<const N: usize>(&mut self, field: &'static Field, value: NetInt<N>) {
        self.0.word(field, signed(N), value.0);
    }
    fn ram<const A: usize, const D: usize>(&mut self, _: &'static Field, ram: &NetRam<A, D>) {
        self.0.memory(ram.memory, ram.state);
    }
    fn shift_register<const K: usize, const D: usize>(
        &mut self,
        _: &'static Field,
        register: &NetShiftRegister<K, D>,
    ) {
        self.0.memory(register.memory, register.state);
    }
}

struct Giving<'a>(&'a mut dyn Give);

impl Make<Netlist> for Giving<'_> {
    fn enter(&mut self, field: &'static Field) {
        self.0.enter(field);
    }
    fn leave(&mut self) {
        self.0.leave();
    }
    fn element(&mut self, index: usize) {
        self.0.element(index);
    }
    fn bit(&mut self, field: &'static Field) -> NetBit {
        NetBit(self.0.word(field, BIT))
    }
    fn unsigned<const N: usize>(&mut self, field: &'static Field) -> NetUInt<N> {
        NetUInt(self.0.word(field, unsigned(N)))
    }
    fn signed<const N: usize>(&mut self, field: &'static Field) -> NetInt<N> {
        NetInt(self.0.word(field, signed(N)))
    }
    fn ram<const A: usize, const D: usize>(&mut self, field: &'static Field) -> NetRam<A, D> {
        let (memory, state) = self.0.memory(field, &WORD, 1 << A, D);
        NetRam { memory, state }
    }
    fn shift_register<const K: usize, const D: usize>(
        &mut self,
        field: &'static Field,
    ) -> NetShiftRegister<K, D> {
        let (memory, state) = self.0.memory(field, &STAGE, K, D);
        NetShiftRegister { memory, state }
    }
}
