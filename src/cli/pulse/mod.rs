//! `run` of the pulse interpolator: its job, waves, summary and picture.

mod beside;
mod job;
pub mod patterns;
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
use motion_rtl::circuits::pulse_interpolator::Group;
use motion_rtl::jobs::pulse_interpolator::job::{
    Computer, Played, fast_forward_by, group, play_by,
};
use motion_rtl::jobs::pulse_interpolator::{ControlComputer, Table};
use motion_rtl::scenario::Loaded;
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
    has_no_segments(arguments)?;
    let options = options(arguments, job.vcd_ticks)?;
    let group = group(&job.table, job.variant.into());
    let mut computer = ControlComputer::new(&group, &job.table);
    let (played, mut files) = simulate(
        arguments,
        (&job.loaded, &job.stem),
        (&group, &job.table),
        &options,
        &mut |pending| computer.drive(pending),
    )?;
    let following =
        Following::new(job, &played).map_err(|error| Failure::Check(error.to_string()))?;
    let (circuits, astray) = beside::compare(job, &played)?;
    let summary = Summary::new(job, &played, &following.largest, (circuits, astray));
    files.write("svg", &draw(job, &played, &following))?;
    conclude(arguments, &options, files, summary)
}

/// Refuses what asks for segments.
fn has_no_segments(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.segments {
        return Err(Failure::Argument {
            field: "--segments",
            problem: "the pulse interpolator has no segments".into(),
            allowed: "a scenario of another circuit".into(),
        });
    }
    Ok(())
}

/// Has a computer play a table on the pulse interpolator, with its waves.
fn simulate(
    arguments: &Arguments,
    scenario: (&Loaded, &str),
    (group, table): (&Group, &Table),
    options: &Options,
    computer: &mut Computer<'_>,
) -> Result<(Played, Files), Failure> {
    let ticks = table.total_ticks();
    let mut traces = Traces::begin((group, group), arguments, scenario, options, ticks)?;
    let mut progress = Progress::new(ticks);
    // Where nobody has to see every tick, idle ones are gone over.
    let played = match traces.is_empty() {
        false => {
            let files = (
                traces.waves.as_mut(),
                traces.stimulus.as_mut(),
                traces.noted.as_mut(),
            );
            play_by(group, table, computer, (files, &mut progress))
        }
        true => fast_forward_by(group, table, computer, &mut progress),
    }?;
    drop(progress);
    let unit = u64::from(table.patterns().first().map_or(1, |first| first.period));
    let focus = Focus {
        action: played.first_step.unwrap_or(played.begun),
        before: unit,
        shown: UNITS_SHOWN * unit,
        overview: &OVERVIEW,
    };
    let files = traces.finish(group, &focus, played.ticks)?;
    Ok((played, files))
}
