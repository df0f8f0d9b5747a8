//! Widths of the arc generator's words, and of the blocks that play its records.

use super::PositionCommand;
use crate::circuits::blocks::{DifferenceEngine, RecordSequencer, difference_column};

/// Widths in bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Widths {
    /// W: position commands, signed, in counts.
    pub position: usize,
    /// P: points inside, signed, with P − W guard bits below the count.
    pub point: usize,
    /// C: coefficients of the rotation, signed, with C − 2 fraction bits.
    pub coefficient: usize,
    /// F: fractions of the difference engine; the modulus is at most 2^(F−1).
    pub fraction: usize,
    /// D: data words of a record.
    pub data: usize,
    /// N: samples of a segment.
    pub samples: usize,
    /// T: ticks of a sampling period.
    pub period: usize,
}

impl Widths {
    /// Widths of the standard build.
    pub const FULL: Widths = Widths {
        position: 24,
        point: 40,
        coefficient: 42,
        fraction: 41,
        data: 42,
        samples: 20,
        period: 24,
    };
    /// Widths of the catalogue for W: half as many guard bits.
    #[must_use]
    pub const fn narrow(position: usize) -> Widths {
        Widths {
            position,
            point: position * 3 / 2,
            coefficient: position * 3 / 2,
            fraction: 2 * position + 1,
            data: 2 * position + 1,
            samples: (2 * position).saturating_sub(2),
            period: 2 * position,
        }
    }

    /// G: bits below the count.
    #[must_use]
    pub const fn guard(&self) -> usize {
        self.point - self.position
    }

    /// B: fraction bits of a coefficient.
    #[must_use]
    pub const fn coefficient_fraction(&self) -> usize {
        self.coefficient - 2
    }

    /// Sequencer of the records.
    #[must_use]
    pub const fn sequencer(&self) -> RecordSequencer {
        RecordSequencer {
            modulus: self.fraction,
            samples: self.samples,
            data: self.data,
            waits: false,
        }
    }

    /// Difference engine for the blends and lines of a coordinate: 0, 1, 2 for x, y, z.
    #[must_use]
    pub const fn engine(&self, coordinate: u64) -> DifferenceEngine {
        let widths = difference_column::Widths {
            whole: self.point,
            part: self.fraction,
            data: self.data,
        };
        DifferenceEngine { widths, coordinate }
    }

    /// Position command of a coordinate.
    #[must_use]
    pub const fn command(self, coordinate: u64) -> PositionCommand {
        PositionCommand {
            widths: self,
            coordinate,
        }
    }

    /// Largest number of samples of a segment.
    #[must_use]
    pub const fn most_samples(&self) -> u64 {
        (1 << self.samples) - 1
    }

    /// Largest number of samples of a blend: even, with a fourth power that is a possible modulus.
    #[must_use]
    pub fn most_blend_samples(&self) -> u64 {
        let most = 1u128 << (self.fraction - 1);
        let fits = |m: u64| u128::from(m).pow(4) <= most && m <= self.most_samples();
        (1u64..)
            .map(|k| 2 * k)
            .take_while(|&m| fits(m))
            .last()
            .unwrap_or(0)
    }

    /// Farthest position command, in counts on either side of zero.
    #[must_use]
    pub fn reach(&self) -> i64 {
        (1 << (self.position - 1)) - 1
    }

    /// Returns true if a coordinate, in counts, can be rounded to a position command; false for
    /// NaN.
    #[must_use]
    pub fn holds(&self, counts: f64) -> bool {
        holds(self.position, counts)
    }

    /// Least W that holds a coordinate in counts.
    #[must_use]
    pub fn needed(counts: f64) -> usize {
        (2..1024)
            .find(|&width| holds(width, counts))
            .unwrap_or(1024)
    }
}

fn holds(width: usize, counts: f64) -> bool {
    counts.abs() < ((width - 1) as f64).exp2() - 0.5
}
