//! The properties of a circuit as assertions of its module.

use super::Netlist;
use super::build::{builder, node};
use super::memory::State;
use super::module::Assertion;
use super::nets::Leaf;
use super::node::{Id, Node};
use super::walk::{Give, Look, look, make};
use crate::kernel::{Circuit, Field, Moment, Property, Role, Shape};
use std::collections::VecDeque;

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
    let mut past = Past::default();
    look(i, Role::Input, &mut past);
    look(q, Role::Register, &mut past);
    look(w, Role::Net, &mut past);
    let past_i = make(Role::Input, &mut past);
    let past_q = make(Role::Register, &mut past);
    let past_w = make(Role::Net, &mut past);
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
                signals: property.signals,
                step: property.step,
                holds: property.holds.0,
            });
        });
    }
}

/// Makes the bundles that were looked at as they were a tick ago; memories as they are.
#[derive(Default)]
struct Past(VecDeque<Leaf>);

impl Look for Past {
    fn word(&mut self, _: &'static Field, _: Shape, id: Id) {
        self.0.push_back(Leaf::Word(id));
    }
    fn memory(&mut self, memory: usize, state: State) {
        self.0.push_back(Leaf::Memory(memory, state));
    }
}

impl Give for Past {
    fn word(&mut self, _: &'static Field, shape: Shape) -> Id {
        match self.0.pop_front() {
            Some(Leaf::Word(id)) => node(Node::Past(id), shape),
            // The same walk gives the same leaves.
            _ => 0,
        }
    }
    fn memory(
        &mut self,
        _: &'static Field,
        _: &'static Field,
        _: usize,
        _: usize,
    ) -> (usize, State) {
        match self.0.pop_front() {
            Some(Leaf::Memory(memory, state)) => (memory, state),
            _ => (0, State::Next),
        }
    }
}
