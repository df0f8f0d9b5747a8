//! Many cases of a combinational netlist, or of a tick of any, side by side: a bit of all of them is one slice, and a gate
//! works on slices.
//!
//! So words may have any width, and what only moves bits costs nothing.

mod gates;
mod lower;
mod state;
mod steps;
#[cfg(test)]
mod tests;
mod transpose;

pub use steps::{LANES, Run, Sliced, Tick, Ticks};
use transpose::transpose;

/// It has registers, or memories that are written, that are no case's, or too many gates or bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NotSliced;
