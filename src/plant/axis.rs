//! Driver, motor and encoder of one axis.

use super::parameters::check_tick;
use super::servo::MotorState;
use super::{Encoder, Motor, Plant, ServoDriver, ServoParameters};
use crate::settings::SettingError;

/// Servo driver 2, motor 3 and pulse generator 4 of one axis, stepped once per reference tick.
#[derive(Debug, Clone)]
pub struct ServoAxis {
    driver: ServoDriver,
    motor: Motor,
    encoder: Encoder,
    counts_per_rad: f64,
    tick_s: f64,
    torque_nm: f64,
    /// Word, full scale, and the speed in rad/s that they request.
    asked: (i64, i64, f64),
}

impl ServoAxis {
    /// Creates an axis at rest at position 0, on a reference tick of `tick_s` seconds.
    ///
    /// # Errors
    ///
    /// Returns a [`SettingError`] that names the parameter, or `tick_s`, that is out of range.
    pub fn new(parameters: &ServoParameters, tick_s: f64) -> Result<Self, SettingError> {
        parameters.validate()?;
        check_tick(tick_s)?;
        Ok(ServoAxis {
            driver: ServoDriver::new(parameters, tick_s),
            motor: Motor::new(parameters),
            encoder: Encoder::default(),
            counts_per_rad: parameters.counts_per_rad(),
            tick_s,
            torque_nm: 0.0,
            asked: (0, 1, 0.0),
        })
    }

    /// Advances one tick under the D/A word `reference`; `full_scale` is the greatest word and
    /// requests rated speed, values below 1 count as 1. Returns the encoder's channels A and B of
    /// the next tick.
    #[inline]
    pub fn step(&mut self, reference: i64, full_scale: i64) -> (bool, bool) {
        // The word is constant for many ticks, and a division takes as long as everything else.
        if (self.asked.0, self.asked.1) != (reference, full_scale) {
            let fraction = reference as f64 / full_scale.max(1) as f64;
            let wanted = self.driver.wanted_rad_per_s(fraction);
            self.asked = (reference, full_scale, wanted);
        }
        let speed = self.motor.speed_rad_per_s();
        self.torque_nm = self.driver.torque_nm(self.asked.2, speed);
        self.motor.step(self.torque_nm, self.tick_s);
        self.encoder.see(self.motor.position_counts())
    }

    /// Returns the current levels of the encoder's channels A and B.
    #[inline]
    pub fn channels(&self) -> (bool, bool) {
        self.encoder.channels(self.motor.position_counts())
    }

    /// Returns the position in encoder counts.
    #[inline]
    pub fn position_counts(&self) -> f64 {
        self.motor.position_counts()
    }

    /// Returns the speed in encoder counts per second.
    #[inline]
    pub fn speed_counts_per_s(&self) -> f64 {
        self.motor.speed_rad_per_s() * self.counts_per_rad
    }

    /// Returns the driver's torque in the last tick, in N·m.
    #[inline]
    pub fn torque_nm(&self) -> f64 {
        self.torque_nm
    }

    /// Returns the greatest speed in counts per second at which every quarter is sampled.
    pub fn countable_counts_per_s(&self) -> f64 {
        self.encoder.countable_counts_per_s(self.tick_s)
    }
}

impl Plant for ServoAxis {
    type State = (MotorState, f64);

    #[inline]
    fn state(&self) -> Self::State {
        (self.motor.state(), self.torque_nm)
    }

    #[inline]
    fn set_state(&mut self, (motor, torque_nm): &Self::State) {
        self.motor.set_state(motor);
        self.torque_nm = *torque_nm;
    }
}
