//! Points and vectors in space, and their rotation by Rodrigues' formula.

use crate::input::{COORDINATES, Point};
pub(crate) use crate::plan::norm;

/// Matrix of rows.
pub type Matrix = [Point; COORDINATES];

/// Returns the sum.
#[must_use]
pub fn add(a: Point, b: Point) -> Point {
    std::array::from_fn(|k| a[k] + b[k])
}

/// Returns the difference: the vector from `b` to `a`.
#[must_use]
pub fn sub(a: Point, b: Point) -> Point {
    std::array::from_fn(|k| a[k] - b[k])
}

/// Returns the multiple of a vector.
#[must_use]
pub fn scale(a: Point, by: f64) -> Point {
    a.map(|x| x * by)
}

/// Returns the dot product.
#[must_use]
pub fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Returns the cross product.
#[must_use]
pub fn cross(a: Point, b: Point) -> Point {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// Returns the distance of two points.
#[must_use]
pub fn distance(a: Point, b: Point) -> f64 {
    norm(sub(a, b))
}

/// Returns the unit vector in the direction of `a`; not a number for a zero vector.
#[must_use]
pub fn unit(a: Point) -> Point {
    scale(a, 1.0 / norm(a))
}

/// Returns the angle between two vectors, 0 to π.
#[must_use]
pub fn angle_between(a: Point, b: Point) -> f64 {
    norm(cross(a, b)).atan2(dot(a, b))
}

/// Returns the matrix that rotates by `angle` around the unit vector `axis` (\[2\], \[7\]).
#[must_use]
pub fn rodrigues(axis: Point, angle: f64) -> Matrix {
    let (sin, cos) = angle.sin_cos();
    // Computes 1 − cos without cancellation: steps are small.
    let half = (angle / 2.0).sin();
    let vers = 2.0 * half * half;
    let [x, y, z] = axis;
    [
        [
            x * x * vers + cos,
            x * y * vers - z * sin,
            x * z * vers + y * sin,
        ],
        [
            x * y * vers + z * sin,
            y * y * vers + cos,
            y * z * vers - x * sin,
        ],
        [
            x * z * vers - y * sin,
            y * z * vers + x * sin,
            z * z * vers + cos,
        ],
    ]
}

/// Returns the product of a matrix and a vector.
#[must_use]
pub fn apply(matrix: &Matrix, vector: Point) -> Point {
    matrix.map(|row| dot(row, vector))
}
