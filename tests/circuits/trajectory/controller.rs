//! The controller without motors: commands, responses and corrections on paths.

use super::bench::{PLANE, Path, Period, Record};
use super::point::{Segment, two_to};
use motion_rtl::circuits::trajectory_controller::vector_correction::Correction;
use std::f64::consts::TAU;

const P: usize = 47;

/// Ticks of a period: the least that are enough, plus some.
const PERIOD: u64 = 480;
/// Guard units of a count.
const UNIT: f64 = 65_536.0;

/// A phase of the profile: so many periods from (q, v) with an acceleration.
#[derive(Debug, Clone, Copy)]
struct Phase {
    periods: u64,
    length: f64,
    speed: f64,
    acceleration: f64,
    rests: bool,
}

impl Phase {
    fn words(&self) -> Record {
        let fraction = two_to(40);
        let split = |value: f64| {
            let parts = (value * fraction).round() as i128;
            let mask = (1i128 << P) - 1;
            [(parts >> 40) & mask, parts & ((1 << 40) - 1)].map(|word| word as u64)
        };
        let mut words = [0; 32];
        words[0] = 1 | u64::from(self.rests) << 2 | self.periods << 3;
        words[1] = 1 << 40;
        words[2] = self.length.round() as u64;
        let first = split(self.speed + self.acceleration / 2.0);
        words[8..10].copy_from_slice(&first);
        words[10..12].copy_from_slice(&split(self.acceleration));
        words
    }
}

/// Ramp up, cruise, ramp down, over a length; the end is told exactly.
fn trapezoid(length: u64, ramp: u64, cruise: u64) -> Vec<Phase> {
    let speed = length as f64 / (ramp + cruise) as f64;
    let acceleration = speed / ramp as f64;
    let phase = |periods, length: f64, speed, acceleration| Phase {
        periods,
        length,
        speed,
        acceleration,
        rests: false,
    };
    let ramped = speed * ramp as f64 / 2.0;
    let end = Phase {
        rests: true,
        ..phase(1, length as f64, 0.0, 0.0)
    };
    vec![
        phase(ramp, 0.0, 0.0, acceleration),
        phase(cruise, ramped, speed, 0.0),
        phase(ramp, length as f64 - ramped, speed, -acceleration),
        end,
    ]
}

fn path(segments: &[Segment]) -> Path {
    let words = |segment: &Segment| (segment.length, segment.words());
    segments.iter().map(words).collect()
}

fn run(
    segments: &[Segment],
    profile: &[Phase],
    gains: [u64; 2],
    correction: Correction,
    periods: usize,
) -> Vec<Period> {
    let profile: Vec<Record> = profile.iter().map(Phase::words).collect();
    PLANE.run(
        &path(segments),
        &profile,
        gains,
        correction,
        (PERIOD, periods),
    )
}

fn line(base: [i64; 2], direction: [f64; 2], length: u64) -> Segment {
    Segment {
        length,
        base: [base[0], base[1], 0],
        along: [direction[0], direction[1], 0.0],
        across: [0.0; 3],
        third: [0.0; 3],
        radius: None,
        powers: None,
    }
}

/// 50/s and 200/s in periods of a millisecond.
const GAINS: [u64; 2] = [1638, 6554];

/// Largest rounding error of a model's position: half a unit of acceleration every period, which
/// the model answers by 1 / (K1·K2) of it.
const ROUNDING: i64 = 50;

#[test]
fn moves_along_an_axis_are_never_corrected() {
    for (axis, sign) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)] {
        let mut direction = [0.0, 0.0];
        direction[axis] = sign;
        let length = 30_000_123;
        let path = [line([0, 0], direction, length)];
        let profile = trapezoid(length, 40, 30);
        // With K2 < 4·K1 the tangential response overshoots the end, and is held there.
        for gains in [GAINS, [1638, 3_000]] {
            let mut overshoot = 0;
            for period in run(&path, &profile, gains, Correction::Vector, 300) {
                let beyond = (period.answered - length as i64).max(0);
                overshoot = overshoot.max(beyond);
                let mut correction = [0, 0];
                correction[axis] = -beyond * sign as i64;
                assert_eq!(period.correction, correction, "{period:?}");
                let corrected = [0, 1].map(|k| period.command[k] + correction[k]);
                assert_eq!(period.corrected, corrected);
                assert_eq!(period.command[axis], sign as i64 * period.length);
                assert_eq!(period.response[axis], sign as i64 * period.answered);
            }
            match gains == GAINS {
                true => assert!(overshoot <= ROUNDING, "{overshoot}"),
                false => assert!(overshoot > 100 * ROUNDING, "{overshoot}"),
            }
        }
    }
}

#[test]
#[ignore = "takes long"]
fn any_straight_path_is_corrected_by_its_rounding_alone() {
    for turn in 0..12 {
        let (sin, cos) = (0.3 + TAU * f64::from(turn) / 12.0).sin_cos();
        let length = 20_000_000 + turn as u64 * 777_777;
        let path = [line([0, 0], [cos, sin], length)];
        let seen = run(
            &path,
            &trapezoid(length, 40, 30),
            GAINS,
            Correction::Vector,
            250,
        );
        for period in &seen {
            // Two models, and the points' own rounding.
            let bound = 2 * ROUNDING + 2;
            let small = period.correction.iter().all(|error| error.abs() <= bound);
            assert!(small, "{period:?}");
        }
        let last = seen.last().expect("periods");
        assert_eq!(last.length, length as i64);
        let exact = [cos, sin].map(|part| part * length as f64);
        for (axis, exact) in exact.into_iter().enumerate() {
            assert!((last.command[axis] as f64 - exact).abs() <= 1.0);
            // The models come to rest within their rounding of the target.
            let rest = last.response[axis] - last.command[axis];
            assert!(rest.abs() <= ROUNDING, "{rest}");
        }
    }
}

/// Mean distance of the servo's models from a circle of 10 mm in its steady part, in mm, at 10 rad/s
/// with K1 = 50/s and K2 = 200/s, in periods of so many milliseconds.
fn contour_error(correction: Correction, period_ms: f64) -> f64 {
    // A count is a micrometre. The circle begins at the origin.
    let radius = 10_000.0 * UNIT;
    let length = (2.0 * TAU * radius) as u64;
    let path = [Segment {
        length,
        base: [-(radius as i64), 0, 0],
        along: [1.0, 0.0, 0.0],
        across: [0.0, 1.0, 0.0],
        third: [0.0; 3],
        radius: Some(radius),
        powers: None,
    }];
    let (ramp, settled, looked_at) = (0.1, 0.4, 0.05);
    let periods = |seconds: f64| (seconds * 1e3 / period_ms).round() as u64;
    let cruise = periods(length as f64 / (100_000.0 * UNIT) - ramp);
    let gains = [50.0, 200.0].map(|gain| (gain * period_ms / 1e3 * two_to(15)).round() as u64);
    let first = periods(settled) as usize;
    let last = first + periods(looked_at) as usize;
    let profile = trapezoid(length, periods(ramp), cruise);
    let seen = run(&path, &profile, gains, correction, last);
    let errors = seen[first..].iter().map(|period| {
        let [x, y] = [0, 1].map(|axis| period.model[axis] as f64);
        (radius - (x + radius).hypot(y)) / UNIT / 1000.0
    });
    errors.sum::<f64>() / (last - first) as f64
}

type Complex = [f64; 2];

fn times([a, b]: Complex, [c, d]: Complex) -> Complex {
    [a * c - b * d, a * d + b * c]
}

fn over(numerator: f64, [re, im]: Complex) -> Complex {
    let square = re * re + im * im;
    [numerator * re / square, -numerator * im / square]
}

/// Values of r(1 − |G|) and r|1 − |G(1 + e^(−jωτ) − G)|| for a response and a lag.
fn closed_forms(response: Complex, lag: f64) -> [f64; 2] {
    let size = |[re, im]: Complex| re.hypot(im);
    let sum = [1.0 + lag.cos() - response[0], -lag.sin() - response[1]];
    let corrected = size(times(response, sum));
    [
        10.0 * (1.0 - size(response)),
        10.0 * (1.0 - corrected).abs(),
    ]
}

#[track_caller]
fn close(seen: f64, expected: f64, part: f64) {
    assert!(
        (seen.abs() / expected - 1.0).abs() < part,
        "{seen}, not {expected}"
    );
}

/// The steps of the models are not small beside their gains: what is periodic with them has their
/// own closed form, of z = e^(jωΔt). A response stands in the period of its command.
#[test]
fn a_circle_shrinks_as_the_steps_of_the_models_say() {
    let (k1, k2, turn) = (0.05, 0.2, 0.01f64);
    let z = [turn.cos(), turn.sin()];
    let step = [z[0] - 1.0, z[1]];
    let square = times(step, step);
    let response = over(
        k1 * k2,
        [square[0] + k2 * step[0] + k1 * k2, square[1] + k2 * step[1]],
    );
    let response = times(z, response);
    let [plain, corrected] = closed_forms(response, turn * (1.0 / k1 - 1.0));
    close(contour_error(Correction::None, 1.0), plain, 0.005);
    close(contour_error(Correction::Vector, 1.0), corrected, 0.02);
}

#[test]
#[ignore = "takes long"]
fn in_short_periods_a_circle_shrinks_as_the_continuous_forms_say() {
    let (k1, k2, omega) = (50.0, 200.0, 10.0);
    let response = over(k1 * k2, [k1 * k2 - omega * omega, k2 * omega]);
    let [plain, corrected] = closed_forms(response, omega / k1);
    close(contour_error(Correction::None, 0.1), plain, 0.02);
    close(contour_error(Correction::Vector, 0.05), corrected, 0.02);
}
