//! Motion-control patents as cycle-accurate register-transfer-level models on one shared
//! reference tick.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod arc_generator;
pub mod blocks;
pub mod check;
pub mod compare;
pub mod input;
pub mod kernel;
pub mod lead_angle;
pub mod linear_interpolator;
pub mod logic;
pub mod machine;
pub mod picture;
pub mod plan;
pub mod plant;
pub mod pulse_interpolator;
pub mod registry;
pub mod trace;
pub mod trajectory_controller;
pub mod verilog;

/// The code in the note on conventions is compiled and run as a test.
#[cfg(doctest)]
#[allow(rustdoc::invalid_codeblock_attributes, reason = "charts stand in it")]
#[doc = include_str!("../rtl_notes/conventions.md")]
pub struct Conventions;

/// The code in the README is compiled and run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
