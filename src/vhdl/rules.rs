//! Names that VHDL needs.

use super::conversion::{bits_of, is_indexed};
use super::scope::Scope;
use crate::netlist::{BIT, Id, Kind, Module, Node, Shape};
use crate::printed::{Names, is_own_register};
use std::collections::HashMap;

/// Returns the nodes that cannot be written without a name: choices that do not stand in a statement
/// of their own, words of which bits are taken, and what drives instances.
pub(super) fn needed(names: &Names<'_>, module: &Module, uses: &[usize]) -> Vec<bool> {
    let mut needed = vec![false; module.nodes.len()];
    for input in module.instances.iter().flat_map(|child| &child.inputs) {
        needed[*input] = true;
    }
    // Nodes in a statement of their own, or in one of its alternatives, and if a bit takes them.
    let mut stands = vec![false; module.nodes.len()];
    let mut bit = vec![false; module.nodes.len()];
    for register in module.signals.iter().filter(|own| is_own_register(own)) {
        if let Some(driver) = register.driver {
            stands[driver] = true;
            bit[driver] = register.shape.kind == Kind::Bit;
        }
    }
    for (id, (node, shape)) in module.nodes.iter().enumerate().rev() {
        if uses[id] == 0 {
            continue;
        }
        let choice = matches!(node, Node::Mux(..));
        let mut named = names.get(id).is_some() || needed[id] || uses[id] > 1;
        if choice && !stands[id] {
            needed[id] |= !named;
            named = true;
        }
        if named {
            bit[id] = shape.kind == Kind::Bit;
        }
        match *node {
            Node::Mux(_, then, other) => {
                for inner in [then, other] {
                    (stands[inner], bit[inner]) = (true, bit[id]);
                }
            }
            Node::Cast(a) if named || stands[id] => (stands[a], bit[a]) = (true, bit[id]),
            Node::Cast(a) if shape.kind == Kind::Bit => need_bit(names, module, a, &mut needed),
            Node::Slice(of, low) => need_part(names, module, (of, low, *shape), &mut needed),
            _ => {}
        }
        if stands[id] && bit[id] && !named && !choice {
            need_bit(names, module, id, &mut needed);
        }
    }
    needed
}

/// Marks a word of one bit if its bit cannot be taken without a name.
fn need_bit(names: &Names<'_>, module: &Module, id: Id, needed: &mut [bool]) {
    let (node, shape) = module.nodes[id];
    if shape.kind == Kind::Bit || names.get(id).is_some() {
        return;
    }
    match node {
        Node::Constant(_) => {}
        Node::Cast(a) => need_bit(names, module, a, needed),
        Node::Slice(of, low) => need_part(names, module, (of, low, BIT), needed),
        _ => needed[id] |= !is_indexed(module, id),
    }
}

/// Marks a word that needs a name because some of its bits are taken.
fn need_part(
    names: &Names<'_>,
    module: &Module,
    (of, low, shape): (Id, usize, Shape),
    needed: &mut [bool],
) {
    let of = bits_of(names, module, of);
    let low_word = low == 0 && shape.kind != Kind::Bit;
    let bit = module.nodes[of].1.kind == Kind::Bit;
    needed[of] |= !low_word && !bit && !is_indexed(module, of);
}

/// Returns the names of the wires at input ports of instances, by what drives them.
pub(super) fn inputs(module: &Module, modules: &[Module], scope: &Scope) -> HashMap<Id, String> {
    let mut inputs = HashMap::new();
    for child in &module.instances {
        let ports = modules[child.module].inputs();
        for (port, driver) in ports.zip(&child.inputs) {
            let wire = || scope.input(&child.name, &port.name);
            inputs.entry(*driver).or_insert_with(wire);
        }
    }
    inputs
}

/// Returns for each node the signal, memory or instance that it is computed for.
pub(super) fn purposes(module: &Module, scope: &Scope) -> Vec<String> {
    let mut purposes = vec![String::new(); module.nodes.len()];
    let signals = module.signals.iter();
    let signals = signals.filter_map(|signal| Some((signal.driver?, &signal.name)));
    let memories = module.memories.iter();
    let memories =
        memories.flat_map(|memory| memory.port.operands().map(move |id| (id, &memory.name)));
    let children = module.instances.iter();
    let children = children.flat_map(|child| child.inputs.iter().map(|id| (*id, &child.name)));
    for (id, name) in signals.chain(memories).chain(children) {
        if purposes[id].is_empty() {
            purposes[id] = scope.own(name);
        }
    }
    for (id, (node, _)) in module.nodes.iter().enumerate().rev() {
        for operand in node.operands() {
            if purposes[operand].is_empty() {
                purposes[operand] = purposes[id].clone();
            }
        }
    }
    purposes
}
