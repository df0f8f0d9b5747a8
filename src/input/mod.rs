//! What comes in: drawings (HPGL), part programs (G-code) and position logs (CSV).
//!
//! A reader of moves turns its text into a [`Drawing`], every reader what it cannot use into a
//! [`Fault`] that names the file, the line, the field, what was wrong and what is allowed, and that
//! leads to the others found in the same file. What a reader of moves skips it says in
//! [`Drawing::warnings`]: nothing is dropped silently.

mod fault;
mod file;
pub mod gcode;
pub mod hpgl;
mod moves;
pub mod position_log;
mod track;

pub(crate) use fault::Faults;
use fault::brief;
pub use fault::{Excerpt, Fault, LISTED, MOST_FAULTS, SHOWN, shown};
pub(crate) use file::size;
pub use file::{
    DRAWINGS, Kind, LARGEST_FILE, MORE_FILES, Options, POSITION_LOGS, Zeros, or_more_files,
    read_bytes, read_path, read_path_with, read_string, read_string_of, read_text, read_text_with,
};
pub use moves::{Iter, Moves};

use std::fmt;

/// The number of coordinates of a [`Point`].
pub const COORDINATES: usize = 3;

/// A point in millimetres: X, Y, Z.
pub type Point = [f64; COORDINATES];

/// The farthest coordinate a reader lets through, in millimetres, on either side of zero.
pub const REACH_MM: f64 = 1.0e6;

/// A straight move that changes no coordinate by this much, in millimetres, counts as zero
/// length. It is far below any step of a machine and far above the rounding of an `f64`.
pub const ZERO_MM: f64 = 1.0e-6;

/// How a move gets to its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Course {
    /// Straight.
    Line,
    /// On a circle in the X-Y plane; Z, where it changes, changes in proportion to the angle.
    Arc {
        /// Centre in millimetres (X, Y).
        centre: [f64; 2],
        /// Seen from +Z. A start equal to the end in X and Y is a full circle.
        clockwise: bool,
    },
    /// On a cubic curve with these two control points between start and end, in Bézier's form. Only
    /// where [`Options::splines`] asks for it.
    Spline {
        /// In millimetres.
        controls: [Point; 2],
    },
}

/// One move, from the end of the move before it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Move {
    /// Where it ends, in millimetres.
    pub to: Point,
    /// Straight or on an arc.
    pub course: Course,
    /// Pen up (HPGL) or G0: travels at the rapid rate, draws nothing.
    pub rapid: bool,
    /// Feed in mm/min where the input sets one.
    pub feed_mm_per_min: Option<f64>,
    /// Line of the input it stands in, from 1.
    pub line: usize,
}

/// A drawing or a part program: a start and the moves from there.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// The file's name as the user gave it.
    pub file: String,
    /// Where the first move starts: the origin, unless a reader says otherwise.
    pub start: Point,
    /// The moves, in order. Never empty, and none of zero length.
    pub moves: Moves,
    /// W at the end of each move, in millimetres; it begins at 0. Empty without [`Options::fourth`].
    pub fourth: Vec<f64>,
    /// How many moves of the input had zero length. They take no time and are not in `moves`.
    pub zero_length: usize,
    /// What was skipped or assumed, in order.
    pub warnings: Vec<Warning>,
}

/// Something a reader skipped or assumed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// The file's name as the user gave it.
    pub file: String,
    /// Line from 1.
    pub line: usize,
    /// What was skipped or assumed.
    pub text: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (file, text) = (shown(&self.file, SHOWN), shown(&self.text, SHOWN));
        write!(f, "{file}:{}: {text}", self.line)
    }
}
