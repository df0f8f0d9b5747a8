//! The module under construction, and the functions that add nodes to it.

use super::describe::describe;
use super::record::MemoryShape;
use crate::netlist::{
    Assertion, BIT, Child, Kind, Memory, Mistake, Module, Node, Operator, Parameter, Port,
    Register, Role, Setting, Shape, Signal, Site, Wrong,
};
use rustc_hash::{FxHashMap, FxHashSet};
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::mem;
use std::panic::Location;

pub use crate::netlist::Id;

/// All modules under construction: a circuit builds the modules inside it while its `tick` runs.
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

/// Module under construction.
#[derive(Default)]
pub(super) struct Builder {
    /// Instance path of the circuit, joined by dots.
    pub path: String,
    /// Declaration site of the circuit's records.
    pub site: Option<Site>,
    pub nodes: Vec<(Node, Shape)>,
    /// Source location that created each node.
    pub sites: Vec<Site>,
    pub known: FxHashMap<(Node, Shape), Id>,
    pub signals: Vec<Signal>,
    /// Parameters with their values.
    pub parameters: Vec<(Parameter, u64)>,
    pub memories: Vec<Memory>,
    pub shapes: Vec<MemoryShape>,
    /// Owner of each memory that belongs to an instance: the instance, and the memory inside it.
    pub owners: Vec<Option<(usize, usize)>>,
    /// Power-on contents of each memory.
    pub contents: Vec<Vec<u64>>,
    pub registers: Vec<Register>,
    /// Number of the circuit's own registers; they come first.
    pub own: usize,
    /// Scope entered last, while parts are declared.
    pub scope: String,
    /// True while the registers being declared belong to a part.
    pub of_part: bool,
    /// True if one of the circuit's own input ports, registers or memories has an impossible
    /// shape.
    pub unmade: bool,
    pub parts: Vec<Declared>,
    pub instances: Vec<Instance>,
    pub assertions: Vec<Assertion>,
    /// Number of nodes before those that only properties read.
    pub logic: usize,
    /// Indices of the ROMs among the memories.
    pub roms: Vec<usize>,
    /// Parts that mistakes name, by index.
    pub involved: BTreeSet<usize>,
    /// Nodes that a helper made: a description of the result, and the helper's operand.
    pub helpers: FxHashMap<Id, (&'static str, Id)>,
}

/// Declared part of the circuit under construction.
pub(super) struct Declared {
    pub name: String,
    /// Range of the part's leaves in the walk over the registers.
    pub registers: std::ops::Range<usize>,
    /// Index of the instance, once the part is settled.
    pub instance: Option<usize>,
    /// Prints the circuit with its fields.
    pub circuit: Box<dyn Fn() -> String>,
}

/// Settled part.
pub(super) struct Instance {
    pub child: Child,
    pub settings: Vec<Setting>,
    /// Nodes that carry the instance's nets in this module.
    pub ports: Vec<Id>,
    pub site: Site,
}

/// Runs `work` on the modules under construction of this thread.
pub(super) fn elaboration<R>(work: impl FnOnce(&mut Elaboration) -> R) -> R {
    ELABORATION.with(|elaboration| work(&mut elaboration.borrow_mut()))
}

/// Runs `work` on the module under construction. Words made outside any circuit go to a module
/// that is thrown away.
pub(super) fn builder<R>(work: impl FnOnce(&mut Builder) -> R) -> R {
    elaboration(|elaboration| {
        if elaboration.open.is_empty() {
            elaboration.open.push(Builder::default());
        }
        let last = elaboration.open.len() - 1;
        work(&mut elaboration.open[last])
    })
}

/// Records a mistake in the module under construction.
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

/// Returns an error with all mistakes in the order they were found, without duplicates.
pub(super) fn wrong(mut mistakes: Vec<Mistake>) -> Result<(), Wrong> {
    let mut seen = FxHashSet::default();
    mistakes.retain(|mistake| seen.insert(mistake.clone()));
    match mistakes.is_empty() {
        true => Ok(()),
        false => Err(Wrong(mistakes)),
    }
}

/// Returns the source location of the caller.
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

/// Returns the node that computes this: an existing one, or a new one.
#[inline(never)]
#[track_caller]
pub(super) fn node(node: Node, shape: Shape) -> Id {
    let site = here();
    builder(|builder| builder.node(node, shape, site))
}

/// Returns a constant, taken modulo 2^width.
#[inline(never)]
#[track_caller]
pub(super) fn constant(value: u64, shape: Shape) -> Id {
    let shape = word(shape, "a constant");
    node(Node::Constant(masked(value, shape)), shape)
}

/// Returns a number as a constant of its own shape. A number that does not fit is a mistake.
#[inline(never)]
#[track_caller]
pub(super) fn number(value: i128, shape: Shape) -> Id {
    let shape = word(shape, "a constant");
    if let Err(wrong) = fits(value, shape) {
        mistake(here(), format!("the constant {wrong}"));
    }
    constant(value as u64, shape)
}

/// Returns a number as a constant of the shape of `beside`. A number that does not fit is a
/// mistake.
#[inline(never)]
#[track_caller]
pub(super) fn number_beside(value: i128, beside: Id) -> Id {
    let shape = shape(beside);
    if let Err(wrong) = fits(value, shape) {
        let name = describe(beside);
        mistake(here(), format!("beside {name}, the constant {wrong}"));
    }
    constant(value as u64, shape)
}

/// Returns an error if a word of this shape cannot hold the number.
pub(super) fn fits(value: i128, shape: Shape) -> Result<(), String> {
    let (least, greatest) = shape.range();
    match (least..=greatest).contains(&value) {
        true => Ok(()),
        false => Err(format!(
            "{value} does not fit {}: {least} to {greatest}",
            bits(shape.width)
        )),
    }
}

/// Returns the shape if a word can have it. Otherwise records a mistake and returns the nearest
/// one.
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

/// Returns an error if no word can have this shape.
pub(super) fn is_word(shape: Shape) -> Result<(), String> {
    match shape.width {
        1..=64 => Ok(()),
        width => Err(format!("has {}; a word has 1 to 64", bits(width))),
    }
}

/// Returns the nearest shape that a word can have.
pub(super) fn nearest(shape: Shape) -> Shape {
    Shape {
        width: shape.width.clamp(1, 64),
        ..shape
    }
}

/// Returns kind and width of a node.
#[inline(never)]
pub(super) fn shape(id: Id) -> Shape {
    builder(|builder| builder.shape(id))
}

/// Returns number of words and width of a memory.
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

/// Returns the node if it has the wanted width. Otherwise records a mistake, and cuts or extends
/// the node.
#[inline(never)]
#[track_caller]
pub(super) fn fit(id: Id, wanted: Shape, what: &str) -> Id {
    let found = shape(id);
    if found.width == wanted.width {
        return id;
    }
    let name = describe(id);
    let (found, wanted_bits) = (bits(found.width), bits(wanted.width));
    mistake(
        here(),
        format!("{what} has {wanted_bits}, {name} has {found}"),
    );
    resize(id, wanted)
}

/// Formats a number of bits with its unit.
pub(super) fn bits(width: usize) -> String {
    match width {
        1 => "1 bit".to_owned(),
        width => format!("{width} bits"),
    }
}

/// Extends or cuts a node to another width.
#[inline(never)]
#[track_caller]
pub(super) fn resize(of: Id, to: Shape) -> Id {
    match shape(of).width {
        width if width < to.width => node(Node::Extend(of), to),
        width if width > to.width => node(Node::Slice(of, 0), to),
        _ => node(Node::Cast(of), to),
    }
}

/// Returns the parameter of that name, or adds it.
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

/// Returns the result of a helper, which mistakes call `what` of `operand`, or as the operand if
/// `what` is empty.
pub(super) fn called(id: Id, what: &'static str, operand: Id) -> Id {
    builder(|builder| {
        builder.helpers.entry(id).or_insert((what, operand));
    });
    id
}

/// Returns the ROM with these words, or adds it.
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

/// Joins scopes and the name below them by dots, as in the waves.
pub(super) fn dotted(scopes: &[String], name: &str) -> String {
    let scopes = scopes.iter().map(|scope| format!("{scope}."));
    scopes.chain([name.to_owned()]).collect()
}

/// Joins the scopes that are no instances with the name below them.
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

    /// Returns the name of a memory.
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

    /// Returns a simpler node, if there is one: for choices between equal words, operations with
    /// constant bits, conversions without effect, conversions of constants.
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

    /// Returns the location of the circuit's declaration.
    pub fn site(&self) -> Site {
        self.site.unwrap_or(Site {
            file: "",
            line: 0,
            column: 0,
        })
    }

    /// Returns the location of a node. For an input or register, that is its circuit's
    /// declaration.
    pub fn site_of(&self, id: Id) -> Site {
        match self.nodes.get(id) {
            Some((Node::Signal(_) | Node::Port { .. }, _)) | None => self.site(),
            Some(_) => self.sites[id],
        }
    }

    /// Adds a signal and returns its index.
    pub fn signal(&mut self, signal: Signal) -> usize {
        self.signals.push(signal);
        self.signals.len() - 1
    }
}

/// Returns a signal without a driver, by its names in Verilog and in the waves.
pub(super) fn signal(
    (name, path): (String, String),
    field: &'static crate::netlist::Field,
    role: Role,
    shape: Shape,
) -> Signal {
    Signal {
        name,
        path,
        field,
        role,
        shape,
        power_on: 0,
        driver: None,
        owner: None,
    }
}

/// Elaboration that is set aside while another one runs on the same thread.
pub(super) struct Aside(Option<Elaboration>);

impl Aside {
    pub fn begin() -> Self {
        Aside(Some(elaboration(mem::take)))
    }

    /// Restores the outer elaboration and returns the inner one.
    pub fn end(mut self) -> Elaboration {
        let outer = self.0.take().unwrap_or_default();
        elaboration(|elaboration| mem::replace(elaboration, outer))
    }
}

impl Drop for Aside {
    // If a circuit's own code panics, its modules are dropped.
    fn drop(&mut self) {
        if let Some(outer) = self.0.take() {
            elaboration(|elaboration| *elaboration = outer);
        }
    }
}
