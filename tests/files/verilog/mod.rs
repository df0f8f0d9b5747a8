//! The netlist and its text, without any simulator of Verilog.

mod errors;
mod interpreter;
mod netlists;
mod snapshots;
mod text;

use motion_rtl::kernel::Declaration;
use motion_rtl::registry::{AnyModel, CATALOGUE, Entry};

/// Every circuit of the catalogue at every width that is offered, and at its own.
fn circuits() -> impl Iterator<Item = Box<dyn AnyModel>> {
    CATALOGUE.iter().flat_map(models)
}

/// A circuit at its widths, the full one last.
fn models(entry: &'static Entry) -> impl Iterator<Item = Box<dyn AnyModel>> {
    let widths = entry.offered.iter();
    let made = widths.map(|width| (entry.model)(&[*width]).expect(entry.name));
    made.chain([(entry.full)()])
}

/// Scopes and name joined by `_`.
fn flat(leaf: &Declaration) -> String {
    leaf.path().replace('.', "_")
}
