//! Records, played by a difference engine of `i128` and compared with the polynomials.

use super::*;
use motion_rtl::circuits::arc_generator::{Rounding, Widths};
use motion_rtl::jobs::arc_generator::prepare::prepare;
use motion_rtl::jobs::arc_generator::record::records;
use motion_rtl::jobs::arc_generator::reference::{Decoded, commands};
use motion_rtl::path::record::Record;

const FULL: Widths = Widths::FULL;

/// Counts per mm at which a millimetre is a guard unit.
fn unit(widths: &Widths) -> f64 {
    (-(widths.guard() as f64)).exp2()
}

fn record_of(shape: Shape, samples: u64, widths: &Widths) -> Record {
    let path = single(shape, samples);
    records(&path, unit(widths), widths, Rounding::Nearest).unwrap()[0]
}

fn point(values: [i64; 3]) -> Point {
    values.map(|value| value as f64)
}

/// Four adders of one coordinate: whole and part of the value and of its differences.
struct Engine {
    columns: [(i128, i128); 5],
    modulus: i128,
    wrap: i128,
}

impl Engine {
    fn new(record: &Record, coordinate: usize, widths: &Widths) -> Self {
        let words = record.words.map(i128::from);
        let wrap = 1 << widths.point;
        let mut columns = [(words[2 + coordinate], 0); 5];
        for order in 0..4 {
            let word = 8 + 8 * coordinate + 2 * order;
            columns[order + 1] = (words[word] % wrap, words[word + 1]);
        }
        Engine {
            columns,
            modulus: words[1],
            wrap,
        }
    }

    fn step(&mut self) {
        for order in 0..4 {
            let below = self.columns[order + 1];
            let (whole, part) = &mut self.columns[order];
            *whole += below.0;
            *part += below.1;
            if *part >= self.modulus {
                *part -= self.modulus;
                *whole += 1;
            }
            *whole %= self.wrap;
            assert!(*part < self.modulus);
        }
    }

    /// The value in units of 1/modulus, modulo the word.
    fn value(&self) -> i128 {
        self.columns[0].0 * self.modulus + self.columns[0].1
    }
}

/// Plays a blend of guard units and compares every sample with [5] times M⁴.
fn blend_is_its_polynomial(points: [[i64; 3]; 3], m: u64, widths: &Widths) {
    let [before, corner, behind] = points;
    let shape = Shape::Blend {
        before: point(before),
        corner: point(corner),
        behind: point(behind),
    };
    let record = record_of(shape, m, widths);
    assert!(record.words.iter().all(|word| word >> widths.data == 0));
    let reference = Decoded::of(&record, widths).points(widths, Rounding::Nearest);
    let reference: Vec<_> = reference.collect();
    let m = i128::from(m);
    let modulus = m * m * m * m;
    for k in 0..3 {
        let [a, b, c] = [before[k], corner[k], behind[k]].map(i128::from);
        let mut engine = Engine::new(&record, k, widths);
        assert_eq!(engine.modulus, modulus);
        for n in 0..=m {
            let wanted = a * modulus
                + 2 * (b - a) * n * m * m * m
                + (a - 2 * b + c) * (2 * m - n) * n * n * n;
            let difference = engine.value() - wanted;
            assert_eq!(
                difference.rem_euclid(modulus << widths.point),
                0,
                "{points:?} {m} {n}"
            );
            let error = 2 * (i128::from(reference[n as usize][k]) * modulus - wanted);
            assert!(-modulus < error && error <= modulus, "the reference at {n}");
            engine.step();
        }
    }
}

#[test]
fn small_blends_are_their_polynomial_at_every_sample() {
    for m in [2, 4, 8, 16] {
        for a in -4..=4 {
            for b in -4..=4 {
                // Three triples of points at once.
                for c in (-4..=4).step_by(3) {
                    let behind = [c, (c + 1).min(4), (c + 2).min(4)];
                    blend_is_its_polynomial([[a; 3], [b; 3], behind], m, &FULL);
                }
            }
        }
    }
}

#[test]
fn small_words_hold_their_blends() {
    for a in -16..16 {
        for b in -16..16 {
            blend_is_its_polynomial([[a, b, -a], [b, a, a], [-b, 0, b]], 4, &Widths::narrow(4));
            blend_is_its_polynomial([[a, b, -a], [b, a, a], [-b, 0, b]], 16, &Widths::narrow(8));
        }
    }
}

proptest! {
    #[test]
    fn blends_are_their_polynomial(
        points in proptest::array::uniform3(proptest::array::uniform3(-(1i64 << 38)..1 << 38)),
        half in 1u64..=512,
    ) {
        blend_is_its_polynomial(points, 2 * half, &FULL);
    }

    #[test]
    fn lines_are_straight_and_end_exactly(
        from in proptest::array::uniform3(-(1i64 << 38)..1 << 38),
        to in proptest::array::uniform3(-(1i64 << 38)..1 << 38),
        samples in 1u64..3000,
    ) {
        let shape = Shape::Line { from: point(from), to: point(to) };
        let record = record_of(shape, samples, &FULL);
        let reference = Decoded::of(&record, &FULL).points(&FULL, Rounding::Nearest);
        let reference: Vec<_> = reference.collect();
        for k in 0..3 {
            let (begin, way) = (i128::from(from[k]), i128::from(to[k]) - i128::from(from[k]));
            let mut engine = Engine::new(&record, k, &FULL);
            for n in 0..=samples {
                let (n, samples) = (i128::from(n), i128::from(samples));
                let wanted = begin * samples + way * n;
                prop_assert_eq!((engine.value() - wanted).rem_euclid(samples << 40), 0);
                let error = 2 * (i128::from(reference[n as usize][k]) * samples - wanted);
                prop_assert!(-samples < error && error <= samples);
                engine.step();
            }
        }
    }
}

#[test]
fn the_header_has_kind_rest_and_samples() {
    let lines = [
        line([1.0, 0.0, 0.0], 5.0),
        arc([1.0, 0.0, 0.0], [2.0, 1.0, 0.0], [1.0, 2.0, 0.0], 5.0),
    ];
    let path = prepare([0.0; 3], &lines, &timing(8)).unwrap();
    let all = records(&path, 1000.0, &FULL, Rounding::Nearest).unwrap();
    assert_eq!(all.len(), path.segments.len());
    let kinds: Vec<_> = all.iter().map(|record| record.words[0] & 3).collect();
    assert_eq!(kinds, [0, 1, 0, 2, 0]);
    let rests: Vec<_> = all.iter().map(|record| record.words[0] >> 2 & 1).collect();
    assert_eq!(rests, [0, 0, 0, 0, 1]);
    for (record, segment) in all.iter().zip(&path.segments) {
        assert_eq!(record.words[0] >> 3, segment.samples);
    }
    assert_eq!(all[0].words[1], 4096);
    assert_eq!(all[1].words[1], path.segments[1].samples);
    assert_eq!(all[3].words[1], 1);
}

#[test]
fn segments_end_where_the_next_begins() {
    let (a, b, c) = ([0.3, 0.1, -0.2], [21.7, 0.4, 3.1], [30.1, 9.9, 3.3]);
    let pieces = [
        line(b, 37.0),
        arc(b, [28.0, 2.0, 3.0], c, 23.0),
        line([30.0, 40.0, 11.0], 41.0),
        line([30.0, 60.0, 22.0], 11.0),
    ];
    let path = prepare(a, &pieces, &timing(64)).unwrap();
    let all = records(&path, 1000.0, &FULL, Rounding::Nearest).unwrap();
    let decoded: Vec<_> = all
        .iter()
        .map(|record| Decoded::of(record, &FULL))
        .collect();
    for (pair, segments) in decoded.windows(2).zip(path.segments.windows(2)) {
        let ends = pair[0].points(&FULL, Rounding::Nearest);
        let mut begins = pair[1].points(&FULL, Rounding::Nearest);
        let (last, first) = (ends.last().unwrap(), begins.next().unwrap());
        let gap = (0..3).map(|k| (last[k] - first[k]).abs()).max().unwrap();
        match segments[0].shape {
            // 2^-16 count each.
            Shape::Arc { .. } => assert!(gap < 2000, "{gap} guard units at the end of an arc"),
            _ => assert_eq!(gap, 0),
        }
    }
    // And the commands are the exact points to the nearest count.
    let commands = commands(&all, &FULL, Rounding::Nearest).collect::<Vec<_>>();
    assert_eq!(commands.len() as u64, path.samples());
    for (sample, command) in (0..).zip(&commands) {
        let exact = path.point(sample).unwrap();
        for k in 0..3 {
            let error = command[k] as f64 - 1000.0 * exact[k];
            assert!(error.abs() < 0.5 + 0.02, "{sample}: {error}");
        }
    }
    assert_eq!(commands.last(), Some(&[30_000, 60_000, 22_000]));
}
