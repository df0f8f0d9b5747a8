//! The numbers of a motor with an elastic load, and what is allowed of them.

use crate::plant::parameters::POSITIVE;
use crate::settings::{SettingError, within};
use serde::{Deserialize, Serialize};

/// Amplifier, motor 32, shaft, load 33 and encoder of one axis. What belongs to the load counts at
/// the motor's shaft.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TwoMassParameters {
    /// Greatest torque that the amplifier gives, in N·m: that of the greatest torque word.
    pub max_torque_nm: f64,
    /// Inertia of the motor, in kg·m².
    pub motor_inertia_kg_m2: f64,
    /// Inertia of the load, in kg·m².
    pub load_inertia_kg_m2: f64,
    /// Stiffness of the shaft, in N·m/rad.
    pub stiffness_nm_per_rad: f64,
    /// Encoder counts a turn of the motor: four times its lines.
    pub counts_per_rev: f64,
    /// Way of the load a turn of the motor: lead of the screw, with the gear before it, in mm.
    pub mm_per_rev: f64,
    /// Damping of the shaft, in N·m·s/rad; 0 for none.
    #[serde(default)]
    pub damping_nm_s_per_rad: f64,
    /// Backlash: how far the shaft turns without torque, from one flank to the other, in rad; 0 for
    /// none.
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
    /// Stiction of the motor, in N·m: what has to be exceeded before it starts. Below the Coulomb
    /// friction it counts as that.
    #[serde(default)]
    pub motor_stiction_nm: f64,
    /// Stiction of the load, in N·m, likewise.
    #[serde(default)]
    pub load_stiction_nm: f64,
}

impl Default for TwoMassParameters {
    /// A table on a screw of 10 mm with 1 µm a count: 87 Hz of the motor and the load against each
    /// other, damped by 5 %, no friction, no backlash.
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

/// Most that the plant's fastest rate times a tick may be: a piece of the motion takes half of 1.
const LONGEST: f64 = 1e4;

impl TwoMassParameters {
    /// Checks every field.
    ///
    /// # Errors
    ///
    /// [`SettingError`] names the first that is outside its range or not a number.
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

    /// Encoder counts a radian.
    pub fn counts_per_rad(&self) -> f64 {
        self.counts_per_rev / std::f64::consts::TAU
    }

    /// Encoder counts a millimetre of the load.
    pub fn counts_per_mm(&self) -> f64 {
        self.counts_per_rev / self.mm_per_rev
    }

    /// No faster than this does anything change without a jump of the torque, in 1/s: natural
    /// frequency (rad/s) and the rates at which the dampings act, together.
    pub fn fastest_per_s(&self) -> f64 {
        let (motor, load) = (self.motor_inertia_kg_m2, self.load_inertia_kg_m2);
        let compliance = 1.0 / motor + 1.0 / load;
        (self.stiffness_nm_per_rad * compliance).sqrt()
            + self.damping_nm_s_per_rad * compliance
            + self.motor_viscous_nm_s_per_rad / motor
            + self.load_viscous_nm_s_per_rad / load
    }

    /// The longest tick that the axis can be simulated on.
    pub fn longest_tick_s(&self) -> f64 {
        LONGEST / self.fastest_per_s()
    }
}
