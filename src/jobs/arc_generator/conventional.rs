//! The conventional method that the patent compares itself with, and what each costs a sample.
//!
//! Conventionally the angle θ(t) itself accelerates, so that Δθ is another one at every sample, and
//! the matrix with it: a sine, a cosine and Rodrigues' formula each time. In return it stays on the
//! circle while it accelerates.

use super::prepare::Timing;
use crate::circuits::arc_generator::{Blend, BlendPoint, Widths};
use crate::engine::EngineError;
use crate::hdl;
use crate::input::Point;
use crate::path::circle::Circle;
use crate::path::vector::{Matrix, sub};
use std::ops::{Add, AddAssign};

/// Operations of floating point or of words.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Operations {
    /// Products.
    pub multiplications: u64,
    /// Sums, differences and comparisons.
    pub additions: u64,
    /// Sines and cosines.
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

/// Arithmetic that counts itself.
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

/// An arc from rest to rest by the conventional method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conventional {
    pub(super) circle: Circle,
    /// v: speed between the ramps, in mm/s.
    pub speed: f64,
    /// Samples of each ramp.
    pub ramp: u64,
    /// Samples between the ramps.
    pub samples: u64,
    /// Angle that a ramp takes.
    pub(super) ramp_angle: f64,
    /// Angle of a sample between the ramps.
    step: f64,
}

impl Conventional {
    /// At a speed of at most `wanted` mm/s, so that a whole number of samples lies between the
    /// ramps; one that is too short for the wanted speed is run slower.
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

    /// The same without ramps: an angle of one size in every sample, so that the speed jumps at start
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

    /// Every sample from the start on, with what it costs; the start costs nothing.
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

    /// θ at a sample: the quartic, linear, the quartic in the mirror.
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

    /// (2 − h)h³ of the ramp's angle.
    fn ramp_up(&self, sample: u64, count: &mut Operations) -> f64 {
        let h = count.times(sample as f64, 1.0 / self.ramp as f64);
        let square = count.times(h, h);
        let cube = count.times(square, h);
        let rest = count.minus(2.0, h);
        let share = count.times(rest, cube);
        count.times(self.ramp_angle, share)
    }
}

/// \[2\]: the matrix of a rotation, each product made once.
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

/// \[9\], \[4\]: the vector times the matrix, and the centre added.
fn rotate(matrix: &Matrix, vector: &mut Point, centre: Point, count: &mut Operations) -> Point {
    let old = *vector;
    *vector = matrix.map(|row| {
        let products: Point = std::array::from_fn(|k| count.times(row[k], old[k]));
        let sum = count.plus(products[0], products[1]);
        count.plus(sum, products[2])
    });
    std::array::from_fn(|k| count.plus(centre[k], vector[k]))
}

/// One sample of an arc as the patent has it: \[9\] with a matrix that was computed once.
#[must_use]
pub fn rotation(matrix: &Matrix, vector: &mut Point, centre: Point) -> (Point, Operations) {
    let mut count = Operations::default();
    let point = rotate(matrix, vector, centre, &mut count);
    (point, count)
}

/// The multiples of 1, h and (2 − h)h³ that \[5\] has for the points A⁻, A, A⁺: computed once.
#[must_use]
pub fn blend_terms(before: Point, corner: Point, behind: Point) -> [Point; 3] {
    let to_corner = sub(corner, before);
    let bend = sub(sub(behind, corner), to_corner);
    [before, to_corner.map(|x| 2.0 * x), bend]
}

/// One sample of a blend as \[5\] is written, at h.
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

/// One sample of a blend by differences, as the circuit has it: the adders, subtractors and
/// comparators of the difference engines of all three coordinates, which work in one tick.
///
/// The text's four additions a coordinate are columns here, each with a part that wraps at the
/// modulus and carries into the whole.
///
/// # Errors
/// The engine is no netlist.
pub fn difference_engines() -> Result<Operations, EngineError> {
    let mut operations = Operations::default();
    for coordinate in 0..3 {
        let model = hdl::model(&Widths::FULL.engine(coordinate))?;
        operations.additions += model.cost().adders;
    }
    Ok(operations)
}

/// One sample of a blend by products, as the circuit has it: h², its product with 2h − h², two products
/// a coordinate; their sums, the centre's place taken by A⁻, and the adders of h.
///
/// # Errors
/// The circuit is no netlist.
pub fn products() -> Result<Operations, EngineError> {
    let widths = Blend::Products.widths(Widths::FULL);
    let share = hdl::model(&BlendPoint { widths }.share())?;
    Ok(Operations {
        multiplications: 2 + 3 * 2,
        additions: 1 + 3 * 2 + share.cost().adders,
        trigonometric: 0,
    })
}
