//! Types of keys.

use std::fmt;

/// Values that a key takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Width of a word, or a number of things.
    Size,
    /// Whole number from 0.
    Whole,
    /// Whole number.
    Signed,
    Flag,
    /// One of these names; some have keys of their own.
    Name(&'static [&'static str]),
    List,
    /// Table of a struct with this name and these keys.
    Table(&'static str, &'static [&'static str]),
}

impl Kind {
    /// Formats it with the numbers that TOML holds.
    pub fn most(self) -> String {
        match self {
            Kind::Size | Kind::Whole => format!("{self} to {}", i64::MAX),
            Kind::Signed => format!("{self} from {} to {}", i64::MIN, i64::MAX),
            _ => self.to_string(),
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Kind::Size | Kind::Whole => f.write_str("a whole number from 0"),
            Kind::Signed => f.write_str("a whole number"),
            Kind::Flag => f.write_str("true or false"),
            Kind::List => f.write_str("a list, [1, 2]"),
            Kind::Table(..) => f.write_str("a table, {key = value}"),
            Kind::Name(names) => {
                let (last, others) = names.split_last().unwrap_or((&"", &[]));
                for (number, name) in others.iter().enumerate() {
                    let end = match number + 1 == others.len() {
                        true => " or ",
                        false => ", ",
                    };
                    write!(f, "`{name}`{end}")?;
                }
                write!(f, "`{last}`")
            }
        }
    }
}
