//! Row of the rotation stage: computes one coordinate of R·GP, three products at once, one bit of
//! the coefficients per tick.
//!
//! ```text
//!                         ┌──────────────┐
//!  load, word, data ─────▶│              │
//!  copy, fraction, top ──▶│ rotation_row ├──▶ offset
//!  commit ───────────────▶│              │
//!  x, y, z ──────────────▶│              │
//!                         └──────────────┘
//! ```
//!
//! Each tick adds to `sum` those of x, y, z whose coefficient has the current bit set, then halves
//! the sum. The last bit shifted out is the half that rounds the result. Nothing is lost before the
//! rounding, and no word is wider than the sum.

use super::{Rounding, VectorRow, Widths};
use crate::circuits::blocks::RecordWord;
use crate::prelude::*;

/// Names of the rows of x, y and z.
pub(super) const ROWS: &[&str] = &["row_x", "row_y", "row_z"];

/// Row of a rotation, for vectors of points and for coefficients.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RotationRow {
    /// Widths of points, coefficients and records.
    pub widths: Widths,
    /// 0, 1, 2 for x, y, z: selects the record words that the row takes.
    pub coordinate: u64,
    /// Rounding of its result.
    pub rounding: Rounding,
}

impl RotationRow {
    /// Width of the sum.
    pub const fn sum(&self) -> usize {
        sum(&self.widths)
    }
}

/// Width of a row's sum: three words of the vector, doubled, and the previous sum.
pub(super) const fn sum(widths: &Widths) -> usize {
    widths.point + 3
}

signals! { for RotationRow as c;
    /// Input ports.
    pub struct In {
        /// Word of a record.
        pub record: RecordWord(&c.widths.data) as Flat,
        /// A step begins: the coefficients are copied.
        pub copy: Bit,
        /// The current bit is a fraction bit.
        pub fraction: Bit,
        /// The current bit is the sign bit, of weight −2.
        pub top: Bit,
        /// The sum is complete and becomes the coordinate.
        pub commit: Bit,
        /// X of the vector.
        pub x: I(c.widths.point),
        /// Y of the vector.
        pub y: I(c.widths.point),
        /// Z of the vector.
        pub z: I(c.widths.point),
    }
    /// Flip-flops.
    pub struct Reg {
        /// Coordinate of the vector from the centre to the point.
        pub offset: I(c.widths.point) as Analog = 0,
        /// Coefficient of x.
        by_x: U(c.widths.coefficient) as Hex = 0,
        /// Coefficient of y.
        by_y: U(c.widths.coefficient) as Hex = 0,
        /// Coefficient of z.
        by_z: U(c.widths.coefficient) as Hex = 0,
        /// Products in progress.
        products: Products(c) as Flat,
    }
}

signals! { for (RotationRow, VectorRow) as c;
    /// Three products in progress, also those of a [row of a matrix that
    /// changes](super::vector_row).
    pub struct Products {
        /// Remaining bits of the coefficient of x.
        bits_x: U(c.widths.coefficient) as Hex = 0,
        /// Remaining bits of the coefficient of y.
        bits_y: U(c.widths.coefficient) as Hex = 0,
        /// Remaining bits of the coefficient of z.
        bits_z: U(c.widths.coefficient) as Hex = 0,
        /// Partial sum of the products, scaled to the weight of the next bit.
        sum: I(c.sum()) = 0,
        /// Last bit shifted out of the sum; its weight is one half.
        half: Bit = 0,
    }
    /// Nets, also those of a [row of a matrix that changes](super::vector_row).
    pub struct Net {
        /// X if the bit of its coefficient is 1, otherwise 0.
        term_x: I(c.sum()),
        /// Y if the bit of its coefficient is 1, otherwise 0.
        term_y: I(c.sum()),
        /// Z if the bit of its coefficient is 1, otherwise 0.
        term_z: I(c.sum()),
        /// Sum of the three terms.
        addend: I(c.sum()),
        /// `sum` plus `addend`, or minus twice `addend` at the sign bit.
        total: I(c.sum()),
        /// Sum plus the rounding term.
        raised: I(c.sum()),
        /// New coordinate, rounded.
        pub(super) rounded: I(c.widths.point),
    }
}

impl Products {
    /// Returns the terms of the next bits and the new sum; `top` if the bits are signs.
    pub(super) fn nets(
        &self,
        [x, y, z]: [I; 3],
        widths: &Widths,
        rounding: Rounding,
        top: Bit,
    ) -> Net {
        let width = sum(widths);
        let term = |bits: U, word: I| bits.bit(0).mux(word.resize(width), 0);
        let (term_x, term_y) = (term(self.bits_x, x), term(self.bits_y, y));
        let term_z = term(self.bits_z, z);
        let addend = term_x + term_y + term_z;
        let raised = match rounding {
            Rounding::Nearest => self.sum + self.half.word().resize(width).signed(),
            Rounding::Floor => self.sum,
        };
        Net {
            term_x,
            term_y,
            term_z,
            addend,
            total: self.sum + top.mux(-addend.shift_left(1), addend),
            raised,
            rounded: raised.resize(widths.point),
        }
    }

    /// Returns the products after the edge; `copy` loads new coefficients.
    pub(super) fn after(&self, net: &Net, copy: Bit, fraction: Bit, by: [U; 3]) -> Products<Edge> {
        let (sum, half) = halved(net.total, self.half, copy, fraction);
        let bits = |by: U, bits: U| copy.mux(by, bits.shift_right(1));
        Products {
            bits_x: bits(by[0], self.bits_x),
            bits_y: bits(by[1], self.bits_y),
            bits_z: bits(by[2], self.bits_z),
            sum,
            half,
        }
    }
}

/// Returns sum and half after the edge; after a fraction bit the sum is halved.
pub(super) fn halved(total: I, half: Bit, copy: Bit, fraction: Bit) -> (I, Bit) {
    // Without bits left the total is the sum.
    let sum = fraction.mux(total.shift_right(1), total);
    let half = fraction.mux(total.unsigned().bit(0), half);
    (copy.mux(0, sum), half)
}

impl Circuit for RotationRow {
    const NAME: &'static str = "rotation_row";
    const ABOUT: &'static str = "one coordinate of a matrix times a vector, one bit per tick";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let (point, coefficient) = (self.widths.point, self.widths.coefficient);
        let vector = [i.x, i.y, i.z];
        let net = q.products.nets(vector, &self.widths, self.rounding, i.top);
        let held = [q.by_x, q.by_y, q.by_z];
        let products = q.products.after(&net, i.copy, i.fraction, held);

        let is = |name, word| i.record.is(name, word);
        let first = 8 + 8 * self.coordinate;
        let by = i.record.data.resize(coefficient);
        let given = i.record.data.resize(point).signed();
        let kept = i.commit.mux(net.rounded, q.offset);
        let next = Reg {
            offset: is("offset_word", 2 + self.coordinate).mux(given, kept),
            by_x: is("x_word", first).mux(by, q.by_x),
            by_y: is("y_word", first + 1).mux(by, q.by_y),
            by_z: is("z_word", first + 2).mux(by, q.by_z),
            products,
        };
        (net, next)
    }

    fn objection(&self) -> Option<String> {
        let of = &self.widths;
        let holds = of.data >= of.point && of.data >= of.coefficient;
        (!holds).then(|| "a word of a record holds coordinate and coefficient".into())
    }
}
