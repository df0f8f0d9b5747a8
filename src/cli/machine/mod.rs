//! `run` of the machine: one job on all circuits, with waves, summary and picture.

mod job;
mod picture;
mod rows;
mod runs;
mod summary;
mod text;
mod verdict;

pub use job::Job;

use super::Failure;
use super::files::Files;
use super::progress::{self, Work};
use super::report::conclude;
use super::run::{Arguments, in_waves, options};
use super::traces::{Focus, Traces};
use super::waves_of::{Ending, System};
use motion_rtl::circuits::machine::Machine;
use motion_rtl::hdl::{Circuit, Observer, RunError, model_beside};
use motion_rtl::jobs::machine::Settings;
use motion_rtl::jobs::machine::job::{Played, machine, play_each};
use motion_rtl::jobs::machine::waves::Plants;
use motion_rtl::plan::Plan;
use motion_rtl::trace::Options;
use runs::{Run, UnderWay};
use summary::Summary;

/// About how long a tick takes, with all motors.
const TICK_S: f64 = 150e-9;

/// Sampling times in the save file's window, and the count of these before the first signal that
/// stops the pen lift.
const SAMPLES_SHOWN: u64 = 300;
const SAMPLES_BEFORE: u64 = 20;

/// Signals at the top of the save file.
const OVERVIEW: [&str; 28] = [
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
    let options = options(arguments, job.loaded.scenario.vcd_ticks())?;
    let (run, mut files) = simulate(arguments, job, &options)?;
    progress::stage("summary and picture");
    files.write("svg", &picture::draw(job, &run))?;
    let summary = Summary::new(job, &run.played, &run.measured);
    conclude(arguments, &options, files, summary)
}

/// Plays the job with its waves.
fn simulate(arguments: &Arguments, job: &Job, options: &Options) -> Result<(Run, Files), Failure> {
    let plan = Plan::new(&job.drawing, &job.settings.motion);
    let plan = plan.map_err(|error| Failure::Check(error.to_string()))?;
    let (program, settings) = (&job.program, &job.settings);
    let circuit = machine(settings);
    let (ticks, scenario) = (job.ticks_at_least(), (&job.loaded, job.stem.as_str()));
    let model = model_beside(&circuit, &Plants).map_err(RunError::from)?;
    let traces = Traces::begin((&model, &circuit), arguments, scenario, options, ticks)?;
    progress::run(
        &job.drawing.file,
        Work {
            ticks,
            runs: 1,
            seconds: ticks as f64 * TICK_S,
            in_waves: in_waves(arguments, options, ticks),
        },
    );
    traces.play(
        &model,
        |observer| {
            let mut run = UnderWay::new(job, &plan);
            let each = &mut |event| run.take(event);
            let played = play_each(&circuit, program, settings, observer, each)?;
            Ok(run.finish(played))
        },
        |run: &Run| (focus(settings, &run.played), run.played.ticks),
    )
}

/// A window around the first signal that stops the pen lift, or where there is none the first move.
fn focus(settings: &Settings, played: &Played) -> Focus {
    let sample = u64::from(settings.sample_ticks);
    let fired = played.liftings.first().map(|lifting| lifting.fired);
    let begun = played.moves.first().map_or(0, |timed| timed.begun);
    Focus {
        action: fired.unwrap_or(begun),
        before: SAMPLES_BEFORE * sample,
        shown: SAMPLES_SHOWN * sample,
        overview: &OVERVIEW,
    }
}

/// The one system of the summary: all machines that it compares are in the circuit.
pub fn systems(job: &Job) -> Vec<System<'_>> {
    let (program, settings) = (&job.program, &job.settings);
    let system = System::new(Machine::NAME, job.ticks_at_least(), move || {
        let circuit = machine(settings);
        let model = model_beside(&circuit, &Plants).map_err(RunError::from)?;
        let run = move |circuit: &Machine, observer: &mut dyn Observer<Machine>| {
            let played = play_each(circuit, program, settings, observer, &mut |_| {})?;
            Ok(Ending {
                ticks: played.ticks,
                focus: focus(settings, &played),
                position: ["x", "y"].into_iter().zip(played.motor).collect(),
                unit: "counts",
            })
        };
        Ok((circuit, model, run))
    });
    vec![system]
}
