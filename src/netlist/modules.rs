//! Queries on modules.

use super::module::{Assertion, Claim, Module, Register};
use super::node::{Id, Node};
use super::signal::{BIT, Shape};

/// The most nodes of a statement that Verilog has.
const LONGEST: usize = 120;

impl Module {
    /// Returns the nodes that drive nets, registers, memories and inputs of instances.
    pub fn roots(&self) -> impl Iterator<Item = Id> + '_ {
        let signals = self.signals.iter().filter_map(|signal| signal.driver);
        let memories = self.memories.iter();
        let memories = memories.flat_map(|memory| memory.port.operands());
        let inputs = self.instances.iter().flat_map(|child| &child.inputs);
        signals.chain(memories).chain(inputs.copied())
    }

    /// Returns for each node if it is used.
    pub fn live(&self) -> Vec<bool> {
        live(&self.nodes, self.roots())
    }

    /// Returns the signals read from instances that are not ports: the instance, and the signal.
    pub(crate) fn hidden(&self, modules: &[Module]) -> Vec<(usize, String)> {
        let nodes = self.nodes.iter().zip(self.live());
        let live = nodes.filter(|(_, live)| *live);
        live.filter_map(|((node, _), _)| self.hidden_read(*node, modules))
            .collect()
    }

    /// Returns the signal that a node reads from an instance if it is no port: the instance, and
    /// the signal.
    fn hidden_read(&self, node: Node, modules: &[Module]) -> Option<(usize, String)> {
        let (instance, inner) = match node {
            Node::Signal(signal) => {
                let (instance, inner) = self.signals[signal].owner?;
                (instance, Some(inner))
            }
            Node::Port { instance, leaf } => {
                let inside = &modules[self.instances[instance].module];
                (instance, inside.nets.get(leaf).copied().flatten())
            }
            Node::Read(memory, _) if self.memories[memory].inner => (0, None),
            _ => return None,
        };
        let child = &self.instances[instance];
        match inner.map(|inner| &modules[child.module].signals[inner]) {
            Some(signal) if signal.is_port() => None,
            Some(signal) => Some((instance, signal.path.clone())),
            None => Some((instance, "a signal further inside".to_owned())),
        }
    }

    /// Returns the statements that Verilog has: those that read only the module's own signals and
    /// the ports of its instances, and that a reader can follow. Those that narrow a search are not
    /// among them.
    pub(crate) fn printed(&self, modules: &[Module]) -> Vec<&Assertion> {
        let assertions = self.assertions.iter();
        let stated = assertions.filter(|assertion| assertion.claim != Claim::Narrowing);
        let shown = stated.filter(|assertion| {
            let live = live(&self.nodes, [assertion.holds].into_iter());
            let read = self.nodes.iter().zip(live).filter(|(_, live)| *live);
            let mut read = read.map(|((node, _), _)| *node);
            let hides = |node| self.hidden_read(node, modules).is_some();
            read.clone().count() <= LONGEST && !read.any(hides)
        });
        shown.collect()
    }

    /// Returns kind and width of leaf `leaf` of the walk over the nets.
    pub(crate) fn net_shape(&self, leaf: usize) -> Shape {
        let node = self.net_nodes.get(leaf).and_then(|id| self.nodes.get(*id));
        node.map_or(BIT, |(_, shape)| *shape)
    }

    /// Returns the node that leaf `leaf` of the walk over the nets shows.
    pub(crate) fn net_node(&self, leaf: usize) -> Option<Id> {
        self.net_nodes.get(leaf).copied()
    }

    /// Returns the number of leaves of the walk over the nets.
    pub(crate) fn net_leaves(&self) -> usize {
        self.net_nodes.len()
    }

    /// Returns the number of own leaves in that walk; they come after those of the instances.
    pub(crate) fn own_nets(&self, modules: &[Module]) -> usize {
        let instances = self.instances.iter();
        let inner = instances.map(|child| child.inputs.len() + modules[child.module].net_leaves());
        self.net_leaves() - inner.sum::<usize>()
    }

    /// Returns the leaves of the walk over the registers; a memory is one leaf.
    pub(crate) fn register_leaves(&self) -> impl Iterator<Item = Register> + '_ {
        self.registers.iter().copied()
    }

    /// Returns the owner of a memory: the instance, and the memory inside it.
    pub(crate) fn memory_owner(&self, memory: usize) -> Option<(usize, usize)> {
        self.owners.get(memory).copied().flatten()
    }

    /// Returns the net of leaf `leaf` of the walk over the nets.
    pub fn net(&self, leaf: usize) -> Option<usize> {
        self.nets.get(leaf).copied().flatten()
    }
}

/// Returns for each node if the roots need it, directly or through other nodes.
pub(crate) fn live(nodes: &[(Node, Shape)], roots: impl Iterator<Item = Id>) -> Vec<bool> {
    let mut live = vec![false; nodes.len()];
    for root in roots {
        live[root] = true;
    }
    for id in (0..live.len()).rev() {
        if live[id] {
            for operand in nodes[id].0.operands() {
                live[operand] = true;
            }
        }
    }
    live
}

/// Adds a module unless an equal one exists; another module of the same circuit gets a number.
pub(crate) fn enter(mut module: Module, modules: &mut Vec<Module>) -> usize {
    let circuit = module.name.clone();
    let filled: Vec<bool> = module.memories.iter().map(|memory| memory.filled).collect();
    for (index, other) in modules.iter_mut().enumerate() {
        module.name.clone_from(&other.name);
        for (memory, other) in module.memories.iter_mut().zip(&other.memories) {
            memory.filled = other.filled;
        }
        if module == *other {
            for (other, filled) in other.memories.iter_mut().zip(filled) {
                other.filled |= filled;
            }
            return index;
        }
    }
    for (memory, filled) in module.memories.iter_mut().zip(filled) {
        memory.filled = filled;
    }
    let mut number = 1;
    module.name.clone_from(&circuit);
    while modules.iter().any(|other| other.name == module.name) {
        number += 1;
        module.name = format!("{circuit}_{number}");
    }
    modules.push(module);
    modules.len() - 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::netlist::unsigned;

    #[test]
    fn a_module_has_a_name_of_its_own() {
        let mut modules = Vec::new();
        for (name, width) in [("it_2", 2), ("it", 3), ("it", 4), ("it", 3)] {
            let module = Module {
                name: name.to_owned(),
                nodes: vec![(Node::Constant(0), unsigned(width))],
                ..Module::default()
            };
            enter(module, &mut modules);
        }
        let names: Vec<_> = modules.iter().map(|module| &module.name).collect();
        assert_eq!(names, ["it_2", "it", "it_3"]);
    }
}
