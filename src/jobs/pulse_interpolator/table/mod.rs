//! Conversion of a drawing to the contents of the pattern memory.
//!
//! [`counts`](crate::circuits::pulse_interpolator::counts) gives the pulses of a half-period in a
//! unit time and the possible counts; [`compile()`] turns a drawing into a [`Table`] of
//! half-periods, with a report; [`Table::scaled`] is the text's scaling by multiplying the data.

mod compile;
mod count_table;
mod demand;
mod error;
mod following;
mod packed;
pub mod read;
mod remedy;
mod report;
mod scale;
mod settings;
mod words;

pub use compile::{compile, compile_unfollowed};
pub use count_table::{CountTable, Offer, PulseLimits, choose_half_period};
pub use error::TableError;
pub use following::{PathSteps, UnitDemand, UnitErrors, demanded, follow};
pub use packed::UnitWords;
pub use report::{AxisReport, FollowingError, Remedy, Report};
pub use scale::{AxisScaling, Ratio, Scaled};
pub use settings::{Settings, StepTiming, UNIT_RANGE_TICKS, WIDTH_RANGE};
pub use words::{MAX_UNITS, Pattern, Table, Word};
