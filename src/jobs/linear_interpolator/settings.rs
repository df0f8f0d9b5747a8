//! What the linear interpolator is run with: clock and scan, machine, motion, axes.

use super::profile::speed_word;
use super::targets::{LATENCY_TICKS, LONGEST_RAMP};
use crate::circuits::linear_interpolator::{MasterAxis, Rule};
use crate::plan::FEED_RANGE;
use crate::settings::{
    CLOCK_RANGE_HZ, COUNTS_PER_MM_RANGE, IN_POSITION_RANGE, Place, SettingError, WholeTime, within,
};
use serde::Deserialize;
use std::ops::RangeInclusive;

/// Scans that are accepted, in ticks: the dividers must be done before the scan is over.
pub const SCAN_RANGE_TICKS: RangeInclusive<u32> = LATENCY_TICKS..=16_777_215;

/// Names of the axes.
pub const AXIS_NAMES: [&str; 2] = ["x", "y"];

/// What becomes of a move that is too short to reach its speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ShortMoves {
    /// It keeps its acceleration: the times become shorter.
    #[default]
    ConstantAcceleration,
    /// It keeps its times: the acceleration becomes smaller.
    ConstantTime,
}

/// One axis: position loop, driver, motor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisSettings {
    /// Kp of the position loop.
    pub position_gain_per_s: f64,
    /// Speed of the motor at the largest speed command.
    pub rated_speed_rev_per_min: f64,
    /// Counts per revolution of the motor, four for each line of its encoder.
    pub counts_per_rev: u32,
    /// Time constant of the driver's velocity loop.
    pub velocity_loop_ms: f64,
    /// Inertia of motor and load, at the motor.
    pub inertia_kg_m2: f64,
    /// Largest torque of the motor.
    pub max_torque_nm: f64,
    /// Friction of motor and load, at the motor.
    pub friction_nm: f64,
}

impl AxisSettings {
    /// Speed at the largest speed command, in counts per second.
    #[must_use]
    pub fn rated_counts_per_s(&self) -> f64 {
        self.rated_speed_rev_per_min / 60.0 * f64::from(self.counts_per_rev)
    }
}

/// Settings of [`compile`](super::targets::compile) and of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// How the integrator divides.
    pub rule: Rule,
    /// Which axis leads.
    pub master: MasterAxis,
    /// Reference clock in Hz.
    pub clock_hz: u64,
    /// Ticks of a scan.
    pub scan_ticks: u32,
    /// Encoder counts per millimetre of X and of Y.
    pub counts_per_mm: [f64; 2],
    /// Feed of the moves that set none, in mm/min.
    pub feed_mm_per_min: f64,
    /// Speed of rapid moves, in mm/min.
    pub rapid_mm_per_min: f64,
    /// 100 % speed of each axis in mm/min, to which the times below are, and the fastest of a move;
    /// without it the faster of the two above.
    pub full_speed_mm_per_min: Option<f64>,
    /// Time from rest to 100 % speed.
    pub acceleration_ms: f64,
    /// Time from 100 % speed to rest.
    pub deceleration_ms: f64,
    /// What becomes of a move that is too short to reach its speed.
    pub short_moves: ShortMoves,
    /// Largest deviation of a chord from its arc.
    pub chord_tolerance_mm: f64,
    /// A cycle begins only when both axes are in position.
    pub exact_stop: bool,
    /// Largest position error of an axis that is in position.
    pub in_position_counts: u32,
    /// X and Y.
    pub axes: [AxisSettings; 2],
}

impl Default for Settings {
    /// A small plotter: 5 µm a count, 4000 counts a revolution, 3000 rev/min, 1 ms of scan at 1 MHz.
    fn default() -> Self {
        Self {
            rule: Rule::default(),
            master: MasterAxis::default(),
            clock_hz: 1_000_000,
            scan_ticks: 1000,
            counts_per_mm: [200.0; 2],
            feed_mm_per_min: 6000.0,
            rapid_mm_per_min: 18_000.0,
            full_speed_mm_per_min: None,
            acceleration_ms: 100.0,
            deceleration_ms: 100.0,
            short_moves: ShortMoves::default(),
            chord_tolerance_mm: 0.01,
            exact_stop: true,
            in_position_counts: 4,
            axes: [AxisSettings {
                position_gain_per_s: 40.0,
                rated_speed_rev_per_min: 3000.0,
                counts_per_rev: 4000,
                velocity_loop_ms: 2.0,
                inertia_kg_m2: 3e-5,
                max_torque_nm: 0.9,
                friction_nm: 0.0,
            }; 2],
        }
    }
}

impl Settings {
    /// Duration of a scan.
    #[must_use]
    pub fn scan_s(&self) -> f64 {
        f64::from(self.scan_ticks) / self.clock_hz as f64
    }

    /// Fastest speed that can be counted in any direction, in mm/min: one count per tick.
    #[must_use]
    pub fn countable_mm_per_min(&self) -> f64 {
        let [x, y] = self.counts_per_mm;
        (60.0 * self.clock_hz as f64 / x.max(y)).min(*FEED_RANGE.end())
    }

    /// 100 % speed in mm/min.
    #[must_use]
    pub fn fastest_mm_per_min(&self) -> f64 {
        let faster = self.feed_mm_per_min.max(self.rapid_mm_per_min);
        self.full_speed_mm_per_min.unwrap_or(faster)
    }

    /// 100 % speed of an axis (0 is X, 1 is Y) as a [`Profile`](super::profile::Profile) has its
    /// speed.
    pub(super) fn full_speed(&self, axis: usize) -> u64 {
        let counts_per_s = self.fastest_mm_per_min() / 60.0 * self.counts_per_mm[axis];
        speed_word(counts_per_s * self.scan_s()).unwrap_or(1)
    }

    /// Times of acceleration and deceleration in scans.
    pub(super) fn ramp_scans(&self) -> [u64; 2] {
        self.ramps().map(|ramp| ramp.periods)
    }

    /// Times of acceleration and deceleration as they are taken.
    #[must_use]
    pub fn ramps(&self) -> [WholeTime; 2] {
        [
            ("acceleration_ms", self.acceleration_ms),
            ("deceleration_ms", self.deceleration_ms),
        ]
        .map(|(field, ms)| WholeTime::new(field, ms, 1e3 * self.scan_s()))
    }

    /// Checks every field.
    ///
    /// # Errors
    ///
    /// Names the first field at fault, its value and what is allowed.
    pub fn validate(&self) -> Result<(), SettingError> {
        within("clock_hz", self.clock_hz, &CLOCK_RANGE_HZ)?;
        within("scan_ticks", self.scan_ticks, &SCAN_RANGE_TICKS)?;
        for (value, name) in self.counts_per_mm.into_iter().zip(AXIS_NAMES) {
            within("counts_per_mm", value, &COUNTS_PER_MM_RANGE)
                .map_err(|error| error.at(Place::Element(name)))?;
        }
        let most = self.countable_mm_per_min();
        if let Some(full) = self.full_speed_mm_per_min {
            within("full_speed_mm_per_min", full, &(*FEED_RANGE.start()..=most))?;
        }
        let feeds = *FEED_RANGE.start()..=self.full_speed_mm_per_min.unwrap_or(most);
        within("feed_mm_per_min", self.feed_mm_per_min, &feeds)?;
        within("rapid_mm_per_min", self.rapid_mm_per_min, &feeds)?;
        let times = 0.0..=LONGEST_RAMP as f64 * 1e3 * self.scan_s();
        within("acceleration_ms", self.acceleration_ms, &times)?;
        within("deceleration_ms", self.deceleration_ms, &times)?;
        let tolerance = self.chord_tolerance_mm;
        within("chord_tolerance_mm", tolerance, &(1e-6..=1e3))?;
        let counts = self.in_position_counts;
        within("in_position_counts", counts, &IN_POSITION_RANGE)?;
        for (axis, name) in self.axes.iter().zip(AXIS_NAMES) {
            self.validate_axis(axis)
                .map_err(|error| error.at(Place::Element(name)))?;
        }
        Ok(())
    }

    fn validate_axis(&self, axis: &AxisSettings) -> Result<(), SettingError> {
        let AxisSettings {
            position_gain_per_s: gain,
            rated_speed_rev_per_min: speed,
            counts_per_rev: counts,
            velocity_loop_ms,
            inertia_kg_m2: inertia,
            max_torque_nm: torque,
            friction_nm: friction,
        } = *axis;
        // More than the whole error in one scan, and the loop overshoots.
        let gains = 1e-3..=1.0 / self.scan_s();
        within("position_gain_per_s", gain, &gains)?;
        within("counts_per_rev", counts, &(4..=100_000_000))?;
        let fastest = 60.0 * self.clock_hz as f64 / f64::from(counts);
        let speeds = 1e-3..=fastest.min(1e6);
        within("rated_speed_rev_per_min", speed, &speeds)?;
        within("velocity_loop_ms", velocity_loop_ms, &(1e-3..=1e4))?;
        within("inertia_kg_m2", inertia, &(1e-9..=1e3))?;
        within("max_torque_nm", torque, &(1e-6..=1e6))?;
        if !(0.0..torque).contains(&friction) {
            let allowed = format!("0 to below max_torque_nm, {torque}");
            return Err(SettingError::value("friction_nm", friction, allowed));
        }
        Ok(())
    }
}
