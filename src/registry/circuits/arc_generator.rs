use super::make::second;
use crate::arc_generator::{
    ArcGenerator, DifferenceColumn, DifferenceEngine, PositionCommand, Rotation, RotationControl,
    RotationRow, Rounding, SegmentMemory, SegmentSequencer,
};
use crate::registry::Entry;
use crate::registry::entry::{Made, at_width, entry, proved_at, some_widths};

/// The rounding by its number.
fn rounding(number: u64) -> Rounding {
    match number {
        0 => Rounding::Nearest,
        _ => Rounding::Floor,
    }
}

/// A first difference of x.
fn column<const P: usize, const F: usize, const D: usize>() -> DifferenceColumn<P, F, D> {
    DifferenceEngine::new(0).d1
}

/// The circuits of JPH0743606B2.
pub(super) const CIRCUITS: &[Entry] = &[
    entry!(
        DifferenceColumn<40, 41, 42>,
        column(),
        Some(3),
        "JPH0743606B2 [5], [10]: a difference",
        ["P" = 40, "F" = 41, "D" = 42],
        "width of wholes and parts",
        proved_at!(3; [4 8], |given, W| column::<W, W, W>())
    ),
    entry!(
        DifferenceEngine<40, 41, 42>,
        DifferenceEngine::default(),
        None,
        "JPH0743606B2 [5], [10]",
        ["P" = 40, "F" = 41, "D" = 42],
        "width of points",
        some_widths!([4 8], |given, W| DifferenceEngine::<W, { 2 * W + 1 }, { 2 * W + 1 }>::default())
    ),
    entry!(
        RotationControl<42>,
        RotationControl,
        Some(4),
        "JPH0743606B2 (ロ), which bit",
        ["C" = 42],
        "width of a coefficient",
        proved_at!(4; [4 8], |given, W| RotationControl::<W>)
    ),
    entry!(
        RotationRow<40, 42, 43, 42>,
        RotationRow::default(),
        None,
        "JPH0743606B2 (ロ), a row of R",
        ["P" = 40, "C" = 42, "S" = 43, "D" = 42],
        "width of points and coefficients, 1 for rounding down",
        some_widths!([4 8], |given, W| RotationRow::<W, W, { W + 3 }, W> {
            coordinate: 0,
            rounding: rounding(second(given, 0)),
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
            Rotation::<W, W, { W + 3 }, W>::new(rounding(second(given, 0)))
        })
    ),
    entry!(
        PositionCommand<24, 40, 42>,
        PositionCommand::default(),
        Some(2),
        "JPH0743606B2 [4]",
        ["W" = 24, "P" = 40, "D" = 42],
        "width of commands; as many guard bits",
        proved_at!(2; [4 8], |given, W| {
            PositionCommand::<W, { 2 * W }, { 2 * W }>::default()
        })
    ),
    entry!(
        SegmentMemory<4, 9, 42>,
        SegmentMemory,
        None,
        "JPH0743606B2, coefficients",
        ["A" = 4, "K" = 9, "D" = 42],
        "width of a word (two records)",
        some_widths!([4 8], |given, W| SegmentMemory::<1, 6, W>)
    ),
    entry!(
        SegmentSequencer<41, 20, 42>,
        SegmentSequencer,
        Some(2),
        "JPH0743606B2 (イ), (ロ), (ハ)",
        ["F" = 41, "N" = 20, "D" = 42],
        "width of moduli; a word has three bits more",
        proved_at!(2; [4 8], |given, W| SegmentSequencer::<W, W, { W + 3 }>)
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
            >::new(rounding(second(given, 0)))
        })
    ),
];
