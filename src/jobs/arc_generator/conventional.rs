//! Conventional method that the patent compares itself with, and the cost of both per sample.
//!
//! Conventionally the angle θ(t) itself accelerates, so that Δθ and with it the matrix differ in
//! every sample: a sine, a cosine and Rodrigues' formula each time. In return the points stay on
//! the circle while accelerating.

use super::prepare::Timing;
use crate::circuits::arc_generator::{Blend, BlendPoint, Widths};
use crate::engine::EngineError;
use crate::input::Point;
use crate::path::circle::Circle;
use crate::path::vector::{Matrix, sub};
use crate::sim::Elaborated;
use std::ops::{Add, AddAssign};

/// Operations on floating-point numbers or words.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Operations {
    /// Number of products.
    pub multiplications: u64,
    /// Number of sums, differences and comparisons.
    pub additions: u64,
    /// Number of sines and cosines.
    pub trigonometric: u64,
}

impl Add for Operations {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Operations {
            multiplications: self.multiplications + other.multiplications,
            additions: self.additions + other.additions,
            trigonometric: self.trigonometric + other.trigonometric,
        }
    }
}

impl AddAssign for Operations {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

/// Arithmetic that counts its operations.
impl Operations {
    fn times(&mut self, a: f64, b: f64) -> f64 {
        self.multiplications += 1;
        a * b
    }

    fn plus(&mut self, a: f64, b: f64) -> f64 {
        self.additions += 1;
        a + b
    }

    fn minus(&mut self, a: f64, b: f64) -> f64 {
        self.additions += 1;
        a - b
    }

    fn sine(&mut self, angle: f64) -> f64 {
        self.trigonometric += 1;
        angle.sin()
    }

    fn cosine(&mut self, angle: f64) -> f64 {
        self.trigonometric += 1;
        angle.cos()
    }
}

/// Arc from rest to rest by the conventional method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conventional {
    pub(super) circle: Circle,
    /// Speed v between the ramps, in mm/s.
    pub speed: f64,
    /// Number of samples of each ramp.
    pub ramp: u64,
    /// Number of samples between the ramps.
    pub samples: u64,
    /// Angle of a ramp in radians.
    pub(super) ramp_angle: f64,
    /// Angle per sample between the ramps, in radians.
    step: f64,
}

impl Conventional {
    /// Creates an arc with a speed of at most `wanted` mm/s for which a whole number of samples is
    /// between the ramps; an arc that is too short for that speed is slower.
    #[must_use]
    pub fn new(circle: &Circle, wanted: f64, timing: &Timing) -> Self {
        let ramp = timing.blend_samples as f64;
        let all = (circle.length() / (wanted * timing.sample_s)).ceil();
        let samples = (all - ramp).max(1.0);
        let speed = circle.length() / (timing.sample_s * (samples + ramp));
        Conventional {
            circle: *circle,
            speed,
            ramp: timing.blend_samples,
            samples: samples as u64,
            ramp_angle: speed * timing.half_blend_s() / circle.radius,
            step: speed * timing.sample_s / circle.radius,
        }
    }

    /// Creates an arc without ramps: equal angles in all samples, so that the speed jumps at start
    /// and stop.
    #[must_use]
    pub fn even(circle: &Circle, wanted: f64, timing: &Timing) -> Self {
        let samples = (circle.length() / (wanted * timing.sample_s))
            .ceil()
            .max(1.0);
        let speed = circle.length() / (timing.sample_s * samples);
        Conventional {
            circle: *circle,
            speed,
            ramp: 0,
            samples: samples as u64,
            ramp_angle: 0.0,
            step: circle.angle / samples,
        }
    }

    /// Returns every sample from the start on, with its cost; the start costs nothing.
    pub fn samples(&self) -> impl Iterator<Item = (Point, Operations)> {
        let (mut vector, mut angle) = (sub(self.circle.start, self.circle.centre), 0.0);
        let last = 2 * self.ramp + self.samples;
        let start = (self.circle.start, Operations::default());
        std::iter::once(start).chain((1..=last).map(move |sample| {
            let mut count = Operations::default();
            let next = self.angle(sample, &mut count);
            let step = count.minus(next, angle);
            angle = next;
            let matrix = rodrigues(self.circle.axis, step, &mut count);
            let point = rotate(&matrix, &mut vector, self.circle.centre, &mut count);
            (point, count)
        }))
    }

    /// Returns θ at a sample: the quartic, linear, the mirrored quartic.
    fn angle(&self, sample: u64, count: &mut Operations) -> f64 {
        let to_end = 2 * self.ramp + self.samples - sample;
        if sample <= self.ramp {
            return self.ramp_up(sample, count);
        }
        if to_end < self.ramp {
            let left = self.ramp_up(to_end, count);
            return count.minus(self.circle.angle, left);
        }
        let turned = count.times(self.step, (sample - self.ramp) as f64);
        count.plus(self.ramp_angle, turned)
    }

    /// Returns (2 − h)h³ times the ramp's angle.
    fn ramp_up(&self, sample: u64, count: &mut Operations) -> f64 {
        let h = count.times(sample as f64, 1.0 / self.ramp as f64);
        let square = count.times(h, h);
        let cube = count.times(square, h);
        let rest = count.minus(2.0, h);
        let share = count.times(rest, cube);
        count.times(self.ramp_angle, share)
    }
}

/// Returns the matrix of a rotation (\[2\]), with each product computed once.
fn rodrigues(axis: Point, angle: f64, count: &mut Operations) -> Matrix {
    let (sine, cosine) = (count.sine(angle), count.cosine(angle));
    let vers = count.minus(1.0, cosine);
    let [x, y, z] = axis.map(|k| count.times(k, vers));
    let [sx, sy, sz] = axis.map(|k| count.times(k, sine));
    let (xy, xz, yz) = (
        count.times(x, axis[1]),
        count.times(x, axis[2]),
        count.times(y, axis[2]),
    );
    let mut diagonal = |k, other| {
        let square = count.times(k, other);
        count.plus(square, cosine)
    };
    let (xx, yy, zz) = (
        diagonal(x, axis[0]),
        diagonal(y, axis[1]),
        diagonal(z, axis[2]),
    );
    [
        [xx, count.minus(xy, sz), count.plus(xz, sy)],
        [count.plus(xy, sz), yy, count.minus(yz, sx)],
        [count.minus(xz, sy), count.plus(yz, sx), zz],
    ]
}

/// Multiplies the vector by the matrix and adds the centre (\[9\], \[4\]).
fn rotate(matrix: &Matrix, vector: &mut Point, centre: Point, count: &mut Operations) -> Point {
    let old = *vector;
    *vector = matrix.map(|row| {
        let products: Point = std::array::from_fn(|k| count.times(row[k], old[k]));
        let sum = count.plus(products[0], products[1]);
        count.plus(sum, products[2])
    });
    std::array::from_fn(|k| count.plus(centre[k], vector[k]))
}

/// Computes one sample of an arc by the patent's method: \[9\] with a matrix that was computed
/// once.
#[must_use]
pub fn rotation(matrix: &Matrix, vector: &mut Point, centre: Point) -> (Point, Operations) {
    let mut count = Operations::default();
    let point = rotate(matrix, vector, centre, &mut count);
    (point, count)
}

/// Returns the factors of 1, h and (2 − h)h³ in \[5\] for the points A⁻, A, A⁺, which are computed
/// once.
#[must_use]
pub fn blend_terms(before: Point, corner: Point, behind: Point) -> [Point; 3] {
    let to_corner = sub(corner, before);
    let bend = sub(sub(behind, corner), to_corner);
    [before, to_corner.map(|x| 2.0 * x), bend]
}

/// Computes one sample of a blend as \[5\] is written, at h.
#[must_use]
pub fn blend(terms: &[Point; 3], h: f64) -> (Point, Operations) {
    let mut count = Operations::default();
    let square = count.times(h, h);
    let cube = count.times(square, h);
    let rest = count.minus(2.0, h);
    let quartic = count.times(rest, cube);
    let point = std::array::from_fn(|k| {
        let linear = count.times(terms[1][k], h);
        let bent = count.times(terms[2][k], quartic);
        let sum = count.plus(terms[0][k], linear);
        count.plus(sum, bent)
    });
    (point, count)
}

/// Counts the operations of one sample of a blend by differences, as in the circuit: the adders,
/// subtractors and comparators of the difference engines of all three coordinates, which work in
/// one tick.
///
/// The text's four additions per coordinate are columns here, each with a fractional part that
/// wraps at the modulus and carries into the integer part.
///
/// # Errors
/// Returns an error if the engine cannot be elaborated.
pub fn difference_engines() -> Result<Operations, EngineError> {
    let mut operations = Operations::default();
    for coordinate in 0..3 {
        let model = Elaborated::new(&Widths::FULL.engine(coordinate))?;
        operations.additions += model.cost().adders;
    }
    Ok(operations)
}

/// Counts the operations of one sample of a blend by products, as in the circuit: h², its product
/// with 2h − h², two products per coordinate; their sums, with A⁻ in place of the centre, and the
/// adders of h.
///
/// # Errors
/// Returns an error if the circuit cannot be elaborated.
pub fn products() -> Result<Operations, EngineError> {
    let widths = Blend::Products.widths(Widths::FULL);
    let share = Elaborated::new(&BlendPoint { widths }.share())?;
    Ok(Operations {
        multiplications: 2 + 3 * 2,
        additions: 1 + 3 * 2 + share.cost().adders,
        trigonometric: 0,
    })
}
