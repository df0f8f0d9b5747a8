//! Coefficient control: counts the bits of the coefficients of a sequential product.
//!
//! ```text
//!         ┌─────────────────────┐
//!  step ─▶│                     ├──▶ copy, fraction, top, commit
//!  halt ─▶│ coefficient_control ├──▶ busy, done
//!         └─────────────────────┘
//! ```
//!
//! A coefficient is a two's complement number with bit weights 2^−B … 2^−1, 1 and −2. The rows take
//! one bit per tick, the lowest first. After each fraction bit they halve their sum.

use crate::prelude::*;

/// Control for coefficients with B = `coefficient` − 2 fraction bits.
///
/// `done` is high B + 4 ticks after `step`.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CoefficientControl {
    /// Width of a coefficient in bits, 3 to 63.
    pub coefficient: usize,
}

impl CoefficientControl {
    /// Ticks from `step` to `done`.
    pub const fn latency(&self) -> u64 {
        self.coefficient as u64 + 2
    }
}

signals! { for CoefficientControl as c;
    /// Input ports.
    pub struct In {
        /// Advances to the next point; ignored while `busy`.
        pub step: Bit,
        /// Aborts a running step; a step in the same tick is ignored.
        pub halt: Bit,
    }
    /// Flip-flops.
    pub struct Reg {
        /// A step is running.
        pub busy: Bit = 0,
        /// Index of the current coefficient bit, lowest first; the width of a coefficient in the
        /// tick of `commit`.
        bit_index: U(6) = 0,
        /// The new point is valid in this tick.
        pub done: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// A step is accepted: the rows copy their coefficients.
        pub copy: Bit,
        /// The current bit is a fraction bit.
        pub fraction: Bit,
        /// The current bit is the sign bit, of weight −2.
        pub top: Bit,
        /// The sums are complete and become the point.
        pub commit: Bit,
        /// A step runs in the next tick.
        going: Bit,
    }
}

impl Circuit for CoefficientControl {
    const NAME: &'static str = "coefficient_control";
    const ABOUT: &'static str = "counts the bits of the coefficients of a sequential product";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        let wrong = !(3..=63).contains(&self.coefficient);
        wrong.then(|| "a coefficient has a fraction, and its bits are counted".into())
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let bits = self.coefficient as u64;
        let copy = i.step & !q.busy & !i.halt;
        let commit = q.busy & q.bit_index.equals(bits) & !i.halt;
        let going = copy | (q.busy & !commit & !i.halt);
        let net = Net {
            copy,
            fraction: q.busy & q.bit_index.below(bits - 2),
            top: q.busy & q.bit_index.equals(bits - 1),
            commit,
            going,
        };
        let next = Reg {
            busy: going,
            bit_index: (going & !copy).mux(q.bit_index + 1, 0),
            done: commit,
        };
        (net, next)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, w, next) = (&now.i, &now.q, &now.w, &now.next.q);
        let bits = self.coefficient as u64;
        let taken = i.step & !i.halt & !q.busy;
        let begins = next.busy & next.bit_index.is_zero() & w.copy;
        let bit = q.bit_index;
        let goes_on = next.busy & next.bit_index.equals(bit + 1);
        let counted = bit.below(bits).mux(goes_on, !next.busy);
        let fraction = q.busy & bit.below(bits - 2);
        let top = q.busy & bit.equals(bits - 1);
        let commit = q.busy & bit.equals(bits) & !i.halt;
        vec![
            Property::step(
                "a step begins if and only if step is high, none is running, and halt is low",
                &["busy", "bit_index", "copy"],
                taken.equals(begins),
            ),
            Property::step(
                "halt ends a step",
                &["busy", "done"],
                i.halt.implies(!next.busy & !next.done),
            ),
            Property::step(
                "each bit comes once, in order",
                &["bit_index", "done"],
                q.busy
                    .implies(i.halt | (counted & next.done.equals(bit.equals(bits)))),
            ),
            Property::step(
                "done comes only at the end of a step",
                &["done"],
                next.done.implies(q.busy),
            ),
            Property::always(
                "the fraction bits come first, then the bit of weight one, the sign and commit",
                &["fraction", "top", "commit"],
                w.fraction.equals(fraction) & w.top.equals(top) & w.commit.equals(commit),
            ),
            Property::helper(
                "the bit index is at most the width of a coefficient",
                &["bit_index"],
                !U::new(bits, 6).below(bit),
            ),
        ]
    }
}

impl Specified for CoefficientControl {}
