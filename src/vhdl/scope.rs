//! Names of a module in VHDL.

use super::words::{legal, reserved};
use crate::netlist::{Format, Module, Signal};
use crate::printed::{Modules, own_memories};
use std::collections::{HashMap, HashSet};

/// Names in an entity and its architecture, all different in more than the case of letters.
pub(super) struct Scope {
    /// Names in VHDL.
    names: HashMap<Key, String>,
    /// All names that are in use.
    taken: HashSet<String>,
}

/// Thing that has a name.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
enum Key {
    /// A signal, memory, instance, or wire that an instance drives, by its name in Verilog.
    Own(String),
    /// The wire at an input port of an instance.
    Input(String, String),
    /// A generic.
    Generic(String),
    /// The type of a memory.
    Type(String),
    /// A state of a signal.
    State(String, usize),
}

impl Scope {
    /// Names what `module` declares.
    pub(super) fn of(module: &Module, modules: &Modules<'_>) -> Self {
        let mut scope = Scope::new();
        // The names of ports are what others see.
        let own = module.signals.iter().filter(|own| own.owner.is_none());
        let (ports, hidden): (Vec<_>, Vec<_>) = own.partition(|own| own.is_port());
        for signal in ports.iter().chain(&hidden) {
            scope.add(Key::Own(signal.name.clone()), &signal.name);
        }
        for behind in ports.iter().filter_map(|port| port.behind()) {
            scope.add(Key::Own(behind.clone()), &behind);
        }
        for (_, memory) in own_memories(module) {
            scope.add(Key::Own(memory.name.clone()), &memory.name);
            let words = format!("{}_words", memory.name);
            scope.add(Key::Type(memory.name.clone()), &words);
        }
        for child in &module.instances {
            scope.add(Key::Own(child.name.clone()), &child.name);
        }
        for child in &module.instances {
            let inside = &modules.modules[child.module];
            for port in inside.outputs() {
                let wire = format!("{}_{}", child.name, port.name);
                scope.add(Key::Own(wire.clone()), &wire);
            }
            for port in inside.inputs() {
                let wire = format!("{}_{}", child.name, port.name);
                let key = Key::Input(child.name.clone(), port.name.clone());
                scope.add(key, &wire);
            }
        }
        for parameter in modules.numbers(module) {
            let name = parameter.name();
            scope.add(Key::Generic(name.clone()), &name);
        }
        for signal in ports.into_iter().chain(hidden) {
            let Format::States(states) = signal.field.format else {
                continue;
            };
            for (value, state) in states.iter().enumerate() {
                let name = format!("{}_{state}", signal.name);
                scope.add(Key::State(signal.name.clone(), value), &name);
            }
        }
        scope
    }

    /// Names ports, with those of the clock and the reset; `used` are more names that they cannot
    /// have.
    pub(super) fn of_ports<'a>(used: &[&str], ports: impl Iterator<Item = &'a str>) -> Self {
        let mut scope = Scope::new();
        scope
            .taken
            .extend(used.iter().map(|word| (*word).to_owned()));
        for port in ports {
            scope.add(Key::Own(port.to_owned()), port);
        }
        scope
    }

    /// Names the clock and the reset.
    fn new() -> Self {
        let mut scope = Scope {
            names: HashMap::new(),
            taken: reserved().iter().map(|word| (*word).to_owned()).collect(),
        };
        for name in ["clk", "rst"] {
            scope.add(Key::Own(name.to_owned()), name);
        }
        scope
    }

    fn add(&mut self, key: Key, name: &str) {
        if self.names.contains_key(&key) {
            return;
        }
        let legal = legal(name);
        let mut free = legal.clone();
        let mut number = 1;
        while !self.taken.insert(free.clone()) {
            number += 1;
            free = format!("{legal}_{number}");
        }
        let shown = match key {
            Key::Generic(_) | Key::State(..) => free.to_ascii_uppercase(),
            _ => free,
        };
        self.names.insert(key, shown);
    }

    fn get(&self, key: &Key) -> String {
        self.names.get(key).cloned().unwrap_or_default()
    }

    /// Returns the names that no subexpression can have.
    pub(super) fn taken(&self) -> HashSet<String> {
        self.taken.clone()
    }

    /// Returns the name of a signal, memory, instance, or wire that an instance drives.
    pub(super) fn own(&self, name: &str) -> String {
        let known = self.names.get(&Key::Own(name.to_owned()));
        known.cloned().unwrap_or_else(|| legal(name))
    }

    /// Returns the name of the wire at an input port of an instance.
    pub(super) fn input(&self, child: &str, port: &str) -> String {
        self.get(&Key::Input(child.to_owned(), port.to_owned()))
    }

    /// Returns the name of a generic.
    pub(super) fn generic(&self, parameter: &str) -> String {
        self.get(&Key::Generic(parameter.to_owned()))
    }

    /// Returns the name of the type of a memory.
    pub(super) fn words(&self, memory: &str) -> String {
        self.get(&Key::Type(memory.to_owned()))
    }

    /// Returns the constant for a state of a signal; `None` if the value is no state.
    pub(super) fn state(&self, signal: &Signal, value: u64) -> Option<String> {
        let value = usize::try_from(value).ok()?;
        let key = Key::State(signal.name.clone(), value);
        self.names.get(&key).cloned()
    }
}
