//! Path as requested: pieces from taught points or from the moves of a drawing.

use super::circle::{Circle, CircleError};
use super::cubic::Cubic;
use super::error::{PathError, Reason};
use super::helix::Helix;
use super::vector::{add, distance, dot, scale, sub, unit};
use crate::input::{self, COORDINATES, Drawing, Move, Point, ZERO_MM};

/// Greatest distance of an arc from the path's points, as a part of its length plus 1 mm.
const GAP: f64 = 1e-6;

/// Path of a piece to its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Course {
    /// Straight line.
    Line,
    /// Arc, which begins at the end of the piece before.
    Arc(Circle),
    /// Helix, which begins at the end of the piece before.
    Helix(Helix),
    /// Spline, which begins at the end of the piece before.
    Spline(Cubic),
}

impl Course {
    /// Returns the length in mm.
    #[must_use]
    pub fn length(&self, from: Point, to: Point) -> f64 {
        match self {
            Course::Line => distance(from, to),
            Course::Arc(circle) => circle.length(),
            Course::Helix(helix) => helix.length(),
            Course::Spline(cubic) => cubic.length(),
        }
    }

    /// Returns the point of the course nearest to a point.
    #[must_use]
    pub fn nearest(&self, from: Point, to: Point, point: Point) -> Point {
        match self {
            Course::Arc(circle) => circle.nearest(point),
            Course::Helix(helix) => helix.nearest(point),
            Course::Spline(cubic) => cubic.nearest(point),
            Course::Line => {
                let way = sub(to, from);
                let square = dot(way, way);
                let along = match square > 0.0 {
                    true => dot(sub(point, from), way) / square,
                    false => 0.0,
                };
                add(from, scale(way, along.clamp(0.0, 1.0)))
            }
        }
    }

    /// Returns bounds of each coordinate; for a line only those of its end.
    #[must_use]
    pub fn extremes(&self, to: Point) -> [[f64; 2]; COORDINATES] {
        match self {
            Course::Line => to.map(|mm| [mm; 2]),
            Course::Arc(circle) => circle.extremes(),
            Course::Helix(helix) => helix.extremes(),
            Course::Spline(cubic) => cubic.extremes(),
        }
    }

    /// Returns the arc, for circuits that support lines and arcs only; `None` for a line.
    ///
    /// # Errors
    /// Returns an error for a helix or a spline.
    pub fn arc(&self) -> Result<Option<&Circle>, Reason> {
        match self {
            Course::Line => Ok(None),
            Course::Arc(circle) => Ok(Some(circle)),
            Course::Helix(helix) => {
                let rise = helix.rise.abs();
                Err(CircleError::Helix { rise }.into())
            }
            Course::Spline(_) => Err(Reason::Spline),
        }
    }

    /// Returns the directions of motion at start and end; not a number for a line without length.
    #[must_use]
    pub fn directions(&self, from: Point, to: Point) -> [Point; 2] {
        match self {
            Course::Line => [unit(sub(to, from)); 2],
            Course::Arc(circle) => [0.0, circle.angle].map(|angle| circle.direction(angle)),
            Course::Helix(helix) => [0.0, 1.0].map(|part| helix.direction(part)),
            Course::Spline(cubic) => [cubic.direction(0.0, false), cubic.direction(1.0, true)],
        }
    }
}

/// Piece of a path, from the end of the piece before it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// Path to the end.
    pub course: Course,
    /// End in mm.
    pub to: Point,
    /// Requested speed Vs in mm/s.
    pub speed: f64,
    /// Line of the piece in the input.
    pub line: Option<usize>,
}

impl Piece {
    /// Checks that the piece has finite numbers and a speed, and meets the path's points.
    ///
    /// # Errors
    /// Returns the first reason against it.
    pub(crate) fn check(&self, from: Point) -> Result<(), Reason> {
        for point in [from, self.to] {
            if let Some((axis, value)) = no_number(point) {
                return Err(Reason::Coordinate { axis, value });
            }
        }
        if !(self.speed.is_finite() && self.speed > 0.0) {
            return Err(Reason::Speed { speed: self.speed });
        }
        let ends = match &self.course {
            Course::Line => return Ok(()),
            Course::Arc(circle) => [circle.start, circle.end()],
            Course::Helix(helix) => [helix.circle.start, helix.point(1.0)],
            Course::Spline(cubic) => [cubic.points[0], cubic.points[3]],
        };
        let gap = distance(ends[0], from).max(distance(ends[1], self.to));
        let meets = gap <= GAP * (1.0 + self.course.length(from, self.to));
        if !meets {
            return Err(Reason::Gap { gap });
        }
        Ok(())
    }
}

/// Returns the first coordinate that is not a number.
fn no_number(point: Point) -> Option<(&'static str, f64)> {
    let mut named = ["x", "y", "z"].into_iter().zip(point);
    named.find(|(_, value)| !value.is_finite())
}

/// Default speeds of pieces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Speeds {
    /// Speed of all but rapid moves, in mm/s.
    pub wanted: Option<f64>,
    /// Speed of rapid moves, in mm/s.
    pub rapid: f64,
}

/// Piece given by taught points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Taught {
    /// End C in mm.
    pub to: Point,
    /// Point B of the arc; without it the piece is a line or a spline.
    pub via: Option<Point>,
    /// True for a spline: a single curve passes through the ends of consecutive such pieces.
    pub spline: bool,
    /// Own speed in mm/s.
    pub speed: Option<f64>,
}

/// Returns the pieces of taught points.
///
/// # Errors
/// Returns an error for three points that define no arc, a via point or spline end that is not
/// made of numbers, a spline end equal to that of the piece before, or a piece without a speed if
/// there is no default.
pub fn from_points(
    start: Point,
    taught: &[Taught],
    speeds: impl Into<Speeds>,
) -> Result<Vec<Piece>, PathError> {
    let speeds = speeds.into();
    let splines = splines(start, taught)?;
    let mut from = start;
    let pieces = taught.iter().enumerate().map(|(piece, taught)| {
        let begin = std::mem::replace(&mut from, taught.to);
        let refuse = |reason| PathError {
            piece,
            line: None,
            reason,
        };
        if let Some((axis, value)) = taught.via.and_then(no_number) {
            return Err(refuse(Reason::Via { axis, value }));
        }
        let course = match (taught.via, splines[piece]) {
            (Some(via), _) => Circle::through(begin, via, taught.to).map(Course::Arc),
            (None, Some(cubic)) => Ok(Course::Spline(cubic)),
            (None, None) => Ok(Course::Line),
        };
        let speed = taught.speed.or(speeds.wanted);
        Ok(Piece {
            course: course.map_err(|error| refuse(error.into()))?,
            to: taught.to,
            speed: speed.ok_or_else(|| refuse(Reason::NoSpeed))?,
            line: None,
        })
    });
    pieces.collect()
}

/// Returns the curve of each piece that is a spline.
fn splines(start: Point, taught: &[Taught]) -> Result<Vec<Option<Cubic>>, PathError> {
    let mut curves = vec![None; taught.len()];
    let mut points = vec![start];
    for (piece, of) in taught.iter().enumerate() {
        let refuse = |reason| PathError {
            piece,
            line: None,
            reason,
        };
        if of.spline {
            if let Some((axis, value)) = no_number(of.to) {
                return Err(refuse(Reason::Coordinate { axis, value }));
            }
            if points.last() == Some(&of.to) {
                let points = ["start", "end"];
                return Err(refuse(CircleError::Coincident { points }.into()));
            }
            points.push(of.to);
        } else {
            points = vec![of.to];
        }
        let goes_on = taught.get(piece + 1).is_some_and(|next| next.spline);
        if of.spline && !goes_on {
            let first = piece + 2 - points.len();
            let cubics = Cubic::through(&points);
            for (curve, cubic) in curves[first..].iter_mut().zip(cubics) {
                *curve = Some(cubic);
            }
        }
    }
    Ok(curves)
}

/// Returns the pieces of the moves of a drawing or part program. The path begins at
/// `drawing.start`.
///
/// # Errors
/// Returns an error for an arc whose centre does not fit its ends, or a move without a feed if
/// there is no default.
pub fn from_drawing(drawing: &Drawing, speeds: impl Into<Speeds>) -> Result<Vec<Piece>, PathError> {
    let speeds = speeds.into();
    let mut from = drawing.start;
    let pieces = drawing.moves.iter().enumerate().map(|(piece, step)| {
        let begin = std::mem::replace(&mut from, step.to);
        let refuse = |reason| PathError {
            piece,
            line: Some(step.line),
            reason,
        };
        let speed = match step.rapid {
            true => Some(speeds.rapid),
            false => step
                .feed_mm_per_min
                .map(|feed| feed / 60.0)
                .or(speeds.wanted),
        };
        Ok(Piece {
            course: course(begin, &step).map_err(|error| refuse(error.into()))?,
            to: step.to,
            speed: speed.ok_or_else(|| refuse(Reason::NoSpeed))?,
            line: Some(step.line),
        })
    });
    pieces.collect()
}

fn course(from: Point, step: &Move) -> Result<Course, CircleError> {
    match step.course {
        input::Course::Line => Ok(Course::Line),
        input::Course::Spline {
            controls: [one, two],
        } => Ok(Course::Spline(Cubic {
            points: [from, one, two, step.to],
        })),
        input::Course::Arc { centre, clockwise } => {
            let axis = [0.0, 0.0, if clockwise { -1.0 } else { 1.0 }];
            let centre = [centre[0], centre[1], from[2]];
            match (step.to[2] - from[2]).abs() > ZERO_MM {
                true => Helix::around(centre, from, step.to, axis).map(Course::Helix),
                false => Circle::around(centre, from, step.to, axis).map(Course::Arc),
            }
        }
    }
}
