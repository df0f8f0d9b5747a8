//! Settings of circuits and plants: the checks that they have in common, and what is said of one
//! that is refused.

mod key;
mod listing;
mod renamed;
mod table;

pub use key::{Defaults, Key, Shape, Value};
pub(crate) use key::{choices, names};
pub use listing::{Row, rows};
pub(crate) use listing::{allowed, find, kind};
pub(crate) use table::{
    ALLOWED, beside, defaults, has, next, optional, read_keys, read_table, settings, unknown,
};
pub use table::{Table, Within};

use std::fmt::{self, Display};
use std::ops::RangeInclusive;

mod pair;

pub use pair::{Pair, PairError};
pub(crate) use pair::{key_value, unread, value};

/// Clocks that are accepted, in Hz.
pub const CLOCK_RANGE_HZ: RangeInclusive<u64> = 1..=10_000_000_000;

/// Counts or steps per millimetre that are accepted.
pub const COUNTS_PER_MM_RANGE: RangeInclusive<f64> = 1e-6..=1e9;

/// Steps per millimetre that are accepted, but for 0 and what is nearer to it than the least of
/// [`COUNTS_PER_MM_RANGE`].
pub(crate) const STEPS_PER_MM_RANGE: RangeInclusive<f64> =
    -*COUNTS_PER_MM_RANGE.end()..=*COUNTS_PER_MM_RANGE.end();

/// Counts that an axis that is in position may be off by.
pub const IN_POSITION_RANGE: RangeInclusive<u32> = 1..=1_000_000;

/// Relative error within which a time is a whole number of ticks or samples: decimal fractions are
/// not exact in binary.
const WHOLE: f64 = 1e-9;

/// Rounds a number for display to 12 digits, which hides floating-point rounding; a number of 10^9
/// or more is unchanged.
#[must_use]
pub fn tidy(value: f64) -> f64 {
    match value.abs() < 1e9 {
        true => format!("{value:.11e}").parse().unwrap_or(value),
        false => value,
    }
}

/// Longest number that is written with all of its digits.
const LONGEST_NUMBER: usize = 24;

/// Formats a value; a number with many digits as a power of ten.
fn brief(value: impl Display) -> String {
    let text = value.to_string();
    match text.parse::<f64>() {
        Ok(number) if text.len() > LONGEST_NUMBER => format!("{number:e}"),
        _ => text,
    }
}

/// Place of a setting that is part of a list or a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// In a list: the element for the axis of this name.
    Element(&'static str),
    /// In the table of this name.
    Table(&'static str),
    /// In one of the tables of this name, from 0.
    Row(&'static str, usize),
}

/// A setting outside what is allowed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SettingError {
    /// Name of the setting, as in scenarios.
    pub field: &'static str,
    /// Place of the setting; `None` if it stands alone.
    pub place: Option<Place>,
    /// The problem.
    pub problem: String,
    /// Allowed values.
    pub allowed: String,
}

impl SettingError {
    /// A setting by itself.
    pub fn new(
        field: &'static str,
        problem: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Self {
        SettingError {
            field,
            place: None,
            problem: problem.into(),
            allowed: allowed.into(),
        }
    }

    /// A setting by itself whose value is at fault.
    pub fn value(field: &'static str, value: impl Display, allowed: impl Into<String>) -> Self {
        Self::new(field, format!("is {}", brief(value)), allowed)
    }

    /// Returns the error with a place.
    #[must_use]
    pub fn at(self, place: Place) -> Self {
        SettingError {
            place: Some(place),
            ..self
        }
    }
}

impl std::error::Error for SettingError {}

impl Display for SettingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let SettingError {
            field,
            place,
            problem,
            allowed,
        } = self;
        match place {
            None => write!(f, "{field}: {problem}")?,
            Some(Place::Element(axis)) => write!(f, "{field}: {problem} for {axis}")?,
            Some(Place::Table(name)) => write!(f, "{name}.{field}: {problem}")?,
            Some(Place::Row(name, index)) => write!(f, "{name} {index}: {field}: {problem}")?,
        }
        write!(f, "; allowed: {allowed}")
    }
}

/// Refuses a value that is out of range or not a number.
///
/// # Errors
/// Names the setting, its value and the range.
pub fn within<T: PartialOrd + Display>(
    field: &'static str,
    value: T,
    allowed: &RangeInclusive<T>,
) -> Result<(), SettingError> {
    if allowed.contains(&value) {
        return Ok(());
    }
    let ends = [allowed.start(), allowed.end()].map(brief);
    let range = match allowed.is_empty() {
        true => format!(
            "none with the other settings: {} or more, and at most {}",
            ends[0], ends[1]
        ),
        false => ends.join(" to "),
    };
    Err(SettingError::value(field, value, range))
}

/// A time as ticks of the clock, which must be whole and within what is allowed.
///
/// # Errors
/// Names the setting, its value, and the times that are ticks.
pub fn whole_ticks(
    field: &'static str,
    time_ms: f64,
    clock_hz: u64,
    allowed: &RangeInclusive<u64>,
) -> Result<u32, SettingError> {
    let ms = |ticks: f64| ticks * 1e3 / clock_hz as f64;
    let [least, most] = [*allowed.start(), *allowed.end()].map(|ticks| ticks as f64);
    let ticks = time_ms * clock_hz as f64 / 1e3;
    // Written so that NaN fails.
    if !(ticks >= least - 0.5 && ticks <= most + 0.5) {
        let allowed = format!("{} to {} ms: {least} to {most} ticks", ms(least), ms(most));
        return Err(SettingError::value(field, time_ms, allowed));
    }
    let whole = whole(ticks).ok_or_else(|| {
        let [below, above] = [ticks.floor(), ticks.ceil()].map(ms);
        // Without the rounding of the division.
        let ticks = (ticks * 1e6).round() / 1e6;
        let time = format!("{time_ms}: {ticks} ticks");
        SettingError::value(field, time, format!("whole ticks: {below} or {above}"))
    })?;
    Ok(whole as u32)
}

/// A whole number within the rounding of decimal fractions.
pub(crate) fn whole(value: f64) -> Option<u64> {
    let nearest = value.round();
    ((value - nearest).abs() <= WHOLE * nearest).then_some(nearest as u64)
}

/// A time that is taken as a whole number of periods: the nearest, at least one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WholeTime {
    /// The setting.
    pub field: &'static str,
    /// The setting in milliseconds.
    pub wanted_ms: f64,
    /// The period in milliseconds.
    pub period_ms: f64,
    /// Periods that are taken.
    pub periods: u64,
}

impl WholeTime {
    pub(crate) fn new(field: &'static str, wanted_ms: f64, period_ms: f64) -> Self {
        WholeTime {
            field,
            wanted_ms,
            period_ms,
            periods: (wanted_ms / period_ms).round().max(1.0) as u64,
        }
    }

    /// The time that is taken.
    #[must_use]
    pub fn ms(&self) -> f64 {
        self.periods as f64 * self.period_ms
    }

    /// Returns true if the time differs from the setting by more than decimal rounding.
    #[must_use]
    pub fn is_rounded(&self) -> bool {
        (self.ms() - self.wanted_ms).abs() > WHOLE * self.ms()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_of_floating_point_is_not_shown() {
        assert_eq!(tidy(99.999_999_999_999_99), 100.0);
        assert_eq!(tidy(-0.1 - 0.2), -0.3);
        assert_eq!(tidy(1e9 + 0.01), 1e9 + 0.01);
        assert!(tidy(f64::NAN).is_nan());
    }

    #[test]
    fn what_is_refused_is_told_with_its_place() {
        let error = || within("friction_nm", f64::NAN, &(0.0..=2.5)).unwrap_err();
        let shown = |place| error().at(place).to_string();
        let problem = "friction_nm: is NaN";
        assert_eq!(error().to_string(), format!("{problem}; allowed: 0 to 2.5"));
        assert_eq!(
            shown(Place::Element("y")),
            format!("{problem} for y; allowed: 0 to 2.5")
        );
        assert_eq!(
            shown(Place::Table("lift")),
            format!("lift.{problem}; allowed: 0 to 2.5")
        );
        assert_eq!(
            shown(Place::Row("axis", 1)),
            format!("axis 1: {problem}; allowed: 0 to 2.5")
        );
        assert_eq!(within("ends", 0, &(0..=9)), Ok(()));
        assert_eq!(within("ends", 9, &(0..=9)), Ok(()));
    }
}
