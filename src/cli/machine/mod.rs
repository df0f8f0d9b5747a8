//! `run` of the machine: one job on all circuits, with waves, summary and picture.

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
use super::progress::{self, Work};
use super::report::conclude;
use super::setup::Setup;
use super::simulate::{Stage, with_waves};
use super::traces::{End, Focus};
use super::waves_of::{Ending, System};
use super::{Failure, series};
use motion_rtl::circuits::machine::Machine;
use motion_rtl::hdl::Circuit;
use motion_rtl::jobs::machine::Settings;
use motion_rtl::jobs::machine::job::{Played, machine, play_each};
use motion_rtl::jobs::machine::waves::Plants;
use motion_rtl::plan::Plan;
use motion_rtl::sim::{Elaborated, Observer, RunError};
use motion_rtl::trace::{Position, SeriesLayout, SeriesPlan};
use runs::UnderWay;

/// About how long a tick takes, with all motors.
const TICK_S: f64 = 150e-9;

/// Sampling times in the save file's window, and the count of these before the first signal that
/// stops the pen lift.
const SAMPLES_SHOWN: u64 = 300;
const SAMPLES_BEFORE: u64 = 20;

/// Signals at the top of the save file.
const OVERVIEW: [&str; 29] = [
    "enables.unit",
    "enables.scan",
    "enables.ck",
    "enables.sample",
    "step_x",
    "dir_x",
    "step_y",
    "dir_y",
    "lines_busy",
    "arcs_busy",
    "counts_x",
    "counts_y",
    "torque_x",
    "torque_y",
    "position_x",
    "position_y",
    "drive",
    "lead_angle.predicted",
    "lead_angle.target",
    "lead_angle.comparator.difference",
    "lead_angle.fire",
    "brake",
    "lift_busy",
    "fault",
    "plant.stepper_x",
    "plant.stepper_y",
    "plant.servo_x.load_position",
    "plant.servo_y.load_position",
    "plant.lift.position",
];

pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    let setup = Setup::new(arguments, &job.loaded, &job.stem)?;
    let plan = Plan::new(&job.drawing, &job.settings.motion);
    let plan = plan.map_err(|error| Failure::Check(error.to_string()))?;
    let (program, settings) = (&job.program, &job.settings);
    let circuit = machine(settings);
    let ticks = job.ticks_at_least();
    let stage = Stage {
        circuit: &circuit,
        model: &Elaborated::with_beside(&circuit, &Plants).map_err(RunError::from)?,
        subject: &job.drawing.file,
        work: Work {
            ticks,
            runs: 1,
            seconds: ticks as f64 * TICK_S,
        },
        series: setup.series(|| series_of(job, &plan)),
    };
    let (run, mut files) = with_waves(&setup, stage, |observer| {
        let mut run = UnderWay::new(job, &plan);
        let each = &mut |event| run.take(event);
        let played = play_each(&circuit, program, settings, observer, each)?;
        let end = end(settings, &played);
        Ok((run.finish(played), end))
    })?;
    progress::stage("summary and picture");
    files.write("svg", &picture::draw(job, &run))?;
    let summary = Summary::new(job, &run.played, &run.measured);
    conclude(&setup, files, summary)
}

/// The end of a run; its window is around the first signal that stops the pen lift, or where there is none the first move.
fn end(settings: &Settings, played: &Played) -> End {
    let sample = u64::from(settings.sample_ticks);
    let fired = played.liftings.first().map(|lifting| lifting.fired);
    let begun = played.moves.first().map_or(0, |timed| timed.begun);
    let focus = Focus {
        action: fired.unwrap_or(begun),
        before: SAMPLES_BEFORE * sample,
        shown: SAMPLES_SHOWN * sample,
        overview: &OVERVIEW,
    };
    End {
        ticks: played.ticks,
        focus,
    }
}

/// The time series: commands and motors of the servos, plan and steps of the steppers, target and
/// position of the pen lift, at each sampling time of the servos.
fn series_of<'a>(job: &'a Job, plan: &'a Plan<'a>) -> SeriesLayout<'a> {
    let settings = &job.settings;
    let starts = job.program.report.axes.iter();
    let starts: Vec<_> = starts.map(|axis| f64::from(axis.start_position)).collect();
    let mut sampler = plan.sampler();
    let planned = move |ticks: u64| {
        let at = sampler.at(ticks as f64 / settings.clock_hz as f64).position;
        let steps = at.into_iter().zip(settings.steps_per_mm).zip(&starts);
        steps
            .map(|((mm, per_mm), start)| mm * per_mm - start)
            .collect()
    };
    let servo = |name| {
        let command = series::word(format!("command_join.{name}"));
        let motor = series::plant(&format!("servo_{name}.position"));
        series::axis(name, "counts", command, motor)
    };
    let stepper = |(axis, name)| {
        let name = format!("stepper_{name}");
        let steps = series::word(format!("plant.{name}"));
        series::axis(&name, "steps", Position::Planned { plan: 0, axis }, steps)
    };
    let target = Position::Nearest {
        path: "lead_angle.target".to_owned(),
    };
    let lift = series::axis("lift", "counts", target, series::plant("lift.position"));
    let names = ["x", "y"];
    let servos = names.into_iter().map(servo);
    let steppers = names.into_iter().enumerate().map(stepper);
    // The work of a sampling time may take more or fewer ticks than that of the one before.
    let apart = u64::from(settings.sample_ticks) / 2;
    let rows = series::at("trajectory_controller.x.driven", apart);
    SeriesLayout {
        plans: vec![SeriesPlan {
            clock: "pulse_busy".to_owned(),
            at: Box::new(planned),
        }],
        ..series::layout(rows, servos.chain(steppers).chain([lift]))
    }
}

/// The one system of the summary: all machines that it compares are in the circuit.
pub fn systems(job: &Job) -> Vec<System<'_>> {
    let (program, settings) = (&job.program, &job.settings);
    let system = System::new(Machine::NAME, job.ticks_at_least(), move || {
        let circuit = machine(settings);
        let model = Elaborated::with_beside(&circuit, &Plants).map_err(RunError::from)?;
        let run = move |circuit: &Machine, observer: &mut dyn Observer<Machine>| {
            let played = play_each(circuit, program, settings, observer, &mut |_| {})?;
            Ok(Ending {
                end: end(settings, &played),
                position: ["x", "y"].into_iter().zip(played.motor).collect(),
                unit: "counts",
            })
        };
        Ok((circuit, model, run))
    });
    vec![system]
}
