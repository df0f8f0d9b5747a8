//! Which circuits within a circuit can be passed over.

use super::tree::{Tree, alike};
use super::walk::Change;
use crate::kernel::{Declaration, InstanceDeclaration, Role};
use std::iter::repeat_n;
use std::mem;

/// Which circuits within have registers that have changed.
///
/// Behind all circuits within stands the one that holds them: what is a register of none of them is
/// one of its own, and it is always awake.
#[derive(Debug)]
pub(super) struct Rest {
    /// For every leaf, the innermost circuit that it is a register of.
    of: Vec<u32>,
    /// For every circuit within, the one around it.
    around: Vec<u32>,
    /// Those whose registers stand elsewhere than they do, so that nothing is known of them.
    unknown: Vec<usize>,
}

impl Rest {
    pub fn new(leaves: &[Declaration], instances: &[InstanceDeclaration]) -> Self {
        let tree = Tree::new(instances);
        let whole = tree.whole;
        let mut of = Vec::with_capacity(leaves.len());
        let mut missing: Vec<_> = instances.iter().map(|each| each.registers).collect();
        for leaves in leaves.chunk_by(alike) {
            let mut instance = match leaves[0].role {
                Role::Register => tree.innermost(&leaves[0].scopes),
                Role::Input | Role::Net => whole,
            };
            of.extend(repeat_n(instance, leaves.len()));
            while instance != whole {
                let place = instance as usize;
                missing[place] = missing[place].wrapping_sub(leaves.len());
                instance = tree.around[place];
            }
        }
        let unknown = (0..instances.len()).filter(|&place| missing[place] != 0);
        let unknown = unknown.collect();
        Rest {
            of,
            around: tree.around,
            unknown,
        }
    }

    /// All circuits, awake.
    pub fn awake(&self) -> Vec<bool> {
        vec![true; self.around.len() + 1]
    }

    /// At a tick's begin.
    pub fn begin(&self, awake: &mut [bool]) {
        for &instance in &self.unknown {
            awake[instance] = true;
        }
    }

    /// Leaves have changed: the circuits that they are registers of are awake.
    #[inline(never)]
    pub fn wake(&self, changes: &[Change], awake: &mut [bool]) {
        for change in changes {
            let mut instance = self.of[change.leaf as usize] as usize;
            // Those around one that is awake are so too.
            while !mem::replace(&mut awake[instance], true) {
                instance = self.around[instance] as usize;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::registry::CATALOGUE;

    /// The registers of every circuit within stand where its nets do, or it would never rest.
    #[test]
    fn nothing_is_unknown() {
        let mut instances = 0;
        for entry in CATALOGUE {
            let declarations = (entry.full)().declarations();
            let rest = Rest::new(&declarations.leaves, &declarations.instances);
            let unknown = rest.unknown.iter();
            let unknown: Vec<_> = unknown
                .map(|&place| &declarations.instances[place])
                .collect();
            assert!(unknown.is_empty(), "{}: {unknown:?}", entry.name);
            instances += declarations.instances.len();
        }
        assert!(instances > 300, "{instances}");
    }
}
