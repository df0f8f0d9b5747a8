//! Jumps at the joint of two segments, by a polynomial on each side.

use super::measure::Joint;
use super::prepare::Timing;
use super::prepared::{Kind, Segment};
use crate::input::{COORDINATES, Point};
use crate::path::vector::{angle_between, distance, scale};
use std::collections::VecDeque;

/// Degree of the polynomial through the samples at a joint: that of a blend.
const DEGREE: usize = 4;

/// Joint whose first segment has ended.
#[derive(Debug)]
pub(super) struct Leaving {
    segment: usize,
    sample: u64,
    rests: bool,
    /// First and second derivative by the sample number at the end, backwards.
    derivatives: [Point; 2],
}

impl Leaving {
    /// Creates a joint at the end of segment `index` from the latest points, up to the `most`
    /// samples of a blend.
    pub(super) fn new(index: usize, ends: &Segment, recent: &VecDeque<Point>, most: u64) -> Self {
        let count = most.min(ends.samples) as usize + 1;
        let back: Vec<Point> = recent.iter().rev().take(count).copied().collect();
        Leaving {
            segment: index,
            sample: ends.end(),
            rests: ends.ends_at_rest,
            derivatives: derivatives(&back, ends.kind()),
        }
    }

    /// Returns the joint; the latest points are those of the next segment from its start.
    pub(super) fn joint(
        &self,
        begins: &Segment,
        recent: &VecDeque<Point>,
        timing: &Timing,
    ) -> Joint {
        let ts = timing.sample_s;
        let count = timing.blend_samples.min(begins.samples) as usize + 1;
        let points: Vec<Point> = recent.range(recent.len() - count..).copied().collect();
        // Backwards, the velocity has the other sign.
        let [leaves, curves_before] = self.derivatives;
        let [enters, curves_behind] = derivatives(&points, begins.kind());
        let (leaves, enters) = (scale(leaves, -1.0 / ts), scale(enters, 1.0 / ts));
        let direction_jump = match self.rests {
            true => 0.0,
            false => angle_between(leaves, enters),
        };
        Joint {
            segment: self.segment,
            sample: self.sample,
            direction_jump_deg: direction_jump.to_degrees(),
            velocity_jump_mm_per_s: distance(leaves, enters),
            acceleration_jump_mm_per_s2: distance(curves_before, curves_behind) / (ts * ts),
        }
    }
}

/// Returns first and second derivative by the sample number at the first of the points, of the
/// least-squares polynomial: of degree 1 on a line, else 4, limited by the number of points.
fn derivatives(points: &[Point], kind: Kind) -> [Point; 2] {
    let degree = match kind {
        Kind::Line => 1,
        Kind::Blend | Kind::Arc => DEGREE,
    };
    let degree = degree.min(points.len() - 1);
    let span = (points.len() - 1) as f64;
    let coordinates: [[f64; 2]; COORDINATES] = std::array::from_fn(|k| {
        // Relative to the first value, so that large coordinates do not lose digits.
        let values = points.iter().map(|p| p[k] - points[0][k]);
        let c = fit(values, span, degree);
        // x = Σ c·u^j with u = sample/span.
        [c[1] / span, 2.0 * c[2] / (span * span)]
    });
    std::array::from_fn(|order| coordinates.map(|c| c[order]))
}

/// Returns the coefficients of the least-squares polynomial in sample/span, by the normal
/// equations, which are well-conditioned enough at this degree.
fn fit(values: impl Iterator<Item = f64>, span: f64, degree: usize) -> [f64; DEGREE + 1] {
    let mut rows = [[0.0; DEGREE + 2]; DEGREE + 1];
    for (sample, value) in values.enumerate() {
        let u = sample as f64 / span;
        let powers: [f64; DEGREE + 1] = std::array::from_fn(|j| u.powi(j as i32));
        for (row, power) in rows.iter_mut().zip(powers).take(degree + 1) {
            for (cell, other) in row.iter_mut().zip(powers) {
                *cell += power * other;
            }
            row[DEGREE + 1] += power * value;
        }
    }
    // Symmetric and positive: every diagonal element is a pivot.
    let size = degree + 1;
    for pivot in 0..size {
        for row in 0..size {
            if row == pivot {
                continue;
            }
            let eliminated = rows[pivot];
            let factor = rows[row][pivot] / eliminated[pivot];
            for (cell, other) in rows[row].iter_mut().zip(eliminated) {
                *cell -= factor * other;
            }
        }
    }
    std::array::from_fn(|j| match j < size {
        true => rows[j][DEGREE + 1] / rows[j][j],
        false => 0.0,
    })
}
