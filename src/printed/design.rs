//! Modules of a design, and their parameters.

use crate::netlist::{Memory, Module, Port, Role, Setting, Signal, Value};

/// The modules of a design, the circuit itself last, and what they are set to.
pub(crate) struct Modules<'d> {
    pub(crate) modules: &'d [Module],
    pub(crate) settings: &'d [Setting],
}

/// A parameter of a printed module.
pub(crate) struct Parameter {
    /// The instances around it, and its name.
    pub(crate) path: Vec<String>,
    /// The width of a number; none for the file that a memory is filled from.
    pub(crate) width: Option<usize>,
}

impl Parameter {
    pub(crate) fn name(&self) -> String {
        self.path.join("_").to_uppercase()
    }
}

impl Modules<'_> {
    /// Returns true if anything in a module is clocked.
    pub(crate) fn clocked(&self, module: &Module) -> bool {
        module
            .signals
            .iter()
            .any(|signal| signal.role == Role::Register)
            || module
                .memories
                .iter()
                .any(|memory| memory.port != Port::Rom)
            || module
                .instances
                .iter()
                .any(|child| self.clocked(&self.modules[child.module]))
    }

    /// The parameters of a module: its own, and what it passes on to those inside it. The
    /// circuit itself passes numbers on as such.
    pub(crate) fn parameters(&self, module: &Module) -> Vec<Parameter> {
        let numbers = module.parameters.iter().map(|parameter| Parameter {
            path: vec![parameter.name.to_owned()],
            width: Some(parameter.width),
        });
        let filled = |memory: &&Memory| memory.filled && !memory.inner;
        let files = module
            .memories
            .iter()
            .filter(filled)
            .map(|memory| Parameter {
                path: vec![memory.name.clone()],
                width: None,
            });
        let mut parameters: Vec<Parameter> = numbers.chain(files).collect();
        for child in &module.instances {
            for mut parameter in self.parameters(&self.modules[child.module]) {
                if parameter.width.is_none() || !self.is_top(module) {
                    parameter.path.insert(0, child.name.clone());
                    parameters.push(parameter);
                }
            }
        }
        parameters
    }

    /// Returns the parameters of a module that are numbers.
    pub(crate) fn numbers(&self, module: &Module) -> Vec<Parameter> {
        let mut parameters = self.parameters(module);
        parameters.retain(|parameter| parameter.width.is_some());
        parameters
    }

    /// Returns true for the module of the circuit itself.
    pub(crate) fn is_top(&self, module: &Module) -> bool {
        self.modules
            .last()
            .is_some_and(|last| std::ptr::eq(last, module))
    }

    /// The number that a parameter of the circuit itself, or of one inside it, is set to.
    pub(crate) fn number(&self, path: &[String]) -> u64 {
        let setting = self.settings.iter().find(|setting| setting.path == path);
        match setting.map(|setting| &setting.value) {
            Some(Value::Number(number)) => *number,
            _ => 0,
        }
    }
}

/// True for a register of the module itself.
pub(crate) fn is_own_register(signal: &Signal) -> bool {
    signal.role == Role::Register && signal.owner.is_none()
}

/// Returns the name of a register: that of its port is a wire.
pub(crate) fn stored(signal: &Signal) -> String {
    signal.behind().unwrap_or_else(|| signal.name.clone())
}

/// Returns the memories of a module itself, with their places among all.
pub(crate) fn own_memories(module: &Module) -> impl Iterator<Item = (usize, &Memory)> {
    let memories = module.memories.iter().enumerate();
    memories.filter(|(_, memory)| !memory.inner)
}
