//! How a circuit runs: its netlist, made to run when it is to.

mod flat;
mod flatten;
pub mod interpreter;
mod layout;
pub mod passes;
mod plan;
mod value;

pub use flat::{EngineError, Flat, Id, Instance, Memory, Node, Op, Place, Port, Register};
pub use layout::{Change, Layout, Slot, Spot, Watched};
pub use plan::{Block, Code, Plan, PlannedMemory, PlannedRegister, Step, Write};
