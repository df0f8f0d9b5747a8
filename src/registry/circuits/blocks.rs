use crate::blocks::MulDiv;
use crate::registry::Entry;
use crate::registry::entry::{Made, at_width, entry};

/// Blocks that more than one circuit is made of.
pub(super) const CIRCUITS: &[Entry] = &[entry!(
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
)];
