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
/// What [`ours`] asks for of the Verilated model.
mod theirs {
    pub const ROTATION: u32 = 7;
}
