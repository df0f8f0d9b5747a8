//! The absolute detector at full width: a turn of 90,000 counts.

use super::below;
use motion_rtl::check::Random;
use motion_rtl::circuits::lead_angle::AbsoluteDetector;
use motion_rtl::prelude::*;
use motion_rtl::trace::LastTicks;

const TURN: i64 = 90_000;
const CODE: usize = 17;

/// The word of a place.
fn gray(place: i64) -> u64 {
    let number = (place.rem_euclid(TURN) + ((1 << CODE) - TURN) / 2) as u64;
    number ^ (number >> 1)
}

/// An encoder before the detector, whose wires are late by a tick or not, each for itself.
struct Bench {
    detector: Simulator<AbsoluteDetector>,
    random: Random,
    word: u64,
}

impl Bench {
    fn new() -> Self {
        let circuit = AbsoluteDetector {
            code: CODE,
            position: 24,
        };
        let mut detector = LastTicks::simulator(&circuit).unwrap();
        detector.set(|i| i.turn, TURN as u64).unwrap();
        let random = Random::new(11);
        let word = 0;
        Bench {
            detector,
            random,
            word,
        }
    }

    /// A sample in so many ticks, six or more; the position that comes of it, and `lost`.
    fn sample(&mut self, word: u64, ticks: usize) -> (i64, bool) {
        let late = self.random.word() & ((1 << CODE) - 1);
        let torn = (self.word & late) | (word & !late);
        let strobe_late = below(&mut self.random, 2) == 1;
        let mut seen = None;
        for tick in 0..ticks {
            self.detector
                .set(|i| i.strobe, tick < 2 && !(tick == 0 && strobe_late))
                .unwrap();
            self.detector
                .set(|i| i.code, if tick == 0 { torn } else { word })
                .unwrap();
            if self.detector.see(|s| s.w.sample) {
                assert!(seen.is_none(), "two samples");
                let position = self.detector.see(|s| s.w.position);
                seen = Some((position, self.detector.see(|s| s.w.lost)));
            }
            self.detector.step();
        }
        self.word = word;
        seen.expect("a sample")
    }
}

/// From any place on, to and fro over many turns: no count is lost, however the wires come.
#[test]
fn it_goes_on_over_the_seam_in_either_direction() {
    let mut bench = Bench::new();
    let mut place = 45_678;
    assert_eq!(bench.sample(gray(place), 6), (place, false));
    let mut farthest = 0;
    for round in 0..2_000i64 {
        let drift = if round / 500 % 2 == 0 { 9_000 } else { -9_000 };
        place += below(&mut bench.random, 27_001) as i64 - 13_500 + drift;
        let ticks = 6 + below(&mut bench.random, 3) as usize;
        assert_eq!(bench.sample(gray(place), ticks), (place, false), "{round}");
        farthest = farthest.max(place / TURN);
    }
    assert!(farthest >= 40, "{farthest} turns");
}

/// Up to a quarter of a turn it is sure; beyond it says so, and beyond half a turn it goes wrong.
#[test]
fn beyond_a_quarter_of_a_turn_it_is_lost() {
    for (way, position, lost) in [
        (22_500, 22_500, false),
        (-22_500, -22_500, false),
        (22_501, 22_501, true),
        (-22_501, -22_501, true),
        (44_999, 44_999, true),
        (45_001, -44_999, true),
        // A whole turn more looks like less than a quarter: why it says so before.
        (70_000, -20_000, false),
    ] {
        let mut bench = Bench::new();
        assert_eq!(bench.sample(gray(0), 6), (0, false));
        assert_eq!(bench.sample(gray(way), 6), (position, lost), "{way}");
        assert_eq!(bench.sample(gray(way), 6), (position, lost), "{way}");
        // The word after clear is the place.
        bench.detector.set(|i| i.clear, true).unwrap();
        bench.detector.step();
        bench.detector.set(|i| i.clear, false).unwrap();
        assert!(!bench.detector.see(|s| s.w.lost));
        let place = way.rem_euclid(TURN);
        assert_eq!(bench.sample(gray(way), 6), (place, false), "{way}");
    }
}

/// A word outside the turn is none: the position stays, and it is lost.
#[test]
fn words_that_the_turn_has_not_are_not_counted() {
    let mut bench = Bench::new();
    assert_eq!(bench.sample(gray(10), 6), (10, false));
    let below = (((1 << CODE) - TURN) / 2 - 1) as u64;
    let above = below + TURN as u64 + 1;
    for number in [below, above, 0, (1 << CODE) - 1] {
        bench.detector.set(|i| i.clear, true).unwrap();
        bench.detector.step();
        bench.detector.set(|i| i.clear, false).unwrap();
        assert_eq!(bench.sample(gray(10), 6), (10, false));
        assert_eq!(
            bench.sample(number ^ (number >> 1), 6),
            (10, true),
            "{number}"
        );
        assert_eq!(bench.sample(gray(12), 6), (12, true), "{number}");
    }
}
