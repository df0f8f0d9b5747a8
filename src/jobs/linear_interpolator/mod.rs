//! A drawing on the linear interpolator: its cycles, the motors, and their deviations.

pub mod job;
pub mod measure;
pub mod profile;
pub mod reference;
pub mod settings;
pub mod targets;
pub mod ways;
