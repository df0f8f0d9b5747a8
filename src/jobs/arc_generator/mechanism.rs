//! What position commands make of an elastic mechanism.
//!
//! JPH0743606B2 has ramps for its sake: where the angle grows by the same from the first sample on,
//! the speed along the arc jumps at start and stop, and the mechanism vibrates.

use crate::input::Point;
use crate::path::vector::{dot, sub};
use crate::settings::{Place, SettingError, within};
use std::f64::consts::TAU;
use std::ops::RangeInclusive;

/// Natural frequencies that a mechanism may have, in Hz.
pub const FREQUENCY_RANGE_HZ: RangeInclusive<f64> = 0.1..=1000.0;
/// Dampings that it may have, as a share of the critical one.
pub const DAMPING_RANGE: RangeInclusive<f64> = 0.0..=0.9;
/// How often it is looked at between two commands, and after the last in each of its periods.
const LOOKS: u32 = 16;

/// A mass that hangs on its command by a spring and a damper, alike in x, y and z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mechanism {
    /// Its natural frequency.
    pub frequency_hz: f64,
    /// Its damping, as a share of the critical one.
    pub damping: f64,
}

/// What commands make of it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Vibration {
    /// How far it is from its command at most, in mm, until the last command.
    pub moving_mm: f64,
    /// The same from then on.
    pub rest_mm: f64,
}

impl Mechanism {
    /// Checks its figures.
    ///
    /// # Errors
    /// Names the first field at fault, its value and what is allowed.
    pub fn validate(&self) -> Result<(), SettingError> {
        within("frequency_hz", self.frequency_hz, &FREQUENCY_RANGE_HZ)
            .and_then(|()| within("damping", self.damping, &DAMPING_RANGE))
            .map_err(|error| error.at(Place::Table("mechanism")))
    }

    /// How it vibrates under commands in mm, `sample_s` seconds from one to the next, on a line
    /// between two; before the first it is at rest, after the last its command is.
    ///
    /// What it is off its command by swings freely but for the commands' changes of speed, by which
    /// its own speed changes: no integration, and no error but that it is looked at 16 times between
    /// two commands.
    #[must_use]
    pub fn vibration(&self, points: &[Point], sample_s: f64) -> Vibration {
        let free = |seconds| Free::new(self, seconds);
        let (step, turn) = (
            free(sample_s / f64::from(LOOKS)),
            free(1.0 / self.frequency_hz / f64::from(LOOKS)),
        );
        let mut swing = Swing::default();
        let (mut speed, mut vibration) = ([0.0; 3], Vibration::default());
        for pair in points.windows(2) {
            let next = sub(pair[1], pair[0]).map(|mm| mm / sample_s);
            swing.push(sub(speed, next));
            speed = next;
            for _ in 0..LOOKS {
                swing.go_on(&step);
                vibration.moving_mm = vibration.moving_mm.max(swing.far());
            }
        }
        swing.push(speed);
        vibration.rest_mm = swing.far();
        for _ in 0..LOOKS {
            swing.go_on(&turn);
            vibration.rest_mm = vibration.rest_mm.max(swing.far());
        }
        vibration
    }
}

/// The largest change of speed from one sample to the next, in mm/s: at rest before the first command
/// and after the last.
#[must_use]
pub fn largest_speed_change(points: &[Point], sample_s: f64) -> f64 {
    let (mut last, mut most) = ([0.0; 3], 0f64);
    let steps = points.windows(2).map(|pair| sub(pair[1], pair[0]));
    for step in steps.chain([[0.0; 3]]) {
        most = most.max(length(sub(step, last)));
        last = step;
    }
    most / sample_s
}

fn length(vector: Point) -> f64 {
    dot(vector, vector).sqrt()
}

/// By how much the mass is off its command, and how fast that grows.
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

/// How the mass swings in so many seconds: off and rate of then from those of now.
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

    #[track_caller]
    fn near(is: f64, wanted: f64, share: f64) {
        assert!((is - wanted).abs() <= share * wanted, "{is} for {wanted}");
    }

    /// 0.2 mm a sample along an axis in space.
    fn line(samples: u32) -> Vec<Point> {
        (0..=samples)
            .map(|k| [0.36, 0.48, 0.8].map(|axis| axis * 0.2 * f64::from(k)))
            .collect()
    }

    #[test]
    fn a_jump_of_speed_makes_it_swing_by_speed_over_frequency() {
        for frequency in [1.0, 3.0, 8.0] {
            let natural = TAU * frequency;
            // Whole periods later the stop takes out what the start has made; half a period more,
            // and it doubles it.
            let period = (1.0 / (frequency * SAMPLE_S)).round() as u32;
            let whole = mechanism(1.0 / (f64::from(period) * SAMPLE_S), 0.0);
            let out = whole.vibration(&line(3 * period), SAMPLE_S);
            near(out.moving_mm, 20.0 / (TAU * whole.frequency_hz), 5e-3);
            assert!(out.rest_mm < 1e-9, "{out:?}");
            if period.is_multiple_of(2) {
                let double = whole.vibration(&line(3 * period + period / 2), SAMPLE_S);
                near(double.rest_mm, 40.0 / (TAU * whole.frequency_hz), 2e-2);
            }
            // In a damped one the first swing is a quarter of a period late.
            let damping = 0.2f64;
            let damped = mechanism(frequency, damping).vibration(&line(1000), SAMPLE_S);
            let angle = damping.acos();
            let share = (-damping / (1.0 - damping * damping).sqrt() * angle).exp();
            near(damped.moving_mm, 20.0 / natural * share, 5e-3);
            // What the start has made is gone: the stop makes the same.
            near(damped.rest_mm, damped.moving_mm, 2e-2);
        }
    }

    #[test]
    fn a_steady_acceleration_bends_it_by_acceleration_over_frequency_squared() {
        let parabola = |k: u32| [0.0, 0.5 * 100.0 * (f64::from(k) * SAMPLE_S).powi(2), 0.0];
        let points: Vec<Point> = (0..=400).map(parabola).collect();
        // Damped so far that it does not swing over; the speed changes in steps of 1 mm/s.
        let vibration = mechanism(2.0, 0.9).vibration(&points, SAMPLE_S);
        near(vibration.moving_mm, 100.0 / (TAU * 2.0).powi(2), 2e-2);
        near(largest_speed_change(&points[..2], SAMPLE_S), 0.5, 1e-12);
        // It stops from 399.5 mm/s.
        near(largest_speed_change(&points, SAMPLE_S), 399.5, 1e-9);
    }

    #[test]
    fn what_does_not_move_does_not_vibrate() {
        for points in [&[][..], &[[1.0, 2.0, 3.0]], &[[1.0, 2.0, 3.0]; 5]] {
            let vibration = mechanism(5.0, 0.1).vibration(points, SAMPLE_S);
            assert_eq!(vibration, Vibration::default());
            assert_eq!(largest_speed_change(points, SAMPLE_S).to_bits(), 0);
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
