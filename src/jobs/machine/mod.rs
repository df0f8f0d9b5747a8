//! A job on the machine: steppers, servos and pen lift.

mod host;
pub mod job;
pub mod measure;
pub mod program;
mod seen;
pub mod settings;
mod surroundings;
pub mod waves;

pub use program::Program;
pub use settings::Settings;
