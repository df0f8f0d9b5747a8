use super::make::{BLENDS, ROUNDINGS, at_most, choice, one_of, only, width};
use crate::circuits::arc_generator::matrix_element::Sign;
use crate::circuits::arc_generator::{
    AngleStep, ArcGenerator, AxisTerms, Blend, BlendPoint, BlendRow, BlendWeight, Conventional,
    MatrixElement, PositionCommand, Rotation, RotationRow, Rounding, SineWords, VectorRow, Widths,
};
use crate::registry::Entry;
use crate::registry::entry::{alone, entry, nothing};

/// Points, coefficients and words of records of one width.
fn square(width: usize) -> Widths {
    Widths {
        point: width,
        coefficient: width,
        data: width,
        ..Widths::FULL
    }
}

/// A row of x.
fn row(widths: Widths, rounding: Rounding) -> RotationRow {
    RotationRow {
        widths,
        coordinate: 0,
        rounding,
    }
}

/// The command of x.
fn command(widths: Widths) -> PositionCommand {
    PositionCommand {
        widths,
        coordinate: 0,
    }
}

/// How a generator rounds and makes its blends.
fn generator(given: &[u64]) -> Option<(Rounding, Blend)> {
    at_most(given, 2)?;
    Some((choice(given, 0, ROUNDINGS)?, choice(given, 1, BLENDS)?))
}

/// Signs of an element's second term, by their numbers.
const SIGNS: &[Sign] = &[Sign::Plus, Sign::Minus];

/// A row of x whose matrix changes.
fn vector_row(widths: Widths, rounding: Rounding) -> VectorRow {
    VectorRow {
        widths,
        coordinate: 0,
        rounding,
    }
}

/// The circuits of JPH0743606B2.
pub(super) const CIRCUITS: &[Entry] = &[
    entry!(
        RotationRow, "JPH0743606B2 (ロ), a row of R",
        full: || row(Widths::FULL, Rounding::default()),
        widths: [
            point = widths.point,
            coefficient = widths.coefficient,
            data = widths.data,
        ],
        from: "width of points and coefficients, 1 for rounding down", |given| {
            Some(row(square(width(given)?), one_of(given, ROUNDINGS)?))
        },
        with: |row, given| Some(RotationRow { rounding: only(given, ROUNDINGS)?, ..row }),
        proved: none,
    ),
    entry!(
        Rotation, "JPH0743606B2 (ロ)",
        full: || Rotation { widths: Widths::FULL, rounding: Rounding::default() },
        widths: [
            point = widths.point,
            coefficient = widths.coefficient,
            data = widths.data,
        ],
        from: "width of points and coefficients, 1 for rounding down", |given| {
            let (widths, rounding) = (square(width(given)?), one_of(given, ROUNDINGS)?);
            Some(Rotation { widths, rounding })
        },
        with: |rotation, given| Some(Rotation { rounding: only(given, ROUNDINGS)?, ..rotation }),
        proved: none,
    ),
    entry!(
        PositionCommand, "JPH0743606B2 [4]",
        full: || command(Widths::FULL),
        widths: [position = widths.position, point = widths.point, data = widths.data],
        from: "width of commands; as many guard bits", |given| {
            alone(given, |position| {
                let points = square(2 * position);
                command(Widths { position, ..points })
            })
        },
        with: nothing,
        proved: 2,
    ),
    entry!(
        ArcGenerator, "JPH0743606B2",
        full: ArcGenerator::default,
        widths: [
            position = widths.position,
            point = widths.point,
            coefficient = widths.coefficient,
            fraction = widths.fraction,
            data = widths.data,
            samples = widths.samples,
            records,
            period = widths.period,
        ],
        from: "width of commands, 1 for rounding down, 1 for blends by products (half as many guard \
               bits, two records)",
        |given| {
            let (rounding, blend) = generator(given.get(1..)?)?;
            Some(ArcGenerator {
                widths: blend.widths(Widths::narrow(width(given)?)),
                records: 1,
                rounding,
                blend,
            })
        },
        with: |arcs, given| {
            let (rounding, blend) = generator(given)?;
            Some(ArcGenerator { widths: blend.widths(arcs.widths), rounding, blend, ..arcs })
        },
        proved: none,
    ),
    entry!(
        BlendWeight, "JPH0743606B2 [5], [10]: (2 − h)h³",
        full: || BlendWeight { coefficient: Widths::FULL.coefficient },
        widths: [coefficient],
        from: "width of a coefficient",
        |given| alone(given, |coefficient| BlendWeight { coefficient }),
        with: nothing,
        proved: none,
    ),
    entry!(
        BlendRow, "JPH0743606B2 [5], [10], a coordinate",
        full: || BlendRow { widths: Widths::FULL, coordinate: 0 },
        widths: [point = widths.point, data = widths.data],
        from: "width of points; words have two bits more", |given| alone(given, |point| {
            let widths = Widths { point, data: point + 2, ..Widths::FULL };
            BlendRow { widths, coordinate: 0 }
        }),
        with: nothing,
        proved: none,
    ),
    entry!(
        BlendPoint, "JPH0743606B2 [5], [10]",
        full: || BlendPoint { widths: Blend::Products.widths(Widths::FULL) },
        widths: [
            point = widths.point,
            coefficient = widths.coefficient,
            fraction = widths.fraction,
            data = widths.data,
        ],
        from: "width of points, coefficients and moduli; words have two bits more", |given| {
            alone(given, |width| BlendPoint {
                widths: Widths { fraction: width, data: width + 2, ..square(width) },
            })
        },
        with: nothing,
        proved: none,
    ),
    entry!(
        AngleStep, "JPH0743606B2, prior art: Δθ",
        full: || AngleStep { width: Widths::FULL.coefficient },
        widths: [width],
        from: "width", |given| alone(given, |width| AngleStep { width }),
        with: nothing,
        proved: 4,
    ),
    entry!(
        SineWords, "JPH0743606B2, prior art: sin, cos, vers",
        full: || SineWords { coefficient: Widths::FULL.coefficient },
        widths: [coefficient],
        from: "width of a coefficient",
        |given| alone(given, |coefficient| SineWords { coefficient }),
        with: nothing,
        proved: none,
    ),
    entry!(
        AxisTerms, "JPH0743606B2, prior art: k",
        full: || AxisTerms {
            coefficient: Widths::FULL.coefficient,
            data: Widths::FULL.data,
        },
        widths: [coefficient, data],
        from: "width of a coefficient",
        |given| alone(given, |width| AxisTerms { coefficient: width, data: width }),
        with: nothing,
        proved: none,
    ),
    entry!(
        MatrixElement, "JPH0743606B2, prior art [2]",
        full: || MatrixElement {
            coefficient: Widths::FULL.coefficient,
            sign: Sign::default(),
        },
        widths: [coefficient],
        from: "width of a coefficient, 1 for a term that is subtracted", |given| {
            Some(MatrixElement { coefficient: width(given)?, sign: one_of(given, SIGNS)? })
        },
        with: |element, given| Some(MatrixElement { sign: only(given, SIGNS)?, ..element }),
        proved: none,
    ),
    entry!(
        VectorRow, "JPH0743606B2, prior art [3], a row",
        full: || vector_row(Widths::FULL, Rounding::default()),
        widths: [
            point = widths.point,
            coefficient = widths.coefficient,
            data = widths.data,
        ],
        from: "width of points and coefficients, 1 for rounding down", |given| {
            Some(vector_row(square(width(given)?), one_of(given, ROUNDINGS)?))
        },
        with: |row, given| Some(VectorRow { rounding: only(given, ROUNDINGS)?, ..row }),
        proved: none,
    ),
    entry!(
        Conventional, "JPH0743606B2, prior art: Figs 5 and 6",
        full: Conventional::default,
        widths: [
            position = widths.position,
            point = widths.point,
            coefficient = widths.coefficient,
            fraction = widths.fraction,
            data = widths.data,
            samples = widths.samples,
            records,
            period = widths.period,
        ],
        from: "width of commands, 1 for rounding down (half as many guard bits, two records)",
        |given| Some(Conventional {
            widths: Widths::narrow(width(given)?),
            records: 1,
            rounding: one_of(given, ROUNDINGS)?,
        }),
        with: |arcs, given| Some(Conventional { rounding: only(given, ROUNDINGS)?, ..arcs }),
        proved: none,
    ),
];
