//! Scenario files: what is run, on which input, with which settings, in TOML.
//!
//! The key `circuit` chooses the circuit, and with it the other keys. Keys carry their units in
//! their names; an unknown key, a value of the wrong type and a key given twice are faults with
//! their line.

mod loaded;
mod program;
pub mod pulse_interpolator;
mod run;
pub mod shipped;
#[cfg(test)]
mod turntable;

pub use loaded::Loaded;
pub use program::Program;
pub use run::{Keys, Run, Settings};

use crate::input::{DRAWINGS, Kind, POSITION_LOGS};
use crate::jobs::{arc_generator, lead_angle, linear_interpolator, machine, trajectory_controller};
use crate::settings::{Defaults, Key, choices, defaults};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Scenario for an input given by itself: only the key that has no default.
const BARE: &str = "circuit = \"pulse_interpolator\"\n";

/// Scenario for a position log given by itself: two targets, and a lead to be judged.
const BARE_LOG: &str = "circuit = \"lead_angle\"\n\
     [[step]]\ntarget = 1000\nspeed_counts_per_s = 1000\nlead_ms = 10\n\
     [[step]]\ntarget = 0\nspeed_counts_per_s = 1000\nlead_ms = 10\n";

/// A scenario of one of the circuits.
#[derive(Debug, Clone, PartialEq)]
pub enum Scenario {
    /// JP3640909B2.
    PulseInterpolator(Box<Keys<pulse_interpolator::Settings>>),
    /// JP3608587B2.
    LinearInterpolator(Box<Keys<linear_interpolator::settings::Settings>>),
    /// JPH0646367B2.
    LeadAngle(Box<Keys<lead_angle::settings::Settings>>),
    /// JPH0743606B2.
    ArcGenerator(Box<Keys<arc_generator::settings::Settings>>),
    /// CN104204977.
    TrajectoryController(Box<Keys<trajectory_controller::settings::Settings>>),
    /// All of them as one motion controller.
    Machine(Box<Keys<machine::Settings>>),
}

impl Scenario {
    /// Returns what all circuits have.
    #[must_use]
    pub fn run(&self) -> &Run {
        match self {
            Scenario::PulseInterpolator(keys) => &keys.run,
            Scenario::LinearInterpolator(keys) => &keys.run,
            Scenario::LeadAngle(keys) => &keys.run,
            Scenario::ArcGenerator(keys) => &keys.run,
            Scenario::TrajectoryController(keys) => &keys.run,
            Scenario::Machine(keys) => &keys.run,
        }
    }

    fn run_mut(&mut self) -> &mut Run {
        match self {
            Scenario::PulseInterpolator(keys) => &mut keys.run,
            Scenario::LinearInterpolator(keys) => &mut keys.run,
            Scenario::LeadAngle(keys) => &mut keys.run,
            Scenario::ArcGenerator(keys) => &mut keys.run,
            Scenario::TrajectoryController(keys) => &mut keys.run,
            Scenario::Machine(keys) => &mut keys.run,
        }
    }

    /// The circuit.
    #[must_use]
    pub fn circuit(&self) -> Runnable {
        self.run().circuit
    }

    /// The drawing, part program or position log; in a file relative to that file.
    #[must_use]
    pub fn input(&self) -> Option<&PathBuf> {
        self.run().input.as_ref()
    }

    /// Reference clock in Hz.
    #[must_use]
    pub fn clock_hz(&self) -> u64 {
        match self {
            Scenario::PulseInterpolator(keys) => keys.settings.clock_hz,
            Scenario::LinearInterpolator(keys) => keys.settings.clock_hz,
            Scenario::LeadAngle(keys) => keys.settings.clock_hz,
            Scenario::ArcGenerator(keys) => keys.settings.clock_hz,
            Scenario::TrajectoryController(keys) => keys.settings.clock_hz,
            Scenario::Machine(keys) => keys.settings.clock_hz,
        }
    }

    /// True if what the circuit is compared with is played too.
    #[must_use]
    pub fn beside(&self) -> bool {
        self.run().beside
    }

    /// Most ticks that go into the VCD unless a window is asked for.
    #[must_use]
    pub fn vcd_ticks(&self) -> u64 {
        self.run().vcd_ticks
    }
}

/// Circuits that a scenario can run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
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

choices!(Runnable);

impl Settings for pulse_interpolator::Settings {
    const CIRCUIT: Runnable = Runnable::PulseInterpolator;
    const WITHOUT: &'static [&'static str] = &[];
}

impl Settings for linear_interpolator::settings::Settings {
    const CIRCUIT: Runnable = Runnable::LinearInterpolator;
    const WITHOUT: &'static [&'static str] = &[];
}

impl Settings for lead_angle::settings::Settings {
    const CIRCUIT: Runnable = Runnable::LeadAngle;
    // A position log is no part program.
    const WITHOUT: &'static [&'static str] = &["program"];
}

impl Settings for arc_generator::settings::Settings {
    const CIRCUIT: Runnable = Runnable::ArcGenerator;
    const WITHOUT: &'static [&'static str] = &[];
}

impl Settings for trajectory_controller::settings::Settings {
    const CIRCUIT: Runnable = Runnable::TrajectoryController;
    const WITHOUT: &'static [&'static str] = &[];
}

impl Settings for machine::Settings {
    const CIRCUIT: Runnable = Runnable::Machine;
    // Its machines are both its own.
    const WITHOUT: &'static [&'static str] = &["beside"];
}

impl Runnable {
    /// All of them.
    pub const ALL: [Runnable; 6] = [
        Runnable::PulseInterpolator,
        Runnable::LinearInterpolator,
        Runnable::LeadAngle,
        Runnable::ArcGenerator,
        Runnable::TrajectoryController,
        Runnable::Machine,
    ];

    /// Keys of its scenarios, and the defaults of those that have one.
    #[must_use]
    pub fn keys(self) -> (Vec<&'static Key>, Defaults) {
        fn of<S: Settings + serde::Serialize>() -> (Vec<&'static Key>, Defaults) {
            let mut values = defaults::<Run>();
            values.0.extend(defaults::<S>().0);
            (Keys::<S>::all(), values)
        }
        match self {
            Runnable::PulseInterpolator => of::<pulse_interpolator::Settings>(),
            Runnable::LinearInterpolator => of::<linear_interpolator::settings::Settings>(),
            Runnable::LeadAngle => of::<lead_angle::settings::Settings>(),
            Runnable::ArcGenerator => of::<arc_generator::settings::Settings>(),
            Runnable::TrajectoryController => of::<trajectory_controller::settings::Settings>(),
            Runnable::Machine => of::<machine::Settings>(),
        }
    }

    /// Names of the other circuits that have a key.
    fn others_with(self, key: &str) -> Vec<&'static str> {
        let has = |of: &Runnable| *of != self && of.keys().0.iter().any(|own| own.name == key);
        Runnable::ALL
            .into_iter()
            .filter(has)
            .map(Runnable::name)
            .collect()
    }

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

    /// Returns true if its input can be of this kind.
    #[must_use]
    pub fn takes(self, kind: Kind) -> bool {
        match kind {
            Kind::Scenario => false,
            Kind::Drawing => self != Runnable::LeadAngle,
            Kind::PositionLog => self == Runnable::LeadAngle,
        }
    }

    /// Returns the allowed kinds of input, for faults.
    #[must_use]
    pub fn inputs(self) -> &'static str {
        match self {
            Runnable::LeadAngle => POSITION_LOGS,
            _ => DRAWINGS,
        }
    }
}
