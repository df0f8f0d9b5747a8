//! Types and lines in VHDL.

use crate::netlist::{Kind, Shape};
use crate::printed::{LINE, folded};

/// Beginning of a comment.
pub(super) const MARK: &str = "--";

/// One step of indentation.
pub(super) const STEP: &str = "    ";

/// Operators behind which a long line is broken, the weakest first.
const OPERATORS: &[&[&str]] = &[
    &[" else"],
    &[" when"],
    &[" and", " or", " xor"],
    &["&", "+", "-", "*", "=", "<", ","],
];

/// Returns the type of a word.
pub(super) fn subtype(shape: Shape) -> String {
    match shape.kind {
        Kind::Bit => "std_logic".to_owned(),
        Kind::Unsigned => format!("unsigned({} downto 0)", shape.width - 1),
        Kind::Signed => format!("signed({} downto 0)", shape.width - 1),
    }
}

/// Returns the lines of an assignment of alternatives, with an indentation of so many steps.
pub(super) fn assignment(target: &str, alternatives: &[String], steps: usize) -> Vec<String> {
    let pad = STEP.repeat(steps);
    let line = format!("{pad}{target} <= {};", alternatives.join(" else "));
    if line.len() <= LINE {
        return vec![line];
    }
    let indent = pad.len() + STEP.len();
    let mut lines = vec![format!("{pad}{target} <=")];
    let mut ends: Vec<String> = alternatives
        .iter()
        .map(|alternative| format!("{:indent$}{alternative} else", ""))
        .collect();
    if let Some(last) = ends.last_mut() {
        last.truncate(last.len() - " else".len());
        last.push(';');
    }
    for end in ends {
        let text = folded(&end, indent, OPERATORS);
        let text = format!("{:indent$}{text}", "");
        lines.extend(text.lines().map(str::to_owned));
    }
    lines
}

/// Returns the lines of `if`, `elsif` or `when` with a condition and what stands behind it.
pub(super) fn conditional(word: &str, condition: &str, end: &str, steps: usize) -> Vec<String> {
    let indent = STEP.len() * steps;
    let line = format!("{:indent$}{word} {condition} {end}", "");
    if line.len() <= LINE {
        return vec![line];
    }
    let text = folded(line.trim_start(), indent + STEP.len(), OPERATORS);
    let lines = format!("{:indent$}{text}", "");
    lines.lines().map(str::to_owned).collect()
}
