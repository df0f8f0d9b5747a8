//! Curves as chords, for what is no line and no arc in the X-Y plane.

use std::f64::consts::TAU;

use crate::input::Point;

/// How far chords may be off their curve, in millimetres.
pub(super) const OFF_MM: f64 = 0.001;

/// The most chords of one curve.
const MOST: f64 = 1.0e5;

fn steps(wanted: f64) -> u32 {
    wanted.ceil().clamp(1.0, MOST) as u32
}

/// How many chords an arc needs.
fn arc_steps(radius: f64, angle: f64) -> u32 {
    let widest = 2.0 * (1.0 - (OFF_MM / radius).min(1.0)).acos();
    steps(angle.abs() / widest)
}

/// An arc about a centre, in the plane of two axes, as the ends of its chords. The third axis and
/// the radius change in proportion to the angle.
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
    let count = arc_steps(first.max(last), angle);
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

/// The angle from a start to an end about a centre: above 0 and at most a turn counter-clockwise,
/// below it clockwise.
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

/// A cubic Bézier curve in X and Y, as the ends of its chords.
pub(super) fn cubic(points: [[f64; 2]; 4], mut push: impl FnMut([f64; 2])) {
    let [p, q, r, s] = points;
    let bend = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
        (a[0] - 2.0 * b[0] + c[0]).hypot(a[1] - 2.0 * b[1] + c[1])
    };
    // A chord over 1/n is off by an eighth of the second derivative, over n squared, at most.
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
        // Halfway between two ends by the curve itself.
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
}
