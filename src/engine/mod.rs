//! How a circuit runs: its netlist, made to run when it is to.

#[cfg(feature = "jit")]
#[allow(
    unsafe_code,
    reason = "machine code is made here and called; each block says why that is sound"
)]
mod compiler;
mod flat;
mod flatten;
pub mod interpreter;
mod layout;
mod lines;
pub mod passes;
mod plan;
mod played;
mod program;
#[cfg(test)]
mod random;
mod report;
mod run;
pub(crate) mod sliced;
mod tier;
mod unroll;
mod value;

pub use flat::{EngineError, Flat, Id, Instance, Memory, Node, Op, Place, Port, Register};
pub use layout::{Change, Layout, Slot, Spot, Watched};
pub use plan::{Block, Code, Plan, PlannedMemory, PlannedRegister, Step, Write};
pub use played::Inputs;
pub(crate) use program::ports_out;
pub use program::{Program, Watch};
pub use report::report;
pub use run::Engine;
