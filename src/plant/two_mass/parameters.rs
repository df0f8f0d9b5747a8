//! Parameters of a motor with an elastic load, and their allowed ranges.

use crate::plant::parameters::POSITIVE;
use crate::settings::{SettingError, within};
use serde::{Deserialize, Serialize};

/// Parameters of amplifier, motor 32, shaft, load 33 and encoder of one axis. Quantities of the
/// load refer to the motor's shaft.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TwoMassParameters {
    /// Greatest torque of the amplifier, in N·m: that of the greatest torque word.
    pub max_torque_nm: f64,
    /// Inertia of the motor, in kg·m².
    pub motor_inertia_kg_m2: f64,
    /// Inertia of the load, in kg·m².
    pub load_inertia_kg_m2: f64,
    /// Stiffness of the shaft, in N·m/rad.
    pub stiffness_nm_per_rad: f64,
    /// Encoder counts per turn of the motor: four times its lines.
    pub counts_per_rev: f64,
    /// Travel of the load per turn of the motor in mm: lead of the screw, with its gear.
    pub mm_per_rev: f64,
    /// Damping of the shaft, in N·m·s/rad; 0 for none.
    #[serde(default)]
    pub damping_nm_s_per_rad: f64,
    /// Backlash in rad: free rotation of the shaft from one flank to the other; 0 for none.
    #[serde(default)]
    pub backlash_rad: f64,
    /// Viscous friction of the motor, in N·m·s/rad; 0 for none.
    #[serde(default)]
    pub motor_viscous_nm_s_per_rad: f64,
    /// Viscous friction of the load, in N·m·s/rad; 0 for none.
    #[serde(default)]
    pub load_viscous_nm_s_per_rad: f64,
    /// Coulomb friction of the motor, in N·m; 0 for none.
    #[serde(default)]
    pub motor_friction_nm: f64,
    /// Coulomb friction of the load, in N·m; 0 for none.
    #[serde(default)]
    pub load_friction_nm: f64,
    /// Stiction of the motor in N·m: the torque that must be exceeded to start. Values below the
    /// Coulomb friction count as that.
    #[serde(default)]
    pub motor_stiction_nm: f64,
    /// Stiction of the load in N·m; values below its Coulomb friction count as that.
    #[serde(default)]
    pub load_stiction_nm: f64,
}

impl Default for TwoMassParameters {
    /// Returns a table on a screw of 10 mm with 1 µm per count: the motor and the load oscillate
    /// against each other at 87 Hz, damped by 5 %; no friction, no backlash.
    fn default() -> Self {
        TwoMassParameters {
            max_torque_nm: 10.0,
            motor_inertia_kg_m2: 1e-3,
            load_inertia_kg_m2: 2e-3,
            stiffness_nm_per_rad: 200.0,
            counts_per_rev: 10_000.0,
            mm_per_rev: 10.0,
            damping_nm_s_per_rad: 0.0365,
            backlash_rad: 0.0,
            motor_viscous_nm_s_per_rad: 0.0,
            load_viscous_nm_s_per_rad: 0.0,
            motor_friction_nm: 0.0,
            load_friction_nm: 0.0,
            motor_stiction_nm: 0.0,
            load_stiction_nm: 0.0,
        }
    }
}

/// Greatest product of the plant's fastest rate and a tick: a piece of the motion takes 0.5 of it.
const LONGEST: f64 = 1e4;

impl TwoMassParameters {
    /// Checks every field.
    ///
    /// # Errors
    ///
    /// Returns a [`SettingError`] that names the first field outside its range or not a number.
    pub fn validate(&self) -> Result<(), SettingError> {
        let from_zero = 0.0..=*POSITIVE.end();
        let needed = [
            ("max_torque_nm", self.max_torque_nm),
            ("motor_inertia_kg_m2", self.motor_inertia_kg_m2),
            ("load_inertia_kg_m2", self.load_inertia_kg_m2),
            ("stiffness_nm_per_rad", self.stiffness_nm_per_rad),
            ("counts_per_rev", self.counts_per_rev),
            ("mm_per_rev", self.mm_per_rev),
        ];
        let optional = [
            ("damping_nm_s_per_rad", self.damping_nm_s_per_rad),
            ("backlash_rad", self.backlash_rad),
            (
                "motor_viscous_nm_s_per_rad",
                self.motor_viscous_nm_s_per_rad,
            ),
            ("load_viscous_nm_s_per_rad", self.load_viscous_nm_s_per_rad),
            ("motor_friction_nm", self.motor_friction_nm),
            ("load_friction_nm", self.load_friction_nm),
            ("motor_stiction_nm", self.motor_stiction_nm),
            ("load_stiction_nm", self.load_stiction_nm),
        ];
        needed
            .into_iter()
            .try_for_each(|(field, value)| within(field, value, &POSITIVE))?;
        optional
            .into_iter()
            .try_for_each(|(field, value)| within(field, value, &from_zero))
    }

    /// Returns the encoder counts per radian.
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
