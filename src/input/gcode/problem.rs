//! What is wrong with a line.

/// What is wrong with a line, before it is a [`Fault`](crate::input::Fault).
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Problem {
    pub(super) field: String,
    pub(super) problem: String,
    pub(super) allowed: String,
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
        }
    }
}

/// A piece of the input as a message shows it.
pub(super) fn shown(text: &str) -> String {
    let mut chars = text.trim().chars();
    let mut short: String = chars
        .by_ref()
        .take(20)
        .flat_map(char::escape_debug)
        .collect();
    if chars.next().is_some() {
        short.push_str("...");
    }
    short
}
