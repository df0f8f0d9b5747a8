//! Sequential multiplier-divider: `(multiplicand · multiplier + addend) / divisor` with remainder,
//! one bit a tick.
//!
//! ```text
//!                                       ┌─────────┐
//!  start, product_only ────────────────▶│         ├──▶ busy, done
//!  multiplicand, multiplier, addend ───▶│ mul_div ├──▶ quotient
//!  divisor ────────────────────────────▶│         ├──▶ remainder
//!                                       └─────────┘
//! ```
//!
//! The product is made from the multiplier's lowest bit up, on top of the addend; the division
//! restores, from the dividend's highest bit down. Dividend and quotient share a register.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::sim::UInt;
use crate::logic::{Bit, Logic, Sim, Unsigned};
use crate::signals;

/// Names of the states.
const STATES: &[&str] = &["idle", "multiply", "divide"];
const IDLE: u64 = 0;
const MULTIPLY: u64 = 1;
const DIVIDE: u64 = 2;

signals! {
    /// Ports in. What is given with `start` is taken in that tick and need not be held.
    pub struct In<L, const M: usize, const Q: usize> {
        /// Begins, unless one is under way.
        pub start: L::Bit,
        /// The product with its addend is wanted, no division: it is in `quotient`.
        pub product_only: L::Bit,
        /// First factor.
        pub multiplicand: L::U<Q>,
        /// Second factor.
        pub multiplier: L::U<M>,
        /// Added to the product; together they are below 2^Q.
        pub addend: L::U<Q>,
        /// What the sum is divided by, below 2^(Q − 1). By 0 the quotient is all ones.
        pub divisor: L::U<Q>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const M: usize, const Q: usize> {
        /// What it does.
        state: L::U<2> as States(STATES) = 0,
        /// Ticks that the state has lasted.
        count: L::U<6> = 0,
        /// The product is all that is wanted.
        undivided: L::Bit = 0,
        /// First factor times the weight of the multiplier's lowest bit.
        shifted: L::U<Q> = 0,
        /// Bits of the second factor that are yet to come.
        factor: L::U<M> = 0,
        /// What is divided by.
        by: L::U<Q> = 0,
        /// Sum of the product, then dividend above and quotient below; the result.
        pub quotient: L::U<Q> = 0,
        /// What is left of the dividend.
        pub remainder: L::U<Q> = 0,
        /// A result stands at `quotient` and `remainder` from this tick on, until the next start.
        pub done: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const Q: usize> {
        /// A start is not taken.
        pub busy: L::Bit,
        /// A start is taken.
        take: L::Bit,
        /// The remainder with the dividend's highest bit behind it.
        partial: L::U<Q>,
        /// The divisor goes into `partial`.
        fits: L::Bit,
        /// The state's last tick.
        last: L::Bit,
        /// The result is complete with this tick.
        complete: L::Bit,
    }
}

/// Multiplier-divider of words of `Q` bits by a multiplier of `M` bits.
///
/// `done` is high M + Q + 1 ticks after `start`, M + 1 with `product_only`.
#[derive(Debug, Clone, Default)]
pub struct MulDiv<const M: usize, const Q: usize>;

impl<const M: usize, const Q: usize> MulDiv<M, Q> {
    /// Ticks from `start` to `done`.
    pub const LATENCY: u64 = (M + Q + 1) as u64;
    /// Ticks from `start` to `done` with `product_only`.
    pub const PRODUCT_LATENCY: u64 = (M + 1) as u64;
}

impl<const M: usize, const Q: usize> Circuit for MulDiv<M, Q> {
    const NAME: &'static str = "mul_div";
    const ABOUT: &'static str = "multiplies, adds and divides with remainder, one bit a tick";
    type In<L: Logic> = In<L, M, Q>;
    type Reg<L: Logic> = Reg<L, M, Q>;
    type Net<L: Logic> = Net<L, Q>;

    fn comb<L: Logic>(&self, q: &Reg<L, M, Q>, i: &In<L, M, Q>) -> Net<L, Q> {
        let (multiplies, divides) = (q.state.bit(0), q.state.bit(1));
        let busy = multiplies | divides;
        let partial = partial(q);
        let last = q
            .count
            .equals(divides.mux((Q as u64 - 1).into(), (M as u64 - 1).into()));
        Net {
            busy,
            take: i.start & !busy,
            partial,
            fits: !partial.below(q.by),
            last,
            complete: last & (divides | (multiplies & q.undivided)),
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, M, Q>, w: &Net<L, Q>, i: &In<L, M, Q>) -> Reg<L, M, Q> {
        let (multiplies, undivided) = (q.state.bit(0), q.undivided);
        let after = (multiplies & !undivided).mux(DIVIDE.into(), IDLE.into());
        let state = (w.busy & w.last).mux(after, q.state);
        let stepped = step(q, w.busy, w.partial, w.fits);
        Reg {
            state: w.take.mux(MULTIPLY.into(), state),
            count: (w.take | w.last).mux(0.into(), stepped.count),
            undivided: w.take.mux(i.product_only, undivided),
            shifted: w.take.mux(i.multiplicand, stepped.shifted),
            factor: w.take.mux(i.multiplier, stepped.factor),
            by: w.take.mux(i.divisor, stepped.by),
            quotient: w.take.mux(i.addend, stepped.quotient),
            remainder: w.take.mux(0.into(), stepped.remainder),
            done: w.complete,
        }
    }
}

/// The remainder with the next bit of the dividend.
fn partial<L: Logic, const M: usize, const Q: usize>(q: &Reg<L, M, Q>) -> L::U<Q> {
    q.remainder.shift_left(1) | q.quotient.bit(Q - 1).word().resize()
}

/// The registers with one bit more of the product or of the quotient.
fn step<L: Logic, const M: usize, const Q: usize>(
    q: Reg<L, M, Q>,
    busy: L::Bit,
    partial: L::U<Q>,
    fits: L::Bit,
) -> Reg<L, M, Q> {
    let (multiplies, divides) = (q.state.bit(0), q.state.bit(1));
    let sum = q.quotient + q.factor.bit(0).mux(q.shifted, 0.into());
    let shifted_quotient = q.quotient.shift_left(1) | fits.word().resize();
    Reg {
        count: busy.mux(q.count + 1, q.count),
        shifted: multiplies.mux(q.shifted.shift_left(1), q.shifted),
        factor: multiplies.mux(q.factor.shift_right(1), q.factor),
        quotient: divides.mux(shifted_quotient, multiplies.mux(sum, q.quotient)),
        remainder: divides.mux(fits.mux(partial - q.by, partial), q.remainder),
        ..q
    }
}

impl<const M: usize, const Q: usize> Specified for MulDiv<M, Q> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step("a start is taken unless one is under way", |now, next| {
                let taken = now.i.start.get() && now.q.state.get() == IDLE;
                let restarted = next.state.get() == MULTIPLY && next.count.get() == 0;
                let begins = restarted && next.quotient == now.i.addend;
                require(!taken || begins, ["state", "quotient"], || {
                    "not begun".into()
                })
            })
            .step(
                "it multiplies for M ticks and divides for Q",
                |now, next| {
                    let length = match now.q.state.get() {
                        MULTIPLY => M as u64,
                        _ => Q as u64,
                    };
                    let goes_on = next.state == now.q.state && next.count == now.q.count + 1;
                    let over = now.q.count.get() + 1 == length;
                    let right = now.q.state.get() == IDLE || over != goes_on;
                    require(right, ["state", "count"], || "too long or too short".into())
                },
            )
            .step(
                "done stands for one tick, when the last bit is made",
                |now, next| {
                    let ended = now.q.state.get() != IDLE && next.state.get() == IDLE;
                    require(next.done.get() == ended, ["done"], || {
                        "at a wrong time".into()
                    })
                },
            )
            .always("the remainder stays below the divisor", |now| {
                let right = now.q.by.get() == 0 || now.q.remainder.get() < now.q.by.get();
                require(right, ["remainder", "by"], || "too large".into())
            })
            .step(
                "what was divided so far is quotient times divisor plus remainder",
                |now, next| {
                    // The bits of the dividend that are in: those above, and the quotient's below.
                    let known = |q: &Reg<Sim, M, Q>, bits: u64| -> Option<u128> {
                        let low: UInt<Q> = q.quotient & ((1u64 << bits) - 1).into();
                        let (by, rest) = (u128::from(q.by.get()), u128::from(q.remainder.get()));
                        (q.state.get() == DIVIDE).then(|| u128::from(low.get()) * by + rest)
                    };
                    let Some(dividend) = known(now.q, now.q.count.get()) else {
                        return Ok(());
                    };
                    let bit = u128::from(now.q.quotient.get() >> (Q - 1) & 1);
                    let after = Reg {
                        state: DIVIDE.into(),
                        ..next.clone()
                    };
                    let right = known(&after, now.q.count.get() + 1) == Some(2 * dividend + bit);
                    require(
                        right || now.q.by.get() == 0,
                        ["quotient", "remainder"],
                        || format!("{dividend} so far, and {bit}"),
                    )
                },
            )
    }

    fn applies(&self, i: &In<Sim, M, Q>) -> bool {
        let least = 1 << (Q - 1);
        let fits = i.multiplicand.get() * i.multiplier.get() + i.addend.get() < 2 * least;
        // Without `start` the other ports are not looked at.
        let given = [i.multiplicand, i.addend, i.divisor]
            .iter()
            .any(|word| word.get() > 0);
        let given = given || i.multiplier.get() > 0 || i.product_only.get();
        fits && i.divisor.get() < least && (i.start.get() || !given)
    }
}
