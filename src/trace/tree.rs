//! Which circuit within a circuit a leaf belongs to.

use crate::kernel::{Declaration, InstanceDeclaration, Role};
use std::collections::HashMap;
use std::sync::Arc;

/// The circuits within, by their scopes. Behind them stands the one that holds them all.
#[derive(Debug)]
pub(super) struct Tree<'a> {
    places: HashMap<&'a [String], u32>,
    /// For every circuit within, the one around it.
    pub around: Vec<u32>,
    /// The one that holds them all.
    pub whole: u32,
}

impl<'a> Tree<'a> {
    pub fn new(instances: &'a [InstanceDeclaration]) -> Self {
        let scopes = instances.iter().map(|instance| &instance.scopes[..]);
        let mut tree = Tree {
            places: scopes.zip(0..).collect(),
            around: Vec::new(),
            whole: instances.len() as u32,
        };
        let around = instances
            .iter()
            .map(|instance| match instance.scopes.split_last() {
                Some((_, outer)) => tree.innermost(outer),
                None => tree.whole,
            });
        tree.around = around.collect();
        tree
    }

    /// The innermost circuit around a scope.
    pub fn innermost(&self, scopes: &[String]) -> u32 {
        let mut outward = (0..=scopes.len()).rev();
        let place = outward.find_map(|depth| self.places.get(&scopes[..depth]).copied());
        place.unwrap_or(self.whole)
    }
}

/// Leaves that stand side by side in a scope and a role: they belong to the same circuit.
pub(super) fn alike(a: &Declaration, b: &Declaration) -> bool {
    a.role == b.role && Arc::ptr_eq(&a.scopes, &b.scopes)
}

/// Which leaves can change while the circuit coasts under ports in that stay as they are.
pub(crate) fn free_running(
    leaves: &[Declaration],
    instances: &[InstanceDeclaration],
    whole: FreeRunning,
) -> Vec<bool> {
    let tree = Tree::new(instances);
    // Each stands before those within it.
    let mut goes_on: Vec<FreeRunning> = Vec::with_capacity(instances.len());
    let of = |goes_on: &[FreeRunning], place: u32| match place == tree.whole {
        true => whole,
        false => goes_on[place as usize],
    };
    for (instance, &around) in instances.iter().zip(&tree.around) {
        goes_on.push(of(&goes_on, around).within(instance.free_running));
    }
    let mut free = Vec::with_capacity(leaves.len());
    for leaves in leaves.chunk_by(alike) {
        let place = tree.innermost(&leaves[0].scopes);
        // Ports in are what the circuit around makes them.
        let all = match leaves[0].role {
            Role::Input if place == tree.whole => false,
            Role::Input => of(&goes_on, tree.around[place as usize]) == FreeRunning::All,
            Role::Register | Role::Net => of(&goes_on, place) == FreeRunning::All,
        };
        free.resize(free.len() + leaves.len(), all);
    }
    free
}
