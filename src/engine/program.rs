use super::flat::Flat;
use super::passes;
use super::plan::Plan;
use crate::hdl::netlist::Design;
use std::sync::Arc;

/// A circuit that is ready to run, for as many engines as are wanted.
#[derive(Debug)]
pub struct Program {
    /// The netlist as it was written: leaves that are not watched are computed from it.
    flat: Arc<Flat>,
    /// What runs.
    pub(super) plan: Plan,
    /// Registers at power-on.
    pub(super) power_on: Vec<u64>,
    /// The leaves that end a run over idle ticks when they change, as slots; see
    /// [`Engine::forward`](super::Engine::forward).
    pub(super) held: Vec<bool>,
    all: bool,
}

/// What of a circuit can be looked at in every tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Watch<'w> {
    /// All leaves.
    All,
    /// These leaves; what else is asked for is computed then.
    Leaves(&'w [usize]),
}

impl Program {
    /// Plans a netlist; `held` are leaves that idle ticks leave as they are.
    pub(crate) fn planned(flat: &Arc<Flat>, watch: Watch<'_>, held: &[usize]) -> Program {
        let mut wanted = vec![watch == Watch::All; flat.leaves.len() + flat.properties.len()];
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
            all: watch == Watch::All,
        }
    }

    /// Whether all leaves are watched.
    pub fn watches_all(&self) -> bool {
        self.all
    }

    /// How it runs.
    #[inline]
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// What it was made from.
    #[inline]
    pub fn flat(&self) -> &Flat {
        &self.flat
    }
}

/// The leaves that are ports out of a design: its outermost module's own public nets and registers.
pub(crate) fn ports_out(design: &Design) -> Vec<usize> {
    use crate::hdl::netlist::Register;
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
