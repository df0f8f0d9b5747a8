//! Row of a blend by products: computes one coordinate of 2(A − A⁻)h + S(2 − h)h³, both products at
//! once, one bit of h and of the weight per tick.
//!
//! ```text
//!                             ┌───────────┐
//!  load, word, data ─────────▶│           │
//!  copy, fraction, commit ───▶│ blend_row ├──▶ offset
//!  share_bit, weight_bit ────▶│           │
//!                             └───────────┘
//! ```
//!
//! The sum is halved after each fraction bit, as in a [`RotationRow`](super::RotationRow). The last
//! bit shifted out rounds the result; nothing is lost before that.

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
    /// 0, 1, 2 for x, y, z: selects the record words that the row takes.
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
        /// A pass begins: the sum is cleared.
        pub copy: Bit,
        /// The current bit is a fraction bit.
        pub fraction: Bit,
        /// The sum is complete and becomes the point.
        pub commit: Bit,
        /// Current bit of h.
        pub share_bit: Bit,
        /// Current bit of the weight (2 − h)h³.
        pub weight_bit: Bit,
    }
    /// Flip-flops.
    pub struct Reg {
        /// On a blend, 2(A − A⁻); on a line, the distance from its start to its end.
        slope: I(c.term()) = 0,
        /// S = A⁻ − 2A + A⁺; 0 for a line.
        bend: I(c.term()) = 0,
        /// Coordinate of the vector from A⁻ to the point.
        pub offset: I(c.widths.point) as Analog = 0,
        /// Partial sum of the products, scaled to the weight of the next bit.
        sum: I(c.sum()) = 0,
        /// Last bit shifted out of the sum; its weight is one half.
        half: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// `slope` if the bit of h is 1, otherwise 0.
        term_slope: I(c.sum()),
        /// `bend` if the bit of the weight is 1, otherwise 0.
        term_bend: I(c.sum()),
        /// Sum plus both terms.
        total: I(c.sum()),
        /// Sum plus the rounding term.
        raised: I(c.sum()),
        /// Coordinate, rounded to the nearest; halves round up.
        rounded: I(c.widths.point),
    }
}

impl Circuit for BlendRow {
    const NAME: &'static str = "blend_row";
    const ABOUT: &'static str = "one coordinate of a blend by two products, one bit per tick";
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
