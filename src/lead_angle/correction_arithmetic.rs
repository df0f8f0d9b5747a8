//! Correction arithmetic 28: Δt2 = Δt1 + Δt1·d2/d1, on the grid of the codes.
//!
//! ```text
//!                             ┌───────────────────────┐ start, multiplicand, …
//!  complete, learn, missed ──▶│                       ├──▶ mul_div
//!  lead_time, overrun, error ▶│ correction arithmetic │◀── done, quotient
//!  seed ─────────────────────▶│                       ├──▶ raw, learned
//!                             └───────────────────────┘──▶ corrected
//! ```
//!
//! The quotient is rounded to the nearest and made of amounts; its sign is that of d2/d1, so it is
//! right for both directions. `raw` is put on the grid by the [ratio logic](super::ratio_logic).
//!
//! Departures, all of them where the text is silent: an overrun of 0 teaches nothing. A time of 0
//! would never change, so it begins with `seed` if there was an error. The result is at least one
//! CK and at most the last code. A positioning that was halted teaches nothing.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Signed, Sim, Unsigned};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const C: usize, const W: usize, const R: usize> {
        /// The positioning is complete.
        pub complete: L::Bit,
        /// Times are to be learned.
        pub learn: L::Bit,
        /// The control signal was not given by the comparator.
        pub missed: L::Bit,
        /// Δt1 in CKs.
        pub lead_time: L::U<C>,
        /// d1.
        pub overrun: L::I<W>,
        /// d2.
        pub error: L::I<W>,
        /// The time that a step begins with that has none.
        pub seed: L::U<C>,
        /// The divider has its result.
        pub done: L::Bit,
        /// The divider's result: |Δtd|.
        pub quotient: L::U<R>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const C: usize> {
        /// The divider works on a correction.
        dividing: L::Bit,
        /// Δtd is negative.
        negative: L::Bit,
        /// Δt2 before it is put on the grid.
        pub raw: L::U<C>,
        /// `raw` is a new time; one tick.
        pub learned: L::Bit,
        /// The correction is over, with a new time or without; one tick.
        pub corrected: L::Bit,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const C: usize, const W: usize, const R: usize> {
        /// A correction is wanted.
        wanted: L::Bit,
        /// The correction is wanted and can be made by a division.
        pub divide: L::Bit,
        /// The step begins with the seed.
        sow: L::Bit,
        /// |d2|, first factor.
        pub multiplicand: L::U<R>,
        /// Δt1, second factor.
        pub multiplier: L::U<C>,
        /// |d1|.
        pub divisor: L::U<R>,
        /// Half of |d1|: the quotient is rounded to the nearest.
        pub addend: L::U<R>,
        /// The division of a correction is over.
        divided: L::Bit,
        /// Δt1 + |Δtd|.
        sum: L::U<R>,
        /// Δt1 + |Δtd| as a code can be.
        longer: L::U<C>,
        /// |Δtd| takes all of Δt1.
        vanishes: L::Bit,
        /// Δt1 − |Δtd|.
        rest: L::U<R>,
        /// The same as a code can be.
        shorter: L::U<C>,
    }
}

/// Correction arithmetic 28 with times of `C` bits, positions of `W`, a divider of `R` = `W` + `C`;
/// times end at 10·`K`.
#[derive(Debug, Clone, Default)]
pub struct CorrectionArithmetic<const K: usize, const C: usize, const W: usize, const R: usize>;

impl<const K: usize, const C: usize, const W: usize, const R: usize>
    CorrectionArithmetic<K, C, W, R>
{
    /// The last code.
    const LAST: u64 = {
        assert!(R == W + C, "R is the width of the product, W + C");
        assert!(10 * K < 1 << C, "a time holds the last code");
        10 * K as u64
    };
}

impl<const K: usize, const C: usize, const W: usize, const R: usize> Circuit
    for CorrectionArithmetic<K, C, W, R>
{
    const NAME: &'static str = "correction_arithmetic";
    const ABOUT: &'static str = "the next lead time from overrun and error";
    type In<L: Logic> = In<L, C, W, R>;
    type Reg<L: Logic> = Reg<L, C>;
    type Net<L: Logic> = Net<L, C, W, R>;

    fn comb<L: Logic>(&self, q: &Reg<L, C>, i: &In<L, C, W, R>) -> Net<L, C, W, R> {
        let wanted = i.complete & i.learn & !i.missed;
        let none = i.lead_time.is_zero();
        let divisor: L::U<R> = i.overrun.magnitude().resize();
        let time: L::U<R> = i.lead_time.resize();
        let sum = time + i.quotient;
        let last: L::U<R> = Self::LAST.into();
        let vanishes = !i.quotient.below(time);
        let rest = time - i.quotient;
        Net {
            wanted,
            divided: q.dividing & i.done,
            divide: wanted & !none & !divisor.is_zero(),
            sow: wanted & none & !i.error.is_zero(),
            multiplicand: i.error.magnitude().resize(),
            multiplier: i.lead_time,
            divisor,
            addend: divisor.shift_right(1),
            sum,
            longer: last.below(sum).mux(last, sum).resize(),
            vanishes,
            rest,
            shorter: vanishes.mux(1.into(), rest.resize()),
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, C>, w: &Net<L, C, W, R>, i: &In<L, C, W, R>) -> Reg<L, C> {
        let opposed = i.error.is_negative() ^ i.overrun.is_negative();
        let result = q.negative.mux(w.shorter, w.longer);
        Reg {
            dividing: w.divide | (q.dividing & !i.done),
            negative: w.divide.mux(opposed, q.negative),
            raw: w.divided.mux(result, w.sow.mux(i.seed, q.raw)),
            learned: w.divided | w.sow,
            corrected: w.divided | (i.complete & !w.divide),
        }
    }
}

impl<const K: usize, const C: usize, const W: usize, const R: usize> Specified
    for CorrectionArithmetic<K, C, W, R>
{
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step(
                "every completion is corrected, at once or when divided",
                |now, next| {
                    let divides = now.w.divide.get();
                    let ended = now.q.dividing.get() && now.i.done.get();
                    let corrected = ended || (now.i.complete.get() && !divides);
                    let dividing = divides || (now.q.dividing.get() && !ended);
                    let right =
                        next.corrected.get() == corrected && next.dividing.get() == dividing;
                    require(right, ["corrected", "dividing"], || {
                        format!("{corrected} and {dividing} expected")
                    })
                },
            )
            .step(
                "it learns from a division, or begins with the seed",
                |now, next| {
                    let i = now.i;
                    let learns = i.complete.get() && i.learn.get() && !i.missed.get();
                    let (time, error) = (i.lead_time.get(), i.error.get());
                    let sown = learns && time == 0 && error != 0;
                    let divided = now.q.dividing.get() && i.done.get();
                    let right = next.learned.get() == (sown || divided)
                        && (!sown || divided || next.raw == i.seed)
                        && now.w.divide.get() == (learns && time > 0 && i.overrun.get() != 0);
                    require(right, ["learned", "divide", "raw"], || {
                        format!("a time of {time} with an error of {error}")
                    })
                },
            )
            .step(
                "the result is the sum within 1 and the last code",
                |now, next| {
                    if !(now.q.dividing.get() && now.i.done.get()) {
                        return Ok(());
                    }
                    let (time, by) = (now.i.lead_time.get() as i128, now.i.quotient.get() as i128);
                    let sum = if now.q.negative.get() {
                        time - by
                    } else {
                        time + by
                    };
                    let expected = sum.clamp(1, 10 * K as i128);
                    require(i128::from(next.raw.get()) == expected, ["raw"], || {
                        format!("{expected} expected")
                    })
                },
            )
            .step("the sign is that of error by overrun", |now, next| {
                let signs = now.i.error.get().signum() * now.i.overrun.get().signum();
                let right = next.negative.get() == (signs < 0) || signs == 0;
                require(!now.w.divide.get() || right, ["negative"], || {
                    "wrong".into()
                })
            })
    }

    /// Times as the memory holds them, and quotients that such a division can have.
    fn applies(&self, i: &In<Sim, C, W, R>) -> bool {
        let last = 10 * K as u64;
        i.lead_time.get() <= last && i.seed.get() <= 1
    }
}
