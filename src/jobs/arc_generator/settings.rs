//! What the arc generator is run with: clock and sampling, machine, motion.

use super::prepare::Timing;
use crate::circuits::arc_generator::{ArcGenerator, Blend, Rounding, Widths};
use crate::path::pieces::Speeds;
use crate::settings::{
    CLOCK_RANGE_HZ, COUNTS_PER_MM_RANGE, SettingError, whole, whole_ticks, within,
};
use serde::Deserialize;
use std::ops::RangeInclusive;

/// Shortest sampling period in ticks: a record is fetched and a rotation done within it.
pub const LEAST_SAMPLE_TICKS: u64 = least_sample_ticks(Blend::Differences);

/// The same where blends are made so: products take longer than a rotation.
#[must_use]
pub const fn least_sample_ticks(blend: Blend) -> u64 {
    ArcGenerator::new(Rounding::Nearest, blend).least_period()
}

/// Speeds that are accepted, in mm/s.
pub const SPEED_RANGE_MM_PER_S: RangeInclusive<f64> = 1e-6..=1e9;

/// What becomes of a piece that is too short or too tight for its speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ShortPieces {
    /// It is refused, and the largest speed that fits is said.
    #[default]
    Refuse,
    /// It is run at the largest speed that fits.
    Slower,
}

/// Settings of [`prepare`](super::prepare::prepare) and of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Reference clock in Hz.
    pub clock_hz: u64,
    /// Ts.
    pub sample_period_ms: f64,
    /// 2ta: duration of a blend.
    pub acceleration_ms: f64,
    /// Counts of a position command per millimetre, of every coordinate.
    pub counts_per_mm: f64,
    /// Speed of the pieces that have none of their own.
    pub speed_mm_per_s: Option<f64>,
    /// Speed of rapid moves.
    pub rapid_mm_per_s: f64,
    /// Largest turn between two pieces that are joined without a stop.
    pub corner_deg: f64,
    /// How the rotation rounds.
    pub rounding: Rounding,
    /// How blends and lines are made.
    pub blend: Blend,
    /// What becomes of a piece that is too short or too tight for its speed.
    pub short_pieces: ShortPieces,
}

impl Default for Settings {
    /// 1 µm a count, 1 ms of sampling at 1 MHz, blends of 64 ms.
    fn default() -> Self {
        Self {
            clock_hz: 1_000_000,
            sample_period_ms: 1.0,
            acceleration_ms: 64.0,
            counts_per_mm: 1000.0,
            speed_mm_per_s: None,
            rapid_mm_per_s: 200.0,
            corner_deg: 20.0,
            rounding: Rounding::default(),
            blend: Blend::default(),
            short_pieces: ShortPieces::default(),
        }
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

    /// Ts as ticks of the clock.
    ///
    /// # Errors
    /// As [`Settings::validate`], of the clock and the sampling period.
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

    /// The times of a path, of which all that depend on the words are within them.
    ///
    /// # Errors
    /// As [`Settings::validate`].
    pub fn timing(&self, widths: &Widths) -> Result<Timing, SettingError> {
        let ticks = self.sample_ticks(widths)?;
        let blend_samples = self.blend_samples(widths)?;
        let counts = self.counts_per_mm;
        within("counts_per_mm", counts, &COUNTS_PER_MM_RANGE)?;
        if let Some(speed) = self.speed_mm_per_s {
            within("speed_mm_per_s", speed, &SPEED_RANGE_MM_PER_S)?;
        }
        let rapid = self.rapid_mm_per_s;
        within("rapid_mm_per_s", rapid, &SPEED_RANGE_MM_PER_S)?;
        within("corner_deg", self.corner_deg, &(0.0..=180.0))?;
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
            wanted: settings.speed_mm_per_s,
            rapid: settings.rapid_mm_per_s,
        }
    }
}
