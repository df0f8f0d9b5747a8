//! The text of circuits as VHDL, without any simulator.

mod names;
mod snapshots;
mod vhpi;
