//! Motor with an elastic load (13 = motor 32 and load 33 of CN104204977, Fig. 1): two inertias,
//! shaft, friction, backlash, and an encoder on the motor.
//!
//! ```text
//!              ┌───────────────────── two-mass axis ─────────────────────┐
//!              │ ┌───────────┐ torque ┌──────────┐ twist ┌─────────┐     │
//!  torque word ┼▶│ amplifier ├───────▶│ motor 32 ├───────┤ load 33 ├─────┼▶ load position
//!              │ └───────────┘        └────┬─────┘       └────▲────┘     │
//!  load torque ┼───────────────────────────┼──────────────────┘          │
//!              │                           └─▶ encoder ──────────────────┼▶ a, b
//!              └─────────────────────────────────────────────────────────┘
//! ```
//!
//! Between events the motion is linear and is integrated exactly; a tick is split at its events.

mod drive;
mod events;
mod motion;
mod parameters;
#[cfg(test)]
mod tests;

pub use parameters::TwoMassParameters;

use super::parameters::check_tick;
use super::{Encoder, Plant};
use crate::settings::{SettingError, within};
use events::{Flank, Grip};
use motion::{Equations, REACH, Regime, State, Step};

/// Amplifier, motor 32, shaft, load 33 and encoder of one axis, stepped once per reference tick.
#[derive(Debug, Clone)]
pub struct TwoMassAxis {
    parameters: TwoMassParameters,
    encoder: Encoder,
    tick_s: f64,
    counts_per_rad: f64,
    equations: Equations,
    /// Step of a whole tick without dry friction and backlash.
    whole: Step,
    /// Step of a piece of a tick, for each regime.
    pieces: [Step; 8],
    count: u32,
    /// Current torque word, and its torque.
    asked: (i64, f64),
    torque_nm: f64,
    /// External torque on the load, in N·m.
    load_torque_nm: f64,
    /// Motor angle, load angle, motor speed, load speed, in rad and rad/s.
    state: State,
    grips: [Grip; 2],
    flank: Flank,
}

/// State of a two-mass axis.
#[derive(Debug, Clone, Copy)]
pub struct TwoMassState {
    torque_nm: f64,
    load_torque_nm: f64,
    state: State,
    grips: [Grip; 2],
    flank: Flank,
}

impl Plant for TwoMassAxis {
    type State = TwoMassState;

    #[inline]
    fn state(&self) -> TwoMassState {
        TwoMassState {
            torque_nm: self.torque_nm,
            load_torque_nm: self.load_torque_nm,
            state: self.state,
            grips: self.grips,
            flank: self.flank,
        }
    }

    #[inline]
    fn set_state(&mut self, state: &TwoMassState) {
        self.torque_nm = state.torque_nm;
        self.load_torque_nm = state.load_torque_nm;
        self.state = state.state;
        self.grips = state.grips;
        self.flank = state.flank;
    }
}

impl TwoMassAxis {
    /// Torque word that requests the greatest torque; −32,768 requests the greatest negative
    /// torque.
    pub const FULL_SCALE: i64 = 32_767;

    /// Creates an axis at rest at position 0, in the middle of its backlash, on a reference tick
    /// of `tick_s` seconds.
    ///
    /// # Errors
    ///
    /// Returns a [`SettingError`] that names the parameter, or `tick_s`, that is out of range. A
    /// tick longer than [`TwoMassParameters::longest_tick_s`] is out of range too.
    pub fn new(parameters: &TwoMassParameters, tick_s: f64) -> Result<Self, SettingError> {
        parameters.ranges()?;
        check_tick(tick_s)?;
        let fastest = parameters.fastest_per_s();
        within("tick_s", tick_s, &(0.0..=parameters.longest_tick_s()))?;
        let count = (tick_s * fastest / REACH).ceil().max(1.0);
        let doublings = count.log2().ceil();
        let equations = Equations::new(parameters);
        let piece = |index: usize| {
            let stuck = [index & 1 != 0, index & 2 != 0];
            let touches = index & 4 != 0;
            let regime = Regime { touches, stuck };
            Step::new(&equations, regime, tick_s / count, 0)
        };
        let linear = Regime {
            touches: true,
            stuck: [false; 2],
        };
        let whole = Step::new(
            &equations,
            linear,
            tick_s / doublings.exp2(),
            doublings as u32,
        );
        let dry = [
            parameters
                .motor_friction_nm
                .max(parameters.motor_stiction_nm),
            parameters.load_friction_nm.max(parameters.load_stiction_nm),
        ];
        Ok(TwoMassAxis {
            parameters: *parameters,
            encoder: Encoder::default(),
            tick_s,
            counts_per_rad: parameters.counts_per_rad(),
            equations,
            whole,
            pieces: std::array::from_fn(piece),
            count: count as u32,
            asked: (0, 0.0),
            torque_nm: 0.0,
            load_torque_nm: 0.0,
            state: [0.0; 4],
            grips: dry.map(|dry| if dry > 0.0 { Grip::Stuck } else { Grip::Loose }),
            flank: match parameters.backlash_rad > 0.0 {
                true => Flank::Gap,
                false => Flank::Touches(0.0),
            },
        })
    }

    /// Sets the external torque on the load, in N·m at the motor's shaft, from the next tick on: a
    /// cutting force or a weight.
    pub fn set_load_torque_nm(&mut self, torque_nm: f64) {
        self.load_torque_nm = torque_nm;
    }

    /// Advances one tick under this 16-bit torque word; values beyond [`TwoMassAxis::FULL_SCALE`]
    /// request the greatest torque. Returns the encoder's channels A and B of the next tick.
    #[inline]
    pub fn step(&mut self, torque_word: i64) -> (bool, bool) {
        // The word is constant for many ticks, and a division takes as long as much of the rest.
        if self.asked.0 != torque_word {
            let word = torque_word.clamp(-Self::FULL_SCALE, Self::FULL_SCALE);
            let part = word as f64 / Self::FULL_SCALE as f64;
            self.asked = (torque_word, part * self.parameters.max_torque_nm);
        }
        self.drive(self.asked.1);
        self.encoder.see(self.state[0] * self.counts_per_rad)
    }

    /// Returns the current levels of the encoder's channels A and B.
    #[inline]
    pub fn channels(&self) -> (bool, bool) {
        self.encoder.channels(self.position_counts())
    }

    /// Returns the position of the motor in encoder counts.
    #[inline]
    pub fn position_counts(&self) -> f64 {
        self.state[0] * self.counts_per_rad
    }

    /// Returns the speed of the motor in encoder counts per second.
    #[inline]
    pub fn speed_counts_per_s(&self) -> f64 {
        self.state[2] * self.counts_per_rad
    }

    /// Returns the position of the load in encoder counts.
    #[inline]
    pub fn load_position_counts(&self) -> f64 {
        self.state[1] * self.counts_per_rad
    }

    /// Returns the speed of the load in encoder counts per second.
    #[inline]
    pub fn load_speed_counts_per_s(&self) -> f64 {
        self.state[3] * self.counts_per_rad
    }

    /// Returns the position of the load in mm.
    #[inline]
    pub fn load_position_mm(&self) -> f64 {
        self.load_position_counts() / self.parameters.counts_per_mm()
    }

    /// Returns the lead of the motor over the load, in rad.
    #[inline]
    pub fn twist_rad(&self) -> f64 {
        self.state[0] - self.state[1]
    }

    /// Returns the amplifier's torque in the last tick, in N·m.
    #[inline]
    pub fn torque_nm(&self) -> f64 {
        self.torque_nm
    }

    /// Returns the current torque of the shaft on the load, in N·m.
    #[inline]
    pub fn shaft_torque_nm(&self) -> f64 {
        let [motor, load, motor_speed, load_speed] = self.untwisted();
        let Equations {
            stiffness, damping, ..
        } = self.equations;
        match self.flank {
            Flank::Touches(_) => stiffness * (motor - load) + damping * (motor_speed - load_speed),
            _ => 0.0,
        }
    }

    /// Returns the greatest speed in counts per second at which every quarter is sampled.
    pub fn countable_counts_per_s(&self) -> f64 {
        self.encoder.countable_counts_per_s(self.tick_s)
    }
}
