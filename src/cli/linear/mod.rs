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
use super::waves_of::{Ending, System};
use super::{Failure, threads};
use job::Other;
use motion_rtl::circuits::linear_interpolator::Controller;
use motion_rtl::hdl::{Model, Observer, RunError, model_beside};
use motion_rtl::jobs::linear_interpolator::job::{conventional, play_each, plotter};
use motion_rtl::jobs::linear_interpolator::measure::Seen;
use motion_rtl::jobs::linear_interpolator::settings::{AXIS_NAMES, Settings};
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

/// Signals at the top of the save file.
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

/// Rows on top of the save file of the conventional system.
const CONVENTIONAL_OVERVIEW: [&str; 11] = [
    "scan",
    "interpolator.pattern_x.trapezoid.phase",
    "interpolator.pattern_x.trapezoid.level",
    "interpolator.pattern_y.trapezoid.phase",
    "interpolator.pattern_y.trapezoid.level",
    "command_x",
    "command_y",
    "feedback_x",
    "feedback_y",
    "reference_x",
    "reference_y",
];

pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let options = options(arguments, job.loaded.scenario.vcd_ticks())?;
    let circuit = plotter(&job.settings);
    let model = model_beside(&circuit, &Axes).map_err(RunError::from)?;
    let (ticks, scenario) = (job.ticks_at_least(), (&job.loaded, job.stem.as_str()));
    // Traces begin before the other runs, so that an error in their options is reported at once.
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

/// Plays the job with its waves, and in parallel the systems that it is compared with.
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
    traces: Traces<'_>,
) -> Result<(Run, Files), Failure> {
    let (targets, settings) = (&job.compiled.targets, &job.settings);
    traces.play(
        model,
        |observer| {
            let mut run = UnderWay::new(job);
            let each = &mut |seen: &Seen<'_>| run.take(seen);
            let played = play_each(circuit, targets, settings, observer, each)?;
            Ok(run.finish(played))
        },
        |run: &Run| (focus(settings, run.begun, &OVERVIEW), run.played.ticks),
    )
}

/// A window that begins shortly before the first command.
fn focus(settings: &Settings, begun: u64, overview: &'static [&'static str]) -> Focus {
    let scan = u64::from(settings.scan_ticks);
    Focus {
        action: begun,
        before: 2 * scan,
        shown: SCANS_SHOWN * scan,
        overview,
    }
}

/// The systems of the summary.
pub fn systems(job: &Job) -> Vec<System<'_>> {
    let interpolator = |name, settings, targets| {
        system(job, name, settings, move || {
            (plotter(settings), targets, &OVERVIEW)
        })
    };
    let (settings, targets) = (&job.settings, job.compiled.targets.clone());
    let mut systems = vec![interpolator("interpolator".to_owned(), settings, targets)];
    if let Some(other) = &job.other
        && let Ok(compiled) = &other.compiled
    {
        let name = other_name(other.settings.master.name());
        systems.push(interpolator(
            name,
            &other.settings,
            compiled.targets.clone(),
        ));
    }
    systems.extend(Way::ALL.map(|way| {
        system(job, way_name(way), settings, move || {
            let targets = way.targets(&job.longer().targets, settings);
            (conventional(), targets, &CONVENTIONAL_OVERVIEW)
        })
    }));
    systems
}

/// A system by the circuit, the targets and the rows of its save file's overview.
fn system<'a, const N: usize, const R: usize>(
    job: &'a Job,
    name: String,
    settings: &'a Settings,
    make: impl FnOnce() -> (Controller, Vec<Target<N>>, &'static [&'static str; R]) + 'a,
) -> System<'a> {
    System::new(name, job.ticks_at_least(), move || {
        let (circuit, targets, overview) = make();
        let model = model_beside(&circuit, &Axes).map_err(RunError::from)?;
        let run = move |circuit: &Controller, observer: &mut dyn Observer<Controller>| {
            let mut last = [0; 2];
            let mut begun = None;
            let each = &mut |seen: &Seen<'_>| {
                last = seen.record.command;
                begun.get_or_insert(seen.record.tick);
            };
            let played = play_each(circuit, &targets, settings, observer, each)?;
            Ok(Ending {
                ticks: played.ticks,
                focus: focus(settings, begun.unwrap_or(0), overview),
                position: AXIS_NAMES.into_iter().zip(last).collect(),
                unit: "counts",
            })
        };
        Ok((circuit, model, run))
    })
}

/// Name of the run with another master axis.
fn other_name(master: &str) -> String {
    format!("interpolator, master {master}")
}

/// Name of the conventional system.
fn way_name(way: Way) -> String {
    format!("conventional, {}", way.name())
}
