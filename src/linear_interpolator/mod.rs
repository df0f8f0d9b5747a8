//! The linear interpolator of JP3608587B2.

pub mod position_control;
pub mod position_loop;

pub use position_control::PositionControl;
pub use position_loop::PositionLoop;
