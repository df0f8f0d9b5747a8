//! The module that is being made, and how nodes get into it.

use super::module::{
    Assertion, Child, Memory, Module, NetlistError, Parameter, Port, Register, Setting, Signal,
};
use super::node::{BIT, Id, Node, Operator, unsigned};
use super::words::NetUInt;
use crate::kernel::{Field, Kind, Shape};
use std::cell::RefCell;
use std::collections::HashMap;

/// Everything that is being made: a circuit makes the modules inside it on its way.
#[derive(Default)]
pub(super) struct Elaboration {
    /// The circuits whose `comb` and `next` are running, outermost first.
    pub(super) open: Vec<Builder>,
    pub(super) modules: Vec<Module>,
    pub(super) errors: Vec<NetlistError>,
    /// Circuits inside the outermost are no modules: their nodes are among those around them.
    pub(super) in_place: bool,
}

thread_local! {
    static ELABORATION: RefCell<Elaboration> = RefCell::default();
}

/// One module being made.
#[derive(Default)]
pub(super) struct Builder {
    pub(super) name: &'static str,
    pub(super) nodes: Vec<(Node, Shape)>,
    pub(super) known: HashMap<(Node, Shape), Id>,
    pub(super) signals: Vec<Signal>,
    /// The scopes around each signal, by its index.
    pub(super) scopes: Vec<Vec<String>>,
    /// Parameters and their values.
    pub(super) parameters: Vec<(Parameter, u64)>,
    pub(super) memories: Vec<Memory>,
    /// The scopes around each memory, by its index.
    pub(super) memory_scopes: Vec<Vec<String>>,
    pub(super) registers: Vec<Register>,
    pub(super) instances: Vec<Building>,
    /// What registers and memories hold at power-on, in the order of `registers`.
    pub(super) power_on: Vec<PowerOn>,
    pub(super) assertions: Vec<Assertion>,
    /// The contents of ROMs, by memory.
    pub(super) roms: Vec<(usize, Vec<u64>)>,
}

/// An instance in a module being made; its name is known at the end.
pub(super) struct Building {
    pub(super) child: Child,
    pub(super) circuit: &'static str,
    /// Its place in the walk over the registers, and how many leaves there are its.
    pub(super) registers: std::ops::Range<usize>,
    pub(super) settings: Vec<Setting>,
}

/// What a leaf of the walk over the registers holds at power-on.
#[derive(Debug, Clone)]
pub(super) enum PowerOn {
    Bits(u64),
    Words(Vec<u64>),
}

/// Works on what is being made.
pub(super) fn elaboration<R>(work: impl FnOnce(&mut Elaboration) -> R) -> R {
    ELABORATION.with(|elaboration| work(&mut elaboration.borrow_mut()))
}

/// Whether circuits inside are no modules.
pub(super) fn in_place() -> bool {
    elaboration(|elaboration| elaboration.in_place)
}

/// Works on the module being made. Words that are made outside of any circuit go to one that
/// nobody asks for.
pub(super) fn builder<R>(work: impl FnOnce(&mut Builder) -> R) -> R {
    elaboration(|elaboration| {
        if elaboration.open.is_empty() {
            elaboration.open.push(Builder::default());
        }
        let last = elaboration.open.len() - 1;
        work(&mut elaboration.open[last])
    })
}

/// The node that computes this: one that is there already, or a new one.
pub(super) fn node(node: Node, shape: Shape) -> Id {
    builder(|builder| builder.node(node, shape))
}

/// A constant, taken modulo 2^N.
#[inline(never)]
pub(super) fn constant(value: u64, shape: Shape) -> Id {
    node(Node::Constant(masked(value, shape)), shape)
}

/// Kind and width of a node.
pub(super) fn shape(id: Id) -> Shape {
    builder(|builder| builder.shape(id))
}

/// A memory is used after its edge.
pub(super) fn read_after_write(memory: usize) {
    elaboration(|elaboration| {
        let Some(builder) = elaboration.open.last() else {
            return;
        };
        let memory = builder.memories.get(memory);
        elaboration.errors.push(NetlistError::Memory {
            module: builder.name.to_owned(),
            memory: memory.map(|memory| memory.name.clone()).unwrap_or_default(),
        });
    });
}

/// A parameter: the one of that name, or a new one.
pub(super) fn parameter<const N: usize>(name: &'static str, value: u64) -> NetUInt<N> {
    if in_place() {
        // Those of circuits that are not told apart may have the same name.
        return value.into();
    }
    NetUInt(builder(|builder| {
        let same = |(known, _): &(Parameter, u64)| known.name == name && known.width == N;
        let known = builder.parameters.iter().position(same);
        let index = known.unwrap_or(builder.parameters.len());
        if known.is_none() {
            let value = masked(value, unsigned(N));
            builder
                .parameters
                .push((Parameter { name, width: N }, value));
        }
        builder.node(Node::Parameter(index), unsigned(N))
    }))
}

/// The ROM with these words.
pub(super) fn rom(width: usize, words: Vec<u64>) -> usize {
    builder(|builder| {
        let same = |memory: &usize| builder.memories[*memory].width == width;
        let known = builder.roms.iter().find(|(_, known)| *known == words);
        if let Some(memory) = known.map(|(memory, _)| *memory).filter(same) {
            return memory;
        }
        let name = match builder.roms.len() {
            0 => "rom".to_owned(),
            others => format!("rom_{}", others + 1),
        };
        builder.memories.push(Memory {
            name,
            doc: "",
            words: words.len(),
            width,
            port: Port::Rom,
            filled: words.iter().any(|word| *word != 0),
            inner: false,
        });
        builder.memory_scopes.push(Vec::new());
        let memory = builder.memories.len() - 1;
        builder.roms.push((memory, words));
        memory
    })
}

fn masked(value: u64, shape: Shape) -> u64 {
    value & (u64::MAX >> (64 - shape.width))
}

impl Builder {
    pub(super) fn shape(&self, id: Id) -> Shape {
        self.nodes.get(id).map_or(BIT, |(_, shape)| *shape)
    }

    fn bits(&self, id: Id) -> Option<u64> {
        match self.nodes.get(id) {
            Some((Node::Constant(bits), _)) => Some(*bits),
            _ => None,
        }
    }

    pub(super) fn node(&mut self, node: Node, shape: Shape) -> Id {
        if let Some(simpler) = self.simpler(node, shape) {
            return simpler;
        }
        let nodes = &mut self.nodes;
        *self.known.entry((node, shape)).or_insert_with(|| {
            nodes.push((node, shape));
            nodes.len() - 1
        })
    }

    /// What is written more simply: choices between the same, operations with constant bits,
    /// conversions that change nothing, conversions of constants.
    fn simpler(&mut self, node: Node, shape: Shape) -> Option<Id> {
        match node {
            Node::Mux(choose, then, other) => match self.bits(choose) {
                Some(0) => Some(other),
                Some(_) => Some(then),
                None => (then == other).then_some(then),
            },
            Node::Not(a) => match self.nodes.get(a) {
                Some((Node::Not(a), _)) => Some(*a),
                Some((Node::Constant(bits), _)) => {
                    let inverted = masked(!bits, shape);
                    Some(self.node(Node::Constant(inverted), shape))
                }
                _ => None,
            },
            Node::Binary(operator, a, b) if shape.kind == Kind::Bit && self.shape(a) == BIT => {
                let (other, bit) = match (self.bits(a), self.bits(b)) {
                    (Some(bit), _) => (b, bit),
                    (_, Some(bit)) => (a, bit),
                    _ => return None,
                };
                match (operator, bit) {
                    (Operator::And, 0) => Some(self.node(Node::Constant(0), BIT)),
                    (Operator::Or, 1) => Some(self.node(Node::Constant(1), BIT)),
                    (Operator::And, _) | (Operator::Or | Operator::Xor, 0) => Some(other),
                    (Operator::Xor, _) => Some(self.node(Node::Not(other), BIT)),
                    _ => None,
                }
            }
            Node::ShiftLeft(a, 0) | Node::ShiftRight(a, 0) => Some(a),
            Node::Slice(a, low) => match self.bits(a) {
                Some(bits) => Some(self.node(Node::Constant(masked(bits >> low, shape)), shape)),
                None if self.shape(a).width == shape.width => Some(self.node(Node::Cast(a), shape)),
                None => None,
            },
            Node::Extend(a) => {
                let bits = self.bits(a)?;
                let from = self.shape(a);
                let spare = 64 - from.width as u32;
                let extended = match from.kind {
                    Kind::Signed => ((bits << spare) as i64 >> spare) as u64,
                    _ => bits,
                };
                Some(self.node(Node::Constant(masked(extended, shape)), shape))
            }
            Node::Cast(a) => match self.nodes.get(a) {
                _ if self.shape(a) == shape => Some(a),
                Some((Node::Constant(bits), _)) => {
                    let bits = *bits;
                    Some(self.node(Node::Constant(bits), shape))
                }
                Some((Node::Cast(a), _)) => {
                    let a = *a;
                    Some(self.node(Node::Cast(a), shape))
                }
                _ => None,
            },
            _ => None,
        }
    }

    /// A signal; its node is what reads it.
    pub(super) fn signal(&mut self, signal: Signal, scopes: Vec<String>) -> usize {
        self.signals.push(signal);
        self.scopes.push(scopes);
        self.signals.len() - 1
    }
}

/// The name that stands for scopes that are no instances, and a name below them.
pub(super) fn flat(scopes: &[String], name: &str) -> String {
    scopes
        .iter()
        .map(|scope| format!("{scope}_"))
        .chain([name.to_owned()])
        .collect()
}

/// A signal without what drives it.
pub(super) fn signal(name: String, field: &'static Field, shape: Shape) -> Signal {
    Signal {
        name,
        field,
        role: crate::kernel::Role::Net,
        shape,
        power_on: 0,
        driver: None,
        owner: None,
    }
}
