use super::conversion::literal;
use super::text::range;
use crate::netlist::{Kind, Memory, Module, Port, Role, Setting, Shape, Value};

/// The modules of a design, the circuit itself last, and what they are set to.
pub(super) struct Modules<'d> {
    pub(super) modules: &'d [Module],
    pub(super) settings: &'d [Setting],
}

/// A parameter of a module in Verilog.
pub(super) struct Parameter {
    /// The instances around it, and its name.
    pub(super) path: Vec<String>,
    /// The width of a number; none for the file that a memory is filled from.
    pub(super) width: Option<usize>,
}

impl Parameter {
    pub(super) fn name(&self) -> String {
        self.path.join("_").to_uppercase()
    }

    pub(super) fn declaration(&self, top: bool, value: u64) -> String {
        let name = self.name();
        match self.width {
            Some(width) => {
                let shape = unsigned(width);
                format!(
                    "parameter {}{name} = {}",
                    range(shape),
                    literal(value, shape)
                )
            }
            None if top => {
                // A memory deep inside has a long name, twice on the line.
                let between = if name.len() > 40 { "\n        " } else { " " };
                format!("parameter {name} ={between}\"{}.hex\"", self.path.join("_"))
            }
            None => format!("parameter {name} = \"\""),
        }
    }
}

pub(super) fn unsigned(width: usize) -> Shape {
    Shape {
        kind: Kind::Unsigned,
        width,
    }
}

impl Modules<'_> {
    /// Returns true if anything in a module is clocked.
    pub(super) fn clocked(&self, module: &Module) -> bool {
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
    pub(super) fn parameters(&self, module: &Module) -> Vec<Parameter> {
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

    /// Returns true for the module of the circuit itself.
    pub(super) fn is_top(&self, module: &Module) -> bool {
        self.modules
            .last()
            .is_some_and(|last| std::ptr::eq(last, module))
    }

    /// The number that a parameter of the circuit itself, or of one inside it, is set to.
    pub(super) fn number(&self, path: &[String]) -> u64 {
        let setting = self.settings.iter().find(|setting| setting.path == path);
        match setting.map(|setting| &setting.value) {
            Some(Value::Number(number)) => *number,
            _ => 0,
        }
    }
}
