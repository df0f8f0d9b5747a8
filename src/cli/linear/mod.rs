//! `run` of the linear interpolator: its job, waves, summary and picture.

mod job;
mod picture;
mod rows;
mod runs;
mod summary;
mod text;
mod verdict;

pub use job::Job;
pub use summary::Summary;

use super::arguments::Arguments;
use super::progress::{self, Part, Work};
use super::report::conclude;
use super::setup::Setup;
use super::simulate::{Stage, with_waves};
use super::traces::{End, Focus};
use super::waves_of::{Ending, System};
use super::{Failure, series, threads};
use job::Other;
use motion_rtl::circuits::linear_interpolator::Controller;
use motion_rtl::jobs::linear_interpolator::job::{conventional, play_each, plotter};
use motion_rtl::jobs::linear_interpolator::measure::Seen;
use motion_rtl::jobs::linear_interpolator::settings::{AXIS_NAMES, Settings};
use motion_rtl::jobs::linear_interpolator::targets::Target;
use motion_rtl::jobs::linear_interpolator::ways::Way;
use motion_rtl::plant::waves::Axes;
use motion_rtl::sim::{Elaborated, Observer, RunError};
use motion_rtl::trace::SeriesLayout;
use picture::draw;
use runs::{Run, Runs, UnderWay};
use std::thread;

/// About how long a tick takes, with both motors.
const TICK_S: f64 = 50e-9;

/// Scans that the save file's window shows.
const SCANS_SHOWN: u64 = 60;

/// Signals at the top of the save file.
const OVERVIEW: [&str; 13] = [
    "scan",
    "interpolator.pattern.trapezoid.phase",
    "interpolator.pattern.trapezoid.level",
    "interpolator.integrator.integral",
    "interpolator.integrator.remainder",
    "command_x",
    "command_y",
    "feedback_x",
    "feedback_y",
    "loop_x.deviation",
    "loop_y.deviation",
    "reference_x",
    "reference_y",
];

/// Rows on top of the save file of the conventional system.
const CONVENTIONAL_OVERVIEW: [&str; 13] = [
    "scan",
    "interpolator.pattern_x.trapezoid.phase",
    "interpolator.pattern_x.trapezoid.level",
    "interpolator.pattern_y.trapezoid.phase",
    "interpolator.pattern_y.trapezoid.level",
    "command_x",
    "command_y",
    "feedback_x",
    "feedback_y",
    "loop_x.deviation",
    "loop_y.deviation",
    "reference_x",
    "reference_y",
];

pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let setup = Setup::new(arguments, &job.loaded, &job.stem)?;
    let circuit = plotter(&job.settings);
    let ticks = job.ticks_at_least();
    let runs = if job.other.is_some() { 4 } else { 1 };
    let stage = Stage {
        circuit: &circuit,
        model: &Elaborated::with_beside(&circuit, &Axes).map_err(RunError::from)?,
        subject: &job.drawing.file,
        work: Work {
            ticks,
            runs,
            seconds: ticks as f64 * runs as f64 * TICK_S,
        },
        series: setup.series(|| series_of(&job.settings)),
    };
    let (runs, mut files) = with_waves(&setup, stage, |observer| {
        let (targets, settings) = (&job.compiled.targets, &job.settings);
        let mut own = || play_system(&circuit, job, targets, settings, observer);
        let runs = match &job.other {
            None => Runs {
                interpolator: own()?,
                other: None,
                conventional: None,
            },
            Some(other) => compared(job, other, own)?,
        };
        let run = &runs.interpolator;
        let end = end(settings, run.played.ticks, run.begun, &OVERVIEW);
        Ok((runs, end))
    })?;
    progress::stage("summary and picture");
    files.write("svg", &draw(job, &runs))?;
    let summary = Summary::new(job, &runs);
    conclude(&setup, files, summary)
}

/// Plays the job as `own` does, and in parallel the systems that it is compared with.
fn compared(
    job: &Job,
    other: &Other,
    own: impl FnOnce() -> Result<Run, Failure>,
) -> Result<Runs, Failure> {
    let conventional = |way: Way| {
        let targets = way.targets(&job.longer().targets, &job.settings);
        let progress = &mut Part::default();
        play_system(&conventional(), job, &targets, &job.settings, progress)
    };
    let other = || match &other.compiled {
        Err(_) => Ok(None),
        Ok(compiled) => {
            let (targets, settings) = (&compiled.targets, &other.settings);
            let progress = &mut Part::default();
            play_system(&plotter(settings), job, targets, settings, progress).map(Some)
        }
    };
    thread::scope(|scope| {
        let start = |way| threads::beside(scope, move || conventional(way));
        let [same, inverse] = Way::ALL;
        let others = [start(same)?, start(inverse)?];
        let other = threads::beside(scope, other)?;
        let interpolator = own()?;
        let [same, inverse] = others.map(threads::joined);
        Ok(Runs {
            interpolator,
            other: threads::joined(other)?,
            conventional: Some([same?, inverse?]),
        })
    })
}

/// Plays cycles on a system.
fn play_system<const N: usize>(
    circuit: &Controller,
    job: &Job,
    targets: &[Target<N>],
    settings: &Settings,
    observer: &mut dyn Observer<Controller>,
) -> Result<Run, Failure> {
    let mut run = UnderWay::new(job);
    let each = &mut |seen: &Seen<'_>| run.take(seen);
    let played = play_each(circuit, targets, settings, observer, each)?;
    Ok(run.finish(played))
}

/// The end of a run; its window begins shortly before the first command.
fn end(settings: &Settings, ticks: u64, begun: u64, overview: &'static [&'static str]) -> End {
    let scan = u64::from(settings.scan_ticks);
    let focus = Focus {
        action: begun,
        before: 2 * scan,
        shown: SCANS_SHOWN * scan,
        overview,
    };
    End { ticks, focus }
}

/// The time series: commands and motors at each scan.
fn series_of(settings: &Settings) -> SeriesLayout<'static> {
    let rows = series::at("scan", settings.scan_ticks.into());
    let axis = |name| {
        let command = series::word(format!("command_{name}"));
        let motor = series::plant(&format!("{name}.position"));
        series::axis(name, "counts", command, motor)
    };
    series::layout(rows, AXIS_NAMES.map(axis))
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
        let model = Elaborated::with_beside(&circuit, &Axes).map_err(RunError::from)?;
        let run = move |circuit: &Controller, observer: &mut dyn Observer<Controller>| {
            let mut last = [0; 2];
            let mut begun = None;
            let each = &mut |seen: &Seen<'_>| {
                last = seen.record.command;
                begun.get_or_insert(seen.record.tick);
            };
            let played = play_each(circuit, &targets, settings, observer, each)?;
            Ok(Ending {
                end: end(settings, played.ticks, begun.unwrap_or(0), overview),
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
