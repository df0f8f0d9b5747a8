//! The miter: circuit and design side by side on the same inputs, with assertions that paired
//! signals are equal.

use super::invariants::Invariant;
use super::netlist::Netlist;
use super::pairs::{Pair, Pairs, Part};
use motion_rtl::sim::{PortDirection, SignalInfo};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Circuit and design side by side, with the same inputs and with assertions that pairs are equal.
#[derive(Debug, Clone, Copy)]
pub struct Miter<'a> {
    pub circuit: &'a str,
    pub signals: &'a [SignalInfo],
    pub golden: &'a Netlist,
    pub design: &'a Netlist,
    pub pairs: &'a Pairs,
    /// Clock of the design.
    pub clock: &'a str,
    /// Reset of the design, and true if it is active low.
    pub reset: Option<(&'a str, bool)>,
    /// True to compare only after the first tick of a reset.
    pub after_reset: bool,
    /// Statements about the circuit alone that are proved along.
    pub invariants: &'a [Invariant],
}

/// Nets that the miter reads, with the names of its wires.
struct Wires<'a>(BTreeMap<&'a str, String>);

impl<'a> Wires<'a> {
    fn of(side: &str, nets: impl Iterator<Item = &'a str>) -> Self {
        let mut wires = BTreeMap::new();
        for net in nets {
            let number = wires.len();
            wires
                .entry(net)
                .or_insert_with(|| format!("{side}_{number}"));
        }
        Wires(wires)
    }

    /// Returns the command of Yosys that makes nets into output ports.
    fn exposed(&self, side: &str, netlist: &Netlist) -> String {
        let mut text = String::new();
        for net in self.0.keys() {
            if !netlist.outputs.contains(*net) && !netlist.inputs.contains_key(*net) {
                // Writing to a string does not fail.
                let _ = writeln!(text, "expose {side}/w:{net}");
            }
        }
        text
    }
}

/// Each input port of the design with the expression that drives it; and the extra ports of the
/// miter, for bits that have any value, with their widths.
type Driven<'a> = (Vec<(&'a str, String)>, Vec<(String, usize)>);

/// Returns the declaration of an input port.
fn input(name: &str, width: usize) -> String {
    format!("input wire {}{}", range(width), identifier(name))
}

/// Returns a range in a declaration.
fn range(width: usize) -> String {
    match width {
        1 => String::new(),
        _ => format!("[{}:0] ", width - 1),
    }
}

impl Part {
    /// Returns the part of a wire of `width` bits.
    fn of(&self, wire: &str, width: usize) -> String {
        let invert = if self.invert { "~" } else { "" };
        match (self.width == width, self.width) {
            (true, _) => format!("{invert}{wire}"),
            (false, 1) => format!("{invert}{wire}[{}]", self.low),
            (false, _) => format!("{invert}{wire}[{}:{}]", self.low + self.width - 1, self.low),
        }
    }
}

impl Miter<'_> {
    fn signal(&self, pair: &Pair) -> &SignalInfo {
        &self.signals[pair.signal]
    }

    fn wires(&self) -> [Wires<'_>; 2] {
        let held = self.pairs.held.iter();
        let own = held.clone().map(|pair| pair.signal);
        let own = own.chain(self.invariants.iter().flat_map(Invariant::signals));
        [
            Wires::of("golden", own.map(|index| &*self.signals[index].verilog)),
            Wires::of("design", held.map(|pair| &*pair.part.net)),
        ]
    }

    /// Returns the wires of the circuit's signals in the text of [`alone`](Self::alone).
    pub fn alone_wires(&self) -> BTreeMap<usize, String> {
        let none = Pairs::default();
        let miter = Miter {
            pairs: &none,
            ..*self
        };
        let [golden, _] = miter.wires();
        let signals = self.invariants.iter().flat_map(Invariant::signals);
        signals
            .map(|index| (index, golden.0[&*self.signals[index].verilog].clone()))
            .collect()
    }

    /// Returns the assertions of the invariants.
    fn stated(&self, golden: &Wires<'_>) -> String {
        let wire = |index: usize| golden.0[&*self.signals[index].verilog].clone();
        let invariants = self.invariants.iter();
        invariants
            .map(|invariant| format!("        assert ({});\n", invariant.verilog(wire)))
            .collect()
    }

    /// Returns the circuit alone with the invariants, and the commands that expose its registers.
    pub fn alone(&self) -> (String, String) {
        let none = Pairs::default();
        let miter = Miter {
            pairs: &none,
            ..*self
        };
        let [golden, _] = miter.wires();
        let mut ports = vec!["input wire clk".to_owned(), "input wire rst".to_owned()];
        ports.extend(
            self.inputs()
                .map(|signal| input(&signal.verilog, signal.width())),
        );
        let mut connections: Vec<String> = self
            .golden
            .inputs
            .keys()
            .map(|port| connection(port, &identifier(port)))
            .collect();
        let mut wires = String::new();
        for (net, wire) in &golden.0 {
            let width = self.golden.nets.get(*net).map_or(1, |net| net.width());
            // Writing to a string does not fail.
            let _ = writeln!(wires, "    wire {}{wire};", range(width));
            connections.push(connection(net, wire));
        }
        let text = format!(
            "module miter (\n    {}\n);\n\n{wires}\n    golden golden (\n{}\n    );\n\n    always @* \
             begin\n{}    end\n\nendmodule\n",
            ports.join(",\n    "),
            connections.join(",\n"),
            miter.stated(&golden)
        );
        (text, golden.exposed("golden", self.golden))
    }

    /// Returns the commands of Yosys that make the registers of both sides into ports.
    pub fn exposed(&self) -> String {
        let [golden, design] = self.wires();
        golden.exposed("golden", self.golden) + &design.exposed("design", self.design)
    }

    /// Returns the inputs of the circuit, without clock and reset.
    fn inputs(&self) -> impl Iterator<Item = &SignalInfo> {
        let signals = self.signals.iter();
        signals.filter(|signal| signal.port == Some(PortDirection::In))
    }

    /// Returns the input ports of the design with a bit that no port of the circuit drives.
    pub fn free(&self) -> Vec<&str> {
        let inputs = self.design.inputs.keys();
        let free = inputs.filter(|port| self.pieces(port).iter().any(|piece| piece.1.is_none()));
        free.map(String::as_str).collect()
    }

    /// Returns what drives an input port of the design, from the highest bit down: a number of bits
    /// and the pair; free bits have none.
    fn pieces(&self, port: &str) -> Vec<(usize, Option<&Pair>)> {
        if port == self.clock || self.reset.is_some_and(|(reset, _)| reset == port) {
            return Vec::new();
        }
        let inputs = self.pairs.inputs.iter();
        let mut parts: Vec<&Pair> = inputs.filter(|pair| pair.part.net == port).collect();
        parts.sort_by_key(|pair| pair.part.low);
        let mut pieces = Vec::new();
        let mut place = 0;
        for pair in parts {
            if pair.part.low > place {
                pieces.push((pair.part.low - place, None));
            }
            // Two ports of the circuit for the same bits: the first has them.
            if pair.part.low >= place {
                pieces.push((pair.part.width, Some(pair)));
                place = pair.part.low + pair.part.width;
            }
        }
        let width = self.design.inputs.get(port).copied().unwrap_or(place);
        if width > place {
            pieces.push((width - place, None));
        }
        pieces.reverse();
        pieces
    }

    fn driven(&self) -> Driven<'_> {
        let (mut inputs, mut free) = (Vec::new(), Vec::new());
        for (number, (port, width)) in self.design.inputs.iter().enumerate() {
            let pieces = self.pieces(port);
            if pieces.iter().any(|piece| piece.1.is_none()) {
                free.push((format!("free_{number}"), *width));
            }
            let mut place = *width;
            let drivers: Vec<String> = pieces
                .iter()
                .map(|(count, pair)| {
                    place -= count;
                    match pair {
                        Some(pair) if pair.part.invert => {
                            format!("~{}", identifier(&self.signal(pair).verilog))
                        }
                        Some(pair) => identifier(&self.signal(pair).verilog),
                        None if count == width => format!("free_{number}"),
                        None => format!("free_{number}[{}:{place}]", place + count - 1),
                    }
                })
                .collect();
            let driver = match (port == self.clock, self.reset) {
                (true, _) => "clk".to_owned(),
                (_, Some((reset, low))) if reset == port => {
                    if low { "~rst" } else { "rst" }.to_owned()
                }
                _ => format!("{{{}}}", drivers.join(", ")),
            };
            inputs.push((port.as_str(), driver));
        }
        (inputs, free)
    }

    /// Returns the design alone; the words of a file, one a tick, are the reset and the inputs. Free
    /// bits are low.
    pub fn driven_by(&self, file: &str, ticks: u64) -> String {
        let (inputs, free) = self.driven();
        let mut wires = String::from("    wire rst;\n");
        let mut names: Vec<&str> = Vec::new();
        let mut bits = 1;
        for signal in self.inputs() {
            let width = signal.width();
            // Writing to a string does not fail.
            let _ = writeln!(wires, "    wire {}{};", range(width), signal.verilog);
            names.push(&signal.verilog);
            bits += width;
        }
        names.push("rst");
        names.reverse();
        for (name, width) in &free {
            let _ = writeln!(wires, "    wire {}{name} = 0;", range(*width));
        }
        let inputs = inputs.iter().map(|(port, driver)| connection(port, driver));
        format!(
            "module miter (\n    input wire clk\n);\n\n    reg [31:0] tick = 0;\n    reg [{}:0] words \
             [0:{}];\n    initial $readmemh(\"{file}\", words);\n    always @(posedge clk)\n        \
             tick <= tick + 1;\n\n{wires}    assign {{{}}} = words[tick];\n\n    design design \
             (\n{}\n    );\n\nendmodule\n",
            bits - 1,
            ticks - 1,
            names.join(", "),
            inputs.collect::<Vec<_>>().join(",\n")
        )
    }

    /// Returns the text of the miter.
    pub fn text(&self) -> String {
        let [golden, design] = self.wires();
        let mut ports = vec!["input wire clk".to_owned(), "input wire rst".to_owned()];
        for signal in self.inputs() {
            ports.push(input(&signal.verilog, signal.width()));
        }
        let (inputs, free) = self.driven();
        ports.extend(free.iter().map(|(name, width)| input(name, *width)));
        let mut text = format!(
            "// Miter of {} and a design: equal inputs, and assertions that paired signals are equal.\n\
             // Made by motion-rtl.\n\nmodule miter (\n    {}\n);\n\n",
            self.circuit,
            ports.join(",\n    ")
        );
        let mut declare = |wires: &Wires<'_>, netlist: &Netlist| {
            for (net, wire) in &wires.0 {
                let width = netlist.nets.get(*net).map_or(1, |net| net.width());
                // Writing to a string does not fail.
                let _ = writeln!(text, "    wire {}{wire};", range(width));
            }
        };
        declare(&golden, self.golden);
        declare(&design, self.design);
        // A design without reset is compared with a circuit that gets none.
        let rst = if self.reset.is_some() { "rst" } else { "1'b0" };
        let mut own = Vec::new();
        for port in self.golden.inputs.keys() {
            let driver = match port.as_str() {
                "rst" => rst.to_owned(),
                port => identifier(port),
            };
            own.push(connection(port, &driver));
        }
        let outputs = |wires: &Wires<'_>, netlist: &Netlist| -> Vec<String> {
            // An input port is read where it is driven.
            let nets = wires.0.iter();
            let nets = nets.filter(|(net, _)| !netlist.inputs.contains_key(**net));
            nets.map(|(net, wire)| connection(net, wire)).collect()
        };
        own.extend(outputs(&golden, self.golden));
        let mut others: Vec<String> = inputs
            .iter()
            .map(|(port, driver)| connection(port, driver))
            .collect();
        others.extend(outputs(&design, self.design));
        for (side, wires, netlist) in [
            ("golden", &golden, self.golden),
            ("design", &design, self.design),
        ] {
            for (net, wire) in &wires.0 {
                if !netlist.inputs.contains_key(*net) {
                    continue;
                }
                let driver = match side {
                    "golden" => identifier(net),
                    _ => inputs
                        .iter()
                        .find(|(port, _)| port == net)
                        .map_or_else(String::new, |(_, driver)| driver.clone()),
                };
                let _ = writeln!(text, "    assign {wire} = {driver};");
            }
        }
        let _ = write!(
            text,
            "\n    golden golden (\n{}\n    );\n\n    design design (\n{}\n    );\n\n",
            own.join(",\n"),
            others.join(",\n")
        );
        let begun = match self.after_reset {
            false => "",
            true => {
                text += "    // High after the first tick of a reset.\n    reg begun = 1'b0;\n    \
                         always @(posedge clk)\n        begun <= begun || rst;\n\n";
                "!begun || "
            }
        };
        text += "    always @* begin\n";
        for pair in &self.pairs.held {
            let signal = self.signal(pair);
            let width = self.design.nets.get(&pair.part.net);
            let width = width.map_or(pair.part.width, |net| net.width());
            let (own, other) = (&golden.0[&*signal.verilog], &design.0[&*pair.part.net]);
            let other = pair.part.of(other, width);
            let _ = writeln!(
                text,
                "        assert ({begun}{own} == {other}); // {}",
                signal.path
            );
        }
        if !self.invariants.is_empty() {
            text += "        // Values that the circuit's registers do not have.\n";
            text += &self.stated(&golden);
        }
        text + "    end\n\nendmodule\n"
    }
}

/// Returns a name in Verilog; ports of parts have dots.
fn identifier(name: &str) -> String {
    match name.contains('.') {
        true => format!("\\{name} "),
        false => name.to_owned(),
    }
}

/// Returns a connection of a port; names of flattened designs have dots.
fn connection(port: &str, driver: &str) -> String {
    format!("        .\\{port} ({driver})")
}

#[cfg(test)]
mod tests {
    use super::super::pairs::tests::{design, golden};
    use super::*;
    use motion_rtl::Model;

    #[test]
    fn parts_are_joined_inverted_and_held_equal() {
        let signals = Model::new("unit_law", &["width=4".parse().unwrap()])
            .unwrap()
            .signals();
        let design = design(&[
            ("bus", 12, 'i'),
            ("rst_n", 1, 'i'),
            ("word", 9, 'r'),
            ("line_n", 1, 'o'),
        ]);
        let index = |path: &str| {
            signals
                .iter()
                .position(|signal| signal.path == path)
                .unwrap()
        };
        let pair = |path: &str, net: &str, low, width, invert| Pair {
            signal: index(path),
            part: Part {
                net: net.to_owned(),
                low,
                width,
                invert,
            },
        };
        let pairs = Pairs {
            inputs: vec![
                pair("half_period", "bus", 6, 4, true),
                pair("period", "bus", 0, 4, false),
            ],
            held: vec![
                pair("counter.count", "word", 5, 4, false),
                pair("step", "line_n", 0, 1, true),
                pair("sync.step", "word", 2, 1, true),
            ],
            ..Pairs::default()
        };
        let invariants = [Invariant {
            signal: index("held_period"),
            value: 0,
            state: None,
        }];
        let mut miter = Miter {
            circuit: "unit_law",
            signals: &signals,
            golden: &golden(&signals),
            design: &design,
            pairs: &pairs,
            clock: "clk",
            reset: Some(("rst_n", true)),
            after_reset: false,
            invariants: &invariants,
        };
        let text = miter.text();
        for line in [
            // Free bits at both sides of the inverted part.
            "        .\\bus ({free_0[11:10], ~half_period, free_0[5:4], period})",
            "        .\\rst_n (~rst)",
            "        .\\counter.count (golden_0)",
            "        assert (golden_0 == design_0[8:5]); // counter.count",
            "        assert (golden_1 == ~design_1); // step",
            "        assert (golden_2 == ~design_0[2]); // sync.step",
            "        assert (golden_3 != 0);",
        ] {
            assert!(text.contains(line), "{line}\n{text}");
        }
        assert_eq!(miter.free(), ["bus"]);
        let driven = miter.driven_by("words", 5);
        for line in [
            "    reg [8:0] words [0:4];",
            "    assign {rst, period, half_period} = words[tick];",
            "    wire [11:0] free_0 = 0;",
            "        .\\rst_n (~rst)",
        ] {
            assert!(driven.contains(line), "{line}\n{driven}");
        }
        let exposed = "expose golden/w:counter.count\nexpose golden/w:held_period\n\
                       expose golden/w:sync.step\nexpose design/w:word\n";
        assert_eq!(miter.exposed(), exposed);
        miter.after_reset = true;
        let line = "        assert (!begun || golden_1 == ~design_1); // step";
        assert!(miter.text().contains(line));
        // An invariant of the circuit needs no reset.
        assert!(miter.text().contains("        assert (golden_3 != 0);"));
        let (alone, exposed) = miter.alone();
        assert!(
            alone.contains("assert (golden_0 != 0);") && !alone.contains("design"),
            "{alone}"
        );
        assert_eq!(exposed, "expose golden/w:held_period\n");
    }
}
