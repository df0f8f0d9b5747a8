use super::conversion::literal;
use super::expression::Expressions;
use super::module::{is_own_register, stored};
use crate::netlist::{Id, Module, Node};

/// A statement at a rising edge.
#[derive(Debug, PartialEq)]
enum Statement {
    /// A register takes a value.
    Assign(String),
    /// Condition, statements if it holds, and statements otherwise.
    If(String, Vec<Statement>, Vec<Statement>),
}

/// The edge of a module's own registers. A register that holds its value where a condition is low
/// stands in an `if`; those with one condition stand together.
pub(super) fn edge(module: &Module, expressions: &Expressions<'_>, indent: usize) -> Vec<String> {
    let mut reset = Vec::new();
    let mut statements = Vec::new();
    for (register, signal) in module.signals.iter().enumerate() {
        if !is_own_register(signal) {
            continue;
        }
        let power_on = literal(signal.power_on, signal.shape);
        reset.push(Statement::Assign(format!(
            "{} <= {power_on};",
            stored(signal)
        )));
        let next = signal.driver;
        let next = next.and_then(|next| statement(module, expressions, register, next));
        if let Some(statement) = next {
            merge(&mut statements, statement);
        }
    }
    if reset.is_empty() {
        return Vec::new();
    }
    let mut lines = Vec::new();
    print(
        &[Statement::If("rst".into(), reset, statements)],
        indent,
        &mut lines,
    );
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

fn statement(
    module: &Module,
    expressions: &Expressions<'_>,
    register: usize,
    next: Id,
) -> Option<Statement> {
    let next = expressions.same_bits(next);
    let node = module.nodes[next].0;
    if node == Node::Signal(register) {
        return None;
    }
    if let (Node::Mux(choose, then, other), None) = (node, expressions.names.get(next)) {
        let branch = |id| statement(module, expressions, register, id);
        let (then, other) = (branch(then), branch(other));
        return Some(match then {
            Some(then) => Statement::If(
                expressions.value(choose),
                vec![then],
                other.into_iter().collect(),
            ),
            None => Statement::If(
                expressions.negated(choose),
                other.into_iter().collect(),
                Vec::new(),
            ),
        });
    }
    let name = stored(&module.signals[register]);
    Some(Statement::Assign(format!(
        "{name} <= {};",
        expressions.value(next)
    )))
}

/// Adds a statement; one with the condition of the last goes into it.
fn merge(statements: &mut Vec<Statement>, statement: Statement) {
    match (statements.last_mut(), statement) {
        (Some(Statement::If(last, then, other)), Statement::If(condition, more, others))
            if *last == condition =>
        {
            for statement in more {
                merge(then, statement);
            }
            for statement in others {
                merge(other, statement);
            }
        }
        (_, statement) => statements.push(statement),
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
