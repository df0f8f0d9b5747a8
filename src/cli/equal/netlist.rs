//! A flattened design as Yosys writes it in JSON.

use serde::Deserialize;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// A flattened module: its ports and its nets with public names.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Netlist {
    /// Input ports with their widths.
    pub inputs: BTreeMap<String, usize>,
    /// Names of the output ports.
    pub outputs: BTreeSet<String>,
    pub nets: BTreeMap<String, Net>,
    /// True if the module has a flip-flop.
    pub is_clocked: bool,
    /// Number of its cells.
    pub cells: usize,
}

/// A net of a design.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Net {
    pub bits: Vec<Bit>,
    /// Declared index of the lowest bit, or of the highest one if the range ascends.
    offset: i64,
    ascends: bool,
    /// True if flip-flops drive all bits.
    pub is_register: bool,
    /// True if all bits have a power-on value.
    pub has_power_on: bool,
}

/// A bit of a net: the number of its driver, or a constant.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(untagged)]
pub enum Bit {
    Driven(u64),
    Constant(String),
}

#[derive(Deserialize)]
struct File {
    modules: BTreeMap<String, Module>,
}

#[derive(Deserialize)]
struct Module {
    ports: BTreeMap<String, Port>,
    cells: BTreeMap<String, Cell>,
    netnames: BTreeMap<String, Name>,
}

#[derive(Deserialize)]
struct Port {
    direction: String,
    bits: Vec<Bit>,
}

#[derive(Deserialize)]
struct Cell {
    #[serde(rename = "type")]
    kind: String,
    #[serde(default)]
    parameters: BTreeMap<String, Value>,
    connections: BTreeMap<String, Vec<Bit>>,
}

#[derive(Deserialize)]
struct Name {
    hide_name: u8,
    bits: Vec<Bit>,
    #[serde(default)]
    offset: i64,
    #[serde(default)]
    upto: u8,
    #[serde(default)]
    attributes: BTreeMap<String, Value>,
}

impl Net {
    pub fn width(&self) -> usize {
        self.bits.len()
    }

    /// Returns the place of a declared index, counted from the lowest bit.
    pub fn place(&self, index: i64) -> Option<usize> {
        let place = usize::try_from(index - self.offset).ok()?;
        let place = match self.ascends {
            true => self.width().checked_sub(place + 1)?,
            false => place,
        };
        (place < self.width()).then_some(place)
    }
}

impl Cell {
    /// True for a flip-flop.
    fn is_register(&self) -> bool {
        self.kind == "$dff" || self.kind.starts_with("$_DFF_")
    }

    /// True for a cell with a state that is no flip-flop at the rising edge of a clock.
    fn is_other_state(&self) -> bool {
        let kind = self.kind.to_ascii_lowercase();
        let states = ["latch", "$sr", "$_sr_", "ff", "$mem"];
        !self.is_register() && states.iter().any(|state| kind.contains(state))
    }

    fn rises(&self) -> bool {
        match self.parameters.get("CLK_POLARITY") {
            Some(Value::String(bits)) => bits.ends_with('1'),
            Some(Value::Number(number)) => number.as_u64() == Some(1),
            _ => self.kind.starts_with("$_DFF_P"),
        }
    }

    fn pin(&self, names: [&str; 2]) -> &[Bit] {
        let pin = names.iter().find_map(|name| self.connections.get(*name));
        pin.map_or(&[], Vec::as_slice)
    }
}

impl Netlist {
    /// Reads the module `name` of a file, all of whose flip-flops take the rising edge of the port
    /// `clock`.
    ///
    /// # Errors
    /// Returns the problem: the file cannot be read, or a register is clocked in another way.
    pub fn read(text: &str, name: &str, clock: &str) -> Result<Self, String> {
        let file: File = serde_json::from_str(text).map_err(|error| error.to_string())?;
        let module = file.modules.get(name);
        let module = module.ok_or_else(|| format!("there is no module {name}"))?;
        let clock = module.ports.get(clock).map(|port| &port.bits[..]);
        let mut registers = BTreeSet::new();
        for cell in module.cells.values() {
            let outputs = cell.pin(["Q", "RD_DATA"]);
            let named = || module.name_of(outputs);
            if cell.is_other_state() {
                return Err(format!(
                    "{} is no flip-flop of a clock ({})",
                    named(),
                    cell.kind
                ));
            }
            if !cell.is_register() {
                continue;
            }
            if Some(cell.pin(["CLK", "C"])) != clock || !cell.rises() {
                let by = module.name_of(cell.pin(["CLK", "C"]));
                let edge = if cell.rises() { "rising" } else { "falling" };
                return Err(format!("{} takes the {edge} edge of {by}", named()));
            }
            registers.extend(outputs);
        }
        let known = module.power_on();
        let net = |name: &Name| Net {
            bits: name.bits.clone(),
            offset: name.offset,
            ascends: name.upto != 0,
            is_register: name.bits.iter().all(|bit| registers.contains(bit)),
            has_power_on: name.bits.iter().all(|bit| known.contains(bit)),
        };
        let public = module.netnames.iter().filter(|(_, net)| net.hide_name == 0);
        let ports = |direction: &'static str| {
            let ports = module.ports.iter();
            ports.filter(move |(_, port)| port.direction == direction)
        };
        Ok(Netlist {
            inputs: ports("input")
                .map(|(name, port)| (name.clone(), port.bits.len()))
                .collect(),
            outputs: ports("output").map(|(name, _)| name.clone()).collect(),
            nets: public.map(|(name, of)| (name.clone(), net(of))).collect(),
            is_clocked: !registers.is_empty(),
            cells: module.cells.len(),
        })
    }
}

impl Module {
    /// Returns the public name of a net, or of one with its first bit.
    fn name_of(&self, bits: &[Bit]) -> String {
        let mut names = self.netnames.iter().filter(|(_, net)| net.hide_name == 0);
        let first = bits.first();
        let whole = names.clone().find(|(_, net)| net.bits == bits);
        let found = whole.or_else(|| names.find(|(_, net)| net.bits.first() == first));
        found
            .map_or("a net without a name", |(name, _)| name)
            .to_owned()
    }

    /// Returns the bits with a power-on value.
    fn power_on(&self) -> BTreeSet<&Bit> {
        let mut known = BTreeSet::new();
        for net in self.netnames.values() {
            let Some(Value::String(values)) = net.attributes.get("init") else {
                continue;
            };
            let values = values.chars().rev();
            let bits = net.bits.iter().zip(values);
            known.extend(bits.filter(|(_, value)| *value != 'x').map(|(bit, _)| bit));
        }
        known
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A register `count` of two bits with the power-on value `init`, clocked by `clk`.
    fn counter(kind: &str, clock: u64, polarity: &str, init: &str) -> String {
        format!(
            r#"{{"modules": {{"design": {{
                "ports": {{"clk": {{"direction": "input", "bits": [2]}},
                           "en": {{"direction": "input", "bits": [3]}},
                           "n": {{"direction": "output", "bits": [4, 5]}}}},
                "cells": {{"$1": {{"type": "{kind}", "parameters": {{"CLK_POLARITY": "{polarity}"}},
                           "connections": {{"CLK": [{clock}], "D": [6, 7], "Q": [4, 5]}}}}}},
                "netnames": {{"clk": {{"hide_name": 0, "bits": [2]}},
                              "en": {{"hide_name": 0, "bits": [3]}},
                              "count": {{"hide_name": 0, "bits": [4, 5], "offset": 3,
                                         "attributes": {{"init": "{init}"}}}},
                              "n": {{"hide_name": 0, "bits": [4, 5], "upto": 1}},
                              "mixed": {{"hide_name": 0, "bits": [4, "0"]}},
                              "$auto": {{"hide_name": 1, "bits": [6, 7]}}}}}}}}}}"#
        )
    }

    #[test]
    fn registers_are_what_flip_flops_drive() {
        let text = counter("$dff", 2, "1", "x0");
        let netlist = Netlist::read(&text, "design", "clk").unwrap();
        let registers = netlist.nets.iter().filter(|(_, net)| net.is_register);
        let registers: Vec<&str> = registers.map(|(name, _)| &**name).collect();
        assert_eq!(registers, ["count", "n"]);
        assert!(netlist.is_clocked);
        assert!(!netlist.nets["count"].has_power_on);
        let text = counter("$dff", 2, "1", "10");
        let netlist = Netlist::read(&text, "design", "clk").unwrap();
        // A name for the same bits has the same power-on value.
        assert!(netlist.nets["n"].has_power_on);
        assert!(!netlist.nets.contains_key("$auto"));
        assert_eq!(netlist.inputs["en"], 1);
        assert_eq!(netlist.outputs.iter().collect::<Vec<_>>(), ["n"]);
    }

    #[test]
    fn bits_are_counted_from_the_lowest() {
        let text = counter("$dff", 2, "1", "10");
        let netlist = Netlist::read(&text, "design", "clk").unwrap();
        let places = |name: &str| [0, 1, 3, 4, 5].map(|index| netlist.nets[name].place(index));
        assert_eq!(places("count"), [None, None, Some(0), Some(1), None]);
        assert_eq!(places("n"), [Some(1), Some(0), None, None, None]);
    }

    #[test]
    fn other_clocks_edges_and_states_are_refused() {
        let refusal = |kind, clock, polarity| {
            let text = counter(kind, clock, polarity, "00");
            Netlist::read(&text, "design", "clk").unwrap_err()
        };
        assert_eq!(refusal("$dff", 3, "1"), "count takes the rising edge of en");
        assert_eq!(
            refusal("$dff", 2, "0"),
            "count takes the falling edge of clk"
        );
        assert_eq!(
            refusal("$dlatch", 2, "1"),
            "count is no flip-flop of a clock ($dlatch)"
        );
        assert_eq!(
            refusal("$mem_v2", 2, "1"),
            "count is no flip-flop of a clock ($mem_v2)"
        );
        assert_eq!(
            refusal("$adff", 2, "1"),
            "count is no flip-flop of a clock ($adff)"
        );
    }
}
