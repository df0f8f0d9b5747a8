use super::conversion::literal;
use super::design::{Modules, unsigned};
use super::expression::Expressions;
use super::names::Names;
use super::text::Body;
use crate::netlist::{Module, Node, Role, Shape};

/// Connections of instances' output ports.
pub(super) struct Outputs {
    /// Wires to declare.
    pub(super) wires: Vec<(Shape, String)>,
    /// For every instance its ports out and what they drive.
    connections: Vec<Vec<(String, String)>>,
}

impl Modules<'_> {
    /// The wires that the ports out of instances drive.
    pub(super) fn outputs(&self, module: &Module, names: &Names) -> Outputs {
        let mut outputs = Outputs {
            wires: Vec::new(),
            connections: Vec::new(),
        };
        for (index, child) in module.instances.iter().enumerate() {
            let inside = &self.modules[child.module];
            let mut connections = Vec::new();
            for (inner, signal) in inside.signals.iter().enumerate() {
                if signal.role == Role::Input || !signal.is_port() {
                    continue;
                }
                let name = module.nodes.iter().enumerate().find_map(|(id, (node, _))| {
                    let here = match *node {
                        Node::Signal(own) => module.signals[own].owner == Some((index, inner)),
                        Node::Port { instance, leaf } => {
                            instance == index && inside.net(leaf) == Some(inner)
                        }
                        _ => false,
                    };
                    here.then(|| names.get(id)).flatten().map(str::to_owned)
                });
                let name = name.unwrap_or_else(|| format!("{}_{}", child.name, signal.name));
                let mut ports = module.signals.iter().filter(|own| own.is_port());
                if !ports.any(|port| port.name == name) {
                    outputs.wires.push((signal.shape, name.clone()));
                }
                connections.push((signal.name.clone(), name));
            }
            outputs.connections.push(connections);
        }
        outputs
    }

    pub(super) fn instances(
        &self,
        module: &Module,
        expressions: &Expressions<'_>,
        outputs: &Outputs,
        body: &mut Body,
    ) {
        for (child, outputs) in module.instances.iter().zip(&outputs.connections) {
            let inside = &self.modules[child.module];
            let mut connections = Vec::new();
            if self.clocked(inside) {
                connections.push(("clk".to_owned(), "clk".to_owned()));
                connections.push(("rst".to_owned(), "rst".to_owned()));
            }
            let inputs = inside
                .signals
                .iter()
                .filter(|signal| signal.role == Role::Input);
            for (signal, driver) in inputs.zip(&child.inputs) {
                connections.push((signal.name.clone(), expressions.value(*driver)));
            }
            connections.extend(outputs.iter().cloned());
            let parameters: Vec<String> = self
                .parameters(inside)
                .iter()
                .map(|parameter| {
                    let name = parameter.name();
                    let value = match parameter.width.filter(|_| self.is_top(module)) {
                        Some(width) => {
                            let mut path = parameter.path.clone();
                            path.insert(0, child.name.clone());
                            literal(self.number(&path), unsigned(width))
                        }
                        None => format!("{}_{name}", child.name.to_uppercase()),
                    };
                    format!("        .{name}({value})")
                })
                .collect();
            match parameters.is_empty() {
                true => body.line(&format!("{} {} (", inside.name, child.name)),
                false => {
                    body.line(&format!("{} #(", inside.name));
                    body.raw(&parameters.join(",\n"));
                    body.line(&format!(") {} (", child.name));
                }
            }
            let width = connections
                .iter()
                .map(|(port, _)| port.len())
                .max()
                .unwrap_or(0);
            let lines: Vec<String> = connections
                .iter()
                .map(|(port, value)| format!("        .{port:width$} ({value})"))
                .collect();
            body.raw(&lines.join(",\n"));
            body.line(");");
            body.space();
        }
    }
}
