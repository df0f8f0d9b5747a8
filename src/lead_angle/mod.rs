//! The lead-angle compensator of JPH0646367B2.

pub mod settings;
pub mod time_code;
