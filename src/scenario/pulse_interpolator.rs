//! The keys of the pulse interpolator.

use crate::circuits::pulse_interpolator::Variant;
use crate::input::Drawing;
use crate::jobs::pulse_interpolator::motors::Motors;
use crate::jobs::pulse_interpolator::{
    Rewrite, Settings as TableSettings, StepTiming, UNIT_RANGE_TICKS,
};
use crate::plan::MotionLimits;
use crate::plant::StepMotorParameters;
use crate::settings::{CLOCK_RANGE_HZ, Place, STEPS_PER_MM_RANGE, SettingError, choices, settings};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

settings! {
    /// Settings of a drawing or of patterns on the pulse interpolator.
    pub struct Settings {
        /// Patterns that stand in the memory, in place of an input.
        pub pattern: Vec<PatternKeys> = Vec::new();
        /// Names of the patterns in the order in which they are played; without it each once.
        pub play: Option<Vec<String>> = None;
        /// Two groups with unit times of their own, in place of one that plays all patterns.
        pub group: Vec<GroupKeys> = Vec::new(), "none or two";
        /// Unit times T that the control computer writes while patterns are played.
        pub rewrite: Vec<Rewrite> = Vec::new();
        /// True if one pattern is played from power-on, without a control computer.
        pub standalone: bool = false;
        /// Moves of the conventional device: one for each unit time of the planned path, or one for
        /// each line and arc.
        pub conventional_moves: ConventionalMoves = ConventionalMoves::default();
        /// Registers that RST clears; `literal` is as the text has it.
        pub variant: VariantName = VariantName::default();
        /// Reference clock.
        pub clock_hz: u64 = 1_000_000, in CLOCK_RANGE_HZ;
        /// Steps per millimetre of X, of Y and of Z; negative where the motor turns the other way.
        /// Without it 80 for X, for Y and, where the path moves in Z, for Z.
        pub steps_per_mm: Option<Vec<f64>> = None, within STEPS_PER_MM_RANGE,
            "1 to 3 numbers of 0.000001 to 1000000000, or the negative of that";
        /// T2: unit time of lines (¶0014).
        pub line_unit_ticks: u32 = 1000, within UNIT_RANGE_TICKS, "2 to 196605, with room for a pulse";
        /// T1: unit time of arcs (¶0014); without it that of lines.
        pub arc_unit_ticks: Option<u32> = None, within UNIT_RANGE_TICKS, "2 to 196605, with room for a pulse";
        /// Step motors on the drivers, alike on all axes.
        pub motor: Option<StepMotorParameters> = None;
    }
    flat {
        /// Feeds, corner speed and acceleration.
        pub motion: MotionLimits = MotionLimits::default();
        /// Timing that the motor drivers require.
        pub timing: StepTiming = StepTiming::default();
    }
}

impl Settings {
    /// Returns the settings of the table compiler for a drawing.
    #[must_use]
    pub fn settings(&self, drawing: &Drawing) -> TableSettings {
        let moves_in_z = drawing
            .moves
            .iter()
            .any(|step| step.to[2] != drawing.start[2]);
        let axes = if moves_in_z { 3 } else { 2 };
        let steps_per_mm = self.steps_per_mm.clone();
        TableSettings {
            clock_hz: self.clock_hz,
            steps_per_mm: steps_per_mm.unwrap_or_else(|| vec![80.0; axes]),
            motion: self.motion,
            line_unit_ticks: self.line_unit_ticks,
            arc_unit_ticks: self.arc_unit_ticks.unwrap_or(self.line_unit_ticks),
            timing: self.timing,
            ..TableSettings::default()
        }
    }

    /// Returns the motors on `axes` axes, if there are any.
    ///
    /// # Errors
    /// A figure of theirs is out of range.
    pub fn motors(&self, axes: usize) -> Result<Option<Motors>, SettingError> {
        let motors = |motor| Motors::new(&motor, axes, self.clock_hz);
        let motors = self.motor.map(motors).transpose();
        motors.map_err(|error| error.at(Place::Table("motor")))
    }
}

settings! {
    /// A pattern of the memory: a table `[[pattern]]`.
    #[derive(Eq)]
    pub struct PatternKeys {
        /// Name in `play`.
        pub name [required]: String = String::new(), "not empty, and no other's";
        /// Words of the pattern in CSV; in a scenario file relative to that file.
        pub table [required]: PathBuf = PathBuf::new();
        /// Ratio that its half-periods are multiplied by, as 3/2.
        pub scale: Option<String> = None;
    }
}

settings! {
    /// A group of axes: a table `[[group]]`.
    #[derive(Eq)]
    pub struct GroupKeys {
        /// Names of its patterns in the order in which they are played.
        pub play [required]: Vec<String> = Vec::new();
        /// Tick of its first command; its pattern begins two ticks later.
        pub command_tick: u64 = 0, in 0..=1_000_000_000_000_u64;
    }
}

choices!(ConventionalMoves, VariantName);

/// Moves that the computer 7 gives the conventional device of Fig. 5.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ConventionalMoves {
    /// One for every unit time of the planned path.
    #[default]
    UnitTimes,
    /// One for each line and each arc, by its parameters (¶0003–0004).
    Pieces,
}

/// The variant by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
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
