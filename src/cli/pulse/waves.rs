//! The systems of a job with their waves.

use super::beside::moves;
use super::{Job, end, play_on};
use crate::cli::traces::{End, Focus};
use crate::cli::waves_of::{Ending, System};
use motion_rtl::circuits::pulse_interpolator::group::In;
use motion_rtl::circuits::pulse_interpolator::{AXIS_NAMES, Conventional, Group};
use motion_rtl::hdl::{Circuit, Value};
use motion_rtl::jobs::pulse_interpolator::beside::{device, play};
use motion_rtl::jobs::pulse_interpolator::job::group;
use motion_rtl::jobs::pulse_interpolator::motors::{Motors, StepMotors};
use motion_rtl::jobs::pulse_interpolator::{ControlComputer, Table};
use motion_rtl::sim::{Elaborated, Observer, RunError};
use std::collections::BTreeMap;

/// Unit times of the conventional device that the save file's window shows.
const UNITS_SHOWN: u64 = 6;

/// Rows on top of the save file of the conventional device; an axis that the job has not is left
/// out.
const OVERVIEW: [&str; 22] = [
    "unit_rst",
    "interpolator.state",
    "cordic.turning.iteration",
    "controller.state",
    "controller.x.amount",
    "controller.x.half_period",
    "x.count",
    "step_x",
    "dir_x",
    "plant.x.position",
    "controller.y.amount",
    "controller.y.half_period",
    "y.count",
    "step_y",
    "dir_y",
    "plant.y.position",
    "controller.z.amount",
    "controller.z.half_period",
    "z.count",
    "step_z",
    "dir_z",
    "plant.z.position",
];

/// The systems of the summary.
pub fn systems(job: &Job) -> Vec<System<'_>> {
    let group = group(&job.table, job.variant.into());
    let computer = |group: &Group| {
        let mut computer = ControlComputer::new(group, &job.table);
        move |pending| computer.drive(pending)
    };
    vec![
        own(group, &job.table, job.motors.clone(), computer),
        conventional(job),
    ]
}

/// A circuit, with its motors if there are any.
pub fn shown<C: Circuit>(
    circuit: &C,
    axes: usize,
    motors: Option<&Motors>,
) -> Result<Elaborated, RunError> {
    Ok(match motors {
        None => Elaborated::new(circuit),
        Some(_) => Elaborated::with_beside(circuit, &StepMotors { axes }),
    }?)
}

/// The end of a run with the positions of its axes by name.
pub(super) fn ending(end: End, ends: impl Iterator<Item = (&'static str, i64)>) -> Ending {
    Ending {
        end,
        position: ends.collect::<BTreeMap<_, _>>(),
        unit: "steps",
    }
}

/// A group with the computer that has it play a table.
pub fn own<'a, F: FnMut(bool) -> Option<In<Value>> + 'a>(
    group: Group,
    table: &'a Table,
    motors: Option<Motors>,
    computer: impl FnOnce(&Group) -> F + 'a,
) -> System<'a> {
    System::new(Group::NAME, table.total_ticks(), move || {
        let model = shown(&group, group.axes, motors.as_ref())?;
        let run = move |group: &Group, observer: &mut dyn Observer<Group>| {
            let mut computer = computer(group);
            let played = play_on(group, table, (&mut computer, motors), observer)?;
            let ends = played.axes.iter().map(|axis| axis.position());
            let ends = AXIS_NAMES.into_iter().zip(ends);
            Ok(ending(end(table, &played), ends))
        };
        Ok((group, model, run))
    })
}

/// The conventional device of Fig. 5.
fn conventional(job: &Job) -> System<'_> {
    System::new(Conventional::NAME, job.table.total_ticks(), move || {
        let axes = job.table.axes();
        let orders = moves(job)?.orders;
        let (circuit, motors) = (device(axes, &orders), job.motors.clone());
        let model = shown(&circuit, axes, motors.as_ref())?;
        let unit = orders.first().map_or(1, |order| u64::from(order.period));
        let run = move |circuit: &Conventional, observer: &mut dyn Observer<Conventional>| {
            let seen = play(circuit, &orders, motors, observer)?;
            let focus = Focus {
                action: seen.first_step.unwrap_or(0),
                before: unit,
                shown: UNITS_SHOWN * unit,
                overview: &OVERVIEW,
            };
            let ends = seen.positions.iter().rev().take(axes).rev();
            let ends = AXIS_NAMES.into_iter().zip(ends.map(|end| i64::from(*end)));
            let ticks = seen.ticks;
            Ok(ending(End { ticks, focus }, ends))
        };
        Ok((circuit, model, run))
    })
}
