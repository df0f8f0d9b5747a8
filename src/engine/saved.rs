//! States of engines, kept for later.

use super::Engine;
use super::program::Program;
use std::sync::Arc;

/// State of an engine between two edges: input ports, registers and memories.
#[derive(Debug, Clone)]
pub(crate) struct Saved {
    program: Arc<Program>,
    slab: Box<[u64]>,
}

impl Engine {
    /// Returns the state of this tick.
    pub(crate) fn saved(&self) -> Saved {
        Saved {
            program: self.program.clone(),
            slab: self.slab.as_slice().into(),
        }
    }

    /// Continues from a state of an engine of the same netlist, whatever that engine watches; no
    /// net is settled then, and everything is marked as changed. Returns false, and changes
    /// nothing, if the netlist is another one.
    pub(crate) fn resume(&mut self, saved: &Saved) -> bool {
        if Arc::ptr_eq(&self.program, &saved.program) {
            self.restore(&saved.slab);
        } else if self.program.is_of(saved.program.flat()) {
            self.take_over(saved);
        } else {
            return false;
        }
        // Blocks that compiled code inlines have no bits that say that they are due.
        self.wake();
        self.program.plan.layout.mark(&mut self.slab);
        true
    }

    /// Returns an engine of the same program in the power-on state.
    pub(crate) fn at_power_on(&self) -> Engine {
        Engine::new(self.program.clone())
    }

    /// Copies a state from the layout of another plan.
    fn take_over(&mut self, saved: &Saved) {
        let (plan, from) = (&self.program.plan, &saved.program.plan);
        let slab = &mut self.slab;
        let mut copy = |to: u32, from: u32| slab[to as usize] = saved.slab[from as usize];
        for (&to, &from) in plan.layout.inputs.iter().zip(&from.layout.inputs) {
            copy(to, from);
        }
        for (to, from) in plan.registers.iter().zip(&from.registers) {
            copy(to.slot, from.slot);
        }
        for (to, from) in plan.memories.iter().zip(&from.memories) {
            for word in 0..to.words {
                copy(to.first + word, from.first + word);
            }
            copy(to.mark, from.mark);
            copy(to.written, from.written);
            if let (Some(to), Some(from)) = (to.head, from.head) {
                copy(to, from);
            }
        }
    }
}
