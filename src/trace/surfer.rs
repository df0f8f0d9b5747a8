//! Mapping files for Surfer: states by name.

use super::layout::Layout;
use super::{LayoutError, Options};
use crate::netlist::Format;
use crate::sim::Described;
use std::fmt::Write;

/// Folder in which Surfer looks for mapping files, in the directory where it is started.
pub const FOLDER: &str = ".surfer/mappings";

/// A mapping file. Surfer offers its name as the format of signals of the same width.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mapping {
    /// Name of the file.
    pub file: String,
    /// Contents of the file.
    pub text: String,
}

/// Signals that share their states and their width.
struct Table {
    states: &'static [&'static str],
    width: usize,
    signals: Vec<String>,
}

/// Returns a mapping file for each list of states in a dump. It is called after the first signal
/// with these states, and lists all of them.
///
/// # Errors
/// Returns the errors of [`Vcd::new`](super::Vcd::new).
pub fn mappings(circuit: &impl Described, options: &Options) -> Result<Vec<Mapping>, LayoutError> {
    let layout = Layout::of(circuit, options.only.as_deref())?;
    let mut tables: Vec<Table> = Vec::new();
    for (leaf, selected) in layout.leaves.iter().zip(&layout.selected) {
        let (true, Format::States(states)) = (*selected, leaf.field.format) else {
            continue;
        };
        let width = leaf.shape.width;
        let mut known = tables.iter_mut();
        match known.find(|table| table.states == states && table.width == width) {
            Some(table) => table.signals.push(leaf.path()),
            None => tables.push(Table {
                states,
                width,
                signals: vec![leaf.path()],
            }),
        }
    }
    Ok(tables.iter().map(Table::mapping).collect())
}

impl Table {
    fn mapping(&self) -> Mapping {
        let name = &self.signals[0];
        let mut text = String::new();
        // Writing to a string cannot fail.
        for signal in &self.signals {
            let _ = writeln!(text, "# {signal}");
        }
        let _ = writeln!(text, "Name = {name}\nBits = {}", self.width);
        // Surfer refuses a file with a number that is wider than its signals.
        let codes = 1u128 << self.width;
        for (code, state) in (0..codes).zip(self.states) {
            let _ = writeln!(text, "{code} {state}");
        }
        Mapping {
            file: format!("{name}.mapping"),
            text,
        }
    }
}
