//! Entities of a design.

use super::scope::Scope;
use super::words::legal;
use crate::netlist::{Design, Module, Value};
use crate::printed::{Modules, own_memories};

/// An entity: a module with the contents of its memories.
pub(super) struct Unit {
    /// Index of its module.
    pub(super) module: usize,
    /// Name of the entity.
    pub(super) name: String,
    /// Words at power-on of each own memory that does not begin with zeros, by its index.
    pub(super) contents: Vec<(usize, Vec<u64>)>,
    /// Units of its instances.
    pub(super) children: Vec<usize>,
}

/// Entities of a design, each after those of its instances.
pub(super) struct Units<'d> {
    pub(super) modules: Modules<'d>,
    /// Names in each module.
    pub(super) scopes: Vec<Scope>,
    pub(super) units: Vec<Unit>,
}

impl<'d> Units<'d> {
    /// Finds the entities of a design. Instances of a module with other contents of a memory are
    /// entities of their own.
    pub(super) fn of(design: &'d Design) -> Self {
        let modules = Modules {
            modules: &design.modules,
            settings: &design.settings,
        };
        let scopes = design.modules.iter();
        let scopes = scopes.map(|module| Scope::of(module, &modules)).collect();
        let mut units = Units {
            modules,
            scopes,
            units: Vec::new(),
        };
        if let Some(top) = design.modules.len().checked_sub(1) {
            units.enter(top, &[]);
        }
        units
    }

    /// Returns the unit of the instance with this path, and adds it and those inside it.
    fn enter(&mut self, index: usize, path: &[String]) -> usize {
        let module = &self.modules.modules[index];
        let children: Vec<usize> = module
            .instances
            .iter()
            .map(|child| {
                self.enter(
                    child.module,
                    &[path, std::slice::from_ref(&child.name)].concat(),
                )
            })
            .collect();
        let contents: Vec<_> = own_memories(module)
            .filter_map(|(memory, own)| {
                let path = [path, std::slice::from_ref(&own.name)].concat();
                Some((memory, self.words(&path)?))
            })
            .collect();
        let same = self.units.iter().position(|unit| {
            (unit.module, &unit.contents, &unit.children) == (index, &contents, &children)
        });
        same.unwrap_or_else(|| {
            let name = self.free(&module.name);
            self.units.push(Unit {
                module: index,
                name,
                contents,
                children,
            });
            self.units.len() - 1
        })
    }

    fn words(&self, path: &[String]) -> Option<Vec<u64>> {
        let mut settings = self.modules.settings.iter();
        let setting = settings.find(|setting| setting.path == path)?;
        match &setting.value {
            Value::Words(words) => Some(words.clone()),
            Value::Number(_) => None,
        }
    }

    fn free(&self, name: &str) -> String {
        let legal = legal(name);
        let mut free = legal.clone();
        let mut number = 1;
        while self.units.iter().any(|unit| unit.name == free) {
            number += 1;
            free = format!("{legal}_{number}");
        }
        free
    }

    /// Returns the module of a unit and the names in it.
    pub(super) fn inside(&self, unit: &Unit) -> (&'d Module, &Scope) {
        let modules = self.modules.modules;
        (&modules[unit.module], &self.scopes[unit.module])
    }
}
