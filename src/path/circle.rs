//! Arc in space: from three points, or from a centre and two points.

use super::vector::{add, cross, distance, dot, norm, scale, sub, unit};
use crate::input::{COORDINATES, Point, ZERO_MM};
use crate::settings::tidy;
use std::f64::consts::{PI, TAU};

/// Three points count as collinear if the distance of the middle one from the line is less than
/// this part of the longest distance between them: their circle would be determined by rounding
/// errors.
pub const COLLINEAR: f64 = 1e-9;

/// Greatest distance by which a given centre is moved to make both radii equal, as a part of the
/// radius.
pub const CENTRE_MOVE: f64 = 0.05;

/// Arc: a vector from the centre that rotates about an axis, counterclockwise seen from the end of
/// the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Circle {
    /// Centre G.
    pub centre: Point,
    /// Unit vector k of the axis.
    pub axis: Point,
    /// Start A.
    pub start: Point,
    /// Radius R.
    pub radius: f64,
    /// Angle θ from start to end in radians, above 0 and up to a whole turn.
    pub angle: f64,
}

/// Reason why points do not define an arc.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum CircleError {
    /// Two of the points are equal.
    #[error("{} and {} are the same point", points[0], points[1])]
    Coincident {
        /// Names: "start", "via", "end", "centre".
        points: [&'static str; 2],
    },
    /// The three points are collinear.
    #[error(
        "the point via is only {} mm off the line from start to end, {} mm long",
        tidy(*off),
        tidy(*chord)
    )]
    Collinear {
        /// Distance of B from the line through A and C.
        off: f64,
        /// Distance of A and C.
        chord: f64,
    },
    /// Start and end are at different heights along the axis.
    #[error("climbs {} mm along its axis: a helix", tidy(*rise))]
    Helix {
        /// Difference in height of start and end.
        rise: f64,
    },
    /// No centre near the given one has equal distances to both ends.
    #[error("the radius is {} mm at the start and {} mm at the end", tidy(*from), tidy(*to))]
    Radii {
        /// Distance of the start from the centre.
        from: f64,
        /// Distance of the end from the centre.
        to: f64,
    },
}

impl Circle {
    /// Creates the arc from `a` over `b` to `c`: G is equidistant from all three, and the axis (B
    /// − A)×(C − B) gives the right direction for any arc.
    ///
    /// # Errors
    /// Returns an error if two points are equal, or all three are collinear.
    pub fn through(a: Point, b: Point, c: Point) -> Result<Self, CircleError> {
        for (points, p, q) in [
            (["start", "via"], a, b),
            (["via", "end"], b, c),
            (["start", "end"], a, c),
        ] {
            if p == q {
                return Err(CircleError::Coincident { points });
            }
        }
        // Relative to A, so that large coordinates do not lose digits.
        let (u, v) = (sub(b, a), sub(c, a));
        let normal = cross(u, v);
        let chord = norm(v);
        let longest = chord.max(norm(u)).max(distance(b, c));
        let off = norm(normal) / chord;
        if off * chord <= COLLINEAR * longest * longest {
            return Err(CircleError::Collinear { off, chord });
        }
        let weighted = sub(scale(v, dot(u, u)), scale(u, dot(v, v)));
        let to_centre = scale(cross(weighted, normal), 0.5 / dot(normal, normal));
        let mut circle = Circle {
            centre: add(a, to_centre),
            axis: unit(normal),
            start: a,
            radius: norm(to_centre),
            angle: TAU,
        };
        circle.angle = circle.angle_of(c);
        Ok(circle)
    }

    /// Creates the arc from `from` to `to` around an axis through `centre`; a whole circle if both
    /// points are equal. The centre is moved onto the bisector of the chord, so that both radii
    /// agree, and along the axis into the plane of the arc.
    ///
    /// # Errors
    /// Returns an error if the start is on the axis, the end is at another height, or the centre
    /// would have to be moved by more than [`CENTRE_MOVE`] of the radius.
    pub fn around(centre: Point, from: Point, to: Point, axis: Point) -> Result<Self, CircleError> {
        let axis = unit(axis);
        let chord = sub(to, from);
        let rise = dot(chord, axis);
        if rise.abs() > ZERO_MM {
            return Err(CircleError::Helix { rise: rise.abs() });
        }
        let flat = |p: Point| sub(p, scale(axis, dot(p, axis)));
        let (near, far) = (flat(sub(from, centre)), flat(sub(to, centre)));
        let (first, last) = (norm(near), norm(far));
        if first == 0.0 {
            let points = ["start", "centre"];
            return Err(CircleError::Coincident { points });
        }
        let chord = flat(chord);
        let span = norm(chord);
        let moved = match span > 0.0 {
            true => (first - last) * (first + last) / (2.0 * span),
            false => 0.0,
        };
        if moved.abs() > CENTRE_MOVE * first.min(last) {
            return Err(CircleError::Radii {
                from: first,
                to: last,
            });
        }
        // From the moved centre to the start.
        let vector = match span > 0.0 {
            true => add(near, scale(chord, moved / span)),
            false => near,
        };
        let mut circle = Circle {
            centre: sub(from, vector),
            axis,
            start: from,
            radius: norm(vector),
            angle: TAU,
        };
        circle.angle = match circle.angle_of(to) {
            angle if span > 0.0 && angle > 0.0 => angle,
            _ => TAU,
        };
        Ok(circle)
    }

    /// Returns the point at an angle from the start.
    #[must_use]
    pub fn point(&self, angle: f64) -> Point {
        let (sin, cos) = angle.sin_cos();
        let [u, w] = self.frame();
        std::array::from_fn(|k| self.centre[k] + u[k] * cos + w[k] * sin)
    }

    /// Returns the unit direction of motion at an angle from the start.
    #[must_use]
    pub fn direction(&self, angle: f64) -> Point {
        let (sin, cos) = angle.sin_cos();
        let [u, w] = self.frame();
        unit(sub(scale(w, cos), scale(u, sin)))
    }

    /// Returns the end of the arc.
    #[must_use]
    pub fn end(&self) -> Point {
        self.point(self.angle)
    }

    /// Returns the length of the arc.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.radius * self.angle
    }

    /// Returns the distance of a point from the arc.
    #[must_use]
    pub fn distance(&self, point: Point) -> f64 {
        distance(point, self.nearest(point))
    }

    /// Returns the point of the arc nearest to a point; the start for a point on the axis.
    #[must_use]
    pub fn nearest(&self, point: Point) -> Point {
        let angle = self.angle_of(point);
        if angle <= self.angle {
            return self.point(angle);
        }
        let ends = [self.start, self.end()];
        let [to_start, to_end] = ends.map(|end| distance(point, end));
        ends[usize::from(to_end < to_start)]
    }

    /// Returns the distance of a point outside the circle, and above its plane.
    #[must_use]
    pub fn off(&self, point: Point) -> [f64; 2] {
        let vector = sub(point, self.centre);
        let height = dot(vector, self.axis);
        let flat = norm(sub(vector, scale(self.axis, height)));
        [flat - self.radius, height]
    }

    /// Returns least and greatest value of each coordinate on the arc.
    #[must_use]
    pub fn extremes(&self) -> [[f64; 2]; COORDINATES] {
        let [u, w] = self.frame();
        let end = self.end();
        std::array::from_fn(|k| {
            let ends = [self.start[k].min(end[k]), self.start[k].max(end[k])];
            let (top, swing) = (w[k].atan2(u[k]), u[k].hypot(w[k]));
            let passes = |angle: f64| angle.rem_euclid(TAU) <= self.angle;
            [
                match passes(top + PI) {
                    true => self.centre[k] - swing,
                    false => ends[0],
                },
                match passes(top) {
                    true => self.centre[k] + swing,
                    false => ends[1],
                },
            ]
        })
    }

    /// Returns the angle of a point from the start, 0 to below a whole turn.
    fn angle_of(&self, point: Point) -> f64 {
        let [u, w] = self.frame();
        let vector = sub(point, self.centre);
        let angle = dot(vector, w).atan2(dot(vector, u));
        if angle < 0.0 { angle + TAU } else { angle }
    }

    /// Returns the vector to the start, and that vector rotated by a quarter turn.
    fn frame(&self) -> [Point; 2] {
        let vector = sub(self.start, self.centre);
        [vector, cross(self.axis, vector)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rise_is_shown_without_rounding_errors() {
        let rise = 99.999_999_999_999_99;
        let error = CircleError::Helix { rise };
        assert_eq!(error.to_string(), "climbs 100 mm along its axis: a helix");
    }
}
