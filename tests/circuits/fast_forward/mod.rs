//! Runs that go over idle ticks, against the same runs tick by tick.

mod group;
mod jobs_of_all;

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
