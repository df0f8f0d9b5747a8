//! The linear interpolator: its integrator alone, and whole positioning cycles.

mod cycles;
mod integrator;
mod law;
mod targets;
