//! Why a table cannot be made.

use crate::plan::PlanError;
use crate::settings::SettingError;

/// Why a table cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TableError {
    /// A setting is outside what is allowed.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// The path cannot be planned.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// A position is outside the 32-bit step counters.
    #[error(
        "line {line}: {axis} = {steps} steps: allowed are {} to {}",
        i32::MIN,
        i32::MAX
    )]
    Position {
        /// Line of the input.
        line: usize,
        /// "X", "Y" or "Z".
        axis: &'static str,
        /// The position in steps.
        steps: f64,
    },
    /// The path takes more unit times than a table may have.
    #[error("the path takes {units} unit times: allowed are {most}")]
    TooLong {
        /// Unit times needed, as far as known.
        units: f64,
        /// Unit times allowed.
        most: usize,
    },
    /// A scaled half-period does not fit the memory word.
    #[error("unit {unit}, {axis}: scaled half-period {half_period}: allowed are 1 to {most}")]
    ScaledHalfPeriod {
        /// Unit time, from 0.
        unit: usize,
        /// "X", "Y" or "Z".
        axis: &'static str,
        /// The half-period in ticks.
        half_period: u64,
        /// The longest the word can hold.
        most: u32,
    },
}
