//! Cubic curve in space, and smooth cubic splines through points.

use super::vector::{add, distance, dot, norm, scale, sub, unit};
use crate::input::{COORDINATES, Point};

/// Length of a derivative, relative to the longest control vector, below which it has no
/// direction.
const NONE: f64 = 1e-9;

/// Nodes and weights of the Gauss-Legendre quadrature on −1 … 1; the other halves are mirrored.
const GAUSS: [[f64; 2]; 4] = [
    [0.183_434_642_495_649_8, 0.362_683_783_378_362],
    [0.525_532_409_916_329, 0.313_706_645_877_887_3],
    [0.796_666_477_413_626_7, 0.222_381_034_453_374_48],
    [0.960_289_856_497_536_3, 0.101_228_536_290_376_26],
];

/// Cubic Bézier curve by its control points; it begins at the first and ends at the last.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cubic {
    /// Control points in mm.
    pub points: [Point; 4],
}

impl Cubic {
    /// Returns the point at a parameter, 0 to 1.
    #[must_use]
    pub fn point(&self, t: f64) -> Point {
        let u = 1.0 - t;
        let weights = [u * u * u, 3.0 * u * u * t, 3.0 * u * t * t, t * t * t];
        std::array::from_fn(|k| (0..4).map(|of| weights[of] * self.points[of][k]).sum())
    }

    /// Returns the derivative by the parameter.
    #[must_use]
    pub fn derivative(&self, t: f64) -> Point {
        let u = 1.0 - t;
        let [a, b, c] = self.ways();
        let sum = add(scale(a, u * u), scale(b, 2.0 * u * t));
        scale(add(sum, scale(c, t * t)), 3.0)
    }

    /// Returns the vectors from each control point to the next.
    fn ways(&self) -> [Point; 3] {
        std::array::from_fn(|k| sub(self.points[k + 1], self.points[k]))
    }

    /// Returns the unit direction of motion just after a parameter, or with `before` just before
    /// it. If the derivative is zero, the next nonzero one gives the direction.
    #[must_use]
    pub fn direction(&self, t: f64, before: bool) -> Point {
        let [a, b, c] = self.ways();
        let back = if before { -1.0 } else { 1.0 };
        let second = add(scale(sub(b, a), 1.0 - t), scale(sub(c, b), t));
        let third = add(sub(c, b), sub(a, b));
        let longest = [a, b, c].map(norm).into_iter().fold(0.0, f64::max);
        let directions = [self.derivative(t), scale(second, back), third];
        let found = directions.into_iter().find(|of| norm(*of) > NONE * longest);
        unit(found.unwrap_or(third))
    }

    /// Returns the lengths from a parameter to the ends of four equal parts up to another, by
    /// quadrature.
    #[must_use]
    pub fn lengths(&self, from: f64, to: f64) -> [f64; 4] {
        let half = (to - from) / 8.0;
        let mut length = 0.0;
        std::array::from_fn(|part| {
            let middle = from + half * (2.0 * part as f64 + 1.0);
            let speed = |at: f64| norm(self.derivative(at));
            let both = |node: f64| speed(middle - half * node) + speed(middle + half * node);
            length += half
                * GAUSS
                    .map(|[node, weight]| weight * both(node))
                    .iter()
                    .sum::<f64>();
            length
        })
    }

    /// Returns the length in mm.
    #[must_use]
    pub fn length(&self) -> f64 {
        let parts = (0..16).map(|part| [part, part + 1].map(|at| f64::from(at) / 16.0));
        parts.map(|[from, to]| self.lengths(from, to)[3]).sum()
    }

    /// Returns least and greatest value of each coordinate.
    #[must_use]
    pub fn extremes(&self) -> [[f64; 2]; COORDINATES] {
        let [a, b, c] = self.ways();
        std::array::from_fn(|k| {
            // Roots of a·(1 − t)² + 2b·t(1 − t) + c·t², in the form without cancellation.
            let (square, half) = (a[k] - 2.0 * b[k] + c[k], b[k] - a[k]);
            let root = (half * half - square * a[k]).max(0.0).sqrt();
            let sum = -(half + root.copysign(half));
            let turns = [sum / square, a[k] / sum]
                .into_iter()
                .filter(|t| (0.0..=1.0).contains(t));
            let ends = [self.points[0][k], self.points[3][k]];
            let all = turns.map(|t| self.point(t)[k]).chain(ends);
            let start = [f64::INFINITY, f64::NEG_INFINITY];
            all.fold(start, |[low, high], at| [low.min(at), high.max(at)])
        })
    }

    /// Returns the point of the curve nearest to a point, among those at which the distance is
    /// extreme, one in each of 64 parts.
    #[must_use]
    pub fn nearest(&self, point: Point) -> Point {
        let ahead = |t: f64| dot(sub(self.point(t), point), self.derivative(t));
        let turns = rises([0.0, 1.0], 64, ahead).map(|t| self.point(t));
        nearest(point, self.points[3], turns)
    }

    /// Returns the curve through two or more points, none equal to the one before: a cubic between
    /// each pair. The parameter is the chord length. At each inner point the first and second
    /// derivatives by it are continuous, and so are direction and curvature. If the last point
    /// equals the first and there are at least three spans, they are continuous there too;
    /// otherwise the curvature is 0 at both ends.
    #[must_use]
    pub fn through(points: &[Point]) -> Vec<Self> {
        let spans = points.len().saturating_sub(1);
        let chord = |k: usize| distance(points[k], points[k + 1]);
        let slope = |k: usize| scale(sub(points[k + 1], points[k]), 1.0 / chord(k));
        let closed = spans >= 3 && points[0] == points[spans];
        let mut at: Vec<Point> = vec![[0.0; COORDINATES]; points.len()];
        // The sum of a row's other coefficients is half its own: each round halves the error of
        // the derivatives.
        for _ in 0..64 {
            for k in 0..=spans {
                let (before, behind) = match k {
                    0 if closed => (spans - 1, 0),
                    _ if k == spans && closed => (spans - 1, 0),
                    0 => {
                        at[0] = scale(sub(scale(slope(0), 3.0), at[1]), 0.5);
                        continue;
                    }
                    _ if k == spans => {
                        at[k] = scale(sub(scale(slope(k - 1), 3.0), at[k - 1]), 0.5);
                        continue;
                    }
                    _ => (k - 1, k),
                };
                let (one, other) = (1.0 / chord(before), 1.0 / chord(behind));
                let slopes = add(scale(slope(before), one), scale(slope(behind), other));
                let near = add(scale(at[before], one), scale(at[behind + 1], other));
                at[k] = scale(sub(scale(slopes, 3.0), near), 0.5 / (one + other));
            }
        }
        let cubic = |k: usize| {
            let third = chord(k) / 3.0;
            let (from, to) = (points[k], points[k + 1]);
            let control = [
                add(from, scale(at[k], third)),
                sub(to, scale(at[k + 1], third)),
            ];
            Cubic {
                points: [from, control[0], control[1], to],
            }
        };
        (0..spans).map(cubic).collect()
    }
}

/// Returns the one of some points that is nearest to a point.
pub(crate) fn nearest(point: Point, first: Point, others: impl Iterator<Item = Point>) -> Point {
    let off = |at: &Point| distance(*at, point);
    others.fold(first, |best, at| match off(&at) < off(&best) {
        true => at,
        false => best,
    })
}

/// Returns [`rise`] in each of `parts` parts between two numbers.
pub(crate) fn rises(
    [from, to]: [f64; 2],
    parts: u32,
    of: impl Fn(f64) -> f64,
) -> impl Iterator<Item = f64> {
    let end = move |at: u32| from + (to - from) * f64::from(at) / f64::from(parts);
    (0..parts).map(move |part| rise([part, part + 1].map(end), &of))
}

/// Returns the position between two numbers at which a function rises through zero, or one of them
/// if it does not.
pub(crate) fn rise([mut from, mut to]: [f64; 2], of: impl Fn(f64) -> f64) -> f64 {
    if of(from) >= 0.0 {
        return from;
    }
    if of(to) <= 0.0 {
        return to;
    }
    for _ in 0..64 {
        let middle = f64::midpoint(from, to);
        match of(middle) < 0.0 {
            true => from = middle,
            false => to = middle,
        }
    }
    to
}
