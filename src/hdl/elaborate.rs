//! Elaboration: runs a circuit's `tick` once and records what it computes. Circuits inside it
//! become modules of their own.

use super::build::{self, Aside, Builder, builder, elaboration, mistake, signal};
use super::leaves::Leaves;
use super::memory::{State, Written};
use super::mutation;
use super::names;
use super::part::{Counted, Place, pair};
use super::property;
use super::record::{Record, Walk};
use super::view::{self, Edge, Shapes, Wire};
use super::{Circuit, More, Nothing};
use crate::netlist::{
    Design, Id, Mistake, Module, Port, Register, Role, Setting, Site, Value, Wrong,
};
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Elaborates a circuit: its netlist, those of the circuits inside it, and the power-on values.
///
/// # Errors
/// Returns all mistakes of the circuit, each with file, line and column.
pub fn elaborate<C: Circuit>(circuit: &C) -> Result<Design, Wrong> {
    with_inputs(circuit, &mut |_| {})
}

/// Elaborates a circuit that has additional input ports which its `tick` does not read.
pub(crate) fn with_inputs<C: Circuit>(circuit: &C, more: More<'_>) -> Result<Design, Wrong> {
    whole(&mut || circuit.make_module(circuit.name().to_owned(), more))
}

// Code that does not depend on the circuit's type is compiled once.

/// Builds the module of the outermost circuit.
fn whole(make: &mut dyn FnMut() -> (usize, Vec<Setting>)) -> Result<Design, Wrong> {
    let aside = Aside::begin();
    let settings = match catch_unwind(AssertUnwindSafe(make)) {
        Ok((_, settings)) => settings,
        Err(panic) => {
            // For example the circuit's own arithmetic on widths.
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

/// Builds the module of a circuit, with input ports that it does not read. Returns index and
/// settings of the module.
pub fn module<C: Circuit>(circuit: &C, path: String, more: More<'_>) -> (usize, Vec<Setting>) {
    let site = declared([
        <C::In<Wire> as Walk<Wire>>::SITE,
        <C::Reg<Wire> as Walk<Wire>>::SITE,
        <C::Net<Wire> as Walk<Wire>>::SITE,
        <C::Parts<Wire> as Walk<Wire>>::SITE,
    ]);
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

/// Returns the declaration site of a circuit: that of the first record that is its own.
#[inline(never)]
fn declared(records: [Site; 4]) -> Site {
    let nothing = <Nothing as Walk<Wire>>::SITE;
    let mut own = records.into_iter().filter(|site| *site != nothing);
    own.next().unwrap_or(nothing)
}

/// Begins a module inside the one under construction.
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

/// Ends the module; returns its index and its settings.
#[inline(never)]
fn end(name: &str, about: &'static str, nets: Nets) -> (usize, Vec<Setting>) {
    elaboration(|elaboration| {
        let builder = elaboration.open.pop().unwrap_or_default();
        let (path, sites) = (builder.path.clone(), builder.instance_sites());
        for (site, what) in builder.parts_involved() {
            let path = path.clone();
            elaboration.mistakes.push(Mistake { site, path, what });
        }
        let (module, settings) = builder.finish(name, about, nets);
        // The ports of a part with mistakes are unknown.
        let hidden = match elaboration.mistakes.is_empty() {
            true => module.hidden(&elaboration.modules),
            false => Vec::new(),
        };
        for (instance, signal) in hidden {
            let (name, site) = &sites[instance];
            elaboration.mistakes.push(Mistake {
                site: *site,
                path: path.clone(),
                what: format!("`{name}.{signal}` is read, but is no port: it is not declared pub"),
            });
        }
        (
            crate::netlist::enter(module, &mut elaboration.modules),
            settings,
        )
    })
}

/// Builds the signals of a circuit, their drivers, and the circuits inside.
fn signals_of<C: Circuit>(circuit: &C, site: Site, more: More<'_>) -> Nets {
    let i: C::In<Wire> = C::In::make(circuit, view::role(Role::Input), &mut Leaves::default());
    more(&mut Leaves::default());
    let q: C::Reg<Wire> = C::Reg::make(circuit, view::role(Role::Register), &mut Leaves::default());
    own_registers();
    // Words of an impossible shape make the result of `tick` useless.
    if builder(|builder| builder.unmade) {
        return low(&counted_nets(circuit));
    }
    let p: C::Parts<Wire> =
        C::Parts::make(circuit, view::role(Role::Register), &mut Leaves::default());
    let (w, next) = circuit.tick(i, q, p);
    unsettled(site);
    let mut given = Counted::default();
    w.visit(view::role(Role::Net), &mut given);
    let mut nets = nets(
        counted_nets(circuit),
        given,
        <C::Net<Wire> as Walk<Wire>>::SITE,
    );
    let mut wanted = Counted::default();
    C::Reg::<Shapes>::make(circuit, view::role(Role::Register), &mut wanted);
    let mut given = Counted::default();
    next.visit(view::role(Role::Register), &mut given);
    drive(&wanted, given, <C::Reg<Edge> as Walk<Edge>>::SITE);
    names::check(site, circuit.name());
    elaboration(|elaboration| mutation::visit(circuit.name(), elaboration, &mut nets));
    property::note(circuit, &nets, site);
    nets
}

/// Marks the registers made so far as the circuit's own.
#[inline(never)]
fn own_registers() {
    builder(|builder| builder.own = builder.registers.len());
}

fn counted_nets<C: Circuit>(circuit: &C) -> Counted {
    let mut wanted = Counted::default();
    C::Net::<Shapes>::make(circuit, view::role(Role::Net), &mut wanted);
    wanted
}

/// Returns nets that are all low, for a circuit that cannot be elaborated.
fn low(wanted: &Counted) -> Nets {
    let nodes = wanted.low();
    Nets {
        leaves: vec![None; nodes.len()],
        nodes,
    }
}

/// Records a mistake for each part that was never settled.
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

/// Leaves of the walk over the nets: the signal, unless it belongs to an instance, and the node
/// that it shows.
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
    let nodes = pair(&given, &wanted, site, Place::Net);
    for (leaf, id) in wanted.leaves.into_iter().zip(nodes) {
        if let Err(wrong) = build::is_word(leaf.shape) {
            mistake(site, format!("`{}` {wrong}", leaf.path));
        }
        let mut net = signal((leaf.name, leaf.path), leaf.field, Role::Net, leaf.shape);
        net.driver = Some(id);
        let net = builder(|builder| builder.signal(net));
        nets.leaves.push(Some(net));
        nets.nodes.push(id);
    }
    nets
}

/// Connects registers and memories to their values after the edge.
fn drive(wanted: &Counted, given: Counted, site: Site) {
    let nodes = pair(&given, wanted, site, Place::Register);
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
    /// Sets the write port of a memory.
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

    /// Assigns registers to the instance that owns them.
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

    /// Returns the instances with the location of each `settle`.
    fn instance_sites(&self) -> Vec<(String, Site)> {
        let sites = self.instances.iter();
        sites
            .map(|instance| (instance.child.name.clone(), instance.site))
            .collect()
    }

    /// Returns the module, its parameters and the power-on contents of its memories.
    fn finish(mut self, name: &str, about: &'static str, nets: Nets) -> (Module, Vec<Setting>) {
        let settings = self.settings();
        self.owners.resize(self.memories.len(), None);
        let module = Module {
            name: name.to_owned(),
            about,
            logic: self.logic,
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

    /// Returns parameters and memory contents; those of instances under their names.
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

/// True if a memory has contents in any instance of its module.
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
