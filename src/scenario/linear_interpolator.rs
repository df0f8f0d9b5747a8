//! The keys of the linear interpolator.

use super::exactly::exactly;
use super::{Program, Runnable};
use crate::circuits::linear_interpolator::{MasterAxis, Rule};
use crate::jobs::linear_interpolator::settings::{AxisSettings, Settings, ShortMoves};
use serde::Deserialize;
use std::path::PathBuf;

/// A scenario of the linear interpolator. Every key but `circuit` has a default; lists are of X
/// and of Y.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// The circuit that runs.
    pub circuit: Runnable,
    /// The drawing or part program; in a file relative to that file.
    pub input: Option<PathBuf>,
    /// Where the zeros of a part program are.
    #[serde(default)]
    pub program: Program,
    /// How the integrator 24 divides.
    #[serde(default = "default::variant")]
    pub variant: Rule,
    /// Which axis has the position pattern.
    #[serde(default = "default::master")]
    pub master: MasterAxis,
    /// Reference clock in Hz.
    #[serde(default = "default::clock_hz")]
    pub clock_hz: u64,
    /// Ticks of a scan.
    #[serde(default = "default::scan_ticks")]
    pub scan_ticks: u32,
    /// Encoder counts per millimetre: what the positions are in.
    #[serde(default = "default::counts_per_mm", deserialize_with = "exactly")]
    pub counts_per_mm: [f64; 2],
    /// Feed of the moves that set none, in mm/min.
    #[serde(default = "default::feed")]
    pub feed_mm_per_min: f64,
    /// Speed of pen-up and G0 moves, in mm/min.
    #[serde(default = "default::rapid")]
    pub rapid_mm_per_min: f64,
    /// 100 % speed of the axes in mm/min; without it the faster of the two above.
    pub full_speed_mm_per_min: Option<f64>,
    /// Time from rest to 100 % speed.
    #[serde(default = "default::acceleration")]
    pub acceleration_ms: f64,
    /// Time from 100 % speed to rest.
    #[serde(default = "default::deceleration")]
    pub deceleration_ms: f64,
    /// What becomes of a move that is too short to reach its speed.
    #[serde(default = "default::short_moves")]
    pub short_moves: ShortMoves,
    /// Largest deviation of a chord from the arc it stands for.
    #[serde(default = "default::chord_tolerance")]
    pub chord_tolerance_mm: f64,
    /// A cycle begins only when both axes are in position.
    #[serde(default = "default::exact_stop")]
    pub exact_stop: bool,
    /// Largest position error of an axis that is in position.
    #[serde(default = "default::in_position")]
    pub in_position_counts: u32,
    /// Kp of the position loops.
    #[serde(default = "default::position_gain", deserialize_with = "exactly")]
    pub position_gain_per_s: [f64; 2],
    /// Speed of the motors at the largest speed command.
    #[serde(default = "default::rated_speed", deserialize_with = "exactly")]
    pub rated_speed_rev_per_min: [f64; 2],
    /// Counts per revolution of the motors.
    #[serde(default = "default::counts_per_rev", deserialize_with = "exactly")]
    pub counts_per_rev: [u32; 2],
    /// Time constant of the drivers' velocity loops.
    #[serde(default = "default::velocity_loop", deserialize_with = "exactly")]
    pub velocity_loop_ms: [f64; 2],
    /// Inertia of motor and load, at the motor.
    #[serde(default = "default::inertia", deserialize_with = "exactly")]
    pub inertia_kg_m2: [f64; 2],
    /// Largest torque of the motors.
    #[serde(default = "default::max_torque", deserialize_with = "exactly")]
    pub max_torque_nm: [f64; 2],
    /// Friction of motor and load, at the motor.
    #[serde(default = "default::friction", deserialize_with = "exactly")]
    pub friction_nm: [f64; 2],
    /// Plays what the circuit is compared with too: another master axis and the conventional system.
    #[serde(default)]
    pub beside: bool,
    /// The most ticks that go into the VCD unless a window is asked for.
    #[serde(default = "default::vcd_ticks")]
    pub vcd_ticks: u64,
}

impl Scenario {
    /// The settings it stands for.
    #[must_use]
    pub fn settings(&self) -> Settings {
        Settings {
            rule: self.variant,
            master: self.master,
            clock_hz: self.clock_hz,
            scan_ticks: self.scan_ticks,
            counts_per_mm: self.counts_per_mm,
            feed_mm_per_min: self.feed_mm_per_min,
            rapid_mm_per_min: self.rapid_mm_per_min,
            full_speed_mm_per_min: self.full_speed_mm_per_min,
            acceleration_ms: self.acceleration_ms,
            deceleration_ms: self.deceleration_ms,
            short_moves: self.short_moves,
            chord_tolerance_mm: self.chord_tolerance_mm,
            exact_stop: self.exact_stop,
            in_position_counts: self.in_position_counts,
            axes: std::array::from_fn(|axis| AxisSettings {
                position_gain_per_s: self.position_gain_per_s[axis],
                rated_speed_rev_per_min: self.rated_speed_rev_per_min[axis],
                counts_per_rev: self.counts_per_rev[axis],
                velocity_loop_ms: self.velocity_loop_ms[axis],
                inertia_kg_m2: self.inertia_kg_m2[axis],
                max_torque_nm: self.max_torque_nm[axis],
                friction_nm: self.friction_nm[axis],
            }),
        }
    }
}

/// What a key is worth that is not given: what the settings are by default.
mod default {
    use super::{AxisSettings, MasterAxis, Rule, Settings, ShortMoves};

    fn settings() -> Settings {
        Settings::default()
    }
    fn axes<T>(of: impl Fn(AxisSettings) -> T) -> [T; 2] {
        settings().axes.map(of)
    }
    pub(super) fn variant() -> Rule {
        settings().rule
    }
    pub(super) fn master() -> MasterAxis {
        settings().master
    }
    pub(super) fn clock_hz() -> u64 {
        settings().clock_hz
    }
    pub(super) fn scan_ticks() -> u32 {
        settings().scan_ticks
    }
    pub(super) fn counts_per_mm() -> [f64; 2] {
        settings().counts_per_mm
    }
    pub(super) fn feed() -> f64 {
        settings().feed_mm_per_min
    }
    pub(super) fn rapid() -> f64 {
        settings().rapid_mm_per_min
    }
    pub(super) fn acceleration() -> f64 {
        settings().acceleration_ms
    }
    pub(super) fn deceleration() -> f64 {
        settings().deceleration_ms
    }
    pub(super) fn short_moves() -> ShortMoves {
        settings().short_moves
    }
    pub(super) fn chord_tolerance() -> f64 {
        settings().chord_tolerance_mm
    }
    pub(super) fn exact_stop() -> bool {
        settings().exact_stop
    }
    pub(super) fn in_position() -> u32 {
        settings().in_position_counts
    }
    pub(super) fn position_gain() -> [f64; 2] {
        axes(|axis| axis.position_gain_per_s)
    }
    pub(super) fn rated_speed() -> [f64; 2] {
        axes(|axis| axis.rated_speed_rev_per_min)
    }
    pub(super) fn counts_per_rev() -> [u32; 2] {
        axes(|axis| axis.counts_per_rev)
    }
    pub(super) fn velocity_loop() -> [f64; 2] {
        axes(|axis| axis.velocity_loop_ms)
    }
    pub(super) fn inertia() -> [f64; 2] {
        axes(|axis| axis.inertia_kg_m2)
    }
    pub(super) fn max_torque() -> [f64; 2] {
        axes(|axis| axis.max_torque_nm)
    }
    pub(super) fn friction() -> [f64; 2] {
        axes(|axis| axis.friction_nm)
    }
    pub(super) fn vcd_ticks() -> u64 {
        super::super::VCD_TICKS
    }
}
