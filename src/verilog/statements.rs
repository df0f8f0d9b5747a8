//! Statements at a rising edge in Verilog.

use super::conversion::literal;
use super::expression::Expressions;
use crate::netlist::{Id, Module, Signal};
use crate::printed::{Names, Statement, Values, edge, stored};

impl Values for Expressions<'_> {
    fn of(&self) -> (&Module, &Names<'_>) {
        (self.module, self.names)
    }

    fn same_bits(&self, id: Id) -> Id {
        self.same_bits(id)
    }

    fn condition(&self, id: Id) -> String {
        self.value(id)
    }

    fn negated(&self, id: Id) -> String {
        self.negated(id)
    }

    fn reset(&self, register: &Signal) -> String {
        let power_on = literal(register.power_on, register.shape);
        format!("{} <= {power_on};", stored(register))
    }

    fn assign(&self, register: &Signal, value: Id) -> String {
        format!("{} <= {};", stored(register), self.value(value))
    }
}

/// Returns the lines of the edge of a module's own registers.
pub(super) fn edge_lines(expressions: &Expressions<'_>, indent: usize) -> Vec<String> {
    let mut lines = Vec::new();
    if let Some(statement) = edge(expressions, "rst") {
        print(&[statement], indent, &mut lines);
    }
    lines
}

/// A write that depends on a condition, or happens at every edge.
pub(super) fn guarded(condition: Option<String>, statement: String, indent: usize) -> Vec<String> {
    let pad = "    ".repeat(indent);
    match condition {
        Some(condition) => vec![
            format!("{pad}if ({condition})"),
            format!("{pad}    {statement}"),
        ],
        None => vec![format!("{pad}{statement}")],
    }
}

fn print(statements: &[Statement], indent: usize, lines: &mut Vec<String>) {
    let pad = "    ".repeat(indent);
    for statement in statements {
        match statement {
            Statement::Assign(text) => lines.push(format!("{pad}{text}")),
            Statement::If(condition, then, other) => {
                lines.push(format!("{pad}if ({condition})"));
                branches(then, other, indent, lines);
            }
        }
    }
}

/// The branches of an `if` whose condition stands in the last line.
fn branches(then: &[Statement], other: &[Statement], indent: usize, lines: &mut Vec<String>) {
    let pad = "    ".repeat(indent);
    let block = then.len() != 1 || matches!(then[0], Statement::If(..));
    open(block, lines);
    print(then, indent + 1, lines);
    let end = if block { "end " } else { "" };
    match other {
        [] if block => lines.push(format!("{pad}end")),
        [] => {}
        [Statement::If(condition, then, other)] => {
            lines.push(format!("{pad}{end}else if ({condition})"));
            branches(then, other, indent, lines);
        }
        _ => {
            lines.push(format!("{pad}{end}else"));
            let block = other.len() != 1;
            open(block, lines);
            print(other, indent + 1, lines);
            if block {
                lines.push(format!("{pad}end"));
            }
        }
    }
}

fn open(block: bool, lines: &mut [String]) {
    if let (true, Some(last)) = (block, lines.last_mut()) {
        last.push_str(" begin");
    }
}
