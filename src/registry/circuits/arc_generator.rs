use super::make::{ROUNDINGS, one_of, only, width};
use crate::circuits::arc_generator::{
    ArcGenerator, PositionCommand, Rotation, RotationRow, Rounding, Widths,
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
        from: "width of commands, 1 for rounding down (half as many guard bits, two records)",
        |given| Some(ArcGenerator {
            widths: Widths::narrow(width(given)?),
            records: 1,
            rounding: one_of(given, ROUNDINGS)?,
        }),
        with: |arcs, given| Some(ArcGenerator { rounding: only(given, ROUNDINGS)?, ..arcs }),
        proved: none,
    ),
];
