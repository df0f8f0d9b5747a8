//! The phase-shift detector with its transducer: every place, speeds up to the limit, and what is no
//! signal.

use motion_rtl::circuits::lead_angle::PhaseDetector;
use motion_rtl::plant::PhaseShiftTransducer;
use motion_rtl::trace::LastTicks;

/// A sample of the detector.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Seen {
    /// The tick with 0 phase that it belongs to.
    zero: u64,
    position: i64,
    lost: bool,
}

/// Ticks from 0 phase to the sample.
const LATENCY: u64 = 3;

/// The samples of so many ticks, and how many crossings each period had. `level` has the last word on
/// what comes to the pin.
fn samples(
    pitch: u32,
    ticks: u64,
    position: impl Fn(u64) -> f64,
    level: impl Fn(u64, bool) -> bool,
) -> (Vec<Seen>, Vec<u32>) {
    let (phase, width) = (10, 24);
    let circuit = PhaseDetector {
        phase,
        position: width,
    };
    let mut detector = LastTicks::simulator(&circuit).unwrap();
    detector
        .set(|i| i.modulus, u64::from(pitch) % (1 << phase))
        .unwrap();
    let transducer = PhaseShiftTransducer::new(pitch);
    let (mut seen, mut crossings) = (Vec::new(), Vec::new());
    let mut before = true;
    for tick in 0..ticks {
        let phase = detector.see(|s| s.w.phase);
        assert_eq!(phase, tick % u64::from(pitch));
        let now = level(tick, transducer.secondary(phase, position(tick)));
        detector.set(|i| i.secondary, now).unwrap();
        if phase == 0 {
            crossings.push(0);
        }
        *crossings.last_mut().unwrap() += u32::from(now && !before);
        before = now;
        if detector.see(|s| s.w.sample) {
            seen.push(Seen {
                zero: tick - LATENCY,
                position: detector.see(|s| s.w.position),
                lost: detector.see(|s| s.w.lost),
            });
        }
        detector.step();
    }
    (seen, crossings)
}

/// Whole pitches that the position of the first sample is ahead of the way: it is the place in the
/// pitch.
fn ahead(first: &Seen, pitch: u32, way: f64) -> i64 {
    let pitches = (first.position as f64 - way) / f64::from(pitch);
    pitches.round() as i64 * i64::from(pitch)
}

fn as_it_is(_: u64, level: bool) -> bool {
    level
}

/// At rest the position is the place, on every count of a pitch, of a long one every 13th, and 0.4 to
/// either side of it.
#[test]
#[ignore = "takes long"]
fn at_rest_the_position_is_the_place() {
    for pitch in [8, 9, 16, 100, 1000, 1024] {
        for place in (0..pitch).step_by(if pitch > 100 { 13 } else { 1 }) {
            for off in [-0.4, 0.0, 0.4] {
                let at = f64::from(place) + off;
                let (seen, _) = samples(pitch, u64::from(3 * pitch) + 8, |_| at, as_it_is);
                // The first period may have begun with its crossing.
                assert!(seen.len() >= 2, "{pitch} {place}");
                for (index, one) in seen.iter().enumerate() {
                    assert_eq!(one.zero % u64::from(pitch), 0);
                    let right = (i64::from(place), false);
                    assert_eq!((one.position, one.lost), right, "{pitch} {at} {index}");
                }
            }
        }
    }
}

/// A place is that of its crossing, M − D ticks before the sample, or a period more where none came: the
/// position lags by v·(M − D). Up to the limit none is lost, and seams have periods with none and two.
#[test]
fn at_speed_it_lags_by_the_age_of_the_crossing() {
    for pitch in [16, 100, 1000] {
        let limit = PhaseShiftTransducer::followed_counts_per_tick(pitch);
        let (mut none, mut two) = (0, 0);
        for share in [0.003, 0.1, 0.37, 0.8, 1.0] {
            for speed in [limit * share, -limit * share] {
                let way = |tick: u64| 7.0 + speed * tick as f64;
                let ticks = u64::from(pitch) * 400;
                let (seen, crossings) = samples(pitch, ticks, way, as_it_is);
                let ahead = ahead(&seen[0], pitch, way(seen[0].zero));
                for one in &seen[1..] {
                    let period = (one.zero / u64::from(pitch)) as usize - 1;
                    let place = one.position.rem_euclid(i64::from(pitch)) as f64;
                    let empty = crossings[period] == 0;
                    none += u32::from(empty);
                    two += u32::from(crossings[period] == 2);
                    let age = f64::from(pitch) * if empty { 2.0 } else { 1.0 } - place;
                    let off = (one.position - ahead) as f64 - (way(one.zero) - speed * age);
                    assert!(
                        off.abs() <= 0.5 + speed.abs(),
                        "{pitch} {speed} {one:?} {off}"
                    );
                    assert!(!one.lost, "{pitch} {speed} {one:?}");
                }
            }
        }
        assert!(none > 20 && two > 20, "{none} {two}");
    }
}

/// Beyond it the position is not to be trusted, and is said to be so before it is wrong.
#[test]
fn a_body_that_is_too_fast_is_lost() {
    for speed in [0.21, -0.21, 0.3, -0.3, 0.49, -0.49, 0.9, -0.9] {
        let way = |tick: u64| speed * tick as f64;
        let (seen, _) = samples(100, 4_000, way, as_it_is);
        let ahead = ahead(&seen[0], 100, way(seen[0].zero));
        let wrong = seen.iter().position(|one| {
            let lag = way(one.zero) - (one.position - ahead) as f64;
            lag.abs() > 210.0 * f64::abs(speed) + 1.0
        });
        let lost = seen.iter().position(|one| one.lost);
        assert!(lost.is_some(), "{speed}");
        assert!(
            wrong.is_none() || lost <= wrong,
            "{speed} {wrong:?} {lost:?}"
        );
    }
}

/// No secondary, one that ends, one that ends in a seam, and one that is back.
#[test]
fn a_secondary_that_is_missing_is_lost() {
    for stuck in [false, true] {
        let (seen, _) = samples(16, 80, |_| 3.0, |_, _| stuck);
        assert!(seen.iter().all(|one| one.lost), "{seen:?}");
        assert!(seen.len() >= 2);
        for place in 0..16 {
            let ends = |tick, level| {
                if (160..640).contains(&tick) {
                    stuck
                } else {
                    level
                }
            };
            let (seen, _) = samples(16, 800, |_| f64::from(place), ends);
            assert_eq!(seen.last().unwrap().position, i64::from(place));
            for one in &seen {
                // A level that stays high may rise before its time.
                let off = (one.position - i64::from(place)).abs();
                assert!(off == 0 || (stuck && off <= 4), "{place} {one:?}");
                // More than 5/4 of a period after the last crossing.
                let last = if stuck { 160 } else { 144 + place as u64 };
                assert!(one.lost || one.zero <= last + 21, "{place} {one:?}");
                assert!(!one.lost || one.zero > 160, "{place} {one:?}");
            }
        }
    }
}

/// A level that is wrong for a tick, in each of them: it moves a crossing by a count, or it is lost,
/// with the sample after it at the latest, and the position is right once more.
#[test]
fn a_glitch_is_lost_or_harmless() {
    let (mut harmless, mut found) = (0, 0);
    for place in 0..16i64 {
        for glitch in 64..96 {
            let flip = |tick, level: bool| level ^ (tick == glitch);
            let (seen, _) = samples(16, 240, |_| place as f64, flip);
            let last = seen.last().unwrap();
            assert_eq!(last.position, place, "{glitch}");
            let off = seen.iter().map(|one| (one.position - place).abs());
            assert!(off.clone().all(|off| off <= 4), "{place} {glitch}");
            match last.lost {
                true => found += 1,
                false => {
                    harmless += 1;
                    assert!(off.max() <= Some(1), "{place} {glitch} {seen:?}");
                }
            }
        }
    }
    // The ticks beside the crossing, and those around the fall.
    assert!(harmless >= 16 && found >= 256, "{harmless} {found}");
}

/// The place after clear is the position, and the carrier goes on.
#[test]
fn clear_takes_the_next_place() {
    let circuit = PhaseDetector {
        phase: 6,
        position: 12,
    };
    let mut detector = LastTicks::simulator(&circuit).unwrap();
    detector.set(|i| i.modulus, 40).unwrap();
    let transducer = PhaseShiftTransducer::new(40);
    for tick in 0..8_000u64 {
        let phase = detector.see(|s| s.w.phase);
        assert_eq!(phase, tick % 40);
        let at = (tick as f64 / 20.0).min(131.0);
        detector
            .set(|i| i.secondary, transducer.secondary(phase, at))
            .unwrap();
        detector.set(|i| i.clear, tick == 4_000).unwrap();
        let position = detector.see(|s| s.w.position);
        match tick {
            3_000..=4_000 => assert_eq!(position, 131),
            4_100.. => assert_eq!(position, 11),
            _ => (),
        }
        detector.step();
    }
}
