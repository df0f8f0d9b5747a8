//! Gains of a servo control as words, from the parameters of its axis.

use super::settings::Settings;
use crate::circuits::trajectory_controller::Widths;
use crate::plant::{TwoMassAxis, TwoMassParameters};
use crate::settings::{Place, SettingError, within};
use std::f64::consts::TAU;
use std::ops::RangeInclusive;

/// Allowed gains and bandwidths in 1/s and Hz.
pub const RATE_RANGE: RangeInclusive<f64> = 1e-6..=1e9;

/// Allowed integral times in ms; 0 for no integral.
pub const INTEGRAL_RANGE_MS: RangeInclusive<f64> = 0.0..=1e9;

/// Allowed factors of the inertia in the feed-forward.
pub const INERTIA_FACTOR_RANGE: RangeInclusive<f64> = 0.0..=100.0;

/// Words of servo control 11 of one axis.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct ServoGains {
    /// Gain of position control 27: parts of 2^-(G - 1) per period.
    pub position: u64,
    /// Gain of speed control 29: torque per guard unit per period.
    pub speed: u64,
    /// Integral gain of speed control 29: torque per guard unit per period, per period.
    pub integral: u64,
    /// Gain of feed-forward 30: torque per guard unit per period squared.
    pub inertia: u64,
    /// Greatest torque.
    pub limit: u64,
}

impl ServoGains {
    /// Returns the gains for an axis by its index; faults of the axis name the row `axis`.
    ///
    /// With J = J_motor + J_load the speed control has Kp = J·2πf and an integral of Kp/Ti, and
    /// the feed-forward uses the configured factor of J.
    ///
    /// # Errors
    /// Returns an error for a setting or a parameter of the axis that is out of range or gives a
    /// gain that does not fit its word, and for an axis that is too fast for the clock.
    pub fn of(
        settings: &Settings,
        index: usize,
        axis: &TwoMassParameters,
        widths: &Widths,
    ) -> Result<Self, SettingError> {
        let period = settings.period_s(widths)?;
        let of_axis = |error: SettingError| error.at(Place::Row("axis", index));
        axis.ranges().map_err(of_axis)?;
        let (hz, longest_s) = (settings.clock_hz, axis.longest_tick_s());
        let tick_s = 1.0 / hz as f64;
        if tick_s > longest_s {
            let value = format!("{hz}: a tick of {tick_s:e} s");
            let allowed = format!("a faster clock: a tick of at most {longest_s:e} s");
            return Err(SettingError::value("clock_hz", value, allowed));
        }
        let (rate, hz) = (settings.position_gain_per_s, settings.speed_hz);
        within("position_gain_per_s", rate, &RATE_RANGE)?;
        within("speed_hz", hz, &RATE_RANGE)?;
        within("integral_ms", settings.integral_ms, &INTEGRAL_RANGE_MS)?;
        let told = &settings.inertia_factor;
        let factor = told.of(index);
        within("inertia_factor", factor, &INERTIA_FACTOR_RANGE)
            .map_err(|error| told.fault(index, error))?;
        let inertia = axis.motor_inertia_kg_m2 + axis.load_inertia_kg_m2;
        let full_scale = TwoMassAxis::FULL_SCALE as f64;
        let units_per_rad = axis.counts_per_rad() * (widths.guard() as f64).exp2();
        // Torque word per 1 N·m and per guard unit of angle.
        let torque = full_scale / axis.max_torque_nm / units_per_rad;
        let fine = (widths.torque_fraction() as f64).exp2();
        let speed = inertia * TAU * hz * torque / period * fine;
        let integral = match settings.integral_ms > 0.0 {
            true => speed * period / (settings.integral_ms / 1e3),
            false => 0.0,
        };
        let most = (1u64 << widths.servo_gain) - 1;
        let word = |field, value: f64, exact: f64, grows: bool| {
            // Written so that NaN fails.
            if exact >= 0.5 && exact.round() <= most as f64 {
                return Ok(exact.round() as u64);
            }
            // Values of the least and the greatest word, a thousandth inside.
            let ends = match grows {
                true => [value / exact, value / exact * most as f64],
                false => [value * exact / most as f64, value * exact],
            };
            let allowed = format!("{} to {}", short(ends[0] * 1.001), short(ends[1] * 0.999));
            let exact = short(exact);
            let problem = match exact < 1.0 {
                true => format!("is {value}: its gain word is {exact}, which rounds to 0"),
                false => format!("is {value}: its gain word is {exact}, above {most}"),
            };
            Err(SettingError::new(field, problem, allowed))
        };
        let one = ((widths.servo_gain - 1) as f64).exp2();
        let (torque_nm, inertia) = (axis.max_torque_nm, inertia * torque / (period * period));
        let told = inertia * factor;
        Ok(ServoGains {
            position: word("position_gain_per_s", rate, rate * period * one, true)?,
            speed: word("speed_hz", hz, speed, true)?,
            integral: match integral > 0.0 {
                true => word("integral_ms", settings.integral_ms, integral, false)?,
                false => 0,
            },
            inertia: match factor > 0.0 {
                true => word("max_torque_nm", torque_nm, told * fine, false).map_err(of_axis)?,
                false => 0,
            },
            limit: full_scale as u64,
        })
    }
}

/// Rounds a number to four digits.
fn short(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}
