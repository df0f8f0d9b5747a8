use super::make::{BLENDS, ROUNDINGS, at_most, choice, width};
use crate::circuits::arc_generator::matrix_element::Sign;
use crate::circuits::arc_generator::{
    AngleStep, ArcGenerator, AxisTerms, Blend, BlendPoint, BlendRow, BlendWeight, Conventional,
    MatrixElement, PositionCommand, Rotation, RotationRow, Rounding, SineWords, VectorRow, Widths,
};
use crate::registry::Entry;
use crate::registry::entry::entry;

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
        widths: [point, coefficient, data in widths],
        by: "width of points and coefficients, 1 for rounding down",
        |width, rounding of ROUNDINGS| row(square(width), rounding),
        proved: none,
    ),
    entry!(
        Rotation, "JPH0743606B2 (ロ)",
        full: || Rotation { widths: Widths::FULL, rounding: Rounding::default() },
        widths: [point, coefficient, data in widths],
        by: "width of points and coefficients, 1 for rounding down",
        |width, rounding of ROUNDINGS| Rotation { widths: square(width), rounding },
        proved: none,
    ),
    entry!(
        PositionCommand, "JPH0743606B2 [4]",
        full: || Widths::FULL.command(0),
        widths: [position, point, data in widths],
        by: "width of commands; as many guard bits",
        |position| {
            let points = square(2 * position);
            Widths { position, ..points }.command(0)
        },
        proved: 2,
    ),
    entry!(
        ArcGenerator, "JPH0743606B2",
        full: ArcGenerator::default,
        widths: [
            position = widths.position, point = widths.point, coefficient = widths.coefficient,
            fraction = widths.fraction, data = widths.data, samples = widths.samples, records,
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
        by: "width of a coefficient", |coefficient| BlendWeight { coefficient },
        proved: none,
    ),
    entry!(
        BlendRow, "JPH0743606B2 [5], [10], a coordinate",
        full: || BlendRow { widths: Widths::FULL, coordinate: 0 },
        widths: [point, data in widths],
        by: "width of points; words have two bits more",
        |point| {
            let widths = Widths { point, data: point + 2, ..Widths::FULL };
            BlendRow { widths, coordinate: 0 }
        },
        proved: none,
    ),
    entry!(
        BlendPoint, "JPH0743606B2 [5], [10]",
        full: || BlendPoint { widths: Blend::Products.widths(Widths::FULL) },
        widths: [point, coefficient, fraction, data in widths],
        by: "width of points, coefficients and moduli; words have two bits more",
        |width| BlendPoint {
            widths: Widths { fraction: width, data: width + 2, ..square(width) },
        },
        proved: none,
    ),
    entry!(
        AngleStep, "JPH0743606B2, prior art: Δθ",
        full: || AngleStep { width: Widths::FULL.coefficient },
        widths: [width],
        by: "width", |width| AngleStep { width },
        proved: 4,
    ),
    entry!(
        SineWords, "JPH0743606B2, prior art: sin, cos, vers",
        full: || SineWords { coefficient: Widths::FULL.coefficient },
        widths: [coefficient],
        by: "width of a coefficient", |coefficient| SineWords { coefficient },
        proved: none,
    ),
    entry!(
        AxisTerms, "JPH0743606B2, prior art: k",
        full: || AxisTerms {
            coefficient: Widths::FULL.coefficient,
            data: Widths::FULL.data,
        },
        widths: [coefficient, data],
        by: "width of a coefficient", |width| AxisTerms { coefficient: width, data: width },
        proved: none,
    ),
    entry!(
        MatrixElement, "JPH0743606B2, prior art [2]",
        full: || MatrixElement {
            coefficient: Widths::FULL.coefficient,
            sign: Sign::default(),
        },
        widths: [coefficient],
        by: "width of a coefficient, 1 for a term that is subtracted",
        |coefficient, sign of SIGNS| MatrixElement { coefficient, sign },
        proved: none,
    ),
    entry!(
        VectorRow, "JPH0743606B2, prior art [3], a row",
        full: || vector_row(Widths::FULL, Rounding::default()),
        widths: [point, coefficient, data in widths],
        by: "width of points and coefficients, 1 for rounding down",
        |width, rounding of ROUNDINGS| vector_row(square(width), rounding),
        proved: none,
    ),
    entry!(
        Conventional, "JPH0743606B2, prior art: Figs 5 and 6",
        full: Conventional::default,
        widths: [
            position = widths.position, point = widths.point, coefficient = widths.coefficient,
            fraction = widths.fraction, data = widths.data, samples = widths.samples, records,
            period = widths.period,
        ],
        by: "width of commands, 1 for rounding down (half as many guard bits, two records)",
        |width, rounding of ROUNDINGS| Conventional {
            widths: Widths::narrow(width),
            records: 1,
            rounding,
        },
        proved: none,
    ),
];
