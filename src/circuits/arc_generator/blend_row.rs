//! Row of a blend by products: one coordinate of 2(A − A⁻)h + S(2 − h)h³, both products at once,
//! one bit of h and of the weight per tick.
//!
//! ```text
//!                             ┌───────────┐
//!  load, word, data ─────────▶│           │
//!  copy, fraction, commit ───▶│ blend_row ├──▶ offset
//!  share_bit, weight_bit ────▶│           │
//!                             └───────────┘
//! ```
//!
//! The sum is halved after each fraction bit, as in a [`RotationRow`](super::RotationRow); the
//! last bit shifted out rounds the result, so nothing is lost before.

use super::Widths;
use super::rotation_row::halved;
use crate::circuits::blocks::RecordWord;
use crate::prelude::*;

/// Row of a blend, of x, y or z.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BlendRow {
    /// Widths of points and records.
    pub widths: Widths,
    /// 0, 1, 2 for x, y, z: it decides which words of a record the row takes.
    pub coordinate: u64,
}

impl BlendRow {
    /// Width of a multiplicand: a difference of points, doubled.
    pub const fn term(&self) -> usize {
        self.widths.point + 2
    }

    /// Width of the sum: two terms, doubled.
    pub const fn sum(&self) -> usize {
        self.term() + 2
    }
}

signals! { for BlendRow as c;
    /// Input ports.
    pub struct In {
        /// Word of a record.
        pub record: RecordWord(&c.widths.data) as Flat,
        /// A pass begins.
        pub copy: Bit,
        /// The bit is one of the fraction.
        pub fraction: Bit,
        /// The sum is complete: it becomes the point.
        pub commit: Bit,
        /// The bit of h.
        pub share_bit: Bit,
        /// The bit of (2 − h)h³.
        pub weight_bit: Bit,
    }
    /// Flip-flops.
    pub struct Reg {
        /// 2(A − A⁻); on a line its whole length.
        slope: I(c.term()) = 0,
        /// S = A⁻ − 2A + A⁺, on a line 0.
        bend: I(c.term()) = 0,
        /// This row's coordinate of the vector from A⁻ to the point.
        pub offset: I(c.widths.point) as Analog = 0,
        /// Partial sum of the products, in units of the next bit's weight.
        sum: I(c.sum()) = 0,
        /// The bit below the sum: a half.
        half: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// The slope where h has the bit, else 0.
        term_slope: I(c.sum()),
        /// The bend where the weight has the bit, else 0.
        term_bend: I(c.sum()),
        /// The sum with both.
        total: I(c.sum()),
        /// Sum plus the rounding term.
        raised: I(c.sum()),
        /// The coordinate, to the nearest, a half upwards.
        rounded: I(c.widths.point),
    }
}

impl Circuit for BlendRow {
    const NAME: &'static str = "blend_row";
    const ABOUT: &'static str = "one coordinate of a blend by two products, a bit a tick";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let width = self.sum();
        let term = |bit: Bit, word: I| bit.mux(word.resize(width), 0);
        let (term_slope, term_bend) = (term(i.share_bit, q.slope), term(i.weight_bit, q.bend));
        let total = q.sum + (term_slope + term_bend);
        let raised = q.sum + q.half.word().resize(width).signed();
        let rounded = raised.resize(self.widths.point);
        let (sum, half) = halved(total, q.half, i.copy, i.fraction);

        let is = |name, word| i.record.is(name, word);
        let first = 8 + 8 * self.coordinate;
        let by = i.record.data.resize(self.term()).signed();
        let given = i.record.data.resize(self.widths.point).signed();
        let kept = i.commit.mux(rounded, q.offset);
        let next = Reg {
            slope: is("slope_word", first).mux(by, q.slope),
            bend: is("bend_word", first + 1).mux(by, q.bend),
            offset: is("offset_word", 2 + self.coordinate).mux(given, kept),
            sum,
            half,
        };
        let net = Net {
            term_slope,
            term_bend,
            total,
            raised,
            rounded,
        };
        (net, next)
    }

    fn objection(&self) -> Option<String> {
        let short = self.widths.data < self.term();
        short.then(|| "a word of a record holds a difference of points, doubled".into())
    }
}
