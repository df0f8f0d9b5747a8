//! Step rates of each axis in the summary, and the result on its motor.

use super::by_axis::ByAxis;
use crate::cli::columns::Table;
use crate::cli::rows::{fixed, or_dash};
use motion_rtl::jobs::pulse_interpolator;
use motion_rtl::jobs::pulse_interpolator::job::Played;
use motion_rtl::jobs::pulse_interpolator::motors::MotorReport;
use motion_rtl::jobs::pulse_interpolator::rates::{StepRates, step_rates};
use serde::Serialize;
use std::fmt;

/// The axes of a run.
pub type Rows = ByAxis<Row>;

/// Step rates of an axis.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Row {
    #[serde(flatten)]
    pub rates: StepRates,
    /// Result of the motor, if there is one.
    pub motor: Option<MotorReport>,
}

/// The axes of a table that was played.
pub fn rows(table: &pulse_interpolator::Table, played: &Played) -> Rows {
    let rates = step_rates(table).into_iter().enumerate();
    let rows = rates.map(|(axis, rates)| Row {
        rates,
        motor: played.motors.get(axis).copied(),
    });
    rows.collect()
}

/// The motors that are not where their drivers are.
pub fn complaints(rows: &Rows) -> impl Iterator<Item = String> {
    rows.iter().filter_map(|(name, row)| {
        let motor = row.motor.as_ref()?;
        let unit = motor.lost_unit?;
        Some(match motor.lost_steps {
            0 => format!("{name}: the motor slips in unit time {unit}, and back again"),
            steps => {
                let lost = steps.unsigned_abs();
                format!("{name}: the motor loses {lost} steps, the first in unit time {unit}")
            }
        })
    })
}

/// Writes the rows as text.
pub fn write(rows: &Rows, text: &mut String) -> fmt::Result {
    let off =
        |motor: &MotorReport| format!("{} ({})", fixed(motor.off_full_steps, 3), motor.off_unit);
    let change = |rates: &StepRates| format!("{} ({})", fixed(rates.change, 1), rates.change_unit);
    Table::of(rows.iter())
        .left("axis", 4, |(name, _)| name)
        .col("steps/s", 9, |(_, row)| fixed(row.rates.largest, 1))
        .col("change steps/s (unit)", 0, |(_, row)| change(&row.rates))
        .col("motor off full steps (unit)", 0, |(_, row)| {
            or_dash(row.motor.as_ref().map(off))
        })
        .col("lost steps", 0, |(_, row)| {
            or_dash(row.motor.map(|motor| motor.lost_steps))
        })
        .write(text)
}
