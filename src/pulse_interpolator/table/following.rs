//! Following errors: where the axes are at the end of a unit time, against where the path demands
//! them.

use super::demand::{Demand, Demands, Steps};
use super::error::TableError;
use super::report::FollowingError;
use super::settings::Settings;
use super::words::Table;
use crate::input::{COORDINATES, Drawing};
use crate::plan::Plan;

/// The end of a unit time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnitEnd {
    /// The unit, from 0.
    pub unit: usize,
    /// When it ends, in seconds.
    pub time_s: f64,
    /// Line of the input under way at that time.
    pub line: usize,
    /// Whether that is a rapid move.
    pub rapid: bool,
    /// Demand less position of each axis in steps; 0 for those not driven.
    pub errors: [f64; COORDINATES],
}

/// The largest following error of each axis.
#[derive(Debug, Clone)]
pub(super) struct Following {
    pub(super) largest: Vec<FollowingError>,
}

impl Following {
    pub(super) fn new(axes: usize) -> Self {
        Following {
            largest: vec![FollowingError::default(); axes],
        }
    }

    /// Takes in the end of a unit time with the axes at `positions`.
    pub(super) fn take(
        &mut self,
        unit: usize,
        time_s: f64,
        demand: &Demand,
        positions: impl IntoIterator<Item = i64>,
    ) -> UnitEnd {
        let mut end = UnitEnd {
            unit,
            time_s,
            line: demand.line,
            rapid: demand.rapid,
            errors: [0.0; COORDINATES],
        };
        for (axis, (position, largest)) in positions.into_iter().zip(&mut self.largest).enumerate()
        {
            let error = demand.steps[axis] - Steps::from_num(position);
            let error = error.to_num::<f64>();
            end.errors[axis] = error;
            // Not where it is as large: the first of equals.
            if error.abs() > largest.steps {
                *largest = FollowingError {
                    steps: error.abs(),
                    unit,
                    time_s,
                    line: demand.line,
                };
            }
        }
        end
    }
}

/// Compares where a run of `table` had the axes at the ends of its unit times with where `drawing`
/// demands them: tells `each` of every end, and returns the largest error of each axis.
///
/// `positions` are those of all axes after each unit time, in steps from the start.
///
/// # Errors
///
/// [`TableError`], where `settings` are not those that the table was compiled with.
pub fn follow(
    drawing: &Drawing,
    settings: &Settings,
    table: &Table,
    positions: &[i32],
    mut each: impl FnMut(&UnitEnd),
) -> Result<Vec<FollowingError>, TableError> {
    let axes = table.axes();
    let plan = Plan::new(drawing, &settings.motion)?;
    let mut demands = Demands::new(&plan, settings);
    let start = demands.at(0)?;
    let mut following = Following::new(axes);
    let mut ticks = 0;
    let units = table.iter().zip(positions.chunks_exact(axes));
    for (unit, ((period, _), positions)) in units.enumerate() {
        ticks += u64::from(period);
        let demand = demands.at(ticks)?;
        let positions = positions.iter().enumerate();
        let positions = positions.map(|(axis, &steps)| start.rounded(axis) + i64::from(steps));
        each(&following.take(unit, demands.seconds(ticks), &demand, positions));
    }
    Ok(following.largest)
}
