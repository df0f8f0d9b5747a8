//! `run` of the trajectory controller: its path by every correction, waves, summary and picture.

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
use motion_rtl::circuits::trajectory_controller::TrajectoryController;
use motion_rtl::circuits::trajectory_controller::path_point::AXIS_NAMES;
use motion_rtl::jobs::JobError;
use motion_rtl::jobs::trajectory_controller::job::{Period, Played, controller, play_each};
use motion_rtl::jobs::trajectory_controller::program::Program;
use motion_rtl::jobs::trajectory_controller::settings::Correction;
use motion_rtl::plant::TwoMassAxis;
use motion_rtl::plant::waves::Machine;

use motion_rtl::sim::{Elaborated, Observer, RunError};
use motion_rtl::trace::SeriesLayout;
use picture::draw;
use runs::{FULL_FEED, IN_MOTION, Run, Runs, UnderWay};
use std::thread;

/// About how long a tick takes, with a motor and its load on each axis.
const TICK_S: f64 = 100e-9;

/// Periods that the save file's window shows.
const PERIODS_SHOWN: u64 = 4;

/// Signals at the top of the save file, from the length along the path to the loads.
const OVERVIEW: [&str; 22] = [
    "sampled",
    "fresh",
    "progress.length",
    "tangential.integrators.position",
    "x.command",
    "x.deviation",
    "x.servo.arithmetic.model_position",
    "x.servo.arithmetic.position_error",
    "x.servo.arithmetic.state",
    "torque_x",
    "position_x",
    "plant.x.load_position",
    "plant.x.twist",
    "y.command",
    "y.deviation",
    "y.servo.arithmetic.model_position",
    "y.servo.arithmetic.position_error",
    "y.servo.arithmetic.state",
    "torque_y",
    "position_y",
    "plant.y.load_position",
    "plant.y.twist",
];

/// In the order in which they are shown.
const CORRECTIONS: [Correction; 4] = [
    Correction::None,
    Correction::Steady,
    Correction::Feedback,
    Correction::Vector,
];

pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let setup = Setup::new(arguments, &job.loaded, &job.stem)?;
    let traced = job.settings.correction;
    let circuit = controller(job.axes(), traced, job.settings.rounding);
    let runs = match (job.loaded.scenario.beside(), &job.full_feed) {
        (false, _) => 1,
        (true, None) => CORRECTIONS.len() as u64,
        (true, Some(_)) => CORRECTIONS.len() as u64 + 1,
    };
    let ticks = job.ticks_at_least();
    let subject = job.drawing.as_ref();
    let subject = subject.map_or(&job.stem, |drawing| &drawing.file);
    let machine = Machine { axes: job.axes() };
    let stage = Stage {
        circuit: &circuit,
        model: &Elaborated::with_beside(&circuit, &machine).map_err(RunError::from)?,
        subject,
        work: Work {
            ticks,
            runs,
            seconds: ticks as f64 * runs as f64 * TICK_S,
        },
        series: setup.series(|| series_of(job, &circuit)),
    };
    let (runs, mut files) = with_waves(&setup, stage, |observer| {
        let mut own = || {
            let (run, played) = play_path(job, &job.program, traced, observer)?;
            let begun = run.as_ref().map_or(played.start, |run| run.in_motion);
            let end = end(&job.program, &played, begun);
            Ok((run, end))
        };
        let (runs, end) = match job.loaded.scenario.beside() {
            false => {
                let (own, end) = own()?;
                (own.into_iter().collect(), end)
            }
            true => compared(job, own)?,
        };
        Ok((Runs { runs, traced }, end))
    })?;
    progress::stage("summary and picture");
    files.write("svg", &draw(job, &runs))?;
    let summary = Summary::new(job, &runs);
    conclude(&setup, files, summary)
}

/// Plays the path by the correction of the scenario as `own` does, and in parallel by every other,
/// and by the vector at full feed if a contour tolerance limits it.
fn compared(
    job: &Job,
    own: impl FnOnce() -> Result<(Option<Run>, End), Failure>,
) -> Result<(Vec<Run>, End), Failure> {
    thread::scope(|scope| {
        let mut others = Vec::new();
        for correction in CORRECTIONS {
            let untraced = move || untraced(job, &job.program, correction);
            let other = correction != job.settings.correction;
            let started = other.then(|| threads::beside(scope, untraced));
            others.push(started.transpose()?);
        }
        let full_feed = job.full_feed.as_ref().map(|program| {
            threads::beside(scope, move || untraced(job, program, Correction::Vector))
        });
        let full_feed = full_feed.transpose()?;
        let own = own();
        let others: Vec<_> = others
            .into_iter()
            .map(|other| other.map(threads::joined))
            .collect();
        let full_feed = full_feed.map(threads::joined).transpose();
        let (mut own, end) = own?;
        let mut runs = Vec::new();
        for other in others {
            runs.extend(match other {
                Some(run) => run?,
                None => own.take(),
            });
        }
        if let Some(Some(run)) = full_feed? {
            runs.push(Run {
                full_feed: true,
                in_waves: false,
                ..run
            });
        }
        Ok((runs, end))
    })
}

/// Motors and loads at rest.
fn plants(job: &Job) -> Result<Vec<TwoMassAxis>, Failure> {
    let tick_s = 1.0 / job.settings.clock_hz as f64;
    let plants = job.machines.iter();
    let plants = plants.map(|machine| TwoMassAxis::new(machine, tick_s).map_err(JobError::from));
    Ok(plants.collect::<Result<_, _>>()?)
}

/// Plays a path by one correction.
fn play_path(
    job: &Job,
    program: &Program,
    correction: Correction,
    observer: &mut dyn Observer<TrajectoryController>,
) -> Result<(Option<Run>, Played), Failure> {
    let circuit = controller(job.axes(), correction, job.settings.rounding);
    let mut run = UnderWay::new(job, program, correction);
    let each = &mut |period: &Period| run.take(period);
    let played = play_each(&circuit, program, plants(job)?, observer, each)?;
    Ok((run.finish(&played), played))
}

/// Plays a path without waves.
fn untraced(job: &Job, program: &Program, correction: Correction) -> Result<Option<Run>, Failure> {
    let (run, _) = play_path(job, program, correction, &mut Part::default())?;
    Ok(run)
}

/// The end of a run; its window begins with a period in motion.
fn end(program: &Program, played: &Played, action: u64) -> End {
    let shown = PERIODS_SHOWN * u64::from(program.period_ticks);
    let focus = Focus {
        action,
        before: shown / PERIODS_SHOWN,
        shown,
        overview: &OVERVIEW,
    };
    End {
        ticks: played.ticks,
        focus,
    }
}

/// The time series: path points and motors in each period, when the motors are compared with their
/// models.
fn series_of(job: &Job, circuit: &TrajectoryController) -> SeriesLayout<'static> {
    // A period's work may take more or fewer ticks than that of the period before.
    let apart = u64::from(job.program.period_ticks) / 2;
    let rows = series::at("x.servo.model.fresh", apart);
    let scale = (-(circuit.widths.guard() as f64)).exp2();
    let axis = |name: &&str| {
        let command = series::scaled(format!("distribution.{name}.point"), scale);
        let motor = series::plant(&format!("{name}.position"));
        series::axis(name, "counts", command, motor)
    };
    series::layout(rows, AXIS_NAMES[..job.axes()].iter().map(axis))
}

/// The systems of the summary: every correction, and the vector at full feed.
pub fn systems(job: &Job) -> Vec<System<'_>> {
    let by = CORRECTIONS.map(|correction| (correction.name(), correction, &job.program));
    let full = job.full_feed.as_ref();
    let full = full.map(|program| (FULL_FEED, Correction::Vector, program));
    by.into_iter()
        .chain(full)
        .map(|of| system(job, of))
        .collect()
}

/// A system by its name, its correction and the plan of its path.
fn system<'a>(
    job: &'a Job,
    (name, correction, program): (&str, Correction, &'a Program),
) -> System<'a> {
    System::new(name, job.ticks_at_least(), move || {
        let circuit = controller(job.axes(), correction, job.settings.rounding);
        let model = Elaborated::with_beside(&circuit, &Machine { axes: job.axes() })
            .map_err(RunError::from)?;
        let plants = plants(job)?;
        let run = move |circuit: &TrajectoryController,
                        observer: &mut dyn Observer<TrajectoryController>| {
            let (mut seen, mut begun) = (0, None);
            let each = &mut |period: &Period| {
                if seen == IN_MOTION {
                    begun = Some(period.tick);
                }
                seen += 1;
            };
            let played = play_each(circuit, program, plants, observer, each)?;
            let names = AXIS_NAMES[..job.axes()].iter().copied();
            Ok(Ending {
                end: end(program, &played, begun.unwrap_or(played.start)),
                position: names.zip(played.motor).collect(),
                unit: "counts",
            })
        };
        Ok((circuit, model, run))
    })
}
