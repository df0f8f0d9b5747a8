//! Names that a module cannot have: duplicates in its waves or in Verilog, and words that Verilog
//! reserves.

use super::build::{self, Builder, Elaboration, elaboration, mistake};
use super::keywords::is_reserved;
use crate::netlist::{Id, Module, Node, Role, Site};
use std::collections::BTreeMap;

/// Checks the names in the module under construction, a circuit named `circuit`.
pub(super) fn check(site: Site, circuit: &str) {
    let wrong = elaboration(|Elaboration { open, modules, .. }| match open.last() {
        Some(builder) => {
            let reserved = builder.reserved(circuit).into_iter();
            let names = reserved.chain(builder.twice(modules, circuit));
            let names = names.map(|what| (site, what));
            names.chain(builder.hidden(modules)).collect()
        }
        None => Vec::new(),
    });
    for (site, what) in wrong {
        mistake(site, what);
    }
}

impl Builder {
    /// Returns names of the circuit, its signals, memories and parts that are words of Verilog.
    fn reserved(&self, circuit: &str) -> Vec<String> {
        let own = self.signals.iter().filter(|own| own.owner.is_none());
        let memories = self.memories.iter().filter(|memory| !memory.inner);
        let names = own.map(|signal| &signal.name);
        let names = names.chain(memories.map(|memory| &memory.name));
        let names = names.chain(self.parts.iter().map(|part| &part.name));
        let names = std::iter::once(circuit).chain(names.map(String::as_str));
        let reserved = names.filter(|name| is_reserved(name));
        let reserved = reserved.map(|name| {
            format!("`{name}` is a word of Verilog or SystemVerilog, or kept for clock and reset")
        });
        reserved.collect()
    }

    /// Returns names that are used twice by the circuit, its signals, memories and parts, or by
    /// the names that Verilog derives from them.
    fn twice(&self, modules: &[Module], circuit: &str) -> Vec<String> {
        let mut names: BTreeMap<String, Vec<String>> = BTreeMap::new();
        let mut add = |name: String, of: String| {
            let all = names.entry(name).or_default();
            if of.is_empty() || !all.contains(&of) {
                all.push(of);
            }
        };
        for signal in &self.signals {
            if let Some(behind) = signal.behind() {
                add(behind, format!("`{}`", signal.name));
            }
        }
        let own = self.signals.iter().filter(|own| own.owner.is_none());
        let parts = self.parts.iter().map(|part| &part.name);
        for name in own.map(|signal| &signal.name).chain(parts) {
            add(name.clone(), String::new());
        }
        add(circuit.to_owned(), String::new());
        for (index, memory) in self.memories.iter().enumerate() {
            if !memory.inner {
                let rom = self.roms.contains(&index);
                let of = if rom { "a ROM" } else { "" };
                add(memory.name.clone(), of.to_owned());
                for made in memory.loops().chain([memory.name.to_uppercase()]) {
                    add(made, format!("`{}`", memory.name));
                }
            }
        }
        for (parameter, _) in &self.parameters {
            let bits = build::bits(parameter.width);
            let of = format!("`{}` ({bits})", parameter.name);
            add(parameter.name.to_uppercase(), of);
        }
        for (index, instance) in self.instances.iter().enumerate() {
            let name = &instance.child.name;
            for (inner, signal) in modules[instance.child.module].signals.iter().enumerate() {
                let port = format!("{name}_{}", signal.name);
                let out = signal.is_port() && signal.role != Role::Input;
                if out && !self.shows(&port, (index, inner), modules) {
                    add(port, format!("`{name}.{}`", signal.name));
                }
            }
            for setting in &instance.settings {
                let path = |between| format!("{name}{between}{}", setting.path.join(between));
                add(path("_").to_uppercase(), format!("`{}`", path(".")));
            }
        }
        let twice = names.into_iter().filter(|(_, of)| of.len() > 1);
        let twice = twice.map(|(name, mut of)| {
            of.retain(|of| !of.is_empty());
            let made = match of.is_empty() {
                true => String::new(),
                false => format!(": Verilog makes it of {}", of.join(" and of ")),
            };
            format!("the name `{name}` is used twice{made}")
        });
        twice.collect()
    }

    /// True if a net of that name only shows a port of an instance.
    fn shows(&self, name: &str, port: (usize, usize), modules: &[Module]) -> bool {
        let port_of = |id: Id| match self.nodes[id].0 {
            Node::Signal(signal) => self.signals[signal].owner,
            Node::Port { instance, leaf } => {
                let inside = &modules[self.instances[instance].child.module];
                inside.net(leaf).map(|inner| (instance, inner))
            }
            _ => None,
        };
        let mut own = self.signals.iter().filter(|own| own.role == Role::Net);
        own.any(|net| net.name == name && net.driver.and_then(port_of) == Some(port))
    }

    /// Returns parts that have the name of a signal or memory inside them, which would hide it.
    fn hidden(&self, modules: &[Module]) -> impl Iterator<Item = (Site, String)> {
        self.instances.iter().filter_map(|instance| {
            let (name, inside) = (&instance.child.name, &modules[instance.child.module]);
            let signals = inside.signals.iter().filter(|own| own.owner.is_none());
            let signals = signals.flat_map(|own| [Some(own.name.clone()), own.behind()]);
            let memories = inside.memories.iter().filter(|memory| !memory.inner);
            let memories = memories.flat_map(|memory| memory.loops().chain([memory.name.clone()]));
            let mut hidden = signals.flatten().chain(memories);
            hidden.any(|inner| inner == *name).then(|| {
                let what = format!(
                    "part `{name}` has the name of a signal of `{}`, inside it",
                    inside.name
                );
                (instance.site, what)
            })
        })
    }
}
