//! `run` of the linear interpolator: its job, waves, summary and picture.

mod job;
mod picture;
mod rows;
mod summary;
mod text;
mod verdict;

pub use job::Job;

use super::files::Files;
use super::run::{Arguments, Progress, clock, no_such_tick, not_selected, options, verilog};
use super::{Failure, print, print_json};
use motion_rtl::kernel::Without;
use motion_rtl::linear_interpolator::job::{JobError, conventional, play, plotter};
use motion_rtl::linear_interpolator::measure::Played;
use motion_rtl::trace::{Options, Vcd, gtkw};
use picture::draw;
use std::io;
use std::ops::Range;
use std::path::Path;
use summary::Summary;

/// Scans that the save file's window shows.
const SCANS_SHOWN: u64 = 60;

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
    let options = options(arguments, job.loaded.scenario.vcd_ticks())?;
    let (interpolator, mut files) = simulate(arguments, job, &options)?;
    if options.ticks.start >= interpolator.ticks {
        return Err(no_such_tick(&options, interpolator.ticks));
    }
    let progress = Progress::new(interpolator.ticks);
    let conventional = play(
        &conventional(),
        &job.compiled.targets,
        &job.settings,
        progress,
    );
    let runs = Runs {
        interpolator,
        conventional: conventional.map_err(refuse)?,
    };
    files.write("svg", &draw(job, &runs))?;
    let mut summary = Summary::new(job, &runs);
    if !arguments.no_vcd {
        let Range { start, end } = options.ticks;
        summary.vcd_window = Some([start, end.min(summary.ticks).max(start)]);
    }
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

fn refuse(error: JobError) -> Failure {
    match error {
        JobError::Run(error) => Failure::Run(error),
        // What the settings let through, a motor takes; this is for what they may yet let through.
        JobError::Parameter(error) => Failure::Check(error.to_string()),
    }
}

/// Plays the job on the linear interpolator, with its waves.
fn simulate(
    arguments: &Arguments,
    job: &Job,
    options: &Options,
) -> Result<(Played, Files), Failure> {
    let circuit = plotter(job.settings.rule);
    let (targets, settings) = (&job.compiled.targets, &job.settings);
    let clock = clock(arguments, &job.loaded, job.ticks_at_least(), options)?;
    let directory = arguments.out.as_deref().unwrap_or(Path::new("waves"));
    let mut files = Files::begin(directory, &job.stem)?;
    let mut vcd = match arguments.no_vcd {
        true => None,
        false => {
            let dump = Vcd::new(files.create("vcd")?, &circuit, clock, options);
            Some(dump.map_err(|error| not_selected(&error))?)
        }
    };
    let mut stimulus = match arguments.verilog {
        true => Some(Without(verilog(&circuit.circuit, &mut files)?)),
        false => None,
    };
    let mut progress = Progress::new(job.ticks_at_least());
    // Two calls, so that a run without waves is compiled without a trace of them.
    let played = match vcd.is_some() || stimulus.is_some() {
        true => {
            let files = (vcd.as_mut(), stimulus.as_mut());
            play(&circuit, targets, settings, (files, &mut progress))
        }
        false => play(&circuit, targets, settings, &mut progress),
    };
    let played = played.map_err(refuse)?;
    drop(progress);
    if let Some(Without(stimulus)) = stimulus {
        files.push(stimulus.finish()?);
    }
    if let Some(vcd) = vcd {
        let scan = u64::from(settings.scan_ticks);
        let Range { start, end } = options.ticks;
        let first = played.cycles.first().map_or(0, |cycle| cycle.scans.start);
        let action = played.records.get(first).map_or(0, |record| record.tick);
        // Two scans before the first command, where that is in the dump.
        let first = match action < end {
            true => action.saturating_sub(2 * scan).max(start),
            false => start,
        };
        let focus = first..(first + SCANS_SHOWN * scan).min(played.ticks.max(first + 1));
        let save = gtkw::save_file(&circuit, clock, options, &job.stem, focus);
        files.push(vcd.finish()?);
        files.write("gtkw", &save.map_err(io::Error::from)?)?;
    }
    Ok((played, files))
}
