//! The keys of the arc generator.

use super::exactly::exactly;
use super::{Place, Program, Runnable};
use crate::circuits::arc_generator::{Blend, Rounding};
use crate::input::Point;
use crate::jobs::arc_generator::mechanism::Mechanism;
use crate::jobs::arc_generator::settings::{Settings, ShortPieces};
use crate::path::arm::{Arm, Elbow};
use crate::path::pieces::Taught;
use crate::settings::{self, SettingError};
use serde::{Deserialize, Deserializer};
use std::path::PathBuf;

/// A scenario of the arc generator. Every key but `circuit` has a default; the path is a drawing or
/// part program, or the tables `[[piece]]`.
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
    /// Where the first piece begins.
    #[serde(default, deserialize_with = "exactly")]
    pub start_mm: Point,
    /// The pieces.
    #[serde(default)]
    pub piece: Vec<PieceKeys>,
    /// Reference clock in Hz.
    #[serde(default = "default::clock_hz")]
    pub clock_hz: u64,
    /// Ts: time from one position command to the next.
    #[serde(default = "default::sample_period_ms")]
    pub sample_period_ms: f64,
    /// 2ta: duration of a blend.
    #[serde(default = "default::acceleration_ms")]
    pub acceleration_ms: f64,
    /// Counts of a position command per millimetre.
    #[serde(default = "default::counts_per_mm")]
    pub counts_per_mm: f64,
    /// Speed of the pieces that have none of their own.
    pub speed_mm_per_s: Option<f64>,
    /// Speed of pen-up and G0 moves.
    #[serde(default = "default::rapid_mm_per_s")]
    pub rapid_mm_per_s: f64,
    /// Largest turn between two pieces that are joined without a stop.
    #[serde(default = "default::corner_deg")]
    pub corner_deg: f64,
    /// How the rotation rounds.
    #[serde(default)]
    pub rounding: Rounding,
    /// How blends and lines are made.
    #[serde(default)]
    pub blend: Blend,
    /// What becomes of a piece that is too short or too tight for its speed.
    #[serde(default)]
    pub short_pieces: ShortPieces,
    /// The arm whose hand the commands are of.
    pub arm: Option<ArmKeys>,
    /// An elastic mechanism under the commands.
    pub mechanism: Option<MechanismKeys>,
    /// Plays what the circuit is compared with too: its arcs on the conventional circuit.
    #[serde(default)]
    pub beside: bool,
    /// The most ticks that go into the VCD unless a window is asked for.
    #[serde(default = "default::vcd_ticks")]
    pub vcd_ticks: u64,
}

/// A table `[[piece]]`.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PieceKeys<const FOURTH: bool = false> {
    /// Where it ends, with W where there may be a fourth axis.
    pub to_mm: Place<FOURTH>,
    /// A point of the arc; without it the piece is a line or a spline.
    #[serde(default, deserialize_with = "some_point")]
    pub via_mm: Option<Point>,
    /// It is a spline: one curve through the ends of all such pieces in a row.
    #[serde(default)]
    pub spline: bool,
    /// Its speed, where it has its own.
    pub speed_mm_per_s: Option<f64>,
}

/// The table `[arm]`.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ArmKeys {
    /// Where its shoulder is.
    #[serde(default, deserialize_with = "exactly")]
    pub shoulder_mm: Point,
    /// From shoulder to elbow.
    pub upper_mm: f64,
    /// From elbow to hand.
    pub fore_mm: f64,
    /// On which side its elbow is.
    #[serde(default)]
    pub elbow: Elbow,
    /// How near to a singular pose it may not be.
    #[serde(default = "default::singular_deg")]
    pub singular_deg: f64,
    /// Counts of a turn of a joint.
    #[serde(default = "default::counts_per_rev")]
    pub counts_per_rev: u32,
}

impl From<ArmKeys> for Arm {
    fn from(keys: ArmKeys) -> Self {
        Arm {
            shoulder_mm: keys.shoulder_mm,
            upper_mm: keys.upper_mm,
            fore_mm: keys.fore_mm,
            elbow: keys.elbow,
            singular_deg: keys.singular_deg,
            counts_per_rev: keys.counts_per_rev,
        }
    }
}

/// The table `[mechanism]`.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MechanismKeys {
    /// Its natural frequency.
    pub frequency_hz: f64,
    /// Its damping, as a share of the critical one.
    #[serde(default)]
    pub damping: f64,
}

impl From<MechanismKeys> for Mechanism {
    fn from(keys: MechanismKeys) -> Self {
        Mechanism {
            frequency_hz: keys.frequency_hz,
            damping: keys.damping,
        }
    }
}

fn some_point<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Point>, D::Error> {
    exactly(from).map(Some)
}

impl Scenario {
    /// The settings it stands for.
    #[must_use]
    pub fn settings(&self) -> Settings {
        Settings {
            clock_hz: self.clock_hz,
            sample_period_ms: self.sample_period_ms,
            acceleration_ms: self.acceleration_ms,
            counts_per_mm: self.counts_per_mm,
            speed_mm_per_s: self.speed_mm_per_s,
            rapid_mm_per_s: self.rapid_mm_per_s,
            corner_deg: self.corner_deg,
            rounding: self.rounding,
            blend: self.blend,
            short_pieces: self.short_pieces,
        }
    }

    /// The taught pieces, from [`Scenario::start_mm`] on; empty if the path is a drawing.
    ///
    /// # Errors
    /// There are pieces, and a drawing too.
    pub fn taught(&self) -> Result<Vec<Taught>, SettingError> {
        taught(self.input.as_ref(), &self.piece)
    }
}

/// The pieces as they are taught, in X, Y and Z; empty if the path is a drawing.
pub(super) fn taught<const FOURTH: bool>(
    input: Option<&PathBuf>,
    piece: &[PieceKeys<FOURTH>],
) -> Result<Vec<Taught>, SettingError> {
    if input.is_some() && !piece.is_empty() {
        return Err(SettingError::new(
            "input",
            "given beside tables [[piece]]",
            "a drawing or pieces, not both",
        ));
    }
    if let Some(both) = piece.iter().position(|of| of.spline && of.via_mm.is_some()) {
        let error = SettingError::new("spline", "given beside via_mm", "an arc or a spline");
        return Err(error.at(settings::Place::Row("piece", both)));
    }
    let taught = |piece: &PieceKeys<FOURTH>| Taught {
        to: piece.to_mm.point,
        via: piece.via_mm,
        spline: piece.spline,
        speed: piece.speed_mm_per_s,
    };
    Ok(piece.iter().map(taught).collect())
}

/// What a key is worth that is not given: what the settings are by default.
mod default {
    use super::Settings;

    fn settings() -> Settings {
        Settings::default()
    }
    pub(super) fn clock_hz() -> u64 {
        settings().clock_hz
    }
    pub(super) fn sample_period_ms() -> f64 {
        settings().sample_period_ms
    }
    pub(super) fn acceleration_ms() -> f64 {
        settings().acceleration_ms
    }
    pub(super) fn counts_per_mm() -> f64 {
        settings().counts_per_mm
    }
    pub(super) fn rapid_mm_per_s() -> f64 {
        settings().rapid_mm_per_s
    }
    pub(super) fn corner_deg() -> f64 {
        settings().corner_deg
    }
    pub(super) fn singular_deg() -> f64 {
        1.0
    }
    pub(super) fn counts_per_rev() -> u32 {
        1 << 20
    }
    pub(super) fn vcd_ticks() -> u64 {
        super::super::VCD_TICKS
    }
}
