//! `run` of the linear interpolator: its job, summary and picture.

mod job;
mod picture;
mod rows;
mod summary;
mod text;
mod verdict;

pub use job::Job;

use super::files::Files;
use super::run::{Arguments, Progress};
use super::{Failure, print, print_json};
use motion_rtl::linear_interpolator::job::play;
use motion_rtl::linear_interpolator::measure::Played;
use picture::draw;
use std::path::Path;
use summary::Summary;

/// The two systems that play a job.
#[derive(Debug)]
pub struct Runs {
    /// The linear interpolator.
    pub interpolator: Played,
    /// The conventional system of Fig. 3.
    pub conventional: Played,
}

/// Runs a job.
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    refuse_waves(arguments)?;
    let directory = arguments.out.as_deref().unwrap_or(Path::new("waves"));
    let mut files = Files::begin(directory, &job.stem)?;
    let progress = Progress::new(job.ticks_at_least());
    let (interpolator, conventional) = play(&job.compiled.targets, &job.settings, |tick| {
        progress.reach(tick);
    })?;
    drop(progress);
    let runs = Runs {
        interpolator,
        conventional,
    };
    files.write("svg", &draw(job, &runs))?;
    let mut summary = Summary::new(job, &runs);
    summary.files = files.commit()?;
    match arguments.json {
        true => print_json(&summary)?,
        false => print(&summary.text(arguments.segments))?,
    }
    if summary.exact {
        return Ok(());
    }
    Err(Failure::Check(summary.complaints.join("\n")))
}

/// There are no waves of this circuit to choose from.
fn refuse_waves(arguments: &Arguments) -> Result<(), Failure> {
    let given = [
        ("--from", arguments.from.is_some()),
        ("--to", arguments.to.is_some()),
        ("--only", !arguments.only.is_empty()),
        ("--verilog", arguments.verilog),
    ];
    match given.into_iter().find(|(_, given)| *given) {
        None => Ok(()),
        Some((field, _)) => Err(Failure::Argument {
            field,
            problem: "the linear interpolator is played without waves".into(),
            allowed: "a scenario of the pulse interpolator".into(),
        }),
    }
}
