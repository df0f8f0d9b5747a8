//! The linear interpolator of JP3608587B2.
//!
//! ```text
//!  targets ─▶┌────────────────┐  ┌───────────┐ Δ of the master ┌──────────────────────┐ x(n)
//!  abort ───▶│ target data 20 ├─▶│ sequencer ├────────────────▶│ position pattern     ├──┬───────────┐
//!            └────────────────┘  └──┬────────┘                 │ generator 14         │  │           │
//!                                   │                          └──────────────────────┘  ▼           ▼
//!                                   │ Δx, Δy    ┌───────────────┐ δx(n) ┌─────────────────┐   ┌─────────────┐
//!                                   └──────────▶│ integrator 24 │◀──────┤ differentiator  │   │ axis switch │
//!                                               │ I, B          │       │ 21 = 22 + 23    │   │ adder 25    │
//!                                               └───────┬───────┘       └─────────────────┘   └──┬───────┬──┘
//!                                                       │ I                                  ▲   │ x     │ y
//!                                                       └────────────────────────────────────┘   ▼       ▼
//!                                                                                     position loops 10–13
//! ```
//!
//! Every *scan* one axis, the master, gets the next position of a trapezoid, and the other, the
//! slave, the corresponding position on the straight line, by an integer division whose remainder
//! is carried on. `rtl_notes/linear_interpolator/README.md` is the note of this circuit.

pub mod accumulator;
pub mod axis_switch;
pub mod command_source;
pub mod controller;
pub mod conventional;
pub mod cycle_gate;
pub mod differentiator;
pub mod integrator;
pub mod interpolator;
pub mod line_law;
pub mod line_sweep;
pub mod pattern_generator;
pub mod position_control;
pub mod position_loop;
pub mod sequencer;
pub mod target_data;
pub mod trapezoid;
pub mod widths;

pub use accumulator::{Accumulator, Rule};
pub use axis_switch::AxisSwitch;
pub use command_source::{CommandPart, CommandSource};
pub use controller::Controller;
pub use conventional::Conventional;
pub use cycle_gate::CycleGate;
pub use differentiator::Differentiator;
pub use integrator::Integrator;
pub use interpolator::LinearInterpolator;
pub use line_law::LineLaw;
pub use line_sweep::LineSweep;
pub use pattern_generator::PatternGenerator;
pub use position_control::PositionControl;
pub use position_loop::PositionLoop;
pub use sequencer::{MasterAxis, Sequencer};
pub use target_data::TargetData;
pub use trapezoid::Trapezoid;
pub use widths::{LoopWidths, Widths};
