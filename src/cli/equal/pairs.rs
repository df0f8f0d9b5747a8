//! Partners of a circuit's ports and registers in a design, by name or by a map.

use super::netlist::{Net, Netlist};
use motion_rtl::compare::{Entry, Map, Partner, brackets};
use motion_rtl::input::Fault;
use motion_rtl::netlist::Role;
use motion_rtl::sim::{PortDirection, SignalInfo};
use std::collections::{BTreeMap, BTreeSet};

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
                None if left.contains(&index) => continue,
                None => by_name(),
            };
            let pair = part.map(|part| Pair {
                signal: index,
                part,
            });
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

    /// Returns the indices of a signal, or of the words of a memory, by its name in a map.
    fn find(&self, name: &str) -> Vec<usize> {
        let below = name.strip_prefix(self.circuit);
        let below = below.and_then(|name| name.strip_prefix('.'));
        let of = |name: &str| -> Vec<usize> {
            let is = |path: &str| match path.strip_prefix(name) {
                Some(rest) => rest.is_empty() || rest.starts_with('[') && !name.ends_with(']'),
                None => false,
            };
            let signals = self.signals.iter().enumerate();
            let found = signals.filter(|(_, signal)| is(&signal.path) || is(&signal.verilog));
            found.map(|(index, _)| index).collect()
        };
        match of(name) {
            none if none.is_empty() => below.map(of).unwrap_or_default(),
            found => found,
        }
    }

    fn named<T>(&self, entry: &Entry<T>) -> Result<Vec<usize>, Fault> {
        let found = self.find(&entry.golden);
        if !found.is_empty() {
            return Ok(found);
        }
        let problem = format!("no signal of {} is called so", self.circuit);
        let allowed = format!("a signal that `motion-rtl list {}` shows", self.circuit);
        Err(self.map.fault(entry.line, &entry.golden, problem, allowed))
    }

    /// Returns the signals that the map leaves out.
    fn left_out(&self) -> Result<BTreeSet<usize>, Fault> {
        let mut left = BTreeSet::new();
        for entry in self.map.left_out() {
            let Some(scope) = entry.golden.strip_suffix(".*") else {
                left.extend(self.named(entry)?);
                continue;
            };
            let below = scope.strip_prefix(self.circuit).unwrap_or(scope);
            let below = below.strip_prefix('.').unwrap_or(below);
            let signals = self.signals.iter().enumerate();
            let inside = signals.filter(|(_, signal)| {
                let rest = signal.path.strip_prefix(below);
                below.is_empty() || rest.is_some_and(|rest| rest.starts_with(['.', '[']))
            });
            left.extend(inside.map(|(index, _)| index));
        }
        Ok(left)
    }

    /// Returns the partners that the map names.
    fn mapped(&self) -> Result<BTreeMap<usize, Part>, Fault> {
        let mut mapped = BTreeMap::new();
        for entry in self.map.signals() {
            let signals = self.named(entry)?;
            for index in signals {
                let signal = &self.signals[index];
                let part = self.part(entry, signal)?;
                mapped.insert(index, part);
            }
        }
        Ok(mapped)
    }

    /// Returns the partner of one signal that a line of the map names.
    fn part(&self, entry: &Entry<Partner>, signal: &SignalInfo) -> Result<Part, Fault> {
        let Partner {
            name,
            invert,
            delay,
        } = &entry.other;
        let fault = |problem: String, allowed: String| {
            self.map.fault(entry.line, &entry.golden, problem, allowed)
        };
        if *delay > 0 {
            let problem = format!("a delay of {delay}, which a proof does not have");
            return Err(fault(problem, "a signal without delay".to_owned()));
        }
        // A word of a memory whose name is in the map.
        let name = match (signal.path.rfind('['), entry.golden.ends_with(']')) {
            (Some(at), false) => format!("{name}{}", &signal.path[at..]),
            _ => name.clone(),
        };
        let whole = self
            .net(&name)
            .map_err(|(problem, allowed)| fault(problem, allowed))?;
        let (net, low, width) = match (whole, brackets(&name)) {
            (Some(net), _) => (net, 0, self.design.nets[net].width()),
            (None, Some((base, first, last))) => {
                let net = self
                    .net(base)
                    .map_err(|(problem, allowed)| fault(problem, allowed))?;
                let net = net.ok_or_else(|| fault(self.no_net(base), self.nets()))?;
                let of = &self.design.nets[net];
                match (of.place(first), of.place(last)) {
                    (Some(high), Some(low)) if high >= low => (net, low, high - low + 1),
                    _ => {
                        let problem = format!("{name} is no part of the signal");
                        return Err(fault(problem, format!("{} bits of {net}", of.width())));
                    }
                }
            }
            (None, None) => return Err(fault(self.no_net(&name), self.nets())),
        };
        if width != signal.width() {
            let problem = format!("{name} has {}", bits(width));
            let allowed = format!("{}, as {} has", bits(signal.width()), signal.path);
            return Err(fault(problem, allowed));
        }
        if signal.port == Some(PortDirection::In) && !self.design.inputs.contains_key(net) {
            let problem = format!("{net} is no input port of the design");
            let inputs = self.design.inputs.keys().map(String::as_str);
            return Err(fault(problem, listed(inputs)));
        }
        Ok(Part {
            net: net.to_owned(),
            low,
            width,
            invert: *invert,
        })
    }

    fn no_net(&self, name: &str) -> String {
        format!("no signal of the design is called {name}")
    }

    /// Lists registers and ports of the design for a message.
    fn nets(&self) -> String {
        let nets = self.design.nets.iter();
        let nets = nets.filter(|(name, net)| net.is_register || self.is_port(name));
        listed(nets.map(|(name, _)| name.as_str()))
    }

    fn is_port(&self, name: &str) -> bool {
        self.design.inputs.contains_key(name) || self.design.outputs.contains(name)
    }

    /// Returns the design's net that a path of a dump names: scopes of a bench may stand before it,
    /// or it may be the end of the net's path.
    fn net(&self, path: &str) -> Result<Option<&str>, (String, String)> {
        let nets = || self.design.nets.keys().map(String::as_str);
        let above = nets().filter(|net| is_end(path, net));
        if let Some(net) = above.max_by_key(|net| net.len()) {
            return Ok(Some(net));
        }
        let ends: Vec<&str> = nets().filter(|net| is_end(net, path)).collect();
        let first = ends.first().copied();
        let same = |net: &&str| {
            let bits = |net: &str| &self.design.nets[net].bits;
            first.is_some_and(|first| bits(first) == bits(net))
        };
        match ends.iter().all(same) {
            true => Ok(first),
            false => Err((
                format!("{path} is the end of several names"),
                listed(ends.into_iter()),
            )),
        }
    }

    /// Returns the scopes of the map, below the circuit, with those of the design.
    fn scopes(&self) -> Result<Vec<(String, String)>, Fault> {
        let mut known = BTreeSet::new();
        for net in self.design.nets.keys() {
            let dots = net.match_indices('.');
            known.extend(dots.map(|(at, _)| &net[..at]));
        }
        let scope = |entry: &Entry<String>| {
            let own = entry.golden.strip_prefix(self.circuit);
            let own = own.and_then(|rest| match rest {
                "" => Some(""),
                rest => rest.strip_prefix('.'),
            });
            let own = own.unwrap_or(&entry.golden);
            let other = entry.other.as_str();
            let fits = |scope: &&&str| is_end(other, scope) || is_end(scope, other);
            let found = known.iter().filter(fits).max_by_key(|scope| scope.len());
            match found {
                Some(found) => Ok((own.to_owned(), format!("{found}."))),
                // The bench's instance of the whole design.
                None if own.is_empty() => Ok((String::new(), String::new())),
                None => {
                    let problem = format!("no scope of the design is called {other}");
                    let allowed = listed(known.iter().copied());
                    Err(self.map.fault(entry.line, &entry.golden, problem, allowed))
                }
            }
        };
        let mut scopes: Vec<_> = self
            .map
            .scopes()
            .iter()
            .map(scope)
            .collect::<Result<_, _>>()?;
        // The innermost scope counts.
        scopes.sort_by_key(|(own, _)| std::cmp::Reverse(own.len()));
        Ok(scopes)
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

    /// Returns the port or register of the design with the name and width of a signal.
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
        let fits = |name: &&str| {
            let net = &self.design.nets[*name];
            let right = match signal.port {
                Some(PortDirection::In) => self.design.inputs.contains_key(*name),
                Some(PortDirection::Out) => self.design.outputs.contains(*name),
                None => signal.role == Role::Register && net.is_register,
            };
            right && net.width() == signal.width() && !self.reserved.contains(&Some(*name))
        };
        let candidates = keys.get(&key(path)).map_or(&[][..], Vec::as_slice);
        let mut candidates: Vec<&str> = candidates.iter().copied().filter(fits).collect();
        // A bundle of outputs as a scope in the design, whose nets are no ports.
        if let Some((name, net)) = self.design.nets.get_key_value(path)
            && candidates.is_empty()
            && signal.port == Some(PortDirection::Out)
            && net.width() == signal.width()
        {
            candidates.push(name);
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
            width: signal.width(),
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
pub mod tests {
    use super::*;
    use motion_rtl::Model;

    /// Returns a design clocked by `clk`: `i` is an input, `o` an output, `r` a register, `w` a net.
    pub fn design(nets: &[(&str, usize, char)]) -> Netlist {
        let (mut ports, mut cells, mut names) = (Vec::new(), Vec::new(), Vec::new());
        let mut bit = 2;
        for (name, width, kind) in [("clk", 1, 'i')].iter().chain(nets) {
            let bits: Vec<String> = (bit..bit + width).map(|bit| bit.to_string()).collect();
            let bits = format!("[{}]", bits.join(","));
            bit += width;
            let direction = match kind {
                'i' => "input",
                'o' => "output",
                _ => "",
            };
            if !direction.is_empty() {
                ports.push(format!(
                    r#""{name}": {{"direction": "{direction}", "bits": {bits}}}"#
                ));
            }
            if *kind == 'r' {
                cells.push(format!(
                    r#""{name}": {{"type": "$dff", "parameters": {{"CLK_POLARITY": "1"}},
                    "connections": {{"CLK": [2], "Q": {bits}}}}}"#
                ));
            }
            names.push(format!(r#""{name}": {{"hide_name": 0, "bits": {bits}}}"#));
        }
        let text = format!(
            r#"{{"modules": {{"design": {{"ports": {{{}}}, "cells": {{{}}}, "netnames": {{{}}}}}}}}}"#,
            ports.join(","),
            cells.join(","),
            names.join(",")
        );
        Netlist::read(&text, "design", "clk").unwrap()
    }

    /// Returns a circuit's own netlist, as far as pairs need it.
    pub fn golden(signals: &[SignalInfo]) -> Netlist {
        let nets: Vec<(&str, usize, char)> = signals
            .iter()
            .map(|signal| {
                let kind = match (signal.port, signal.role) {
                    (Some(PortDirection::In), _) => 'i',
                    (Some(PortDirection::Out), _) => 'o',
                    (None, Role::Register) => 'r',
                    (None, _) => 'w',
                };
                (&*signal.verilog, signal.width(), kind)
            })
            .collect();
        design(&nets)
    }

    /// Pairs a circuit with a design; returns lines of `path = [!]net[low+width]` and the paths of
    /// ports without partner.
    fn pairs(
        circuit: &str,
        keys: &[&str],
        nets: &[(&str, usize, char)],
        map: &str,
    ) -> Result<(Vec<String>, Vec<String>), String> {
        let keys: Vec<_> = keys.iter().map(|key| key.parse().unwrap()).collect();
        let signals = Model::new(circuit, &keys).unwrap().signals();
        let map = Map::parse("m.toml", map).unwrap();
        let sides = Sides {
            circuit,
            signals: &signals,
            golden: &golden(&signals),
            design: &design(nets),
            reserved: [Some("clk"), Some("rst")],
            map: &map,
        };
        let pairs = sides.pairs().map_err(|fault| fault.to_string())?;
        let line = |pair: &Pair| {
            let Part {
                net,
                low,
                width,
                invert,
            } = &pair.part;
            let invert = if *invert { "!" } else { "" };
            format!(
                "{} = {invert}{net}[{low}+{width}]",
                signals[pair.signal].path
            )
        };
        let lines = pairs.inputs.iter().chain(&pairs.held).map(line).collect();
        let path = |index: &usize| signals[*index].path.clone();
        Ok((lines, pairs.ports_without.iter().map(path).collect()))
    }

    #[test]
    fn registers_and_ports_pair_by_name_and_width() {
        let nets = [
            ("rst", 1, 'i'),
            ("half_period", 4, 'i'),
            ("Period", 4, 'i'),
            ("step", 1, 'o'),
            ("counter_count", 4, 'r'),
            // Another width, and no register.
            ("held_period", 5, 'r'),
            ("generator.count", 4, 'w'),
        ];
        let (lines, without) = pairs("unit_law", &["width=4"], &nets, "").unwrap();
        let expected = [
            "half_period = half_period[0+4]",
            "period = Period[0+4]",
            "counter.count = counter_count[0+4]",
            "step = step[0+1]",
        ];
        assert_eq!(lines, expected);
        assert!(without.is_empty());
        // A net is no port, and the reset is no partner.
        let nets = [("rst", 1, 'i'), ("period", 4, 'w'), ("step", 1, 'w')];
        let (lines, without) = pairs("unit_law", &["width=4"], &nets, "").unwrap();
        assert_eq!(lines, ["step = step[0+1]"]);
        assert_eq!(without, ["half_period", "period"]);
    }

    #[test]
    fn two_registers_of_one_name_pair_with_none_unless_one_is_exact() {
        let mut nets = vec![
            ("half_period", 4, 'i'),
            ("period", 4, 'i'),
            ("step", 1, 'o'),
            ("counter_count", 4, 'r'),
            ("COUNTER.count", 4, 'r'),
        ];
        let ambiguous = pairs("unit_law", &["width=4"], &nets, "").unwrap().0;
        assert_eq!(ambiguous.len(), 3);
        nets.push(("counter.count", 4, 'r'));
        let exact = pairs("unit_law", &["width=4"], &nets, "").unwrap().0;
        assert!(exact.contains(&"counter.count = counter.count[0+4]".to_owned()));
    }

    const BENCH: [(&str, usize, char); 5] = [
        ("bus", 8, 'i'),
        ("line_n", 1, 'o'),
        ("u_timer.cnt", 4, 'r'),
        ("u_edges.cnt", 4, 'r'),
        ("u_edges.count", 4, 'r'),
    ];

    const MAP: &str = "\
        [scopes]\n\"unit_law.generator\" = \"tb.dut.u_edges\"\n[signals]\n\
        \"unit_law.half_period\" = \"tb.dut.bus[7:4]\"\n\"unit_law.period\" = \"bus[3:0]\"\n\
        \"unit_law.step\" = \"!tb.dut.line_n\"\n\"counter.count\" = \"tb.dut.u_timer.cnt\"\n";

    #[test]
    fn a_map_pairs_parts_inverted_signals_and_scopes() {
        let (lines, without) = pairs("unit_law", &["width=4"], &BENCH, MAP).unwrap();
        let expected = [
            "half_period = bus[4+4]",
            "period = bus[0+4]",
            "counter.count = u_timer.cnt[0+4]",
            "generator.count = u_edges.count[0+4]",
            "step = !line_n[0+1]",
        ];
        assert_eq!(lines, expected);
        assert!(without.is_empty());
        let left = MAP.replace("[scopes]", "leave = [\"unit_law.period\"]\n[scopes]");
        let left = left.replace("\"unit_law.period\" = \"bus[3:0]\"\n", "");
        let (lines, without) = pairs("unit_law", &["width=4"], &BENCH, &left).unwrap();
        assert_eq!((lines.len(), without.len()), (4, 0));
    }

    #[test]
    fn wrong_lines_of_a_map_are_refused() {
        let refusal = |from: &str, to: &str| {
            assert!(MAP.contains(from), "{from}");
            pairs("unit_law", &["width=4"], &BENCH, &MAP.replace(from, to)).unwrap_err()
        };
        assert_eq!(
            refusal("tb.dut.bus[7:4]", "tb.dut.bus[7:3]"),
            "m.toml:4: unit_law.half_period: tb.dut.bus[7:3] has 5 bits; allowed: 4 bits, as \
             half_period has"
        );
        assert_eq!(
            refusal("tb.dut.bus[7:4]", "tb.dut.bus[8:5]"),
            "m.toml:4: unit_law.half_period: tb.dut.bus[8:5] is no part of the signal; allowed: 8 \
             bits of bus"
        );
        assert_eq!(
            refusal("tb.dut.bus[7:4]", "u_timer.cnt"),
            "m.toml:4: unit_law.half_period: u_timer.cnt is no input port of the design; allowed: \
             bus, clk"
        );
        assert_eq!(
            refusal("\"tb.dut.u_timer.cnt\"", "\"cnt\""),
            "m.toml:7: counter.count: cnt is the end of several names; allowed: u_edges.cnt, \
             u_timer.cnt"
        );
        assert_eq!(
            refusal("tb.dut.u_edges", "tb.dut.u_none"),
            "m.toml:2: unit_law.generator: no scope of the design is called tb.dut.u_none; allowed: \
             u_edges, u_timer"
        );
        let unknown = refusal("unit_law.step", "unit_law.stp");
        let start = "m.toml:6: unit_law.stp: no signal of unit_law is called so; allowed: a signal";
        assert!(unknown.starts_with(start), "{unknown}");
    }

    #[test]
    fn a_line_for_a_memory_pairs_its_words() {
        let nets = [
            ("store[0]", 4, 'r'),
            ("store[1]", 4, 'r'),
            ("store[2]", 4, 'r'),
        ];
        let map = "[signals]\n\"record_memory.records[1]\" = \"store[2]\"\n";
        let keys = ["data=4", "record=1"];
        let (lines, _) = pairs("record_memory", &keys, &nets, map).unwrap();
        assert_eq!(lines, ["records[1] = store[2][0+4]"]);
        // The design has three of the words.
        let map = "[signals]\n\"record_memory.records\" = \"dut.store\"\n";
        let refusal = pairs("record_memory", &keys, &nets, map).unwrap_err();
        assert!(
            refusal.contains("no signal of the design is called dut.store"),
            "{refusal}"
        );
    }
}
