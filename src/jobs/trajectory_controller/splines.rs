//! Conversion of a spline to segments: cubics of the length that are short enough to approximate
//! it.
//!
//! The parameter of a cubic curve is not its length. Between two points that are close enough, the
//! cubic *of the length* with the same ends and directions is the same curve except for a fourth
//! power of the length l between them: l⁴/384r³ at a radius r. So a curve is halved until no part
//! deviates by more than [`DEVIATION_COUNTS`], and none is faster or slower by more than
//! [`SPEED`], at points whose lengths are known by quadrature. Neighbours meet with the same
//! direction; their curvatures differ by a part (l/r)²/12.

use super::segments::{Segment, Stretch};
use crate::input::Point;
use crate::path::cubic::Cubic;
use crate::path::vector::{add, distance, dot, norm, scale, sub, unit};

/// Greatest deviation of a segment from its spline in counts, at equal length.
pub const DEVIATION_COUNTS: f64 = 0.01;

/// Cosine of the greatest angle that a segment turns.
const TURN: f64 = 0.9;

/// Greatest relative speed error on a segment; rounding of the ends adds to it.
pub const SPEED: f64 = 1e-3;

/// Greatest coefficient: that of a word is below 2.
const LARGEST: f64 = 1.9;

/// Returns the segments of a curve, for given guard units per millimetre and per count, each with
/// the values of `stretch` except for its start.
pub(super) fn stretches(cubic: &Cubic, unit: f64, count: f64, stretch: Stretch) -> Vec<Stretch> {
    let mut made = Vec::new();
    let mut parts = vec![[0.0, 1.0]];
    while let Some([from, to]) = parts.pop() {
        match part(cubic, [from, to], unit, count * DEVIATION_COUNTS) {
            Part::Halves => {
                let middle = f64::midpoint(from, to);
                parts.extend([[middle, to], [from, middle]]);
            }
            Part::Nothing => {}
            Part::Whole(segment, length, directions) => made.push(Stretch {
                segment: *segment,
                length,
                directions,
                radius: segment.least_radius(length as f64).map(|r| r / unit),
                ..stretch
            }),
        }
    }
    made
}

/// Result for a part of a curve.
enum Part {
    /// Part shorter than half a guard unit.
    Nothing,
    /// Segment, its length, and its directions at both ends.
    Whole(Box<Segment>, u64, [Point; 2]),
    /// Part that must be halved.
    Halves,
}

fn part(cubic: &Cubic, [from, to]: [f64; 2], unit_per_mm: f64, deviation: f64) -> Part {
    let at = |t: f64| scale(cubic.point(t), unit_per_mm);
    let ends = [from, to].map(|t| at(t).map(f64::round));
    let lengths = cubic.lengths(from, to).map(|mm| mm * unit_per_mm);
    let length = lengths[3].round();
    if length < 1.0 {
        return Part::Nothing;
    }
    let way = scale(sub(ends[1], ends[0]), 1.0 / length);
    let directions @ [first, last] = [cubic.direction(from, false), cubic.direction(to, true)];
    if lengths[3] <= deviation {
        // Shorter than the allowed deviation: a corner of the curve, or next to one.
        let straight = Segment::line(ends[0], way);
        let directions = match norm(way) > 0.0 {
            true => [unit(way); 2],
            false => directions,
        };
        return Part::Whole(Box::new(straight), length as u64, directions);
    }
    let bits = (length as u64).ilog2() + 1;
    let longest = f64::from(bits).exp2() / length;
    let segment = Segment {
        along: first,
        across: scale(sub(scale(way, 3.0), add(scale(first, 2.0), last)), longest),
        third: scale(sub(add(first, last), scale(way, 2.0)), longest * longest),
        powers: Some(bits),
        ..Segment::line(ends[0], way)
    };
    let near = |quarter: usize| {
        let t = from + (to - from) * (quarter + 1) as f64 / 4.0;
        let offset = lengths[quarter];
        let speed = norm(segment.derivatives(bits, offset)[0]);
        distance(segment.point(offset), at(t)) <= deviation / 2.0
            && (speed - 1.0).abs() <= SPEED + 2.0 / length
    };
    let held = |of: Point| of.iter().all(|one| one.abs() < LARGEST);
    let holds = held(segment.across) && held(segment.third);
    match holds && dot(first, last) >= TURN && (0..3).all(near) {
        true => Part::Whole(Box::new(segment), length as u64, directions),
        false => Part::Halves,
    }
}

impl Segment {
    /// Returns the spline whose points are moved outwards by `by` times the second derivative:
    /// by/r along the normal, with the radius of curvature r. It is a cubic of the same length.
    pub(super) fn widened(&self, by: f64) -> Segment {
        let Some(bits) = self.powers else {
            return *self;
        };
        let longest = f64::from(bits).exp2();
        let begin = scale(self.across, 2.0 * by / longest);
        let along = scale(self.third, 6.0 * by / (longest * longest));
        let base = self.base.map(|units| units as f64);
        Segment {
            base: sub(base, begin).map(|units| units.round() as i64),
            along: sub(self.along, along),
            ..*self
        }
    }

    /// Returns the part of `by` by which a spline of this length may be [widened](Self::widened):
    /// to between half and twice its least radius, with coefficients that fit their words; 0 if it
    /// is not a spline.
    pub(super) fn most_wider(&self, length: f64, by: f64) -> f64 {
        let (Some(bits), Some(radius)) = (self.powers, self.least_radius(length)) else {
            return 0.0;
        };
        let longest = f64::from(bits).exp2();
        let bend = self
            .third
            .iter()
            .fold(0.0, |most: f64, one| most.max(one.abs()));
        let word = (LARGEST - 1.0) * longest * longest / (6.0 * bend);
        by.clamp(-radius * radius / 2.0, radius * radius)
            .clamp(-word, word)
    }

    /// Returns first and second derivative by the length, at a length on a spline of `bits` bits.
    pub(super) fn derivatives(&self, bits: u32, offset: f64) -> [Point; 2] {
        let longest = f64::from(bits).exp2();
        let part = offset / longest;
        let sum = |along: f64, across: f64, third: f64| {
            let flat = add(scale(self.along, along), scale(self.across, across));
            add(flat, scale(self.third, third))
        };
        [
            sum(1.0, 2.0 * part, 3.0 * part * part),
            sum(0.0, 2.0 / longest, 6.0 * part / longest),
        ]
    }

    /// Returns the least radius of curvature of a spline of this length, in guard units: the
    /// second derivative is linear between the ends. Returns `None` for a straight spline.
    fn least_radius(&self, length: f64) -> Option<f64> {
        let bits = self.powers?;
        let most = [0.0, length].map(|at| norm(self.derivatives(bits, at)[1]));
        let most = most[0].max(most[1]);
        (most > 0.0).then_some(1.0 / most)
    }
}
