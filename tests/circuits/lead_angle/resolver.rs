//! The resolver detector with its resolver: from every angle to every angle, lag, what is wrong with the
//! windings, and what is no signal.

use motion_rtl::circuits::lead_angle::{
    ResolverDetector, TrackingConverter, TrackingLoop, tracking_converter,
};
use motion_rtl::plant::{Resolver, ResolverParameters};
use motion_rtl::prelude::*;
use motion_rtl::trace::LastTicks;
use std::f64::consts::TAU;

/// The detector as it is built.
fn detector() -> ResolverDetector {
    ResolverDetector {
        converter: TrackingConverter::new(12, 17),
        position: 24,
    }
}

/// A sample of the detector.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Seen {
    /// The tick of its strobe.
    strobe: u64,
    position: i64,
    lost: bool,
}

/// Ticks from the strobe to the sample.
const LATENCY: u64 = 19;

/// The samples of so many ticks of a resolver on a body. `words` has the last word on what the A/D
/// converters give.
fn samples(
    resolver: &mut Resolver,
    pitch: u64,
    ticks: u64,
    position: impl Fn(u64) -> f64,
    words: impl Fn(u64, [i64; 2]) -> [i64; 2],
) -> Vec<Seen> {
    let mut detector = LastTicks::simulator(&detector()).unwrap();
    detector.set(|i| i.modulus, pitch % (1 << 17)).unwrap();
    let (mut seen, mut strobes) = (Vec::new(), Vec::new());
    for tick in 0..ticks {
        let (strobe, [sine, cosine]) = resolver.step(position(tick));
        let [sine, cosine] = words(tick, [sine, cosine]);
        detector.set(|i| i.strobe, strobe).unwrap();
        detector.set(|i| i.sine, sine).unwrap();
        detector.set(|i| i.cosine, cosine).unwrap();
        if strobe {
            strobes.push(tick);
        }
        if detector.see(|s| s.w.sample) {
            let strobe = tick - LATENCY;
            assert!(strobes.contains(&strobe), "{tick}");
            seen.push(Seen {
                strobe,
                position: detector.see(|s| s.w.position),
                lost: detector.see(|s| s.w.lost),
            });
        }
        detector.step();
    }
    seen
}

fn as_they_are(_: u64, words: [i64; 2]) -> [i64; 2] {
    words
}

fn resolver(pitch: u64, parameters: ResolverParameters) -> Resolver {
    Resolver::new(parameters, pitch as f64, 12, 20)
}

fn good(pitch: u64) -> Resolver {
    resolver(pitch, ResolverParameters::default())
}

/// Conversions until the loop has settled, by 20 ticks.
const SETTLED: u64 = 255 * 20;

/// Distance from one place to another, the shorter way round.
fn apart(one: i64, other: i64, all: i64) -> i64 {
    (one - other + all / 2).rem_euclid(all) - all / 2
}

/// Angle and speed of a converter after so many conversions of two words.
fn convert(
    converter: &mut Simulator<TrackingConverter>,
    [sine, cosine]: [i64; 2],
    conversions: u64,
) -> (i64, i64) {
    let period = converter.circuit().period();
    for tick in 0..conversions * period {
        let i = tracking_converter::In {
            strobe: tick % period == 0,
            sine,
            cosine,
        };
        converter.step_with(&i, |_| ()).unwrap();
    }
    let angle = converter.see(|s| s.w.angle);
    (angle as i64, converter.see(|s| s.w.speed))
}

/// From every angle at rest to every angle, by 64 angles of a pitch: it comes to rest within 30
/// conversions, at one of the angles that the rounded error takes for the same. At half a pitch, where
/// the sine is 0, it does not stay.
#[test]
fn from_every_angle_to_every_angle() {
    let circuit = TrackingConverter {
        converter: 6,
        tracking: TrackingLoop {
            angle: 6,
            smoothing: 1,
            settling: 3,
        },
    };
    let words = |angle: i64| {
        let (sine, cosine) = (angle as f64 / 64.0 * TAU).sin_cos();
        [sine, cosine].map(|part| (0.9 * 31.0 * part).round() as i64)
    };
    let power_on = Simulator::new(&circuit).unwrap();
    let mut longest = 0;
    for from in 0..64 {
        let mut rests = power_on.clone();
        convert(&mut rests, words(from), 60);
        assert_eq!(rests.see(|s| s.w.speed), 0, "{from}");
        for to in 0..64 {
            let mut converter = rests.clone();
            let mut before = convert(&mut converter, words(to), 1);
            let mut rested = 0;
            for conversion in 2..60 {
                let now = convert(&mut converter, words(to), 1);
                if now != before {
                    rested = conversion;
                }
                before = now;
            }
            longest = longest.max(rested);
            let (angle, speed) = before;
            assert!(
                apart(angle, to, 64).abs() <= 3 && speed == 0,
                "{from} {to} {before:?}"
            );
        }
    }
    assert!((20..=30).contains(&longest), "{longest}");
}

/// At rest the position is the place to within what the A/D words know of it: half a unit in each is
/// √½/1842 in the angle, and the rounded error is worth 2.6 angles. It does not move.
#[test]
fn at_rest_the_position_is_the_place_and_rests() {
    for pitch in [1000, 22_500, 90_000, 1 << 17] {
        let bound = 1.0 + pitch as f64 * (0.5f64.sqrt() / 1842.0 / TAU + 4.0 / 131_072.0);
        for part in 0..40 {
            let at = pitch as f64 * (f64::from(part) + 0.3) / 40.0;
            let seen = samples(
                &mut good(pitch),
                pitch,
                SETTLED + 4_000,
                |_| at,
                as_they_are,
            );
            assert_eq!(seen.len(), 200);
            assert_eq!(seen[0].strobe, SETTLED);
            let all = pitch as i64;
            for one in &seen {
                let off = apart(one.position, at as i64, all).abs() as f64;
                assert!(off <= bound && !one.lost, "{pitch} {at} {one:?}");
            }
            // Before the first of them, too.
            assert!(
                seen.iter().all(|one| one.position == seen[0].position),
                "{pitch} {at}"
            );
        }
    }
}

/// At constant speed the angle lags by nothing; at constant acceleration by a/K_a, K_a being
/// 0.3235·A·4^-G in CK^-2.
#[test]
fn it_lags_at_acceleration_only() {
    let pitch = 90_000u64;
    let per_ck = |tick: u64| tick as f64 / 20.0;
    let mean_off = |way: &dyn Fn(f64) -> f64, cks: u64| {
        let at = |tick| way(per_ck(tick));
        let seen = samples(&mut good(pitch), pitch, SETTLED + cks * 20, at, as_they_are);
        assert!(!seen.last().unwrap().lost);
        let from = seen.len() - 200;
        let off = seen[from..].iter().map(|one| {
            let truth = at(one.strobe);
            let ahead = apart(one.position, truth as i64, pitch as i64) as f64;
            ahead + truth.floor() - truth + 0.5
        });
        off.sum::<f64>() / 200.0
    };
    for speed in [3.0, -3.0, 911.0, -911.0, 11_000.0, -11_000.0] {
        // From rest to the speed in 200 CKs, and on.
        let way = |ck: f64| {
            let ramp = (ck - 255.0).clamp(0.0, 200.0);
            speed * (ramp * ramp / 400.0 + (ck - 455.0).max(0.0))
        };
        let off = mean_off(&way, 700);
        assert!(off.abs() <= 1.5, "{speed} {off}");
    }
    for acceleration in [1.0, -1.0, 3.0] {
        // From the first sample on.
        let way = |ck: f64| 0.5 * acceleration * (ck - 255.0).max(0.0).powi(2);
        let off = mean_off(&way, 900);
        let lag = acceleration * 16.0 / (0.3235 * 0.9);
        assert!(
            (off + lag).abs() <= 2.0 + 0.02 * lag.abs(),
            "{acceleration} {off} {lag}"
        );
    }
}

/// An offset δ of the sine winding is δ·cos θ in the angle, a mismatch m of the gains m/2·sin 2θ.
#[test]
fn what_is_wrong_with_the_windings_is_in_the_place() {
    let pitch = 22_500u64;
    let per_rad = pitch as f64 / TAU;
    for (sine_offset, gain_mismatch) in [(0.01, 0.0), (-0.02, 0.0), (0.0, 0.02), (0.01, -0.03)] {
        let parameters = ResolverParameters {
            sine_offset,
            gain_mismatch,
            ..ResolverParameters::default()
        };
        // 30 counts a CK, from rest, over ten pitches.
        let at = |tick: u64| {
            let ck = (tick as f64 / 20.0 - 255.0).max(0.0);
            0.075 * ck.min(200.0).powi(2) + 30.0 * (ck - 200.0).max(0.0)
        };
        let mut resolver = resolver(pitch, parameters);
        let seen = samples(&mut resolver, pitch, SETTLED + 7_700 * 20, at, as_they_are);
        // A place that is too small at the start is one of the pitch before.
        let ahead = if seen[0].position > 10_000 {
            pitch as f64
        } else {
            0.0
        };
        let mut largest: f64 = 0.0;
        for one in &seen[400..] {
            let truth = at(one.strobe);
            let theta = truth / per_rad;
            let wrong = sine_offset * theta.cos() + gain_mismatch / 2.0 * (2.0 * theta).sin();
            largest = largest.max((wrong * per_rad).abs());
            let off = one.position as f64 - ahead - truth - wrong * per_rad;
            // The place is rounded down, the loop follows the ripple a bit late.
            assert!(
                off.abs() <= 5.0,
                "{sine_offset} {gain_mismatch} {one:?} {off}"
            );
            assert!(!one.lost);
        }
        assert!(largest >= 35.0, "{largest}");
    }
}

/// No signal from power-on, one that goes and comes back, and amplitudes around the least.
#[test]
fn a_signal_that_is_too_small_is_lost() {
    let pitch = 1000u64;
    let scaled = |scale: f64| move |words: [i64; 2]| words.map(|word| (word as f64 * scale) as i64);
    let ticks = SETTLED + 8_000;
    let none = samples(&mut good(pitch), pitch, ticks, |_| 300.0, |_, _| [0; 2]);
    assert_eq!(none.len(), 400);
    assert!(none.iter().all(|one| one.lost && one.position == 0));
    // 0.30 of full scale at 0.9.
    for (scale, lost) in [
        (0.32, true),
        (0.33, true),
        (0.345, false),
        (0.4, false),
        (1.1, false),
    ] {
        let words = |_, words| scaled(scale)(words);
        let seen = samples(&mut good(pitch), pitch, ticks, |_| 300.0, words);
        assert!(
            seen.iter().all(|one| one.lost == lost),
            "{scale} {:?}",
            seen[0]
        );
    }
    let gone = |tick, words| match tick {
        0..8_000 => words,
        8_000..9_000 => [0; 2],
        _ => words,
    };
    let seen = samples(&mut good(pitch), pitch, ticks, |_| 300.0, gone);
    for one in &seen {
        assert_eq!(one.lost, one.strobe >= 8_000, "{one:?}");
        assert!((one.position - 300).abs() <= 1, "{one:?}");
    }
}

/// Faster than an eighth of a pitch in a CK, or jerked: what is wrong is said to be so.
#[test]
fn a_body_that_is_too_fast_is_lost() {
    let pitch = 1000u64;
    for (acceleration, most) in [(1.0, 126.0), (3.0, 400.0), (40.0, 700.0), (400.0, 400.0)] {
        for sign in [1.0, -1.0] {
            let at = |tick: u64| {
                let ck = (tick as f64 / 20.0 - 300.0).max(0.0);
                let ramp = ck.min(most / acceleration);
                sign * (0.5 * acceleration * ramp * ramp + most * (ck - ramp))
            };
            let seen = samples(&mut good(pitch), pitch, SETTLED + 20_000, at, as_they_are);
            let wrong = seen.iter().find(|one| {
                let lag = acceleration * 16.0 / (0.3235 * 0.9);
                (one.position as f64 - at(one.strobe)).abs() > 100.0 + lag.min(250.0)
            });
            assert!(
                wrong.is_none_or(|one| one.lost),
                "{acceleration} {most} {wrong:?}"
            );
            assert_eq!(
                seen.last().unwrap().lost,
                most > 250.0 || acceleration > 10.0
            );
        }
    }
}

/// `clear` takes the next place, and goes over no seam.
#[test]
fn clear_takes_the_next_place() {
    let mut detector = LastTicks::simulator(&detector()).unwrap();
    detector.set(|i| i.modulus, 1000).unwrap();
    let mut resolver = good(1000);
    let mut place = None;
    for tick in 0..SETTLED + 40_000 {
        let at = (tick as f64 - 6_000.0).max(0.0) / 10.0;
        let (strobe, [sine, cosine]) = resolver.step(at.min(3_456.4));
        detector.set(|i| i.strobe, strobe).unwrap();
        detector.set(|i| i.sine, sine).unwrap();
        detector.set(|i| i.cosine, cosine).unwrap();
        detector.set(|i| i.clear, tick == 42_005).unwrap();
        let position = detector.see(|s| s.w.position);
        match tick {
            41_800..=42_005 => assert_eq!(place.get_or_insert(position), &position),
            42_040.. => assert_eq!(place.map(|place| place - 3_000), Some(position), "{tick}"),
            _ => (),
        }
        assert!(!detector.see(|s| s.w.lost));
        detector.step();
    }
    assert!(
        place.is_some_and(|place| (place - 3_456).abs() <= 1),
        "{place:?}"
    );
}

/// A body that moves at power-on, at up to an eighth of a pitch in a CK and from any angle, is caught
/// before the first place is taken.
#[test]
fn a_moving_body_is_caught() {
    let pitch = 22_500u64;
    for speed in [30.0, 900.0, 2_812.0] {
        for eighth in 0..8 {
            for speed in [speed, -speed] {
                let at =
                    |tick: u64| (f64::from(eighth) / 8.0) * 22_500.0 + speed * tick as f64 / 20.0;
                let seen = samples(&mut good(pitch), pitch, SETTLED + 2_000, at, as_they_are);
                assert_eq!(seen.len(), 100);
                for one in &seen {
                    let off = apart(one.position, at(one.strobe).floor() as i64, pitch as i64);
                    assert!(
                        off.abs() <= 3 && !one.lost,
                        "{speed} {eighth} {one:?} {off}"
                    );
                }
            }
        }
    }
}
