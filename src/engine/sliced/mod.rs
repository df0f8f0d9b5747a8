//! Bit-sliced evaluation of a combinational netlist, or of one tick of any netlist, for many cases
//! at once. A slice is one bit of all cases; a gate works on slices.
//!
//! Words may have any width, and operations that only move bits cost nothing.

pub(crate) mod gates;
pub(crate) mod lower;
pub(crate) mod state;
mod steps;
#[cfg(test)]
mod tests;
mod ticks;
mod transpose;

pub use steps::{LANES, Run, Sliced, WORDS};
pub use ticks::{Tick, Ticks, Turned};
use transpose::transpose;

/// The netlist has state that is not part of a case, or too many gates or bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NotSliced;
