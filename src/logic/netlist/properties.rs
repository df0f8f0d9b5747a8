//! The properties of a circuit as assertions of its module.

use super::Netlist;
use super::build::{builder, node};
use super::leaves::make_leaves;
use super::memory::{NetRam, NetShiftRegister, State};
use super::module::Assertion;
use super::nets::{Edge, Leaf};
use super::node::Node;
use super::words::{NetBit, NetInt, NetUInt, Word};
use crate::kernel::{Circuit, Field, Make, Moment, Role, Signals};

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
    let (past_i, past_q, past_w) = (past(i), past(q), past(w));
    let before = Moment {
        i: &past_i,
        q: &past_q,
        w: &past_w,
    };
    let steps = circuit.properties(&before, q);
    for (always, step) in properties.into_iter().zip(steps) {
        let property = if always.step { step } else { always };
        builder(|builder| {
            builder.assertions.push(Assertion {
                name: property.name,
                step: property.step,
                holds: property.holds.id(),
            });
        });
    }
}

/// A bundle as it was a tick ago; memories as they are.
fn past<S: Signals<Netlist>>(signals: &S) -> S {
    let field = const { &Field::part(Role::Net) };
    let mut leaves = Edge(Vec::new());
    signals.visit(field, &mut leaves);
    let mut past = Past(leaves.0.into_iter());
    S::make(field, &mut past)
}

struct Past(std::vec::IntoIter<Leaf>);

impl Past {
    fn word<W: Word>(&mut self) -> W {
        match self.0.next() {
            Some(Leaf::Word(id)) => W::of(node(Node::Past(id), W::SHAPE)),
            // The same walk gives the same leaves.
            _ => W::of(0),
        }
    }

    fn memory(&mut self) -> (usize, State) {
        match self.0.next() {
            Some(Leaf::Memory(memory, state)) => (memory, state),
            _ => (0, State::Next),
        }
    }
}

make_leaves!(Past, Past::word, Past::memory);
