//! Parts of a circuit and their connections, as `list` prints them.

use motion_rtl::netlist::{Kind, Shape};
use motion_rtl::registry::find;
use motion_rtl::verilog;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// The parts of a circuit and its own signals, with what drives them.
#[derive(Debug, Serialize)]
pub struct Connections {
    parts: Vec<Part>,
    outputs: Vec<Connection>,
    nets: Vec<Connection>,
    registers: Vec<Connection>,
}

#[derive(Debug, Serialize)]
struct Part {
    name: String,
    circuit: String,
    /// Patent and block of the circuit.
    source: &'static str,
    parameters: BTreeMap<String, u64>,
    inputs: Vec<Connection>,
    outputs: Vec<Signal>,
}

/// A signal by its name.
#[derive(Debug, Serialize)]
pub struct Signal {
    name: String,
    width: usize,
    /// A two's complement word.
    signed: bool,
}

#[derive(Debug, Serialize)]
struct Connection {
    #[serde(flatten)]
    signal: Signal,
    driver: String,
}

impl Signal {
    /// A signal of that shape.
    pub fn of((name, shape): (String, Shape)) -> Self {
        Signal {
            name,
            width: shape.width,
            signed: shape.kind == Kind::Signed,
        }
    }

    /// The name, with the width of a word.
    pub fn text(&self) -> String {
        match (self.width, self.signed) {
            (width, true) => format!("{}[{width}, signed]", self.name),
            (1, false) => self.name.clone(),
            (width, false) => format!("{}[{width}]", self.name),
        }
    }
}

impl Connections {
    /// Returns the connections of a circuit.
    pub fn of(connections: verilog::Connections) -> Self {
        let verilog::Connections {
            parts,
            outputs,
            nets,
            registers,
        } = connections;
        Connections {
            parts: parts.into_iter().map(part).collect(),
            outputs: driven(outputs),
            nets: driven(nets),
            registers: driven(registers),
        }
    }

    /// Returns the lines to print below the circuit's ports; none for a circuit without parts.
    pub fn text(&self) -> String {
        let mut text = String::new();
        if self.parts.is_empty() {
            return text;
        }
        text.push('\n');
        // Writing to a string does not fail.
        for part in &self.parts {
            let _ = writeln!(text, "    {}: {}", part.name, part.circuit);
            lines(&mut text, "=", &part.inputs);
            for (name, number) in &part.parameters {
                let _ = writeln!(text, "      {name} = {number}");
            }
            let outputs = part.outputs.iter().map(Signal::text);
            let outputs = outputs.collect::<Vec<_>>().join(", ");
            let _ = writeln!(text, "      out {outputs}");
        }
        let own = [
            ("out", "=", &self.outputs),
            ("nets", "=", &self.nets),
            ("at the edge", "<=", &self.registers),
        ];
        for (what, sign, own) in own.iter().filter(|(.., own)| !own.is_empty()) {
            let _ = writeln!(text, "    {what}");
            lines(&mut text, sign, own);
        }
        text
    }
}

fn lines(text: &mut String, sign: &str, connections: &[Connection]) {
    for Connection { signal, driver } in connections {
        let _ = writeln!(text, "      {} {sign} {driver}", signal.text());
    }
}

fn part(part: verilog::Part) -> Part {
    Part {
        source: find(&part.circuit).map_or("", |entry| entry.source),
        name: part.name,
        circuit: part.circuit,
        parameters: part.parameters.into_iter().collect(),
        inputs: driven(part.inputs),
        outputs: part.outputs.into_iter().map(Signal::of).collect(),
    }
}

fn driven(connections: Vec<verilog::Connection>) -> Vec<Connection> {
    let connections = connections.into_iter();
    let driven = connections.map(|connection| Connection {
        signal: Signal::of((connection.name, connection.shape)),
        driver: connection.driver,
    });
    driven.collect()
}
