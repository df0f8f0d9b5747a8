//! Helix: an arc that climbs along its axis in proportion to its angle.

use super::circle::{Circle, CircleError};
use super::cubic::{nearest, rises};
use super::vector::{add, dot, scale, sub, unit};
use crate::input::{COORDINATES, Point};
use std::f64::consts::TAU;

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Helix {
    /// Arc in the plane of its start.
    pub circle: Circle,
    /// Climb along the axis from start to end, in mm.
    pub rise: f64,
}

impl Helix {
    /// Creates the helix from `from` to `to` around an axis through `centre`, as
    /// [`Circle::around`] makes its arc; a whole turn if one point is above the other.
    ///
    /// # Errors
    /// Returns the errors of [`Circle::around`].
    pub fn around(centre: Point, from: Point, to: Point, axis: Point) -> Result<Self, CircleError> {
        let axis = unit(axis);
        let rise = dot(sub(to, from), axis);
        let flat = sub(to, scale(axis, rise));
        let circle = Circle::around(centre, from, flat, axis)?;
        Ok(Helix { circle, rise })
    }

    /// Returns the point at a part of the length, 0 to 1.
    #[must_use]
    pub fn point(&self, part: f64) -> Point {
        let flat = self.circle.point(self.circle.angle * part);
        add(flat, scale(self.circle.axis, self.rise * part))
    }

    /// Returns the unit direction of motion at a part of the length.
    #[must_use]
    pub fn direction(&self, part: f64) -> Point {
        let around = self.circle.direction(self.circle.angle * part);
        let around = scale(around, self.circle.length());
        unit(add(around, scale(self.circle.axis, self.rise)))
    }

    #[must_use]
    pub fn length(&self) -> f64 {
        self.circle.length().hypot(self.rise)
    }

    #[must_use]
    pub fn curvature_radius(&self) -> f64 {
        let (radius, climb) = (self.circle.radius, self.rise / self.circle.angle);
        radius + climb * climb / radius
    }

    /// Returns bounds of each coordinate.
    #[must_use]
    pub fn extremes(&self) -> [[f64; 2]; COORDINATES] {
        let flat = self.circle.extremes();
        std::array::from_fn(|k| {
            let climb = self.circle.axis[k] * self.rise;
            [flat[k][0] + climb.min(0.0), flat[k][1] + climb.max(0.0)]
        })
    }

    /// Returns the point of the helix nearest to a point.
    #[must_use]
    pub fn nearest(&self, point: Point) -> Point {
        let parts = (self.circle.angle / TAU * 8.0).ceil() as u32;
        let ahead = |part: f64| dot(sub(self.point(part), point), self.direction(part));
        let turns = rises([0.0, 1.0], parts, ahead).map(|part| self.point(part));
        nearest(point, self.point(1.0), turns)
    }
}
