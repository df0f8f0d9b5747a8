//! What a circuit's walks show: leaves as they come, and nets with the scopes of instances.

use super::build::{builder, flat, signal};
use super::memory::State;
use super::node::{Id, Node};
use super::walk::Look;
use crate::kernel::{Field, Path, Role, Shape};

/// A leaf after the edge, or of the inputs of an instance.
#[derive(Debug, Clone, Copy)]
pub(super) enum Leaf {
    Word(Id),
    Memory(usize, State),
}

impl Look for Vec<Leaf> {
    fn word(&mut self, _: &'static Field, _: Shape, id: Id) {
        self.push(Leaf::Word(id));
    }
    fn memory(&mut self, memory: usize, state: State) {
        self.push(Leaf::Memory(memory, state));
    }
}

/// Collects nets: makes signals of a circuit's own ones, finds the names of its instances.
#[derive(Default)]
pub(super) struct Nets {
    path: Path,
    /// How many structs have been entered, and at which one each nested part begins.
    depth: usize,
    parts: Vec<(usize, Role)>,
    /// How many leaves there were when each struct that is open was entered.
    entered: Vec<usize>,
    /// The signal of each leaf, if it is not one of an instance.
    pub(super) leaves: Vec<Option<usize>>,
    /// The node of each.
    pub(super) nodes: Vec<Id>,
    /// The scopes that are instances, with the instance where a net tells it.
    pub(super) instances: Vec<(Vec<String>, Option<usize>)>,
}

impl Look for Nets {
    fn enter(&mut self, field: &'static Field) {
        self.path.enter(field);
        self.depth += 1;
        self.entered.push(self.leaves.len());
        let Some(role) = field.role.filter(|_| self.depth > 1) else {
            return;
        };
        if self.parts.is_empty() {
            let scopes = self.path.scopes();
            if self.instances.last().is_none_or(|(last, _)| last != scopes) {
                self.instances.push((scopes.to_vec(), None));
            }
        }
        self.parts.push((self.depth, role));
    }
    fn leave(&mut self) {
        let scopes = self.path.scopes();
        let empty = self.entered.pop() == Some(self.leaves.len()) && self.parts.is_empty();
        // An instance without inputs and nets.
        if empty
            && !scopes.is_empty()
            && self.instances.last().is_none_or(|(last, _)| last != scopes)
        {
            self.instances.push((scopes.to_vec(), None));
        }
        self.path.leave();
        if self
            .parts
            .last()
            .is_some_and(|(depth, _)| *depth == self.depth)
        {
            self.parts.pop();
        }
        self.depth -= 1;
    }
    fn element(&mut self, index: usize) {
        self.path.element(index);
    }
    fn word(&mut self, field: &'static Field, shape: Shape, id: Id) {
        let name = self.path.name(field);
        self.nodes.push(id);
        if let Some((_, role)) = self.parts.first() {
            self.leaves.push(None);
            let node = builder(|builder| builder.nodes.get(id).map(|(node, _)| *node));
            let (Role::Net, Some(Node::Port { instance, .. })) = (role, node) else {
                return;
            };
            if let Some((_, known)) = self.instances.last_mut() {
                *known = Some(instance);
            }
            return;
        }
        let scopes = self.path.scopes().to_vec();
        let mut signal = signal(flat(&scopes, &name), field, shape);
        signal.driver = Some(id);
        let signal = builder(|builder| builder.signal(signal, scopes));
        self.leaves.push(Some(signal));
    }
    fn memory(&mut self, _: usize, _: State) {
        self.leaves.push(None);
        self.nodes.push(Id::MAX);
    }
}
