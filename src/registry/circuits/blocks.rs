use crate::blocks::{EnableCounter, MulDiv, QuadratureCounter};
use crate::registry::Entry;
use crate::registry::entry::{Made, any_width, at_width, entry};

/// Blocks that more than one circuit is made of.
pub(super) const CIRCUITS: &[Entry] = &[
    entry!(
        MulDiv<25, 58>,
        MulDiv,
        Some(3),
        "block: sequential arithmetic",
        ["M" = 25, "Q" = 58],
        "width of the words; the multiplier has one bit less",
        Made {
            make: |given| at_width!([2 3 4], given, W => MulDiv::<{ W - 1 }, W>),
            model: |given| at_width!([2 3 4 8 32], given, W => MulDiv::<{ W - 1 }, W>),
            offered: &[2, 3, 4, 8, 32],
        }
    ),
    entry!(
        EnableCounter<24>,
        EnableCounter,
        Some(3),
        "block: scan and sample enables",
        ["W" = 24],
        "width",
        any_width!(|given, W| EnableCounter::<W>)
    ),
    entry!(
        QuadratureCounter<32>,
        QuadratureCounter,
        Some(3),
        "block: 13 of JP3608587B2 and others",
        ["W" = 32],
        "width",
        any_width!(|given, W| QuadratureCounter::<W>)
    ),
];
