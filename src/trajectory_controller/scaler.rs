//! Scaler: a word times a gain, one bit of the gain a tick.
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
//! A gain has one bit before the point: 0 to just below 2. The product is rounded down to a whole
//! word; what the rounding takes away is gone before it could be seen, so a value that is to keep
//! a fraction brings it along as its lower bits.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Sim, Unsigned};
use crate::signals;

signals! {
    /// Ports in. What is given with `start` is taken in that tick and need not be held.
    pub struct In<L, const K: usize, const Q: usize> {
        /// Begins, unless one is under way.
        pub start: L::Bit,
        /// Gives up what is under way; a start that comes with it is not taken.
        pub clear: L::Bit,
        /// What is scaled; below 2^(Q − 1).
        pub value: L::U<Q>,
        /// By how much, in units of 2^−(K − 1).
        pub gain: L::U<K>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const K: usize, const Q: usize> {
        /// A product is under way.
        busy: L::Bit = 0,
        /// The bit of the gain it is at.
        bit_index: L::U<6> = 0,
        /// What is scaled.
        factor: L::U<Q> = 0,
        /// Bits of the gain that are yet to come.
        bits: L::U<K> as Hex = 0,
        /// The product so far, by the weight of the bit to come; the result.
        pub scaled: L::U<Q> = 0,
        /// The result stands in this tick, until the next start.
        pub done: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const Q: usize> {
        /// A start is taken.
        take: L::Bit,
        /// The bit is the last, the one before the point.
        last: L::Bit,
        /// Another bit comes after it.
        more: L::Bit,
        /// The product with what the bit adds.
        total: L::U<Q>,
    }
}

/// Scaler for values of `Q` − 1 bits in words of `Q`, and gains of `K` bits.
///
/// `done` is high `K` + 1 ticks after `start`.
#[derive(Debug, Clone, Default)]
pub struct Scaler<const K: usize, const Q: usize>;

impl<const K: usize, const Q: usize> Scaler<K, Q> {
    /// Ticks from `start` to `done`.
    pub const LATENCY: u64 = K as u64 + 1;
}

impl<const K: usize, const Q: usize> Circuit for Scaler<K, Q> {
    const NAME: &'static str = "scaler";
    const ABOUT: &'static str = "a word times a gain, rounded down, a bit a tick";
    type In<L: Logic> = In<L, K, Q>;
    type Reg<L: Logic> = Reg<L, K, Q>;
    type Net<L: Logic> = Net<L, Q>;

    fn comb<L: Logic>(&self, q: &Reg<L, K, Q>, i: &In<L, K, Q>) -> Net<L, Q> {
        const {
            assert!(
                K >= 2 && K <= 64,
                "a gain has a bit before the point and one behind"
            )
        };
        let last = q.bit_index.equals((K as u64 - 1).into());
        Net {
            take: i.start & !q.busy & !i.clear,
            last,
            more: q.busy & !last & !i.clear,
            total: q.scaled + q.bits.bit(0).mux(q.factor, 0.into()),
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, K, Q>, w: &Net<L, Q>, i: &In<L, K, Q>) -> Reg<L, K, Q> {
        // After a bit behind the point the product is halved.
        let product = w.last.mux(w.total, w.total.shift_right(1));
        Reg {
            busy: w.take | w.more,
            bit_index: w.more.mux(q.bit_index + 1, 0.into()),
            factor: w.take.mux(i.value, q.factor),
            bits: w
                .take
                .mux(i.gain, w.more.mux(q.bits.shift_right(1), 0.into())),
            scaled: w.take.mux(0.into(), q.busy.mux(product, q.scaled)),
            done: q.busy & w.last & !i.clear,
        }
    }
}

impl<const K: usize, const Q: usize> Specified for Scaler<K, Q> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step("a start is taken unless one is under way", |now, next| {
                let taken = now.i.start.get() && !now.q.busy.get() && !now.i.clear.get();
                let begun = next.busy.get() && next.bit_index.get() == 0;
                let begun = begun && next.factor == now.i.value && next.bits == now.i.gain;
                require(!taken || begun, ["busy", "factor", "bits"], || {
                    "not begun".into()
                })
            })
            .step(
                "every bit of the gain comes once, done after the last",
                |now, next| {
                    let bit = now.q.bit_index.get();
                    let over = bit + 1 == K as u64;
                    let goes_on = next.busy.get() && next.bit_index.get() == bit + 1;
                    let right = goes_on != over && next.done.get() == over;
                    let ended = !next.busy.get() && !next.done.get();
                    let right = if now.i.clear.get() { ended } else { right };
                    let idle = !now.q.busy.get() && !next.done.get();
                    require(
                        idle || (now.q.busy.get() && right),
                        ["bit_index", "done"],
                        || "not so".into(),
                    )
                },
            )
            .always("the product so far fits", |now| {
                let right = now.q.scaled.get() <= 2 * now.q.factor.get();
                require(right, ["scaled"], || "too large".into())
            })
    }

    fn applies(&self, i: &In<Sim, K, Q>) -> bool {
        let given = i.value.get() > 0 || i.gain.get() > 0;
        i.value.get() >> (Q - 1) == 0 && (i.start.get() || !given)
    }
}
