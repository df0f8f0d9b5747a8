//! All circuits by name: what `list` and `check` show, what a note's timing charts run.

mod circuits;
mod entry;
mod model;

pub use circuits::CATALOGUE;
pub use entry::{Entry, MODEL_WIDTHS, WIDTHS};
pub use model::{AnyCircuit, AnyModel, Verdict};

/// The entry of that name.
pub fn find(name: &str) -> Option<&'static Entry> {
    CATALOGUE.iter().find(|entry| entry.name == name)
}
