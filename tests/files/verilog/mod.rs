//! The netlist and its text, without any simulator of Verilog.

mod connections;
mod errors;
mod interpreter;
mod netlists;
mod snapshots;
mod text;

use motion_rtl::hdl::Declaration;
use motion_rtl::registry::{AnyModel, CATALOGUE, Entry};

/// Every circuit of the catalogue at narrow widths, and at its own.
fn circuits() -> impl Iterator<Item = Box<dyn AnyModel>> {
    CATALOGUE.iter().flat_map(models)
}

/// A circuit at narrow widths, as far as it can be made at them, and at its own.
pub fn models(entry: &'static Entry) -> impl Iterator<Item = Box<dyn AnyModel>> {
    let made = [2, 3, 4, 8].into_iter();
    let made = made.filter_map(|width| entry.scaled(width));
    made.chain([entry.full()])
}

/// Scopes and name joined by `_`.
fn flat(leaf: &Declaration) -> String {
    leaf.path().replace('.', "_")
}
