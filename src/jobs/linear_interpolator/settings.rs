//! Settings of the linear interpolator: clock and scan, machine, motion, axes.

use super::profile::speed_word;
use super::targets::{LATENCY_TICKS, LONGEST_RAMP};
use crate::circuits::linear_interpolator::{MasterAxis, Rule};
use crate::plan::FEED_RANGE;
use crate::settings::{
    CLOCK_RANGE_HZ, COUNTS_PER_MM_RANGE, IN_POSITION_RANGE, Place, SettingError, WholeTime, Within,
    choices, settings, within,
};
use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;

/// Scans that are accepted, in ticks: the dividers must be done before the scan is over.
pub const SCAN_RANGE_TICKS: RangeInclusive<u32> = LATENCY_TICKS..=16_777_215;

/// Times of acceleration at any clock, in milliseconds.
const RAMP_RANGE_MS: RangeInclusive<f64> =
    0.0..=LONGEST_RAMP as f64 * *SCAN_RANGE_TICKS.end() as f64 * 1e3;
/// Gains at any clock: a position loop takes at most the whole error in a scan.
const GAIN_RANGE_PER_S: RangeInclusive<f64> =
    1e-3..=*CLOCK_RANGE_HZ.end() as f64 / LATENCY_TICKS as f64;
/// Largest torques of motors that are accepted, in N·m.
const TORQUE_RANGE_NM: RangeInclusive<f64> = 1e-6..=1e6;
/// Speeds of motors at any clock, in rev/min.
const RATED_RANGE_REV_PER_MIN: RangeInclusive<f64> = 1e-3..=1e6;

/// Names of the axes.
pub const AXIS_NAMES: [&str; 2] = ["x", "y"];

/// Change to a move that is too short to reach its speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ShortMoves {
    /// Keeps the acceleration; the times become shorter.
    #[default]
    ConstantAcceleration,
    /// Keeps the times; the acceleration becomes smaller.
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

choices!(MasterAxis, Rule, ShortMoves);

settings! {
    /// Settings of [`compile`](super::targets::compile) and of a run. Default: a small plotter with
    /// 5 µm a count, 4000 counts a revolution, 3000 rev/min, 1 ms of scan at 1 MHz. Lists are of X
    /// and of Y.
    pub struct Settings {
        /// Rule by which the integrator 24 rounds.
        pub rule as "variant": Rule = Rule::default();
        /// Axis with the position pattern: the one with the longer way, or always `x` or `y`.
        pub master: MasterAxis = MasterAxis::default();
        /// Reference clock.
        pub clock_hz: u64 = 1_000_000, in CLOCK_RANGE_HZ;
        /// Period of the scan.
        pub scan_ticks: u32 = 1000, in SCAN_RANGE_TICKS;
        /// Encoder counts per millimetre, the unit of positions.
        pub counts_per_mm: [f64; 2] = [200.0; 2], in COUNTS_PER_MM_RANGE;
        /// Feed of the moves that set none.
        pub feed_mm_per_min: f64 = 6000.0, within FEED_RANGE, "0.001 to full_speed_mm_per_min";
        /// Speed with the pen up, and of G0.
        pub rapid_mm_per_min: f64 = 18_000.0, within FEED_RANGE, "0.001 to full_speed_mm_per_min";
        /// 100 % speed of an axis, to which the times below are, and which no move exceeds; without
        /// it the faster of the two above.
        pub full_speed_mm_per_min: Option<f64> = None, within FEED_RANGE, "0.001 to a count per tick";
        /// Time from rest to 100 % speed (¶0004), in whole scans, the nearest and at least one: the
        /// summary says which, where that is another time. A slower move takes a part of it in
        /// proportion to its speed, rounded up to whole scans: the slope of an axis stays.
        pub acceleration_ms: f64 = 100.0, within RAMP_RANGE_MS, "0 to 4095 scans";
        /// Time from 100 % speed to rest, likewise.
        pub deceleration_ms: f64 = 100.0, within RAMP_RANGE_MS, "0 to 4095 scans";
        /// Change to a move that is too short for its speed: shorter times with the same
        /// acceleration, or the same times with less.
        pub short_moves: ShortMoves = ShortMoves::default();
        /// Largest deviation of a chord from its arc.
        pub chord_tolerance_mm: f64 = 0.01, in 1e-6..=1e3;
        /// True if a cycle begins only when both axes are in position.
        pub exact_stop: bool = true;
        /// Largest position error of an axis that is in position.
        pub in_position_counts: u32 = 4, in IN_POSITION_RANGE;
        /// Kp of the position loops.
        pub position_gain_per_s: [f64; 2] = [40.0; 2], within GAIN_RANGE_PER_S, "0.001 to 1 per scan";
        /// Speed of the motors at the largest D/A word.
        pub rated_speed_rev_per_min: [f64; 2] = [3000.0; 2],
            within RATED_RANGE_REV_PER_MIN, "0.001 to 1000000, at most a count per tick";
        /// Counts per revolution of the motors, four for each line of the encoder.
        pub counts_per_rev: [u32; 2] = [4000; 2], in 4..=100_000_000;
        /// Time constants of the drivers' velocity loops.
        pub velocity_loop_ms: [f64; 2] = [2.0; 2], in 1e-3..=1e4;
        /// Inertias of motor and load, at the motor.
        pub inertia_kg_m2: [f64; 2] = [3e-5; 2], in 1e-9..=1e3;
        /// Largest torques of the motors.
        pub max_torque_nm: [f64; 2] = [0.9; 2], in TORQUE_RANGE_NM;
        /// Friction of motor and load, at the motor.
        pub friction_nm: [f64; 2] = [0.0; 2], within 0.0..=*TORQUE_RANGE_NM.end(), "0 to below max_torque_nm";
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
        self.ranges()?;
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
        // More than the whole error in one scan, and the loop overshoots.
        self.position_gain_per_s.check(
            "position_gain_per_s",
            &(*GAIN_RANGE_PER_S.start()..=1.0 / self.scan_s()),
        )?;
        for (axis, name) in AXIS_NAMES.into_iter().enumerate() {
            let at = |error: SettingError| error.at(Place::Element(name));
            let (least, most) = RATED_RANGE_REV_PER_MIN.into_inner();
            let fastest = 60.0 * self.clock_hz as f64 / f64::from(self.counts_per_rev[axis]);
            let (speed, speeds) = (
                self.rated_speed_rev_per_min[axis],
                least..=fastest.min(most),
            );
            within("rated_speed_rev_per_min", speed, &speeds).map_err(at)?;
            let (torque, friction) = (self.max_torque_nm[axis], self.friction_nm[axis]);
            if !(0.0..torque).contains(&friction) {
                let allowed = format!("0 to below max_torque_nm, {torque}");
                return Err(at(SettingError::value("friction_nm", friction, allowed)));
            }
        }
        Ok(())
    }

    /// Returns the settings of X (0) or Y (1).
    #[must_use]
    pub fn axis(&self, axis: usize) -> AxisSettings {
        AxisSettings {
            position_gain_per_s: self.position_gain_per_s[axis],
            rated_speed_rev_per_min: self.rated_speed_rev_per_min[axis],
            counts_per_rev: self.counts_per_rev[axis],
            velocity_loop_ms: self.velocity_loop_ms[axis],
            inertia_kg_m2: self.inertia_kg_m2[axis],
            max_torque_nm: self.max_torque_nm[axis],
            friction_nm: self.friction_nm[axis],
        }
    }
}
