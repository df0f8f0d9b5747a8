//! The keys of the pulse interpolator.

use super::{Program, Runnable};
use crate::circuits::pulse_interpolator::Variant;
use crate::input::Drawing;
use crate::jobs::pulse_interpolator::motors::Motors;
use crate::jobs::pulse_interpolator::{Rewrite, Settings, StepTiming};
use crate::plan::MotionLimits;
use crate::plant::StepMotorParameters;
use crate::settings::{Place, SettingError};
use serde::Deserialize;
use std::path::PathBuf;

/// A scenario of the pulse interpolator. Every key but `circuit` has a default.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// The circuit that runs.
    pub circuit: Runnable,
    /// The drawing or part program; in a file relative to that file.
    pub input: Option<PathBuf>,
    /// Patterns that stand in the memory, in place of an input.
    #[serde(default)]
    pub pattern: Vec<PatternKeys>,
    /// The names of patterns in the order in which they are played; without it each once.
    pub play: Option<Vec<String>>,
    /// Two groups with unit times of their own, in place of one that plays all patterns.
    #[serde(default)]
    pub group: Vec<GroupKeys>,
    /// T written by the control computer while patterns are played.
    #[serde(default)]
    pub rewrite: Vec<RewriteKeys>,
    /// Whether the pattern is played without a control computer.
    #[serde(default)]
    pub standalone: bool,
    /// How the control computer of the conventional device gives it the drawing.
    #[serde(default)]
    pub conventional_moves: ConventionalMoves,
    /// Where the zeros of a part program are.
    #[serde(default)]
    pub program: Program,
    /// What RST clears.
    #[serde(default)]
    pub variant: VariantName,
    /// Reference clock in Hz.
    #[serde(default = "default::clock_hz")]
    pub clock_hz: u64,
    /// Steps per millimetre of X, Y and perhaps Z; negative where the motor turns the other way.
    /// Without it 80 for X, for Y and, where the input moves in Z, for Z.
    pub steps_per_mm: Option<Vec<f64>>,
    /// Feed of the moves that set none, in mm/min.
    #[serde(default = "default::feed")]
    pub feed_mm_per_min: f64,
    /// Speed of pen-up and G0 moves, in mm/min.
    #[serde(default = "default::rapid")]
    pub rapid_mm_per_min: f64,
    /// Largest sudden change of velocity at a corner, in mm/min.
    #[serde(default = "default::corner")]
    pub corner_mm_per_min: f64,
    /// Largest acceleration along the path and, on arcs, across it, in mm/s².
    #[serde(default = "default::acceleration")]
    pub acceleration_mm_per_s2: f64,
    /// Unit time T2 of lines, in ticks.
    #[serde(default = "default::unit")]
    pub line_unit_ticks: u32,
    /// Unit time T1 of arcs, in ticks; without it that of lines.
    pub arc_unit_ticks: Option<u32>,
    /// Shortest high time of the step lines, in ticks.
    #[serde(default = "default::high")]
    pub step_high_ticks: u32,
    /// Shortest low time of the step lines, in ticks.
    #[serde(default = "default::low")]
    pub step_low_ticks: u32,
    /// Shortest time from a change of direction to the next step, in ticks.
    #[serde(default = "default::setup")]
    pub dir_setup_ticks: u32,
    /// Shortest time from a step to a change of direction, in ticks.
    #[serde(default = "default::hold")]
    pub dir_hold_ticks: u32,
    /// Step motors on the drivers, alike on all axes.
    pub motor: Option<MotorKeys>,
    /// Plays what the circuit is compared with too: the conventional device, and searches for the least T.
    #[serde(default)]
    pub beside: bool,
    /// The most ticks that go into the VCD unless a window is asked for.
    #[serde(default = "default::vcd_ticks")]
    pub vcd_ticks: u64,
}

impl Scenario {
    /// The settings of the table compiler for this drawing.
    pub fn settings(&self, drawing: &Drawing) -> Settings {
        let moves_in_z = drawing
            .moves
            .iter()
            .any(|step| step.to[2] != drawing.start[2]);
        let axes = if moves_in_z { 3 } else { 2 };
        let steps_per_mm = self.steps_per_mm.clone();
        Settings {
            clock_hz: self.clock_hz,
            steps_per_mm: steps_per_mm.unwrap_or_else(|| vec![80.0; axes]),
            motion: MotionLimits {
                feed_mm_per_min: self.feed_mm_per_min,
                rapid_mm_per_min: self.rapid_mm_per_min,
                corner_mm_per_min: self.corner_mm_per_min,
                acceleration_mm_per_s2: self.acceleration_mm_per_s2,
            },
            line_unit_ticks: self.line_unit_ticks,
            arc_unit_ticks: self.arc_unit_ticks.unwrap_or(self.line_unit_ticks),
            timing: self.timing(),
            ..Settings::default()
        }
    }

    /// The motors on so many axes, if there are some.
    ///
    /// # Errors
    /// A figure of theirs is out of range.
    pub fn motors(&self, axes: usize) -> Result<Option<Motors>, SettingError> {
        let motors = |keys: MotorKeys| Motors::new(&keys.into(), axes, self.clock_hz);
        let motors = self.motor.map(motors).transpose();
        motors.map_err(|error| error.at(Place::Table("motor")))
    }

    /// T that is written while patterns are played.
    pub fn rewrites(&self) -> Vec<Rewrite> {
        let rewrites = self.rewrite.iter().map(|keys| Rewrite {
            unit: keys.unit,
            period: keys.unit_ticks,
        });
        rewrites.collect()
    }

    /// What the motor drivers ask for.
    pub fn timing(&self) -> StepTiming {
        StepTiming {
            min_high: self.step_high_ticks,
            min_low: self.step_low_ticks,
            dir_setup: self.dir_setup_ticks,
            dir_hold: self.dir_hold_ticks,
        }
    }
}

/// The table `[motor]`.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MotorKeys {
    /// Greatest torque at standstill.
    pub holding_torque_nm: f64,
    /// Inertia of rotor and load.
    pub inertia_kg_m2: f64,
    /// Torque that grows with the speed.
    #[serde(default)]
    pub damping_nm_s: f64,
    /// Coulomb friction.
    #[serde(default)]
    pub friction_nm: f64,
    /// Full steps a turn.
    #[serde(default = "default::full_steps_per_rev")]
    pub full_steps_per_rev: u32,
    /// Steps of the driver in a full step.
    #[serde(default = "default::microsteps")]
    pub microsteps: u32,
}

impl From<MotorKeys> for StepMotorParameters {
    fn from(keys: MotorKeys) -> Self {
        StepMotorParameters {
            holding_torque_nm: keys.holding_torque_nm,
            inertia_kg_m2: keys.inertia_kg_m2,
            damping_nm_s: keys.damping_nm_s,
            friction_nm: keys.friction_nm,
            full_steps_per_rev: keys.full_steps_per_rev,
            microsteps: keys.microsteps,
        }
    }
}

/// A table `[[pattern]]`.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PatternKeys {
    /// What it is called in `play`.
    pub name: String,
    /// Its words in CSV; in a file relative to that file.
    pub table: PathBuf,
    /// What its half-periods are multiplied by, as 3/2.
    pub scale: Option<String>,
}

/// A table `[[group]]`.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GroupKeys {
    /// The names of its patterns in the order in which they are played.
    pub play: Vec<String>,
    /// Tick of its first command, from 0; its pattern begins two ticks later.
    #[serde(default)]
    pub command_tick: u64,
}

/// A table `[[rewrite]]`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RewriteKeys {
    /// The unit time of the run in whose middle T is written, from 0.
    pub unit: usize,
    /// T in ticks from the next unit time on, up to the end of the pattern.
    pub unit_ticks: u32,
}

/// Moves that the computer 7 gives the conventional device of Fig. 5.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ConventionalMoves {
    /// One for every unit time of the planned path.
    #[default]
    UnitTimes,
    /// One for each line and each arc, by its parameters (¶0003–0004).
    Pieces,
}

/// The variant by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum VariantName {
    /// RST clears the counter, the toggle and the flip-flop.
    #[default]
    Safe,
    /// RST clears the flip-flop alone, as the text has it.
    Literal,
}

impl VariantName {
    /// The name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            VariantName::Safe => "safe",
            VariantName::Literal => "literal",
        }
    }
}

impl From<VariantName> for Variant {
    fn from(name: VariantName) -> Self {
        match name {
            VariantName::Safe => Variant::Safe,
            VariantName::Literal => Variant::Literal,
        }
    }
}

/// What a key is worth that is not given: what the compiler's settings are by default.
mod default {
    use crate::jobs::pulse_interpolator::Settings;
    use crate::plant::StepMotorParameters;

    pub(super) fn clock_hz() -> u64 {
        Settings::default().clock_hz
    }
    pub(super) fn feed() -> f64 {
        Settings::default().motion.feed_mm_per_min
    }
    pub(super) fn rapid() -> f64 {
        Settings::default().motion.rapid_mm_per_min
    }
    pub(super) fn corner() -> f64 {
        Settings::default().motion.corner_mm_per_min
    }
    pub(super) fn acceleration() -> f64 {
        Settings::default().motion.acceleration_mm_per_s2
    }
    pub(super) fn unit() -> u32 {
        Settings::default().line_unit_ticks
    }
    pub(super) fn high() -> u32 {
        Settings::default().timing.min_high
    }
    pub(super) fn low() -> u32 {
        Settings::default().timing.min_low
    }
    pub(super) fn setup() -> u32 {
        Settings::default().timing.dir_setup
    }
    pub(super) fn hold() -> u32 {
        Settings::default().timing.dir_hold
    }
    pub(super) fn full_steps_per_rev() -> u32 {
        StepMotorParameters::default().full_steps_per_rev
    }
    pub(super) fn microsteps() -> u32 {
        StepMotorParameters::default().microsteps
    }
    pub(super) fn vcd_ticks() -> u64 {
        super::super::VCD_TICKS
    }
}
