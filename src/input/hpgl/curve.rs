//! Approximation of arcs, circles and Bézier curves by chords. Points are in any unit.

/// Meaning of a chord angle (CT).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Tolerance {
    /// Angle in degrees.
    #[default]
    Angle,
    /// Greatest distance of a chord from its arc.
    Deviation,
}

/// Default chord angle in degrees.
const DEFAULT_CHORD_DEG: f64 = 5.0;

/// Least and greatest chord angle in degrees.
const CHORDS_DEG: [f64; 2] = [0.5, 180.0];

impl Tolerance {
    /// Returns the chord angle in degrees for the parameter of an instruction.
    pub(super) fn chord_deg(self, given: Option<f64>, radius: f64) -> f64 {
        let angle = match (self, given) {
            (_, None) => DEFAULT_CHORD_DEG,
            (Tolerance::Angle, Some(angle)) => angle.abs(),
            (Tolerance::Deviation, Some(_)) if radius == 0.0 => DEFAULT_CHORD_DEG,
            (Tolerance::Deviation, Some(deviation)) => {
                let cosine = 1.0 - (deviation / radius).abs();
                2.0 * cosine.clamp(-1.0, 1.0).acos().to_degrees()
            }
        };
        let [least, most] = CHORDS_DEG;
        angle.clamp(least, most)
    }
}

/// Part of a circle, anticlockwise for a positive angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Arc {
    pub(super) centre: [f64; 2],
    pub(super) start: [f64; 2],
    pub(super) sweep_deg: f64,
}

impl Arc {
    /// Creates an arc from a radius and its start angle.
    pub(super) fn around(centre: [f64; 2], radius: f64, start_deg: f64, sweep_deg: f64) -> Self {
        let [x, y] = centre;
        let [sin, cos] = sin_cos_deg(start_deg);
        Arc {
            centre,
            start: [x + radius * cos, y + radius * sin],
            sweep_deg,
        }
    }

    /// Creates an arc through three points; `None` if they are on a line. An end equal to the
    /// start gives a full circle, with the point between on the opposite side.
    pub(super) fn through(start: [f64; 2], between: [f64; 2], end: [f64; 2]) -> Option<Self> {
        let [bx, by] = [between[0] - start[0], between[1] - start[1]];
        let [cx, cy] = [end[0] - start[0], end[1] - start[1]];
        if (cx, cy) == (0.0, 0.0) && (bx, by) != (0.0, 0.0) {
            return Some(Arc {
                centre: [start[0] + bx / 2.0, start[1] + by / 2.0],
                start,
                sweep_deg: 360.0,
            });
        }
        let cross = bx * cy - by * cx;
        let (b, c) = (bx * bx + by * by, cx * cx + cy * cy);
        let [ox, oy] = [cy * b - by * c, bx * c - cx * b].map(|value| value / (2.0 * cross));
        if !(ox.is_finite() && oy.is_finite()) {
            return None;
        }
        let angle = |x: f64, y: f64| (y - oy).atan2(x - ox).to_degrees();
        let turn = (angle(cx, cy) - angle(0.0, 0.0)).rem_euclid(360.0);
        Some(Arc {
            centre: [start[0] + ox, start[1] + oy],
            start,
            // Anticlockwise if the point between is on the right of the line to the end.
            sweep_deg: if cross > 0.0 { turn } else { turn - 360.0 },
        })
    }

    pub(super) fn radius(&self) -> f64 {
        (self.start[0] - self.centre[0]).hypot(self.start[1] - self.centre[1])
    }

    /// Returns the ends of its chords, all of equal angle, at most the given one.
    pub(super) fn chords(self, chord_deg: f64) -> impl Iterator<Item = [f64; 2]> {
        // Prevents rounding from adding a chord.
        let count = (self.sweep_deg.abs() / chord_deg - 1e-9).ceil();
        let [x, y] = self.centre;
        let [dx, dy] = [self.start[0] - x, self.start[1] - y];
        let turns = self.sweep_deg != 0.0;
        let whole = self.sweep_deg % 360.0 == 0.0;
        let count = if turns { count.max(1.0) as u64 } else { 0 };
        (1..=count).map(move |k| {
            if k == count && whole {
                return self.start;
            }
            let part = k as f64 / count as f64;
            let [sin, cos] = sin_cos_deg(self.sweep_deg * part);
            [x + dx * cos - dy * sin, y + dx * sin + dy * cos]
        })
    }
}

/// Returns sine and cosine of an angle in degrees, exact at right angles.
pub(super) fn sin_cos_deg(angle: f64) -> [f64; 2] {
    match angle.rem_euclid(360.0) {
        0.0 => [0.0, 1.0],
        90.0 => [1.0, 0.0],
        180.0 => [0.0, -1.0],
        270.0 => [-1.0, 0.0],
        angle => angle.to_radians().sin_cos().into(),
    }
}

/// Greatest deviation of a chord from a Bézier curve, in plotter units.
const BEZIER_UNITS: f64 = 0.25;

/// Returns the number of chords of a Bézier curve, from its control points in plotter units.
pub(super) fn bezier_chords(points: [[f64; 2]; 4]) -> u32 {
    let bend = |first: usize| {
        let [a, b, c] = [points[first], points[first + 1], points[first + 2]];
        (a[0] - 2.0 * b[0] + c[0]).hypot(a[1] - 2.0 * b[1] + c[1])
    };
    // A chord over the part h deviates by at most h² / 8 of the second derivative.
    let second_derivative = 6.0 * bend(0).max(bend(1));
    (second_derivative / (8.0 * BEZIER_UNITS))
        .sqrt()
        .ceil()
        .clamp(1.0, 100_000.0) as u32
}

/// Returns a point of a Bézier curve.
pub(super) fn bezier(points: [[f64; 2]; 4], part: f64) -> [f64; 2] {
    let rest = 1.0 - part;
    let weights = [
        rest * rest * rest,
        3.0 * rest * rest * part,
        3.0 * rest * part * part,
        part * part * part,
    ];
    let sum = |axis: usize| {
        let terms = points.iter().zip(weights);
        terms.map(|(point, weight)| point[axis] * weight).sum()
    };
    [sum(0), sum(1)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn near(a: [f64; 2], b: [f64; 2], within: f64) -> bool {
        (a[0] - b[0]).hypot(a[1] - b[1]) <= within
    }

    #[test]
    fn chord_angles_are_taken_or_worked_out() {
        let angle = Tolerance::Angle;
        for (given, chord) in [
            (None, 5.0),
            (Some(10.0), 10.0),
            (Some(-10.0), 10.0),
            (Some(0.0), 0.5),
            (Some(400.0), 180.0),
        ] {
            assert_eq!(angle.chord_deg(given, 100.0), chord);
        }
        let deviation = Tolerance::Deviation;
        // Deviation r (1 - cos 30°): a chord over 60°.
        let off = 100.0 * (1.0 - 0.75f64.sqrt());
        assert!((deviation.chord_deg(Some(off), 100.0) - 60.0).abs() < 1e-9);
        assert_eq!(deviation.chord_deg(Some(500.0), 100.0), 180.0);
        assert_eq!(deviation.chord_deg(Some(0.0), 100.0), 0.5);
        assert_eq!(deviation.chord_deg(Some(1.0), 0.0), 5.0);
        assert_eq!(deviation.chord_deg(None, 100.0), 5.0);
    }

    #[test]
    fn an_arc_has_as_many_chords_as_its_angle_asks_for() {
        let count = |sweep, chord| Arc::around([0.0; 2], 9.0, 0.0, sweep).chords(chord).count();
        for (sweep, chord, chords) in [
            (90.0, 5.0, 18),
            (-91.0, 5.0, 19),
            (360.0, 5.0, 72),
            (3.0, 5.0, 1),
            (0.0, 5.0, 0),
            (0.3, 0.1, 3),
        ] {
            assert_eq!(count(sweep, chord), chords, "{sweep} {chord}");
        }
        let circle = Arc::around([1.0, 2.0], 3.0, 0.0, 360.0);
        assert_eq!(circle.chords(7.0).last(), Some([4.0, 2.0]));
        let quarter = Arc::around([1.0, 2.0], 3.0, 0.0, -90.0);
        assert_eq!(quarter.chords(5.0).last(), Some([1.0, -1.0]));
    }

    #[test]
    fn three_points_on_a_line_have_no_arc() {
        assert_eq!(Arc::through([0.0; 2], [1.0, 1.0], [2.0, 2.0]), None);
        assert_eq!(Arc::through([0.0; 2], [0.0; 2], [0.0; 2]), None);
        assert_eq!(Arc::through([0.0; 2], [0.0; 2], [2.0, 2.0]), None);
        let circle = Arc::through([2.0, 0.0], [6.0, 0.0], [2.0, 0.0]).unwrap();
        assert_eq!(circle.centre, [4.0, 0.0]);
        assert_eq!(circle.sweep_deg, 360.0);
    }

    proptest! {
        #[test]
        fn an_arc_through_three_points_meets_them(
            x in -50.0..50.0f64,
            radius in 1.0..90.0f64,
            start in 0.0..360.0f64,
            sweep in prop_oneof![2.0..355.0f64, -355.0..-2.0f64],
            part in 0.05..0.95f64,
        ) {
            let arc = Arc::around([x, -x], radius, start, sweep);
            let point = |part: f64| {
                Arc::around([x, -x], radius, start + part * sweep, 0.0).start
            };
            let found = Arc::through(arc.start, point(part), point(1.0)).unwrap();
            prop_assert!(near(found.centre, arc.centre, 1e-5 * radius));
            prop_assert!((found.sweep_deg - sweep).abs() < 1e-3, "{found:?}");
            let mut from = found.start;
            for to in found.chords(5.0) {
                prop_assert!(near(to, arc.centre, radius * (1.0 + 1e-5)));
                prop_assert!(near(from, to, 2.0 * radius * 2.5001f64.to_radians().sin()));
                from = to;
            }
            prop_assert!(near(from, point(1.0), 1e-5 * radius));
        }

        #[test]
        fn chords_of_a_bezier_curve_are_near_it(
            corners in proptest::array::uniform8(-4000.0..4000.0f64),
        ) {
            let [a, b, c, d, e, f, g, h] = corners;
            let points = [[a, b], [c, d], [e, f], [g, h]];
            let count = bezier_chords(points);
            let ends = |k: u32| bezier(points, f64::from(k) / f64::from(count));
            prop_assert!(near(ends(0), points[0], 1e-9) && near(ends(count), points[3], 1e-9));
            for k in 0..count {
                let (from, to) = (ends(k), ends(k + 1));
                let curve = bezier(points, (f64::from(k) + 0.5) / f64::from(count));
                let middle = [(from[0] + to[0]) / 2.0, (from[1] + to[1]) / 2.0];
                prop_assert!(near(curve, middle, BEZIER_UNITS + 1e-6));
            }
        }
    }
}
