//! The properties of a circuit as assertions of its module.

use super::Netlist;
use super::build::{builder, node};
use super::memory::State;
use super::module::Assertion;
use super::nets::{Edge, Leaf};
use super::node::{Id, Node};
use super::walk::{Give, make};
use crate::kernel::{Circuit, Field, Moment, Property, Role, Shape, Signals};

/// Adds the properties of a circuit to the module being made. Those that look over an edge are
/// about the tick before and the registers of this one.
pub(super) fn note_properties<C: Circuit>(
    circuit: &C,
    i: &C::In<Netlist>,
    q: &C::Reg<Netlist>,
    w: &C::Net<Netlist>,
) {
    let properties = circuit.properties(&Moment { i, q, w }, q);
    if properties.is_empty() {
        return;
    }
    let past_i = past(i, Role::Input);
    let past_q = past(q, Role::Register);
    let past_w = past(w, Role::Net);
    let before = Moment {
        i: &past_i,
        q: &past_q,
        w: &past_w,
    };
    add(properties, circuit.properties(&before, q));
}

/// Adds each in that of its two forms that it has.
fn add(always: Vec<Property<Netlist>>, steps: Vec<Property<Netlist>>) {
    for (always, step) in always.into_iter().zip(steps) {
        let property = if always.step { step } else { always };
        builder(|builder| {
            builder.assertions.push(Assertion {
                name: property.name,
                step: property.step,
                holds: property.holds.0,
            });
        });
    }
}

/// A bundle as it was a tick ago; memories as they are.
fn past<S: Signals<Netlist>>(signals: &S, role: Role) -> S {
    make(role, &mut Past(Edge::of(signals, role).into_iter()))
}

struct Past(std::vec::IntoIter<Leaf>);

impl Give for Past {
    fn word(&mut self, _: &'static Field, shape: Shape) -> Id {
        match self.0.next() {
            Some(Leaf::Word(id)) => node(Node::Past(id), shape),
            // The same walk gives the same leaves.
            _ => 0,
        }
    }
    fn memory(&mut self, _: &'static Field, _: usize, _: usize) -> (usize, State) {
        match self.0.next() {
            Some(Leaf::Memory(memory, state)) => (memory, state),
            _ => (0, State::Next),
        }
    }
}
