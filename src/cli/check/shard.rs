//! A part of the work.

use serde::{Deserialize, Serialize};
use std::ops::Range;
use std::str::FromStr;

/// A part of the work; part 1 of 1 is all of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Shard {
    /// Number of the part, from 1.
    pub part: u32,
    /// Count of parts.
    pub of: u32,
}

impl Default for Shard {
    fn default() -> Self {
        Shard { part: 1, of: 1 }
    }
}

impl FromStr for Shard {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let numbers = text
            .split_once('/')
            .and_then(|(part, of)| Some((part.parse().ok()?, of.parse().ok()?)));
        match numbers {
            Some((part, of)) if (1..=of).contains(&part) => Ok(Shard { part, of }),
            _ => Err("allowed: a part and how many there are, 1/4 to 4/4 for instance"),
        }
    }
}

impl Shard {
    /// Its cases of a sweep.
    pub fn range(self, cases: u64) -> Range<u64> {
        let at = |part: u32| {
            let at = u128::from(cases) * u128::from(part) / u128::from(self.of);
            at as u64
        };
        at(self.part - 1)..at(self.part)
    }
}
