//! Modules in Verilog.

use super::conversion::literal;
use super::expression::Expressions;
use super::memories::{memories, write_memories};
use super::rules::names;
use super::statements::edge_lines;
use super::text::{MARK, column, range};
use super::unused::unused;
use crate::netlist::{Module, Signal};
use crate::printed::{
    Body, Definition, Modules, annotated, ascii, comment, definitions, is_own_register, stored,
};
use std::fmt::Write as _;

/// The room for a definition before it is broken into lines.
const ROOM: usize = 66;

impl Modules<'_> {
    /// The text of a module.
    pub(super) fn print_in_verilog(&self, module: &Module) -> String {
        let names = names(module, self.modules);
        let expressions = Expressions::new(module, &names);
        let clocked = self.clocked(module);
        let mut text = String::new();
        let _ = writeln!(text, "// {}: {}.", module.name, ascii(module.about));
        let _ = writeln!(text, "// Made by motion-rtl from the circuit of that name.");
        text.push('\n');
        text += &self.header_in_verilog(module, clocked);

        let mut body = Body::new(MARK);
        memories(module, &mut body);
        let inner = module
            .signals
            .iter()
            .filter(|signal| is_own_register(signal));
        let inner: Vec<&Signal> = inner.collect();
        let column = column(inner.iter().map(|signal| signal.shape));
        let registers: Vec<(String, String)> = inner
            .iter()
            .map(|signal| {
                let power_on = literal(signal.power_on, signal.shape);
                let range = format!("{:column$}", range(signal.shape));
                // A port is described where it stands.
                let comment = match signal.is_port() {
                    true => String::new(),
                    false => comment(signal),
                };
                (
                    format!("reg  {range}{} = {power_on};", stored(signal)),
                    comment,
                )
            })
            .collect();
        for line in annotated(&registers, MARK) {
            body.line(&line);
        }
        for (signal, behind) in inner.iter().filter_map(|one| Some((one, one.behind()?))) {
            body.line(&format!("assign {} = {behind};", signal.name));
        }
        body.space();
        let outputs = self.outputs(module, &names);
        let column = self::column(outputs.wires.iter().map(|(shape, _)| *shape));
        for (shape, name) in &outputs.wires {
            body.line(&format!("wire {:column$}{name};", range(*shape)));
        }
        body.space();
        define(module, &expressions, &mut body);
        self.instances_in_verilog(module, &expressions, &outputs, &mut body);
        clock(module, &expressions, &mut body);
        unused(module, &expressions, &outputs, clocked, &mut body);
        text += &body.finish();
        text += &self.assertions_in_verilog(module);
        text + "endmodule\n"
    }
}

/// Adds nets and shared subexpressions.
fn define(module: &Module, expressions: &Expressions<'_>, body: &mut Body) {
    let definition = |id| expressions.definition(id, ROOM, "            ");
    for defined in definitions(module, expressions.names) {
        match defined {
            Definition::Shared(id) => {
                let name = expressions.names.get(id).unwrap_or_default();
                let range = range(module.nodes[id].1);
                body.line(&format!("wire {range}{name} = {};", definition(id)));
            }
            Definition::Net {
                signal,
                id,
                computed,
            } => {
                let value = match computed {
                    true => definition(id),
                    false => expressions.value(id),
                };
                match signal.is_port() {
                    true => body.line(&format!("assign {} = {value};", signal.name)),
                    false => {
                        let start = format!("wire {}{}", range(signal.shape), signal.name);
                        body.described(signal, &format!("{start} = {value};"));
                    }
                }
            }
        }
    }
    body.space();
}

/// Adds the statements at the rising edge.
fn clock(module: &Module, expressions: &Expressions<'_>, body: &mut Body) {
    write_memories(module, expressions, body);
    let lines = edge_lines(expressions, 1);
    if lines.is_empty() {
        return;
    }
    body.line("always @(posedge clk)");
    for line in lines {
        body.line(&line);
    }
    body.space();
}
