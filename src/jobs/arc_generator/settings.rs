//! Settings of the arc generator: clock and sampling, machine, motion.

use super::mechanism::Mechanism;
use super::prepare::Timing;
use crate::circuits::arc_generator::{ArcGenerator, Blend, Rounding, Widths};
use crate::input::Point;
use crate::jobs::taught::{REACH_RANGE_MM, TaughtPiece};
use crate::path::arm::Arm;
use crate::path::pieces::Speeds;
use crate::settings::{
    CLOCK_RANGE_HZ, COUNTS_PER_MM_RANGE, SettingError, choices, settings, whole, whole_ticks,
    within,
};
use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;

/// Shortest sampling period in ticks: a record is fetched and a rotation done within it.
pub const LEAST_SAMPLE_TICKS: u64 = least_sample_ticks(Blend::Differences);

/// Returns the shortest sampling period in ticks by kind of blend: products take longer than a
/// rotation.
#[must_use]
pub const fn least_sample_ticks(blend: Blend) -> u64 {
    ArcGenerator::new(Rounding::Nearest, blend).least_period()
}

/// Speeds that are accepted.
pub const SPEED_RANGE_MM_PER_MIN: RangeInclusive<f64> = 6e-5..=6e10;

/// Sampling periods at any clock, in milliseconds.
const SAMPLE_RANGE_MS: RangeInclusive<f64> = LEAST_SAMPLE_TICKS as f64 * 1e3
    / *CLOCK_RANGE_HZ.end() as f64
    ..=((1u64 << Widths::FULL.period) - 1) as f64 * 1e3;

/// Treatment of a piece that is too short or too tight for its speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ShortPieces {
    /// Refused, with an error that says the largest speed that fits.
    #[default]
    Refuse,
    /// Run at the largest speed that fits.
    Slower,
}

choices!(Blend, Rounding, ShortPieces);

settings! {
    /// Settings of a path, its pieces and a run. Default: 1 µm a count, 1 ms of sampling at 1 MHz,
    /// blends of 64 ms.
    pub struct Settings {
        /// Start of the first piece.
        pub start_mm: Point = [0.0; 3], in REACH_RANGE_MM;
        /// Pieces of the path, if it is not a drawing.
        pub piece: Vec<TaughtPiece> = Vec::new();
        /// Reference clock.
        pub clock_hz: u64 = 1_000_000, in CLOCK_RANGE_HZ;
        /// Ts: time from one position command to the next, in whole ticks.
        pub sample_period_ms: f64 = 1.0, within SAMPLE_RANGE_MS, "as many ticks as the circuit needs, or more";
        /// 2ta: duration of a blend, an even number of samples.
        pub acceleration_ms: f64 = 64.0,
            within 2.0 * *SAMPLE_RANGE_MS.start()
                ..=*SAMPLE_RANGE_MS.end() * Widths::FULL.most_samples() as f64,
            "2 samples to what the words hold";
        /// Counts of a position command per millimetre, of every coordinate.
        pub counts_per_mm: f64 = 1000.0, in COUNTS_PER_MM_RANGE;
        /// Speed of the pieces that have none of their own.
        pub feed_mm_per_min: Option<f64> = None, in SPEED_RANGE_MM_PER_MIN;
        /// Speed with the pen up, and of G0.
        pub rapid_mm_per_min: f64 = 12_000.0, in SPEED_RANGE_MM_PER_MIN;
        /// Largest turn between two pieces that are joined without a stop.
        pub corner_deg: f64 = 20.0, in 0.0..=180.0;
        /// Rounding of the rotation.
        pub rounding: Rounding = Rounding::default();
        /// Way in which blends and lines are made.
        pub blend: Blend = Blend::default();
        /// Treatment of a piece that is too short or too tight for its speed: it is refused, or runs
        /// at the largest speed that fits.
        pub short_pieces: ShortPieces = ShortPieces::default();
        /// Arm whose hand follows the commands.
        pub arm: Option<Arm> = None;
        /// Elastic mechanism that follows the commands.
        pub mechanism: Option<Mechanism> = None;
    }
}

impl Settings {
    /// Checks every field.
    ///
    /// # Errors
    /// Names the first field at fault, its value and what is allowed.
    pub fn validate(&self, widths: &Widths) -> Result<(), SettingError> {
        self.timing(widths).map(drop)
    }

    /// Returns Ts in ticks of the clock.
    ///
    /// # Errors
    /// An error of [`Settings::validate`] on the clock or the sampling period.
    pub fn sample_ticks(&self, widths: &Widths) -> Result<u32, SettingError> {
        within("clock_hz", self.clock_hz, &CLOCK_RANGE_HZ)?;
        let ticks = least_sample_ticks(self.blend)..=(1 << widths.period) - 1;
        whole_ticks(
            "sample_period_ms",
            self.sample_period_ms,
            self.clock_hz,
            &ticks,
        )
    }

    /// Returns the times of a path; all that depend on the words fit them.
    ///
    /// # Errors
    /// An error of [`Settings::validate`].
    pub fn timing(&self, widths: &Widths) -> Result<Timing, SettingError> {
        let ticks = self.sample_ticks(widths)?;
        let blend_samples = self.blend_samples(widths)?;
        self.ranges()?;
        Ok(Timing {
            sample_s: f64::from(ticks) / self.clock_hz as f64,
            blend_samples,
            corner: self.corner_deg.to_radians(),
            short_pieces: self.short_pieces,
            most_samples: widths.most_samples(),
        })
    }

    /// M = 2ta/Ts: even, since ta is a multiple of Ts.
    fn blend_samples(&self, widths: &Widths) -> Result<u64, SettingError> {
        let field = "acceleration_ms";
        let (ms, period) = (self.acceleration_ms, self.sample_period_ms);
        let most = self.blend.most_samples(widths);
        let halves = ms / (2.0 * period);
        if !(halves >= 0.5 && halves <= most as f64 / 2.0 + 0.5) {
            let (first, last) = (2.0 * period, most as f64 * period);
            let allowed = format!("{first} to {last} ms: 2 to {most} samples");
            return Err(SettingError::value(field, ms, allowed));
        }
        let half = whole(halves).ok_or_else(|| {
            let times = [halves.floor(), halves.ceil()];
            let times = times.map(|halves| 2.0 * halves.clamp(1.0, most as f64 / 2.0) * period);
            let allowed = match times[0] < times[1] {
                true => format!("an even number of samples: {} or {}", times[0], times[1]),
                false => format!("an even number of samples: {}", times[0]),
            };
            SettingError::value(field, format!("{ms}: {} samples", 2.0 * halves), allowed)
        })?;
        Ok(2 * half)
    }
}

impl From<&Settings> for Speeds {
    fn from(settings: &Settings) -> Self {
        Speeds {
            wanted: settings.feed_mm_per_min.map(|feed| feed / 60.0),
            rapid: settings.rapid_mm_per_min / 60.0,
        }
    }
}
