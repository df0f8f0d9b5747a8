//! Connections of instances' output ports.

use super::{Modules, Names};
use crate::netlist::{Module, Node, Role, Shape};

/// Connections of instances' output ports.
pub(crate) struct Outputs {
    /// Wires to declare.
    pub(crate) wires: Vec<(Shape, String)>,
    /// For each instance, the names of its output ports and of what they drive.
    pub(crate) connections: Vec<Vec<(String, String)>>,
}

impl Modules<'_> {
    /// Returns the wires that the ports out of instances drive.
    pub(crate) fn outputs(&self, module: &Module, names: &Names) -> Outputs {
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
                let unread = || names.shown(&format!("{}_{}", child.name, signal.name));
                let name = name.unwrap_or_else(unread);
                let mut ports = module.signals.iter().filter(|own| own.is_port());
                if !ports.any(|port| names.shown(&port.name) == name) {
                    outputs.wires.push((signal.shape, name.clone()));
                }
                connections.push((signal.name.clone(), name));
            }
            outputs.connections.push(connections);
        }
        outputs
    }
}
