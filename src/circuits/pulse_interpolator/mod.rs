//! The multi-axis pulse interpolator of JP3640909B2.
//!
//! ```text
//!                 ┌──────────────┐ active T ┌───────────────────┐
//!  T, write ─────▶│ unit-time    ├─────────▶│ unit-time counter ├─ RST ──────────┬──────────────┐
//!                 │ register     │          │ 30                │                │              │
//!                 └──────▲───────┘          └───────────────────┘                ▼              │
//!                        │ T of the pattern               ┌────────────────────────────┐        │
//!                 ┌──────┴───────┐ waiting command        │ address sequencer          │        │
//!  command ──────▶│ command port ├───────────────────────▶│ 50                         │        │
//!                 └──────────────┘                        └──────────────────┬─────────┘        │
//!                                                      read, blank, address  │                  │
//!   one per axis ┌───────────────────────────────────────────────────────────▼────────────────┐ │
//!                │ ┌───────────────────┐ n ┌──────────────────────┐          ┌──────────────┐ │ │
//!  pattern ──────┼▶│ pattern memory 10 ├──▶│ pulse generator 20 = ├─ pulse ─▶│ sync stage   ├─┼─┼▶ step
//!  words         │ └─────────┬─────────┘   │ counter 201 +        │          │ 40           │ │ │
//!                │           │             │ comparator 202       │          └──────▲───────┘ │ │
//!                │           │             └──────────▲───────────┘                 │         │ │
//!                │           │                        └──────────── RST ────────────┴─────────┼─┘
//!                │           └────────────────────────────────────────────────────────────────┼──▶ dir
//!                └────────────────────────────────────────────────────────────────────────────┘
//! ```
//!
//! A *unit time* is T ticks. For each unit time and axis the memory holds a direction and a
//! half-period n; the axis' step line toggles n, 2n, … ticks into the unit time and is low again
//! when the next one begins. The unit-time counter 30 is an
//! [`EnableCounter`](super::blocks::EnableCounter). `rtl_notes/pulse_interpolator/README.md` is the note
//! of this circuit.

pub mod address_sequencer;
pub mod axis;
pub mod circular_interpolator;
pub mod command_port;
pub mod conventional;
pub mod counts;
pub mod group;
pub mod groups;
pub mod motor_controller;
pub mod pattern_memory;
pub mod pulse_generator;
pub mod pulse_train;
pub mod sync_stage;
pub mod unit_law;
pub mod unit_time_register;
pub mod widths;

pub use address_sequencer::AddressSequencer;
pub use axis::Axis;
pub use circular_interpolator::CircularInterpolator;
pub use command_port::CommandPort;
pub use conventional::Conventional;
pub use group::Group;
pub use groups::Groups;
pub use motor_controller::{ConventionalWidths, MotorController};
pub use pattern_memory::PatternMemory;
pub use pulse_generator::PulseGenerator;
pub use pulse_train::PulseTrain;
pub use sync_stage::SyncStage;
pub use unit_law::UnitLaw;
pub use unit_time_register::UnitTimeRegister;
pub use widths::Widths;

/// The most axes of one group.
pub const AXES_MAX: usize = 8;

/// Names of the axes, in the order of a group.
pub const AXIS_NAMES: [&str; AXES_MAX] = ["x", "y", "z", "a", "b", "c", "u", "v"];

/// Registers that RST clears.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Variant {
    /// The reference-clock counter 201, the toggle of the comparator 202 and the flip-flop 40.
    #[default]
    Safe,
    /// Only the flip-flop 40, as ¶0017 has it; 201 and 202 run on across unit times.
    Literal,
}

/// A pattern in the memory: its addresses, its end, and its unit time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pattern {
    /// Address of its first word.
    pub base: u64,
    /// Address of its last word; below `base` the pattern runs across the top of the memory.
    pub last: u64,
    /// Starts again after its last word.
    pub cyclic: bool,
    /// Unit time T in ticks.
    pub period: u64,
}
