//! Properties of a circuit, written in words.

use super::Circuit;
use super::build::{builder, node};
use super::elaborate::Nets;
use super::leaves::Nodes;
use super::record::{Pass, Record, Source};
use super::view::{self, Seen, Wire};
use super::words::Bit;
use crate::netlist::{Assertion, Field, Id, Node, Register, Role, Shape};
use std::fmt;

/// Signals of a settled tick, and the registers after its edge.
pub struct Moment<C: Circuit> {
    /// Input ports.
    pub i: C::In<Wire>,
    /// Registers.
    pub q: C::Reg<Seen>,
    /// Nets.
    pub w: C::Net<Wire>,
    /// Circuits inside.
    pub p: C::Parts<Seen>,
    /// Registers after the edge.
    pub next: After<C>,
}

/// Registers after an edge.
pub struct After<C: Circuit> {
    /// Registers of the circuit itself.
    pub q: C::Reg<Seen>,
    /// Registers of the circuits inside.
    pub p: C::Parts<Seen>,
}

impl<C: Circuit> fmt::Debug for Moment<C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct(C::NAME).finish_non_exhaustive()
    }
}

impl<C: Circuit> fmt::Debug for After<C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct(C::NAME).finish_non_exhaustive()
    }
}

/// Invariant written in words. `check` proves it at small widths. The printed Verilog has it as an
/// assertion, which other tools can prove at full width.
#[derive(Debug, Clone)]
pub struct Property {
    /// Statement of the property.
    pub name: &'static str,
    /// Signals at fault if the property is violated.
    pub signals: &'static [&'static str],
    /// True if the property reads the registers after the edge.
    pub step: bool,
    /// High if the property holds.
    pub holds: Bit,
}

impl Property {
    /// Creates a property of the settled signals of a tick.
    pub fn always(name: &'static str, signals: &'static [&'static str], holds: Bit) -> Self {
        Property {
            name,
            signals,
            step: false,
            holds,
        }
    }

    /// Creates a property of the settled signals of a tick and the registers after its edge.
    pub fn step(name: &'static str, signals: &'static [&'static str], holds: Bit) -> Self {
        Property {
            step: true,
            ..Property::always(name, signals, holds)
        }
    }
}

/// Adds the properties of a circuit to the module under construction. A property over an edge is
/// stated about the tick before and the registers of this one.
pub(super) fn note<C: Circuit>(circuit: &C, nets: &Nets) {
    let now = There::of(nets);
    let always = circuit.properties(&now.moment(circuit, &now));
    if always.is_empty() {
        return;
    }
    let past = now.past();
    assert(always, circuit.properties(&past.moment(circuit, &now)));
}

/// Adds properties to the module under construction: `always` states each about this tick, `steps`
/// about the edge before it.
fn assert(always: Vec<Property>, steps: Vec<Property>) {
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

/// Nodes of all signals of the module under construction, in the order of the walks.
struct There {
    inputs: Vec<Id>,
    registers: Vec<Id>,
    nets: Vec<Id>,
}

impl There {
    fn of(nets: &Nets) -> Self {
        let (inputs, registers): (Vec<_>, Vec<_>) = builder(|builder| {
            let signals = builder.signals.iter().enumerate();
            let inputs = signals.filter(|(_, signal)| signal.role == Role::Input);
            let inputs = inputs.map(|(index, signal)| (index, signal.shape));
            let registers = builder
                .registers
                .iter()
                .filter_map(|register| match register {
                    Register::Signal(signal) => Some((*signal, builder.signals[*signal].shape)),
                    Register::Memory(_) => None,
                });
            (inputs.collect(), registers.collect())
        });
        let read = |signals: Vec<(usize, Shape)>| {
            let nodes = signals.into_iter();
            nodes
                .map(|(signal, shape)| node(Node::Signal(signal), shape))
                .collect()
        };
        There {
            inputs: read(inputs),
            registers: read(registers),
            nets: nets.nodes.clone(),
        }
    }

    /// Returns the nodes of one tick ago.
    fn past(&self) -> There {
        let past = |nodes: &[Id]| {
            let nodes = nodes.iter();
            nodes
                .map(|id| node(Node::Past(*id), super::build::shape(*id)))
                .collect()
        };
        There {
            inputs: past(&self.inputs),
            registers: past(&self.registers),
            nets: past(&self.nets),
        }
    }

    fn moment<C: Circuit>(&self, circuit: &C, next: &There) -> Moment<C> {
        let mut inputs = Nodes(self.inputs.iter());
        let i = C::In::make(circuit, view::role(Role::Input), &mut inputs);
        let mut again = self.again();
        let q = C::Reg::make(circuit, view::role(Role::Register), &mut again);
        let p = C::Parts::make(circuit, view::role(Role::Net), &mut again);
        again.pass(Pass::Nets);
        let w = C::Net::make(circuit, view::role(Role::Net), &mut again);
        let mut again = next.again();
        let next = After {
            q: C::Reg::make(circuit, view::role(Role::Register), &mut again),
            p: C::Parts::make(circuit, view::role(Role::Net), &mut again),
        };
        Moment { i, q, w, p, next }
    }

    /// Returns a source of the registers, and of the nets where a part has them.
    fn again(&self) -> Again<'_> {
        Again {
            registers: Nodes(self.registers.iter()),
            nets: Nodes(self.nets.iter()),
            pass: Pass::Registers,
        }
    }
}

/// Source of existing nodes, in the order of the walks.
struct Again<'a> {
    registers: Nodes<'a>,
    nets: Nodes<'a>,
    pass: Pass,
}

impl Source for Again<'_> {
    fn pass(&mut self, pass: Pass) {
        self.pass = pass;
    }
    fn passing(&self) -> Pass {
        self.pass
    }
    fn word(&mut self, field: &'static Field, shape: Shape, power_on: i128) -> u64 {
        match self.pass {
            Pass::Registers => self.registers.word(field, shape, power_on),
            Pass::Nets => self.nets.word(field, shape, power_on),
        }
    }
}
