//! Parameters of a motor with an elastic load, and their allowed ranges.

use crate::plant::parameters::{MOST_TORQUE_NM, POSITIVE};
use crate::settings::{Table, settings};
use std::ops::RangeInclusive;

/// Amounts that may be none.
const FROM_ZERO: RangeInclusive<f64> = 0.0..=*POSITIVE.end();

settings! {
    /// Amplifier, motor 32, shaft, load 33 and encoder of one axis. What belongs to the load counts
    /// at the motor's shaft. Default: a table on a screw of 10 mm with 1 µm a count, 87 Hz of the
    /// motor and the load against each other, damped by 5 %, no friction, no backlash.
    #[derive(Copy)]
    pub struct TwoMassParameters {
        /// Largest torque of the amplifier: that of the largest torque word.
        pub max_torque_nm [required]: f64 = 10.0, in *POSITIVE.start()..=MOST_TORQUE_NM;
        /// Inertia of the motor.
        pub motor_inertia_kg_m2 [required]: f64 = 1e-3, in POSITIVE;
        /// Inertia of the load.
        pub load_inertia_kg_m2 [required]: f64 = 2e-3, in POSITIVE;
        /// Stiffness of the shaft.
        pub stiffness_nm_per_rad [required]: f64 = 200.0, in POSITIVE;
        /// Encoder counts per revolution of the motor: four times its lines.
        pub counts_per_rev [required]: f64 = 10_000.0, in POSITIVE;
        /// Travel of the load per revolution of the motor: lead of the screw, with its gear.
        pub mm_per_rev [required]: f64 = 10.0, in POSITIVE,
            "counts_per_rev divided by counts_per_mm";
        /// Damping of the shaft; 0 for none.
        pub damping_nm_s_per_rad: f64 = 0.0, in FROM_ZERO;
        /// Backlash: angle that the shaft turns without torque, from one flank to the other; 0 for
        /// none.
        pub backlash_rad: f64 = 0.0, in FROM_ZERO;
        /// Viscous friction of the motor; 0 for none.
        pub motor_viscous_nm_s_per_rad: f64 = 0.0, in FROM_ZERO;
        /// Viscous friction of the load; 0 for none.
        pub load_viscous_nm_s_per_rad: f64 = 0.0, in FROM_ZERO;
        /// Coulomb friction of the motor; 0 for none.
        pub motor_friction_nm: f64 = 0.0, in FROM_ZERO;
        /// Coulomb friction of the load; 0 for none.
        pub load_friction_nm: f64 = 0.0, in FROM_ZERO;
        /// Stiction of the motor: torque that starts it. Below the Coulomb friction it counts as
        /// that.
        pub motor_stiction_nm: f64 = 0.0, in FROM_ZERO;
        /// Stiction of the load, likewise.
        pub load_stiction_nm: f64 = 0.0, in FROM_ZERO;
    }
    default {
        TwoMassParameters {
            damping_nm_s_per_rad: 0.0365,
            ..Table::initial()
        }
    }
}

/// Greatest product of the plant's fastest rate and a tick: a piece of the motion takes 0.5 of it.
const LONGEST: f64 = 1e4;

impl TwoMassParameters {
    /// Encoder counts a radian.
    pub fn counts_per_rad(&self) -> f64 {
        self.counts_per_rev / std::f64::consts::TAU
    }

    /// Returns the encoder counts per millimetre of the load.
    pub fn counts_per_mm(&self) -> f64 {
        self.counts_per_rev / self.mm_per_rev
    }

    /// Returns a bound of the plant's rates without jumps of the torque, in 1/s: the sum of the
    /// natural frequency (rad/s) and the rates of the dampings.
    pub fn fastest_per_s(&self) -> f64 {
        let (motor, load) = (self.motor_inertia_kg_m2, self.load_inertia_kg_m2);
        let compliance = 1.0 / motor + 1.0 / load;
        (self.stiffness_nm_per_rad * compliance).sqrt()
            + self.damping_nm_s_per_rad * compliance
            + self.motor_viscous_nm_s_per_rad / motor
            + self.load_viscous_nm_s_per_rad / load
    }

    /// Returns the greatest tick for which the axis can be simulated, in seconds.
    pub fn longest_tick_s(&self) -> f64 {
        LONGEST / self.fastest_per_s()
    }
}
