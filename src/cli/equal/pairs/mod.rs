//! Partners of a circuit's ports and registers in a design, by name or by a map.

mod mapped;

use super::netlist::{Net, Netlist};
use motion_rtl::compare::Map;
use motion_rtl::input::Fault;
use motion_rtl::netlist::Role;
use motion_rtl::sim::{PortDirection, SignalInfo};
use std::collections::BTreeMap;

/// Most names in a message.
const LISTED: usize = 12;

/// Bits of a net of the design.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Part {
    pub net: String,
    /// Place of the lowest bit, counted from the net's lowest.
    pub low: usize,
    pub width: usize,
    pub invert: bool,
}

/// A signal of the circuit and its partner.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pair {
    /// Index of the circuit's signal.
    pub signal: usize,
    pub part: Part,
}

/// Result of pairing.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Pairs {
    /// Input ports of the circuit with those of the design.
    pub inputs: Vec<Pair>,
    /// Signals that have to be equal: output ports, registers, and nets that the map names.
    pub held: Vec<Pair>,
    /// Ports of the circuit without partner.
    pub ports_without: Vec<usize>,
    /// Those of them whose name a port of the design has, with another width.
    pub other_widths: Vec<Pair>,
    /// Ports of the circuit that the map leaves out.
    pub ports_left_out: Vec<usize>,
    /// Registers of the circuit without partner.
    pub registers_without: Vec<usize>,
}

/// The two sides of a comparison.
#[derive(Debug, Clone, Copy)]
pub struct Sides<'a> {
    pub circuit: &'a str,
    /// Signals of the circuit.
    pub signals: &'a [SignalInfo],
    /// The circuit's Verilog, flattened.
    pub golden: &'a Netlist,
    pub design: &'a Netlist,
    /// Clock and reset of the design, which are no partners.
    pub reserved: [Option<&'a str>; 2],
    pub map: &'a Map,
}

/// Returns a name without regard to case and to the difference between scopes and bundles.
pub fn key(name: &str) -> String {
    name.replace('.', "_").to_ascii_lowercase()
}

/// True if `end` is `path` or the end of it, from a dot on.
fn is_end(path: &str, end: &str) -> bool {
    let before = path.strip_suffix(end);
    before.is_some_and(|before| before.is_empty() || before.ends_with('.'))
}

impl Sides<'_> {
    /// Pairs the signals.
    ///
    /// # Errors
    /// Returns the fault of the map's first wrong line.
    pub fn pairs(&self) -> Result<Pairs, Fault> {
        let left = self.left_out()?;
        let mapped = self.mapped()?;
        let scopes = self.scopes()?;
        let keys = self.keys();
        let mut pairs = Pairs::default();
        for (index, signal) in self.signals.iter().enumerate() {
            let by_name = || self.by_name(signal, &scopes, &keys);
            let part = match mapped.get(&index) {
                Some(part) => Some(part.clone()),
                None if left.contains(&index) => {
                    if signal.port.is_some() {
                        pairs.ports_left_out.push(index);
                    }
                    continue;
                }
                None => by_name(),
            };
            let mut pair = part.map(|part| Pair {
                signal: index,
                part,
            });
            let other_width = pair.take_if(|pair| pair.part.width != signal.width());
            pairs
                .other_widths
                .extend(other_width.filter(|_| signal.port.is_some()));
            match (signal.port, pair) {
                (Some(PortDirection::In), Some(pair)) => pairs.inputs.push(pair),
                (_, Some(pair)) if self.golden.nets.contains_key(&signal.verilog) => {
                    pairs.held.push(pair);
                }
                // An unused net that synthesis has left out.
                (None, Some(_)) => {}
                (Some(_), _) => pairs.ports_without.push(index),
                (None, None) if signal.role == Role::Register => {
                    pairs.registers_without.push(index);
                }
                (None, None) => {}
            }
        }
        Ok(pairs)
    }

    fn is_port(&self, name: &str) -> bool {
        self.design.inputs.contains_key(name) || self.design.outputs.contains(name)
    }

    /// Returns the registers and ports of the design by their keys.
    fn keys(&self) -> BTreeMap<String, Vec<&str>> {
        let mut keys: BTreeMap<String, Vec<&str>> = BTreeMap::new();
        for (name, net) in &self.design.nets {
            if net.is_register || self.is_port(name) {
                keys.entry(key(name)).or_default().push(name);
            }
        }
        keys
    }

    /// Returns the port or register of the design with the name of a signal; one of its width, if
    /// there is one.
    fn by_name(
        &self,
        signal: &SignalInfo,
        scopes: &[(String, String)],
        keys: &BTreeMap<String, Vec<&str>>,
    ) -> Option<Part> {
        let below = |own: &str| match own {
            "" => Some(signal.path.as_str()),
            own => signal.path.strip_prefix(own)?.strip_prefix('.'),
        };
        let moved = scopes
            .iter()
            .find_map(|(own, other)| Some(format!("{other}{}", below(own)?)));
        let path = moved.as_deref().unwrap_or(&signal.path);
        let names = match moved {
            None => [path, &signal.verilog],
            Some(_) => [path, path],
        };
        let width = |name: &str| self.design.nets[name].width();
        let is_kind = |name: &&str| {
            let right = match signal.port {
                Some(PortDirection::In) => self.design.inputs.contains_key(*name),
                Some(PortDirection::Out) => self.design.outputs.contains(*name),
                None => signal.role == Role::Register && self.design.nets[*name].is_register,
            };
            right && !self.reserved.contains(&Some(*name))
        };
        let candidates = keys.get(&key(path)).map_or(&[][..], Vec::as_slice);
        let candidates = candidates.iter().copied().filter(is_kind);
        let (mut candidates, others): (Vec<&str>, Vec<&str>) =
            candidates.partition(|name| width(name) == signal.width());
        // A bundle of outputs as a scope in the design, whose nets are no ports.
        if let Some((name, net)) = self.design.nets.get_key_value(path)
            && candidates.is_empty()
            && signal.port == Some(PortDirection::Out)
            && net.width() == signal.width()
        {
            candidates.push(name);
        }
        if candidates.is_empty() {
            candidates = others;
        }
        let exact = names.iter().find(|name| candidates.contains(name)).copied();
        let net = exact.or_else(|| {
            let bits = |name: &str| -> &Net { &self.design.nets[name] };
            let first = *candidates.first()?;
            let same = |name: &&str| bits(name).bits == bits(first).bits;
            candidates.iter().all(same).then_some(first)
        })?;
        Some(Part {
            net: net.to_owned(),
            low: 0,
            width: width(net),
            invert: false,
        })
    }
}

/// Formats a number of bits.
pub fn bits(count: usize) -> String {
    match count {
        1 => "1 bit".to_owned(),
        _ => format!("{count} bits"),
    }
}

/// Lists names for a message.
pub fn listed<'n>(names: impl Iterator<Item = &'n str>) -> String {
    let names: Vec<&str> = names.collect();
    let shown = names[..names.len().min(LISTED)].join(", ");
    match names.len().checked_sub(LISTED) {
        None | Some(0) => shown,
        Some(more) => format!("{shown} and {more} more"),
    }
}

#[cfg(test)]
pub mod tests;
