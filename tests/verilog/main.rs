//! The netlist and its text, without any simulator of Verilog.

mod errors;
mod interpreter;
mod netlists;
mod snapshots;
mod text;

use motion_rtl::kernel::Declaration;
use motion_rtl::registry::{AnyModel, CATALOGUE, MODEL_WIDTHS};

/// Every circuit of the catalogue at every width that is offered, and at its own.
fn circuits() -> impl Iterator<Item = Box<dyn AnyModel>> {
    CATALOGUE.iter().flat_map(|entry| {
        let widths = MODEL_WIDTHS.iter();
        let made = widths.filter_map(|width| (entry.model)(&[*width]));
        made.chain([(entry.full)()])
    })
}

/// Scopes and name joined by `_`.
fn flat(leaf: &Declaration) -> String {
    leaf.path().replace('.', "_")
}
