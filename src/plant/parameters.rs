//! Parameters of a servo axis, and their allowed ranges.

use crate::settings::{CLOCK_RANGE_HZ, SettingError, within};
use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;

/// Allowed range of positive quantities.
pub(super) const POSITIVE: RangeInclusive<f64> = 1e-9..=1e9;

/// Greatest torque, in N·m: the waves hold it in mN·m in 32 bits.
pub const MOST_TORQUE_NM: f64 = 2_147_483.0;

/// Parameters of servo driver, motor, load and encoder of one axis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ServoParameters {
    /// Time constant of the driver's velocity loop, in seconds.
    pub velocity_loop_s: f64,
    /// Inertia of motor and load, in kg·m².
    pub inertia_kg_m2: f64,
    /// Greatest torque of the driver, in N·m.
    pub max_torque_nm: f64,
    /// Coulomb friction, in N·m; 0 for none.
    pub friction_nm: f64,
    /// Speed at the greatest word of the D/A converter, in rad/s.
    pub rated_speed_rad_per_s: f64,
    /// Encoder counts per turn: four times its lines.
    pub counts_per_rev: f64,
}

impl Default for ServoParameters {
    /// Returns a 400 W motor with 3000 turns per minute, an encoder of 500 lines, and no friction.
    fn default() -> Self {
        ServoParameters {
            velocity_loop_s: 0.005,
            inertia_kg_m2: 1e-4,
            max_torque_nm: 3.8,
            friction_nm: 0.0,
            rated_speed_rad_per_s: 314.16,
            counts_per_rev: 2000.0,
        }
    }
}

impl ServoParameters {
    /// Checks every field.
    ///
    /// # Errors
    ///
    /// Returns a [`SettingError`] that names the first field outside its range or not a number.
    pub fn validate(&self) -> Result<(), SettingError> {
        let friction = 0.0..=*POSITIVE.end();
        let fields = [
            ("velocity_loop_s", self.velocity_loop_s, &POSITIVE),
            ("inertia_kg_m2", self.inertia_kg_m2, &POSITIVE),
            ("max_torque_nm", self.max_torque_nm, &POSITIVE),
            ("friction_nm", self.friction_nm, &friction),
            (
                "rated_speed_rad_per_s",
                self.rated_speed_rad_per_s,
                &POSITIVE,
            ),
            ("counts_per_rev", self.counts_per_rev, &POSITIVE),
        ];
        fields
            .into_iter()
            .try_for_each(|(field, value, allowed)| within(field, value, allowed))
    }

    /// Returns the encoder counts per second at the greatest word of the D/A converter.
    pub fn rated_counts_per_s(&self) -> f64 {
        self.rated_speed_rad_per_s * self.counts_per_rad()
    }

    /// Returns the encoder counts per radian.
    pub fn counts_per_rad(&self) -> f64 {
        self.counts_per_rev / std::f64::consts::TAU
    }
}

/// Checks the length of a reference tick; every allowed clock is valid.
pub(super) fn check_tick(tick_s: f64) -> Result<(), SettingError> {
    let least = 1.0 / *CLOCK_RANGE_HZ.end() as f64;
    within("tick_s", tick_s, &(least..=*POSITIVE.end()))
}
