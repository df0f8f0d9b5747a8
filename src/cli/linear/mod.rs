//! `run` of the linear interpolator: its job, waves, summary and picture.

mod job;
mod picture;
mod rows;
mod summary;
mod text;
mod verdict;

pub use job::Job;

use super::files::Files;
use super::report::conclude;
use super::run::{Arguments, Progress, options};
use super::traces::{Focus, Traces};
use super::{Failure, threads};
use job::Other;
use motion_rtl::circuits::linear_interpolator::Controller;
use motion_rtl::hdl::{Model, RunError, Without, model_beside};
use motion_rtl::jobs::linear_interpolator::job::{conventional, play, plotter};
use motion_rtl::jobs::linear_interpolator::measure::Played;
use motion_rtl::jobs::linear_interpolator::ways::Way;
use motion_rtl::plant::waves::Axes;
use picture::draw;
use std::thread;
use summary::Summary;

/// Scans that the save file's window shows.
const SCANS_SHOWN: u64 = 60;

/// What the save file shows on top.
const OVERVIEW: [&str; 11] = [
    "scan",
    "interpolator.pattern.trapezoid.phase",
    "interpolator.pattern.trapezoid.level",
    "interpolator.integrator.integral",
    "interpolator.integrator.remainder",
    "command_x",
    "command_y",
    "feedback_x",
    "feedback_y",
    "reference_x",
    "reference_y",
];

/// The systems that play a job.
#[derive(Debug)]
pub struct Runs {
    /// The linear interpolator.
    pub interpolator: Played,
    /// The same with another master axis, if the job can be had so.
    pub other: Option<Played>,
    /// The conventional system of Fig. 3, in each of its ways, where the scenario asks for it.
    pub conventional: Option<[Played; 2]>,
}

/// Runs a job.
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let options = options(arguments, job.loaded.scenario.vcd_ticks())?;
    let circuit = plotter(&job.settings);
    let model = model_beside(&circuit, &Axes).map_err(RunError::from)?;
    let (ticks, scenario) = (job.ticks_at_least(), (&job.loaded, job.stem.as_str()));
    // Before the others run, as what it refuses would wait for them.
    let traces = Traces::begin((&model, &circuit), arguments, scenario, &options, ticks)?;
    let (runs, mut files) = match &job.other {
        None => {
            let (interpolator, files) = simulate((&circuit, &model), job, traces)?;
            let runs = Runs {
                interpolator,
                other: None,
                conventional: None,
            };
            (runs, files)
        }
        Some(other) => compared((&circuit, &model), job, other, traces)?,
    };
    files.write("svg", &draw(job, &runs))?;
    let summary = Summary::new(job, &runs);
    conclude(arguments, &options, files, summary)
}

/// Plays the job with its waves, and what it is compared with beside it.
fn compared(
    shown: (&Controller, &Model),
    job: &Job,
    other: &Other,
    traces: Traces<'_>,
) -> Result<(Runs, Files), Failure> {
    let conventional = |way: Way| {
        let targets = way.targets(&job.longer().targets, &job.settings);
        play(&conventional(), &targets, &job.settings, &mut ())
    };
    let other = || match &other.compiled {
        Err(_) => Ok(None),
        Ok(compiled) => {
            let settings = &other.settings;
            let circuit = plotter(settings);
            play(&circuit, &compiled.targets, settings, &mut ()).map(Some)
        }
    };
    thread::scope(|scope| {
        let start = |way| threads::beside(scope, move || conventional(way));
        let [same, inverse] = Way::ALL;
        let others = [start(same)?, start(inverse)?];
        let other = threads::beside(scope, other)?;
        let (interpolator, files) = simulate(shown, job, traces)?;
        let [same, inverse] = others.map(threads::joined);
        let runs = Runs {
            interpolator,
            other: threads::joined(other)?,
            conventional: Some([same?, inverse?]),
        };
        Ok((runs, files))
    })
}

/// Plays the job on the linear interpolator, with its waves.
fn simulate(
    (circuit, model): (&Controller, &Model),
    job: &Job,
    mut traces: Traces<'_>,
) -> Result<(Played, Files), Failure> {
    let (targets, settings) = (&job.compiled.targets, &job.settings);
    let mut progress = Progress::new(job.ticks_at_least());
    let stimulus = traces.stimulus.as_mut().map(Without);
    let files = (traces.waves.as_mut(), stimulus, traces.noted.as_mut());
    let played = play(circuit, targets, settings, &mut (files, &mut progress))?;
    drop(progress);
    let scan = u64::from(settings.scan_ticks);
    let first = played.cycles.first().map_or(0, |cycle| cycle.scans.start);
    let focus = Focus {
        action: played.records.get(first).map_or(0, |record| record.tick),
        before: 2 * scan,
        shown: SCANS_SHOWN * scan,
        overview: &OVERVIEW,
    };
    let files = traces.finish(model, &focus, played.ticks)?;
    Ok((played, files))
}
