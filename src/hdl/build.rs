//! The module that is being made, and how nodes get into it.

use super::mistake::{Mistake, Wrong};
use super::record::{BIT, MemoryShape, Site};
use crate::hdl::netlist::{
    Assertion, Child, Memory, Module, Node, Operator, Parameter, Port, Register, Setting, Signal,
};
use crate::hdl::{Kind, Role, Shape};
use rustc_hash::{FxHashMap, FxHashSet};
use std::cell::RefCell;
use std::mem;
use std::panic::Location;

pub use crate::hdl::netlist::Id;

/// Everything that is being made: a circuit makes the modules inside it on its way.
#[derive(Default)]
pub(super) struct Elaboration {
    /// The circuits whose `tick` is running, outermost first.
    pub open: Vec<Builder>,
    pub modules: Vec<Module>,
    pub mistakes: Vec<Mistake>,
}

thread_local! {
    static ELABORATION: RefCell<Elaboration> = RefCell::default();
}

/// One module being made.
#[derive(Default)]
pub(super) struct Builder {
    /// The names of the circuit and of the instances around it.
    pub path: String,
    /// Where the circuit's records are declared.
    pub site: Option<Site>,
    pub nodes: Vec<(Node, Shape)>,
    /// Where each was made.
    pub sites: Vec<Site>,
    pub known: FxHashMap<(Node, Shape), Id>,
    pub signals: Vec<Signal>,
    /// Parameters and their values.
    pub parameters: Vec<(Parameter, u64)>,
    pub memories: Vec<Memory>,
    pub shapes: Vec<MemoryShape>,
    /// For every memory that belongs to an instance, the instance and the memory there.
    pub owners: Vec<Option<(usize, usize)>>,
    /// What each memory holds.
    pub contents: Vec<Vec<u64>>,
    pub registers: Vec<Register>,
    /// How many of the registers are the circuit's own; they come first.
    pub own: usize,
    /// The scope that was entered last, while parts are declared.
    pub scope: String,
    /// Registers that come into being are those of a part.
    pub of_part: bool,
    /// A port in, register or memory of its own cannot be made.
    pub unmade: bool,
    pub parts: Vec<Declared>,
    pub instances: Vec<Instance>,
    pub assertions: Vec<Assertion>,
    /// ROMs, by memory.
    pub roms: Vec<usize>,
}

/// A circuit inside the one that is being made.
pub(super) struct Declared {
    pub name: String,
    /// Its place in the walk over the registers.
    pub registers: std::ops::Range<usize>,
    /// The instance, once it is settled.
    pub instance: Option<usize>,
}

/// An instance.
pub(super) struct Instance {
    pub child: Child,
    pub settings: Vec<Setting>,
    /// The nodes of its nets here.
    pub ports: Vec<Id>,
    pub site: Site,
}

/// Works on what is being made.
pub(super) fn elaboration<R>(work: impl FnOnce(&mut Elaboration) -> R) -> R {
    ELABORATION.with(|elaboration| work(&mut elaboration.borrow_mut()))
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

/// Something is wrong with the circuit that is being made.
#[inline(never)]
pub(super) fn mistake(site: Site, what: String) {
    elaboration(|elaboration| {
        let path = elaboration.open.last().map(|builder| builder.path.clone());
        elaboration.mistakes.push(Mistake {
            site,
            path: path.unwrap_or_default(),
            what,
        });
    });
}

/// All that is wrong, in the order in which it was found, each once.
pub(super) fn wrong(mut mistakes: Vec<Mistake>) -> Result<(), Wrong> {
    let mut seen = FxHashSet::default();
    mistakes.retain(|mistake| seen.insert(mistake.clone()));
    match mistakes.is_empty() {
        true => Ok(()),
        false => Err(Wrong(mistakes)),
    }
}

/// Where a function was called.
#[track_caller]
pub(super) fn here() -> Site {
    Site::from(Location::caller())
}

impl From<&'static Location<'static>> for Site {
    fn from(at: &'static Location<'static>) -> Self {
        Site {
            file: at.file(),
            line: at.line(),
            column: at.column(),
        }
    }
}

/// The node that computes this: one that is there already, or a new one.
#[inline(never)]
#[track_caller]
pub(super) fn node(node: Node, shape: Shape) -> Id {
    let site = here();
    builder(|builder| builder.node(node, shape, site))
}

/// A constant, taken modulo 2^width.
#[inline(never)]
#[track_caller]
pub(super) fn constant(value: u64, shape: Shape) -> Id {
    let shape = word(shape, "a constant");
    node(Node::Constant(masked(value, shape)), shape)
}

/// A number as a word of its own; one that does not fit is a mistake.
#[inline(never)]
#[track_caller]
pub(super) fn number(value: i128, shape: Shape) -> Id {
    let shape = word(shape, "a constant");
    if let Err(wrong) = fits(value, shape) {
        mistake(here(), format!("the constant {wrong}"));
    }
    constant(value as u64, shape)
}

/// A number beside a word, as wide as that; one that does not fit is a mistake.
#[inline(never)]
#[track_caller]
pub(super) fn number_beside(value: i128, beside: Id) -> Id {
    let shape = shape(beside);
    if let Err(wrong) = fits(value, shape) {
        let name = builder(|builder| builder.describe(beside));
        mistake(here(), format!("beside {name}, the constant {wrong}"));
    }
    constant(value as u64, shape)
}

/// Checks that a word can hold a number.
pub(super) fn fits(value: i128, shape: Shape) -> Result<(), String> {
    let (least, greatest) = shape.range();
    match (least..=greatest).contains(&value) {
        true => Ok(()),
        false => Err(format!(
            "{value} does not fit {}; allowed are {least} to {greatest}",
            bits(shape.width)
        )),
    }
}

/// A shape that a word can have; one that it cannot have is a mistake.
#[inline(never)]
#[track_caller]
pub(super) fn word(shape: Shape, what: &str) -> Shape {
    match is_word(shape) {
        Ok(()) => shape,
        Err(wrong) => {
            mistake(here(), format!("{what} {wrong}"));
            nearest(shape)
        }
    }
}

/// Whether a word can have that shape, or what is wrong with it.
pub(super) fn is_word(shape: Shape) -> Result<(), String> {
    match shape.width {
        1..=64 => Ok(()),
        width => Err(format!("has {}; a word has 1 to 64", bits(width))),
    }
}

/// The shape next to it that a word can have.
pub(super) fn nearest(shape: Shape) -> Shape {
    Shape {
        width: shape.width.clamp(1, 64),
        ..shape
    }
}

/// Kind and width of a node.
#[inline(never)]
pub(super) fn shape(id: Id) -> Shape {
    builder(|builder| builder.shape(id))
}

/// Words and width of a memory.
#[inline(never)]
pub(super) fn memory_shape(memory: usize) -> MemoryShape {
    builder(|builder| {
        builder.shapes.get(memory).copied().unwrap_or(MemoryShape {
            words: 1,
            width: 1,
            address: None,
        })
    })
}

/// The node where it has the width that is wanted; otherwise that is a mistake, and it is cut or
/// extended.
#[inline(never)]
#[track_caller]
pub(super) fn fit(id: Id, wanted: Shape, what: &str) -> Id {
    let found = shape(id);
    if found.width == wanted.width {
        return id;
    }
    let name = builder(|builder| builder.describe(id));
    let (found, wanted_bits) = (bits(found.width), bits(wanted.width));
    mistake(
        here(),
        format!("{what} has {wanted_bits}, {name} has {found}"),
    );
    resize(id, wanted)
}

/// So many bits, in words.
pub(super) fn bits(width: usize) -> String {
    match width {
        1 => "1 bit".to_owned(),
        width => format!("{width} bits"),
    }
}

/// Extended or cut to another width.
#[inline(never)]
#[track_caller]
pub(super) fn resize(of: Id, to: Shape) -> Id {
    match shape(of).width {
        width if width < to.width => node(Node::Extend(of), to),
        width if width > to.width => node(Node::Slice(of, 0), to),
        _ => node(Node::Cast(of), to),
    }
}

/// A parameter: the one of that name, or a new one.
#[inline(never)]
#[track_caller]
pub(super) fn parameter(name: &'static str, value: u64, shape: Shape) -> Id {
    let shape = word(shape, name);
    if let Err(wrong) = fits(value.into(), shape) {
        mistake(here(), format!("parameter `{name}`: {wrong}"));
    }
    let width = shape.width;
    let index = builder(|builder| {
        let same = |(known, _): &(Parameter, u64)| known.name == name && known.width == shape.width;
        let known = builder.parameters.iter().position(same);
        known.unwrap_or_else(|| {
            let value = masked(value, shape);
            builder.parameters.push((Parameter { name, width }, value));
            builder.parameters.len() - 1
        })
    });
    node(Node::Parameter(index), shape)
}

/// The ROM with these words.
pub(super) fn rom(width: usize, words: Vec<u64>) -> usize {
    builder(|builder| {
        let same = |&&memory: &&usize| {
            builder.contents[memory] == words && builder.memories[memory].width == width
        };
        if let Some(memory) = builder.roms.iter().find(same) {
            return *memory;
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
        builder.shapes.push(MemoryShape {
            words: words.len(),
            width,
            address: None,
        });
        builder.contents.push(words);
        let memory = builder.memories.len() - 1;
        builder.roms.push(memory);
        memory
    })
}

pub(super) fn masked(value: u64, shape: Shape) -> u64 {
    value & (u64::MAX >> (64 - shape.width.clamp(1, 64)))
}

/// The scopes that are no instances, and a name below them.
pub(super) fn flat(scopes: &[String], name: &str) -> String {
    scopes
        .iter()
        .map(|scope| format!("{scope}_"))
        .chain([name.to_owned()])
        .collect()
}

impl Builder {
    pub fn shape(&self, id: Id) -> Shape {
        self.nodes.get(id).map_or(BIT, |(_, shape)| *shape)
    }

    /// A node by name where it has one, as a reader of the circuit would call it.
    pub fn describe(&self, id: Id) -> String {
        match self.nodes.get(id).map(|(node, _)| *node) {
            Some(Node::Signal(signal)) => match self.signals.get(signal) {
                Some(signal) => format!("`{}`", signal.name),
                None => "a register".to_owned(),
            },
            Some(Node::Constant(value)) => format!("the constant {value}"),
            Some(Node::Parameter(index)) => match self.parameters.get(index) {
                Some((parameter, _)) => format!("`{}`", parameter.name),
                None => "a parameter".to_owned(),
            },
            Some(Node::Port { instance, .. }) => match self.instances.get(instance) {
                Some(instance) => format!("a port of `{}`", instance.child.name),
                None => "a port".to_owned(),
            },
            Some(Node::Binary(operator, ..)) => match operator {
                Operator::Add => "a sum",
                Operator::Subtract => "a difference",
                Operator::Multiply => "a product",
                Operator::And | Operator::Or | Operator::Xor => "a bitwise operation",
                Operator::Equal | Operator::Below => "a comparison",
            }
            .to_owned(),
            Some(Node::Mux(..)) => "a choice".to_owned(),
            Some(Node::Read(memory, _)) => match self.memories.get(memory) {
                Some(memory) => format!("a word of `{}`", memory.name),
                None => "a word".to_owned(),
            },
            _ => "an operand".to_owned(),
        }
    }

    /// The name of a memory.
    pub fn memory_name(&self, memory: usize) -> &str {
        self.memories.get(memory).map_or("", |memory| &memory.name)
    }

    fn bits(&self, id: Id) -> Option<u64> {
        match self.nodes.get(id) {
            Some((Node::Constant(bits), _)) => Some(*bits),
            _ => None,
        }
    }

    pub fn node(&mut self, node: Node, shape: Shape, site: Site) -> Id {
        if let Some(simpler) = self.simpler(node, shape, site) {
            return simpler;
        }
        let (nodes, sites) = (&mut self.nodes, &mut self.sites);
        *self.known.entry((node, shape)).or_insert_with(|| {
            nodes.push((node, shape));
            sites.push(site);
            nodes.len() - 1
        })
    }

    /// What is written more simply: choices between the same, operations with constant bits,
    /// conversions that change nothing, conversions of constants.
    fn simpler(&mut self, node: Node, shape: Shape, site: Site) -> Option<Id> {
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
                    Some(self.node(Node::Constant(inverted), shape, site))
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
                    (Operator::And, 0) => Some(self.node(Node::Constant(0), BIT, site)),
                    (Operator::Or, 1) => Some(self.node(Node::Constant(1), BIT, site)),
                    (Operator::And, _) | (Operator::Or | Operator::Xor, 0) => Some(other),
                    (Operator::Xor, _) => Some(self.node(Node::Not(other), BIT, site)),
                    _ => None,
                }
            }
            Node::ShiftLeft(a, 0) | Node::ShiftRight(a, 0) => Some(a),
            Node::Slice(a, low) => match self.bits(a) {
                Some(bits) => {
                    let bits = masked(bits >> low, shape);
                    Some(self.node(Node::Constant(bits), shape, site))
                }
                None if self.shape(a).width == shape.width => {
                    Some(self.node(Node::Cast(a), shape, site))
                }
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
                let extended = masked(extended, shape);
                Some(self.node(Node::Constant(extended), shape, site))
            }
            Node::Cast(a) => match self.nodes.get(a) {
                _ if self.shape(a) == shape => Some(a),
                Some((Node::Constant(bits), _)) => {
                    let bits = *bits;
                    Some(self.node(Node::Constant(bits), shape, site))
                }
                Some((Node::Cast(a), _)) => {
                    let a = *a;
                    Some(self.node(Node::Cast(a), shape, site))
                }
                _ => None,
            },
            _ => None,
        }
    }

    /// Where the circuit is declared.
    pub fn site(&self) -> Site {
        self.site.unwrap_or(Site {
            file: "",
            line: 0,
            column: 0,
        })
    }

    /// Where a node was made; an input or register, where its circuit is declared.
    pub fn site_of(&self, id: Id) -> Site {
        match self.nodes.get(id) {
            Some((Node::Signal(_) | Node::Port { .. }, _)) | None => self.site(),
            Some(_) => self.sites[id],
        }
    }

    /// Adds a signal.
    pub fn signal(&mut self, signal: Signal) -> usize {
        self.signals.push(signal);
        self.signals.len() - 1
    }
}

/// A signal without what drives it.
pub(super) fn signal(
    name: String,
    field: &'static crate::hdl::Field,
    role: Role,
    shape: Shape,
) -> Signal {
    Signal {
        name,
        field,
        role,
        shape,
        power_on: 0,
        driver: None,
        owner: None,
    }
}

/// Something under way, put aside for another: a thread may be in the middle of an elaboration.
pub(super) struct Aside(Option<Elaboration>);

impl Aside {
    pub fn begin() -> Self {
        Aside(Some(elaboration(mem::take)))
    }

    /// What was made meanwhile.
    pub fn end(mut self) -> Elaboration {
        let outer = self.0.take().unwrap_or_default();
        elaboration(|elaboration| mem::replace(elaboration, outer))
    }
}

impl Drop for Aside {
    // Where a circuit's own code panics, nothing of it stays behind.
    fn drop(&mut self) {
        if let Some(outer) = self.0.take() {
            elaboration(|elaboration| *elaboration = outer);
        }
    }
}
