//! Scenario files: what is run, on which input, with which settings, in TOML.
//!
//! The key `circuit` chooses the circuit, and with it the other keys. Keys carry their units in
//! their names; an unknown key, a value of the wrong type and a key given twice are faults with
//! their line.

pub mod arc_generator;
mod exactly;
pub mod lead_angle;
pub mod linear_interpolator;
mod loaded;
pub mod machine;
mod program;
pub mod pulse_interpolator;
pub mod trajectory_controller;

pub use exactly::Place;
pub use loaded::Loaded;
pub use program::Program;

use crate::input::{DRAWINGS, Kind, POSITION_LOGS};
use serde::Deserialize;
use std::path::PathBuf;

/// A scenario with no key but the one that has no default: for an input given by itself.
const BARE: &str = "circuit = \"pulse_interpolator\"\n";

/// The same for a position log given by itself: two targets, and a lead to be judged.
const BARE_LOG: &str = "circuit = \"lead_angle\"\n\
     [[step]]\ntarget = 1000\nspeed_counts_per_s = 1000\nlead_ms = 10\n\
     [[step]]\ntarget = 0\nspeed_counts_per_s = 1000\nlead_ms = 10\n";

/// The most ticks that go into a VCD where neither a window nor the scenario says so.
const VCD_TICKS: u64 = 1_000_000;

/// A scenario of one of the circuits.
#[derive(Debug, Clone, PartialEq)]
pub enum Scenario {
    /// JP3640909B2.
    PulseInterpolator(pulse_interpolator::Scenario),
    /// JP3608587B2.
    LinearInterpolator(linear_interpolator::Scenario),
    /// JPH0646367B2.
    LeadAngle(lead_angle::Scenario),
    /// JPH0743606B2.
    ArcGenerator(arc_generator::Scenario),
    /// CN104204977.
    TrajectoryController(Box<trajectory_controller::Scenario>),
    /// All of them as one motion controller.
    Machine(Box<machine::Scenario>),
}

impl Scenario {
    /// The circuit.
    pub fn circuit(&self) -> Runnable {
        match self {
            Scenario::PulseInterpolator(_) => Runnable::PulseInterpolator,
            Scenario::LinearInterpolator(_) => Runnable::LinearInterpolator,
            Scenario::LeadAngle(_) => Runnable::LeadAngle,
            Scenario::ArcGenerator(_) => Runnable::ArcGenerator,
            Scenario::TrajectoryController(_) => Runnable::TrajectoryController,
            Scenario::Machine(_) => Runnable::Machine,
        }
    }

    /// The drawing, part program or position log; in a file relative to that file.
    pub fn input(&self) -> Option<&PathBuf> {
        match self {
            Scenario::PulseInterpolator(scenario) => scenario.input.as_ref(),
            Scenario::LinearInterpolator(scenario) => scenario.input.as_ref(),
            Scenario::LeadAngle(scenario) => scenario.input.as_ref(),
            Scenario::ArcGenerator(scenario) => scenario.input.as_ref(),
            Scenario::TrajectoryController(scenario) => scenario.input.as_ref(),
            Scenario::Machine(scenario) => scenario.input.as_ref(),
        }
    }

    /// The same, to be changed.
    fn input_mut(&mut self) -> Option<&mut PathBuf> {
        match self {
            Scenario::PulseInterpolator(scenario) => scenario.input.as_mut(),
            Scenario::LinearInterpolator(scenario) => scenario.input.as_mut(),
            Scenario::LeadAngle(scenario) => scenario.input.as_mut(),
            Scenario::ArcGenerator(scenario) => scenario.input.as_mut(),
            Scenario::TrajectoryController(scenario) => scenario.input.as_mut(),
            Scenario::Machine(scenario) => scenario.input.as_mut(),
        }
    }

    /// Where the zeros of a part program are.
    pub fn program(&self) -> Option<&Program> {
        match self {
            Scenario::PulseInterpolator(scenario) => Some(&scenario.program),
            Scenario::LinearInterpolator(scenario) => Some(&scenario.program),
            Scenario::LeadAngle(_) => None,
            Scenario::ArcGenerator(scenario) => Some(&scenario.program),
            Scenario::TrajectoryController(scenario) => Some(&scenario.program),
            Scenario::Machine(scenario) => Some(&scenario.program),
        }
    }

    fn program_mut(&mut self) -> Option<&mut Program> {
        match self {
            Scenario::PulseInterpolator(scenario) => Some(&mut scenario.program),
            Scenario::LinearInterpolator(scenario) => Some(&mut scenario.program),
            Scenario::LeadAngle(_) => None,
            Scenario::ArcGenerator(scenario) => Some(&mut scenario.program),
            Scenario::TrajectoryController(scenario) => Some(&mut scenario.program),
            Scenario::Machine(scenario) => Some(&mut scenario.program),
        }
    }

    /// Reference clock in Hz.
    pub fn clock_hz(&self) -> u64 {
        match self {
            Scenario::PulseInterpolator(scenario) => scenario.clock_hz,
            Scenario::LinearInterpolator(scenario) => scenario.clock_hz,
            Scenario::LeadAngle(scenario) => scenario.clock_hz,
            Scenario::ArcGenerator(scenario) => scenario.clock_hz,
            Scenario::TrajectoryController(scenario) => scenario.clock_hz,
            Scenario::Machine(scenario) => scenario.clock_hz,
        }
    }

    /// True if what the circuit is compared with is played too.
    pub fn beside(&self) -> bool {
        match self {
            Scenario::PulseInterpolator(scenario) => scenario.beside,
            Scenario::LinearInterpolator(scenario) => scenario.beside,
            Scenario::LeadAngle(scenario) => scenario.beside,
            Scenario::ArcGenerator(scenario) => scenario.beside,
            Scenario::TrajectoryController(scenario) => scenario.beside,
            // Its machines are both its own.
            Scenario::Machine(_) => false,
        }
    }

    /// The most ticks that go into the VCD unless a window is asked for.
    pub fn vcd_ticks(&self) -> u64 {
        match self {
            Scenario::PulseInterpolator(scenario) => scenario.vcd_ticks,
            Scenario::LinearInterpolator(scenario) => scenario.vcd_ticks,
            Scenario::LeadAngle(scenario) => scenario.vcd_ticks,
            Scenario::ArcGenerator(scenario) => scenario.vcd_ticks,
            Scenario::TrajectoryController(scenario) => scenario.vcd_ticks,
            Scenario::Machine(scenario) => scenario.vcd_ticks,
        }
    }
}

/// Circuits that a scenario can run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Runnable {
    /// JP3640909B2.
    PulseInterpolator,
    /// JP3608587B2.
    LinearInterpolator,
    /// JPH0646367B2.
    LeadAngle,
    /// JPH0743606B2.
    ArcGenerator,
    /// CN104204977.
    TrajectoryController,
    /// All of them as one motion controller.
    Machine,
}

impl Runnable {
    /// The name it has in scenarios.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Runnable::PulseInterpolator => "pulse_interpolator",
            Runnable::LinearInterpolator => "linear_interpolator",
            Runnable::LeadAngle => "lead_angle",
            Runnable::ArcGenerator => "arc_generator",
            Runnable::TrajectoryController => "trajectory_controller",
            Runnable::Machine => "machine",
        }
    }

    /// Whether its input is of this kind.
    #[must_use]
    pub fn takes(self, kind: Kind) -> bool {
        match kind {
            Kind::Scenario => false,
            Kind::Drawing => self != Runnable::LeadAngle,
            Kind::PositionLog => self == Runnable::LeadAngle,
        }
    }

    /// What its input may be, for faults.
    #[must_use]
    pub fn inputs(self) -> &'static str {
        match self {
            Runnable::LeadAngle => POSITION_LOGS,
            _ => DRAWINGS,
        }
    }
}
