//! Row of a rotation whose matrix changes every sample: a [`RotationRow`](super::RotationRow) with
//! the coefficients of the matrix as inputs.
//!
//! ```text
//!                         ┌────────────┐
//!  load, word, data ─────▶│            │
//!  copy, fraction, top ──▶│            │
//!  commit ───────────────▶│ vector_row ├──▶ offset
//!  by_x, by_y, by_z ─────▶│            │
//!  x, y, z ──────────────▶│            │
//!                         └────────────┘
//! ```

use super::rotation_row::{Net, Products, sum};
use super::{Rounding, Widths};
use crate::circuits::blocks::RecordWord;
use crate::prelude::*;

/// Word of a record that is GA's x; y and z follow.
pub const VECTOR_WORD: u64 = 16;

/// Row of a rotation by a matrix that changes.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct VectorRow {
    /// Widths of points, coefficients and records.
    pub widths: Widths,
    /// 0, 1, 2 for x, y, z: selects the record word that the row takes.
    pub coordinate: u64,
    /// Rounding of its result.
    pub rounding: Rounding,
}

impl VectorRow {
    /// Width of the sum.
    pub const fn sum(&self) -> usize {
        sum(&self.widths)
    }
}

signals! { for VectorRow as c;
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
        /// Coefficient of x.
        pub by_x: U(c.widths.coefficient) as Hex,
        /// Coefficient of y.
        pub by_y: U(c.widths.coefficient) as Hex,
        /// Coefficient of z.
        pub by_z: U(c.widths.coefficient) as Hex,
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
        /// Products in progress.
        products: Products(c) as Flat,
    }
}

impl Circuit for VectorRow {
    const NAME: &'static str = "vector_row";
    const ABOUT: &'static str =
        "one coordinate of a changing matrix times a vector, one bit per tick";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let vector = [i.x, i.y, i.z];
        let net = q.products.nets(vector, &self.widths, self.rounding, i.top);
        let by = [i.by_x, i.by_y, i.by_z];
        let products = q.products.after(&net, i.copy, i.fraction, by);

        let own = i.record.is("offset_word", VECTOR_WORD + self.coordinate);
        let given = i.record.data.resize(self.widths.point).signed();
        let next = Reg {
            offset: own.mux(given, i.commit.mux(net.rounded, q.offset)),
            products,
        };
        (net, next)
    }

    fn objection(&self) -> Option<String> {
        let short = self.widths.data < self.widths.point;
        short.then(|| "a word of a record holds a coordinate".into())
    }
}
