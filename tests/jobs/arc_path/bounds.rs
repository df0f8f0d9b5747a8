//! The bound of the rotation, against rotations of integers.

use super::*;
use motion_rtl::circuits::arc_generator::{Rounding, Widths};
use motion_rtl::jobs::arc_generator::bounds::{command_error, rotation_error};
use motion_rtl::jobs::arc_generator::record::records;
use motion_rtl::jobs::arc_generator::reference::{Decoded, commands};
use motion_rtl::path::record::Record;
use std::cell::Cell;
use std::f64::consts::TAU;

/// The points of a rotation's record in guard units, in `i128`.
fn rotated(record: &Record, steps: u64, widths: &Widths, rounding: Rounding) -> Vec<[i128; 3]> {
    let word = |index: usize, bits: usize| {
        let value = i128::from(record.words[index]) % (1 << bits);
        if value >= 1 << (bits - 1) {
            value - (1 << bits)
        } else {
            value
        }
    };
    let fraction = widths.coefficient - 2;
    let mut vector = [2, 3, 4].map(|index| word(index, widths.point));
    let centre = [5, 6, 7].map(|index| word(index, widths.point));
    let mut points = Vec::new();
    for _ in 0..=steps {
        points.push([0, 1, 2].map(|k| centre[k] + vector[k]));
        vector = [0, 1, 2].map(|row| {
            let sum: i128 = (0..3)
                .map(|k| word(8 + 8 * row + k, widths.coefficient) * vector[k])
                .sum();
            match rounding {
                Rounding::Nearest => (sum + (1 << (fraction - 1))).div_euclid(1 << fraction),
                Rounding::Floor => sum.div_euclid(1 << fraction),
            }
        });
    }
    points
}

/// Error of an arc as a part of its bound: the largest on the way, and that of the last point.
/// Radius and centre in counts.
fn part_of_bound(
    frame: [Point; 3],
    (centre, radius): (Point, f64),
    (step, steps): (f64, u64),
    widths: &Widths,
    rounding: Rounding,
) -> [f64; 2] {
    let circle = Circle {
        centre,
        axis: frame[2],
        start: on_circle(frame, centre, radius, 0.0),
        radius,
        angle: step * steps as f64,
    };
    let from = 0.0;
    let path = single(Shape::Arc { circle, from, step }, steps);
    let record = records(&path, 1.0, widths, rounding).unwrap()[0];
    let points = rotated(&record, steps, widths, rounding);
    let reference = Decoded::of(&record, widths).points(widths, rounding);
    assert!(
        points
            .iter()
            .zip(reference)
            .all(|(a, b)| *a == b.map(i128::from))
    );
    let (unit, commands) = (
        (-(widths.guard() as f64)).exp2(),
        commands(&[record], widths, rounding).collect::<Vec<_>>(),
    );
    let (mut worst, mut last) = (0.0f64, 0.0);
    for (n, (point, command)) in (0..).zip(points.iter().zip(commands)) {
        let exact = on_circle(frame, centre, radius, step * n as f64);
        let error = length(minus(point.map(|x| x as f64 * unit), exact));
        let bound = rotation_error(radius, n, widths, rounding);
        // The exact point is good to a part in 10^14.
        assert!(error <= bound + 1e-14 * radius, "{error} of {bound} at {n}");
        let rounded = length(minus(command.map(|x| x as f64), exact));
        assert!(rounded <= command_error(radius, n, widths, rounding) + 1e-14 * radius);
        last = error / bound;
        worst = worst.max(last);
    }
    [worst, last]
}

fn roundings() -> impl Strategy<Value = Rounding> {
    prop_oneof![Just(Rounding::Nearest), Just(Rounding::Floor)]
}

/// Radius from 10 counts to 2^22, a step from 0.0005 to 0.5, up to two turns.
fn turns() -> impl Strategy<Value = (f64, f64, u64)> {
    let radius = (10f64.ln()..22.0 * 2f64.ln()).prop_map(f64::exp);
    let step = (0.0005f64.ln()..0.5f64.ln()).prop_map(f64::exp);
    (radius, step, 0.01..2.0f64)
        .prop_map(|(radius, step, turns)| (radius, step, (turns * TAU / step).ceil() as u64))
}

#[test]
fn every_arc_is_within_its_bound() {
    let worst = [Cell::new([0f64; 2]), Cell::new([0f64; 2])];
    let centre = proptest::array::uniform3(-2e6..2e6f64);
    let mut runner = proptest::test_runner::TestRunner::new(ProptestConfig {
        cases: 400,
        source_file: Some(file!()),
        ..ProptestConfig::default()
    });
    let cases = (frames(), centre, turns(), roundings());
    let outcome = runner.run(
        &cases,
        |(frame, centre, (radius, step, steps), rounding)| {
            let (arc, turn) = ((centre, radius), (step, steps));
            let part = part_of_bound(frame, arc, turn, &Widths::FULL, rounding);
            let worst = &worst[usize::from(rounding == Rounding::Floor)];
            let so_far = worst.get();
            worst.set([0, 1].map(|k| so_far[k].max(part[k])));
            Ok(())
        },
    );
    outcome.unwrap();
    // The bound adds what rounding mostly adds at random: it is loose, but not absurdly.
    let [nearest, floor] = worst.map(Cell::into_inner);
    println!("largest part of the bound, on the way and at the end: {nearest:?}, {floor:?} floor");
    assert!(nearest[1] > 0.1 && floor[1] > 0.2, "{nearest:?} {floor:?}");
}

/// Share of the bound that a whole turn reaches, for radii and steps of several sizes.
#[test]
fn a_whole_turn_stays_within_its_bound() {
    // Tilted, so that no coefficient is a round number.
    let u = [2.0 / 3.0, -2.0 / 3.0, 1.0 / 3.0];
    let v = [1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0];
    let w = [-2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0];
    for radius in [10.0, 1e3, 1e5, 4e6] {
        for steps in [13, 126, 1257, 12567] {
            for rounding in [Rounding::Nearest, Rounding::Floor] {
                let (arc, turn) = (([7.3, -1.9, 5.5], radius), (TAU / steps as f64, steps));
                let [part, last] = part_of_bound([u, v, w], arc, turn, &Widths::FULL, rounding);
                let bound = rotation_error(radius, steps, &Widths::FULL, rounding);
                println!("{radius:>8} {steps:>5} {rounding:?} {bound:.6} {part:.3} {last:.3}");
            }
        }
    }
}

#[test]
fn small_words_stay_within_their_bound() {
    let [u, v, w] = [[1.0, 0.0, 0.0], [0.0, 0.6, 0.8], [0.0, -0.8, 0.6]];
    for radius in [10.0, 33.3, 60.0] {
        for steps in [5, 20, 60] {
            for rounding in [Rounding::Nearest, Rounding::Floor] {
                let step = TAU / 60.0;
                let arc = ([0.0, 1.0, -2.0], radius);
                part_of_bound([u, v, w], arc, (step, steps), &Widths::narrow(8), rounding);
            }
        }
    }
}

#[test]
fn the_bound_is_what_its_derivation_says() {
    // n·(3r·2^-(B+1) + √3·2^-(G+1)) in first order, and the ends.
    let first = |r: f64, n: f64| n * (3.0 * r * 2f64.powi(-41) + 3f64.sqrt() * 2f64.powi(-17));
    let ends = 3.0 * 3f64.sqrt() * 2f64.powi(-17);
    for (radius, steps) in [(10.0, 1), (1e4, 1000), (4e6, 100_000)] {
        let bound = rotation_error(radius, steps, &Widths::FULL, Rounding::Nearest);
        let order = first(radius, steps as f64) + ends;
        assert!(bound >= order && bound < order * 1.01, "{bound} {order}");
    }
    assert!(rotation_error(1e4, 1000, &Widths::FULL, Rounding::Floor) > 0.02);
}

proptest! {
    #[test]
    fn coarse_coefficients_stay_within_their_bound(
        frame in frames(),
        coefficient in 12usize..30,
        (radius, step, steps) in turns(),
        rounding in roundings(),
    ) {
        // Here coefficients are off by more than points: the other half of the bound.
        let widths = Widths { coefficient, position: 30, point: 46, ..Widths::FULL };
        let steps = steps.min(2000);
        let bound = rotation_error(radius, steps, &widths, rounding);
        prop_assume!(bound < 0.1 * radius);
        part_of_bound(frame, ([0.0; 3], radius), (step, steps), &widths, rounding);
    }
}
