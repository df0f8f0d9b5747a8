//! Settings for compiling a table: machine, clock and unit times.

use super::count_table::PulseLimits;
use crate::circuits::pulse_interpolator::AXIS_NAMES;
use crate::input::COORDINATES;
use crate::plan::MotionLimits;
use crate::settings::{CLOCK_RANGE_HZ, COUNTS_PER_MM_RANGE, Place, SettingError, settings, within};
use std::ops::RangeInclusive;

/// Widths of the half-period and of the unit-time register that are accepted, in bits. The memory
/// word keeps one of its 32 bits for the direction.
pub const WIDTH_RANGE: RangeInclusive<u32> = 2..=31;

/// Unit times that the words of a full-size memory hold, in ticks.
pub const UNIT_RANGE_TICKS: RangeInclusive<u32> = 2..=3 * ((1 << HALF_PERIOD_BITS) - 1);
/// Width of the half-period in the memory word, in bits.
const HALF_PERIOD_BITS: u32 = 16;

settings! {
    /// Timing that the motor driver requires of its step and direction inputs, in reference ticks.
    #[derive(Copy, Eq)]
    pub struct StepTiming {
        /// Shortest high time of the step line.
        pub step_high_ticks: u32 = 2, within 0..=*UNIT_RANGE_TICKS.end() / 2, "up to half of a unit time";
        /// Shortest low time of the step line.
        pub step_low_ticks: u32 = 2, within 0..=*UNIT_RANGE_TICKS.end(), "what a unit time leaves beside the high time";
        /// Shortest time from a change of the direction line to the next step.
        pub dir_setup_ticks: u32 = 5, within 0..=*UNIT_RANGE_TICKS.end(), "what a unit time leaves beside the high time";
        /// Shortest time from a step to a change of the direction line.
        pub dir_hold_ticks: u32 = 5, within 0..=*UNIT_RANGE_TICKS.end(), "up to a unit time";
    }
}

impl StepTiming {
    /// Timing of a driver that requires nothing.
    pub const NONE: Self = StepTiming {
        step_high_ticks: 0,
        step_low_ticks: 0,
        dir_setup_ticks: 0,
        dir_hold_ticks: 0,
    };
}

/// Settings of [`compile`](super::compile()).
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Reference clock in Hz.
    pub clock_hz: u64,
    /// Steps per millimetre of one to three axes: of X, or X and Y, or X, Y and Z. Negative where
    /// the motor's positive direction is the coordinate's negative one.
    pub steps_per_mm: Vec<f64>,
    /// Feeds, corner speed and acceleration.
    pub motion: MotionLimits,
    /// Unit time T2 of lines (paragraph 0014), in ticks.
    pub line_unit_ticks: u32,
    /// Unit time T1 of arcs (paragraph 0014), in ticks.
    pub arc_unit_ticks: u32,
    /// Width of the half-period in the memory word, in bits.
    pub half_period_bits: u32,
    /// Width of the unit-time register, in bits.
    pub period_bits: u32,
    /// Limits of the motor driver.
    pub timing: StepTiming,
}

impl Default for Settings {
    /// Two axes of 80 steps/mm at 1 MHz, 1 ms of unit time, and a driver that wants 2 µs high and
    /// low and 5 µs about a change of direction.
    fn default() -> Self {
        Self {
            clock_hz: 1_000_000,
            steps_per_mm: vec![80.0; 2],
            motion: MotionLimits::default(),
            line_unit_ticks: 1000,
            arc_unit_ticks: 1000,
            half_period_bits: HALF_PERIOD_BITS,
            period_bits: 24,
            timing: StepTiming::default(),
        }
    }
}

impl Settings {
    /// Checks every field.
    ///
    /// # Errors
    ///
    /// Names the first field at fault, its value and what is allowed.
    pub fn validate(&self) -> Result<(), SettingError> {
        within("clock_hz", self.clock_hz, &CLOCK_RANGE_HZ)?;
        if !(1..=COORDINATES).contains(&self.steps_per_mm.len()) {
            let problem = format!("has {} numbers", self.steps_per_mm.len());
            let allowed = format!("1 to {COORDINATES} numbers, one for each axis");
            return Err(SettingError::new("steps_per_mm", problem, allowed));
        }
        for (value, name) in self.steps_per_mm.iter().zip(AXIS_NAMES) {
            if !COUNTS_PER_MM_RANGE.contains(&value.abs()) {
                let (least, most) = COUNTS_PER_MM_RANGE.into_inner();
                let allowed = format!("{least} to {most}, or the negative of that");
                let error = SettingError::value("steps_per_mm", value, allowed);
                return Err(error.at(Place::Element(name)));
            }
        }
        self.motion.ranges()?;
        within("half_period_bits", self.half_period_bits, &WIDTH_RANGE)?;
        within("period_bits", self.period_bits, &WIDTH_RANGE)?;
        self.check_period("line_unit_ticks", self.line_unit_ticks)?;
        self.check_period("arc_unit_ticks", self.arc_unit_ticks)
    }

    /// A unit time must hold one pulse, also just after a change of direction: else a table could
    /// not end on every position. One pulse needs a half-period of a third of T.
    fn check_period(&self, field: &'static str, period: u32) -> Result<(), SettingError> {
        let StepTiming {
            step_high_ticks: min_high,
            step_low_ticks: min_low,
            dir_setup_ticks: dir_setup,
            dir_hold_ticks: dir_hold,
        } = self.timing;
        let max_half_period = self.pulse_limits().max_half_period;
        let longest = ((1 << self.period_bits) - 1).min(max_half_period.saturating_mul(3));
        within(field, period, &(2..=longest))?;
        within(
            "step_high_ticks",
            min_high,
            &(0..=max_half_period.min(period / 2)),
        )?;
        let room = 0..=max_half_period.min(period - min_high.max(1));
        within("step_low_ticks", min_low, &room)?;
        within("dir_setup_ticks", dir_setup, &room)?;
        within("dir_hold_ticks", dir_hold, &(0..=period))
    }

    /// Returns the limits of a unit's pulses while the direction stays the same.
    #[must_use]
    pub fn pulse_limits(&self) -> PulseLimits {
        let timing = self.timing;
        PulseLimits::new(
            self.half_period_bits,
            timing.step_high_ticks,
            timing.step_low_ticks,
        )
    }

    /// Returns these settings with one unit time for lines and arcs.
    #[must_use]
    pub fn with_period(&self, period: u32) -> Self {
        Self {
            line_unit_ticks: period,
            arc_unit_ticks: period,
            ..self.clone()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::count_table::CountTable;
    use super::*;

    fn refusal(change: impl FnOnce(&mut Settings)) -> String {
        let mut settings = Settings::default();
        change(&mut settings);
        settings.validate().unwrap_err().to_string()
    }

    #[test]
    fn every_field_is_refused_by_name_value_and_range() {
        assert_eq!(Settings::default().validate(), Ok(()));
        let cases = [
            (
                refusal(|s| s.clock_hz = 0),
                "clock_hz: is 0; allowed: 1 to 10000000000",
            ),
            (
                refusal(|s| s.steps_per_mm.clear()),
                "steps_per_mm: has 0 numbers; allowed: 1 to 3 numbers, one for each axis",
            ),
            (
                refusal(|s| s.steps_per_mm = vec![1.0; 4]),
                "steps_per_mm: has 4 numbers",
            ),
            (
                refusal(|s| s.steps_per_mm[1] = 0.0),
                "steps_per_mm: is 0 for y; allowed: 0.000001 to",
            ),
            (
                refusal(|s| s.steps_per_mm[0] = f64::NAN),
                "steps_per_mm: is NaN for x",
            ),
            (
                refusal(|s| s.steps_per_mm[0] = -2e9),
                "steps_per_mm: is -2000000000 for x",
            ),
            (
                refusal(|s| s.motion.feed_mm_per_min = 0.0),
                "feed_mm_per_min: is 0; allowed: 0.001",
            ),
            (
                refusal(|s| s.line_unit_ticks = 1),
                "line_unit_ticks: is 1; allowed: 2 to 196605",
            ),
            (
                refusal(|s| s.arc_unit_ticks = 196_606),
                "arc_unit_ticks: is 196606; allowed: 2 to 196605",
            ),
            (
                refusal(|s| s.period_bits = 9),
                "line_unit_ticks: is 1000; allowed: 2 to 511",
            ),
            (
                refusal(|s| s.half_period_bits = 8),
                "line_unit_ticks: is 1000; allowed: 2 to 765",
            ),
            (
                refusal(|s| s.half_period_bits = 32),
                "half_period_bits: is 32; allowed: 2 to 31",
            ),
            (
                refusal(|s| s.period_bits = 1),
                "period_bits: is 1; allowed: 2 to 31",
            ),
            (
                refusal(|s| s.timing.step_high_ticks = 501),
                "step_high_ticks: is 501; allowed: 0 to 500",
            ),
            (
                refusal(|s| s.timing.step_low_ticks = 999),
                "step_low_ticks: is 999; allowed: 0 to 998",
            ),
            (
                refusal(|s| s.timing.dir_setup_ticks = 999),
                "dir_setup_ticks: is 999; allowed: 0 to 998",
            ),
            (
                refusal(|s| s.timing.dir_hold_ticks = 1001),
                "dir_hold_ticks: is 1001; allowed: 0 to 1000",
            ),
        ];
        for (message, expected) in cases {
            assert!(message.starts_with(expected), "{message}");
        }
    }

    /// The closed form of the ranges above against the table itself.
    #[test]
    fn accepted_unit_times_are_those_that_hold_one_pulse() {
        let sizes = [0, 1, 2, 3, 5, 9];
        for bits in 2..=4 {
            for period in 2..20 {
                for (min_high, min_low) in sizes.iter().flat_map(|&h| sizes.map(|l| (h, l))) {
                    for dir_setup in sizes {
                        let timing = StepTiming {
                            step_high_ticks: min_high,
                            step_low_ticks: min_low,
                            dir_setup_ticks: dir_setup,
                            dir_hold_ticks: 0,
                        };
                        let settings = Settings {
                            half_period_bits: bits,
                            timing,
                            ..Settings::default().with_period(period)
                        };
                        let limits = PulseLimits {
                            lead: dir_setup,
                            ..settings.pulse_limits()
                        };
                        let holds_one = CountTable::new(period, &limits).contains(1);
                        assert_eq!(settings.validate().is_ok(), holds_one, "{settings:?}");
                    }
                }
            }
        }
    }
}
