//! `run` of the lead-angle compensator.

mod job;

pub use job::Job;

use super::Failure;
use super::run::Arguments;

/// Runs a job.
pub fn run(_: &Arguments, job: &Job) -> Result<(), Failure> {
    let problem = "the lead-angle compensator cannot be run yet".to_owned();
    let allowed = "pulse_interpolator or linear_interpolator".to_owned();
    Err(job.loaded.fault("circuit", problem, allowed).into())
}
