//! Readers of input files: drawings (HPGL), part programs (G-code), position logs (CSV), and inputs
//! of a circuit, tick by tick.
//!
//! A reader of moves converts its text into a [`Drawing`]. Every reader reports errors as a
//! [`Fault`], which names the file, the line, the field, the problem and the allowed values, and
//! links to the other faults of the same file. Anything that a reader of moves skips is listed in
//! [`Drawing::warnings`]: nothing is dropped silently.

mod fault;
mod file;
pub mod gcode;
pub mod hpgl;
mod moves;
pub mod position_log;
pub mod stimulus;
mod track;

pub(crate) use fault::Faults;
use fault::brief;
pub use fault::{Excerpt, Fault, LISTED, MOST_FAULTS, SHOWN, counted, shown};
pub(crate) use file::size;
pub use file::{
    DRAWINGS, Kind, LARGEST_FILE, Language, MORE_FILES, Options, POSITION_LOGS, Zeros, as_text,
    or_more_files, read_bytes, read_path, read_path_with, read_string, read_string_of, read_text,
    read_text_with,
};
pub use moves::{Iter, Moves};

use std::fmt;

/// Number of coordinates of a [`Point`].
pub const COORDINATES: usize = 3;

/// Point in millimetres: X, Y, Z.
pub type Point = [f64; COORDINATES];

/// Greatest absolute value of a coordinate in millimetres.
pub const REACH_MM: f64 = 1.0e6;

/// Length in millimetres below which a straight move counts as zero length, in every coordinate.
/// Far below any step of a machine and far above the rounding of an `f64`.
pub const ZERO_MM: f64 = 1.0e-6;

/// Path of a move to its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Course {
    /// Straight line.
    Line,
    /// Circle in the X-Y plane; Z changes in proportion to the angle.
    Arc {
        /// Centre in millimetres (X, Y).
        centre: [f64; 2],
        /// True if clockwise, seen from +Z. Equal start and end in X and Y give a full circle.
        clockwise: bool,
    },
    /// Cubic Bézier curve with two control points between start and end. Only with
    /// [`Options::splines`].
    Spline {
        /// Control points in millimetres.
        controls: [Point; 2],
    },
}

/// Move from the end of the move before it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Move {
    /// End point in millimetres.
    pub to: Point,
    /// Path to the end.
    pub course: Course,
    /// True for pen up (HPGL) or G0: moves at the rapid rate and draws nothing.
    pub rapid: bool,
    /// Feed in mm/min, if the input sets one.
    pub feed_mm_per_min: Option<f64>,
    /// Line of the input, from 1.
    pub line: usize,
}

/// Drawing or part program: a start and the moves from there.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// Name of the file as given by the user.
    pub file: String,
    /// Start of the first move: the origin, unless a reader sets it.
    pub start: Point,
    /// Moves in order; never empty, and none of zero length.
    pub moves: Moves,
    /// W at the end of each move, in millimetres; starts at 0. Empty without [`Options::fourth`].
    pub fourth: Vec<f64>,
    /// Number of input moves of zero length. They take no time and are not in `moves`.
    pub zero_length: usize,
    /// Parts of the input that were skipped or assumed, in order.
    pub warnings: Vec<Warning>,
}

/// Warning about a part of the input that was skipped or assumed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// Name of the file as given by the user.
    pub file: String,
    /// Line from 1.
    pub line: usize,
    /// Text of the warning.
    pub text: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (file, text) = (shown(&self.file, SHOWN), shown(&self.text, SHOWN));
        write!(f, "{file}:{}: {text}", self.line)
    }
}
