//! Nets and shared subexpressions of a module, in the order in which they are computed.

use super::Names;
use crate::netlist::{Id, Module, Node, Role, Signal};

/// A name that a module gives to a value.
pub(crate) enum Definition<'m> {
    /// A subexpression that no signal shows.
    Shared(Id),
    /// A net, which computes the node itself or shows a value that has another name.
    Net {
        signal: &'m Signal,
        id: Id,
        computed: bool,
    },
}

/// Returns the definitions of a module, each after what it reads. Nets that instances drive by
/// their ports are not among them.
pub(crate) fn definitions<'m>(module: &'m Module, names: &Names) -> Vec<Definition<'m>> {
    let mut definitions = Vec::new();
    for id in 0..module.nodes.len() {
        if names.shared.contains(&id) {
            definitions.push(Definition::Shared(id));
        }
        for signal in &module.signals {
            if signal.role != Role::Net || signal.driver != Some(id) {
                continue;
            }
            let computed = names.is_net(id, signal);
            // An instance drives it by its port.
            if computed && matches!(module.nodes[id].0, Node::Port { .. } | Node::Signal(_)) {
                continue;
            }
            definitions.push(Definition::Net {
                signal,
                id,
                computed,
            });
        }
    }
    definitions
}
