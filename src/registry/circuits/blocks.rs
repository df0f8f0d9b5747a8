use crate::blocks::{EnableCounter, QuadratureCounter};
use crate::registry::Entry;
use crate::registry::entry::{Made, any_width, at_width, entry};

/// Blocks that more than one circuit is made of.
pub(super) const CIRCUITS: &[Entry] = &[
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
