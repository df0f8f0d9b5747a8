//! The arc generator of JPH0743606B2.

pub mod difference_column;
pub mod difference_engine;
pub mod generator;
pub mod position_command;
pub mod rotation;
pub mod rotation_control;
pub mod rotation_row;
pub mod segment_memory;
pub mod segment_sequencer;

pub use difference_column::DifferenceColumn;
pub use difference_engine::DifferenceEngine;
pub use generator::ArcGenerator;
pub use position_command::PositionCommand;
pub use rotation::Rotation;
pub use rotation_control::RotationControl;
pub use rotation_row::RotationRow;
pub use segment_memory::SegmentMemory;
pub use segment_sequencer::SegmentSequencer;

/// How the rotation rounds its points to guard units.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Rounding {
    /// To the nearest, a half upwards.
    #[default]
    Nearest,
    /// Down.
    Floor,
}
