use super::flat::Flat;
use super::passes;
use super::plan::Plan;
use super::prediction::Graph;
use crate::netlist::Design;
use std::sync::{Arc, OnceLock};

/// Circuit that is ready to run; engines share it.
#[derive(Debug)]
pub struct Program {
    /// Netlist before all passes: leaves that are not watched are computed from it.
    flat: Arc<Flat>,
    /// Plan.
    pub(super) plan: Plan,
    /// Power-on values of the registers.
    pub(super) power_on: Vec<u64>,
    /// By slot: leaves that end a run over idle ticks when they change; see
    /// [`Engine::forward`](super::Engine::forward).
    held: Vec<bool>,
    /// Dependency graph, made when the first engine searches for idle ticks.
    graph: OnceLock<Arc<Graph>>,
    all: bool,
}

/// Selection of the leaves that can be read in every tick without extra cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Watch<'w> {
    /// All leaves.
    All,
    /// All leaves, and the properties.
    Stated,
    /// These leaves; others are computed on request.
    Leaves(&'w [usize]),
}

impl Program {
    /// Plans a netlist; `held` are leaves that do not change in idle ticks.
    pub(crate) fn planned(flat: &Arc<Flat>, watch: Watch<'_>, held: &[usize]) -> Program {
        let all = matches!(watch, Watch::All | Watch::Stated);
        let mut wanted = vec![all; flat.leaves.len()];
        wanted.resize(
            flat.leaves.len() + flat.properties.len(),
            watch == Watch::Stated,
        );
        if let Watch::Leaves(leaves) = watch {
            for &leaf in leaves {
                if let Some(wanted) = wanted.get_mut(leaf) {
                    *wanted = true;
                }
            }
        }
        let passed = passes::all(flat, &wanted);
        let plan = Plan::of(&passed, &wanted);
        let mut slots = vec![false; plan.layout.words as usize];
        for &leaf in held {
            if let Some(super::Spot::Slot(slot)) = plan.layout.leaves.get(leaf) {
                slots[*slot as usize] = true;
            }
        }
        Program {
            power_on: flat
                .registers
                .iter()
                .map(|register| register.power_on)
                .collect(),
            plan,
            flat: flat.clone(),
            held: slots,
            graph: OnceLock::new(),
            all,
        }
    }

    /// True if all leaves are watched.
    pub fn watches_all(&self) -> bool {
        self.all
    }

    /// Returns the plan.
    #[inline]
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Returns the dependency graph of the plan.
    pub(super) fn graph(&self) -> Arc<Graph> {
        let graph = || Arc::new(Graph::new(&self.plan, &self.held));
        self.graph.get_or_init(graph).clone()
    }

    /// Returns the netlist before all passes.
    #[inline]
    pub fn flat(&self) -> &Flat {
        &self.flat
    }

    /// True if the program is of this netlist.
    pub(super) fn is_of(&self, flat: &Flat) -> bool {
        std::ptr::eq(&*self.flat, flat) || *self.flat == *flat
    }
}

/// Returns the leaves that are output ports of a design: public nets and registers of its
/// outermost module.
pub(crate) fn ports_out(design: &Design) -> Vec<usize> {
    use crate::netlist::Register;
    let Some(module) = design.modules.last() else {
        return Vec::new();
    };
    let inputs = module.inputs().count();
    let mut leaf = inputs;
    let mut ports = Vec::new();
    for register in module.register_leaves() {
        match register {
            Register::Signal(signal) => {
                if module.signals[signal].is_port() {
                    ports.push(leaf);
                }
                leaf += 1;
            }
            Register::Memory(memory) => leaf += module.memories[memory].words,
        }
    }
    for net in 0..module.net_leaves() {
        let signal = module.net(net).map(|signal| &module.signals[signal]);
        if signal.is_some_and(|signal| signal.is_port()) {
            ports.push(leaf + net);
        }
    }
    ports
}
