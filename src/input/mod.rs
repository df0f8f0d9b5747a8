//! What comes in: drawings (HPGL), part programs (G-code), position logs (CSV) and scenario files.
//!
//! A reader of moves turns its text into a [`Drawing`], every reader what it cannot use into a
//! [`Fault`] that names the file, the line, the field, what was wrong and what is allowed. What a
//! reader of moves skips it says in [`Drawing::warnings`]: nothing is dropped silently.

mod file;
pub mod gcode;
pub mod hpgl;
pub mod position_log;
pub mod scenario;
mod track;

pub(crate) use file::size;
pub use file::{
    DRAWINGS, Kind, LARGEST_FILE, Options, POSITION_LOGS, read_bytes, read_path, read_path_with,
    read_string, read_text, read_text_with,
};

use std::borrow::Cow;
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
    pub moves: Vec<Move>,
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

/// Input that cannot be used.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// The file's name as the user gave it.
    pub file: String,
    /// Line from 1; 0 where the file as a whole is meant.
    pub line: usize,
    /// The instruction, word or key at fault.
    pub field: String,
    /// What is wrong.
    pub problem: String,
    /// What would be right.
    pub allowed: String,
}

impl std::error::Error for Fault {}

/// Characters at most of what a message has from a file.
pub const SHOWN: usize = 1000;

/// Characters at most of what a message lists as allowed.
pub const LISTED: usize = 10_000;

/// A part of a message that comes from a file or an argument: of so many characters at most, and
/// without control characters, which a terminal would obey.
#[must_use]
pub fn shown(text: &str, most: usize) -> Cow<'_, str> {
    let cut = text.char_indices().nth(most).map(|(end, _)| end);
    if cut.is_none() && !text.contains(char::is_control) {
        return Cow::Borrowed(text);
    }
    let mut plain = String::new();
    for character in text[..cut.unwrap_or(text.len())].chars() {
        match character.is_control() {
            true => plain.extend(character.escape_default()),
            false => plain.push(character),
        }
    }
    if let Some(end) = cut {
        plain.push_str(&format!("... ({} bytes more)", text.len() - end));
    }
    Cow::Owned(plain)
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [file, field, problem] =
            [&self.file, &self.field, &self.problem].map(|text| shown(text, SHOWN));
        let allowed = shown(&self.allowed, LISTED);
        match self.line {
            0 => write!(f, "{file}: ")?,
            line => write!(f, "{file}:{line}: ")?,
        }
        write!(f, "{field}: {problem}; allowed: {allowed}")
    }
}

impl Fault {
    pub(crate) fn new(
        file: &str,
        line: usize,
        field: impl Into<String>,
        problem: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Self {
        Self {
            file: file.to_owned(),
            line,
            field: field.into(),
            problem: problem.into(),
            allowed: allowed.into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_have_an_end_and_nothing_that_a_terminal_obeys() {
        assert_eq!(shown("a \u{e9} b", SHOWN), "a \u{e9} b");
        assert_eq!(
            shown("a\u{1b}[2J\r\n\u{9b}", SHOWN),
            "a\\u{1b}[2J\\r\\n\\u{9b}"
        );
        let long = "\u{e9}".repeat(SHOWN);
        assert_eq!(shown(&long, SHOWN), long);
        let text = shown(&format!("{long}\u{e9}ab"), SHOWN).into_owned();
        assert_eq!(text, format!("{long}... (4 bytes more)"));
        let fault = Fault::new("f\n", 3, "\t".repeat(SHOWN + 1), "p\0", "a\u{7f}");
        let field = "\\t".repeat(SHOWN);
        let text = format!("f\\n:3: {field}... (1 bytes more): p\\u{{0}}; allowed: a\\u{{7f}}");
        assert_eq!(fault.to_string(), text);
    }
}
