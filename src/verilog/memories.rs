//! Memories of a module in Verilog.

use super::conversion::literal;
use super::expression::Expressions;
use super::statements::guarded;
use super::text::range;
use crate::netlist::{Memory, Module, Node, Port, unsigned};
use crate::printed::{Body, clean, own_memories};

/// Declarations and contents of memories.
pub(super) fn memories(module: &Module, body: &mut Body) {
    for (index, memory) in own_memories(module) {
        let shape = unsigned(memory.width);
        body.comment(&clean(memory.doc));
        let last = memory.words - 1;
        // Words of one bit have a range too: without it, dumps mistake them for a vector.
        let range = match memory.width {
            1 => "[0:0] ".to_owned(),
            _ => range(shape),
        };
        body.line(&format!("reg  {range}{} [0:{last}];", memory.name));
        match memory.filled {
            true => {
                let file = memory.name.to_uppercase();
                body.line("generate");
                body.line(&format!("    if ({file} != \"\")"));
                body.line(&format!(
                    "        initial $readmemh({file}, {});",
                    memory.name
                ));
                body.line("endgenerate");
            }
            false => {
                let zero = literal(0, shape);
                body.line(&format!("integer {}_word;", memory.name));
                body.line("initial");
                body.line(&format!(
                    "    for ({0}_word = 0; {0}_word < {1}; {0}_word = {0}_word + 1)",
                    memory.name, memory.words
                ));
                body.line(&format!("        {0}[{0}_word] = {zero};", memory.name));
            }
        }
        if module.has_leaves(index) {
            words(memory, body);
        }
        body.space();
    }
}

/// Declares the words as wires: vvp warns of each word of an array that it dumps.
fn words(memory: &Memory, body: &mut Body) {
    let Memory { name, words, .. } = memory;
    let range = range(unsigned(memory.width));
    body.raw("`ifdef __ICARUS__");
    body.comment("Words as wires, for dumps.");
    body.line("generate");
    body.line(&format!("    genvar {name}_at;"));
    body.line(&format!("    for ({name}_at = 0; {name}_at < {words};"));
    body.line(&format!(
        "        {name}_at = {name}_at + 1) begin : {name}_words"
    ));
    body.line(&format!(
        "            wire {range}word = {name}[{name}_at];"
    ));
    body.line("    end");
    body.line("endgenerate");
    body.raw("`endif");
}

/// Adds the memories' writes at the rising edge.
pub(super) fn write_memories(module: &Module, expressions: &Expressions<'_>, body: &mut Body) {
    for (index, memory) in own_memories(module) {
        if let Some((condition, write)) = expressions.port(index) {
            body.line("always @(posedge clk)");
            for line in guarded(condition, write, 1) {
                body.line(&line);
            }
            body.space();
        }
        if let Port::Shift { enable, data } = memory.port {
            let name = &memory.name;
            let condition = match module.nodes[enable].0 {
                Node::Constant(0) => continue,
                Node::Constant(_) => None,
                _ => Some(expressions.value(enable)),
            };
            body.line("always @(posedge clk)");
            let first = format!("{name}[0] <= {};", expressions.value(data));
            for line in guarded(condition.clone(), first, 1) {
                body.line(&line);
            }
            if memory.words > 1 {
                body.line("generate");
                body.line(&format!("    genvar {name}_to;"));
                body.line(&format!(
                    "    for ({name}_to = 1; {name}_to < {}; {name}_to = {name}_to + 1) begin : {name}_shift",
                    memory.words
                ));
                body.line("        always @(posedge clk)");
                let next = format!("{name}[{name}_to] <= {name}[{name}_to - 1];");
                for line in guarded(condition, next, 3) {
                    body.line(&line);
                }
                body.line("    end");
                body.line("endgenerate");
            }
            body.space();
        }
    }
}
