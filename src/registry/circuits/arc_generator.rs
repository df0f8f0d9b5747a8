use crate::circuits::arc_generator::matrix_element::Sign;
use crate::circuits::arc_generator::{
    AngleStep, ArcGenerator, AxisTerms, Blend, BlendPoint, BlendRow, BlendWeight, Conventional,
    MatrixElement, PositionCommand, Rotation, RotationRow, Rounding, SineWords, VectorRow, Widths,
};
use crate::registry::Entry;
use crate::registry::entry::entry;

/// Widths of the full circuits.
const FULL: Widths = Widths::FULL;

/// Points, coefficients and words of records of four bits.
const SMALL: Widths = Widths {
    point: 4,
    coefficient: 4,
    data: 4,
    ..FULL
};

/// A row of x.
fn row(widths: Widths) -> RotationRow {
    RotationRow {
        widths,
        coordinate: 0,
        rounding: Rounding::Nearest,
    }
}

/// A row of x whose matrix changes.
fn vector_row(widths: Widths) -> VectorRow {
    VectorRow {
        widths,
        coordinate: 0,
        rounding: Rounding::Nearest,
    }
}

/// The circuits of JPH0743606B2.
pub(super) const CIRCUITS: &[Entry] = &[
    entry!(
        RotationRow, "JPH0743606B2 (ロ), a row of R",
        full: row(FULL),
        small: row(SMALL), uses: [point, coefficient, data],
    ),
    entry!(
        Rotation, "JPH0743606B2 (ロ)",
        full: Rotation { widths: FULL, rounding: Rounding::Nearest },
        small: Rotation { widths: SMALL, rounding: Rounding::Nearest },
        uses: [point, coefficient, data],
    ),
    entry!(
        PositionCommand, "JPH0743606B2 [4]",
        full: FULL.command(0),
        small: Widths { position: 2, ..SMALL }.command(0), uses: [position, point, data],
        proved: true,
    ),
    entry!(
        ArcGenerator, "JPH0743606B2",
        full: ArcGenerator::default(),
        small: ArcGenerator { widths: Widths::narrow(4), records: 1, ..ArcGenerator::default() },
    ),
    entry!(
        BlendWeight, "JPH0743606B2 [5], [10]: (2 − h)h³",
        full: BlendWeight { coefficient: FULL.coefficient },
        small: BlendWeight { coefficient: 4 },
    ),
    entry!(
        BlendRow, "JPH0743606B2 [5], [10], a coordinate",
        full: BlendRow { widths: FULL, coordinate: 0 },
        small: BlendRow { widths: Widths { point: 4, data: 6, ..FULL }, coordinate: 0 },
        uses: [point, data],
    ),
    entry!(
        BlendPoint, "JPH0743606B2 [5], [10]",
        full: BlendPoint { widths: Blend::Products.widths(FULL) },
        small: BlendPoint { widths: Widths { fraction: 4, data: 6, ..SMALL } },
        uses: [point, coefficient, fraction, data],
    ),
    entry!(
        AngleStep, "JPH0743606B2, prior art: Δθ",
        full: AngleStep { width: FULL.coefficient },
        small: AngleStep { width: 4 }, proved: true,
    ),
    entry!(
        SineWords, "JPH0743606B2, prior art: sin, cos, vers",
        full: SineWords { coefficient: FULL.coefficient },
        small: SineWords { coefficient: 4 },
    ),
    entry!(
        AxisTerms, "JPH0743606B2, prior art: k",
        full: AxisTerms { coefficient: FULL.coefficient, data: FULL.data },
        small: AxisTerms { coefficient: 4, data: 4 },
    ),
    entry!(
        MatrixElement, "JPH0743606B2, prior art [2]",
        full: MatrixElement { coefficient: FULL.coefficient, sign: Sign::Plus },
        small: MatrixElement { coefficient: 4, sign: Sign::Plus },
    ),
    entry!(
        VectorRow, "JPH0743606B2, prior art [3], a row",
        full: vector_row(FULL),
        small: vector_row(SMALL), uses: [point, coefficient, data],
    ),
    entry!(
        Conventional, "JPH0743606B2, prior art: Figs 5 and 6",
        full: Conventional::default(),
        small: Conventional { widths: Widths::narrow(4), records: 1, ..Conventional::default() },
    ),
];
