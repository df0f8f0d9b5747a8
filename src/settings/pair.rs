//! Keys with values, as `--set` and timing charts give them.

use std::fmt;
use std::num::IntErrorKind;
use std::str::FromStr;
use toml::{Table, Value};

/// Key and value of an override, `key=value`.
///
/// # Errors
/// Text without `=` or without a key, in words.
pub(crate) fn key_value(text: &str) -> Result<(&str, &str), &'static str> {
    let (key, value) = text.split_once('=').ok_or("no '='")?;
    match key.trim() {
        "" => Err("no key"),
        key => Ok((key, value.trim())),
    }
}

/// The TOML value that a text is, or else the text as a string: `variant=literal`.
pub(crate) fn value(text: &str) -> Value {
    let parsed = format!("x = {text}").parse::<Table>().ok();
    parsed
        .filter(|table| table.len() == 1)
        .and_then(|mut table| table.remove("x"))
        .unwrap_or_else(|| Value::String(text.to_owned()))
}

/// Returns the problem of a number that TOML does not hold, or of a list or table that is no TOML:
/// [`value`] takes these as text.
pub(crate) fn unread(text: &str) -> Option<String> {
    if text.starts_with(['[', '{']) {
        let error = format!("x = {text}").parse::<Table>().err()?;
        return Some(match error.message() {
            message if message.ends_with(" as i128") || message.contains(" as i128, ") => {
                format!("is {text}, with a number that is too large")
            }
            message => format!("is {text}: {message}"),
        });
    }
    match text.replace('_', "").parse::<i64>().err()?.kind() {
        IntErrorKind::PosOverflow => Some(format!("is {text}: too large")),
        IntErrorKind::NegOverflow => Some(format!("is {text}: too small")),
        _ => None,
    }
}

/// A key of a circuit and its value as TOML; a bare word is a string.
///
/// ```
/// use motion_rtl::registry::Pair;
///
/// let pair: Pair = "widths.position=20".parse()?;
/// assert_eq!(pair, Pair::new("widths.position", 20));
/// # Ok::<(), motion_rtl::registry::PairError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Pair {
    /// Dotted key.
    pub key: String,
    /// Value.
    pub value: String,
}

/// Text that is not `key=value`.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{text}`: {problem}; allowed: key=value")]
pub struct PairError {
    /// The text.
    pub text: String,
    /// Missing part.
    pub problem: &'static str,
}

impl Pair {
    /// Returns a pair of these.
    pub fn new(key: impl Into<String>, value: impl ToString) -> Self {
        Pair {
            key: key.into(),
            value: value.to_string(),
        }
    }
}

impl FromStr for Pair {
    type Err = PairError;

    fn from_str(text: &str) -> Result<Self, PairError> {
        let (key, value) = key_value(text).map_err(|problem| PairError {
            text: text.to_owned(),
            problem,
        })?;
        Ok(Pair::new(key, value))
    }
}

impl fmt::Display for Pair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}", self.key, self.value)
    }
}
