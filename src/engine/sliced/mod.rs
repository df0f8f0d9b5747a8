//! Many cases of a combinational netlist side by side: a bit of all of them is one slice, and a gate
//! works on slices.
//!
//! So words may have any width, and what only moves bits costs nothing.

mod gates;
mod lower;
mod steps;
#[cfg(test)]
mod tests;
mod transpose;

pub use steps::{LANES, Run, Sliced};
use transpose::transpose;

/// It has registers, or memories that are written, or too many gates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NotSliced;
