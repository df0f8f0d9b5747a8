//! How a circuit runs: its netlist, made to run when it is to.

mod flat;
mod flatten;
pub mod interpreter;
mod layout;
#[allow(missing_docs, dead_code)]
mod lines {
    use super::Plan;
    #[derive(Debug)]
    pub struct Lines;
    impl Lines {
        pub fn new(_: &Plan, _: &[bool]) -> Self {
            Lines
        }
        pub fn horizon(&mut self, _: &Plan, _: &[bool], _: &[u64], _: u64) -> u64 {
            0
        }
        pub fn jump(&mut self, _: &Plan, _: &mut [u64], _: u64) {}
    }
}
pub mod passes;
mod plan;
mod program;
mod run;
mod tier;
mod value;

pub use flat::{EngineError, Flat, Id, Instance, Memory, Node, Op, Place, Port, Register};
pub use layout::{Change, Layout, Slot, Spot, Watched};
pub use plan::{Block, Code, Plan, PlannedMemory, PlannedRegister, Step, Write};
pub(crate) use program::ports_out;
pub use program::{Program, Watch};
pub use run::Engine;
