//! Element of the matrix \[2\]: a product of the axis times vers Δθ, plus or minus a component
//! times sin Δθ (on the diagonal: 1 times cos Δθ). Both products at once, one bit per tick.
//!
//! ```text
//!                          ┌────────────────┐
//!  copy, fraction, top ───▶│                │
//!  versine_bit, turn_bit ─▶│ matrix_element ├──▶ entry
//!  product, turn ─────────▶│                │
//!                          └────────────────┘
//! ```
//!
//! The sum is halved after each fraction bit, as in a [`RotationRow`](super::RotationRow). The last
//! bit shifted out rounds the result.

use super::rotation_row::halved;
use crate::prelude::*;

/// Sign of an element's second term.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sign {
    /// Added.
    #[default]
    Plus,
    /// Subtracted.
    Minus,
}

/// Element of the matrix.
///
/// The entry is valid from the tick after the sign bit until the next `copy`.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MatrixElement {
    /// C: width of a coefficient.
    pub coefficient: usize,
    /// Sign of the term with `turn`.
    pub sign: Sign,
}

impl MatrixElement {
    /// Width of the sum: two coefficients, doubled.
    pub const fn sum(&self) -> usize {
        self.coefficient + 2
    }
}

signals! { for MatrixElement as c;
    /// Input ports.
    pub struct In {
        /// The computation of a matrix begins.
        pub copy: Bit,
        /// The current bit is a fraction bit.
        pub fraction: Bit,
        /// The current bit is the sign bit, of weight −2.
        pub top: Bit,
        /// Current bit of vers Δθ.
        pub versine_bit: Bit,
        /// Current bit of sin Δθ; on the diagonal, of cos Δθ.
        pub turn_bit: Bit,
        /// Multiplicand of vers Δθ: a product of components of the axis.
        pub product: I(c.coefficient),
        /// Multiplicand of `turn_bit`: a component of the axis; on the diagonal, 1.
        pub turn: I(c.coefficient),
    }
    /// Flip-flops.
    pub struct Reg {
        /// Partial sum of the products, scaled to the weight of the next bit.
        sum: I(c.sum()) = 0,
        /// Last bit shifted out of the sum; its weight is one half.
        half: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// `product` if `versine_bit` is high, otherwise 0.
        term_product: I(c.sum()),
        /// `turn` if `turn_bit` is high, otherwise 0.
        term_turn: I(c.sum()),
        /// Sum or difference of the two terms.
        addend: I(c.sum()),
        /// `sum` plus `addend`, or minus twice `addend` at the sign bit.
        total: I(c.sum()),
        /// Sum plus the rounding term.
        raised: I(c.sum()),
        /// Element, rounded to the nearest.
        pub entry: U(c.coefficient) as Hex,
    }
}

impl Circuit for MatrixElement {
    const NAME: &'static str = "matrix_element";
    const ABOUT: &'static str = "one element of a rotation matrix, one bit per tick";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let term = |bit: Bit, word: I| bit.mux(word.resize(self.sum()), 0);
        let term_product = term(i.versine_bit, i.product);
        let term_turn = term(i.turn_bit, i.turn);
        let addend = match self.sign {
            Sign::Plus => term_product + term_turn,
            Sign::Minus => term_product - term_turn,
        };
        let total = q.sum + i.top.mux(-addend.shift_left(1), addend);
        let raised = q.sum + q.half.word().resize(self.sum()).signed();
        let entry = raised.unsigned().resize(self.coefficient);
        let (sum, half) = halved(total, q.half, i.copy, i.fraction);
        let next = Reg { sum, half };
        let net = Net {
            term_product,
            term_turn,
            addend,
            total,
            raised,
            entry,
        };
        (net, next)
    }
}
