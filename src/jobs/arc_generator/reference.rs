//! Reference model of records by integer arithmetic: every sample of a blend or line from its
//! polynomial by a division, every rotation by full products.

use crate::circuits::arc_generator::{Rounding, Widths};
use crate::input::COORDINATES;
use crate::path::record::{Record, coordinate_word};

/// Points of a record, one by one.
pub type Points = Box<dyn Iterator<Item = [i64; COORDINATES]>>;

/// Decoded record, in guard units.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Decoded {
    /// Kind: 0 blend, 1 line, 2 arc.
    pub kind: u64,
    pub ends_at_rest: bool,
    /// Number of samples.
    pub samples: u64,
    /// Modulus of the differences.
    pub modulus: u64,
    /// Start; for an arc the vector from the centre.
    pub start: [i64; COORDINATES],
    /// Centre of an arc, else 0.
    pub origin: [i64; COORDINATES],
    /// Words of each coordinate: differences as integer and fractional part, or a matrix row.
    pub coordinates: [[i64; 8]; COORDINATES],
}

impl Decoded {
    /// Decodes a record as the circuit does: upper bits of signed words are ignored.
    #[must_use]
    pub fn of(record: &Record, widths: &Widths) -> Self {
        let words = &record.words;
        let header = words[0];
        let kind = header & 3;
        let point = |word: usize| signed(words[word], widths.point);
        let coordinates = std::array::from_fn(|coordinate| {
            std::array::from_fn(|k| {
                let word = words[coordinate_word(coordinate) + k];
                match (kind, k % 2) {
                    (2, _) => signed(word, widths.coefficient),
                    (_, 0) => signed(word, widths.point),
                    _ => word as i64,
                }
            })
        });
        Decoded {
            kind,
            ends_at_rest: header & 4 != 0,
            samples: header >> 3 & ((1 << widths.samples) - 1),
            modulus: words[1],
            start: std::array::from_fn(|k| point(2 + k)),
            origin: std::array::from_fn(|k| point(5 + k)),
            coordinates,
        }
    }

    /// Returns the points of its samples in guard units, starting with its start.
    #[must_use]
    pub fn points(self, widths: &Widths, rounding: Rounding) -> Points {
        let widths = *widths;
        match self.kind {
            2 => self.rotated(&widths, rounding),
            _ => Box::new((0..=self.samples).map(move |n| self.interpolated(n, &widths))),
        }
    }

    /// Computes Newton's forward formula: value + Σ C(n, k)·dₖ, rounded to the nearest, halves
    /// upwards.
    fn interpolated(&self, n: u64, widths: &Widths) -> [i64; COORDINATES] {
        let modulus = i128::from(self.modulus);
        std::array::from_fn(|coordinate| {
            let mut sum = i128::from(self.start[coordinate]) * modulus;
            let mut ways = 1;
            for (k, pair) in (0..).zip(self.coordinates[coordinate].chunks_exact(2)) {
                ways = ways * (i128::from(n) - k) / (k + 1);
                sum += ways * (i128::from(pair[0]) * modulus + i128::from(pair[1]));
            }
            let nearest = (2 * sum + modulus).div_euclid(2 * modulus);
            signed(nearest as u64, widths.point)
        })
    }

    fn rotated(self, widths: &Widths, rounding: Rounding) -> Points {
        let (fraction, point) = (widths.coefficient_fraction(), widths.point);
        let half = match rounding {
            Rounding::Nearest => 1i128 << (fraction - 1),
            Rounding::Floor => 0,
        };
        let vectors = std::iter::successors(Some(self.start), move |vector| {
            Some(std::array::from_fn(|row| {
                let products = self.coordinates[row].iter().zip(vector);
                let sum: i128 = products.map(|(&r, &v)| i128::from(r) * i128::from(v)).sum();
                signed(((sum + half) >> fraction) as u64, point)
            }))
        });
        let points = vectors.map(move |v| std::array::from_fn(|k| self.origin[k] + v[k]));
        Box::new(points.take(self.samples as usize + 1))
    }
}

/// Returns the position commands of a path in counts: the start of the first record and every
/// sample of all.
pub fn commands<'a>(
    records: &'a [Record],
    widths: &Widths,
    rounding: Rounding,
) -> impl Iterator<Item = [i64; COORDINATES]> + use<'a> {
    let all = *widths;
    commands_of(records, widths, move |record| {
        Decoded::of(record, &all).points(&all, rounding)
    })
}

/// Returns the position commands of records whose points `points` computes.
pub(super) fn commands_of<'a, F: Fn(&Record) -> Points + 'a>(
    records: &'a [Record],
    widths: &Widths,
    points: F,
) -> impl Iterator<Item = [i64; COORDINATES]> + use<'a, F> {
    let guard = widths.guard();
    let half = (1i64 << guard) >> 1;
    let segments = records
        .iter()
        .enumerate()
        .flat_map(move |(index, record)| points(record).skip(usize::from(index > 0)));
    segments.map(move |point| point.map(|units| (units + half) >> guard))
}

/// Reads a word of `bits` bits as two's complement.
pub(super) fn signed(word: u64, bits: usize) -> i64 {
    let unused = 64 - bits;
    (word << unused) as i64 >> unused
}
