use crate::linear_interpolator::{PositionControl, PositionLoop};
use crate::registry::Entry;
use crate::registry::entry::{Made, any_width, at_width, entry};

/// The circuits of JP3608587B2.
pub(super) const CIRCUITS: &[Entry] = &[
    entry!(
        PositionControl,
        PositionControl,
        Some(3),
        "JP3608587B2 10 + 11 + 12",
        ["P" = 32, "G" = 16, "F" = 8, "D" = 16, "R" = 48],
        "width of positions, gain and D/A converter; half of the gain is its fraction",
        any_width!(|given, W| PositionControl::<W, W, { W / 2 }, W, { 2 * W }>)
    ),
    entry!(
        PositionLoop,
        PositionLoop::default(),
        Some(2),
        "JP3608587B2 10–13",
        ["P" = 32, "G" = 16, "F" = 8, "D" = 16, "R" = 48],
        "width of positions, gain and D/A converter; half of the gain is its fraction",
        any_width!(|given, W| PositionLoop::<W, W, { W / 2 }, W, { 2 * W }>::default())
    ),
];
