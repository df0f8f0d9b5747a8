//! Instances of a module in Verilog.

use super::conversion::literal;
use super::expression::Expressions;
use crate::netlist::{Module, Role, unsigned};
use crate::printed::{Body, Modules, Outputs};

impl Modules<'_> {
    pub(super) fn instances_in_verilog(
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
