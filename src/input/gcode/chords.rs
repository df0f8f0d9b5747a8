//! Approximation of curves by chords, for all that are not lines or arcs in the X-Y plane.

use std::f64::consts::TAU;

use super::nurbs::Weighted;
use crate::input::Point;

/// Greatest deviation of a chord from its curve, in millimetres.
pub(super) const OFF_MM: f64 = 0.001;

/// Greatest number of chords of a curve.
const MOST: f64 = 1.0e5;

fn steps(wanted: f64) -> u32 {
    wanted.ceil().clamp(1.0, MOST) as u32
}

/// Returns the number of chords of an arc whose radius changes from one value to another. Beyond
/// the deviation on a circle, a chord deviates by a quarter of its angle times the change of the
/// radius.
fn arc_steps(first: f64, last: f64, angle: f64) -> u32 {
    let angle = angle.abs();
    let widest = 2.0 * (1.0 - (OFF_MM / first.max(last)).min(1.0)).acos();
    steps((angle / widest).hypot((angle * (last - first).abs() / (4.0 * OFF_MM)).sqrt()))
}

/// Approximates an arc about a centre, in the plane of two axes; yields the ends of the chords.
/// The third axis and the radius change in proportion to the angle.
pub(super) fn arc(
    from: Point,
    to: Point,
    centre: [f64; 2],
    angle: f64,
    axes: [usize; 3],
    mut push: impl FnMut(Point),
) {
    let pick = |point: &Point, axis: usize| point.get(axis).copied().unwrap_or(0.0);
    let [a, b, c] = axes;
    let [u, v] = [pick(&from, a) - centre[0], pick(&from, b) - centre[1]];
    let [end_u, end_v] = [pick(&to, a) - centre[0], pick(&to, b) - centre[1]];
    let (first, last) = (u.hypot(v), end_u.hypot(end_v));
    let start = v.atan2(u);
    let count = arc_steps(first, last, angle);
    for step in 1..count {
        let part = f64::from(step) / f64::from(count);
        let (sin, cos) = (start + angle * part).sin_cos();
        let radius = first + (last - first) * part;
        let mut point = from;
        for (axis, value) in [
            (a, centre[0] + radius * cos),
            (b, centre[1] + radius * sin),
            (c, pick(&from, c) + (pick(&to, c) - pick(&from, c)) * part),
        ] {
            if let Some(place) = point.get_mut(axis) {
                *place = value;
            }
        }
        push(point);
    }
    push(to);
}

/// Returns the angle from a start to an end about a centre: above 0 and at most a turn if
/// counter-clockwise, negative if clockwise.
pub(super) fn angle(from: [f64; 2], to: [f64; 2], centre: [f64; 2], clockwise: bool) -> f64 {
    let at = |[u, v]: [f64; 2]| (v - centre[1]).atan2(u - centre[0]);
    let turn = (at(to) - at(from)).rem_euclid(TAU);
    let whole = (from[0] - to[0]).hypot(from[1] - to[1]) < crate::input::ZERO_MM;
    match (clockwise, whole) {
        (false, true) => TAU,
        (true, true) => -TAU,
        (false, false) => turn,
        (true, false) => turn - TAU,
    }
}

/// Approximates a cubic Bézier curve in X and Y; yields the ends of the chords.
pub(super) fn cubic(points: [[f64; 2]; 4], mut push: impl FnMut([f64; 2])) {
    let [p, q, r, s] = points;
    let bend = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
        (a[0] - 2.0 * b[0] + c[0]).hypot(a[1] - 2.0 * b[1] + c[1])
    };
    // A chord over 1/n deviates by at most an eighth of the second derivative, divided by n
    // squared.
    let second = 6.0 * bend(p, q, r).max(bend(q, r, s));
    let count = steps((second / (8.0 * OFF_MM)).sqrt());
    for step in 1..count {
        let t = f64::from(step) / f64::from(count);
        let u = 1.0 - t;
        let weights = [u * u * u, 3.0 * u * u * t, 3.0 * u * t * t, t * t * t];
        let mut at = [0.0; 2];
        for (weight, point) in weights.iter().zip([p, q, r, s]) {
            at[0] += weight * point[0];
            at[1] += weight * point[1];
        }
        push(at);
    }
    push(s);
}

/// Greatest number of halvings of a NURBS span.
const HALVINGS: u32 = 12;

/// Approximates a NURBS; yields its start and the ends of the chords. The number of control points
/// must be at least the order, the number of knots the sum of both, and knots must not decrease.
pub(super) fn nurbs(
    points: &[Weighted],
    knots: &[f64],
    order: usize,
    mut push: impl FnMut([f64; 2]),
) {
    let mut first = true;
    for span in order - 1..points.len() {
        let (begin, end) = (knots[span], knots[span + 1]);
        if begin >= end {
            continue;
        }
        let at = |part: f64| on_nurbs(points, knots, order, span, begin + (end - begin) * part);
        if std::mem::take(&mut first) {
            push(at(0.0));
        }
        halve((0.0, at(0.0)), (1.0, at(1.0)), HALVINGS, &at, &mut push);
    }
}

/// Yields the ends of chords between two points of a curve, which is halved until points between
/// are close enough.
fn halve(
    from: (f64, [f64; 2]),
    to: (f64, [f64; 2]),
    left: u32,
    at: &impl Fn(f64) -> [f64; 2],
    push: &mut impl FnMut([f64; 2]),
) {
    let between = |part: f64| from.0 + (to.0 - from.0) * part;
    // Unevenly spaced, so that a bend to either side is not missed. Half the tolerance, since the
    // largest deviation is between them.
    let off = [0.2, 0.45, 0.75].map(|part| off_chord(from.1, to.1, at(between(part))));
    if left == 0 || (left < HALVINGS && off.into_iter().all(|off| off <= OFF_MM / 2.0)) {
        push(to.1);
        return;
    }
    let middle = (between(0.5), at(between(0.5)));
    halve(from, middle, left - 1, at, push);
    halve(middle, to, left - 1, at, push);
}

/// Returns the distance of a point from a chord.
fn off_chord([x0, y0]: [f64; 2], [x1, y1]: [f64; 2], [x, y]: [f64; 2]) -> f64 {
    let (u, v) = (x1 - x0, y1 - y0);
    let square = u * u + v * v;
    let part = match square > 0.0 {
        true => (((x - x0) * u + (y - y0) * v) / square).clamp(0.0, 1.0),
        false => 0.0,
    };
    (x - x0 - u * part).hypot(y - y0 - v * part)
}

/// Returns a point of a NURBS at a parameter within a span of its knots, by de Boor's algorithm.
fn on_nurbs(points: &[Weighted], knots: &[f64], order: usize, span: usize, u: f64) -> [f64; 2] {
    let first = span + 1 - order;
    let mut sums: Vec<[f64; 3]> = points[first..=span]
        .iter()
        .map(|Weighted { at: [x, y], weight }| [x * weight, y * weight, *weight])
        .collect();
    for round in 1..order {
        for index in (round..order).rev() {
            let low = knots[first + index];
            let high = knots[first + index + order - round];
            let part = (u - low) / (high - low);
            let before = sums[index - 1];
            for (sum, before) in sums[index].iter_mut().zip(before) {
                *sum = (1.0 - part) * before + part * *sum;
            }
        }
    }
    let [x, y, weight] = sums[order - 1];
    [x / weight, y / weight]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn chords_stay_within_the_tolerance_and_are_few() {
        for radius in [0.01, 1.0, 10.0, 300.0] {
            let (mut last, mut worst, mut count) = ([radius, 0.0, 0.0], 0.0_f64, 0);
            arc(
                last,
                [-radius, 0.0, 4.0],
                [0.0; 2],
                PI,
                [0, 1, 2],
                |to: Point| {
                    let middle = ((last[0] + to[0]) / 2.0).hypot((last[1] + to[1]) / 2.0);
                    worst = worst.max(radius - middle);
                    assert!((to[0].hypot(to[1]) - radius).abs() < 1e-9);
                    (last, count) = (to, count + 1);
                },
            );
            assert!(worst <= OFF_MM * 1.000_001, "{radius}: {worst}");
            assert!(worst > OFF_MM / 2.0 || count < 4, "{radius}: {worst}");
            assert_eq!(last, [-radius, 0.0, 4.0]);
        }
    }

    #[test]
    fn chords_stay_within_the_tolerance_where_the_radius_changes() {
        for (first, last, angle) in [(0.02, 0.09, 0.5), (0.1, 0.17, 0.3), (5.0, 5.07, TAU)] {
            let on = |part: f64| {
                let (sin, cos) = (angle * part).sin_cos();
                let radius = first + (last - first) * part;
                [radius * cos, radius * sin, 0.0]
            };
            let mut ends = vec![on(0.0)];
            arc(on(0.0), on(1.0), [0.0; 2], angle, [0, 1, 2], |to| {
                ends.push(to)
            });
            let count = (ends.len() - 1) as f64;
            let mut worst = 0.0_f64;
            for (step, pair) in ends.windows(2).enumerate() {
                let [x, y, _] = on((step as f64 + 0.5) / count);
                let ([a, b, _], [c, d, _]) = (pair[0], pair[1]);
                let area = (c - a) * (y - b) - (d - b) * (x - a);
                worst = worst.max(area.abs() / (c - a).hypot(d - b));
            }
            assert!(worst <= OFF_MM && worst > OFF_MM / 4.0, "{first}: {worst}");
        }
    }

    #[test]
    fn angles_turn_the_given_way() {
        let angle = |to, clockwise| angle([1.0, 0.0], to, [0.0; 2], clockwise);
        assert!((angle([0.0, 1.0], false) - FRAC_PI_2).abs() < 1e-12);
        assert!((angle([0.0, 1.0], true) + 1.5 * PI).abs() < 1e-12);
        assert!((angle([1.0, 0.0], false) - TAU).abs() < 1e-12);
        assert!((angle([1.0, 0.0], true) + TAU).abs() < 1e-12);
    }

    #[test]
    fn a_cubic_ends_at_its_end_and_stays_close() {
        let points = [[0.0, 0.0], [0.0, 40.0], [30.0, 40.0], [30.0, 0.0]];
        let mut ends = vec![[0.0, 0.0]];
        cubic(points, |to| ends.push(to));
        assert_eq!(ends.last(), Some(&[30.0, 0.0]));
        // Halfway between two ends on the exact curve.
        let exact = |t: f64| {
            let u = 1.0 - t;
            [
                90.0 * u * t * t + 30.0 * t * t * t,
                120.0 * u * u * t + 120.0 * u * t * t,
            ]
        };
        let count = ends.len() - 1;
        for (step, pair) in ends.windows(2).enumerate() {
            let [x, y] = exact((step as f64 + 0.5) / count as f64);
            let [a, b] = [pair[0], pair[1]];
            let off = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])).abs()
                / (b[0] - a[0]).hypot(b[1] - a[1]);
            assert!(off <= OFF_MM, "{off}");
        }
    }

    fn weighted<const N: usize>(points: [[f64; 3]; N]) -> [Weighted; N] {
        points.map(|[x, y, weight]| Weighted { at: [x, y], weight })
    }

    #[test]
    fn a_nurbs_of_weights_is_a_circle() {
        // A quarter circle by one span, and a full circle by four with double knots.
        let half = 0.5_f64.sqrt();
        let quarter = weighted([[10.0, 0.0, 1.0], [10.0, 10.0, half], [0.0, 10.0, 1.0]]);
        let full = weighted([
            [10.0, 0.0, 1.0],
            [10.0, 10.0, half],
            [0.0, 10.0, 1.0],
            [-10.0, 10.0, half],
            [-10.0, 0.0, 1.0],
            [-10.0, -10.0, half],
            [0.0, -10.0, 1.0],
            [10.0, -10.0, half],
            [10.0, 0.0, 1.0],
        ]);
        let quarter_knots = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
        let full_knots = [0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0];
        for (points, knots, end, length) in [
            (
                &quarter[..],
                &quarter_knots[..],
                [0.0, 10.0],
                FRAC_PI_2 * 10.0,
            ),
            (&full, &full_knots, [10.0, 0.0], TAU * 10.0),
        ] {
            let (mut path, mut sum) = (Vec::new(), 0.0);
            nurbs(points, knots, 3, |to| path.push(to));
            assert_eq!(path.first(), Some(&[10.0, 0.0]));
            for pair in path.windows(2) {
                let [[x0, y0], [x1, y1]] = [pair[0], pair[1]];
                assert!((x1.hypot(y1) - 10.0).abs() < 1e-9);
                let middle = ((x0 + x1) / 2.0).hypot((y0 + y1) / 2.0);
                assert!(10.0 - middle <= OFF_MM, "{middle}");
                sum += (x1 - x0).hypot(y1 - y0);
            }
            let last = path.last().unwrap();
            assert!((last[0] - end[0]).hypot(last[1] - end[1]) < 1e-9);
            assert!((sum - length).abs() < 0.01, "{sum}");
        }
    }

    #[test]
    fn a_nurbs_with_the_knots_of_a_bezier_curve_is_that_curve() {
        let points = [[0.0, 0.0], [0.0, 40.0], [30.0, -40.0], [30.0, 0.0]];
        let weighted = points.map(|at| Weighted { at, weight: 2.5 });
        let knots = [0.0, 0.0, 0.0, 0.0, 5.0, 5.0, 5.0, 5.0];
        for step in 0..=16 {
            let t = f64::from(step) / 16.0;
            let u = 1.0 - t;
            let weights = [u * u * u, 3.0 * u * u * t, 3.0 * u * t * t, t * t * t];
            let exact = [0, 1].map(|axis| {
                let parts = weights.iter().zip(points);
                parts
                    .map(|(weight, point)| weight * point[axis])
                    .sum::<f64>()
            });
            let [x, y] = on_nurbs(&weighted, &knots, 4, 3, 5.0 * t);
            assert!((x - exact[0]).hypot(y - exact[1]) < 1e-9, "{t}");
        }
        // Bends to both sides of its chord.
        let mut ends = Vec::new();
        nurbs(&weighted, &knots, 4, |to| ends.push(to));
        assert!(ends.len() > 50, "{}", ends.len());
    }
}
