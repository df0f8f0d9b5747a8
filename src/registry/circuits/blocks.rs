use crate::blocks::{
    CoefficientControl, DifferenceColumn, DifferenceEngine, EnableCounter, MulDiv,
    QuadratureCounter, RecordMemory, RecordSequencer,
};
use crate::registry::Entry;
use crate::registry::entry::{Made, at_width, entry, proved_at, some_widths};

/// A first difference of x.
fn column<const P: usize, const F: usize, const D: usize>() -> DifferenceColumn<P, F, D> {
    DifferenceEngine::new(0).d1
}

/// Blocks that more than one circuit is made of.
pub(super) const CIRCUITS: &[Entry] = &[
    entry!(
        MulDiv<25, 58>,
        MulDiv,
        Some(3),
        "block: sequential arithmetic",
        ["M" = 25, "Q" = 58],
        "width of the words; the multiplier has one bit less",
        proved_at!([3]; [4 8], |W| MulDiv::<{ W - 1 }, W>)
    ),
    entry!(
        EnableCounter<24>,
        EnableCounter,
        Some(3),
        "block: scan and sample enables",
        ["W" = 24],
        "width",
        proved_at!([3]; [3 8], |W| EnableCounter::<W>)
    ),
    entry!(
        QuadratureCounter<32>,
        QuadratureCounter,
        Some(3),
        "block: 13 of JP3608587B2 and others",
        ["W" = 32],
        "width",
        proved_at!([3]; [2 4 8], |W| QuadratureCounter::<W>)
    ),
    entry!(
        DifferenceColumn<40, 41, 42>,
        column(),
        Some(3),
        "block: a difference of JPH0743606B2 [5], [10]",
        ["P" = 40, "F" = 41, "D" = 42],
        "width of wholes and parts",
        proved_at!([3]; [4 8], |W| column::<W, W, W>())
    ),
    entry!(
        DifferenceEngine<40, 41, 42>,
        DifferenceEngine::default(),
        None,
        "block: polynomials of JPH0743606B2, CN104204977",
        ["P" = 40, "F" = 41, "D" = 42],
        "width of points",
        some_widths!([4 8], |W| DifferenceEngine::<W, { 2 * W + 1 }, { 2 * W + 1 }>::default())
    ),
    entry!(
        CoefficientControl<42>,
        CoefficientControl,
        Some(4),
        "block: which bit of a sequential product",
        ["C" = 42],
        "width of a coefficient",
        proved_at!([4]; [4 8], |W| CoefficientControl::<W>)
    ),
    entry!(
        RecordMemory<4, 9, 42>,
        RecordMemory,
        None,
        "block: records that wait",
        ["A" = 4, "K" = 9, "D" = 42],
        "width of a word (two records)",
        some_widths!([4 8], |W| RecordMemory::<1, 6, W>)
    ),
    entry!(
        RecordSequencer<41, 20, 42>,
        RecordSequencer,
        Some(2),
        "block: record after record",
        ["F" = 41, "N" = 20, "D" = 42],
        "width of moduli; a word has three bits more",
        proved_at!([2]; [4 8], |W| RecordSequencer::<W, W, { W + 3 }>)
    ),
];
