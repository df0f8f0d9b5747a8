//! All five circuits as one motion controller: steppers and servos on one job, one reference tick.
//!
//! ```text
//!                  ┌ enables ┐ unit time, scan, CK, Ts
//!                  └────┬────┘
//!       ┌───────────────┼──────────────────────────────┐
//!       ▼               ▼                              ▼
//!  pulse interpolator  linear interpolator ─ lines ─┐  lead-angle compensator ─▶ pen drive, brake
//!       │              arc generator ────── arcs ──┬┘          ▲ encoder of the pen lift
//!       ▼                                          ▼
//!  step, dir of X, Y                        command join
//!                                                  ▼
//!                                        trajectory controller ─▶ torques of X, Y
//!                                                  ▲ encoders of X, Y
//! ```
//!
//! `rtl_notes/machine/README.md` describes the wiring, the control computer and what the patents
//! leave open.

pub mod circuit;
pub mod command_join;
pub mod enables;
pub mod ports;

pub use circuit::Machine;
pub use command_join::CommandJoin;
pub use enables::Enables;
