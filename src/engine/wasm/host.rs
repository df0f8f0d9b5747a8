//! Functions of the host that make modules callable.

use super::{CompileError, EDGE, LONG, PART, SETTLE, encode};
use crate::engine::plan::Plan;
use std::fmt;

#[link(wasm_import_module = "motion_rtl")]
unsafe extern "C" {
    /// Instantiates a module on the memory of this program and puts its function `run` into the
    /// table of this program. Returns the place, or 0 if that cannot be done.
    fn compile(module: *const u8, length: usize) -> usize;
    /// Gives back a place of the table.
    fn free(place: usize);
}

/// Compiled function: takes the slab, a phase and the number of ticks; returns the number of ticks
/// left.
type Entry = unsafe extern "C" fn(*mut u64, u32, u64) -> u64;

/// Compiled module of a plan.
pub struct Code {
    entry: Entry,
    /// Number of words of a slab.
    words: usize,
}

impl Code {
    /// Compiles a plan. Blocks that are `hot` run in every tick and are not woken.
    ///
    /// # Errors
    /// Returns an error if the host compiles nothing, or an index in the plan is out of range.
    pub fn compile(plan: &Plan, hot: &[bool]) -> Result<Code, CompileError> {
        let module = encode(plan, hot, PART, LONG)?;
        // SAFETY: the host reads the bytes of the module, which live until it returns.
        let place = unsafe { compile(module.as_ptr(), module.len()) };
        if place == 0 {
            return Err(CompileError::Host);
        }
        Ok(Code {
            // SAFETY: a function pointer is a place of the table. The host has put the function
            // `run` there, which `encode` declares with this type, and keeps it until `free`.
            entry: unsafe { std::mem::transmute::<usize, Entry>(place) },
            words: plan.layout.words as usize,
        })
    }

    /// Settles the nets of a tick.
    pub fn settle(&self, slab: &mut [u64]) {
        self.run(slab, SETTLE, 1);
    }

    /// Makes the edge.
    pub fn edge(&self, slab: &mut [u64]) {
        self.run(slab, EDGE, 0);
    }

    /// Advances by up to `ticks` ticks, each an edge and a settling with constant input ports.
    /// Stops after the settling in which something watched changes. Returns the number of ticks.
    pub fn advance(&self, slab: &mut [u64], ticks: u64) -> u64 {
        match ticks {
            0 => 0,
            _ => ticks - self.run(slab, EDGE, ticks),
        }
    }

    /// Returns the number of ticks left; does nothing if the slab is not of the plan.
    fn run(&self, slab: &mut [u64], phase: u32, ticks: u64) -> u64 {
        if slab.len() != self.words {
            return ticks;
        }
        // SAFETY: the code reads and writes nothing but the slab, which is borrowed for it alone:
        // `Emitter` takes places below `layout.words` only, which the slab has, and bounds every
        // address of a memory, whatever stands in the slab. What it keeps elsewhere is of one call,
        // and this target has no threads.
        unsafe { (self.entry)(slab.as_mut_ptr(), phase, ticks) }
    }
}

impl Drop for Code {
    fn drop(&mut self) {
        // SAFETY: the place is that of `compile`, and nothing calls it after its owner is gone.
        unsafe { free(self.entry as usize) }
    }
}

impl fmt::Debug for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "Code(place {} for {} words)",
            self.entry as usize, self.words
        )
    }
}
