use crate::linear_interpolator::{PatternGenerator, Trapezoid};
use crate::registry::Entry;
use crate::registry::entry::{Made, at_width, entry, some_widths};

/// The circuits of JP3608587B2.
pub(super) const CIRCUITS: &[Entry] = &[
    entry!(
        Trapezoid<32, 12, 25, 58>,
        Trapezoid,
        None,
        "JP3608587B2 14, control",
        ["P" = 32, "T" = 12, "M" = 25, "Q" = 58],
        "width of positions; times have half of it",
        some_widths!([4 8], |given, W| Trapezoid::<W, { W / 2 }, { W + 1 }, { 2 * W + 2 }>)
    ),
    entry!(
        PatternGenerator<32, 12, 25, 58>,
        PatternGenerator::default(),
        None,
        "JP3608587B2 14",
        ["P" = 32, "T" = 12, "M" = 25, "Q" = 58],
        "width of positions; times have half of it",
        some_widths!([2 4 8], |given, W| {
            PatternGenerator::<W, { W / 2 }, { W + 1 }, { 2 * W + 2 }>::default()
        })
    ),
];
