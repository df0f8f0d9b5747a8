//! Statements at a rising edge in VHDL.

use super::constant::assigned;
use super::expression::Expressions;
use super::text::{STEP, assignment, conditional};
use crate::netlist::{Id, Module, Signal};
use crate::printed::{Names, Statement, Values, edge, stored};

impl Values for Expressions<'_> {
    fn of(&self) -> (&Module, &Names<'_>) {
        (self.module, self.names)
    }

    fn same_bits(&self, id: Id) -> Id {
        self.uncast(id)
    }

    fn condition(&self, id: Id) -> String {
        self.value(id)
    }

    fn negated(&self, id: Id) -> String {
        self.negated(id)
    }

    fn reset(&self, register: &Signal) -> String {
        let target = self.scope.own(&stored(register));
        format!("{target} <= {}", self.power_on(register))
    }

    fn assign(&self, register: &Signal, value: Id) -> String {
        let target = self.scope.own(&stored(register));
        let value = self.assigned(value, register.shape, self.index(register));
        format!("{target} <= {value}")
    }
}

impl Expressions<'_> {
    /// Returns the power-on value of a register.
    pub(super) fn power_on(&self, register: &Signal) -> String {
        let state = self.state(self.index(register), register.power_on);
        state.unwrap_or_else(|| assigned(register.power_on, register.shape))
    }

    /// Returns the index of a signal of the module.
    pub(super) fn index(&self, signal: &Signal) -> Option<usize> {
        let mut signals = self.module.signals.iter();
        signals.position(|own| std::ptr::eq(own, signal))
    }
}

/// Returns the process of a module's own registers, if it has some.
pub(super) fn registers(expressions: &Expressions<'_>) -> Vec<String> {
    let Some(statement) = edge(expressions, "rst") else {
        return Vec::new();
    };
    let mut lines = Vec::new();
    print(&[statement], 3, &mut lines);
    clocked(lines)
}

/// Returns a process for statements at a rising edge, which have three steps of indentation.
pub(super) fn clocked(lines: Vec<String>) -> Vec<String> {
    let step = |count: usize, text: &str| format!("{}{text}", STEP.repeat(count));
    let begin = [
        step(1, "process (clk)"),
        step(1, "begin"),
        step(2, "if rising_edge(clk) then"),
    ];
    let end = [step(2, "end if;"), step(1, "end process;")];
    begin.into_iter().chain(lines).chain(end).collect()
}

/// Returns a statement that depends on a condition, or is executed at every edge.
pub(super) fn guarded(condition: Option<&str>, statements: &[String]) -> Vec<String> {
    let Some(condition) = condition else {
        return clocked(at(statements, 3));
    };
    let mut lines = conditional("if", condition, "then", 3);
    lines.extend(at(statements, 4));
    lines.push(format!("{}end if;", STEP.repeat(3)));
    clocked(lines)
}

fn at(statements: &[String], steps: usize) -> Vec<String> {
    let lines = statements.iter();
    lines
        .flat_map(|statement| {
            let (target, value) = statement.split_once(" <= ").unwrap_or((statement, ""));
            assignment(target, &[value.to_owned()], steps)
        })
        .collect()
}

fn print(statements: &[Statement], steps: usize, lines: &mut Vec<String>) {
    for statement in statements {
        match statement {
            Statement::Assign(text) => lines.extend(at(std::slice::from_ref(text), steps)),
            Statement::If(condition, then, other) => {
                lines.extend(conditional("if", condition, "then", steps));
                print(then, steps + 1, lines);
                otherwise(other, steps, lines);
                lines.push(format!("{}end if;", STEP.repeat(steps)));
            }
        }
    }
}

/// Adds the branches of an `if` that are executed otherwise.
fn otherwise(mut other: &[Statement], steps: usize, lines: &mut Vec<String>) {
    while let [Statement::If(condition, then, next)] = other {
        lines.extend(conditional("elsif", condition, "then", steps));
        print(then, steps + 1, lines);
        other = next;
    }
    if !other.is_empty() {
        lines.push(format!("{}else", STEP.repeat(steps)));
        print(other, steps + 1, lines);
    }
}
