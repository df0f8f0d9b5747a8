//! Runs that go over idle ticks, against the same runs tick by tick.

mod group;
#[path = "../../../benches/verilator/jobs.rs"]
#[allow(dead_code)]
mod jobs;
mod jobs_of_all;
#[path = "../../../benches/verilator/ours.rs"]
#[allow(dead_code)]
mod ours;
#[path = "../../../benches/verilator/stimulus.rs"]
#[allow(dead_code)]
mod stimulus;
/// Items of the Verilated model that [`ours`] needs.
mod theirs {
    pub const ROTATION: u32 = 7;
}

use motion_rtl::hdl::{Circuit, Declarations};
use motion_rtl::netlist::Role;
use motion_rtl::sim::Simulator;

/// All registers, words of memories among them.
fn registers<C: Circuit>(simulator: &Simulator<C>) -> Vec<u64> {
    let leaves = Declarations::of(simulator.circuit()).leaves;
    let leaves = leaves.iter().enumerate();
    let registers = leaves.filter(|(_, leaf)| leaf.role == Role::Register);
    registers
        .map(|(leaf, _)| simulator.engine().leaf(leaf).unwrap())
        .collect()
}
