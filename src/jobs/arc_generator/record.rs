//! Conversion of segments to records.

use super::bounds::rotation_error;
use super::prepared::{Prepared, Segment, Shape};
use crate::circuits::arc_generator::{Rounding, Widths};
use crate::input::{COORDINATES, Point};
use crate::path::circle::Circle;
use crate::path::error::{PathError, Reason};
use crate::path::record::{Record, WORDS, coordinate_word};
use crate::path::vector::{rodrigues, scale};
use fixed::types::I64F64;

/// Returns the records of a path at `counts_per_mm`.
///
/// Every segment begins at the word at which the one before ends; an arc ends there within its
/// [`rotation_error`].
///
/// # Errors
/// Returns an error if a coordinate, centre or radius does not fit in its word, with the width
/// needed.
pub fn records(
    prepared: &Prepared,
    counts_per_mm: f64,
    widths: &Widths,
    rounding: Rounding,
) -> Result<Vec<Record>, PathError> {
    let segments = prepared.segments.iter().map(|segment| {
        fits(segment, counts_per_mm, widths, rounding).map_err(|reason| PathError {
            piece: segment.piece,
            line: prepared
                .pieces
                .get(segment.piece)
                .and_then(|piece| piece.line),
            reason,
        })?;
        Ok(record(segment, counts_per_mm, widths))
    });
    segments.collect()
}

/// Checks that a segment's points fit in their words.
fn fits(
    segment: &Segment,
    counts_per_mm: f64,
    widths: &Widths,
    rounding: Rounding,
) -> Result<(), Reason> {
    let check = |what, counts: f64| match widths.holds(counts) {
        true => Ok(()),
        false => Err(Reason::Reach {
            what,
            counts,
            most: widths.reach(),
            width: widths.position,
            needed: Widths::needed(counts),
        }),
    };
    let check_point = |names: [&'static str; COORDINATES], point: Point, error: f64| {
        let coordinates = names.into_iter().zip(point);
        coordinates
            .map(|(what, mm)| (what, mm * counts_per_mm))
            .try_for_each(|(what, counts)| check(what, counts + error.copysign(counts)))
    };
    let names = ["x", "y", "z"];
    // A point is rounded to a guard unit and then to a count.
    let unit = (-(widths.guard() as f64)).exp2();
    match &segment.shape {
        // A blend is inside the triangle of its points.
        Shape::Blend {
            before,
            corner,
            behind,
        } => [before, corner, behind]
            .into_iter()
            .try_for_each(|point| check_point(names, *point, unit)),
        Shape::Line { from, to } => [from, to]
            .into_iter()
            .try_for_each(|point| check_point(names, *point, unit)),
        Shape::Arc { circle, from, step } => {
            let radius = circle.radius * counts_per_mm;
            let error = rotation_error(radius, segment.samples, widths, rounding);
            check("radius", radius + error)?;
            let names_of_centre = ["centre x", "centre y", "centre z"];
            check_point(names_of_centre, circle.centre, unit)?;
            let part = Circle {
                start: circle.point(*from),
                angle: step * segment.samples as f64,
                ..*circle
            };
            let extremes = part.extremes();
            (0..2).try_for_each(|end| check_point(names, extremes.map(|k| k[end]), error))
        }
    }
}

fn record(segment: &Segment, counts_per_mm: f64, widths: &Widths) -> Record {
    let units =
        |point: Point| scale(point, counts_per_mm).map(|counts| quantise(counts, widths.guard()));
    let mut words = [0; WORDS];
    words[0] = segment.kind() as u64 | u64::from(segment.ends_at_rest) << 2 | segment.samples << 3;
    let mut put = |first: usize, values: [i64; COORDINATES], bits: usize| {
        for (word, value) in words[first..].iter_mut().zip(values) {
            *word = signed(value, bits);
        }
    };
    let (point, coefficient) = (widths.point, widths.coefficient);
    let (modulus, differences): (u128, [[i128; 4]; COORDINATES]) = match &segment.shape {
        Shape::Arc { circle, from, step } => {
            let centre = units(circle.centre);
            let begin = units(circle.point(*from));
            let vector = std::array::from_fn(|k| begin[k] - centre[k]);
            put(2, vector, point);
            put(5, centre, point);
            let matrix = rodrigues(circle.axis, *step);
            for (row, coefficients) in matrix.into_iter().enumerate() {
                let fraction = widths.coefficient_fraction();
                let coefficients = coefficients.map(|value| quantise(value, fraction));
                put(coordinate_word(row), coefficients, coefficient);
            }
            words[1] = 1;
            return Record { words };
        }
        Shape::Line { from, to } => {
            let (from, to) = (units(*from), units(*to));
            put(2, from, point);
            let way = std::array::from_fn(|k| [i128::from(to[k]) - i128::from(from[k]), 0, 0, 0]);
            (u128::from(segment.samples), way)
        }
        Shape::Blend {
            before,
            corner,
            behind,
        } => {
            let [before, corner, behind] = [before, corner, behind].map(|point| units(*point));
            put(2, before, point);
            let of =
                |k: usize| blend_differences([before[k], corner[k], behind[k]], segment.samples);
            (u128::from(segment.samples).pow(4), std::array::from_fn(of))
        }
    };
    words[1] = modulus as u64;
    for (coordinate, differences) in differences.into_iter().enumerate() {
        let words = &mut words[coordinate_word(coordinate)..];
        put_differences(words, differences, modulus as i128, point);
    }
    Record { words }
}

/// Returns a word in two's complement.
pub(super) fn signed(value: i64, bits: usize) -> u64 {
    value as u64 & ((1 << bits) - 1)
}

/// Writes differences as integer parts of `bits` bits and fractional parts.
pub(super) fn put_differences(
    words: &mut [u64],
    differences: [i128; 4],
    modulus: i128,
    bits: usize,
) {
    for (pair, difference) in words.chunks_exact_mut(2).zip(differences) {
        pair[0] = signed(difference.div_euclid(modulus) as i64, bits);
        pair[1] = difference.rem_euclid(modulus) as u64;
    }
}

/// Returns the differences of x·M⁴ at the first sample, in guard units, of x = A⁻ + 2(A − A⁻)h +
/// S(2 − h)h³ with h = n/M and S = A⁻ − 2A + A⁺.
pub(super) fn blend_differences([before, corner, behind]: [i64; 3], samples: u64) -> [i128; 4] {
    let [before, corner, behind] = [before, corner, behind].map(i128::from);
    let (bend, m) = (before - 2 * corner + behind, i128::from(samples));
    [
        2 * (corner - before) * m * m * m + bend * (2 * m - 1),
        bend * (12 * m - 14),
        bend * (12 * m - 36),
        -24 * bend,
    ]
}

/// Returns the nearest multiple of 2^-`fraction` as an integer; halves round away from zero.
pub(super) fn quantise(value: f64, fraction: usize) -> i64 {
    // 64 bits on each side of the point hold everything that fits into a word.
    let units = I64F64::saturating_from_num(value).saturating_mul(I64F64::ONE << fraction);
    units.round().saturating_to_num()
}
