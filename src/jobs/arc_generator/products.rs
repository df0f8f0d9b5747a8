//! Blends and lines by products: their records, and an integer model of the circuit.
//!
//! | word | contents for a blend or line by products |
//! |---|---|
//! | 1 | number of samples M |
//! | 2, 3, 4 | 0: the distance from A⁻ |
//! | 5, 6, 7 | start A⁻ |
//! | 8c + 8, 8c + 9 | of coordinate c: 2(A − A⁻), S; for a line its length, 0 |
//! | 10, 11, 12 | h = 0; 1/M as integer and fractional part, in units of 2^-B |
//!
//! Other words are 0; headers and arcs are unchanged.

use super::prepared::{Prepared, Segment, Shape};
use super::record::{self, quantise, signed};
use super::reference::{Decoded, Points, commands_of, signed as wrap};
use crate::circuits::arc_generator::blend_point::SHARE_WORD;
use crate::circuits::arc_generator::{Rounding, Widths};
use crate::circuits::blocks::record_memory::ARC;
use crate::input::COORDINATES;
use crate::path::error::PathError;
use crate::path::record::{Record, WORDS, coordinate_word};
use crate::path::vector::scale;

/// Returns the records of a path at `counts_per_mm`; `widths` are those of products.
///
/// # Errors
/// Returns the errors of [`record::records`].
pub fn records(
    prepared: &Prepared,
    counts_per_mm: f64,
    widths: &Widths,
    rounding: Rounding,
) -> Result<Vec<Record>, PathError> {
    let mut records = record::records(prepared, counts_per_mm, widths, rounding)?;
    for (record, segment) in records.iter_mut().zip(&prepared.segments) {
        rewrite(record, segment, counts_per_mm, widths);
    }
    Ok(records)
}

/// Replaces the words of a blend or line by those for products.
fn rewrite(record: &mut Record, segment: &Segment, counts_per_mm: f64, widths: &Widths) {
    let units = |point| scale(point, counts_per_mm).map(|counts| quantise(counts, widths.guard()));
    let (before, slope, bend) = match segment.shape {
        Shape::Arc { .. } => return,
        Shape::Line { from, to } => {
            let (from, to) = (units(from), units(to));
            (
                from,
                std::array::from_fn(|k| to[k] - from[k]),
                [0; COORDINATES],
            )
        }
        Shape::Blend {
            before,
            corner,
            behind,
        } => {
            let [before, corner, behind] = [before, corner, behind].map(units);
            let slope: [i64; COORDINATES] = std::array::from_fn(|k| 2 * (corner[k] - before[k]));
            let bend = |k: usize| before[k] - 2 * corner[k] + behind[k];
            (before, slope, std::array::from_fn(bend))
        }
    };
    let mut words = [0; WORDS];
    words[0] = record.words[0];
    words[1] = segment.samples;
    for k in 0..COORDINATES {
        words[5 + k] = signed(before[k], widths.point);
        words[coordinate_word(k)] = signed(slope[k], widths.point + 2);
        words[coordinate_word(k) + 1] = signed(bend[k], widths.point + 2);
    }
    let one = 1u64 << widths.coefficient_fraction();
    // A segment without samples has no step.
    let samples = segment.samples.max(1);
    words[SHARE_WORD as usize + 1] = one / samples;
    words[SHARE_WORD as usize + 2] = one % samples;
    record.words = words;
}

/// Returns the position commands of such records in counts: the start of the first and every
/// sample of all.
pub fn commands<'a>(
    records: &'a [Record],
    widths: &Widths,
    rounding: Rounding,
) -> impl Iterator<Item = [i64; COORDINATES]> + use<'a> {
    let all = *widths;
    commands_of(records, widths, move |record| {
        points(record, &all, rounding)
    })
}

/// Returns the points of a record's samples in guard units, starting with its start.
#[must_use]
pub fn points(record: &Record, widths: &Widths, rounding: Rounding) -> Points {
    let decoded = Decoded::of(record, widths);
    if decoded.kind == ARC {
        return decoded.points(widths, rounding);
    }
    let fraction = widths.coefficient_fraction();
    let nearest = move |product: i128| (product + (1 << (fraction - 1))) >> fraction;
    let modulus = i128::from(decoded.modulus);
    let (words, bits) = (record.words, widths.point);
    let word = |k: usize| i128::from(words[k]);
    let first = SHARE_WORD as usize;
    let (start, step) = (
        word(first) * modulus,
        word(first + 1) * modulus + word(first + 2),
    );
    let point = move |n: u64| {
        let share = start + i128::from(n) * step;
        let h = (2 * share + modulus).div_euclid(2 * modulus);
        let square = nearest(h * h);
        let weight = nearest(square * (2 * h - square));
        std::array::from_fn(|k| {
            let term = |place: usize| i128::from(wrap(words[coordinate_word(k) + place], bits + 2));
            let way = match n {
                0 => i128::from(decoded.start[k]),
                _ => nearest(term(0) * h + term(1) * weight),
            };
            wrap((i128::from(decoded.origin[k]) + way) as u64, bits)
        })
    };
    Box::new((0..=decoded.samples).map(point))
}
