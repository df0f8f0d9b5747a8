//! A row of the rotation stage: one coordinate of R·GP, three products at once, a bit of the
//! coefficients a tick.
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
//! The sum of those of x, y, z whose coefficient has the bit is added to `sum`, which is then
//! halved; the bit that falls off last is the half by which the result is rounded. So nothing is
//! lost before the rounding, and no word is wider than the sum.

use super::Rounding;
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Signed, Unsigned};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const P: usize, const D: usize> {
        /// `data` is word `word` of a record.
        pub load: L::Bit,
        /// Number of the word.
        pub word: L::U<5>,
        /// Its data.
        pub data: L::U<D> as Hex,
        /// A step begins: the coefficients are copied.
        pub copy: L::Bit,
        /// The bit is one of the fraction.
        pub fraction: L::Bit,
        /// The bit is the sign, of weight −2.
        pub top: L::Bit,
        /// The sum is complete.
        pub commit: L::Bit,
        /// X of the vector.
        pub x: L::I<P>,
        /// Y of the vector.
        pub y: L::I<P>,
        /// Z of the vector.
        pub z: L::I<P>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const P: usize, const C: usize, const S: usize> {
        /// This row's coordinate of the vector from the centre to the point.
        pub offset: L::I<P> as Analog = 0,
        /// Coefficient of x.
        by_x: L::U<C> as Hex = 0,
        /// Coefficient of y.
        by_y: L::U<C> as Hex = 0,
        /// Coefficient of z.
        by_z: L::U<C> as Hex = 0,
        /// Bits of the coefficient of x that are yet to come.
        bits_x: L::U<C> as Hex = 0,
        /// Bits of that of y.
        bits_y: L::U<C> as Hex = 0,
        /// Bits of that of z.
        bits_z: L::U<C> as Hex = 0,
        /// The products so far, by the weight of the bit to come.
        sum: L::I<S> = 0,
        /// The bit below the sum: a half.
        half: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const P: usize, const S: usize> {
        /// X where its coefficient has the bit, else 0.
        term_x: L::I<S>,
        /// Y likewise.
        term_y: L::I<S>,
        /// Z likewise.
        term_z: L::I<S>,
        /// The three terms added.
        addend: L::I<S>,
        /// The sum with it.
        total: L::I<S>,
        /// The sum with what rounds it.
        raised: L::I<S>,
        /// The coordinate of the new point.
        rounded: L::I<P>,
    }
}

/// Row for vectors of `P` bits and coefficients of `C`, of which `C` − 2 are fraction; `S` = `P` + 3
/// is the word of its sum, `D` that of a record.
#[derive(Debug, Clone, Default)]
pub struct RotationRow<const P: usize, const C: usize, const S: usize, const D: usize> {
    /// 0, 1, 2 for x, y, z: it decides which words of a record the row takes.
    pub coordinate: u64,
    /// How its result is rounded.
    pub rounding: Rounding,
}

impl<const P: usize, const C: usize, const S: usize, const D: usize> Circuit
    for RotationRow<P, C, S, D>
{
    const NAME: &'static str = "rotation_row";
    const ABOUT: &'static str = "one coordinate of a matrix times a vector, a bit a tick";
    type In<L: Logic> = In<L, P, D>;
    type Reg<L: Logic> = Reg<L, P, C, S>;
    type Net<L: Logic> = Net<L, P, S>;

    fn comb<L: Logic>(&self, q: &Reg<L, P, C, S>, i: &In<L, P, D>) -> Net<L, P, S> {
        const {
            assert!(
                S == P + 3,
                "three words of P bits, doubled, and what was there"
            )
        };
        const {
            assert!(
                D >= P && D >= C,
                "a word of a record holds coordinate and coefficient"
            )
        };
        let term =
            |bits: L::U<C>, word: L::I<P>| -> L::I<S> { bits.bit(0).mux(word.resize(), 0.into()) };
        let (term_x, term_y) = (term(q.bits_x, i.x), term(q.bits_y, i.y));
        let term_z = term(q.bits_z, i.z);
        let addend = term_x + term_y + term_z;
        let half: L::U<S> = q.half.word().resize();
        let raised = match self.rounding {
            Rounding::Nearest => q.sum + half.signed(),
            Rounding::Floor => q.sum,
        };
        Net {
            term_x,
            term_y,
            term_z,
            addend,
            total: q.sum + i.top.mux(-addend.shift_left(1), addend),
            raised,
            rounded: raised.resize(),
        }
    }

    fn next<L: Logic>(
        &self,
        q: Reg<L, P, C, S>,
        w: &Net<L, P, S>,
        i: &In<L, P, D>,
    ) -> Reg<L, P, C, S> {
        let is = |name, word| i.load & i.word.equals(L::parameter(name, word));
        let first = 8 + 8 * self.coordinate;
        let coefficient = i.data.resize();
        let by_x = is("x_word", first).mux(coefficient, q.by_x);
        let by_y = is("y_word", first + 1).mux(coefficient, q.by_y);
        let by_z = is("z_word", first + 2).mux(coefficient, q.by_z);
        let offset = is("offset_word", 2 + self.coordinate);
        Reg {
            offset: offset.mux(i.data.resize().signed(), i.commit.mux(w.rounded, q.offset)),
            bits_x: i.copy.mux(q.by_x, q.bits_x.shift_right(1)),
            bits_y: i.copy.mux(q.by_y, q.bits_y.shift_right(1)),
            bits_z: i.copy.mux(q.by_z, q.bits_z.shift_right(1)),
            by_x,
            by_y,
            by_z,
            sum: i.copy.mux(
                0.into(),
                // Without bits left the total is the sum.
                i.fraction.mux(w.total.shift_right(1), w.total),
            ),
            half: i.fraction.mux(w.total.unsigned().bit(0), q.half),
        }
    }
}
