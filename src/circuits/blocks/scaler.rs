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
        busy: Bit = 0,
        /// Index of the current gain bit, lowest first.
        bit_index: U(6) = 0,
        /// Value that is being scaled.
        factor: U(c.value) = 0,
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
}

impl Specified for Scaler {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step(
                "a start begins a product unless one is running or clear is high",
                |now, next| {
                    let taken = now.i.start && !now.q.busy && !now.i.clear;
                    let begun = next.q.busy && next.q.bit_index == 0;
                    let begun = begun && next.q.factor == now.i.value && next.q.bits == now.i.gain;
                    require(!taken || begun, ["busy", "factor", "bits"], || {
                        "not begun".into()
                    })
                },
            )
            .step(
                "each bit of the gain is used once, and done follows the last one",
                |now, next| {
                    let bit = now.q.bit_index;
                    let over = bit + 1 == self.gain as u64;
                    let goes_on = next.q.busy && next.q.bit_index == bit + 1;
                    let right = goes_on != over && next.q.done == over;
                    let ended = !next.q.busy && !next.q.done;
                    let right = if now.i.clear { ended } else { right };
                    let idle = !now.q.busy && !next.q.done;
                    require(idle || (now.q.busy && right), ["bit_index", "done"], || {
                        "not so".into()
                    })
                },
            )
            .always("the partial product is at most twice the value", |now| {
                let right = now.q.scaled <= 2 * now.q.factor;
                require(right, ["scaled"], || "too large".into())
            })
    }

    fn applies(&self, i: &In<Value>) -> bool {
        let given = i.value > 0 || i.gain > 0;
        i.value >> (self.value - 1) == 0 && (i.start || !given)
    }
}
