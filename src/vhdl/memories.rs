//! Memories of a module in VHDL.

use super::constant::string;
use super::expression::Expressions;
use super::statements::guarded;
use super::text::{STEP, subtype};
use super::units::Unit;
use crate::netlist::{Id, Memory, Node, Port, unsigned};
use crate::printed::{Body, LINE, clean, own_memories};

/// Adds types and declarations of memories, with their contents.
pub(super) fn memories(unit: &Unit, expressions: &Expressions<'_>, body: &mut Body) {
    for (index, memory) in own_memories(expressions.module) {
        let scope = expressions.scope;
        let (name, words) = (scope.own(&memory.name), scope.words(&memory.name));
        let last = memory.words - 1;
        let word = subtype(unsigned(memory.width));
        body.line(&format!("type {words} is array (0 to {last}) of {word};"));
        body.comment(&clean(memory.doc));
        let contents = unit.contents.iter().find(|(own, _)| *own == index);
        let contents = contents.map_or(&[][..], |(_, words)| words);
        let never = |enable: Id| expressions.module.nodes[enable].0 == Node::Constant(0);
        let kind = match memory.port {
            Port::Rom => "constant",
            Port::Ram { enable, .. } | Port::Shift { enable, .. } if never(enable) => "constant",
            Port::Ram { .. } | Port::Shift { .. } => "signal",
        };
        let begin = format!("{kind} {name} : {words} :=");
        match aggregate(memory, contents) {
            short if !short.contains('\n') => body.line(&format!("{begin} {short};")),
            long => {
                body.line(&begin);
                for line in format!("{long};").lines() {
                    body.line(&format!("{STEP}{line}"));
                }
            }
        }
        body.space();
    }
}

/// Returns the words of a memory; those that are zero at its end together.
fn aggregate(memory: &Memory, contents: &[u64]) -> String {
    let filled = contents.iter().rposition(|word| *word != 0);
    let filled = &contents[..filled.map_or(0, |last| last + 1)];
    let zeros = "others => (others => '0')";
    let words = filled.iter().map(|word| string(*word, memory.width));
    let mut items: Vec<String> = match filled.len() {
        // A single word needs its index.
        1 => words.map(|word| format!("0 => {word}")).collect(),
        _ => words.collect(),
    };
    if filled.len() < memory.words {
        items.push(zeros.to_owned());
    }
    let mut lines = vec!["(".to_owned()];
    for (index, item) in items.iter().enumerate() {
        let comma = if index + 1 == items.len() { ")" } else { "," };
        let line = lines.last_mut().map_or(0, |line| line.len());
        let full = line + item.len() + 2 > LINE - 2 * STEP.len();
        match lines.last_mut() {
            Some(line) if !full => {
                if !line.ends_with('(') {
                    line.push(' ');
                }
                line.push_str(item);
                line.push_str(comma);
            }
            _ => lines.push(format!(" {item}{comma}")),
        }
    }
    lines.join("\n")
}

/// Adds the processes that write memories.
pub(super) fn writes(expressions: &Expressions<'_>, body: &mut Body) {
    for (index, memory) in own_memories(expressions.module) {
        let process = match memory.port {
            Port::Rom => None,
            Port::Ram { .. } => {
                let write = expressions.write(index);
                write.map(|(condition, write)| guarded(condition.as_deref(), &[write]))
            }
            Port::Shift { enable, data } => shift(expressions, memory, enable, data),
        };
        for line in process.into_iter().flatten() {
            body.raw(&line);
        }
        body.space();
    }
}

/// Returns the process of a shift register.
fn shift(
    expressions: &Expressions<'_>,
    memory: &Memory,
    enable: Id,
    data: Id,
) -> Option<Vec<String>> {
    let condition = match expressions.module.nodes[enable].0 {
        Node::Constant(0) => return None,
        Node::Constant(_) => None,
        _ => Some(expressions.value(enable)),
    };
    let name = expressions.scope.own(&memory.name);
    let first = expressions.assigned(data, expressions.shape(data), None);
    let mut statements = vec![format!("{name}(0) <= {first}")];
    if memory.words > 1 {
        let (last, before) = (memory.words - 1, memory.words - 2);
        statements.push(format!("{name}(1 to {last}) <= {name}(0 to {before})"));
    }
    Some(guarded(condition.as_deref(), &statements))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contents_of_memories() {
        let memory = |words, width| Memory {
            name: "m".to_owned(),
            doc: "",
            words,
            width,
            port: Port::Rom,
            filled: true,
            inner: false,
        };
        for (words, width, contents, expected) in [
            (4, 4, &[][..], "(others => (others => '0'))"),
            (4, 4, &[0, 0, 0, 0], "(others => (others => '0'))"),
            (1, 4, &[9], "(0 => x\"9\")"),
            (4, 4, &[9, 0], "(0 => x\"9\", others => (others => '0'))"),
            (2, 6, &[9, 63], "(6x\"09\", 6x\"3f\")"),
            (
                4,
                8,
                &[1, 2],
                "(x\"01\", x\"02\", others => (others => '0'))",
            ),
        ] {
            assert_eq!(aggregate(&memory(words, width), contents), expected);
        }
        let long = aggregate(&memory(64, 16), &[7; 64]);
        assert_eq!(long.matches("x\"0007\"").count(), 64);
        assert!(long.lines().all(|line| line.len() <= LINE), "{long}");
    }
}
