//! Response of an elastic mechanism to position commands.
//!
//! The ramps of JPH0743606B2 serve the mechanism: with equal angles from the first sample on, the
//! speed along the arc jumps at start and stop, and the mechanism vibrates.

use crate::input::Point;
use crate::path::vector::{dot, sub};
use crate::settings::{Place, SettingError, settings};
use std::f64::consts::TAU;
use std::ops::RangeInclusive;

/// Allowed natural frequencies of a mechanism, in Hz.
pub const FREQUENCY_RANGE_HZ: RangeInclusive<f64> = 0.1..=1000.0;
/// Allowed damping ratios.
pub const DAMPING_RANGE: RangeInclusive<f64> = 0.0..=0.9;
/// Number of evaluations between two commands and, after the last, per period.
const LOOKS: u32 = 16;

settings! {
    /// A mass that hangs on its command by a spring and a damper, alike in x, y and z.
    #[derive(Copy)]
    pub struct Mechanism {
        /// Natural frequency.
        pub frequency_hz [required]: f64 = 1.0, in FREQUENCY_RANGE_HZ;
        /// Damping, as a part of the critical one.
        pub damping: f64 = 0.0, in DAMPING_RANGE;
    }
}

/// Vibration caused by commands.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Vibration {
    /// Greatest distance from the command until the last command, in mm.
    pub moving_mm: f64,
    /// Greatest distance from the last command on, in mm.
    pub rest_mm: f64,
}

impl Mechanism {
    /// Checks every field.
    ///
    /// # Errors
    /// Returns an error that names the first field at fault, its value and the allowed range.
    pub fn validate(&self) -> Result<(), SettingError> {
        self.ranges()
            .map_err(|error| error.at(Place::Table("mechanism")))
    }
}

/// Vibration of a mechanism under successive commands, with linear motion between two commands.
/// The mechanism is at rest before the first command; after the last one the command rests.
///
/// The deviation from the command oscillates freely, except for the commands' changes of speed,
/// which change its rate. There is no integration error; the only error is evaluation at 16 times
/// between two commands.
#[derive(Debug)]
pub struct Vibrating {
    sample_s: f64,
    /// Steps between evaluations: between two commands, and after the last.
    moving: Free,
    resting: Free,
    last: Option<Point>,
    speed: Point,
    swing: Swing,
    moving_mm: f64,
}

impl Vibrating {
    /// Creates a vibration whose commands in mm come `sample_s` seconds apart.
    #[must_use]
    pub fn new(mechanism: &Mechanism, sample_s: f64) -> Self {
        let looks = f64::from(LOOKS);
        Vibrating {
            sample_s,
            moving: Free::new(mechanism, sample_s / looks),
            resting: Free::new(mechanism, 1.0 / mechanism.frequency_hz / looks),
            last: None,
            speed: [0.0; 3],
            swing: Swing::default(),
            moving_mm: 0.0,
        }
    }

    /// Adds the next command.
    pub fn take(&mut self, point: Point) {
        if let Some(last) = self.last.replace(point) {
            let next = sub(point, last).map(|mm| mm / self.sample_s);
            self.swing.push(sub(self.speed, next));
            self.speed = next;
            for _ in 0..LOOKS {
                self.swing.go_on(&self.moving);
                self.moving_mm = self.moving_mm.max(self.swing.far());
            }
        }
    }

    /// Returns the vibration after the last command.
    #[must_use]
    pub fn finish(mut self) -> Vibration {
        self.swing.push(self.speed);
        let mut rest_mm = self.swing.far();
        for _ in 0..LOOKS {
            self.swing.go_on(&self.resting);
            rest_mm = rest_mm.max(self.swing.far());
        }
        Vibration {
            moving_mm: self.moving_mm,
            rest_mm,
        }
    }
}

/// Greatest change of speed from one command to the next, with rest before the first and after the
/// last.
#[derive(Debug, Default)]
pub struct SpeedChange {
    last: Option<Point>,
    step: Point,
    most: f64,
}

impl SpeedChange {
    /// Adds the next command in mm.
    pub fn take(&mut self, point: Point) {
        if let Some(last) = self.last.replace(point) {
            self.changes_to(sub(point, last));
        }
    }

    /// Returns the change in mm/s of commands that came `sample_s` seconds apart.
    #[must_use]
    pub fn finish(mut self, sample_s: f64) -> f64 {
        self.changes_to([0.0; 3]);
        self.most / sample_s
    }

    fn changes_to(&mut self, step: Point) {
        self.most = self.most.max(length(sub(step, self.step)));
        self.step = step;
    }
}

fn length(vector: Point) -> f64 {
    dot(vector, vector).sqrt()
}

/// Deviation of the mass from its command, and its rate.
#[derive(Debug, Default)]
struct Swing {
    off: Point,
    rate: Point,
}

impl Swing {
    fn push(&mut self, change: Point) {
        for (rate, change) in self.rate.iter_mut().zip(change) {
            *rate += change;
        }
    }

    fn go_on(&mut self, free: &Free) {
        for (off, rate) in self.off.iter_mut().zip(&mut self.rate) {
            let [[a, b], [c, d]] = free.0;
            (*off, *rate) = (a * *off + b * *rate, c * *off + d * *rate);
        }
    }

    fn far(&self) -> f64 {
        length(self.off)
    }
}

/// Free oscillation over a fixed time: next deviation and rate from the current ones.
#[derive(Debug)]
struct Free([[f64; 2]; 2]);

impl Free {
    fn new(mechanism: &Mechanism, seconds: f64) -> Self {
        let natural = TAU * mechanism.frequency_hz;
        let decay = mechanism.damping * natural;
        let damped = natural * (1.0 - mechanism.damping.powi(2)).sqrt();
        let (sine, cosine) = (damped * seconds).sin_cos();
        let (share, left) = (decay / damped * sine, (-decay * seconds).exp());
        Free([
            [left * (cosine + share), left * sine / damped],
            [
                -left * sine * natural * natural / damped,
                left * (cosine - share),
            ],
        ])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SAMPLE_S: f64 = 0.01;

    fn mechanism(frequency_hz: f64, damping: f64) -> Mechanism {
        Mechanism {
            frequency_hz,
            damping,
        }
    }

    fn vibration(mechanism: &Mechanism, points: &[Point]) -> Vibration {
        let mut vibrating = Vibrating::new(mechanism, SAMPLE_S);
        points.iter().for_each(|point| vibrating.take(*point));
        vibrating.finish()
    }

    fn largest_speed_change(points: &[Point]) -> f64 {
        let mut change = SpeedChange::default();
        points.iter().for_each(|point| change.take(*point));
        change.finish(SAMPLE_S)
    }

    #[track_caller]
    fn near(is: f64, wanted: f64, share: f64) {
        assert!((is - wanted).abs() <= share * wanted, "{is} for {wanted}");
    }

    /// Returns a line of 0.2 mm per sample along an axis in space.
    fn line(samples: u32) -> Vec<Point> {
        (0..=samples)
            .map(|k| [0.36, 0.48, 0.8].map(|axis| axis * 0.2 * f64::from(k)))
            .collect()
    }

    #[test]
    fn a_jump_of_speed_makes_it_swing_by_speed_over_frequency() {
        for frequency in [1.0, 3.0, 8.0] {
            let natural = TAU * frequency;
            // After whole periods the stop cancels the vibration of the start; half a period later
            // it doubles it.
            let period = (1.0 / (frequency * SAMPLE_S)).round() as u32;
            let whole = mechanism(1.0 / (f64::from(period) * SAMPLE_S), 0.0);
            let out = vibration(&whole, &line(3 * period));
            near(out.moving_mm, 20.0 / (TAU * whole.frequency_hz), 5e-3);
            assert!(out.rest_mm < 1e-9, "{out:?}");
            if period.is_multiple_of(2) {
                let double = vibration(&whole, &line(3 * period + period / 2));
                near(double.rest_mm, 40.0 / (TAU * whole.frequency_hz), 2e-2);
            }
            // In a damped mechanism the first oscillation is a quarter of a period late.
            let damping = 0.2f64;
            let damped = vibration(&mechanism(frequency, damping), &line(1000));
            let angle = damping.acos();
            let share = (-damping / (1.0 - damping * damping).sqrt() * angle).exp();
            near(damped.moving_mm, 20.0 / natural * share, 5e-3);
            // The vibration of the start has decayed: the stop causes the same.
            near(damped.rest_mm, damped.moving_mm, 2e-2);
        }
    }

    #[test]
    fn a_steady_acceleration_bends_it_by_acceleration_over_frequency_squared() {
        let parabola = |k: u32| [0.0, 0.5 * 100.0 * (f64::from(k) * SAMPLE_S).powi(2), 0.0];
        let points: Vec<Point> = (0..=400).map(parabola).collect();
        // Damped enough not to overshoot; the speed changes in steps of 1 mm/s.
        let vibration = vibration(&mechanism(2.0, 0.9), &points);
        near(vibration.moving_mm, 100.0 / (TAU * 2.0).powi(2), 2e-2);
        near(largest_speed_change(&points[..2]), 0.5, 1e-12);
        // Stops from 399.5 mm/s.
        near(largest_speed_change(&points), 399.5, 1e-9);
    }

    #[test]
    fn what_does_not_move_does_not_vibrate() {
        for points in [&[][..], &[[1.0, 2.0, 3.0]], &[[1.0, 2.0, 3.0]; 5]] {
            let still = vibration(&mechanism(5.0, 0.1), points);
            assert_eq!(still, Vibration::default());
            assert_eq!(largest_speed_change(points).to_bits(), 0);
        }
    }

    #[test]
    fn figures_out_of_range_are_refused() {
        assert!(mechanism(0.1, 0.0).validate().is_ok());
        for (wrong, text) in [
            (mechanism(0.0, 0.1), "frequency_hz"),
            (mechanism(f64::NAN, 0.1), "frequency_hz"),
            (mechanism(8.0, 1.0), "damping"),
            (mechanism(8.0, -0.1), "damping"),
        ] {
            let error = wrong.validate().unwrap_err().to_string();
            assert!(error.contains(text), "{error}");
        }
    }
}
