//! Names that Verilog needs.

use super::unused::UNUSED;
use crate::netlist::{Id, Kind, Module, Node, Operator, Port};
use crate::printed::{Names, Rules, index_width, reserved};
use std::collections::{HashMap, HashSet};

/// Returns the rules of Verilog for the names of a module; `shown` formats the name of a signal.
pub(super) fn rules<'r>(
    module: &Module,
    modules: &[Module],
    shown: &'r dyn Fn(&str) -> String,
) -> Rules<'r> {
    let taken: HashSet<String> = reserved(module, modules).into_iter().collect();
    Rules {
        shown,
        taken: &taken | &HashSet::from([UNUSED.to_owned()]),
        given: HashMap::new(),
        needs: needed,
        fallback: &|_| "net".to_owned(),
    }
}

/// Returns names of a module's nodes that are those of its signals.
pub(super) fn names(module: &Module, modules: &[Module]) -> Names<'static> {
    Names::new(
        module,
        modules,
        rules(module, modules, &|name| name.to_owned()),
    )
}

/// Returns the nodes that need a name, in a whole module.
fn needed(names: &Names<'_>, module: &Module, uses: &[usize]) -> Vec<bool> {
    let live: Vec<bool> = uses.iter().map(|uses| *uses > 0).collect();
    let mut parts = parts(names, module, &live);
    for memory in &module.memories {
        if let Port::Ram { address, .. } = memory.port {
            parts[address] |= !is_index(names, module, address);
        }
    }
    parts
}

/// Returns the nodes that need a name because Verilog takes bits only of names.
pub(super) fn parts(names: &Names<'_>, module: &Module, read: &[bool]) -> Vec<bool> {
    let mut parts = vec![false; module.nodes.len()];
    for (id, (node, shape)) in module.nodes.iter().enumerate() {
        if !read[id] {
            continue;
        }
        match *node {
            Node::Slice(of, low) => parts[of] |= !(low == 0 && narrows(names, module, of)),
            Node::Extend(of) => parts[of] |= shape.kind == Kind::Signed,
            Node::Read(memory, address) => {
                let fits =
                    index_width(module.memories[memory].words) == module.nodes[address].1.width;
                parts[address] |= !fits && !narrows(names, module, address);
                parts[address] |= !is_index(names, module, address);
            }
            _ => {}
        }
    }
    parts
}

/// Returns true if the low bits of a node can be written without a name for the whole.
fn narrows(names: &Names<'_>, module: &Module, id: Id) -> bool {
    if names.get(id).is_some() {
        return true;
    }
    match module.nodes[id].0 {
        Node::Constant(_) => true,
        Node::Binary(Operator::Equal | Operator::Below, ..) => false,
        Node::Binary(_, a, b) | Node::Mux(_, a, b) => {
            narrows(names, module, a) && narrows(names, module, b)
        }
        Node::Not(a) | Node::Negate(a) | Node::Cast(a) => narrows(names, module, a),
        _ => false,
    }
}

/// Returns true if a node can be written as an index. Icarus computes an index in more bits
/// than its operands have, so an expression that may wrap needs a name.
fn is_index(names: &Names<'_>, module: &Module, id: Id) -> bool {
    let named = |id: Id| names.get(id).is_some();
    match module.nodes[id].0 {
        _ if named(id) => true,
        Node::Constant(_) | Node::Parameter(_) | Node::Read(..) | Node::Join(..) => true,
        Node::Cast(a) | Node::Extend(a) => is_index(names, module, a),
        Node::Slice(a, _) => named(a),
        _ => false,
    }
}
