//! Statements at a clock edge.

use super::{Names, is_own_register};
use crate::netlist::{Id, Module, Node, Signal};

/// A statement at a clock edge.
#[derive(Debug, PartialEq)]
pub(crate) enum Statement {
    /// A register takes a value.
    Assign(String),
    /// Condition, statements if it holds, and statements otherwise.
    If(String, Vec<Statement>, Vec<Statement>),
}

/// Texts of a language for the values of a module.
pub(crate) trait Values {
    /// Returns the module and the names of its nodes.
    fn of(&self) -> (&Module, &Names<'_>);

    /// Returns the node whose text is that of `id`.
    fn same_bits(&self, id: Id) -> Id;

    /// Returns a condition.
    fn condition(&self, id: Id) -> String;

    /// Returns the opposite of a condition.
    fn negated(&self, id: Id) -> String;

    /// Returns the statement that gives a register its power-on value.
    fn reset(&self, register: &Signal) -> String;

    /// Returns the statement that gives a register a value.
    fn assign(&self, register: &Signal, value: Id) -> String;
}

/// Returns the statement of a module's own registers at an edge, if it has some. A register that
/// holds its value where a condition is low stands in an `if`; those with one condition stand
/// together.
pub(crate) fn edge(values: &impl Values, rst: &str) -> Option<Statement> {
    let (module, _) = values.of();
    let mut reset = Vec::new();
    let mut statements = Vec::new();
    for (register, signal) in module.signals.iter().enumerate() {
        if !is_own_register(signal) {
            continue;
        }
        reset.push(Statement::Assign(values.reset(signal)));
        let next = signal.driver;
        let next = next.and_then(|next| statement(values, register, next));
        if let Some(statement) = next {
            merge(&mut statements, statement);
        }
    }
    (!reset.is_empty()).then(|| Statement::If(rst.to_owned(), reset, statements))
}

fn statement(values: &impl Values, register: usize, next: Id) -> Option<Statement> {
    let (module, names) = values.of();
    let next = values.same_bits(next);
    let node = module.nodes[next].0;
    if node == Node::Signal(register) {
        return None;
    }
    if let (Node::Mux(choose, then, other), None) = (node, names.get(next)) {
        let branch = |id| statement(values, register, id);
        let (then, other) = (branch(then), branch(other));
        return Some(match then {
            Some(then) => Statement::If(
                values.condition(choose),
                vec![then],
                other.into_iter().collect(),
            ),
            None => Statement::If(
                values.negated(choose),
                other.into_iter().collect(),
                Vec::new(),
            ),
        });
    }
    Some(Statement::Assign(
        values.assign(&module.signals[register], next),
    ))
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
