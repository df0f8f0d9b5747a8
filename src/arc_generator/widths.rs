//! Widths of the arc generator's words, as numbers.

/// Widths in bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Widths {
    /// W: position commands, signed, in counts.
    pub position: u32,
    /// P: points inside, signed, with P − W guard bits below the count.
    pub point: u32,
    /// C: coefficients of the rotation, signed, with C − 2 fraction bits.
    pub coefficient: u32,
    /// F: fractions of the difference engine; the modulus is at most 2^(F−1).
    pub fraction: u32,
    /// D: data words of a record.
    pub data: u32,
    /// N: samples of a segment.
    pub samples: u32,
    /// T: ticks of a sampling period.
    pub period: u32,
}

impl Widths {
    /// The circuit's own.
    pub const FULL: Widths = Widths {
        position: 24,
        point: 40,
        coefficient: 42,
        fraction: 41,
        data: 42,
        samples: 20,
        period: 24,
    };
    /// The catalogue's at W = 8.
    pub const EIGHT: Widths = Widths {
        position: 8,
        point: 12,
        coefficient: 12,
        fraction: 17,
        data: 17,
        samples: 14,
        period: 16,
    };
    /// The catalogue's at W = 4.
    pub const FOUR: Widths = Widths {
        position: 4,
        point: 6,
        coefficient: 6,
        fraction: 9,
        data: 9,
        samples: 6,
        period: 8,
    };

    /// G: bits below the count.
    #[must_use]
    pub const fn guard(&self) -> u32 {
        self.point - self.position
    }

    /// B: fraction bits of a coefficient.
    #[must_use]
    pub const fn coefficient_fraction(&self) -> u32 {
        self.coefficient - 2
    }

    /// The most samples of a segment.
    #[must_use]
    pub const fn most_samples(&self) -> u64 {
        (1 << self.samples) - 1
    }

    /// The most samples of a blend: even, and its fourth power is a modulus.
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

    /// Whether a coordinate so far from zero is rounded to a position command. `false` for NaN.
    #[must_use]
    pub fn holds(&self, counts: f64) -> bool {
        holds(self.position, counts)
    }

    /// The least W that holds it.
    #[must_use]
    pub fn needed(counts: f64) -> u32 {
        (2..1024).find(|&w| holds(w, counts)).unwrap_or(1024)
    }
}

fn holds(width: u32, counts: f64) -> bool {
    counts.abs() < f64::from(width - 1).exp2() - 0.5
}
