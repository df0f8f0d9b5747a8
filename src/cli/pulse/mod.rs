//! `run` of the pulse interpolator: its job, waves, summary and picture.

mod job;
mod picture;
mod summary;
mod text;
mod verdict;

pub use job::{Job, table_fault};
pub use summary::{TableSummary, warnings};

use super::Failure;
use super::files::Files;
use super::report::conclude;
use super::run::{Arguments, Progress, options};
use super::traces::{Focus, Traces};
use motion_rtl::jobs::pulse_interpolator::job::{Played, fast_forward, group, play};
use motion_rtl::trace::Options;
use picture::{Following, draw};
use summary::Summary;

/// Unit times that the save file's window shows.
const UNITS_SHOWN: u64 = 6;

/// What the save file shows on top; an axis that the job has not is left out.
const OVERVIEW: [&str; 13] = [
    "unit_rst",
    "x.memory.half_period",
    "x.generator.count",
    "step_x",
    "dir_x",
    "y.memory.half_period",
    "y.generator.count",
    "step_y",
    "dir_y",
    "z.memory.half_period",
    "z.generator.count",
    "step_z",
    "dir_z",
];

/// Runs a job.
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    if arguments.segments {
        return Err(Failure::Argument {
            field: "--segments",
            problem: "the pulse interpolator has no segments".into(),
            allowed: "a scenario of another circuit".into(),
        });
    }
    let options = options(arguments, job.vcd_ticks)?;
    let (played, mut files) = simulate(arguments, job, &options)?;
    let following =
        Following::new(job, &played).map_err(|error| Failure::Check(error.to_string()))?;
    let summary = Summary::new(job, &played, &following.largest);
    files.write("svg", &draw(job, &played, &following))?;
    conclude(arguments, &options, files, summary)
}

/// Plays the job on the pulse interpolator, with its waves.
fn simulate(
    arguments: &Arguments,
    job: &Job,
    options: &Options,
) -> Result<(Played, Files), Failure> {
    let group = group(&job.table, job.variant);
    let ticks = job.table.total_ticks();
    let scenario = (&job.loaded, job.stem.as_str());
    let mut traces = Traces::begin((&group, &group), arguments, scenario, options, ticks)?;
    let mut progress = Progress::new(ticks);
    // Where nobody has to see every tick, idle ones are gone over.
    let played = match traces.is_empty() {
        false => {
            let files = (
                traces.waves.as_mut(),
                traces.stimulus.as_mut(),
                traces.noted.as_mut(),
            );
            play(&group, &job.table, (files, &mut progress))
        }
        true => fast_forward(&group, &job.table, &mut progress),
    }?;
    drop(progress);
    let unit = u64::from(job.table.patterns().first().map_or(1, |first| first.period));
    let focus = Focus {
        action: played.first_step.unwrap_or(played.begun),
        before: unit,
        shown: UNITS_SHOWN * unit,
        overview: &OVERVIEW,
    };
    let files = traces.finish(&group, &focus, played.ticks)?;
    Ok((played, files))
}
