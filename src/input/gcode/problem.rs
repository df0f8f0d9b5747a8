//! What is wrong with a line.

use std::ops::Range;

/// What is wrong with a line, before it is a [`Fault`](crate::input::Fault).
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Problem {
    pub(super) field: String,
    pub(super) problem: String,
    pub(super) allowed: String,
    /// Where in the cleaned line, if known.
    pub(super) at: Option<Range<usize>>,
    /// It may be the doing of another fault before it, which has left a position, a mode or a
    /// parameter other than was meant.
    pub(super) follows: bool,
}

impl Problem {
    pub(super) fn new(
        field: impl Into<String>,
        problem: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Self {
        Self {
            field: field.into(),
            problem: problem.into(),
            allowed: allowed.into(),
            at: None,
            follows: false,
        }
    }

    /// The same, of a part of the cleaned line, unless a smaller one is known.
    pub(super) fn at(self, at: Range<usize>) -> Self {
        Self {
            at: Some(self.at.unwrap_or(at)),
            ..self
        }
    }

    /// The same, which may be the doing of another fault.
    pub(super) fn following(self) -> Self {
        Self {
            follows: true,
            ..self
        }
    }
}
