//! Time series of a run on the pulse interpolator.

use super::Job;
use crate::cli::series;
use motion_rtl::circuits::pulse_interpolator::AXIS_NAMES;
use motion_rtl::jobs::pulse_interpolator::positions::TableSteps;
use motion_rtl::jobs::pulse_interpolator::{PathSteps, Table, TableError};
use motion_rtl::plan::Plan;
use motion_rtl::trace::{Position, SeriesAxis, SeriesLayout, SeriesPlan};

/// Returns the plan of a drawing: its exact position.
pub fn of_path<'a>(job: &'a Job, path: &'a Plan<'a>) -> Result<SeriesPlan<'a>, TableError> {
    let mut steps = PathSteps::new(path, &job.settings)?;
    Ok(SeriesPlan {
        clock: "busy".to_owned(),
        // A job that is compiled has no position that does not fit.
        at: Box::new(move |ticks| steps.at(ticks).map_or(Vec::new(), Vec::from)),
    })
}

/// Returns the plan of a table, for the group whose signals are in `scope`.
pub fn of_table<'a>(table: &'a Table, scope: &str) -> SeriesPlan<'a> {
    let mut steps = TableSteps::new(table);
    SeriesPlan {
        clock: format!("{scope}busy"),
        at: Box::new(move |ticks| steps.at(ticks)),
    }
}

/// Returns the axes of the group whose signals are in `scope`; their plan has this number.
fn axes(names: &[&str], scope: &str, plan: usize, has_motors: bool) -> Vec<SeriesAxis> {
    let axes = names.iter().zip(AXIS_NAMES).enumerate();
    let axes = axes.map(|(axis, (name, letter))| {
        let actual = match has_motors {
            true => series::plant(&format!("{letter}.position")),
            false => Position::Steps {
                step: format!("{scope}step_{letter}"),
                dir: format!("{scope}dir_{letter}"),
            },
        };
        series::axis(name, "steps", Position::Planned { plan, axis }, actual)
    });
    axes.collect()
}

/// Returns the layout of a group: its plan, and steps or motors.
pub fn of_group(count: usize, has_motors: bool, plan: SeriesPlan<'_>) -> SeriesLayout<'_> {
    let axes = axes(&AXIS_NAMES[..count], "", 0, has_motors);
    SeriesLayout {
        plans: vec![plan],
        ..series::layout(series::at("unit_rst", 1), axes)
    }
}

/// Returns the layout of several groups, each with the scope of its signals, its table and the
/// names of its axes. A row is at the end of each unit time of the first.
pub fn of_groups<'a>(
    groups: impl IntoIterator<Item = (&'a str, &'a Table, &'a [&'a str])>,
) -> SeriesLayout<'a> {
    let (mut plans, mut all, mut strobe) = (Vec::new(), Vec::new(), None);
    for (scope, table, names) in groups {
        strobe.get_or_insert(format!("{scope}unit_rst"));
        all.extend(axes(&names[..table.axes()], scope, plans.len(), false));
        plans.push(of_table(table, scope));
    }
    SeriesLayout {
        plans,
        ..series::layout(series::at(&strobe.unwrap_or_default(), 1), all)
    }
}
