//! Servo driver 2 and motor 3.
//!
//! The driver's torque is constant for a tick, so the motion within a tick is a parabola, which is
//! integrated exactly: if friction stops the motor within a tick, it stops at that moment.

use super::{Plant, ServoParameters};

/// Servo driver 2: first-order velocity loop with a torque limit.
///
/// Without friction, the torque of a tick brings the motor to the speed that the continuous loop
/// `inertia · (speed_reference − speed) / velocity_loop_s` would reach at the end of the tick.
#[derive(Debug, Clone, Copy)]
pub struct ServoDriver {
    /// Torque per speed difference, in N·m·s/rad.
    gain: f64,
    max_torque_nm: f64,
    rated_speed_rad_per_s: f64,
}

impl ServoDriver {
    /// Creates a driver on a reference tick of `tick_s` seconds.
    pub fn new(parameters: &ServoParameters, tick_s: f64) -> Self {
        let approach = -(-tick_s / parameters.velocity_loop_s).exp_m1();
        ServoDriver {
            gain: parameters.inertia_kg_m2 * approach / tick_s,
            max_torque_nm: parameters.max_torque_nm,
            rated_speed_rad_per_s: parameters.rated_speed_rad_per_s,
        }
    }

    /// Returns the speed in rad/s that a reference requests, a fraction of rated speed.
    #[inline]
    pub fn wanted_rad_per_s(&self, reference: f64) -> f64 {
        reference * self.rated_speed_rad_per_s
    }

    /// Returns the torque in N·m for a requested and a current speed, both in rad/s.
    #[inline]
    pub fn torque_nm(&self, wanted_rad_per_s: f64, speed_rad_per_s: f64) -> f64 {
        let missing = wanted_rad_per_s - speed_rad_per_s;
        (self.gain * missing).clamp(-self.max_torque_nm, self.max_torque_nm)
    }
}

/// Position in counts and speed in rad/s of a motor.
pub type MotorState = [f64; 2];

/// Motor 3 with its load: inertia and Coulomb friction.
#[derive(Debug, Clone, Copy)]
pub struct Motor {
    /// Acceleration per torque, in 1/(kg·m²).
    ease: f64,
    friction_nm: f64,
    counts_per_rad: f64,
    position_counts: f64,
    speed_rad_per_s: f64,
}

impl Motor {
    /// Creates a motor at rest at position 0.
    pub fn new(parameters: &ServoParameters) -> Self {
        Motor {
            ease: 1.0 / parameters.inertia_kg_m2,
            friction_nm: parameters.friction_nm,
            counts_per_rad: parameters.counts_per_rad(),
            position_counts: 0.0,
            speed_rad_per_s: 0.0,
        }
    }

    /// Returns the position in encoder counts.
    #[inline]
    pub fn position_counts(&self) -> f64 {
        self.position_counts
    }

    /// Returns the speed in rad/s.
    #[inline]
    pub fn speed_rad_per_s(&self) -> f64 {
        self.speed_rad_per_s
    }

    /// Moves for `time_s` seconds under a constant torque.
    #[inline]
    pub fn step(&mut self, torque_nm: f64, time_s: f64) {
        let speed = self.speed_rad_per_s;
        if speed == 0.0 {
            return self.start(torque_nm, time_s);
        }
        let opposed = torque_nm - self.friction_nm * speed.signum();
        let acceleration = opposed * self.ease;
        if (speed + acceleration * time_s) * speed >= 0.0 {
            return self.advance(acceleration, time_s);
        }
        // Comes to rest within this time, and may reverse.
        let stop = -speed / acceleration;
        self.advance(acceleration, stop);
        self.speed_rad_per_s = 0.0;
        self.start(torque_nm, time_s - stop);
    }

    /// Starts from rest: friction holds the motor, or opposes the torque.
    #[inline]
    fn start(&mut self, torque_nm: f64, time_s: f64) {
        let over = (torque_nm.abs() - self.friction_nm).max(0.0);
        self.advance(over * torque_nm.signum() * self.ease, time_s);
    }

    #[inline]
    fn advance(&mut self, acceleration: f64, time_s: f64) {
        let mean = self.speed_rad_per_s + 0.5 * acceleration * time_s;
        self.position_counts += mean * time_s * self.counts_per_rad;
        self.speed_rad_per_s += acceleration * time_s;
    }
}

impl Plant for Motor {
    type State = MotorState;

    #[inline]
    fn state(&self) -> MotorState {
        [self.position_counts, self.speed_rad_per_s]
    }

    #[inline]
    fn set_state(&mut self, &[position_counts, speed_rad_per_s]: &MotorState) {
        self.position_counts = position_counts;
        self.speed_rad_per_s = speed_rad_per_s;
    }
}
