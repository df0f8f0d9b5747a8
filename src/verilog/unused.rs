//! Bits that nothing reads.

use super::expression::Expressions;
use crate::netlist::{Module, Role};
use crate::printed::{Body, LINE, Outputs, is_own_register};

/// Name of the wire that reads otherwise unused bits.
pub(super) const UNUSED: &str = "_unused";

/// A wire that reads what nothing else does, so that a linter stays quiet about it alone.
pub(super) fn unused(
    module: &Module,
    expressions: &Expressions<'_>,
    outputs: &Outputs,
    clocked: bool,
    body: &mut Body,
) {
    let mut unread = Vec::new();
    let resets = module.signals.iter().any(is_own_register);
    if clocked && !resets && module.instances.is_empty() {
        unread.push("rst".to_owned());
    }
    let own = module
        .signals
        .iter()
        .filter(|signal| signal.owner.is_none());
    let hidden = own.filter(|signal| signal.role == Role::Input || !signal.is_port());
    let declared = hidden.map(|signal| (signal.shape, signal.name.clone()));
    let shared = expressions.names.shared.iter().filter_map(|id| {
        let name = expressions.names.get(*id)?;
        Some((module.nodes[*id].1, name.to_owned()))
    });
    let mut seen = std::collections::HashSet::new();
    for (shape, name) in declared.chain(outputs.wires.iter().cloned()).chain(shared) {
        if seen.insert(name.clone()) {
            unread.extend(parts_unread(
                shape.width,
                &name,
                expressions.bits_read(&name),
            ));
        }
    }
    if !unread.is_empty() {
        body.comment("Read by nothing here: for the waves, or bits that are not needed.");
        let mut line = format!("wire {UNUSED} = &{{1'b0");
        for part in unread {
            line.push(',');
            if line.len() + part.len() + 4 > LINE {
                body.line(&line);
                line = "       ".to_owned();
            }
            line.push(' ');
            line += &part;
        }
        body.line(&(line + "};"));
        body.space();
    }
}

/// The bits of a name that nothing reads.
fn parts_unread(width: usize, name: &str, read: u64) -> Vec<String> {
    let unread = |bit: usize| read >> bit & 1 == 0;
    let mut parts = Vec::new();
    let mut bit = 0;
    while bit < width {
        if !unread(bit) {
            bit += 1;
            continue;
        }
        let first = bit;
        while bit < width && unread(bit) {
            bit += 1;
        }
        parts.push(match (first, bit - first) {
            (0, all) if all == width => name.to_owned(),
            (first, 1) => format!("{name}[{first}]"),
            (first, _) => format!("{name}[{}:{first}]", bit - 1),
        });
    }
    parts
}
