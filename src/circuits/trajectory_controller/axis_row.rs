//! Axis row: computes one coordinate of the point from the three coordinates within a segment.
//!
//! ```text
//!                           ┌──────────┐
//!  load, word, data ───────▶│          │
//!  copy, fraction, top ────▶│ axis_row ├──▶ point
//!  commit ─────────────────▶│          │
//!  along, across, third ───▶│          │
//!                           └──────────┘
//! ```
//!
//! The point is base + by_along·along + by_across·across + by_third·third. On a line, the base is
//! the start, `along` the length on the line, and its coefficient the direction cosine (equation
//! (1), with the ratio computed beforehand). On an arc, the base is the centre, and the
//! coefficients are those of the two radii; on a helix, also of the rise. On a spline, the
//! coordinates are the powers of the length. One bit of all coefficients is processed per tick, the
//! lowest first. Nothing is lost before the rounding.

use super::widths::PointWidths;
use crate::prelude::*;

/// Row of an axis.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AxisRow {
    /// Word widths.
    pub widths: PointWidths,
    /// 0, 1, 2, 3 for x, y, z, w: selects the words of a segment that the row takes.
    pub coordinate: u64,
}

impl AxisRow {
    /// The words of a segment that are base, along, across and third.
    const fn words(&self) -> [u64; 4] {
        match self.coordinate {
            3 => [16, 17, 18, 19],
            axis => [3 + axis, 6 + axis, 9 + axis, 13 + axis],
        }
    }
}

signals! { for AxisRow as c;
    /// Input ports.
    pub struct In {
        /// `data` is word `word` of a segment.
        pub load: Bit,
        /// Number of the word in `data`.
        pub word: U(c.widths.word),
        /// Word of a segment.
        pub data: U(c.widths.data) as Hex,
        /// The coefficients are copied.
        pub copy: Bit,
        /// The current bit is a fraction bit.
        pub fraction: Bit,
        /// The current bit is the sign bit, of weight −2.
        pub top: Bit,
        /// The sum is complete.
        pub commit: Bit,
        /// First coordinate within the segment, with R − P bits below the guard unit.
        pub along: I(c.widths.radius),
        /// Second coordinate within the segment, in the unit of `along`.
        pub across: I(c.widths.radius),
        /// Third coordinate within the segment, in the unit of `along`.
        pub third: I(c.widths.radius),
    }
    /// Flip-flops.
    pub struct Reg {
        /// Origin of the segment's coordinates, in guard units.
        base: I(c.widths.point) = 0,
        /// Coefficient of `along`.
        by_along: U(c.widths.coefficient) as Hex = 0,
        /// Coefficient of `across`.
        by_across: U(c.widths.coefficient) as Hex = 0,
        /// Coefficient of `third`.
        by_third: U(c.widths.coefficient) as Hex = 0,
        /// Remaining bits of the coefficient of `along`.
        bits_along: U(c.widths.coefficient) as Hex = 0,
        /// Remaining bits of the coefficient of `across`.
        bits_across: U(c.widths.coefficient) as Hex = 0,
        /// Remaining bits of the coefficient of `third`.
        bits_third: U(c.widths.coefficient) as Hex = 0,
        /// Partial sum of the products, scaled to the weight of the next bit.
        sum: I(c.widths.sum()) = 0,
        /// Coordinate of the point, in guard units.
        pub point: I(c.widths.point) as Analog = 0,
    }
    /// Nets.
    pub struct Net {
        /// `along` if the bit of its coefficient is 1, otherwise 0.
        term_along: I(c.widths.sum()),
        /// `across` if the bit of its coefficient is 1, otherwise 0.
        term_across: I(c.widths.sum()),
        /// `third` if the bit of its coefficient is 1, otherwise 0.
        term_third: I(c.widths.sum()),
        /// Sum of the three terms.
        addend: I(c.widths.sum()),
        /// `sum` plus `addend`, or minus twice `addend` at the sign bit.
        total: I(c.widths.sum()),
        /// Sum plus half a guard unit.
        raised: I(c.widths.sum()),
        /// Sum, rounded to the nearest guard unit.
        nearest: I(c.widths.point),
    }
}

impl Circuit for AxisRow {
    const NAME: &'static str = "axis_row";
    const ABOUT: &'static str = "one coordinate of a point on a segment, one bit per tick";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let (point, coefficient) = (self.widths.point, self.widths.coefficient);
        let fine = self.widths.fine();
        let term = |bits: U, word: I| bits.bit(0).mux(word.resize(self.widths.sum()), 0);
        let term_along = term(q.bits_along, i.along);
        let term_across = term(q.bits_across, i.across);
        let term_third = term(q.bits_third, i.third);
        let addend = term_along + term_across + term_third;
        let total = q.sum + i.top.mux(-addend.shift_left(1), addend);
        let raised = q.sum + (1i64 << (fine - 1));
        let nearest = raised.shift_right(fine).resize(point);

        let [base_word, along_word, across_word, third_word] = self.words();
        let is = |name, word| i.load & i.word.equals(U::parameter(name, word, self.widths.word));
        let (base, by) = (i.data.resize(point).signed(), i.data.resize(coefficient));
        let next = Reg {
            base: is("base_word", base_word).mux(base, q.base),
            by_along: is("along_word", along_word).mux(by, q.by_along),
            by_across: is("across_word", across_word).mux(by, q.by_across),
            by_third: is("third_word", third_word).mux(by, q.by_third),
            bits_along: i.copy.mux(q.by_along, q.bits_along.shift_right(1)),
            bits_across: i.copy.mux(q.by_across, q.bits_across.shift_right(1)),
            bits_third: i.copy.mux(q.by_third, q.bits_third.shift_right(1)),
            // Without bits left the total is the sum.
            sum: i.copy.mux(0, i.fraction.mux(total.shift_right(1), total)),
            point: i.commit.mux(q.base + nearest, q.point),
        };
        let net = Net {
            term_along,
            term_across,
            term_third,
            addend,
            total,
            raised,
            nearest,
        };
        (net, next)
    }

    fn objection(&self) -> Option<String> {
        let holds = self.widths.radius > self.widths.point;
        if !holds {
            return Some("a radius has bits below the guard unit".into());
        }
        let placed = self.coordinate < 3 || (self.coordinate == 3 && self.widths.word == 5);
        (!placed).then(|| "a segment has words for x, y, z, and in 5 bits for w".into())
    }
}
