//! Records of a profile in the arc generator's format; coordinate x is the length.
//!
//! ```text
//!  q(t)   ──────┬───────────────┬─────────   pieces of constant jerk
//!  samples  ·   ·   ·   ·   ·   ·   ·   ·    at n·Δt
//!           ════╪   ╪═══════════╪   ╪═════   records of a cubic
//!               └───┘           └───┘        records of one sample, a line, where the piece changes
//! ```
//!
//! Samples of a cubic have constant third differences, so a record plays it by three additions per
//! sample. It begins at a whole guard unit; its differences are multiples of 2^-40 of one. The
//! first difference is chosen such that the record ends where the piece does, so that rounding at
//! the start does not persist. Every sample is therefore within a guard unit of q(t), and the last
//! is L.

use super::profile::{Cubic, Profile};
use crate::circuits::trajectory_controller::{Rounding, Widths};
use crate::jobs::arc_generator::reference::Decoded;
use crate::path::record::{Record, WORDS, coordinate_word};

/// Greatest number of samples of a record: within them, third differences rounded to 2^-40 add up
/// to less than a fiftieth of a guard unit.
const MOST_SAMPLES: u64 = 1 << 13;

/// Kinds of records, both played alike.
const CUBIC: u64 = 0;
const LINE: u64 = 1;

/// Returns the records of a profile, with a sample every `period`, in the profile's unit of time.
///
/// Sample 0 is the start. Sample n is at n·period, up to the last, which is the first at or after
/// the profile's end.
#[must_use]
pub fn records(profile: &Profile, period: f64, widths: &Widths) -> Vec<Record> {
    let last = (profile.duration / period).ceil() as u64;
    let most = MOST_SAMPLES.min(widths.record().most_samples());
    let time = |sample: u64| sample as f64 * period;
    let at = |sample: u64| match sample < last {
        true => profile.at(time(sample))[0],
        false => profile.length,
    };
    let mut records = Vec::new();
    let mut sample = 0;
    while sample < last {
        let index = profile.index(time(sample));
        let end = match profile.pieces.get(index + 1) {
            Some(next) => next.t,
            None => profile.duration,
        };
        // Last sample before the piece's end.
        let inside = ((end / period).ceil() as u64).saturating_sub(1);
        let inside = inside.min(sample + most);
        let ends = [at(sample), at(inside.max(sample + 1))];
        let next = inside.max(sample + 1);
        let (kind, differences) = match inside > sample {
            true => {
                let piece = &profile.pieces[index];
                (CUBIC, cubic(piece, time(sample), period, widths))
            }
            false => (LINE, [0; 2]),
        };
        let rests = u64::from(next == last);
        records.push(record(
            kind | rests << 2 | (next - sample) << 3,
            next - sample,
            ends.map(|length| length.round() as i64),
            ends[1],
            differences,
            widths,
        ));
        sample = next;
    }
    records
}

/// Returns second and third difference of a piece's samples from a time on, in units of the
/// modulus.
fn cubic(piece: &Cubic, t: f64, period: f64, widths: &Widths) -> [i128; 2] {
    let [_, _, a] = piece.at(t);
    let third = piece.jerk * period.powi(3);
    let second = a * period.powi(2) + third;
    [second, third].map(|difference| (difference * modulus(widths) as f64).round() as i128)
}

/// Returns 2^(F − 1).
fn modulus(widths: &Widths) -> i128 {
    1 << (widths.fraction - 1)
}

fn record(
    header: u64,
    samples: u64,
    [start, end]: [i64; 2],
    exact_end: f64,
    [second, third]: [i128; 2],
    widths: &Widths,
) -> Record {
    let (n, modulus) = (i128::from(samples), modulus(widths));
    // From the start by n first, C(n, 2) second and C(n, 3) third differences to the end.
    let way = i128::from(end - start) * modulus;
    let way = match samples {
        1 => way,
        // Adds the fractional part of the end.
        _ => way + ((exact_end - end as f64) * modulus as f64).round() as i128,
    };
    let bends = n * (n - 1) / 2 * second + n * (n - 1) * (n - 2) / 6 * third;
    let first = (way - bends + n / 2).div_euclid(n);
    let signed = |value: i128| value as u64 & ((1 << widths.point) - 1);
    let mut words = [0; WORDS];
    words[0] = header;
    words[1] = modulus as u64;
    words[2] = signed(i128::from(start));
    let pairs = words[coordinate_word(0)..].chunks_exact_mut(2);
    for (pair, difference) in pairs.zip([first, second, third]) {
        pair[0] = signed(difference.div_euclid(modulus));
        pair[1] = difference.rem_euclid(modulus) as u64;
    }
    Record { words }
}

/// Returns the lengths of all samples, the start first, by plain integer arithmetic.
#[must_use]
pub fn lengths(records: &[Record], widths: &Widths) -> Vec<i64> {
    let samples = records.iter().enumerate().flat_map(|(index, record)| {
        let decoded = Decoded::of(record, &widths.record());
        let points = decoded.points(&widths.record(), Rounding::Nearest);
        points.into_iter().skip(usize::from(index > 0))
    });
    samples.map(|[length, ..]| length).collect()
}
