//! The circuits: the blocks that several are made of, a folder for each patent, and the machine of
//! them all.
//!
//! A file is a circuit; widths, names and laws on numbers that several need have files of their own.

pub mod arc_generator;
pub mod blocks;
pub mod lead_angle;
pub mod linear_interpolator;
pub mod machine;
pub mod pulse_interpolator;
pub mod trajectory_controller;
