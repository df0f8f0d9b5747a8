//! Coefficient control: which bit of its coefficients a sequential product is at.
//!
//! ```text
//!         ┌─────────────────────┐
//!  step ─▶│                     ├──▶ copy, fraction, top, commit
//!  halt ─▶│ coefficient_control ├──▶ busy, done
//!         └─────────────────────┘
//! ```
//!
//! A coefficient has two's complement bits of weights 2^−B … 2^−1, 1 and −2. The rows take them
//! from the lowest up, a bit a tick; after a bit of the fraction they halve their sum.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Unsigned};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L> {
        /// On to the next point; not taken while `busy`.
        pub step: L::Bit,
        /// Gives a step up that is under way; one that comes with it is not taken.
        pub halt: L::Bit,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L> {
        /// A step is under way.
        pub busy: L::Bit = 0,
        /// The bit the rows are at; those of the fraction come first.
        bit_index: L::U<6> = 0,
        /// The new point stands in this tick.
        pub done: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L> {
        /// A step is taken: the rows copy their coefficients.
        pub copy: L::Bit,
        /// The bit is one of the fraction.
        pub fraction: L::Bit,
        /// The bit is the sign, of weight −2.
        pub top: L::Bit,
        /// The sums are complete: they become the point.
        pub commit: L::Bit,
        /// A step is under way after this tick.
        going: L::Bit,
    }
}

/// Control for coefficients of `C` bits, of which B = `C` − 2 are fraction.
///
/// `done` is high B + 4 ticks after `step`.
#[derive(Debug, Clone, Default)]
pub struct CoefficientControl<const C: usize>;

impl<const C: usize> CoefficientControl<C> {
    /// Ticks from `step` to `done`.
    pub const LATENCY: u64 = C as u64 + 2;
}

impl<const C: usize> Circuit for CoefficientControl<C> {
    const NAME: &'static str = "coefficient_control";
    const ABOUT: &'static str = "counts the bits of the coefficients of a sequential product";
    type In<L: Logic> = In<L>;
    type Reg<L: Logic> = Reg<L>;
    type Net<L: Logic> = Net<L>;

    fn comb<L: Logic>(&self, q: &Reg<L>, i: &In<L>) -> Net<L> {
        const {
            assert!(
                C >= 3 && C <= 63,
                "a coefficient has a fraction, and its bits are counted"
            )
        };
        let copy = i.step & !q.busy & !i.halt;
        let commit = q.busy & q.bit_index.equals((C as u64).into()) & !i.halt;
        Net {
            copy,
            fraction: q.busy & q.bit_index.below((C as u64 - 2).into()),
            top: q.busy & q.bit_index.equals((C as u64 - 1).into()),
            commit,
            going: copy | (q.busy & !commit & !i.halt),
        }
    }

    fn next<L: Logic>(&self, q: Reg<L>, w: &Net<L>, _: &In<L>) -> Reg<L> {
        Reg {
            busy: w.going,
            bit_index: (w.going & !w.copy).mux(q.bit_index + 1, 0.into()),
            done: w.commit,
        }
    }
}

impl<const C: usize> Specified for CoefficientControl<C> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step("a step is taken where none is under way", |now, next| {
                let taken = now.i.step.get() && !now.i.halt.get() && !now.q.busy.get();
                let begins = next.busy.get() && next.bit_index.get() == 0 && now.w.copy.get();
                require(taken == begins, ["busy", "bit_index", "copy"], || {
                    "not so".into()
                })
            })
            .step("halt ends it", |now, next| {
                let right = !next.busy.get() && !next.done.get();
                require(right || !now.i.halt.get(), ["busy", "done"], || {
                    "goes on".into()
                })
            })
            .step("each bit comes once, in order", |now, next| {
                let under_way = now.q.busy.get() && !now.i.halt.get();
                let (bit, last) = (now.q.bit_index.get(), C as u64);
                let expected = (bit < last).then_some(bit + 1);
                let after = next.busy.get().then(|| next.bit_index.get());
                let right = after == expected && next.done.get() == (bit == last);
                require(right || !under_way, ["bit_index", "done"], || {
                    format!("{after:?} after {bit}")
                })
            })
            .step("done where a step ends, nowhere else", |now, next| {
                let right = next.done.get() <= now.q.busy.get();
                require(right, ["done"], || "without a step".into())
            })
            .always("fraction, a one, the sign, then the point", |now| {
                let (bit, w) = (now.q.bit_index.get(), now.w);
                let kinds = [w.fraction.get(), w.top.get(), w.commit.get()];
                let count = kinds.iter().filter(|kind| **kind).count();
                let expected = match now.q.busy.get() {
                    false => [false; 3],
                    true => [
                        bit + 2 < C as u64,
                        bit + 1 == C as u64,
                        bit == C as u64 && !now.i.halt.get(),
                    ],
                };
                require(
                    kinds == expected && count <= 1,
                    ["fraction", "top", "commit"],
                    || format!("bit {bit}"),
                )
            })
    }
}
