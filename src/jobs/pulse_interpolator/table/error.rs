//! Errors of table compilation.

use crate::plan::PlanError;
use crate::settings::SettingError;

/// Reason why a table cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TableError {
    /// A setting is out of range.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// The path cannot be planned.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// A position exceeds the 32-bit step counters.
    #[error(
        "line {line}: {axis} = {steps} steps: allowed are {} to {}",
        i32::MIN,
        i32::MAX
    )]
    Position {
        /// Line of the input.
        line: usize,
        /// Axis: "X", "Y" or "Z".
        axis: &'static str,
        /// Position in steps.
        steps: f64,
    },
    /// The path takes more unit times than a table may have.
    #[error("the path takes {units} unit times: allowed are {most}")]
    TooLong {
        /// Number of unit times needed, as far as known.
        units: f64,
        /// Number of unit times allowed.
        most: usize,
    },
    /// A scaled half-period does not fit the memory word.
    #[error("unit {unit}, {axis}: scaled half-period {half_period} is not from 1 to {most}")]
    ScaledHalfPeriod {
        /// Unit time, from 0.
        unit: usize,
        /// Axis: "X", "Y" or "Z".
        axis: &'static str,
        /// Half-period in ticks.
        half_period: u64,
        /// Greatest half-period of the word.
        most: u32,
    },
}
