//! `run` of the pulse interpolator: its job, waves, summary and picture.

mod beside;
mod by_axis;
mod job;
pub mod patterns;
mod picture;
mod rates;
mod series;
mod summary;
mod text;
mod verdict;
mod waves;

pub use job::{Job, table_fault};
pub use summary::{Summary, TableSummary, warnings};
pub use waves::{own, systems};

use super::Failure;
use super::arguments::Arguments;
use super::files::Files;
use super::progress::{self, Work};
use super::report::conclude;
use super::setup::Setup;
use super::simulate::{Stage, with_waves};
use super::traces::{End, Focus};
use motion_rtl::circuits::pulse_interpolator::Group;
use motion_rtl::jobs::JobError;
use motion_rtl::jobs::pulse_interpolator::job::{
    Computer, Played, fast_forward_by, group, play_by, play_motors,
};
use motion_rtl::jobs::pulse_interpolator::motors::Motors;
use motion_rtl::jobs::pulse_interpolator::{ControlComputer, Table};
use motion_rtl::plan::Plan;

use motion_rtl::sim::Observer;
use motion_rtl::trace::SeriesPlan;
use picture::{Following, draw};

/// About how long a unit time takes where idle ticks are gone over, and a tick where they are not.
const UNIT_S: f64 = 0.5e-6;
const TICK_S: f64 = 20e-9;

/// Unit times that the save file's window shows.
const UNITS_SHOWN: u64 = 6;

/// Signals at the top of the save file; those of axes that the job lacks are omitted.
const OVERVIEW: [&str; 19] = [
    "unit_rst",
    "x.memory.half_period",
    "x.generator.count",
    "step_x",
    "dir_x",
    "plant.x.position",
    "plant.x.ahead",
    "y.memory.half_period",
    "y.generator.count",
    "step_y",
    "dir_y",
    "plant.y.position",
    "plant.y.ahead",
    "z.memory.half_period",
    "z.generator.count",
    "step_z",
    "dir_z",
    "plant.z.position",
    "plant.z.ahead",
];

pub fn run(arguments: &Arguments, job: &Job) -> Result<(), Failure> {
    has_no_segments(arguments)?;
    let setup = Setup::new(arguments, &job.loaded, &job.stem)?;
    let group = group(&job.table, job.variant.into());
    let mut computer = ControlComputer::new(&group, &job.table);
    let path = arguments.series.as_ref().map(|_| {
        let path = Plan::new(&job.drawing, &job.settings.motion);
        path.map_err(|error| Failure::Check(error.to_string()))
    });
    let path = path.transpose()?;
    let plan = path.as_ref().map(|path| series::of_path(job, path));
    let plan = plan.transpose();
    let (played, mut files) = play_table(
        &setup,
        (&group, &job.table),
        plan.map_err(|error| Failure::Check(error.to_string()))?,
        (&mut |pending| computer.drive(pending), job.motors.clone()),
        true,
    )?;
    progress::stage("following errors");
    let following =
        Following::new(job, &played).map_err(|error| Failure::Check(error.to_string()))?;
    let own = beside::own(job, &played, following.end_error)?;
    let (circuits, astray) = match job.loaded.scenario.beside() {
        true => {
            progress::stage("the conventional device, and the least T");
            beside::compare(job, own)?
        }
        false => (vec![own], Vec::new()),
    };
    let summary = Summary::new(job, &played, &following.largest, (circuits, astray));
    progress::stage("summary and picture");
    files.write("svg", &draw(job, following))?;
    conclude(&setup, files, summary)
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

/// Has a computer play a table on the pulse interpolator, with its waves. If the computer `skips`
/// idle ticks and no file needs them, these are gone over.
fn play_table(
    setup: &Setup<'_>,
    (group, table): (&Group, &Table),
    plan: Option<SeriesPlan<'_>>,
    (computer, motors): (&mut Computer<'_>, Option<Motors>),
    skips: bool,
) -> Result<(Played, Files), Failure> {
    let ticks = table.total_ticks();
    let idle = skips && motors.is_none() && setup.skips_ticks();
    let stage = Stage {
        circuit: group,
        model: &waves::shown(group, group.axes, motors.as_ref())?,
        subject: setup.stem,
        work: Work {
            ticks,
            runs: 1,
            seconds: match idle {
                true => table.units() as f64 * UNIT_S,
                false => ticks as f64 * TICK_S,
            },
        },
        series: plan
            .and_then(|plan| setup.series(|| series::of_group(group.axes, motors.is_some(), plan))),
    };
    with_waves(setup, stage, |observer| {
        let played = match idle {
            true => fast_forward_by(group, table, computer, observer)?,
            false => play_on(group, table, (computer, motors), observer)?,
        };
        let end = end(table, &played);
        Ok((played, end))
    })
}

/// Plays a table, with motors if there are any.
fn play_on(
    group: &Group,
    table: &Table,
    (computer, motors): (&mut Computer<'_>, Option<Motors>),
    observer: &mut dyn Observer<Group>,
) -> Result<Played, JobError> {
    match motors {
        None => play_by(group, table, computer, observer),
        Some(motors) => play_motors(group, table, computer, motors, observer),
    }
}

/// The end of a run; its window begins a unit time before the first step.
fn end(table: &Table, played: &Played) -> End {
    let unit = u64::from(table.patterns().first().map_or(1, |first| first.period));
    let focus = Focus {
        action: played.first_step.unwrap_or(played.begun),
        before: unit,
        shown: UNITS_SHOWN * unit,
        overview: &OVERVIEW,
    };
    End {
        ticks: played.ticks,
        focus,
    }
}
