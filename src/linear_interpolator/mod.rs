//! The linear interpolator of JP3608587B2.

pub mod pattern_generator;
pub mod trapezoid;

pub use pattern_generator::PatternGenerator;
pub use trapezoid::Trapezoid;
