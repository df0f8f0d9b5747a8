//! Moving body with a motor drive, a brake and an encoder, which a lead-angle compensator stops.
//!
//! Acceleration is constant between events (the speed is reached, the brake engages, the body
//! comes to rest), so the motion between them is a parabola. A tick is split at its events and
//! integrated exactly.

mod parameters;
#[cfg(test)]
mod tests;

pub use parameters::{BodyParameters, Load};

use super::parameters::check_tick;
use super::{Encoder, Plant};
use crate::settings::SettingError;

/// Motor drive, body, brake and encoder, stepped once per reference tick.
#[derive(Debug, Clone)]
pub struct BrakedBody {
    parameters: BodyParameters,
    encoder: Encoder,
    tick_s: f64,
    load: Load,
    position_counts: f64,
    speed_counts_per_s: f64,
    /// Time for which the brake's control signal has been constant, in seconds.
    signal_s: f64,
    engaged: bool,
    /// True if the brake has slipped since its last release.
    rubbed: bool,
    brakings: u32,
    /// Remaining part of the brake's torque.
    left: f64,
}

/// State of a body, without its load.
#[derive(Debug, Clone, Copy)]
pub struct BodyState {
    position_counts: f64,
    speed_counts_per_s: f64,
    signal_s: f64,
    engaged: bool,
    rubbed: bool,
    brakings: u32,
    left: f64,
}

impl Plant for BrakedBody {
    type State = BodyState;

    #[inline]
    fn state(&self) -> BodyState {
        BodyState {
            position_counts: self.position_counts,
            speed_counts_per_s: self.speed_counts_per_s,
            signal_s: self.signal_s,
            engaged: self.engaged,
            rubbed: self.rubbed,
            brakings: self.brakings,
            left: self.left,
        }
    }

    #[inline]
    fn set_state(&mut self, state: &BodyState) {
        self.position_counts = state.position_counts;
        self.speed_counts_per_s = state.speed_counts_per_s;
        self.signal_s = state.signal_s;
        self.engaged = state.engaged;
        self.rubbed = state.rubbed;
        self.brakings = state.brakings;
        self.left = state.left;
    }
}

impl BrakedBody {
    /// Creates a body at rest at position 0 with a new brake, on a reference tick of `tick_s`
    /// seconds.
    ///
    /// # Errors
    ///
    /// Returns a [`SettingError`] that names the parameter, or `tick_s`, that is out of range.
    pub fn new(parameters: &BodyParameters, tick_s: f64) -> Result<Self, SettingError> {
        parameters.ranges()?;
        check_tick(tick_s)?;
        Ok(BrakedBody {
            parameters: *parameters,
            encoder: Encoder::default(),
            tick_s,
            load: Load::default(),
            position_counts: 0.0,
            speed_counts_per_s: 0.0,
            signal_s: 0.0,
            engaged: false,
            rubbed: false,
            brakings: 0,
            left: 1.0,
        })
    }

    /// Changes the load, from the next tick on.
    ///
    /// # Errors
    ///
    /// Returns a [`SettingError`] that names the factor that is out of range.
    pub fn set_load(&mut self, load: Load) -> Result<(), SettingError> {
        load.ranges()?;
        self.load = load;
        Ok(())
    }

    /// Advances one tick. The motor is on or off (`drive`), towards smaller counts (`reverse`),
    /// with this speed as its reference; `brake` is the control signal of the brake. An engaged
    /// brake overrides the motor. Returns the encoder's channels A and B of the next tick.
    #[inline]
    pub fn step(
        &mut self,
        drive: bool,
        reverse: bool,
        speed_counts_per_s: f64,
        brake: bool,
    ) -> (bool, bool) {
        let tick = self.tick_s;
        let free = match brake {
            true => (self.parameters.brake_dead_time_s - self.signal_s).clamp(0.0, tick),
            false => tick,
        };
        self.signal_s = if brake { self.signal_s + tick } else { 0.0 };
        if !brake && self.rubbed {
            self.rubbed = false;
            self.brakings += 1;
            self.left = (1.0 - self.parameters.brake_fade).powf(f64::from(self.brakings));
        }
        self.engaged = false;
        match drive {
            true => {
                let reference = if reverse { -1.0 } else { 1.0 } * speed_counts_per_s;
                self.approach(reference, self.parameters.acceleration_counts_per_s2, free);
            }
            false => self.slow_down(free),
        }
        if free < tick {
            self.engaged = true;
            self.rubbed |= self.speed_counts_per_s != 0.0;
            self.slow_down(tick - free);
        }
        self.encoder.see(self.position_counts)
    }

    /// Returns the current levels of the encoder's channels A and B.
    #[inline]
    pub fn channels(&self) -> (bool, bool) {
        self.encoder.channels(self.position_counts)
    }

    /// Returns the position in encoder counts.
    #[inline]
    pub fn position_counts(&self) -> f64 {
        self.position_counts
    }

    /// Returns the speed in encoder counts per second.
    #[inline]
    pub fn speed_counts_per_s(&self) -> f64 {
        self.speed_counts_per_s
    }

    /// True if the brake is engaged: its signal has been high for the dead time.
    #[inline]
    pub fn engaged(&self) -> bool {
        self.engaged
    }

    /// Returns the number of completed brakings: releases of a brake that has slipped.
    #[inline]
    pub fn brakings(&self) -> u32 {
        self.brakings
    }

    /// Returns the friction torque of the bearings and of an engaged brake, in N·m.
    #[inline]
    pub fn friction_nm(&self) -> f64 {
        let bearings = self.parameters.friction_nm * self.load.load_friction_factor;
        match self.engaged {
            true => bearings + self.brake_torque_nm(),
            false => bearings,
        }
    }

    /// Returns the friction torque of the brake under this load and at its age, in N·m.
    #[inline]
    pub fn brake_torque_nm(&self) -> f64 {
        self.parameters.brake_torque_nm * self.load.load_brake_factor * self.left
    }

    /// Returns the deceleration by friction, in counts/s².
    #[inline]
    fn deceleration(&self) -> f64 {
        let inertia = self.parameters.inertia_kg_m2 * self.load.load_inertia_factor;
        self.friction_nm() / inertia * self.parameters.counts_per_rad()
    }

    /// Moves for `time_s` seconds, slowed down by friction until it rests.
    #[inline]
    fn slow_down(&mut self, time_s: f64) {
        // A body rests in most ticks, and two divisions take as long as all else in them.
        if self.speed_counts_per_s != 0.0 {
            self.approach(0.0, self.deceleration(), time_s);
        }
    }

    /// Moves for `time_s` seconds, with this acceleration until `speed` is reached.
    #[inline]
    fn approach(&mut self, speed: f64, acceleration: f64, time_s: f64) {
        let missing = speed - self.speed_counts_per_s;
        let reached = missing.abs() / acceleration;
        if reached <= time_s {
            self.advance(acceleration.copysign(missing), reached);
            self.speed_counts_per_s = speed;
            self.advance(0.0, time_s - reached);
        } else {
            self.advance(acceleration.copysign(missing), time_s);
        }
    }

    #[inline]
    fn advance(&mut self, acceleration: f64, time_s: f64) {
        let mean = self.speed_counts_per_s + 0.5 * acceleration * time_s;
        self.position_counts += mean * time_s;
        self.speed_counts_per_s += acceleration * time_s;
    }
}
