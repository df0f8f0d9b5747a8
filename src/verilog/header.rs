//! Parameters and ports of a module in Verilog.

use super::conversion::literal;
use super::text::{MARK, column, range};
use crate::netlist::{Module, Role, Signal, unsigned};
use crate::printed::{Modules, Parameter, annotated, comment};
use std::fmt::Write as _;

/// Unit of time of modules, in which nothing happens: with it in all of them no simulator asks which
/// one a testbench leaves to them.
const TIMESCALE: &str = "`timescale 1ns / 1ps\n";

impl Modules<'_> {
    /// Returns the parameters and ports.
    pub(super) fn header_in_verilog(&self, module: &Module, clocked: bool) -> String {
        let mut text = format!("{TIMESCALE}\nmodule {} ", module.name);
        let parameters = self.parameters(module);
        match parameters.is_empty() {
            true => text += "(\n",
            false => {
                let lines: Vec<String> = parameters
                    .iter()
                    .map(|parameter| {
                        let top = self.is_top(module);
                        let value = if top { self.number(&parameter.path) } else { 0 };
                        format!("    {}", declaration(parameter, top, value))
                    })
                    .collect();
                let _ = writeln!(text, "#(\n{}\n) (", lines.join(",\n"));
            }
        }
        let mut ports = Vec::new();
        let signals = module.signals.iter().filter(|signal| signal.is_port());
        let column = column(signals.map(|signal| signal.shape));
        if clocked {
            ports.push((format!("input  wire {:column$}clk", ""), String::new()));
            let about = "Registers to their power-on values; memories stay.";
            ports.push((format!("input  wire {:column$}rst", ""), about.to_owned()));
        }
        for signal in module.signals.iter().filter(|signal| signal.is_port()) {
            let Signal { name, shape, .. } = signal;
            let range = format!("{:column$}", range(*shape));
            let port = match signal.role {
                Role::Input => format!("input  wire {range}{name}"),
                Role::Net | Role::Register => format!("output wire {range}{name}"),
            };
            ports.push((port, comment(signal)));
        }
        let last = ports.len().saturating_sub(1);
        for (index, (port, _)) in ports.iter_mut().enumerate() {
            if index != last {
                port.push(',');
            }
        }
        for line in annotated(&ports, MARK) {
            let _ = writeln!(text, "    {line}");
        }
        text + ");\n\n"
    }
}

fn declaration(parameter: &Parameter, top: bool, value: u64) -> String {
    let name = parameter.name();
    match parameter.width {
        Some(width) => {
            let shape = unsigned(width);
            format!(
                "parameter {}{name} = {}",
                range(shape),
                literal(value, shape)
            )
        }
        None if top => {
            // A memory deep inside has a long name, twice on the line.
            let between = if name.len() > 40 { "\n        " } else { " " };
            let file = parameter.path.join("_");
            format!("parameter {name} ={between}\"{file}.hex\"")
        }
        None => format!("parameter {name} = \"\""),
    }
}
