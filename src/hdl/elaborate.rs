//! Runs a circuit's `tick` once and notes what it computes. Circuits inside it become modules of
//! their own.

use super::Circuit;
use super::build::{
    self, Aside, Builder, builder, elaboration, flat, masked, mistake, node, signal,
};
use super::memory::{Contents, State, Written};
use super::mistake::Wrong;
use super::part::{Counted, pair};
use super::property;
use super::record::{Cells, MemoryShape, Pass, Record, Site, Source, Walk};
use super::view::{self, Edge, Shapes, Wire};
use crate::hdl::netlist::{Design, Id, Memory, Module, Node, Port, Register, Setting, Value};
use crate::hdl::{Field, Path, Role, Shape};
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

/// The netlist of a circuit and of those inside it, with its power-on values.
///
/// # Errors
/// All that is wrong with it, each with file, line and column.
pub fn elaborate<C: Circuit>(circuit: &C) -> Result<Design, Wrong> {
    with_inputs(circuit, &mut |_| {})
}

/// The same with ports in of the whole that it does not look at.
pub(crate) fn with_inputs<C: Circuit>(
    circuit: &C,
    more: &mut dyn FnMut(&mut dyn Source),
) -> Result<Design, Wrong> {
    whole(&mut || module_with(circuit, circuit.name().to_owned(), more))
}

// What does not depend on the circuit's type is not made for each.

/// Makes the module of a whole circuit.
fn whole(make: &mut dyn FnMut() -> (usize, Vec<Setting>)) -> Result<Design, Wrong> {
    let aside = Aside::begin();
    let settings = match catch_unwind(AssertUnwindSafe(make)) {
        Ok((_, settings)) => settings,
        Err(panic) => {
            // The circuit's own arithmetic on widths, say.
            let what = panic.downcast_ref::<String>().cloned();
            let what = what.or_else(|| panic.downcast_ref::<&str>().map(|&what| what.to_owned()));
            let what = what.unwrap_or_else(|| "for no reason given".to_owned());
            let site = builder(|builder| builder.site());
            mistake(site, format!("its code panics: {what}"));
            Vec::new()
        }
    };
    let made = aside.end();
    build::wrong(made.mistakes)?;
    let mut settings = settings;
    settings.retain(|setting| match setting.value {
        Value::Number(_) => true,
        Value::Words(_) => is_filled(&made.modules, &setting.path),
    });
    Ok(Design {
        modules: made.modules,
        settings,
    })
}

/// Makes the module of a circuit; returns its number and its settings.
pub(super) fn module<C: Circuit>(circuit: &C, path: String) -> (usize, Vec<Setting>) {
    module_with(circuit, path, &mut |_| {})
}

fn module_with<C: Circuit>(
    circuit: &C,
    path: String,
    more: &mut dyn FnMut(&mut dyn Source),
) -> (usize, Vec<Setting>) {
    let site = <C::In<Wire> as Walk<Wire>>::SITE;
    begin(path, site);
    let nets = match circuit.objection() {
        Some(what) => {
            mistake(site, what);
            Nets::default()
        }
        None => signals_of(circuit, site, more),
    };
    end(circuit.name(), circuit.about(), nets)
}

/// A module begins, inside the one that is being made.
#[inline(never)]
fn begin(path: String, site: Site) {
    elaboration(|elaboration| {
        elaboration.open.push(Builder {
            path,
            site: Some(site),
            ..Builder::default()
        });
    });
}

/// It ends; returns its number and its settings.
#[inline(never)]
fn end(name: &str, about: &'static str, nets: Nets) -> (usize, Vec<Setting>) {
    elaboration(|elaboration| {
        let builder = elaboration.open.pop().unwrap_or_default();
        let (path, sites) = (builder.path.clone(), builder.instance_sites());
        let (module, settings) = builder.finish(name, about, nets);
        // Of a part with mistakes it is not known what its ports are.
        let hidden = match elaboration.mistakes.is_empty() {
            true => module.hidden(&elaboration.modules),
            false => Vec::new(),
        };
        for (instance, signal) in hidden {
            let (name, site) = &sites[instance];
            elaboration.mistakes.push(super::Mistake {
                site: *site,
                path: path.clone(),
                what: format!("`{name}.{signal}` is read, but is no port: it is not declared pub"),
            });
        }
        (
            crate::hdl::netlist::enter(module, &mut elaboration.modules),
            settings,
        )
    })
}

/// Makes the signals of a circuit, what drives them, and the circuits inside.
fn signals_of<C: Circuit>(circuit: &C, site: Site, more: &mut dyn FnMut(&mut dyn Source)) -> Nets {
    let mistakes = build::mistakes();
    let i: C::In<Wire> = C::In::make(circuit, view::role(Role::Input), &mut Leaves::new());
    more(&mut Leaves::new());
    let q: C::Reg<Wire> = C::Reg::make(circuit, view::role(Role::Register), &mut Leaves::new());
    own_registers();
    // What a tick makes of words that are none is no use.
    if build::mistakes() > mistakes {
        return low(counted_nets(circuit));
    }
    let p: C::Parts<Wire> = C::Parts::make(circuit, view::role(Role::Register), &mut Leaves::new());
    let (w, next) = circuit.tick(i, q, p);
    unsettled(site);
    let mut given = Counted::default();
    w.visit(view::role(Role::Net), &mut given);
    let nets = nets(
        counted_nets(circuit),
        given,
        <C::Net<Wire> as Walk<Wire>>::SITE,
    );
    let mut wanted = Counted::default();
    C::Reg::<Shapes>::make(circuit, view::role(Role::Register), &mut wanted);
    let mut given = Counted::default();
    next.visit(view::role(Role::Register), &mut given);
    drive(&wanted, given, <C::Reg<Edge> as Walk<Edge>>::SITE);
    property::note(circuit, &nets);
    names(site);
    nets
}

/// The registers made so far are the circuit's own.
#[inline(never)]
fn own_registers() {
    builder(|builder| builder.own = builder.registers.len());
}

fn counted_nets<C: Circuit>(circuit: &C) -> Counted {
    let mut wanted = Counted::default();
    C::Net::<Shapes>::make(circuit, view::role(Role::Net), &mut wanted);
    wanted
}

/// Nets that are all low, of a circuit that cannot be elaborated.
fn low(wanted: Counted) -> Nets {
    let nodes = wanted.leaves.into_iter().map(|leaf| {
        let width = leaf.shape.width.clamp(1, 64);
        build::constant(
            0,
            Shape {
                width,
                ..leaf.shape
            },
        )
    });
    let nodes: Vec<Id> = nodes.collect();
    Nets {
        leaves: vec![None; nodes.len()],
        nodes,
    }
}

/// Parts that were never settled.
fn unsettled(site: Site) {
    let names: Vec<String> = builder(|builder| {
        let parts = builder.parts.iter();
        let left = parts.filter(|part| part.instance.is_none());
        left.map(|part| part.name.clone()).collect()
    });
    for name in names {
        mistake(site, format!("part `{name}` is never settled"));
    }
}

/// Names that are used twice.
fn names(site: Site) {
    let twice: Vec<String> = builder(|builder| {
        let signals = builder
            .signals
            .iter()
            .filter(|signal| signal.owner.is_none());
        let memories = builder.memories.iter().filter(|memory| !memory.inner);
        let parts = builder.parts.iter().map(|part| &part.name);
        let mut names: Vec<&String> = signals
            .map(|signal| &signal.name)
            .chain(memories.map(|memory| &memory.name))
            .chain(parts)
            .collect();
        names.sort();
        let mut twice: Vec<String> = names
            .windows(2)
            .filter(|pair| pair[0] == pair[1])
            .map(|pair| pair[0].clone())
            .collect();
        twice.dedup();
        twice
    });
    for name in twice {
        mistake(site, format!("the name `{name}` is used twice"));
    }
}

/// The leaves of the walk over the nets: for each the signal, if it is not one of an instance, and
/// the node that it shows.
#[derive(Default)]
pub(super) struct Nets {
    pub leaves: Vec<Option<usize>>,
    pub nodes: Vec<Id>,
}

/// Names the nets.
fn nets(wanted: Counted, given: Counted, site: Site) -> Nets {
    let mut nets = Nets::default();
    builder(|builder| {
        for part in &builder.parts {
            let Some(instance) = part.instance.and_then(|part| builder.instances.get(part)) else {
                continue;
            };
            nets.nodes.extend(&instance.child.inputs);
            nets.nodes.extend(&instance.ports);
        }
    });
    nets.leaves = vec![None; nets.nodes.len()];
    let nodes = pair(&given, &wanted, site, "net");
    for (leaf, id) in wanted.leaves.into_iter().zip(nodes) {
        if !(1..=64).contains(&leaf.shape.width) {
            let bits = build::bits(leaf.shape.width);
            mistake(
                site,
                format!("`{}` has {bits}; a word has 1 to 64", leaf.name),
            );
        }
        let mut net = signal(leaf.name, leaf.field, Role::Net, leaf.shape);
        net.driver = Some(id);
        let net = builder(|builder| builder.signal(net));
        nets.leaves.push(Some(net));
        nets.nodes.push(id);
    }
    nets
}

/// What the edge makes of registers and memories.
fn drive(wanted: &Counted, given: Counted, site: Site) {
    let nodes = pair(&given, wanted, site, "register");
    let mistakes: Vec<String> = builder(|builder| {
        let own = builder.registers[..builder.own].to_vec();
        let (mut nodes, mut memories) = (nodes.into_iter(), given.memories.into_iter());
        let mut mistakes = Vec::new();
        for register in own {
            match register {
                Register::Signal(signal) => builder.signals[signal].driver = nodes.next(),
                Register::Memory(memory) => {
                    let written = memories.next().map(|(_, written)| written);
                    if let Err(what) = builder.write(memory, written.unwrap_or_default()) {
                        mistakes.push(what);
                    }
                }
            }
        }
        mistakes
    });
    for what in mistakes {
        mistake(site, what);
    }
}

impl Builder {
    /// Takes over how a memory is written.
    fn write(&mut self, memory: usize, written: Written) -> Result<(), String> {
        let name = |memory: usize| match self.memories.get(memory) {
            Some(memory) => memory.name.clone(),
            None => "another".to_owned(),
        };
        let port = match written.0 {
            Some((made, state)) if made == memory => match state {
                State::Kept => Port::Rom,
                State::Written {
                    enable,
                    address,
                    data,
                } => Port::Ram {
                    enable,
                    address,
                    data,
                },
                State::Shifted { enable, data } => Port::Shift { enable, data },
            },
            Some((made, _)) => {
                return Err(format!(
                    "memory `{}` becomes what was made of `{}`",
                    name(memory),
                    name(made)
                ));
            }
            None => return Err(format!("memory `{}` becomes nothing", name(memory))),
        };
        self.memories[memory].port = port;
        Ok(())
    }

    /// Gives registers to the instance whose they are.
    pub(super) fn claim(&mut self, instance: usize, registers: Range<usize>, inside: &[Register]) {
        for (register, inner) in self.registers[registers].iter().zip(inside) {
            match (register, inner) {
                (Register::Signal(signal), Register::Signal(inner)) => {
                    self.signals[*signal].owner = Some((instance, *inner));
                }
                (Register::Memory(memory), Register::Memory(inner)) => {
                    self.memories[*memory].inner = true;
                    self.owners.resize(self.memories.len(), None);
                    self.owners[*memory] = Some((instance, *inner));
                }
                _ => {}
            }
        }
    }

    /// The instances and where each was settled.
    fn instance_sites(&self) -> Vec<(String, Site)> {
        let sites = self.instances.iter();
        sites
            .map(|instance| (instance.child.name.clone(), instance.site))
            .collect()
    }

    /// The module, its parameters and what its memories hold at power-on.
    fn finish(mut self, name: &str, about: &'static str, nets: Nets) -> (Module, Vec<Setting>) {
        let settings = self.settings();
        self.owners.resize(self.memories.len(), None);
        let module = Module {
            name: name.to_owned(),
            about,
            nodes: self.nodes,
            signals: self.signals,
            parameters: self
                .parameters
                .into_iter()
                .map(|(parameter, _)| parameter)
                .collect(),
            memories: self.memories,
            assertions: self.assertions,
            instances: self
                .instances
                .into_iter()
                .map(|instance| instance.child)
                .collect(),
            registers: self.registers,
            nets: nets.leaves,
            net_nodes: nets.nodes,
            owners: self.owners,
        };
        (module, settings)
    }

    /// Parameters and contents of memories, those of instances under their names.
    fn settings(&mut self) -> Vec<Setting> {
        let parameters = self.parameters.iter().map(|(parameter, value)| Setting {
            path: vec![parameter.name.to_owned()],
            width: parameter.width,
            value: Value::Number(*value),
        });
        let memories = self.memories.iter().zip(&self.contents);
        let own = memories.filter(|(memory, _)| !memory.inner);
        let own = own.map(|(memory, words)| Setting {
            path: vec![memory.name.clone()],
            width: memory.width,
            value: Value::Words(words.clone()),
        });
        let mut settings: Vec<Setting> = parameters.chain(own).collect();
        for instance in &mut self.instances {
            for mut inner in std::mem::take(&mut instance.settings) {
                inner.path.insert(0, instance.child.name.clone());
                settings.push(inner);
            }
        }
        settings
    }
}

/// Whether a memory has contents, in this instance of its module or in another.
fn is_filled(modules: &[Module], path: &[String]) -> bool {
    let mut module = modules.last();
    let Some((name, instances)) = path.split_last() else {
        return false;
    };
    for instance in instances {
        let child = module.and_then(|module| {
            let mut children = module.instances.iter();
            children.find(|child| child.name == *instance)
        });
        module = child.and_then(|child| modules.get(child.module));
    }
    module.is_some_and(|module| {
        let mut own = module.memories.iter().filter(|memory| !memory.inner);
        own.any(|memory| memory.name == *name && memory.filled)
    })
}

/// Makes inputs and registers.
pub(crate) struct Leaves {
    path: Path,
}

impl Leaves {
    pub fn new() -> Self {
        Leaves {
            path: Path::default(),
        }
    }

    /// The words of a memory for a view that does not look at them.
    pub fn no_cells(shape: MemoryShape) -> Cells {
        Cells {
            first: 0,
            words: shape.words,
            width: shape.width,
            contents: Arc::new([]),
        }
    }
}

impl Source for Leaves {
    fn enter(&mut self, field: &'static Field) {
        self.path.enter(field);
        let scope = self.path.scopes().join("_");
        builder(|builder| builder.scope = scope);
    }
    fn leave(&mut self) {
        self.path.leave();
        let scope = self.path.scopes().join("_");
        builder(|builder| builder.scope = scope);
    }
    fn element(&mut self, index: usize) {
        self.path.element(index);
    }
    fn pass(&mut self, _: Pass) {}

    fn word(&mut self, field: &'static Field, shape: Shape, power_on: u64) -> u64 {
        let name = self.path.name(field);
        let name = flat(self.path.scopes(), &name);
        let role = self.path.role();
        // Words of a part are told where it is elaborated.
        if !(1..=64).contains(&shape.width) && !builder(|builder| builder.of_part) {
            let site = builder(|builder| builder.site);
            if let Some(site) = site {
                let bits = build::bits(shape.width);
                mistake(site, format!("`{name}` has {bits}; a word has 1 to 64"));
            }
        }
        let shape = Shape {
            width: shape.width.clamp(1, 64),
            ..shape
        };
        builder(|builder| {
            let mut made = signal(name, field, role, shape);
            if role == Role::Register {
                made.power_on = masked(power_on, shape);
                let register = Register::Signal(builder.signals.len());
                builder.registers.push(register);
            }
            let signal = builder.signal(made);
            let site = builder.site();
            builder.node(Node::Signal(signal), shape, site) as u64
        })
    }

    fn memory(
        &mut self,
        field: &'static Field,
        _: &'static Field,
        shape: MemoryShape,
        contents: &dyn Fn() -> Contents,
    ) -> Cells {
        let name = self.path.name(field);
        let name = flat(self.path.scopes(), &name);
        let contents = contents();
        let site = builder(|builder| builder.site);
        let of_part = builder(|builder| builder.of_part);
        let object = |what: String| {
            if let Some(site) = site
                && !of_part
            {
                mistake(site, what);
            }
        };
        let most = 1 << 24;
        if !(1..=64).contains(&shape.width) || !(1..=most).contains(&shape.words) {
            object(format!(
                "memory `{name}` has {} words of {}; there are 1 to {most} words of 1 to 64 bits",
                shape.words,
                build::bits(shape.width)
            ));
        }
        if let Some((address, width)) = contents.shape()
            && (shape.address != Some(address) || shape.width != width)
        {
            let words = match shape.address {
                Some(address) => format!("addresses of {}", build::bits(address)),
                None => format!("{} stages", shape.words),
            };
            object(format!(
                "memory `{name}` has {words} and words of {}, what it holds at power-on has {} and {}",
                build::bits(shape.width),
                build::bits(address),
                build::bits(width)
            ));
        }
        let shape = MemoryShape {
            words: shape.words.clamp(1, most),
            width: shape.width.clamp(1, 64),
            ..shape
        };
        let words = contents.words(shape);
        let first = builder(|builder| {
            builder.memories.push(Memory {
                name,
                doc: field.doc,
                words: shape.words,
                width: shape.width,
                port: Port::Rom,
                filled: words.iter().any(|word| *word != 0),
                inner: false,
            });
            builder.shapes.push(shape);
            builder.contents.push(words);
            let memory = builder.memories.len() - 1;
            builder.registers.push(Register::Memory(memory));
            memory
        });
        Cells {
            first,
            ..Leaves::no_cells(shape)
        }
    }
}

/// Nets of an instance, as nodes that are there.
pub(super) struct Ports<'a>(pub std::slice::Iter<'a, Id>);

impl Source for Ports<'_> {
    fn word(&mut self, _: &'static Field, shape: Shape, _: u64) -> u64 {
        match self.0.next() {
            Some(id) => *id as u64,
            // There are as many as the same walk found.
            None => node(Node::Constant(0), shape) as u64,
        }
    }
    fn memory(
        &mut self,
        _: &'static Field,
        _: &'static Field,
        shape: MemoryShape,
        _: &dyn Fn() -> Contents,
    ) -> Cells {
        Leaves::no_cells(shape)
    }
}
