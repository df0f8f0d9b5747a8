//! Step rates of each axis in the summary, and the result on its motor.

use super::by_axis::ByAxis;
use crate::cli::rows::{fixed, or_dash, table};
use motion_rtl::jobs::pulse_interpolator::Table;
use motion_rtl::jobs::pulse_interpolator::job::Played;
use motion_rtl::jobs::pulse_interpolator::motors::MotorReport;
use motion_rtl::jobs::pulse_interpolator::rates::step_rates;
use serde::Serialize;
use std::fmt;

/// The axes of a run.
pub type Rows = ByAxis<Row>;

/// Step rates of an axis.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Row {
    /// Largest step rate.
    pub largest_per_s: f64,
    /// Largest change from one unit time to the next.
    pub change_per_s: f64,
    /// Index of the unit time that begins with that change.
    pub change_unit: usize,
    /// The motor, if there is one.
    pub motor: Option<MotorRow>,
}

#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MotorRow {
    /// Largest distance between rotor and field, in full steps.
    pub off_full_steps: f64,
    /// The unit time in which.
    pub off_unit: usize,
    /// Steps by which it is behind at rest.
    pub lost_steps: i64,
    /// The first unit time in which it was nearer to another tooth than to its own.
    pub lost_unit: Option<usize>,
}

impl From<&MotorReport> for MotorRow {
    fn from(report: &MotorReport) -> Self {
        MotorRow {
            off_full_steps: report.off_full_steps,
            off_unit: report.off_unit,
            lost_steps: report.lost_steps,
            lost_unit: report.lost_unit,
        }
    }
}

/// The axes of a table that was played.
pub fn rows(table: &Table, played: &Played) -> Rows {
    let rates = step_rates(table).into_iter().enumerate();
    let rows = rates.map(|(axis, rates)| Row {
        largest_per_s: rates.largest,
        change_per_s: rates.change,
        change_unit: rates.change_unit,
        motor: played.motors.get(axis).map(MotorRow::from),
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
    let heads = [
        ("axis", 4),
        ("steps/s", 9),
        ("change steps/s (unit)", 0),
        ("motor off full steps (unit)", 0),
        ("lost steps", 0),
    ];
    let cells = rows.iter().map(|(name, row)| {
        let motor = row.motor.as_ref();
        let off = motor.map(|of| format!("{} ({})", fixed(of.off_full_steps, 3), of.off_unit));
        [
            format!("{name:<4}"),
            fixed(row.largest_per_s, 1),
            format!("{} ({})", fixed(row.change_per_s, 1), row.change_unit),
            or_dash(off),
            or_dash(motor.map(|of| of.lost_steps)),
        ]
    });
    table(text, heads, cells)
}
