//! Position loops as circuits around behavioural servo axes, tick by tick: what they settle at, how
//! far they lag behind, and what two of them make of a line.

use motion_rtl::circuits::linear_interpolator::PositionLoop;
use motion_rtl::circuits::linear_interpolator::position_loop::In;
use motion_rtl::plant::{ServoAxis, ServoParameters};
use motion_rtl::sim::Simulator;
use motion_rtl::trace::LastTicks;
use proptest::prelude::*;

/// 200 kHz.
const TICK_S: f64 = 5e-6;
/// Greatest word of the D/A converter.
const FULL: i64 = 32_767;
/// A scan of 1 ms.
const SCAN: u64 = 200;

/// Nets in the tick of a scan.
#[derive(Debug, Clone, Copy)]
struct Seen {
    deviation: i64,
    in_position: bool,
    /// Word of the D/A converter until this scan.
    speed_ref: i64,
    saturated: bool,
    lost: bool,
}

/// One axis: the circuit and its plant.
struct Axis {
    simulator: Simulator<PositionLoop>,
    servo: ServoAxis,
    levels: (bool, bool),
    gain: u64,
    scan_ticks: u64,
}

impl Axis {
    fn new(parameters: &ServoParameters, gain: u64, scan_ticks: u64) -> Self {
        let servo = ServoAxis::new(parameters, TICK_S).expect("they are in range");
        Axis {
            simulator: LastTicks::simulator(&PositionLoop::default()).unwrap(),
            levels: servo.channels(),
            servo,
            gain,
            scan_ticks,
        }
    }

    fn tick(&mut self, scan: bool, command: i64) -> Seen {
        let (a, b) = self.levels;
        let i = In {
            scan,
            command,
            a,
            b,
            clear: false,
            gain: self.gain,
            window: 0,
        };
        let seen = self
            .simulator
            .step_with(&i, |now| Seen {
                deviation: now.w.deviation,
                in_position: now.w.in_position,
                speed_ref: now.w.speed_ref,
                saturated: now.w.saturated,
                lost: now.w.lost,
            })
            .unwrap();
        self.levels = self.servo.step(seen.speed_ref, FULL);
        seen
    }

    /// A scan and the ticks up to the next.
    fn scan(&mut self, command: i64) -> Seen {
        let seen = self.tick(true, command);
        for _ in 1..self.scan_ticks {
            self.tick(false, command);
        }
        seen
    }
}

/// Kp in 1/s of a gain word.
fn kp_of(parameters: &ServoParameters, word: u64) -> f64 {
    word as f64 / 256.0 * parameters.rated_counts_per_s() / FULL as f64
}

/// The gain word for Kp in 1/s, and the Kp that it has.
fn gain(parameters: &ServoParameters, kp: f64) -> (u64, f64) {
    let word = (kp / kp_of(parameters, 1)).round() as u64;
    assert!((1..65536).contains(&word), "a gain of {word}");
    (word, kp_of(parameters, word))
}

/// The greatest Kp at which the loop is taken to settle; see the note.
fn bound(parameters: &ServoParameters, scan_s: f64) -> f64 {
    0.25 / (parameters.velocity_loop_s + 1.5 * scan_s)
}

/// Moves an axis to a target, where it is to rest without an error after that time.
fn settles(axis: &mut Axis, target: i64, seconds: f64) -> Result<(), String> {
    let scans = (seconds / TICK_S / axis.scan_ticks as f64) as u64;
    for scan in 0..scans + 50 {
        let seen = axis.scan(target);
        let there = seen.deviation == 0 && seen.speed_ref == 0 && seen.in_position;
        if seen.lost || scan >= scans && !there {
            return Err(format!("scan {scan} of {scans}: {seen:?}"));
        }
    }
    match (axis.servo.position_counts() - target as f64).abs() <= 0.5 {
        true => Ok(()),
        false => Err(format!("at {}", axis.servo.position_counts())),
    }
}

proptest! {
    // A run takes a while, so what is found is not shrunk for long.
    #![proptest_config(ProptestConfig { cases: 60, max_shrink_iters: 20, ..ProptestConfig::default() })]

    /// One count of deviation gives at least half an LSB, there is no friction, Kp is within the
    /// bound, and neither torque nor speed comes to its limit.
    #[test]
    fn a_step_settles_at_no_error(
        velocity_loop_s in 1e-3..8e-3,
        scan_ticks in 100..400u64,
        share in 0.2..1.0,
        rated_speed_rad_per_s in 150.0..600.0,
        size in -1.0..1.0f64,
    ) {
        let parameters = ServoParameters {
            velocity_loop_s,
            rated_speed_rad_per_s,
            ..ServoParameters::default()
        };
        let (word, kp) = gain(&parameters, share * bound(&parameters, scan_ticks as f64 * TICK_S));
        prop_assume!(word >= 128);
        let fastest = parameters.max_torque_nm / parameters.inertia_kg_m2 * velocity_loop_s
            * parameters.counts_per_rad();
        let greatest = parameters.rated_counts_per_s().min(fastest) / kp;
        let target = (size * greatest) as i64;
        let seconds = (greatest.ln() + 4.0) / kp + 10.0 * velocity_loop_s;
        let mut axis = Axis::new(&parameters, word, scan_ticks);
        let settled = settles(&mut axis, target, seconds);
        assert!(settled.is_ok(), "Kp {kp}, to {target}: {settled:?}");
    }
}

#[test]
#[ignore = "takes long"]
fn steps_of_a_few_counts_settle_too() {
    for velocity_loop_s in [0.001, 0.005] {
        let parameters = ServoParameters {
            velocity_loop_s,
            ..ServoParameters::default()
        };
        let (word, _) = gain(&parameters, bound(&parameters, SCAN as f64 * TICK_S));
        for word in [word, 128, 129, 200, 383] {
            for target in [-3, -2, -1, 1, 2, 3, 17] {
                let seconds = 4.0 / kp_of(&parameters, word) + 0.1;
                let mut axis = Axis::new(&parameters, word, SCAN);
                settles(&mut axis, target, seconds)
                    .unwrap_or_else(|error| panic!("{word} to {target}: {error}"));
            }
        }
    }
}

#[test]
fn beyond_the_limit_of_stability_it_swings() {
    let parameters = ServoParameters::default();
    // With a scan of 20 ms the phase lag is a half turn at 107 rad/s, where Kp is 122.
    let (scan_ticks, kp) = (4000, 160.0);
    let (word, _) = gain(&parameters, kp);
    let mut axis = Axis::new(&parameters, word, scan_ticks);
    assert!(settles(&mut axis, 100, 5.0).is_err());
    let (word, _) = gain(&parameters, bound(&parameters, 0.02));
    let mut axis = Axis::new(&parameters, word, scan_ticks);
    settles(&mut axis, 100, 5.0).expect("within the bound");
}

/// A ramp of so many counts a second in the scan of that number.
fn ramp(speed: f64, scan: u64) -> i64 {
    (speed * scan as f64 * SCAN as f64 * TICK_S).round() as i64
}

#[test]
fn a_ramp_is_followed_at_the_distance_of_speed_over_gain() {
    let parameters = ServoParameters::default();
    for (speed, kp) in [(20_000.0, 20.0), (-60_000.0, 35.0), (90_000.0, 30.0)] {
        let (word, kp) = gain(&parameters, kp);
        assert!(kp <= bound(&parameters, SCAN as f64 * TICK_S));
        let mut axis = Axis::new(&parameters, word, SCAN);
        let mut sum = 0;
        for scan in 0..1200 {
            let seen = axis.scan(ramp(speed, scan));
            sum += if scan < 800 { 0 } else { seen.deviation };
            assert!(!seen.lost && !seen.saturated);
        }
        let (mean, law) = (sum as f64 / 400.0, speed / kp);
        assert!((mean / law - 1.0).abs() < 0.01, "{mean}, not {law}");
    }
}

/// Steady contour error in counts of a line at `angle` degrees with a feed in counts a second, by
/// both axes' gains: positive where the path runs to the left of the line. And its law.
fn contour_error(angle: f64, feed: f64, kps: [f64; 2]) -> (f64, f64) {
    let parameters = [
        ServoParameters::default(),
        ServoParameters {
            velocity_loop_s: 0.003,
            inertia_kg_m2: 2e-4,
            ..ServoParameters::default()
        },
    ];
    let (sin, cos) = angle.to_radians().sin_cos();
    let gains: [_; 2] = std::array::from_fn(|axis| gain(&parameters[axis], kps[axis]));
    let mut axes: [_; 2] =
        std::array::from_fn(|axis| Axis::new(&parameters[axis], gains[axis].0, SCAN));
    let (settle, measure) = (800, 300);
    let mut sum = 0.0;
    for scan in 0..settle + measure {
        for (axis, part) in axes.iter_mut().zip([cos, sin]) {
            let seen = axis.scan(ramp(feed * part, scan));
            assert!(!seen.lost && !seen.saturated);
        }
        if scan >= settle {
            let [x, y] = axes.each_ref().map(|axis| axis.servo.position_counts());
            sum += y * cos - x * sin;
        }
    }
    let [kp_x, kp_y] = gains.map(|(_, kp)| kp);
    // Each axis lags by its speed over its gain, which puts the path to the left of the line by
    // e_x sin α − e_y cos α.
    let law = feed * sin * cos * (1.0 / kp_x - 1.0 / kp_y);
    (sum / measure as f64, law)
}

#[test]
#[ignore = "takes long"]
fn unequal_gains_shift_a_line_by_the_law_of_the_contour_error() {
    for kps in [[30.0, 38.0], [36.0, 24.0], [20.0, 38.0]] {
        for angle in [12.0, 30.0, 45.0, 63.0, 80.0, 135.0, -150.0] {
            let (error, law) = contour_error(angle, 80_000.0, kps);
            assert!(law.abs() > 90.0, "{law} is little");
            let off = error / law - 1.0;
            assert!(off.abs() < 0.01, "{kps:?} at {angle}: {error}, not {law}");
        }
    }
}

#[test]
fn equal_gains_keep_a_line_whatever_the_velocity_loops() {
    for angle in [20.0, 45.0, 110.0] {
        let (error, _) = contour_error(angle, 80_000.0, [30.0, 30.0]);
        assert!(error.abs() < 0.5, "{angle}: {error}");
    }
}

#[test]
fn the_torque_limit_limits_the_acceleration() {
    let weak = ServoParameters {
        max_torque_nm: 0.5,
        ..ServoParameters::default()
    };
    let limit = weak.max_torque_nm / weak.inertia_kg_m2 * weak.counts_per_rad();
    // In a millisecond, from rest, on the way to a far target.
    for (parameters, limited) in [(weak, true), (ServoParameters::default(), false)] {
        let (word, _) = gain(&parameters, 30.0);
        let mut axis = Axis::new(&parameters, word, SCAN);
        let (mut before, mut most) = (0.0, 0.0f64);
        for _ in 0..20 {
            axis.scan(1600);
            let speed = axis.servo.speed_counts_per_s();
            most = most.max((speed - before).abs() / (SCAN as f64 * TICK_S));
            before = speed;
            assert!(axis.servo.torque_nm().abs() <= parameters.max_torque_nm);
        }
        assert_eq!(most < limit * 1.001, limited, "{most} of {limit}");
        assert!(most > limit * 0.99, "{most} of {limit}");
    }
}

#[test]
fn the_converter_saturates_at_rated_speed_and_comes_back() {
    let parameters = ServoParameters::default();
    let (word, kp) = gain(&parameters, 30.0);
    for target in [20_000, -20_000] {
        let mut axis = Axis::new(&parameters, word, SCAN);
        let mut saturated = 0;
        for _ in 0..700 {
            let seen = axis.scan(target);
            assert_eq!(seen.saturated, seen.speed_ref.abs() == FULL);
            assert!(!seen.lost);
            saturated += u64::from(seen.saturated);
            let speed = axis.servo.speed_counts_per_s().abs();
            assert!(speed <= parameters.rated_counts_per_s() * 1.000_001);
        }
        // Saturated for as long as rated speed takes to come within rated speed / Kp.
        let rated = parameters.rated_counts_per_s();
        let scans = (20_000.0 - rated / kp) / rated / (SCAN as f64 * TICK_S);
        let lag = parameters.velocity_loop_s / (SCAN as f64 * TICK_S);
        assert!((saturated as f64 - scans - lag).abs() < 5.0, "{saturated}");
        assert_eq!(axis.scan(target).deviation, 0);
    }
}

#[test]
fn an_encoder_that_is_too_fast_is_told() {
    for (counts_per_rev, too_fast) in [(3900.0, false), (4300.0, true), (8000.0, true)] {
        let parameters = ServoParameters {
            counts_per_rev,
            ..ServoParameters::default()
        };
        let (word, _) = gain(&parameters, 30.0);
        let mut axis = Axis::new(&parameters, word, SCAN);
        let countable = axis.servo.countable_counts_per_s();
        assert_eq!(parameters.rated_counts_per_s() > countable, too_fast);
        let mut lost = false;
        for _ in 0..400 {
            let before = lost;
            lost = axis.scan(40_000).lost;
            assert!(lost || !before, "it is kept");
        }
        assert_eq!(lost, too_fast, "{counts_per_rev} counts a turn");
    }
}
