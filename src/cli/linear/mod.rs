//! `run` of the linear interpolator: its job, waves, summary and picture.

mod job;
mod picture;
mod rows;
mod runs;
mod summary;
mod text;
mod verdict;

pub use job::Job;

use super::files::Files;
use super::progress::{self, Part, Work};
use super::report::conclude;
use super::run::{Arguments, in_waves, options};
use super::traces::{Focus, Traces};
use super::{Failure, threads};
use job::Other;
use motion_rtl::circuits::linear_interpolator::Controller;
use motion_rtl::hdl::{Model, RunError, Without, model_beside};
use motion_rtl::jobs::linear_interpolator::job::{conventional, play_each, plotter};
use motion_rtl::jobs::linear_interpolator::measure::Seen;
use motion_rtl::jobs::linear_interpolator::settings::Settings;
use motion_rtl::jobs::linear_interpolator::targets::Target;
use motion_rtl::jobs::linear_interpolator::ways::Way;
use motion_rtl::plant::waves::Axes;
use picture::draw;
use runs::{Run, Runs, UnderWay};
use std::thread;
use summary::Summary;

/// About how long a tick takes, with both motors.
const TICK_S: f64 = 50e-9;

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

/// Runs a job.
pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let options = options(arguments, job.loaded.scenario.vcd_ticks())?;
    let circuit = plotter(&job.settings);
    let model = model_beside(&circuit, &Axes).map_err(RunError::from)?;
    let (ticks, scenario) = (job.ticks_at_least(), (&job.loaded, job.stem.as_str()));
    // Before the others run, as what it refuses would wait for them.
    let traces = Traces::begin((&model, &circuit), arguments, scenario, &options, ticks)?;
    let runs = if job.other.is_some() { 4 } else { 1 };
    progress::run(
        &job.drawing.file,
        Work {
            ticks,
            runs,
            seconds: ticks as f64 * runs as f64 * TICK_S,
            in_waves: in_waves(arguments, &options, ticks),
        },
    );
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
    progress::stage("summary and picture");
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
        alone(&conventional(), job, &targets, &job.settings)
    };
    let other = || match &other.compiled {
        Err(_) => Ok(None),
        Ok(compiled) => {
            let settings = &other.settings;
            alone(&plotter(settings), job, &compiled.targets, settings).map(Some)
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

/// Plays cycles without waves.
fn alone<const N: usize>(
    circuit: &Controller,
    job: &Job,
    targets: &[Target<N>],
    settings: &Settings,
) -> Result<Run, Failure> {
    let mut run = UnderWay::new(job);
    let each = &mut |seen: &Seen<'_>| run.take(seen);
    let played = play_each(circuit, targets, settings, &mut Part::default(), each)?;
    Ok(run.finish(played))
}

/// Plays the job on the linear interpolator, with its waves.
fn simulate(
    (circuit, model): (&Controller, &Model),
    job: &Job,
    mut traces: Traces<'_>,
) -> Result<(Run, Files), Failure> {
    let (targets, settings) = (&job.compiled.targets, &job.settings);
    let mut progress = Part::default();
    let stimulus = traces.stimulus.as_mut().map(Without);
    let files = (traces.waves.as_mut(), stimulus, traces.noted.as_mut());
    let mut run = UnderWay::new(job);
    let each = &mut |seen: &Seen<'_>| run.take(seen);
    let observer = &mut (files, &mut progress);
    let played = play_each(circuit, targets, settings, observer, each)?;
    let run = run.finish(played);
    let scan = u64::from(settings.scan_ticks);
    let focus = Focus {
        action: run.begun,
        before: 2 * scan,
        shown: SCANS_SHOWN * scan,
        overview: &OVERVIEW,
    };
    let files = traces.finish(model, &focus, run.played.ticks)?;
    Ok((run, files))
}
