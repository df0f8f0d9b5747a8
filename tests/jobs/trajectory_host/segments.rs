//! Paths as segments: their words, as the circuit reads them, against the pieces.

use super::config;
use motion_rtl::circuits::trajectory_controller::Widths;
use motion_rtl::jobs::trajectory_controller::segments::{Path, Segment};
use motion_rtl::path::circle::Circle;
use motion_rtl::path::helix::Helix;
use motion_rtl::path::pieces::{Course, Piece};
use proptest::prelude::*;
use std::f64::consts::TAU;

type Vector = [f64; 3];

const COUNTS_PER_MM: f64 = 1000.0;
/// Guard units of a millimetre.
const UNIT: f64 = COUNTS_PER_MM * 65536.0;

fn line(to: Vector) -> Piece {
    Piece {
        course: Course::Line,
        to,
        speed: 10.0,
        line: None,
    }
}

/// The point that the words say, in guard units, by numbers that are not rounded.
pub fn read(words: &[u64; 16], offset: u64) -> Vector {
    let signed = |word: u64, bits: u32| (word << (64 - bits)) as i64 >> (64 - bits);
    let (arc, spatial, shift) = (words[0] & 1, words[0] >> 7, words[0] >> 1 & 63);
    let (a, b, c) = match (arc, spatial) {
        (0, 0) => (offset as f64, 0.0, 0.0),
        (0, _) => {
            let part = offset as f64 / (shift as f64).exp2();
            assert!(part < 1.0, "{offset} of {shift} bits");
            (
                offset as f64,
                offset as f64 * part,
                offset as f64 * part * part,
            )
        }
        _ => {
            // 2^(M + n − 4) / turn, n = H − shift.
            let exponent = 44 + 44 - shift as i32 - 4;
            let turns = offset as f64 * words[1] as f64 / f64::from(exponent).exp2();
            let radius = words[2] as f64 / 256.0 * 1.646_760_258_121_065_6;
            let (sin, cos) = (TAU * turns).sin_cos();
            (
                radius * cos,
                radius * sin,
                if spatial == 1 { offset as f64 } else { 0.0 },
            )
        }
    };
    let part = |word: usize| signed(words[word], 42) as f64 / 2f64.powi(40);
    [0, 1, 2].map(|k| {
        signed(words[3 + k], 47) as f64 + a * part(6 + k) + b * part(9 + k) + c * part(13 + k)
    })
}

/// The point of a piece at a part of its length, in guard units.
fn exact(from: Vector, piece: &Piece, part: f64) -> Vector {
    let point = match &piece.course {
        Course::Line => [0, 1, 2].map(|k| from[k] + (piece.to[k] - from[k]) * part),
        Course::Arc(circle) => circle.point(circle.angle * part),
        Course::Helix(_) | Course::Spline(_) => unreachable!("none is made here"),
    };
    point.map(|mm| mm * UNIT)
}

fn off(a: Vector, b: Vector) -> f64 {
    let squares: f64 = (0..3).map(|k| (a[k] - b[k]).powi(2)).sum();
    squares.sqrt()
}

proptest! {
    #![proptest_config(config(500))]

    #[test]
    fn each_segment_begins_and_ends_where_its_piece_does(
        pieces in prop::collection::vec(
            (prop::array::uniform3(-1.0..1.0f64), prop::array::uniform3(-1.0..1.0f64), -7.0..4.0f64, any::<bool>()),
            1..20,
        ),
        parts in prop::array::uniform5(0.0..1.0f64),
    ) {
        let (start, mut from) = ([1.0, -2.0, 3.0], [1.0, -2.0, 3.0]);
        let mut taught = Vec::new();
        for (way, aside, size, arc) in pieces {
            let size = 10f64.powf(size);
            let to = [0, 1, 2].map(|k| from[k] + size * way[k]);
            let via = [0, 1, 2].map(|k| from[k] + size * (way[k] / 2.0 + aside[k]));
            let circle = Circle::through(from, via, to).ok().filter(|circle| arc && circle.radius < 1e5);
            taught.push((from, Piece { course: circle.map_or(Course::Line, Course::Arc), ..line(to) }));
            from = to;
        }
        let pieces: Vec<Piece> = taught.iter().map(|(_, piece)| *piece).collect();
        let Ok(path) = Path::of(start, &pieces, COUNTS_PER_MM, &Widths::FULL) else {
            // Only where nothing has a length.
            prop_assert!(pieces.iter().all(|piece| off(piece.to, start) < 1.0 / UNIT * 40.0));
            return Ok(());
        };
        prop_assert_eq!(path.stretches.len() + path.zero_length, pieces.len());
        let mut length = 0;
        for stretch in &path.stretches {
            prop_assert_eq!(stretch.begin, length);
            prop_assert!(stretch.length > 0);
            length += stretch.length;
            let (from, piece) = &taught[stretch.piece];
            let own = piece.course.length(*from, piece.to) * UNIT;
            // A line is measured between rounded points.
            prop_assert!((stretch.length as f64 - own).abs() <= 0.5 + 3f64.sqrt() + own * 1e-12);
            let words = stretch.segment.words(&Widths::FULL);
            prop_assert!(words.iter().all(|word| word >> 55 == 0) && words[1] >> 44 == 0);
            let size = match &piece.course {
                Course::Line | Course::Helix(_) | Course::Spline(_) => own,
                Course::Arc(circle) => {
                    // But for turns of more than 2^41, whose angles have no bit to spare.
                    prop_assert!(words[1] >> 43 == 1 || words[0] >> 1 & 63 == 0, "{:x}", words[1]);
                    circle.radius * UNIT
                }
            };
            // Ends rounded to units, coefficients and curvature to words.
            let near = 1.8 + size * 2f64.powi(-38) + size.max(own) * 1e-12;
            for part in [0.0, 1.0].into_iter().chain(parts) {
                let offset = (stretch.length as f64 * part).round();
                let exact = exact(*from, piece, offset / stretch.length as f64);
                let point = read(&words, offset as u64);
                prop_assert!(off(point, exact) < near, "{:?} {:?}: {}", point, exact, off(point, exact));
                let computed = stretch.segment.point(offset);
                prop_assert!(off(computed, exact) < near);
                let along = path.point(stretch.begin as f64 + offset);
                // At its end the next begins.
                let other = offset == stretch.length as f64 || off(along, computed) == 0.0;
                prop_assert!(other && off(along, exact) < near + 2.0 + 1e-9 * size);
            }
        }
        prop_assert_eq!(path.length, length);
        let end = path.point(f64::INFINITY);
        let last = pieces[pieces.len() - 1].to.map(|mm| mm * UNIT);
        prop_assert!(off(end, last) < 4.0 + length as f64 * 1e-11);
    }
}

proptest! {
    #![proptest_config(config(200))]

    #[test]
    fn a_helix_has_the_words_of_its_arc_and_its_rise(
        (radius, rise) in (-3.0..3.0f64, -3.0..3.0f64),
        (angle, first, signs) in (0.01..TAU, 0.0..TAU, any::<[bool; 2]>()),
        parts in prop::array::uniform5(0.0..1.0f64),
    ) {
        let [radius, rise] = [radius, rise].map(|exponent| 10f64.powf(exponent));
        let [turn, up] = signs.map(|sign| if sign { 1.0 } else { -1.0 });
        let at = |part: f64| {
            let (sin, cos) = (first + turn * angle * part).sin_cos();
            [5.0 + radius * cos, radius * sin - 3.0, 7.0 + up * rise * part]
        };
        let helix = Helix::around([5.0, -3.0, 0.0], at(0.0), at(1.0), [0.0, 0.0, turn]).unwrap();
        let piece = Piece { course: Course::Helix(helix), ..line(at(1.0)) };
        let path = Path::of(at(0.0), &[piece], COUNTS_PER_MM, &Widths::FULL).unwrap();
        let stretch = &path.stretches[0];
        let length = (radius * angle).hypot(rise);
        prop_assert!((stretch.length as f64 - length * UNIT).abs() <= 0.5 + length * UNIT * 1e-9);
        let steep = rise / angle;
        let curved = (radius * radius + steep * steep) / radius;
        prop_assert!((stretch.radius.unwrap() / curved - 1.0).abs() < 1e-6);
        let words = stretch.segment.words(&Widths::FULL);
        let near = 3.0 + length.max(radius) * UNIT * 1e-9;
        for part in [0.0, 1.0].into_iter().chain(parts) {
            let offset = (stretch.length as f64 * part).round();
            let exact = at(offset / stretch.length as f64).map(|mm| mm * UNIT);
            let point = read(&words, offset as u64);
            prop_assert!(off(point, exact) < near, "{:?} {:?} {}", point, exact, near);
            prop_assert!(off(stretch.segment.point(offset), exact) < near);
            let found = helix.nearest(point.map(|units| units / UNIT)).map(|mm| mm * UNIT);
            prop_assert!(off(found, exact) < near);
        }
        let whole = path.length as f64;
        for (end, part) in [(0.0, 0.0), (whole, 1.0)] {
            let step = whole * 1e-5;
            let [back, on] = [end - step * part, end + step * (1.0 - part)].map(|at| path.point(at));
            let way = [0, 1, 2].map(|k| (on[k] - back[k]) / step);
            prop_assert!(off(way, stretch.directions[part as usize]) < 1e-3 + 4.0 / step);
        }
    }
}

fn refusal(start: Vector, pieces: &[Piece], counts_per_mm: f64) -> String {
    let error = Path::of(start, pieces, counts_per_mm, &Widths::FULL).unwrap_err();
    error.to_string()
}

#[test]
fn what_does_not_fit_is_refused_with_the_width_it_needs() {
    let origin = [0.0; 3];
    let far = |x: f64| line([x, 0.0, 0.0]);
    // 2^30 counts are too many: W = 31 holds 2^30 − 1.
    assert_eq!(
        refusal(origin, &[far(1_073_742.0)], 1000.0),
        "piece 0: x reaches 1073742000.0 counts, which needs W = 32; \
         allowed: -1073741823 to 1073741823 counts at W = 31: fewer counts per mm"
    );
    // Half of them are for what is beside the path: from its start it may go as far as the rest.
    assert_eq!(
        refusal(origin, &[far(-536_871.0)], 1000.0),
        "piece 0: x from the start reaches -536871000.0 counts, which needs W = 32; \
         allowed: -536870911 to 536870911 counts at W = 31: fewer counts per mm"
    );
    assert!(Path::of(origin, &[far(536_870.0)], 1000.0, &Widths::FULL).is_ok());
    let away = [500_000.0, 0.0, 0.0];
    assert!(Path::of(away, &[far(1_036_000.0)], 1000.0, &Widths::FULL).is_ok());
    // There and back the length is too long where no point is.
    let there = [far(400_000.0), far(0.0), far(400_000.0)];
    assert_eq!(
        refusal(origin, &there, 1000.0),
        "piece 2: length reaches 1200000000.0 counts, which needs W = 32; \
         allowed: -1073741823 to 1073741823 counts at W = 31: fewer counts per mm"
    );
    let flat = Circle::through(origin, [1000.0, 1e-4, 0.0], [2000.0, 0.0, 0.0]).unwrap();
    let flat = Piece {
        course: Course::Arc(flat),
        ..far(2000.0)
    };
    let text = refusal(origin, &[flat], 1000.0);
    assert!(
        text.contains("centre y reaches -4999999999999.9 counts"),
        "{text}"
    );
    assert!(text.contains("needs W = 44"), "{text}");
    let many: Vec<Piece> = (1..=4097).map(|k| far(f64::from(k))).collect();
    assert_eq!(
        refusal(origin, &many, 1000.0),
        "piece 4096: the path has 4097 segments, which take addresses of A = 13 bits; allowed: at most 4096"
    );
    assert!(Path::of(origin, &many[1..], 1000.0, &Widths::FULL).is_ok());
    let nothing = [far(0.0), far(1e-9)];
    assert_eq!(
        refusal(origin, &nothing, 1000.0),
        "piece 0: the path is empty; allowed: one piece or more"
    );
    assert!(refusal(origin, &[], 1000.0).contains("empty"));
    let nan = line([0.0, f64::NAN, 0.0]);
    assert!(refusal(origin, &[nan], 1000.0).contains("y is NaN"));
    let still = Piece {
        speed: 0.0,
        ..far(1.0)
    };
    assert!(refusal(origin, &[still], 1000.0).contains("is 0 mm/min"));
    let moved = Piece {
        to: [2001.0, 0.0, 0.0],
        ..flat
    };
    assert!(refusal(origin, &[moved], 1000.0).contains("off the path's points"));
}

#[test]
fn steps_too_small_for_a_unit_are_not_lost() {
    // 0.3 units each: with their sum the path goes on.
    let pieces: Vec<Piece> = (1..=1000)
        .map(|k| line([f64::from(k) * 0.3 / UNIT, 0.0, 0.0]))
        .collect();
    let path = Path::of([0.0; 3], &pieces, COUNTS_PER_MM, &Widths::FULL).unwrap();
    assert_eq!(path.length, 300);
    assert_eq!(path.point(300.0), [300.0, 0.0, 0.0]);
    assert_eq!(path.zero_length, 700);
}

#[test]
fn the_smallest_and_the_largest_arc_have_words() {
    for radius in [0.2 / UNIT, 1.0 / UNIT, 1e-3, 1e3, 1.07e6] {
        let quarter = Circle {
            centre: [0.0; 3],
            axis: [0.0, 0.0, 1.0],
            start: [radius, 0.0, 0.0],
            radius,
            angle: TAU / 4.0 * 3.0,
        };
        let piece = Piece {
            course: Course::Arc(quarter),
            ..line([0.0, -radius, 0.0])
        };
        let path = Path::of(quarter.start, &[piece], 1000.0, &Widths::FULL);
        if radius * UNIT * TAU * 0.75 < 0.5 {
            assert!(path.is_err());
            continue;
        }
        let Ok(path) = path else {
            // Longer than the words.
            assert!(radius == 1.07e6);
            continue;
        };
        let Segment { arc, .. } = path.stretches[0].segment;
        assert!((arc.unwrap().turn * 0.75 - path.length as f64).abs() < 1e-9 * path.length as f64);
        let words = path.stretches[0].segment.words(&Widths::FULL);
        assert!(
            words[0] < 128 && words[1] >> 43 == 1 && words[2] >> 54 == 0,
            "{words:?}"
        );
    }
}
