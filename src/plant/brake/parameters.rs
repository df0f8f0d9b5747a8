//! Parameters of a braked body, and their allowed ranges.

use crate::plant::parameters::POSITIVE;
use crate::settings::{SettingError, within};
use serde::{Deserialize, Serialize};

/// Parameters of motor drive, body, brake and encoder.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BodyParameters {
    /// Encoder counts per turn: four times its lines.
    pub counts_per_rev: f64,
    /// Acceleration of the drive, independent of the load, in counts/s².
    pub acceleration_counts_per_s2: f64,
    /// Inertia of motor and body before the load changes, in kg·m².
    pub inertia_kg_m2: f64,
    /// Coulomb friction of the bearings before the load changes, in N·m; 0 for none.
    pub friction_nm: f64,
    /// Time from the control signal until the brake engages, in seconds.
    pub brake_dead_time_s: f64,
    /// Friction torque of the new brake, in N·m.
    pub brake_torque_nm: f64,
    /// Part of its torque that the brake loses with each braking; 0 for none.
    pub brake_fade: f64,
}

impl Default for BodyParameters {
    /// Returns a rotary table that stops from 90,000 counts per second in 42 ms.
    fn default() -> Self {
        BodyParameters {
            counts_per_rev: 90_000.0,
            acceleration_counts_per_s2: 600_000.0,
            inertia_kg_m2: 0.5,
            friction_nm: 1.5,
            brake_dead_time_s: 0.012,
            brake_torque_nm: 50.0,
            brake_fade: 0.0005,
        }
    }
}

impl BodyParameters {
    /// Checks every field.
    ///
    /// # Errors
    ///
    /// Returns a [`SettingError`] that names the first field outside its range or not a number.
    pub fn validate(&self) -> Result<(), SettingError> {
        let from_zero = 0.0..=*POSITIVE.end();
        let acceleration = self.acceleration_counts_per_s2;
        within("counts_per_rev", self.counts_per_rev, &POSITIVE)?;
        within("acceleration_counts_per_s2", acceleration, &POSITIVE)?;
        within("inertia_kg_m2", self.inertia_kg_m2, &POSITIVE)?;
        within("friction_nm", self.friction_nm, &from_zero)?;
        within("brake_dead_time_s", self.brake_dead_time_s, &(0.0..=10.0))?;
        within("brake_torque_nm", self.brake_torque_nm, &POSITIVE)?;
        within("brake_fade", self.brake_fade, &(0.0..=0.5))
    }

    /// Returns the encoder counts per radian.
    #[inline]
    pub fn counts_per_rad(&self) -> f64 {
        self.counts_per_rev / std::f64::consts::TAU
    }

    /// Returns the distance from the brake's control signal to rest, at this speed without a load
    /// and with a new brake, in counts: v·td + v²/2a if the bearings have no friction.
    pub fn stopping_way_counts(&self, speed_counts_per_s: f64) -> f64 {
        let per_nm = self.counts_per_rad() / self.inertia_kg_m2;
        let coasting = self.friction_nm * per_nm;
        let braking = (self.friction_nm + self.brake_torque_nm) * per_nm;
        let dead = self.brake_dead_time_s;
        let bite = speed_counts_per_s - coasting * dead;
        if bite <= 0.0 && coasting > 0.0 {
            // Stops before the brake engages.
            return speed_counts_per_s * speed_counts_per_s / (2.0 * coasting);
        }
        (speed_counts_per_s + bite) / 2.0 * dead + bite * bite / (2.0 * braking)
    }
}

/// Load of the body, as factors of the values without load.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Load {
    /// Factor of the inertia.
    pub load_inertia_factor: f64,
    /// Factor of the bearings' friction.
    pub load_friction_factor: f64,
    /// Factor of the brake's friction torque: a loaded brake gets hot.
    pub load_brake_factor: f64,
}

impl Load {
    /// No load.
    pub const NONE: Self = Load {
        load_inertia_factor: 1.0,
        load_friction_factor: 1.0,
        load_brake_factor: 1.0,
    };

    /// Checks every factor.
    ///
    /// # Errors
    ///
    /// Returns a [`SettingError`] that names the first factor outside its range or not a number.
    pub fn validate(&self) -> Result<(), SettingError> {
        let factors = 1e-3..=1e3;
        within("load_inertia_factor", self.load_inertia_factor, &factors)?;
        within("load_friction_factor", self.load_friction_factor, &factors)?;
        within("load_brake_factor", self.load_brake_factor, &factors)
    }
}
