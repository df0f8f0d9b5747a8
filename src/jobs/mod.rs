//! Jobs: inputs of the circuits and their results, by programs that are not hardware.
//!
//! Each circuit has a folder: its settings, the conversion of a drawing to words, the control
//! computer that feeds it, a run with its surroundings, and the measures of the run.

pub mod arc_generator;
mod error;
pub mod lead_angle;
pub mod linear_interpolator;
pub mod machine;
pub mod pulse_interpolator;
mod record_writer;
pub mod taught;
pub mod trajectory_controller;

pub use error::JobError;
