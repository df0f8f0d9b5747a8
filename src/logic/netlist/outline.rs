//! The signals of a circuit without a circuit: names and shapes, in the order of the walk.

use super::Netlist;
use super::memory::State;
use super::node::Id;
use super::walk::{Give, make};
use crate::kernel::{Circuit, Field, Outline, Role, Shape};

/// Shows what the signals of a circuit are: a scope with its name, in it ports in, registers, nets.
pub(crate) fn outline<C: Circuit>(show: &mut dyn Outline) {
    show.enter(const { &Field::named(C::NAME) });
    parts::<C>(&[Role::Input, Role::Register, Role::Net], show);
    show.leave();
}

/// Shows what some parts of a circuit are.
pub(crate) fn parts<C: Circuit>(roles: &[Role], show: &mut dyn Outline) {
    let mut shown = Shown(show);
    for role in roles {
        // The records are of no use: they say which leaves there are by being made.
        match role {
            Role::Input => drop(make::<C::In<Netlist>>(*role, &mut shown)),
            Role::Register => drop(make::<C::Reg<Netlist>>(*role, &mut shown)),
            Role::Net => drop(make::<C::Net<Netlist>>(*role, &mut shown)),
        }
    }
}

struct Shown<'a>(&'a mut dyn Outline);

impl Give for Shown<'_> {
    fn enter(&mut self, field: &'static Field) {
        self.0.enter(field);
    }
    fn leave(&mut self) {
        self.0.leave();
    }
    fn element(&mut self, index: usize) {
        self.0.element(index);
    }
    fn word(&mut self, field: &'static Field, shape: Shape) -> Id {
        self.0.leaf(field, shape);
        0
    }
    fn memory(
        &mut self,
        field: &'static Field,
        label: &'static Field,
        words: usize,
        width: usize,
    ) -> (usize, State) {
        self.0.memory(field, label, words, width);
        (0, State::Next)
    }
}

/// The records of a circuit whose words are the numbers of their leaves.
pub(crate) fn places<C: Circuit>() -> (C::In<Netlist>, C::Reg<Netlist>, C::Net<Netlist>) {
    let mut count = Count(0);
    let i = make(Role::Input, &mut count);
    let q = make(Role::Register, &mut count);
    let w = make(Role::Net, &mut count);
    (i, q, w)
}

struct Count(usize);

impl Give for Count {
    fn word(&mut self, _: &'static Field, _: Shape) -> Id {
        self.0 += 1;
        self.0 - 1
    }
    fn memory(
        &mut self,
        _: &'static Field,
        _: &'static Field,
        words: usize,
        _: usize,
    ) -> (usize, State) {
        self.0 += words;
        (self.0 - words, State::Next)
    }
}
