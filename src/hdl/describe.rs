//! Names of nodes in mistakes, as a reader of the circuit knows them.

use super::build::{Builder, Declared, Elaboration, elaboration};
use crate::netlist::{BIT, Id, Module, Node, Operator, Register, Site};

/// Greatest number of characters of a circuit in a mistake: a field may be a whole memory.
const LONGEST: usize = 120;

/// Returns the text, cut if it is long.
fn short(text: &str) -> String {
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{} …", &text[..end]),
        None => text.to_owned(),
    }
}

/// Returns the name of a node of the module under construction, for a mistake. If the node is of a
/// part, the mistakes say later what the part is.
pub(super) fn describe(id: Id) -> String {
    elaboration(|Elaboration { open, modules, .. }| match open.last_mut() {
        Some(builder) => {
            let part = builder.part_of(id);
            builder.involved.extend(part);
            builder.describe(id, modules)
        }
        None => "a word".to_owned(),
    })
}

impl Builder {
    /// Returns the part to whose signal a node belongs, also through operations of one operand.
    fn part_of(&self, id: Id) -> Option<usize> {
        let operand = match self.nodes.get(id)?.0 {
            Node::Signal(signal) => {
                let register = Register::Signal(signal);
                let leaf = self.registers.iter().position(|known| *known == register)?;
                let mut parts = self.parts.iter();
                return parts.position(|part| part.registers.contains(&leaf));
            }
            Node::Port { instance, .. } => {
                let mut parts = self.parts.iter();
                return parts.position(|part| part.instance == Some(instance));
            }
            Node::Cast(a) | Node::Not(a) | Node::Negate(a) | Node::Slice(a, _) => a,
            Node::Extend(a) | Node::ShiftLeft(a, _) | Node::ShiftRight(a, _) => a,
            _ => self.helpers.get(&id)?.1,
        };
        self.part_of(operand)
    }

    /// Returns a line on each part that a mistake names: its circuit with the fields.
    pub fn parts_involved(&self) -> Vec<(Site, String)> {
        let parts = self.involved.iter().map(|&part| {
            let Declared {
                name,
                circuit,
                instance,
                ..
            } = &self.parts[part];
            let instance = instance.and_then(|instance| self.instances.get(instance));
            let site = instance.map_or_else(|| self.site(), |instance| instance.site);
            (site, format!("`{name}` is {}", short(&circuit())))
        });
        parts.collect()
    }

    fn describe(&self, id: Id, modules: &[Module]) -> String {
        let Some(&(node, shape)) = self.nodes.get(id) else {
            return "a word".to_owned();
        };
        if let Some(name) = self.name(id, modules) {
            return name;
        }
        if let Some((what, operand)) = self.helpers.get(&id) {
            return self.made(what, *operand, modules);
        }
        match node {
            Node::Constant(value) => format!("the constant {value}"),
            Node::Cast(a) => self.describe(a, modules),
            Node::Not(a) => self.made("the inverse", a, modules),
            Node::Negate(a) => self.made("the negative", a, modules),
            Node::Slice(a, bit) if shape == BIT => self.made(&format!("bit {bit}"), a, modules),
            Node::Slice(a, _) => self.made("a slice", a, modules),
            Node::Extend(a) => self.made("an extension", a, modules),
            Node::ShiftLeft(a, _) | Node::ShiftRight(a, _) => self.made("a shift", a, modules),
            Node::Join(..) => "a joined word".to_owned(),
            Node::Binary(operator, ..) => match operator {
                Operator::Add => "a sum",
                Operator::Subtract => "a difference",
                Operator::Multiply => "a product",
                Operator::And | Operator::Or | Operator::Xor => "a bitwise operation",
                Operator::Equal | Operator::Below => "a comparison",
            }
            .to_owned(),
            Node::Mux(..) => "a choice".to_owned(),
            _ => "an operand".to_owned(),
        }
    }

    /// Returns the name of a signal, a parameter, a part's port or a word of a memory.
    fn name(&self, id: Id, modules: &[Module]) -> Option<String> {
        let name = match self.nodes.get(id)?.0 {
            Node::Signal(signal) => format!("`{}`", self.signals.get(signal)?.path),
            Node::Parameter(index) => format!("`{}`", self.parameters.get(index)?.0.name),
            Node::Port { instance, leaf } => {
                let part = &self.instances.get(instance)?.child;
                let inside = modules.get(part.module)?;
                match inside.net(leaf).and_then(|net| inside.signals.get(net)) {
                    Some(net) => format!("`{}.{}`", part.name, net.path),
                    None => format!("a port of `{}`", part.name),
                }
            }
            Node::Read(memory, _) if self.roms.contains(&memory) => "a word of a ROM".to_owned(),
            Node::Read(memory, _) => format!("a word of `{}`", self.memories.get(memory)?.name),
            _ => return None,
        };
        Some(name)
    }

    /// Returns the name of a result of one operand; of a named one, or of a helper's, with it.
    fn made(&self, what: &str, operand: Id, modules: &[Module]) -> String {
        let mut operand = operand;
        while let Some((Node::Cast(a), _)) = self.nodes.get(operand) {
            operand = *a;
        }
        match self.name(operand, modules) {
            Some(name) if what.is_empty() => name,
            Some(name) => format!("{what} of {name}"),
            None => format!("{what} of a word"),
        }
    }
}
