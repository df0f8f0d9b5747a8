//! Axis row: one coordinate of the point at `along` and `across` of a segment's own two directions.
//!
//! ```text
//!                           ┌──────────┐
//!  load, word, data ───────▶│          │
//!  copy, fraction, top ────▶│ axis_row ├──▶ point
//!  commit ─────────────────▶│          │
//!  along, across ──────────▶│          │
//!                           └──────────┘
//! ```
//!
//! base + by_along·along + by_across·across: on a line the base is its start, `along` the length on
//! it, and the coefficient the direction's cosine (equation (1), with the ratio worked out
//! beforehand); on an arc the base is the centre, and the coefficients are those of the two radii.
//! A bit of both coefficients a tick, from the lowest up; nothing is lost before the rounding.

use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Signed, Unsigned};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const R: usize, const D: usize> {
        /// `data` is word `word` of a segment.
        pub load: L::Bit,
        /// Number of the word.
        pub word: L::U<4>,
        /// Its data.
        pub data: L::U<D> as Hex,
        /// The coefficients are copied.
        pub copy: L::Bit,
        /// The bit is one of the fraction.
        pub fraction: L::Bit,
        /// The bit is the sign, of weight −2.
        pub top: L::Bit,
        /// The sum is complete.
        pub commit: L::Bit,
        /// First coordinate in the segment, with R − P bits behind the guard unit.
        pub along: L::I<R>,
        /// Second coordinate likewise.
        pub across: L::I<R>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const P: usize, const C: usize, const S: usize> {
        /// Where the coordinates are 0.
        base: L::I<P> = 0,
        /// Coefficient of `along`.
        by_along: L::U<C> as Hex = 0,
        /// Coefficient of `across`.
        by_across: L::U<C> as Hex = 0,
        /// Bits of the coefficient of `along` that are yet to come.
        bits_along: L::U<C> as Hex = 0,
        /// Bits of that of `across`.
        bits_across: L::U<C> as Hex = 0,
        /// The products so far, by the weight of the bit to come.
        sum: L::I<S> = 0,
        /// The coordinate of the point.
        pub point: L::I<P> as Analog = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const P: usize, const S: usize> {
        /// `along` where its coefficient has the bit, else 0.
        term_along: L::I<S>,
        /// `across` likewise.
        term_across: L::I<S>,
        /// Both terms added.
        addend: L::I<S>,
        /// The sum with it.
        total: L::I<S>,
        /// The sum and half a guard unit.
        raised: L::I<S>,
        /// The sum to the nearest guard unit.
        nearest: L::I<P>,
    }
}

/// Row for points of `P` bits, coordinates of `R`, coefficients of `C`; `S` = `R` + 2 is the word of
/// its sum, `D` that of a segment.
#[derive(Debug, Clone, Default)]
pub struct AxisRow<const P: usize, const R: usize, const C: usize, const S: usize, const D: usize> {
    /// 0, 1, 2 for x, y, z: it decides which words of a segment the row takes.
    pub coordinate: u64,
}

impl<const P: usize, const R: usize, const C: usize, const S: usize, const D: usize> Circuit
    for AxisRow<P, R, C, S, D>
{
    const NAME: &'static str = "axis_row";
    const ABOUT: &'static str = "one coordinate of a point on a segment, a bit a tick";
    type In<L: Logic> = In<L, R, D>;
    type Reg<L: Logic> = Reg<L, P, C, S>;
    type Net<L: Logic> = Net<L, P, S>;

    fn comb<L: Logic>(&self, q: &Reg<L, P, C, S>, i: &In<L, R, D>) -> Net<L, P, S> {
        const { assert!(R > P && S == R + 2, "two words of R bits, doubled") };
        let term =
            |bits: L::U<C>, word: L::I<R>| -> L::I<S> { bits.bit(0).mux(word.resize(), 0.into()) };
        let term_along = term(q.bits_along, i.along);
        let term_across = term(q.bits_across, i.across);
        let addend = term_along + term_across;
        let raised = q.sum + (1i64 << (R - P - 1));
        Net {
            term_along,
            term_across,
            addend,
            total: q.sum + i.top.mux(-addend.shift_left(1), addend),
            raised,
            nearest: raised.shift_right(R - P).resize(),
        }
    }

    fn next<L: Logic>(
        &self,
        q: Reg<L, P, C, S>,
        w: &Net<L, P, S>,
        i: &In<L, R, D>,
    ) -> Reg<L, P, C, S> {
        let is = |name, word| i.load & i.word.equals(L::parameter(name, word));
        let coefficient = i.data.resize();
        let by_along = is("along_word", 6 + self.coordinate).mux(coefficient, q.by_along);
        let by_across = is("across_word", 9 + self.coordinate).mux(coefficient, q.by_across);
        let base = is("base_word", 3 + self.coordinate);
        Reg {
            base: base.mux(i.data.resize().signed(), q.base),
            by_along,
            by_across,
            bits_along: i.copy.mux(q.by_along, q.bits_along.shift_right(1)),
            bits_across: i.copy.mux(q.by_across, q.bits_across.shift_right(1)),
            sum: i.copy.mux(
                0.into(),
                // Without bits left the total is the sum.
                i.fraction.mux(w.total.shift_right(1), w.total),
            ),
            point: i.commit.mux(q.base + w.nearest, q.point),
        }
    }
}
