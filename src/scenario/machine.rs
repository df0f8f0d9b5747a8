//! The keys of the machine.

use super::exactly::exactly;
use super::{Program, Runnable, VCD_TICKS};
use crate::jobs::machine::settings::{Correction, History, Settings};
use crate::jobs::pulse_interpolator::StepTiming;
use crate::plan::MotionLimits;
use crate::plant::{BodyParameters, TwoMassParameters};
use serde::Deserialize;
use std::path::PathBuf;

/// A scenario of the machine. Every key but `circuit` has a default; lists are of X and of Y.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Scenario {
    /// The circuit that runs.
    pub circuit: Runnable,
    /// The drawing or part program; in a file relative to that file.
    pub input: Option<PathBuf>,
    /// Where the zeros of a part program are.
    pub program: Program,
    /// Reference clock in Hz.
    pub clock_hz: u64,
    /// T: unit time of the steppers, in ticks.
    pub unit_ticks: u32,
    /// Scan of the linear interpolator, in ticks.
    pub scan_ticks: u32,
    /// CK of the lead-angle compensator, in ticks.
    pub ck_ticks: u32,
    /// Ts: sampling time of arc generator and trajectory controller, in ticks.
    pub sample_ticks: u32,
    /// Steps of the steppers per millimetre.
    #[serde(deserialize_with = "exactly")]
    pub steps_per_mm: [f64; 2],
    /// Shortest high time of a step line.
    pub step_high_ticks: u32,
    /// Shortest low time of a step line.
    pub step_low_ticks: u32,
    /// Time from a change of the direction line to the next step.
    pub dir_setup_ticks: u32,
    /// Time from a step to a change of the direction line.
    pub dir_hold_ticks: u32,
    /// Counts of the servos per millimetre.
    pub counts_per_mm: f64,
    /// Speed of the moves that set none.
    pub feed_mm_per_min: f64,
    /// Speed of pen-up and G0 moves.
    pub rapid_mm_per_min: f64,
    /// Largest sudden change of the steppers' velocity at a corner.
    pub corner_mm_per_min: f64,
    /// Largest acceleration of the steppers, and of the servos across arcs.
    pub acceleration_mm_per_s2: f64,
    /// Time in which the servos come to speed, and to rest.
    pub acceleration_ms: f64,
    /// K1 of all models.
    pub k1_per_s: f64,
    /// K2 of all models.
    pub k2_per_s: f64,
    /// What the trajectory controller adds to the commands.
    pub correction: Correction,
    /// Gain of the position controls.
    pub position_gain_per_s: f64,
    /// Bandwidth of the speed controls.
    pub speed_hz: f64,
    /// Integral time of the speed controls; 0 for no integral.
    pub integral_ms: f64,
    /// A move begins when both motors are as near to their commands.
    pub in_position_counts: u32,
    /// Amplifier, motor, load and encoder of X and Y.
    pub machine: TwoMassParameters,
    /// Where the lift has the pen down; up is 0.
    pub pen_down_counts: i64,
    /// Speed of the lift.
    pub lift_counts_per_s: u32,
    /// Lead of the lift's brake before anything is learned.
    pub lift_lead_ms: f64,
    /// Memory of the lift's past positions.
    pub lift_history: History,
    /// Drive, body, brake and encoder of the lift.
    pub lift: BodyParameters,
    /// The most ticks that go into the VCD unless a window is asked for.
    pub vcd_ticks: u64,
}

impl Default for Scenario {
    /// What the settings are by default.
    fn default() -> Self {
        let settings = Settings::default();
        let (motion, timing) = (settings.motion, settings.step_timing);
        Scenario {
            circuit: Runnable::Machine,
            input: None,
            program: Program::default(),
            clock_hz: settings.clock_hz,
            unit_ticks: settings.unit_ticks,
            scan_ticks: settings.scan_ticks,
            ck_ticks: settings.ck_ticks,
            sample_ticks: settings.sample_ticks,
            steps_per_mm: settings.steps_per_mm,
            step_high_ticks: timing.min_high,
            step_low_ticks: timing.min_low,
            dir_setup_ticks: timing.dir_setup,
            dir_hold_ticks: timing.dir_hold,
            counts_per_mm: settings.counts_per_mm,
            feed_mm_per_min: motion.feed_mm_per_min,
            rapid_mm_per_min: motion.rapid_mm_per_min,
            corner_mm_per_min: motion.corner_mm_per_min,
            acceleration_mm_per_s2: motion.acceleration_mm_per_s2,
            acceleration_ms: settings.acceleration_ms,
            k1_per_s: settings.k1_per_s,
            k2_per_s: settings.k2_per_s,
            correction: settings.correction,
            position_gain_per_s: settings.position_gain_per_s,
            speed_hz: settings.speed_hz,
            integral_ms: settings.integral_ms,
            in_position_counts: settings.in_position_counts,
            machine: settings.axis,
            pen_down_counts: settings.pen_down_counts,
            lift_counts_per_s: settings.lift_counts_per_s,
            lift_lead_ms: settings.lift_lead_ms,
            lift_history: settings.lift_history,
            lift: settings.lift,
            vcd_ticks: VCD_TICKS,
        }
    }
}

impl Scenario {
    /// The settings it stands for.
    #[must_use]
    pub fn settings(&self) -> Settings {
        Settings {
            clock_hz: self.clock_hz,
            unit_ticks: self.unit_ticks,
            scan_ticks: self.scan_ticks,
            ck_ticks: self.ck_ticks,
            sample_ticks: self.sample_ticks,
            steps_per_mm: self.steps_per_mm,
            step_timing: StepTiming {
                min_high: self.step_high_ticks,
                min_low: self.step_low_ticks,
                dir_setup: self.dir_setup_ticks,
                dir_hold: self.dir_hold_ticks,
            },
            counts_per_mm: self.counts_per_mm,
            motion: MotionLimits {
                feed_mm_per_min: self.feed_mm_per_min,
                rapid_mm_per_min: self.rapid_mm_per_min,
                corner_mm_per_min: self.corner_mm_per_min,
                acceleration_mm_per_s2: self.acceleration_mm_per_s2,
            },
            acceleration_ms: self.acceleration_ms,
            k1_per_s: self.k1_per_s,
            k2_per_s: self.k2_per_s,
            correction: self.correction,
            position_gain_per_s: self.position_gain_per_s,
            speed_hz: self.speed_hz,
            integral_ms: self.integral_ms,
            in_position_counts: self.in_position_counts,
            axis: self.machine,
            pen_down_counts: self.pen_down_counts,
            lift_counts_per_s: self.lift_counts_per_s,
            lift_lead_ms: self.lift_lead_ms,
            lift_history: self.lift_history,
            lift: self.lift,
        }
    }
}
