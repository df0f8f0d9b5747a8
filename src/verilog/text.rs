//! Ranges of words in Verilog.

use crate::netlist::{Kind, Shape};

/// Beginning of a comment.
pub(super) const MARK: &str = "//";

/// `signed` and the range of a word, with a space behind.
pub(super) fn range(shape: Shape) -> String {
    let signed = if shape.kind == Kind::Signed {
        "signed "
    } else {
        ""
    };
    match shape.width {
        1 => signed.to_owned(),
        width => format!("{signed}[{}:0] ", width - 1),
    }
}

/// The room that the ranges of such words take.
pub(super) fn column(shapes: impl Iterator<Item = Shape>) -> usize {
    shapes.map(|shape| range(shape).len()).max().unwrap_or(0)
}
