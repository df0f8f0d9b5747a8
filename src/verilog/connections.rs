//! Connections of a circuit's parts: the driver of each of their input ports.

use super::expression::Expressions;
use super::rules::rules;
use crate::hdl::Declarations;
use crate::netlist::{Child, Design, Module, Role, Shape, Signal};
use crate::printed::{Modules, Names};
use std::collections::HashMap;

/// The circuits that a circuit is made of, and what connects them.
///
/// Drivers are expressions of Verilog in the circuit's own signals and in ports out of its parts,
/// `part.port`. Names are those of the waves below the circuit's scope.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Connections {
    /// The parts, in the order in which they settle.
    pub parts: Vec<Part>,
    /// The circuit's own nets that are output ports.
    pub outputs: Vec<Connection>,
    /// Its other nets, which may be shared parts of drivers.
    pub nets: Vec<Connection>,
    /// Its own registers, with their next values.
    pub registers: Vec<Connection>,
}

/// A circuit inside a circuit.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Part {
    /// Name, equal to its scope in the waves.
    pub name: String,
    /// Name of its circuit in the catalogue.
    pub circuit: String,
    /// Numbers that may differ between parts of the same circuit; those of inner parts by path.
    pub parameters: Vec<(String, u64)>,
    /// Input ports with their drivers.
    pub inputs: Vec<Connection>,
    /// Output ports with their shapes.
    pub outputs: Vec<(String, Shape)>,
}

/// A signal and what drives it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Connection {
    /// Its name.
    pub name: String,
    /// Kind and width.
    pub shape: Shape,
    /// Expression that drives the signal.
    pub driver: String,
}

impl Connections {
    /// Returns the connections of a circuit whose signals are `declarations`.
    pub fn of(design: &Design, declarations: &Declarations) -> Self {
        let modules = Modules {
            modules: &design.modules,
            settings: &design.settings,
        };
        let Some(module) = design.modules.last() else {
            return Connections::default();
        };
        let paths = Paths::of(declarations);
        let shown = |name: &str| paths.shown(name);
        let rules = rules(module, &design.modules, &shown);
        let names = Names::of_parts(module, &design.modules, rules);
        let expressions = Expressions::new(module, &names);
        let parts = module.instances.iter();
        let parts = parts.map(|child| part(&modules, child, &expressions, &paths));
        let mut connections = Connections {
            parts: parts.collect(),
            ..Connections::default()
        };
        for &id in &names.shared {
            connections.nets.push(Connection {
                name: expressions.value(id),
                shape: expressions.shape(id),
                driver: expressions.definition(id, usize::MAX, ""),
            });
        }
        for signal in module.signals.iter().filter(|own| own.owner.is_none()) {
            let Some(driver) = signal.driver else {
                continue;
            };
            let name = paths.shown(&signal.name);
            let of_its_own = signal.role == Role::Net && names.get(driver) == Some(&name);
            let connection = Connection {
                driver: match of_its_own {
                    true => expressions.definition(driver, usize::MAX, ""),
                    false => expressions.value(driver),
                },
                name,
                shape: signal.shape,
            };
            match (signal.role, signal.is_port()) {
                (Role::Register, _) => connections.registers.push(connection),
                (_, true) => connections.outputs.push(connection),
                (_, false) => connections.nets.push(connection),
            }
        }
        connections
    }
}

fn part(
    modules: &Modules<'_>,
    child: &Child,
    expressions: &Expressions<'_>,
    paths: &Paths,
) -> Part {
    let inside = &modules.modules[child.module];
    let port = |signal: &Signal| {
        let whole = paths.shown(&format!("{}_{}", child.name, signal.name));
        whole[child.name.len() + 1..].to_owned()
    };
    let inputs = inside.inputs().zip(&child.inputs);
    let inputs = inputs.map(|(signal, driver)| Connection {
        name: port(signal),
        shape: signal.shape,
        driver: expressions.value(*driver),
    });
    let outputs = inside.signals.iter();
    let outputs = outputs.filter(|signal| signal.is_port() && signal.role != Role::Input);
    let parameters = modules.parameters(inside);
    let numbers = parameters
        .into_iter()
        .filter(|parameter| parameter.width.is_some());
    let numbers = numbers.map(|parameter| {
        let around = std::iter::once(&child.name);
        let mut path: Vec<String> = around.chain(&parameter.path).cloned().collect();
        let number = modules.number(&path);
        // Parameters are upper case in the Verilog output.
        if let Some(name) = path.last_mut() {
            name.make_ascii_uppercase();
        }
        (path[1..].join("."), number)
    });
    Part {
        name: child.name.clone(),
        circuit: circuit(modules.modules, inside).to_owned(),
        parameters: numbers.collect(),
        inputs: inputs.collect(),
        outputs: outputs.map(|signal| (port(signal), signal.shape)).collect(),
    }
}

/// Returns the circuit of a module; modules of one circuit differ by a number after its name.
fn circuit<'m>(modules: &'m [Module], module: &'m Module) -> &'m str {
    let first = modules.iter().find(|first| {
        let number = module.name.strip_prefix(&first.name);
        let number = number.and_then(|rest| rest.strip_prefix('_'));
        first.about == module.about && number.is_some_and(|rest| rest.parse::<usize>().is_ok())
    });
    &first.unwrap_or(module).name
}

/// Names in the waves, with dots between scopes, by their names in a module.
struct Paths(HashMap<String, String>);

impl Paths {
    fn of(declarations: &Declarations) -> Self {
        let leaves = declarations.signals().filter_map(|(_, leaf)| {
            let path = leaf.path();
            let (_, below) = path.split_once('.')?;
            Some((below.replace('.', "_"), below.to_owned()))
        });
        Paths(leaves.collect())
    }

    fn shown(&self, name: &str) -> String {
        self.0.get(name).map_or(name, String::as_str).to_owned()
    }
}
