//! Blends and lines by products, against the exact quartic and the bound.

use super::*;
use motion_rtl::circuits::arc_generator::{Blend, Rounding, Widths};
use motion_rtl::jobs::arc_generator::bounds::product_error;
use motion_rtl::jobs::arc_generator::products::{commands, points, records};
use motion_rtl::jobs::arc_generator::{record, reference};

const FULL: Widths = Blend::Products.widths(Widths::FULL);
/// Farthest corner in guard units.
const REACH: i64 = (1 << 39) - (1 << 16);

/// A millimetre is a guard unit.
fn unit() -> f64 {
    (-(FULL.guard() as f64)).exp2()
}

fn made(shape: Shape, samples: u64) -> Vec<[i64; 3]> {
    let path = single(shape, samples);
    let records = records(&path, unit(), &FULL, Rounding::Nearest).unwrap();
    points(&records[0], &FULL, Rounding::Nearest).collect()
}

fn mm(point: [i64; 3]) -> Point {
    point.map(|units| units as f64)
}

fn corner() -> impl Strategy<Value = [i64; 3]> {
    proptest::array::uniform3(-REACH..REACH)
}

proptest! {
    #[test]
    #[ignore = "takes long"]
    fn blends_are_within_the_bound_and_end_exactly(
        before in corner(),
        at in corner(),
        behind in corner(),
        samples in prop_oneof![2u64..50, 1000u64..1100, Just(30_000), Just((1 << 20) - 2)],
    ) {
        let [a, b, c] = [before, at, behind].map(mm);
        let found = made(Shape::Blend { before: a, corner: b, behind: c }, samples);
        let m = i128::from(samples);
        let bound = 0.5 + product_error(&FULL) / unit();
        // The largest error can be anywhere: a sample of many points.
        let every = (samples / 500).max(1);
        for n in (0..=samples).step_by(every as usize).chain([samples]) {
            for k in 0..3 {
                let [a, b, c] = [before, at, behind].map(|point| i128::from(point[k]));
                let i = i128::from(n);
                let way = 2 * (b - a) * i * m.pow(3) + (a - 2 * b + c) * (2 * m - i) * i.pow(3);
                let off = (i128::from(found[n as usize][k]) - a) * m.pow(4) - way;
                prop_assert!(off.abs() as f64 / m.pow(4) as f64 <= bound, "{} of {}", n, samples);
            }
        }
        prop_assert_eq!((found[0], found[samples as usize]), (before, behind));
    }

    #[test]
    fn lines_are_straight_and_end_exactly(from in corner(), to in corner(), samples in 1u64..3000) {
        let found = made(Shape::Line { from: mm(from), to: mm(to) }, samples);
        let bound = 0.5 + product_error(&FULL) / unit();
        for (n, point) in (0..).zip(&found) {
            for k in 0..3 {
                let way = i128::from(to[k]) - i128::from(from[k]);
                let off = i128::from(point[k] - from[k]) * i128::from(samples) - way * n;
                prop_assert!(off.abs() as f64 / samples as f64 <= bound, "{}", n);
            }
        }
        prop_assert_eq!(found[samples as usize], to);
    }
}

#[test]
fn commands_are_those_of_differences_and_arcs_are_the_same() {
    let pieces = [
        line([21.7, 0.4, 3.1], 37.0),
        arc([21.7, 0.4, 3.1], [28.0, 2.0, 3.0], [30.1, 9.9, 3.3], 23.0),
        line([30.0, 60.0, 22.0], 11.0),
    ];
    let path = motion_rtl::jobs::arc_generator::prepare::prepare([0.0; 3], &pieces, &timing(64));
    let path = path.unwrap();
    let nearest = Rounding::Nearest;
    let own = records(&path, 1000.0, &FULL, nearest).unwrap();
    let others = record::records(&path, 1000.0, &Widths::FULL, nearest).unwrap();
    let others_commands = reference::commands(&others, &Widths::FULL, nearest);
    assert!(commands(&own, &FULL, nearest).eq(others_commands));
    for (segment, (own, other)) in path.segments.iter().zip(own.iter().zip(&others)) {
        let is_arc = matches!(segment.shape, Shape::Arc { .. });
        assert_eq!(own == other, is_arc);
        assert_eq!(own.words[0], other.words[0]);
    }
}
