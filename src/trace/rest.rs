//! Which circuits within a circuit can be passed over.

use crate::kernel::{Declaration, InstanceDeclaration, Role};
use std::collections::HashMap;
use std::iter::repeat_n;
use std::mem;
use std::sync::Arc;

/// Which circuits within have registers that have changed.
#[derive(Debug)]
pub(super) struct Rest {
    /// For every leaf, the innermost circuit within that it is a register of.
    of: Vec<Option<u32>>,
    /// For every circuit within, the one around it.
    around: Vec<Option<u32>>,
    /// Those whose registers stand elsewhere than they do, so that nothing is known of them.
    unknown: Vec<usize>,
}

impl Rest {
    pub fn new(leaves: &[Declaration], instances: &[InstanceDeclaration]) -> Self {
        let places: HashMap<&[String], u32> = instances
            .iter()
            .map(|instance| &instance.scopes[..])
            .zip(0..)
            .collect();
        let innermost = |scopes: &[String]| {
            let mut outward = (0..=scopes.len()).rev();
            outward.find_map(|depth| places.get(&scopes[..depth]).copied())
        };
        let around: Vec<_> = instances
            .iter()
            .map(|instance| {
                let (_, outer) = instance.scopes.split_last()?;
                innermost(outer)
            })
            .collect();

        let mut of = Vec::with_capacity(leaves.len());
        let mut missing: Vec<_> = instances.iter().map(|each| each.registers).collect();
        let alike = |a: &Declaration, b: &Declaration| {
            a.role == b.role && Arc::ptr_eq(&a.scopes, &b.scopes)
        };
        for leaves in leaves.chunk_by(alike) {
            let instance = match leaves[0].role {
                Role::Register => innermost(&leaves[0].scopes),
                Role::Input | Role::Net => None,
            };
            of.extend(repeat_n(instance, leaves.len()));
            let mut instance = instance;
            while let Some(place) = instance {
                let place = place as usize;
                missing[place] = missing[place].wrapping_sub(leaves.len());
                instance = around[place];
            }
        }
        let unknown = (0..instances.len()).filter(|&place| missing[place] != 0);
        let unknown = unknown.collect();
        Rest {
            of,
            around,
            unknown,
        }
    }

    /// At a tick's begin.
    pub fn begin(&self, awake: &mut [bool]) {
        for &instance in &self.unknown {
            awake[instance] = true;
        }
    }

    /// The innermost circuit within that a leaf is a register of.
    #[inline]
    pub fn of(&self, leaf: usize) -> Option<usize> {
        self.of[leaf].map(|instance| instance as usize)
    }

    /// A register of a circuit has changed.
    #[inline(never)]
    pub fn wake(&self, instance: usize, awake: &mut [bool]) {
        let mut instance = Some(instance);
        while let Some(place) = instance {
            if mem::replace(&mut awake[place], true) {
                // And so are those around it.
                break;
            }
            instance = self.around[place].map(|place| place as usize);
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
