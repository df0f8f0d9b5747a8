//! Behavioural models of the plant: motors, encoders, loads, on the same reference tick as the
//! circuits.
//!
//! ```text
//!             ┌────────────────────────── servo axis ──────────────────────────┐
//!             │ ┌────────────────┐ torque ┌─────────┐ position ┌─────────────┐ │
//!  D/A word ──┼▶│ servo driver 2 ├───────▶│ motor 3 ├─────────▶│ encoder 4   ├─┼▶ a, b
//!             │ └───────▲────────┘        └────┬────┘          └─────────────┘ │
//!             │         └──────── speed ───────┘                               │
//!             └────────────────────────────────────────────────────────────────┘
//! ```
//!
//! ```text
//!                    ┌──────────────── braked body ────────────────┐
//!  drive, reverse,   │ ┌───────┐      ┌──────┐ position ┌─────────┐ │
//!  speed ────────────┼▶│ motor ├─────▶│ body ├─────────▶│ encoder ├─┼▶ a, b
//!                    │ └───────┘      └──▲───┘          └─────────┘ │
//!  brake ────────────┼▶ dead time ▶ brake┘                          │
//!                    └─────────────────────────────────────────────┘
//! ```
//!
//! ```text
//!              ┌───────────────────── two-mass axis ─────────────────────┐
//!              │ ┌───────────┐ torque ┌──────────┐ twist ┌─────────┐     │
//!  torque word ┼▶│ amplifier ├───────▶│ motor 32 ├───────┤ load 33 ├─────┼▶ load position
//!              │ └───────────┘        └────┬─────┘       └─────────┘     │
//!              │                           └─▶ encoder ──────────────────┼▶ a, b
//!              └─────────────────────────────────────────────────────────┘
//! ```
//!
//! `rtl_notes/plant.md` has the equations and the idealisations.

mod absolute;
mod ahead;
pub mod axis;
pub mod brake;
pub mod encoder;
mod operation;
pub mod parameters;
mod phase_shift;
mod resolver;
pub mod servo;
pub mod step_motor;
pub mod two_mass;
pub mod waves;

pub use absolute::AbsoluteEncoder;
pub use ahead::{Ahead, Plant, Plants};
pub use axis::ServoAxis;
pub use brake::{BodyParameters, BrakedBody, Load};
pub use encoder::Encoder;
pub use operation::Operation;
pub use parameters::{MOST_TORQUE_NM, ServoParameters};
pub use phase_shift::PhaseShiftTransducer;
pub use resolver::{POLE_PAIRS_RANGE, Resolver, ResolverParameters, WINDING_RANGE};
pub use servo::{Motor, ServoDriver};
pub use step_motor::{StepMotor, StepMotorParameters};
pub use two_mass::{TwoMassAxis, TwoMassParameters};

#[cfg(test)]
mod tests;
