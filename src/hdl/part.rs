//! Circuits inside a circuit.

use super::Path;
use super::build::{self, Declared, Instance, builder, elaboration, here, node};
use super::describe::describe;
use super::leaves::Nodes;
use super::record::{Pass, Record, Sink, Source, Walk};
use super::view::{self, Open, Seen, Shapes, Wire};
use super::{Circuit, Written};
use crate::netlist::{Child, Field, Node, Register, Role, Setting, Shape};
use std::fmt;

/// Circuit inside another, before it is settled; its registers are already readable.
pub struct Part<C: Circuit> {
    circuit: C,
    /// Index among the parts.
    part: usize,
    /// Registers in this tick.
    pub q: C::Reg<Seen>,
}

/// Circuit inside another, settled.
pub struct Settled<C: Circuit> {
    /// Drivers of its input ports.
    pub i: C::In<Wire>,
    /// Registers in this tick.
    pub q: C::Reg<Seen>,
    /// Nets.
    pub w: C::Net<Wire>,
}

/// Circuit inside another, in [properties](super::Moment).
pub struct Opened<C: Circuit> {
    /// Drivers of its input ports.
    pub i: C::In<Wire>,
    /// Registers.
    pub q: C::Reg<Open>,
    /// Nets.
    pub w: C::Net<Wire>,
    /// Circuits inside.
    pub p: C::Parts<Open>,
}

impl<C: Circuit> Part<C> {
    /// Declares the registers of the part and of the circuits inside it.
    pub(super) fn declare(circuit: &C, field: &'static Field, source: &mut dyn Source) -> Self {
        source.enter(field);
        let first = begin();
        source.pass(Pass::Registers);
        let q = C::Reg::make(circuit, view::role(Role::Register), source);
        if circuit.objection().is_none() {
            C::Parts::<Shapes>::make(circuit, view::role(Role::Register), source);
        }
        let shown = circuit.clone();
        let part = declared(first, Box::new(move || format!("{shown:?}")));
        source.leave();
        Part {
            circuit: circuit.clone(),
            part,
            q,
        }
    }

    /// Connects the input ports and settles the nets. Takes the part by value, so that it settles
    /// once.
    #[track_caller]
    pub fn settle(self, i: C::In<Wire>) -> Settled<C> {
        let site = here();
        let inputs = drive::<C>(&self.circuit, &i, site, self.part);
        let made = self.circuit.make_module(path(self.part), &mut |_| {});
        let nets = instance(self.part, made, inputs, site);
        let w = C::Net::make(
            &self.circuit,
            view::role(Role::Net),
            &mut Nodes(nets.iter()),
        );
        Settled { i, q: self.q, w }
    }
}

// Code that does not depend on the circuit's type is compiled once.

/// Begins the registers of a part; returns their first leaf in the walk.
#[inline(never)]
fn begin() -> usize {
    builder(|builder| {
        builder.of_part = true;
        builder.registers.len()
    })
}

/// Ends the registers of a part that begin at `first`; returns its index.
#[inline(never)]
fn declared(first: usize, circuit: Box<dyn Fn() -> String>) -> usize {
    builder(|builder| {
        builder.of_part = false;
        builder.parts.push(Declared {
            // The source knows the scopes; see `Leaves`.
            name: std::mem::take(&mut builder.scope),
            registers: first..builder.registers.len(),
            instance: None,
            circuit,
        });
        builder.parts.len() - 1
    })
}

/// Returns the instance path of a part.
#[inline(never)]
fn path(part: usize) -> String {
    builder(|builder| format!("{}.{}", builder.path, builder.parts[part].name))
}

/// Makes a part an instance of its module; returns the nodes of its own nets.
#[inline(never)]
fn instance(
    part: usize,
    (module, settings): (usize, Vec<Setting>),
    inputs: Vec<build::Id>,
    site: crate::netlist::Site,
) -> Vec<build::Id> {
    let (leaves, own) = elaboration(|elaboration| {
        let module = &elaboration.modules[module];
        (module.net_leaves(), module.own_nets(&elaboration.modules))
    });
    let instance = builder(|builder| builder.instances.len());
    let mut ports: Vec<_> = (0..leaves)
        .map(|leaf| {
            let shape = elaboration(|elaboration| elaboration.modules[module].net_shape(leaf));
            node(Node::Port { instance, leaf }, shape)
        })
        .collect();
    elaboration(|elaboration| {
        let Some(builder) = elaboration.open.last_mut() else {
            return;
        };
        let declared = &mut builder.parts[part];
        declared.instance = Some(instance);
        let (name, registers) = (declared.name.clone(), declared.registers.clone());
        let inside: Vec<Register> = elaboration.modules[module].register_leaves().collect();
        builder.claim(instance, registers, &inside);
        builder.instances.push(Instance {
            child: Child {
                name,
                module,
                inputs,
            },
            settings,
            ports: ports.clone(),
            site,
        });
    });
    ports.split_off(leaves - own)
}

/// Settles several parts; `drive` returns the input ports of a part by its index.
#[track_caller]
pub fn settle_each<C: Circuit>(
    parts: Vec<Part<C>>,
    mut drive: impl FnMut(usize) -> C::In<Wire>,
) -> Vec<Settled<C>> {
    let mut settled = Vec::with_capacity(parts.len());
    for (index, part) in parts.into_iter().enumerate() {
        settled.push(part.settle(drive(index)));
    }
    settled
}

/// Returns the nodes that drive the input ports, each as wide as its port.
fn drive<C: Circuit>(
    circuit: &C,
    i: &C::In<Wire>,
    site: crate::netlist::Site,
    part: usize,
) -> Vec<build::Id> {
    let mut wanted = Counted::default();
    circuit.make_shapes(Role::Input, &mut wanted);
    let mut given = Counted::default();
    i.visit(view::role(Role::Input), &mut given);
    pair(&given, &wanted, site, Place::Port(part))
}

/// Record whose leaves are given nodes.
#[derive(Clone, Copy)]
pub(super) enum Place {
    Net,
    Register,
    /// Input ports of a part, by its index.
    Port(usize),
}

/// Returns the nodes of the leaves of a record, each as wide as declared.
pub(super) fn pair(
    given: &Counted,
    wanted: &Counted,
    site: crate::netlist::Site,
    place: Place,
) -> Vec<build::Id> {
    let (what, scope) = match place {
        Place::Net => ("net", String::new()),
        Place::Register => ("register", String::new()),
        Place::Port(part) => builder(|builder| ("port", format!("{}.", builder.parts[part].name))),
    };
    if given.leaves.len() != wanted.leaves.len() {
        let names = |leaves: &Counted| {
            let mut names: Vec<_> = leaves.leaves.iter().map(|leaf| leaf.path.clone()).collect();
            names.reverse();
            names
        };
        let (mut found, mut asked) = (names(given), names(wanted));
        while !found.is_empty() && found.last() == asked.last() {
            found.pop();
            asked.pop();
        }
        let what = match (found.pop(), asked.pop()) {
            (Some(found), None) => format!("{what} `{scope}{found}` is not there"),
            (_, Some(asked)) => format!("{what} `{scope}{asked}` is given nothing"),
            (None, None) => format!("{what}s do not match"),
        };
        build::mistake(site, what);
        return wanted.low();
    }
    let pairs = given.leaves.iter().zip(&wanted.leaves);
    pairs
        .map(|(given, wanted)| {
            let id = given.token as build::Id;
            let found = build::shape(id);
            if found.width == wanted.shape.width || build::is_word(wanted.shape).is_err() {
                return id;
            }
            let from = describe(id);
            let site = match place {
                Place::Port(part) => {
                    builder(|builder| builder.involved.insert(part));
                    site
                }
                Place::Net | Place::Register => builder(|builder| builder.site_of(id)),
            };
            let (wanted_bits, found) = (build::bits(wanted.shape.width), build::bits(found.width));
            build::mistake(
                site,
                format!(
                    "{what} `{scope}{}` has {wanted_bits}, {from} has {found}",
                    wanted.path
                ),
            );
            build::resize(id, wanted.shape)
        })
        .collect()
}

/// Leaves of a record by name.
#[derive(Default)]
pub(crate) struct Counted {
    path: Path,
    pub leaves: Vec<Leaf>,
    pub memories: Vec<(String, Written)>,
}

pub(crate) struct Leaf {
    pub name: String,
    /// Name in the waves.
    pub path: String,
    pub field: &'static Field,
    pub shape: Shape,
    pub token: u64,
}

impl Counted {
    /// Returns the names of the next leaf in its module and in the waves of its circuit.
    fn names(&mut self, field: &'static Field) -> (String, String) {
        let name = self.path.name(field);
        let scopes = self.path.scopes();
        (build::flat(scopes, &name), build::dotted(scopes, &name))
    }

    fn push(&mut self, field: &'static Field, shape: Shape, token: u64) {
        let (name, path) = self.names(field);
        self.leaves.push(Leaf {
            name,
            path,
            field,
            shape,
            token,
        });
    }

    /// Returns one low word per leaf.
    pub(super) fn low(&self) -> Vec<build::Id> {
        let leaves = self.leaves.iter();
        let low = leaves.map(|leaf| build::constant(0, build::nearest(leaf.shape)));
        low.collect()
    }
}

impl Source for Counted {
    fn enter(&mut self, field: &'static Field) {
        self.path.enter(field);
    }
    fn leave(&mut self) {
        self.path.leave();
    }
    fn element(&mut self, index: usize) {
        self.path.element(index);
    }
    fn word(&mut self, field: &'static Field, shape: Shape, _: i128) -> u64 {
        self.push(field, shape, 0);
        0
    }
    fn memory(
        &mut self,
        field: &'static Field,
        _: &'static Field,
        shape: super::MemoryShape,
        _: &dyn Fn() -> super::Contents,
    ) -> super::Cells {
        let (_, path) = self.names(field);
        self.memories.push((path, Written::default()));
        super::Cells::at(0, shape)
    }
}

impl Sink for Counted {
    fn enter(&mut self, field: &'static Field) {
        self.path.enter(field);
    }
    fn leave(&mut self) {
        self.path.leave();
    }
    fn element(&mut self, index: usize) {
        self.path.element(index);
    }
    fn word(&mut self, field: &'static Field, token: u64) {
        self.push(field, crate::netlist::BIT, token);
    }
    fn memory(&mut self, field: &'static Field, written: Written) {
        let (_, path) = self.names(field);
        self.memories.push((path, written));
    }
}

impl<C: Circuit> fmt::Debug for Part<C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct(self.circuit.name())
            .field("circuit", &self.circuit)
            .finish_non_exhaustive()
    }
}

impl<C: Circuit> fmt::Debug for Opened<C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct(C::NAME).finish_non_exhaustive()
    }
}

impl<C: Circuit> fmt::Debug for Settled<C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct(C::NAME).finish_non_exhaustive()
    }
}
