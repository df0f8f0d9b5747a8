//! A cubic curve in space, and the smooth curve of cubics through points.

use super::vector::{add, distance, dot, norm, scale, sub, unit};
use crate::input::{COORDINATES, Point};

/// A derivative shorter than this part of the longest control vector has no direction of its own.
const NONE: f64 = 1e-9;

/// Nodes and weights of Gauss and Legendre on −1 … 1, of which the other halves are mirrored.
const GAUSS: [[f64; 2]; 4] = [
    [0.183_434_642_495_649_8, 0.362_683_783_378_362],
    [0.525_532_409_916_329, 0.313_706_645_877_887_3],
    [0.796_666_477_413_626_7, 0.222_381_034_453_374_48],
    [0.960_289_856_497_536_3, 0.101_228_536_290_376_26],
];

/// A cubic curve by its control points in Bézier's form: it begins at the first and ends at the last.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cubic {
    /// In mm.
    pub points: [Point; 4],
}

impl Cubic {
    /// The point at a parameter, 0 to 1.
    #[must_use]
    pub fn point(&self, t: f64) -> Point {
        let u = 1.0 - t;
        let weights = [u * u * u, 3.0 * u * u * t, 3.0 * u * t * t, t * t * t];
        std::array::from_fn(|k| (0..4).map(|of| weights[of] * self.points[of][k]).sum())
    }

    /// The derivative by the parameter.
    #[must_use]
    pub fn derivative(&self, t: f64) -> Point {
        let u = 1.0 - t;
        let [a, b, c] = self.ways();
        let sum = add(scale(a, u * u), scale(b, 2.0 * u * t));
        scale(add(sum, scale(c, t * t)), 3.0)
    }

    /// From each control point to the next.
    fn ways(&self) -> [Point; 3] {
        std::array::from_fn(|k| sub(self.points[k + 1], self.points[k]))
    }

    /// Direction of motion just behind a parameter, or just before it, of length 1; where the
    /// derivative is zero that of the next one that is not.
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

    /// Length between two parameters, by quadrature in four parts: where each of them ends.
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

    /// Length in mm.
    #[must_use]
    pub fn length(&self) -> f64 {
        let parts = (0..16).map(|part| [part, part + 1].map(|at| f64::from(at) / 16.0));
        parts.map(|[from, to]| self.lengths(from, to)[3]).sum()
    }

    /// Least and largest value of each coordinate.
    #[must_use]
    pub fn extremes(&self) -> [[f64; 2]; COORDINATES] {
        let [a, b, c] = self.ways();
        std::array::from_fn(|k| {
            // Where a·(1 − t)² + 2b·t(1 − t) + c·t² is 0, by the form that does not cancel.
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

    /// The point of it that is nearest to a point, among those where its distance turns in one of
    /// 64 parts.
    #[must_use]
    pub fn nearest(&self, point: Point) -> Point {
        let ahead = |t: f64| dot(sub(self.point(t), point), self.derivative(t));
        let turns = rises([0.0, 1.0], 64, ahead).map(|t| self.point(t));
        nearest(point, self.points[3], turns)
    }

    /// The curve through points, of which there are two or more and none is the one before it: a
    /// cubic between each and the next. The parameter is the length of the chords, and at each inner
    /// point both derivatives by it meet, so that direction and curvature do. Where the last
    /// point is the first, and there are three spans or more, that is so there too; else the
    /// curvature is 0 at both ends.
    #[must_use]
    pub fn through(points: &[Point]) -> Vec<Self> {
        let spans = points.len().saturating_sub(1);
        let chord = |k: usize| distance(points[k], points[k + 1]);
        let slope = |k: usize| scale(sub(points[k + 1], points[k]), 1.0 / chord(k));
        let closed = spans >= 3 && points[0] == points[spans];
        let mut at: Vec<Point> = vec![[0.0; COORDINATES]; points.len()];
        // The sum of a row's other coefficients is half its own: each round takes half of what the
        // derivatives are off.
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

/// The point of some that is nearest to a point.
pub(crate) fn nearest(point: Point, first: Point, others: impl Iterator<Item = Point>) -> Point {
    let off = |at: &Point| distance(*at, point);
    others.fold(first, |best, at| match off(&at) < off(&best) {
        true => at,
        false => best,
    })
}

/// [`rise`] in each of so many parts between two numbers.
pub(crate) fn rises(
    [from, to]: [f64; 2],
    parts: u32,
    of: impl Fn(f64) -> f64,
) -> impl Iterator<Item = f64> {
    let end = move |at: u32| from + (to - from) * f64::from(at) / f64::from(parts);
    (0..parts).map(move |part| rise([part, part + 1].map(end), &of))
}

/// Where a function goes from below to above zero between two numbers, if it does; one of them if
/// not.
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
