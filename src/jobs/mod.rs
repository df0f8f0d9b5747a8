//! Jobs: what the circuits are given and what came of it, by programs that are no hardware.
//!
//! A folder for each circuit: its settings, what makes words of a drawing, the control computer that
//! feeds it, a run with what stands around it, and what is measured of the run.

pub mod arc_generator;
pub mod lead_angle;
pub mod linear_interpolator;
pub mod machine;
pub mod pulse_interpolator;
pub mod trajectory_controller;
