//! A path as it is wanted: pieces, from taught points or from the moves of a drawing.

use super::circle::{Circle, CircleError};
use super::error::{PathError, Reason};
use super::settings::Settings;
use crate::input::{self, Drawing, Move, Point};

/// How a piece gets to its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Course {
    /// Straight.
    Line,
    /// On an arc, which begins where the piece before ends.
    Arc(Circle),
}

/// One piece of a path, from the end of the piece before it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// Straight or on an arc.
    pub course: Course,
    /// Where it ends, in mm.
    pub to: Point,
    /// Vs: the speed that is wanted, in mm/s.
    pub speed: f64,
    /// Line of the input it stands in.
    pub line: Option<usize>,
}

/// A piece as it is taught: by points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Taught {
    /// C: where it ends, in mm.
    pub to: Point,
    /// B: a point of the arc; without it the piece is a line.
    pub via: Option<Point>,
    /// Its speed in mm/s, where it has its own.
    pub speed: Option<f64>,
}

/// The pieces of taught points.
///
/// # Errors
/// Three points that make no arc; a piece without a speed where the settings have none either.
pub fn from_points(
    start: Point,
    taught: &[Taught],
    settings: &Settings,
) -> Result<Vec<Piece>, PathError> {
    let mut from = start;
    let pieces = taught.iter().enumerate().map(|(piece, taught)| {
        let begin = std::mem::replace(&mut from, taught.to);
        let refuse = |reason| PathError {
            piece,
            line: None,
            reason,
        };
        let course = match taught.via {
            None => Ok(Course::Line),
            Some(via) => Circle::through(begin, via, taught.to).map(Course::Arc),
        };
        let speed = taught.speed.or(settings.speed_mm_per_s);
        Ok(Piece {
            course: course.map_err(|error| refuse(error.into()))?,
            to: taught.to,
            speed: speed.ok_or_else(|| refuse(Reason::NoSpeed))?,
            line: None,
        })
    });
    pieces.collect()
}

/// The pieces of a drawing's or a part program's moves. The path begins at `drawing.start`.
///
/// # Errors
/// An arc that rises, or whose centre fits no arc; a move without a feed where the settings have no
/// speed either.
pub fn from_drawing(drawing: &Drawing, settings: &Settings) -> Result<Vec<Piece>, PathError> {
    let mut from = drawing.start;
    let pieces = drawing.moves.iter().enumerate().map(|(piece, step)| {
        let begin = std::mem::replace(&mut from, step.to);
        let refuse = |reason| PathError {
            piece,
            line: Some(step.line),
            reason,
        };
        let speed = match step.rapid {
            true => Some(settings.rapid_mm_per_s),
            false => step
                .feed_mm_per_min
                .map(|feed| feed / 60.0)
                .or(settings.speed_mm_per_s),
        };
        Ok(Piece {
            course: course(begin, step).map_err(|error| refuse(error.into()))?,
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
        input::Course::Arc { centre, clockwise } => {
            let axis = [0.0, 0.0, if clockwise { -1.0 } else { 1.0 }];
            let centre = [centre[0], centre[1], from[2]];
            Circle::around(centre, from, step.to, axis).map(Course::Arc)
        }
    }
}
