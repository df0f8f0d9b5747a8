//! The registers of the integrator 24 (¶0011–0013): I, B, and the signs around an unsigned
//! divider.
//!
//! ```text
//!                         ┌─────────────┐
//!  clear ────────────────▶│             ├──▶ integral (I), remainder (B)
//!  master, slave ────────▶│ accumulator ├──▶ busy, valid
//!  start, increment ─────▶│             ├──▶ divide, factors, addend, divisor ──▶ mul_div
//!  done, quotient, rest ─▶│             │◀── mul_div
//!                         └─────────────┘
//! ```
//!
//! `(Δy·δx + B) / Δx + I → I`, remainder `→ B`. The division is made of magnitudes. With b = B
//! times the sign of Δx, which is 0 … |Δx| − 1 under the floor rule, a term Δy·δx/Δx that counts
//! down is divided as `(|Δy·δx| + (|Δx| − 1 − b)) / |Δx|`: quotient and remainder then are those
//! of the floor with the sign of the one and the complement of the other turned round.
//!
//! Departures: the rounding rule, which the text leaves open, is a [`Rule`]; a start with a Δ of 0
//! for the master is not taken.

use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Signed, Unsigned};
use crate::signals;
use serde::Deserialize;

/// How the integrator 24 divides: what becomes of the remainder.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rule {
    /// Towards minus infinity: the remainder has the sign of the divisor. A return stroke meets the
    /// points of the stroke.
    #[default]
    Floor,
    /// Towards zero: the remainder has the sign of the dividend.
    Truncating,
    /// Towards minus infinity, from a remainder of half the divisor on: half the deviation.
    Centred,
}

impl Rule {
    /// The name it has in scenarios.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Rule::Floor => "floor",
            Rule::Truncating => "truncating",
            Rule::Centred => "centred",
        }
    }
}

signals! {
    /// Ports in.
    pub struct In<L, const P: usize, const R: usize> {
        /// A positioning cycle begins: I and B take their first values.
        pub clear: L::Bit,
        /// Δx: signed distance of the master axis, constant from `clear` on for the whole cycle.
        pub master: L::I<P>,
        /// Δy: signed distance of the slave axis, constant likewise.
        pub slave: L::I<P>,
        /// An increment is given; not taken while `busy`.
        pub start: L::Bit,
        /// δx(n): what the master moves in this scan.
        pub increment: L::I<P>,
        /// The divider is done.
        pub done: L::Bit,
        /// Its quotient.
        pub quotient: L::U<R>,
        /// Its remainder.
        pub rest: L::U<R>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const P: usize> {
        /// I: what the slave has moved since the cycle began.
        pub integral: L::I<P> as Analog = 0,
        /// B: what the division has left over; it takes part in the next.
        pub remainder: L::I<P> as Analog = 0,
        /// A division is under way.
        pub busy: L::Bit = 0,
        /// Its result belongs to a cycle that is over, and is not taken.
        dropped: L::Bit = 0,
        /// Its term counts down.
        down: L::Bit = 0,
        /// Truncating rule: its dividend is one divisor too large.
        lent: L::Bit = 0,
        /// I and B are new in this tick.
        pub valid: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const P: usize, const R: usize> {
        /// The divider begins.
        pub divide: L::Bit,
        /// |Δy|.
        pub multiplicand: L::U<R>,
        /// |δx|.
        pub multiplier: L::U<P>,
        /// What the remainder brings along.
        pub addend: L::U<R>,
        /// |Δx|.
        pub divisor: L::U<R>,
        /// |Δx|.
        modulus: L::U<P>,
        /// The term Δy·δx/Δx is negative.
        term_down: L::Bit,
        /// B times the sign of Δx, and under the truncating rule also that of the term.
        carried: L::I<P>,
        /// |δy(n)|, in the tick of `done`.
        way: L::I<P>,
        /// The remainder after this division, times the sign of Δx.
        rest_positive: L::I<P>,
        /// δy(n): what the slave moves, in the tick of `done`.
        step: L::I<P>,
        /// The remainder after this division.
        left: L::I<P>,
        /// The division is over.
        over: L::Bit,
        /// Its result is taken.
        taken: L::Bit,
        /// B at the beginning of a cycle.
        first: L::I<P>,
    }
}

/// Registers of the integrator 24, with positions of `P` bits and a divider of `R` = 2·`P` bits.
#[derive(Debug, Clone, Default)]
pub struct Accumulator<const P: usize, const R: usize> {
    /// How a quotient is rounded.
    pub rule: Rule,
}

/// `word`, or its negative.
fn signed_by<L: Logic, const P: usize>(negative: L::Bit, word: L::I<P>) -> L::I<P> {
    negative.mux(-word, word)
}

impl<const P: usize, const R: usize> Circuit for Accumulator<P, R> {
    const NAME: &'static str = "accumulator";
    const ABOUT: &'static str = "integral and remainder, with the signs around the divider";
    type In<L: Logic> = In<L, P, R>;
    type Reg<L: Logic> = Reg<L, P>;
    type Net<L: Logic> = Net<L, P, R>;

    fn comb<L: Logic>(&self, q: &Reg<L, P>, i: &In<L, P, R>) -> Net<L, P, R> {
        const { assert!(R == 2 * P, "the divider is twice as wide as a position") };
        let backwards = i.master.is_negative();
        let modulus = i.master.magnitude();
        let term_down = backwards ^ i.slave.is_negative() ^ i.increment.is_negative();
        let positive = signed_by::<L, P>(backwards, q.remainder);
        let (carried, addend) = match self.rule {
            Rule::Truncating => {
                let carried = signed_by::<L, P>(term_down, positive);
                let lent = carried.is_negative();
                let addend = lent.mux(modulus + carried.unsigned(), carried.unsigned());
                (carried, addend)
            }
            Rule::Floor | Rule::Centred => {
                let complement = modulus - 1 - positive.unsigned();
                (positive, term_down.mux(complement, positive.unsigned()))
            }
        };
        let (quotient, rest): (L::U<P>, L::U<P>) = (i.quotient.resize(), i.rest.resize());
        let (quotient, rest) = match self.rule {
            Rule::Truncating => {
                let none = quotient.is_zero();
                let lent = q.lent.mux(none.mux(quotient, quotient - 1), quotient);
                let rest = (q.lent & none).mux(rest - modulus, rest);
                (lent, signed_by::<L, P>(q.down, rest.signed()))
            }
            Rule::Floor | Rule::Centred => {
                let rest = q.down.mux(modulus - 1 - rest, rest);
                (quotient, rest.signed())
            }
        };
        let (way, over) = (quotient.signed(), i.done & q.busy);
        let half = modulus.shift_right(1).signed();
        Net {
            divide: i.start & !q.busy & !i.master.is_zero() & !i.clear,
            multiplicand: i.slave.magnitude().resize(),
            multiplier: i.increment.magnitude(),
            addend: addend.resize(),
            divisor: modulus.resize(),
            modulus,
            term_down,
            carried,
            way,
            rest_positive: rest,
            step: signed_by::<L, P>(q.down, way),
            left: signed_by::<L, P>(backwards, rest),
            over,
            taken: over & !q.dropped,
            first: match self.rule {
                Rule::Centred => signed_by::<L, P>(backwards, half),
                Rule::Floor | Rule::Truncating => 0.into(),
            },
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, P>, w: &Net<L, P, R>, i: &In<L, P, R>) -> Reg<L, P> {
        Reg {
            integral: i
                .clear
                .mux(0.into(), w.taken.mux(q.integral + w.step, q.integral)),
            remainder: i.clear.mux(w.first, w.taken.mux(w.left, q.remainder)),
            busy: w.divide | (q.busy & !w.over),
            dropped: q.busy & !w.over & (q.dropped | i.clear),
            down: w.divide.mux(w.term_down, q.down),
            lent: match self.rule {
                Rule::Truncating => w.divide.mux(w.carried.is_negative(), q.lent),
                Rule::Floor | Rule::Centred => false.into(),
            },
            valid: w.taken & !i.clear,
        }
    }
}
