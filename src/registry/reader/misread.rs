//! Errors of reading a circuit.

use super::Kind;
use serde::de::{self, Expected, Unexpected};
use std::fmt;

/// A value that a key does not take, or a key that its table does not have.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{key}: {problem}; allowed: {allowed}")]
pub struct Misread {
    /// Dotted key, of an unknown key that of its table.
    pub key: String,
    pub problem: String,
    pub allowed: String,
    /// True if a key is unknown.
    pub unknown: bool,
    /// True if a name that has keys stands without them.
    pub bare: bool,
}

impl Misread {
    pub fn new(problem: String, allowed: String) -> Self {
        Misread {
            key: String::new(),
            problem,
            allowed,
            unknown: false,
            bare: false,
        }
    }
}

impl de::Error for Misread {
    fn custom<T: fmt::Display>(problem: T) -> Self {
        let whole = "the key with all of its table, KEY={a=1, b=2}";
        Misread::new(problem.to_string(), whole.to_owned())
    }

    fn invalid_type(given: Unexpected, expected: &dyn Expected) -> Self {
        Misread::new(format!("invalid type: {given}"), expected.to_string())
    }

    fn invalid_value(given: Unexpected, expected: &dyn Expected) -> Self {
        Misread::new(format!("invalid value: {given}"), expected.to_string())
    }

    fn invalid_length(length: usize, expected: &dyn Expected) -> Self {
        Misread::new(format!("invalid length {length}"), expected.to_string())
    }

    fn unknown_variant(name: &str, names: &'static [&'static str]) -> Self {
        Misread::new(
            format!("unknown variant `{name}`"),
            Kind::Name(names).to_string(),
        )
    }

    fn unknown_field(field: &str, fields: &'static [&'static str]) -> Self {
        Misread {
            unknown: true,
            ..Misread::new(
                format!("unknown field `{field}`"),
                Kind::Name(fields).to_string(),
            )
        }
    }
}
