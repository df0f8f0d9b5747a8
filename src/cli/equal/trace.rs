//! A run from power-on to a difference, as Yosys finds it.

use super::netlist::Netlist;
use motion_rtl::netlist::Module;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Values of the nets of a miter, tick by tick.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Trace {
    /// Bits of each net in each tick, the highest first.
    nets: BTreeMap<String, Vec<String>>,
    pub ticks: usize,
}

impl Trace {
    /// Reads a VCD of Yosys, whose time stamps are ticks; the last one ends the dump.
    pub fn read(text: &str) -> Self {
        let mut names: BTreeMap<&str, &str> = BTreeMap::new();
        let mut now: BTreeMap<&str, &str> = BTreeMap::new();
        let mut trace = Trace::default();
        let mut stamped = false;
        let finish = |now: &mut BTreeMap<&str, &str>, trace: &mut Trace| {
            if now.is_empty() {
                return;
            }
            for (net, bits) in std::mem::take(now) {
                let values = trace.nets.entry(net.to_owned()).or_default();
                // A net that was not dumped since stays.
                let last = values.last().cloned().unwrap_or_else(|| bits.to_owned());
                values.resize(trace.ticks, last);
                values.push(bits.to_owned());
            }
            trace.ticks += 1;
        };
        for line in text.lines() {
            let words: Vec<&str> = line.split_whitespace().collect();
            match words[..] {
                ["$var", _, _, id, name, ..] => {
                    names.insert(id, name.strip_prefix('\\').unwrap_or(name));
                }
                [stamp] if stamp.starts_with('#') => {
                    if stamped {
                        finish(&mut now, &mut trace);
                    }
                    stamped = true;
                }
                [bits, id] if bits.starts_with('b') => {
                    if let Some(name) = names.get(id) {
                        now.insert(name, &bits[1..]);
                    }
                }
                [value] if value.starts_with(['0', '1', 'x']) => {
                    let (bit, id) = value.split_at(1);
                    if let Some(name) = names.get(id) {
                        now.insert(name, bit);
                    }
                }
                _ => {}
            }
        }
        finish(&mut now, &mut trace);
        trace
    }

    /// Reads a VCD of a simulation by Yosys, whose clock rises every 10 units and falls between.
    pub fn simulated(text: &str) -> Self {
        let falls = |line: &&str| line.starts_with('#') && line.ends_with('5');
        let lines: Vec<&str> = text.lines().filter(|line| !falls(line)).collect();
        Self::read(&lines.join("\n"))
    }

    /// Adds a net of the design by the values of another one with the same driver: a simulation by
    /// Yosys dumps one name of each.
    pub fn add(&mut self, net: &str, design: &Netlist) {
        let name = |net: &str| format!("design.{net}");
        let Some(own) = design.nets.get(net) else {
            return;
        };
        if self.nets.contains_key(&name(net)) {
            return;
        }
        let mut nets = design.nets.iter();
        let values = nets.find_map(|(other, of)| {
            let values = self.nets.get(&name(other))?;
            (of.bits == own.bits).then(|| values.clone())
        });
        if let Some(values) = values {
            self.nets.insert(name(net), values);
        }
    }

    /// Leaves only the first ticks.
    pub fn cut(&mut self, ticks: usize) {
        self.ticks = self.ticks.min(ticks);
    }

    /// Returns the first tick of a reset.
    pub fn first_reset(&self) -> Option<usize> {
        (0..self.ticks).find(|tick| self.bits("rst", *tick) == Some("1"))
    }

    /// Returns the bits of a net in a tick, the highest first.
    pub fn bits(&self, net: &str, tick: usize) -> Option<&str> {
        let values = self.nets.get(net)?;
        values.get(tick).or(values.last()).map(String::as_str)
    }

    /// Returns the inputs as a stimulus of a circuit; `resets` if its reset was driven.
    pub fn stimulus(&self, module: &Module, resets: bool) -> String {
        let ports: Vec<_> = module.inputs().collect();
        let mut text = String::new();
        // A stimulus has two ticks at least.
        for tick in 0..self.ticks.max(2) {
            let rst = self.bits("rst", tick).unwrap_or("0");
            let mut bits = if resets { rst } else { "0" }.to_owned();
            for port in ports.iter().rev() {
                let width = port.shape.width;
                let value = self.bits(&port.name, tick).unwrap_or_default();
                let _ = write!(bits, "{value:0>width$}");
            }
            text += &hexadecimal(&bits);
            text.push('\n');
        }
        text
    }

    /// Returns the waves of the design as a VCD with a clock, `miter.clk`.
    pub fn waves(&self, clocks: &[&str]) -> String {
        let shown = |net: &&String| net.starts_with("design.") && !clocks.contains(&&net[7..]);
        let nets: Vec<&String> = self.nets.keys().filter(shown).collect();
        let mut text = String::from("$timescale 1 ns $end\n$scope module miter $end\n");
        text += "$var wire 1 ! clk $end\n";
        let mut open: Vec<&str> = Vec::new();
        let mut sorted: Vec<(Vec<&str>, usize)> = nets
            .iter()
            .enumerate()
            .map(|(index, net)| (net.split('.').collect(), index))
            .collect();
        // The signals of a scope before the scopes in it.
        sorted.sort_by(|(a, _), (b, _)| {
            let (a, b) = (a.split_last(), b.split_last());
            a.map(|(name, scopes)| (scopes, name))
                .cmp(&b.map(|(name, scopes)| (scopes, name)))
        });
        for (path, index) in &sorted {
            let (name, scopes) = path.split_last().unwrap_or((&"", &[]));
            let common = open.iter().zip(scopes).take_while(|(a, b)| a == b).count();
            for _ in common..open.len() {
                text += "$upscope $end\n";
            }
            open.truncate(common);
            for scope in &scopes[common..] {
                let _ = writeln!(text, "$scope module {scope} $end");
                open.push(scope);
            }
            let width = self.bits(nets[*index], 0).map_or(1, str::len);
            let _ = writeln!(text, "$var wire {width} n{index} {name} $end");
        }
        for _ in &open {
            text += "$upscope $end\n";
        }
        text += "$upscope $end\n$enddefinitions $end\n";
        for tick in 0..self.ticks {
            let time = 10 * tick;
            let _ = writeln!(text, "#{time}\n0!");
            for (index, net) in nets.iter().enumerate() {
                let bits = self.bits(net, tick).unwrap_or("x");
                let _ = match bits.len() {
                    1 => writeln!(text, "{bits}n{index}"),
                    _ => writeln!(text, "b{bits} n{index}"),
                };
            }
            let _ = writeln!(text, "#{}\n1!", time + 5);
        }
        let _ = writeln!(text, "#{}", 10 * self.ticks);
        text
    }
}

/// Converts bits, the highest first, to hexadecimal.
fn hexadecimal(bits: &str) -> String {
    let pad = (4 - bits.len() % 4) % 4;
    let bits = "0".repeat(pad) + &bits.replace('x', "0");
    let digits = bits.as_bytes().chunks(4).map(|four| {
        let value = four
            .iter()
            .fold(0, |value, bit| value << 1 | u32::from(bit & 1));
        char::from_digit(value, 16).unwrap_or('0')
    });
    digits.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_net_has_the_values_of_its_driver() {
        let text = r#"{"modules": {"design": {"ports": {}, "cells": {}, "netnames": {
            "other": {"hide_name": 0, "bits": [3]}, "own": {"hide_name": 0, "bits": [2]},
            "port": {"hide_name": 0, "bits": [2]}, "none": {"hide_name": 0, "bits": [4]}}}}}"#;
        let design = Netlist::read(text, "design", "clk").unwrap();
        let dump = "$var wire 1 a design.other $end\n$var wire 1 b design.own $end\n\
                    #0\nb0 a\nb1 b\n#10\n";
        let mut trace = Trace::read(dump);
        for net in ["port", "none", "other", "unknown"] {
            trace.add(net, &design);
        }
        let bits = |net: &str| trace.bits(net, 0);
        assert_eq!(bits("design.port"), Some("1"));
        assert_eq!(bits("design.other"), Some("0"));
        assert_eq!(bits("design.none"), None);
    }

    /// A dump as Yosys 0.23 writes it: the state at power-on, then the first tick.
    const DUMP: &str = "\
$scope module \\miter $end
$var wire 3 v0 \\design.count $end
$var wire 1 v1 \\design.clk $end
$var wire 1 v2 \\rst $end
$var wire 2 v3 \\design.u.n $end
$upscope $end
$enddefinitions $end
$dumpvars
#0
b000 v0
b000 v0
0v1
1v2
b01 v3
#2
b110 v0
0v1
0v2
b11 v3
#3
";

    #[test]
    fn a_time_stamp_is_a_tick() {
        let trace = Trace::read(DUMP);
        assert_eq!(trace.ticks, 2);
        assert_eq!(trace.bits("design.count", 0), Some("000"));
        assert_eq!(trace.bits("design.count", 1), Some("110"));
        assert_eq!(trace.bits("rst", 0), Some("1"));
        assert_eq!(trace.bits("rst", 1), Some("0"));
        assert_eq!(trace.bits("none", 0), None);
        assert_eq!(Trace::read("").ticks, 0);
    }

    #[test]
    fn a_simulation_has_a_tick_for_each_rising_edge() {
        let dump = "$var wire 1 a clk $end\n$var wire 2 b n $end\n#0\nbx a\nb00 b\n#5\nb0 a\n\
                    #10\nb1 a\nb01 b\n#15\nb0 a\n#20\nb1 a\n#25\nb0 a\n#30\nb1 a\nb10 b\n";
        let mut trace = Trace::simulated(dump);
        let values: Vec<_> = (0..4).map(|tick| trace.bits("n", tick).unwrap()).collect();
        assert_eq!(values, ["00", "01", "01", "10"]);
        assert_eq!(trace.ticks, 4);
        trace.cut(2);
        assert_eq!(trace.ticks, 2);
    }

    #[test]
    fn waves_have_a_clock_and_the_scopes_of_the_design() {
        let waves = Trace::read(DUMP).waves(&["clk"]);
        let expected = "\
$timescale 1 ns $end
$scope module miter $end
$var wire 1 ! clk $end
$scope module design $end
$var wire 3 n0 count $end
$scope module u $end
$var wire 2 n1 n $end
$upscope $end
$upscope $end
$upscope $end
$enddefinitions $end
#0
0!
b000 n0
b01 n1
#5
1!
#10
0!
b110 n0
b11 n1
#15
1!
#20
";
        assert_eq!(waves, expected);
    }

    #[test]
    fn bits_become_digits_from_the_lowest() {
        assert_eq!(hexadecimal("1"), "1");
        assert_eq!(hexadecimal("10000"), "10");
        assert_eq!(hexadecimal("1011010"), "5a");
        assert_eq!(hexadecimal("x1"), "1");
    }
}
