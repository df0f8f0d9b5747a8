use super::make::{ROUNDINGS, one_of};
use crate::arc_generator::{ArcGenerator, PositionCommand, Rotation, RotationRow, Rounding};
use crate::registry::Entry;
use crate::registry::entry::{Made, at_width, entry, proved_at, some_widths};

/// The circuits of JPH0743606B2.
pub(super) const CIRCUITS: &[Entry] = &[
    entry!(
        RotationRow<40, 42, 43, 42>,
        RotationRow::default(),
        None,
        "JPH0743606B2 (ロ), a row of R",
        ["P" = 40, "C" = 42, "S" = 43, "D" = 42],
        "width of points and coefficients, 1 for rounding down",
        some_widths!([4 8], |given, W| RotationRow::<W, W, { W + 3 }, W> {
            coordinate: 0,
            rounding: one_of(given, ROUNDINGS)?,
        })
    ),
    entry!(
        Rotation<40, 42, 43, 42>,
        Rotation::new(Rounding::default()),
        None,
        "JPH0743606B2 (ロ)",
        ["P" = 40, "C" = 42, "S" = 43, "D" = 42],
        "width of points and coefficients, 1 for rounding down",
        some_widths!([4 8], |given, W| {
            Rotation::<W, W, { W + 3 }, W>::new(one_of(given, ROUNDINGS)?)
        })
    ),
    entry!(
        PositionCommand<24, 40, 42>,
        PositionCommand::default(),
        Some(2),
        "JPH0743606B2 [4]",
        ["W" = 24, "P" = 40, "D" = 42],
        "width of commands; as many guard bits",
        proved_at!([2]; [4 8], |W| {
            PositionCommand::<W, { 2 * W }, { 2 * W }>::default()
        })
    ),
    entry!(
        ArcGenerator,
        ArcGenerator::default(),
        None,
        "JPH0743606B2",
        [
            "W" = 24,
            "P" = 40,
            "C" = 42,
            "S" = 43,
            "F" = 41,
            "D" = 42,
            "N" = 20,
            "A" = 4,
            "K" = 9,
            "T" = 24
        ],
        "width of commands, 1 for rounding down (half as many guard bits, two records)",
        some_widths!([4 8], |given, W| {
            ArcGenerator::<
                W,
                { W * 3 / 2 },
                { W * 3 / 2 },
                { W * 3 / 2 + 3 },
                { 2 * W + 1 },
                { 2 * W + 1 },
                { 2 * W - 2 },
                1,
                6,
                { 2 * W },
            >::new(one_of(given, ROUNDINGS)?)
        })
    ),
];
