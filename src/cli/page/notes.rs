//! Notes of the page, which it loads when a reader asks for one: JSON with their texts by path.

use super::{Program, packed};
use crate::cli::notes::NOTES;
use serde::Serialize;
use std::collections::BTreeMap;

/// Name of their file beside the page.
pub const FILE: &str = "notes.json";

/// Where the page has them.
#[derive(Debug, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Notes {
    /// In the page itself: base64 of a zlib stream.
    Within(String),
    /// At an address beside the page.
    Beside(&'static str),
}

impl Notes {
    /// Those of a page with this program; `None` if no notes ship.
    pub fn beside(program: &Program<'_>) -> Option<Self> {
        (!NOTES.is_empty()).then(|| match program {
            Program::Within(_) => Notes::Within(packed(json().as_bytes())),
            _ => Notes::Beside(FILE),
        })
    }
}

/// Returns the text of each note by its path, as JSON.
pub fn json() -> String {
    let notes: BTreeMap<_, _> = NOTES.iter().copied().collect();
    // A map of texts is JSON.
    serde_json::to_string(&notes).unwrap_or_default()
}
