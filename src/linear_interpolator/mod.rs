//! The linear interpolator of JP3608587B2.

pub mod job;
pub mod measure;
pub mod reference;
pub mod settings;
pub mod targets;
