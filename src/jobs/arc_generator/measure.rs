//! What came out: measured from position commands, sample by sample.

use super::prepared::{Kind, Prepared, Shape};
use crate::input::{COORDINATES, Point};
use crate::path::vector::{add, angle_between, distance, norm, scale, sub};

/// Degree of the polynomial that is laid through the samples at a joint: that of a blend.
const DEGREE: usize = 4;

/// Measured from the samples of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Speed in mm/s from each sample to the next.
    pub speeds: Vec<f64>,
    /// Acceleration in mm/s² at each sample but the first and the last.
    pub accelerations: Vec<f64>,
    /// Largest distance of a sample from its exact point, in mm.
    pub largest_error: f64,
    /// The arcs, in order.
    pub arcs: Vec<ArcMeasured>,
    /// The blends, in order.
    pub blends: Vec<BlendMeasured>,
    /// The joints of segments, in order.
    pub joints: Vec<Joint>,
}

/// Measured on the samples of a rotation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArcMeasured {
    /// The segment.
    pub segment: usize,
    /// Least and largest error of the radius, in mm, outwards positive.
    pub radius_errors: [f64; 2],
    /// Largest distance from the arc's plane, in mm.
    pub off_plane: f64,
    /// Distance of its last sample from C⁻, in mm.
    pub end_error: f64,
    /// Mean speed along the arc, in mm/s.
    pub speed: f64,
}

/// Measured on the samples of a blend.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlendMeasured {
    /// The segment.
    pub segment: usize,
    /// Largest distance from the lines and arcs that it belongs to, in mm.
    pub off_path: f64,
    /// Least distance from the taught point, in mm.
    pub from_corner: f64,
    /// Largest acceleration, in mm/s²: that of the parabola of least squares through the second
    /// differences of the samples. One of them alone may be off by two counts over Ts² for rounding.
    pub peak_acceleration: f64,
}

/// What jumps where a segment ends and the next begins. Each side is a polynomial of degree 4 of
/// least squares through the segment's samples next to the joint, as many as a blend has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint {
    /// The segment that ends.
    pub segment: usize,
    /// The sample.
    pub sample: u64,
    /// Angle between the velocities before and after, in radians; 0 if it rests.
    pub direction_jump: f64,
    /// Length of the difference of both velocities, in mm/s.
    pub velocity_jump: f64,
    /// Length of the difference of both accelerations, in mm/s².
    pub acceleration_jump: f64,
}

impl Measured {
    /// Measures position commands in counts, one for each sample of the path.
    ///
    /// `None` unless there are as many as the path has.
    #[must_use]
    pub fn of(
        prepared: &Prepared,
        counts_per_mm: f64,
        commands: &[[i64; COORDINATES]],
    ) -> Option<Self> {
        if commands.len() as u64 != prepared.samples() {
            return None;
        }
        let points: Vec<Point> = commands
            .iter()
            .map(|command| command.map(|counts| counts as f64 / counts_per_mm))
            .collect();
        let ts = prepared.timing.sample_s;
        let speeds = points.windows(2).map(|p| distance(p[1], p[0]) / ts);
        let accelerations: Vec<f64> = points
            .windows(3)
            .map(|p| norm(sub(sub(p[2], p[1]), sub(p[1], p[0]))) / (ts * ts))
            .collect();
        let errors = (0..)
            .zip(&points)
            .filter_map(|(sample, point)| Some(distance(prepared.point(sample)?, *point)));
        let mut measured = Measured {
            speeds: speeds.collect(),
            largest_error: errors.fold(0.0, f64::max),
            arcs: Vec::new(),
            blends: Vec::new(),
            joints: joints(prepared, &points),
            accelerations: Vec::new(),
        };
        for (index, segment) in prepared.segments.iter().enumerate() {
            let own = &points[segment.first_sample as usize..=segment.end() as usize];
            match segment.shape {
                Shape::Line { .. } => {}
                Shape::Blend { corner, .. } => {
                    let off = own.iter().map(|&p| prepared.distance(segment, p));
                    let from = own.iter().map(|&p| distance(p, corner));
                    measured.blends.push(BlendMeasured {
                        segment: index,
                        off_path: off.fold(0.0, f64::max),
                        from_corner: from.fold(f64::INFINITY, f64::min),
                        peak_acceleration: peak_acceleration(own) / (ts * ts),
                    });
                }
                Shape::Arc { circle, .. } => {
                    let off: Vec<_> = own.iter().map(|&p| circle.off(p)).collect();
                    let outside = off.iter().map(|off| off[0]);
                    let way: f64 = own.windows(2).map(|p| distance(p[1], p[0])).sum();
                    let last = own.last().copied().unwrap_or(circle.start);
                    measured.arcs.push(ArcMeasured {
                        segment: index,
                        radius_errors: [
                            outside.clone().fold(f64::INFINITY, f64::min),
                            outside.fold(f64::NEG_INFINITY, f64::max),
                        ],
                        off_plane: off.iter().map(|off| off[1].abs()).fold(0.0, f64::max),
                        end_error: distance(last, segment.point(segment.samples)),
                        speed: way / (ts * segment.samples as f64),
                    });
                }
            }
        }
        measured.accelerations = accelerations;
        Some(measured)
    }
}

/// The largest second difference of a blend, by what of the second differences of its samples is
/// in the shape that a blend has: those of x'' = 12S·h(1 − h), which a step of 1/n makes less by
/// 2S/n².
fn peak_acceleration(samples: &[Point]) -> f64 {
    let n = samples.len().saturating_sub(1) as f64;
    let (mut along, mut square) = ([0.0; COORDINATES], 0.0);
    for (sample, p) in (1..).zip(samples.windows(3)) {
        let h = f64::from(sample) / n;
        let shape = 4.0 * h * (1.0 - h) - 2.0 / (3.0 * n * n);
        let second = sub(sub(p[2], p[1]), sub(p[1], p[0]));
        along = add(along, scale(second, shape));
        square += shape * shape;
    }
    match square > 0.0 {
        true => norm(along) / square,
        false => 0.0,
    }
}

fn joints(prepared: &Prepared, points: &[Point]) -> Vec<Joint> {
    let ts = prepared.timing.sample_s;
    let most = prepared.timing.blend_samples as usize;
    let pairs = prepared
        .segments
        .iter()
        .zip(prepared.segments.iter().skip(1));
    let joints = pairs.enumerate().map(|(segment, (ends, begins))| {
        let at = ends.end() as usize;
        let before = at - most.min(ends.samples as usize);
        let behind = at + most.min(begins.samples as usize);
        let mut back: Vec<Point> = points[before..=at].to_vec();
        back.reverse();
        // Backwards the velocity has the other sign.
        let [leaves, curves_before] = derivatives(&back, ends.kind());
        let [enters, curves_behind] = derivatives(&points[at..=behind], begins.kind());
        let (leaves, enters) = (scale(leaves, -1.0 / ts), scale(enters, 1.0 / ts));
        let direction_jump = match ends.ends_at_rest {
            true => 0.0,
            false => angle_between(leaves, enters),
        };
        Joint {
            segment,
            sample: ends.end(),
            direction_jump,
            velocity_jump: distance(leaves, enters),
            acceleration_jump: distance(curves_before, curves_behind) / (ts * ts),
        }
    });
    joints.collect()
}

/// First and second derivative by the sample number at the first of the points, of the polynomial
/// of least squares: of degree 1 on a line, else 4, or as high as there are points.
fn derivatives(points: &[Point], kind: Kind) -> [Point; 2] {
    let degree = match kind {
        Kind::Line => 1,
        Kind::Blend | Kind::Arc => DEGREE,
    };
    let degree = degree.min(points.len() - 1);
    let span = (points.len() - 1) as f64;
    let coordinates: [[f64; 2]; COORDINATES] = std::array::from_fn(|k| {
        // From its first value, for large coordinates not to cost digits.
        let values = points.iter().map(|p| p[k] - points[0][k]);
        let c = fit(values, span, degree);
        // x = Σ c·u^j with u = sample/span.
        [c[1] / span, 2.0 * c[2] / (span * span)]
    });
    std::array::from_fn(|order| coordinates.map(|c| c[order]))
}

/// Coefficients of the polynomial of least squares in sample/span: the normal equations, which are
/// well enough conditioned at such a degree.
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
    // Symmetric and positive: the diagonal is always a pivot.
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
