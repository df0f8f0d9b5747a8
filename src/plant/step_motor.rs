//! Hybrid step motor with its driver: the magnet of a rotor in a field that rotates in steps.
//!
//! ```text
//! J·dω/dt = T·sin(p·(φ − θ)) − D·ω − friction        p = full steps a turn / 4
//! ```
//!
//! φ is the position of the field according to the driver, in whole steps or microsteps; the
//! currents follow immediately. A rotor that is off by more than two full steps is nearer to the
//! next tooth: it has lost four.

use super::parameters::{POSITIVE, check_tick};
use crate::settings::{SettingError, Table, settings};
use std::f64::consts::{FRAC_PI_2, TAU};
use std::ops::RangeInclusive;

/// Full steps from one tooth of the rotor to the next.
const TOOTH: f64 = 4.0;
/// Greatest integration step, in radians of the rotor's free oscillation.
const SWING: f64 = 0.02;
/// Greatest number of parts of a tick.
const MOST_PARTS: f64 = 1000.0;
/// Number of free oscillations in which a rotor comes to rest, if it does.
const SWINGS: f64 = 200.0;

/// Amounts that may be none.
const FROM_ZERO: RangeInclusive<f64> = 0.0..=*POSITIVE.end();

settings! {
    /// Step motor, driver and load of one axis. Default: a motor of 57 mm with its load, in full
    /// steps.
    #[derive(Copy)]
    pub struct StepMotorParameters {
        /// Largest torque at standstill.
        pub holding_torque_nm [required]: f64 = 1.0, in POSITIVE;
        /// Inertia of rotor and load.
        pub inertia_kg_m2 [required]: f64 = 5e-5, in POSITIVE,
            "enough for the torque and the clock";
        /// Torque per speed, viscous.
        pub damping_nm_s: f64 = 0.0, in FROM_ZERO;
        /// Coulomb friction; 0 for none.
        pub friction_nm: f64 = 0.0, in FROM_ZERO;
        /// Full steps per revolution: 200 are of 1.8°.
        pub full_steps_per_rev: u32 = 200, in 4..=10_000;
        /// Steps of the driver per full step.
        pub microsteps: u32 = 1, in 1..=1024;
    }
    default {
        StepMotorParameters {
            damping_nm_s: 5e-3,
            friction_nm: 0.03,
            ..Table::initial()
        }
    }
}

impl StepMotorParameters {
    /// Full steps of a radian.
    fn full_steps_per_rad(&self) -> f64 {
        f64::from(self.full_steps_per_rev) / TAU
    }

    /// Returns ω0 = √(p·T/J), the natural frequency of small oscillations about a tooth, in rad/s.
    fn natural_rad_per_s(&self) -> f64 {
        let teeth = f64::from(self.full_steps_per_rev) / TOOTH;
        (teeth * self.holding_torque_nm / self.inertia_kg_m2).sqrt()
    }
}

/// Step motor, stepped once per reference tick.
#[derive(Debug, Clone)]
pub struct StepMotor {
    /// Driver steps per full step.
    microsteps: f64,
    /// T/J, in full steps/s².
    pull: f64,
    /// D/J.
    damping: f64,
    /// Friction/J, in full steps/s².
    friction: f64,
    /// Number of parts of a tick, and the length of one.
    parts: u32,
    part_s: f64,
    /// Greatest length of a part in seconds.
    longest_s: f64,
    /// Position in full steps.
    position: f64,
    /// Speed in full steps per second.
    speed: f64,
}

impl StepMotor {
    /// Creates a motor at rest at position 0, on a reference tick of `tick_s` seconds.
    ///
    /// # Errors
    /// Returns a [`SettingError`] that names the parameter, or `tick_s`, that is out of range; or
    /// the inertia, if the rotor oscillates or slows by too much within a tick.
    pub fn new(parameters: &StepMotorParameters, tick_s: f64) -> Result<Self, SettingError> {
        parameters.ranges()?;
        check_tick(tick_s)?;
        let inertia = parameters.inertia_kg_m2;
        let per_inertia = parameters.full_steps_per_rad() / inertia;
        let damping = parameters.damping_nm_s / inertia;
        let longest_s = SWING / (parameters.natural_rad_per_s() + damping);
        let parts = (tick_s / longest_s).ceil();
        if parts > MOST_PARTS {
            let allowed = "more, or less torque and damping, or a faster clock: in a tick the rotor \
                           swings and slows by up to 20 rad";
            return Err(SettingError::value("inertia_kg_m2", inertia, allowed));
        }
        Ok(StepMotor {
            microsteps: f64::from(parameters.microsteps),
            pull: parameters.holding_torque_nm * per_inertia,
            damping,
            friction: parameters.friction_nm * per_inertia,
            parts: parts as u32,
            part_s: tick_s / parts,
            longest_s,
            position: 0.0,
            speed: 0.0,
        })
    }

    /// Advances one tick, with the driver at `commanded`, in its steps.
    pub fn step(&mut self, commanded: i64) {
        self.go_on(commanded, self.parts, self.part_s);
    }

    /// Advances until the motor is at rest, with the driver at `commanded`: at most 200 free
    /// oscillations.
    pub fn settle(&mut self, commanded: i64) {
        let parts = (SWINGS * TAU / SWING) as u32;
        self.go_on(commanded, parts, self.longest_s);
    }

    /// Advances by `parts` parts of `seconds` seconds each.
    fn go_on(&mut self, commanded: i64, parts: u32, seconds: f64) {
        let field = commanded as f64 / self.microsteps;
        for _ in 0..parts {
            let pull = self.pull * (FRAC_PI_2 * (field - self.position)).sin();
            let free = self.speed + (pull - self.damping * self.speed) * seconds;
            // Friction takes at most the speed that stops it.
            let taken = (self.friction * seconds).min(free.abs());
            self.speed = free - taken.copysign(free);
            self.position += self.speed * seconds;
        }
    }

    /// Returns the position in driver steps.
    #[must_use]
    pub fn position_steps(&self) -> f64 {
        self.position * self.microsteps
    }

    /// Returns the speed in driver steps per second.
    #[must_use]
    pub fn speed_steps_per_s(&self) -> f64 {
        self.speed * self.microsteps
    }

    /// Returns the lead of the field over the rotor, in full steps.
    #[must_use]
    pub fn off_full_steps(&self, commanded: i64) -> f64 {
        commanded as f64 / self.microsteps - self.position
    }

    /// Returns the number of driver steps by which the nearest tooth is behind the one at which
    /// the rotor began: a multiple of four full steps.
    #[must_use]
    pub fn lost_steps(&self, commanded: i64) -> i64 {
        let teeth = (self.off_full_steps(commanded) / TOOTH).round();
        (teeth * TOOTH * self.microsteps) as i64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TICK_S: f64 = 1e-5;

    fn ideal() -> StepMotorParameters {
        StepMotorParameters {
            damping_nm_s: 0.0,
            friction_nm: 0.0,
            ..StepMotorParameters::default()
        }
    }

    fn motor(parameters: &StepMotorParameters) -> StepMotor {
        StepMotor::new(parameters, TICK_S).unwrap()
    }

    #[test]
    fn a_small_swing_has_the_natural_frequency() {
        for inertia_kg_m2 in [5e-5, 2e-4] {
            let parameters = StepMotorParameters {
                inertia_kg_m2,
                microsteps: 64,
                ..ideal()
            };
            let mut motor = motor(&parameters);
            // One microstep: oscillates from 0 to 2 and is at 1 in every half period.
            let period = TAU / parameters.natural_rad_per_s();
            let (mut crossings, mut before, mut last) = (0u32, 0.0, 0);
            for tick in 1..=100_000u32 {
                motor.step(1);
                let now = motor.position_steps();
                assert!(now > -1e-2 && now < 2.01, "{now}");
                if (before < 1.0) != (now < 1.0) {
                    (crossings, last) = (crossings + 1, tick);
                }
                before = now;
            }
            // The first is after a quarter period.
            let measured = f64::from(last) * TICK_S / (f64::from(crossings) / 2.0 - 0.25);
            assert!(
                (measured / period - 1.0).abs() < 2e-3,
                "{measured} {period}"
            );
        }
    }

    /// Returns the lost steps of a field that starts at once, at `rate` full steps per second.
    fn started(parameters: &StepMotorParameters, rate: f64) -> i64 {
        let mut motor = motor(parameters);
        let per_tick = rate * f64::from(parameters.microsteps) * TICK_S;
        let command = |tick: u32| (f64::from(tick) * per_tick) as i64;
        for tick in 0..20_000 {
            motor.step(command(tick));
        }
        let lost = motor.lost_steps(command(20_000));
        assert_eq!(lost % (4 * i64::from(parameters.microsteps)), 0);
        lost
    }

    #[test]
    fn it_starts_up_to_the_rate_at_which_a_pendulum_does_not_turn_over() {
        let parameters = StepMotorParameters {
            microsteps: 256,
            ..ideal()
        };
        // Relative to the field the rotor is a driven pendulum: electrically at most 2ω0.
        let most = 2.0 * parameters.natural_rad_per_s() / FRAC_PI_2;
        assert_eq!(started(&parameters, 0.98 * most), 0);
        assert!(started(&parameters, 1.02 * most) > 0);
        assert_eq!(started(&parameters, -0.98 * most), 0);
        assert!(started(&parameters, -1.02 * most) < 0);
    }

    #[test]
    fn in_motion_it_lags_by_what_friction_and_damping_take() {
        let parameters = StepMotorParameters {
            microsteps: 256,
            friction_nm: 0.3,
            damping_nm_s: 5e-3,
            ..ideal()
        };
        let mut motor = motor(&parameters);
        let rate = 400.0;
        let command = |tick: u32| (f64::from(tick) * TICK_S * rate * 256.0) as i64;
        for tick in 0..100_000 {
            motor.step(command(tick));
        }
        let taken = 0.3 + 5e-3 * rate / parameters.full_steps_per_rad();
        let lag = taken.asin() / FRAC_PI_2;
        let off = motor.off_full_steps(command(100_000));
        assert!((off - lag).abs() < 0.01, "{off} {lag}");
        assert!((motor.speed_steps_per_s() / 256.0 - rate).abs() < 2.0);
        // Stops where friction holds it, behind its field by no more.
        for _ in 0..100_000 {
            motor.step(command(100_000));
        }
        let rest = motor.off_full_steps(command(100_000)).abs();
        assert!(rest <= 0.3f64.asin() / FRAC_PI_2, "{rest}");
        assert_eq!(motor.speed_steps_per_s().to_bits(), 0);
    }

    #[test]
    fn a_step_that_it_does_not_follow_is_lost_by_the_tooth() {
        for (commanded, lost) in [(1, 0), (-1, 0), (3, 4), (5, 4), (-3, -4)] {
            let mut motor = motor(&StepMotorParameters::default());
            assert_eq!(motor.lost_steps(commanded), lost, "{commanded}");
            let mut settled = motor.clone();
            settled.settle(commanded);
            for _ in 0..100_000 {
                motor.step(commanded);
            }
            let apart = settled.position_steps() - motor.position_steps();
            assert!(apart.abs() < 0.02, "{commanded}: {apart}");
            // Friction holds it up to 0.02 steps off.
            let at = motor.position_steps() - (commanded - lost) as f64;
            assert!(at.abs() < 0.03, "{commanded}: {at}");
            assert_eq!(motor.lost_steps(commanded), lost, "{commanded}");
        }
    }

    #[test]
    fn figures_out_of_range_are_refused() {
        let good = StepMotorParameters::default();
        assert!(StepMotor::new(&good, TICK_S).is_ok());
        let bad = [
            (
                "holding_torque_nm",
                StepMotorParameters {
                    holding_torque_nm: 0.0,
                    ..good
                },
            ),
            (
                "inertia_kg_m2",
                StepMotorParameters {
                    inertia_kg_m2: f64::NAN,
                    ..good
                },
            ),
            (
                "damping_nm_s",
                StepMotorParameters {
                    damping_nm_s: -1.0,
                    ..good
                },
            ),
            (
                "friction_nm",
                StepMotorParameters {
                    friction_nm: -1.0,
                    ..good
                },
            ),
            (
                "full_steps_per_rev",
                StepMotorParameters {
                    full_steps_per_rev: 3,
                    ..good
                },
            ),
            (
                "microsteps",
                StepMotorParameters {
                    microsteps: 0,
                    ..good
                },
            ),
        ];
        for (field, parameters) in bad {
            let error = StepMotor::new(&parameters, TICK_S).unwrap_err().to_string();
            assert!(error.contains(field), "{error}");
        }
        // ω0 is 1000 rad/s: 20 rad take 20 ms, or 10 ms for a motor that is twice as fast.
        assert!(StepMotor::new(&ideal(), 0.0199).is_ok());
        let quick = StepMotorParameters {
            inertia_kg_m2: ideal().inertia_kg_m2 / 4.0,
            ..ideal()
        };
        assert!(StepMotor::new(&quick, 0.0099).is_ok());
        let error = StepMotor::new(&quick, 0.0101).unwrap_err().to_string();
        assert!(
            error.contains("inertia_kg_m2: is 0.0000125; allowed: more"),
            "{error}"
        );
    }
}
