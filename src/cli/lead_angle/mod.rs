//! `run` of the lead-angle compensator: its positionings, or a position log, with waves, summary
//! and picture.

mod job;
mod log;
mod picture;
mod summary;
mod systems;
mod text;
mod traces;

pub use job::Job;

use super::files::Files;
use super::run::{Arguments, Progress, no_such_tick, options};
use super::{Failure, print, print_json};
use motion_rtl::lead_angle::job::{
    Conventional, JobError, JobLead, Played, RamLead, ShiftLead, play, positioner,
};
use motion_rtl::lead_angle::settings::History;
use motion_rtl::trace::Options;
use std::ops::Range;
use summary::Summary;
use systems::{System, systems};
use traces::Traces;

/// Runs a job.
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let options = options(arguments, job.loaded.scenario.vcd_ticks())?;
    if let Some(log) = &job.log {
        return log::run(arguments, job, log, &options);
    }
    let (own, mut files) = match job.settings.history {
        History::ShiftRegister => simulate::<ShiftLead>(arguments, job, &options),
        History::Ram => simulate::<RamLead>(arguments, job, &options),
    }?;
    if options.ticks.start >= own.ticks {
        return Err(no_such_tick(&options, own.ticks));
    }
    let played = systems(&job.settings).into_iter().map(|system| {
        let played = match system.own {
            true => own.clone(),
            false => alone(&system)?,
        };
        Ok((system, played))
    });
    let played = played.collect::<Result<Vec<_>, Failure>>()?;
    files.write("svg", &picture::draw(job, &played))?;
    let mut summary = Summary::new(job, &played);
    if !arguments.no_vcd {
        let Range { start, end } = options.ticks;
        summary.vcd_window = Some([start, end.min(summary.ticks).max(start)]);
    }
    summary.files = files.commit()?;
    match arguments.json {
        true => print_json(&summary)?,
        false => print(&summary.text(arguments.segments))?,
    }
    if summary.complaints.is_empty() {
        return Ok(());
    }
    Err(Failure::Check(summary.complaints.join("\n")))
}

fn refuse(error: JobError) -> Failure {
    match error {
        JobError::Run(error) => Failure::Run(error),
        // What the settings let through, a body takes.
        JobError::Parameter(error) => Failure::Check(error.to_string()),
    }
}

/// Plays a system without waves.
fn alone(system: &System) -> Result<Played, Failure> {
    let settings = &system.settings;
    let played = match system.conventional {
        true => play(&positioner::<Conventional>(settings), settings, ()),
        // The RAM gives the same in every tick.
        false => play(&positioner::<ShiftLead>(settings), settings, ()),
    };
    played.map_err(refuse)
}

/// Plays the settings' own system with its waves.
fn simulate<P: JobLead>(
    arguments: &Arguments,
    job: &Job,
    options: &Options,
) -> Result<(Played, Files), Failure> {
    let settings = &job.settings;
    let circuit = positioner::<P>(settings);
    let ticks = job.ticks_at_least();
    let mut traces = Traces::begin(&circuit, arguments, job, options, ticks)?;
    let mut progress = Progress::new(ticks);
    // Two calls, so that a run without waves is compiled without a trace of them.
    let played = match traces.vcd.is_some() || traces.stimulus.is_some() {
        true => {
            let files = (traces.vcd.as_mut(), traces.stimulus.as_mut());
            play(&circuit, settings, (files, &mut progress))
        }
        false => play(&circuit, settings, &mut progress),
    };
    let played = played.map_err(refuse)?;
    drop(progress);
    let first = played.positionings.first();
    let action = first.map_or(0, |positioning| positioning.fired);
    let files = traces.finish(&circuit, action, played.ticks)?;
    Ok((played, files))
}
