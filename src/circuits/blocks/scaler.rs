//! Scaler: multiplies a word by a gain, one bit of the gain per tick.
//!
//! ```text
//!         ┌────────┐
//!  start ▶│        ├──▶ busy, done
//!  value ▶│ scaler ├──▶ scaled
//!  gain ─▶│        │
//!  clear ▶│        │
//!         └────────┘
//! ```
//!
//! A gain has one integer bit, so it ranges from 0 to just below 2. The product is rounded down to
//! an integer. To keep a fraction, pass it in the lower bits of the value.

use crate::prelude::*;

/// Scaler.
///
/// `done` is high K + 1 ticks after `start`.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scaler {
    /// K: width of a gain, 2 to 64.
    pub gain: usize,
    /// Q: width of a value's word; the value itself has Q − 1 bits.
    pub value: usize,
}

impl Scaler {
    /// Ticks from `start` to `done`.
    pub const fn latency(&self) -> u64 {
        self.gain as u64 + 1
    }
}

signals! { for Scaler as c;
    /// Input ports. Values given with `start` are taken in that tick and need not be held.
    pub struct In {
        /// Starts a product; ignored while one is running.
        pub start: Bit,
        /// Aborts; a start in the same tick is ignored.
        pub clear: Bit,
        /// Value to scale; below 2^(Q − 1).
        pub value: U(c.value),
        /// Gain, in units of 2^−(K − 1).
        pub gain: U(c.gain),
    }
    /// Flip-flops.
    pub struct Reg {
        /// A product is being computed.
        pub(crate) busy: Bit = 0,
        /// Index of the current gain bit, lowest first.
        bit_index: U(6) = 0,
        /// Value that is being scaled.
        pub(crate) factor: U(c.value) = 0,
        /// Remaining bits of the gain.
        bits: U(c.gain) as Hex = 0,
        /// Partial product, scaled to the weight of the next bit; at the end the result.
        pub scaled: U(c.value) = 0,
        /// High for one tick: `scaled` is valid from this tick until the next start.
        pub done: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// A start is accepted.
        take: Bit,
        /// The current bit is the last one, the integer bit.
        last: Bit,
        /// Another bit follows in the next tick.
        more: Bit,
        /// Partial product plus the term of the current bit.
        total: U(c.value),
    }
}

impl Circuit for Scaler {
    const NAME: &'static str = "scaler";
    const ABOUT: &'static str = "multiplies a word by a gain, rounded down, one bit per tick";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let take = i.start & !q.busy & !i.clear;
        let last = q.bit_index.equals(self.gain as u64 - 1);
        let more = q.busy & !last & !i.clear;
        let total = q.scaled + q.bits.bit(0).mux(q.factor, 0);
        // After a fraction bit the product is halved.
        let product = last.mux(total, total.shift_right(1));
        let next = Reg {
            busy: take | more,
            bit_index: more.mux(q.bit_index + 1, 0),
            factor: take.mux(i.value, q.factor),
            bits: take.mux(i.gain, more.mux(q.bits.shift_right(1), 0)),
            scaled: take.mux(0, q.busy.mux(product, q.scaled)),
            done: q.busy & last & !i.clear,
        };
        (
            Net {
                take,
                last,
                more,
                total,
            },
            next,
        )
    }

    fn objection(&self) -> Option<String> {
        let counted = (2..=64).contains(&self.gain);
        (!counted).then(|| "a gain has a bit before the point and one behind".into())
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, next) = (&now.i, &now.q, &now.next.q);
        let taken = i.start & !q.busy & !i.clear;
        let held = next.factor.equals(i.value) & next.bits.equals(i.gain);
        let begun = next.busy & next.bit_index.is_zero() & held;
        let counted = next.bit_index.equals(q.bit_index + 1) & !next.bit_index.is_zero();
        let over = q.bit_index.equals(self.gain as u64 - 1);
        let steps = (over ^ (next.busy & counted)) & over.equals(next.done);
        let runs = i.clear.mux(!next.busy & !next.done, steps);
        // Twice a value whose highest bit is high is above every word.
        let highest = |word: U| word.bit(self.value - 1);
        let doubled = q.factor.shift_left(1);
        vec![
            Property::given(
                "the value is below half of the range when start is high",
                i.start.implies(!highest(i.value)),
            ),
            Property::step(
                "a start begins a product unless one is running or clear is high",
                &["busy", "factor", "bits"],
                taken.implies(begun),
            ),
            Property::step(
                "each bit of the gain is used once, and done follows the last one",
                &["bit_index", "done"],
                q.busy.mux(runs, !next.done),
            ),
            Property::always(
                "the partial product is at most twice the value",
                &["scaled"],
                highest(q.factor) | !doubled.below(q.scaled),
            ),
            Property::helper(
                "the bit index stays below the width of a gain",
                &["bit_index"],
                !U::new(self.gain as u64 - 1, 6).below(q.bit_index),
            ),
            Property::helper(
                "while busy is high, the partial product is at most the value",
                &["scaled", "busy"],
                q.busy.implies(!q.factor.below(q.scaled)),
            ),
            Property::helper(
                "the value that is being scaled is below half of the range",
                &["factor"],
                !highest(q.factor),
            ),
        ]
    }
}

impl Specified for Scaler {
    /// Without `start` the words are not looked at.
    fn applies(&self, i: &In<Value>) -> bool {
        i.start || (i.value, i.gain) == (0, 0)
    }
}
