//! Registers of the integrator 24 (¶0011–0013): I and B, and the signs around an unsigned divider.
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
//! Each division computes `(Δy·δx + B) / Δx + I → I`, remainder `→ B`. The divider works on
//! magnitudes. Let b be B times the sign of Δx; under the floor rule b is 0 … |Δx| − 1. Where the
//! term Δy·δx/Δx is negative, the divider computes `(|Δy·δx| + (|Δx| − 1 − b)) / |Δx|`. The
//! negative of this quotient and the complement of this remainder, |Δx| − 1 − remainder, are those
//! of the floor.
//! Departures: the rounding rule, which the text leaves open, is a [`Rule`]; a start with Δx = 0 is
//! ignored.
//! for the master is not taken.

use super::Integrator;
use crate::prelude::*;
use serde::Deserialize;

/// Rounding rule of the integrator 24, which determines the remainder.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, serde::Serialize)]
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

/// Registers of the integrator 24.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Accumulator {
    /// Width of a position in bits; the divider has twice as many.
    pub position: usize,
    /// Rounding of a quotient.
    pub rule: Rule,
}

impl Accumulator {
    /// Width of the divider.
    #[must_use]
    pub const fn divider(&self) -> usize {
        2 * self.position
    }
}

signals! { for (Accumulator, Integrator) as c;
    /// The line, and the increment of the master axis.
    pub struct Motion {
        /// Begins a positioning cycle: I and B take their initial values.
        pub clear: Bit,
        /// Δx: signed distance of the master axis, constant from `clear` on for the whole cycle.
        pub master: I(c.position),
        /// Δy: signed distance of the slave axis, constant from `clear` on for the whole cycle.
        pub slave: I(c.position),
        /// Starts a division for `increment`; ignored while `busy`.
        pub start: Bit,
        /// δx(n): increment of the master axis in this scan.
        pub increment: I(c.position),
    }
}

signals! { for Accumulator as c;
    /// Input ports.
    pub struct In {
        /// The line, and the increment of the master axis.
        pub motion: Motion(c) as Flat,
        /// The divider has a result.
        pub done: Bit,
        /// Quotient from the divider.
        pub quotient: U(c.divider()),
        /// Remainder from the divider.
        pub rest: U(c.divider()),
    }
    /// Flip-flops.
    pub struct Reg {
        /// I: distance moved by the slave axis since the cycle began.
        pub integral: I(c.position) as Analog = 0,
        /// B: remainder of the division, carried into the next one.
        pub remainder: I(c.position) as Analog = 0,
        /// A division is running.
        pub busy: Bit = 0,
        /// The running division belongs to a cycle that is over: its result is discarded.
        dropped: Bit = 0,
        /// The term of the running division is negative.
        down: Bit = 0,
        /// Truncating rule: the dividend of the running division is one divisor too large.
        lent: Bit = 0,
        /// I and B have new values in this tick.
        pub valid: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// Starts the divider.
        pub divide: Bit,
        /// |Δy|.
        pub multiplicand: U(c.divider()),
        /// |δx|.
        pub multiplier: U(c.position),
        /// Addend of the dividend: brings in the carried remainder.
        pub addend: U(c.divider()),
        /// |Δx|.
        pub divisor: U(c.divider()),
        /// |Δx|.
        modulus: U(c.position),
        /// The term Δy·δx/Δx is negative.
        term_down: Bit,
        /// B times the sign of Δx; under the truncating rule also times the sign of the term.
        carried: I(c.position),
        /// |δy(n)|; valid in the tick of `done`.
        way: I(c.position),
        /// Remainder after this division, times the sign of Δx; valid in the tick of `done`.
        rest_positive: I(c.position),
        /// δy(n): increment of the slave axis; valid in the tick of `done`.
        step: I(c.position),
        /// Next value of B; valid in the tick of `done`.
        left: I(c.position),
        /// The division ends in this tick.
        over: Bit,
        /// The result of the division is used.
        taken: Bit,
        /// Initial value of B in a cycle.
        first: I(c.position),
    }
}

impl Circuit for Accumulator {
    const NAME: &'static str = "accumulator";
    const ABOUT: &'static str = "integral and remainder, with the signs around the divider";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let Motion {
            clear,
            master,
            slave,
            start,
            increment,
        } = i.motion;
        let backwards = master.is_negative();
        let modulus = master.magnitude();
        let term_down = backwards ^ slave.is_negative() ^ increment.is_negative();
        let positive = q.remainder.negated_by(backwards);
        let (carried, addend) = match self.rule {
            Rule::Truncating => {
                let carried = positive.negated_by(term_down);
                let lent = carried.is_negative();
                let addend = lent.mux(modulus + carried.unsigned(), carried.unsigned());
                (carried, addend)
            }
            Rule::Floor | Rule::Centred => {
                let complement = modulus - 1 - positive.unsigned();
                (positive, term_down.mux(complement, positive.unsigned()))
            }
        };
        let divide = start & !q.busy & !master.is_zero() & !clear;

        let quotient = i.quotient.resize(self.position);
        let rest = i.rest.resize(self.position);
        let (quotient, rest_positive) = match self.rule {
            Rule::Truncating => {
                let none = quotient.is_zero();
                let paid = q.lent.mux(none.mux(quotient, quotient - 1), quotient);
                let rest = (q.lent & none).mux(rest - modulus, rest);
                (paid, rest.signed().negated_by(q.down))
            }
            Rule::Floor | Rule::Centred => {
                let rest = q.down.mux(modulus - 1 - rest, rest);
                (quotient, rest.signed())
            }
        };
        let way = quotient.signed();
        let step = way.negated_by(q.down);
        let left = rest_positive.negated_by(backwards);
        let over = i.done & q.busy;
        let taken = over & !q.dropped;
        let half = modulus.shift_right(1).signed();
        let first = match self.rule {
            Rule::Centred => half.negated_by(backwards),
            Rule::Floor | Rule::Truncating => I::new(0, self.position),
        };

        let integral = taken.mux(q.integral + step, q.integral);
        let remainder = taken.mux(left, q.remainder);
        let next = Reg {
            integral: clear.mux(0, integral),
            remainder: clear.mux(first, remainder),
            busy: divide | (q.busy & !over),
            dropped: q.busy & !over & (q.dropped | clear),
            down: divide.mux(term_down, q.down),
            lent: match self.rule {
                Rule::Truncating => divide.mux(carried.is_negative(), q.lent),
                Rule::Floor | Rule::Centred => Bit::low(),
            },
            valid: taken & !clear,
        };
        let net = Net {
            divide,
            multiplicand: slave.magnitude().resize(self.divider()),
            multiplier: increment.magnitude(),
            addend: addend.resize(self.divider()),
            divisor: modulus.resize(self.divider()),
            modulus,
            term_down,
            carried,
            way,
            rest_positive,
            step,
            left,
            over,
            taken,
            first,
        };
        (net, next)
    }
}
