//! Properties of a circuit, written in words.

use super::Circuit;
use super::build::{self, builder, elaboration, mistake, node};
use super::elaborate::Nets;
use super::leaves::Nodes;
use super::memory::Contents;
use super::record::{Cells, MemoryShape, Pass, Record, Source};
use super::view::{self, Open, Wire};
use super::words::Bit;
use crate::netlist::{Assertion, Claim, Field, Id, Node, Register, Role, Shape, Site};
use rustc_hash::FxHashSet;
use std::fmt;

/// Signals of a settled tick, and the registers after its edge.
pub struct Moment<C: Circuit> {
    /// Input ports.
    pub i: C::In<Wire>,
    /// Registers.
    pub q: C::Reg<Open>,
    /// Nets.
    pub w: C::Net<Wire>,
    /// Circuits inside.
    pub p: C::Parts<Open>,
    /// Registers after the edge.
    pub next: After<C>,
}

/// Registers after an edge.
pub struct After<C: Circuit> {
    /// Registers of the circuit itself.
    pub q: C::Reg<Open>,
    /// Registers of the circuits inside.
    pub p: C::Parts<Open>,
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

/// Statement about a circuit, written in words. `check` proves it at small widths and at full
/// width. The printed Verilog has it as an assertion for other tools.
#[derive(Debug, Clone)]
pub struct Property {
    /// The statement: a line of text that no other property of the circuit has.
    pub name: &'static str,
    /// Use of the statement in proofs.
    pub claim: Claim,
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
            claim: Claim::Property,
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

    /// Creates a property of the settled signals of a tick that makes the proofs of others
    /// possible. It is proved like the others and listed apart.
    pub fn helper(name: &'static str, signals: &'static [&'static str], holds: Bit) -> Self {
        Property {
            claim: Claim::Helper,
            ..Property::always(name, signals, holds)
        }
    }

    /// Creates an assumption about the input ports of a tick, which may depend on the state. The
    /// circuit is proved for inputs that keep it in every tick; a circuit that contains this one has
    /// to keep it.
    pub fn given(name: &'static str, holds: Bit) -> Self {
        Property {
            claim: Claim::Given,
            ..Property::always(name, &[], holds)
        }
    }

    /// Creates a condition under which an exhaustive search looks at an input, because other inputs
    /// have the same effect. Proofs at full width do without it.
    pub fn narrowing(name: &'static str, holds: Bit) -> Self {
        Property {
            claim: Claim::Narrowing,
            ..Property::always(name, &[], holds)
        }
    }
}

/// Adds the properties of a circuit to the module under construction. A property over an edge is
/// stated about the tick before and the registers of this one.
pub(super) fn note<C: Circuit>(circuit: &C, nets: &Nets, site: Site) {
    builder(|builder| builder.logic = builder.nodes.len());
    // The signals of a part with mistakes are unknown.
    if elaboration(|elaboration| !elaboration.mistakes.is_empty()) {
        return;
    }
    let now = There::of(nets);
    let always = circuit.properties(&now.moment(circuit, &now));
    if always.is_empty() {
        return;
    }
    let past = now.past();
    let steps = circuit.properties(&past.moment(circuit, &now));
    for what in wrong(&always, &steps) {
        mistake(site, what);
    }
    assert(always, steps);
}

/// Returns the mistakes of properties, stated about this tick and about the edge before it.
fn wrong(always: &[Property], steps: &[Property]) -> Vec<String> {
    let mut wrong = Vec::new();
    for (index, (property, over)) in always.iter().zip(steps).enumerate() {
        let name = property.name;
        if name.trim().is_empty() || name.contains(char::is_control) {
            wrong.push(format!(
                "property {name:?}: a name is one line of text and is not empty"
            ));
        }
        if property.step && matches!(property.claim, Claim::Given | Claim::Narrowing) {
            wrong.push(format!(
                "assumption `{name}` is about an edge; an assumption is about the input ports of a tick"
            ));
        }
        if always[..index].iter().any(|other| other.name == name) {
            wrong.push(format!("two properties are called `{name}`"));
        }
        if !property.step && reads_after(over.holds.0) {
            wrong.push(format!(
                "property `{name}` reads registers after the edge, which only `Property::step` may"
            ));
        }
    }
    wrong
}

/// True if a node of a property over an edge reads a signal or a memory after the edge.
fn reads_after(id: Id) -> bool {
    let mut seen = FxHashSet::default();
    let mut open = vec![id];
    while let Some(id) = open.pop() {
        if !seen.insert(id) {
            continue;
        }
        let (here, _) = builder(|builder| builder.nodes[id]);
        match here {
            Node::Past(_) => {}
            Node::Signal(_) | Node::Port { .. } => return true,
            Node::Read(memory, _) if !builder(|builder| builder.roms.contains(&memory)) => {
                return true;
            }
            _ => open.extend(here.operands()),
        }
    }
    false
}

/// Adds properties to the module under construction: `always` states each about this tick, `steps`
/// about the edge before it.
fn assert(always: Vec<Property>, steps: Vec<Property>) {
    for (always, step) in always.into_iter().zip(steps) {
        let property = if always.step { step } else { always };
        builder(|builder| {
            builder.assertions.push(Assertion {
                name: property.name,
                claim: property.claim,
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
    memories: Vec<usize>,
    nets: Vec<Id>,
    /// True for the tick before the edge.
    past: bool,
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
        let memories = builder(|builder| {
            let registers = builder.registers.iter();
            let memories = registers.filter_map(|register| match register {
                Register::Memory(memory) => Some(*memory),
                Register::Signal(_) => None,
            });
            memories.collect()
        });
        There {
            inputs: read(inputs),
            registers: read(registers),
            memories,
            nets: nets.nodes.clone(),
            past: false,
        }
    }

    /// Returns the nodes of one tick ago.
    fn past(&self) -> There {
        let past = |nodes: &[Id]| {
            let nodes = nodes.iter();
            nodes
                .map(|id| node(Node::Past(*id), build::shape(*id)))
                .collect()
        };
        There {
            inputs: past(&self.inputs),
            registers: past(&self.registers),
            memories: self.memories.clone(),
            nets: past(&self.nets),
            past: true,
        }
    }

    fn moment<C: Circuit>(&self, circuit: &C, next: &There) -> Moment<C> {
        let mut inputs = Nodes(self.inputs.iter());
        let i = C::In::make(circuit, view::role(Role::Input), &mut inputs);
        let mut again = self.again();
        let (q, p) = view::open(circuit, &mut again);
        let w = C::Net::make(circuit, view::role(Role::Net), &mut again);
        let (after_q, after_p) = view::open(circuit, &mut next.again());
        let next = After {
            q: after_q,
            p: after_p,
        };
        Moment { i, q, w, p, next }
    }

    /// Returns a source of the registers, and of the nets where a part has them.
    fn again(&self) -> Again<'_> {
        Again {
            registers: Nodes(self.registers.iter()),
            memories: self.memories.iter(),
            nets: Nodes(self.nets.iter()),
            pass: Pass::Registers,
            past: self.past,
        }
    }
}

/// Source of existing nodes, in the order of the walks.
struct Again<'a> {
    registers: Nodes<'a>,
    memories: std::slice::Iter<'a, usize>,
    nets: Nodes<'a>,
    pass: Pass,
    past: bool,
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
    fn memory(
        &mut self,
        _: &'static Field,
        _: &'static Field,
        shape: MemoryShape,
        _: &dyn Fn() -> Contents,
    ) -> Cells {
        // A walk over the registers has each memory once.
        let memory = self.memories.next().copied().unwrap_or_default();
        Cells {
            past: self.past,
            ..Cells::at(memory, shape)
        }
    }
}

/// Returns the node of one tick ago whose value a node of a property over an edge has: the same
/// function of the signals then. Returns `None` if it reads a signal of after the edge.
pub(super) fn before(id: Id) -> Option<Id> {
    let (here, shape) = builder(|builder| builder.nodes[id]);
    let operands: Vec<Id> = match here {
        Node::Past(then) => return Some(then),
        Node::Constant(_) | Node::Parameter(_) => return Some(id),
        Node::Signal(_) | Node::Port { .. } => return None,
        Node::Read(memory, _) if !builder(|builder| builder.roms.contains(&memory)) => return None,
        _ => here.operands().map(before).collect::<Option<_>>()?,
    };
    let mut operands = operands.into_iter();
    let then = here.map(|operand| operands.next().unwrap_or(operand));
    Some(node(then, shape))
}
