//! Problems in a line.

use std::ops::Range;

/// Problem in a line, before it becomes a [`Fault`](crate::input::Fault).
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Problem {
    pub(super) field: String,
    pub(super) problem: String,
    pub(super) allowed: String,
    /// Position in the cleaned line, if known.
    pub(super) at: Option<Range<usize>>,
    /// True if it may be a consequence of an earlier fault, which has left a wrong position, mode
    /// or parameter.
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

    /// Sets the part of the cleaned line, unless a smaller one is known.
    pub(super) fn at(self, at: Range<usize>) -> Self {
        Self {
            at: Some(self.at.unwrap_or(at)),
            ..self
        }
    }

    /// Marks the problem as a possible consequence of an earlier fault.
    pub(super) fn following(self) -> Self {
        Self {
            follows: true,
            ..self
        }
    }
}
