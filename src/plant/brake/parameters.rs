//! Parameters of a braked body, and their allowed ranges.

use crate::plant::parameters::{MOST_TORQUE_NM, POSITIVE};
use crate::settings::settings;
use std::ops::RangeInclusive;

/// Factors of a load that are accepted.
const FACTORS: RangeInclusive<f64> = 1e-3..=1e3;

settings! {
    /// Motor drive, body, brake and encoder: a rotary table that stops from 90,000 counts a second
    /// in 42 ms.
    #[derive(Copy)]
    pub struct BodyParameters {
        /// Encoder counts per revolution: four times its lines.
        pub counts_per_rev [required]: f64 = 90_000.0, in POSITIVE;
        /// Acceleration of the drive, whatever the load.
        pub acceleration_counts_per_s2 [required]: f64 = 600_000.0, in POSITIVE;
        /// Inertia of motor and body before the load changes.
        pub inertia_kg_m2 [required]: f64 = 0.5, in POSITIVE;
        /// Coulomb friction of the bearings before the load changes; 0 for none.
        pub friction_nm [required]: f64 = 1.5, in 0.0..=MOST_TORQUE_NM,
            "also together with brake_torque_nm";
        /// Time from the control signal until the brake engages.
        pub brake_dead_time_s [required]: f64 = 0.012, in 0.0..=10.0;
        /// Friction torque of the new brake.
        pub brake_torque_nm [required]: f64 = 50.0, in *POSITIVE.start()..=MOST_TORQUE_NM,
            "also together with friction_nm";
        /// Part of its torque that the brake loses with each braking; 0 for none.
        pub brake_fade [required]: f64 = 0.0005, in 0.0..=0.5;
    }
}

impl BodyParameters {
    /// Encoder counts a radian.
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

settings! {
    /// Load on the body, as factors of the values without it.
    #[derive(Copy)]
    pub struct Load {
        /// Factor of the inertia.
        pub load_inertia_factor: f64 = 1.0, in FACTORS;
        /// Factor of the bearings' friction.
        pub load_friction_factor: f64 = 1.0, in FACTORS,
            "as long as friction and brake are in their ranges";
        /// Factor of the brake's torque: a loaded brake gets hot.
        pub load_brake_factor: f64 = 1.0, in FACTORS,
            "as long as friction and brake are in their ranges";
    }
}
