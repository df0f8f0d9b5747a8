//! Shifter: a word divided by a power of two that is chosen in the run, rounded down.
//!
//! ```text
//!         ┌─────────┐
//!  word ─▶│ shifter ├──▶ shifted
//!  by ───▶│         │
//!         └─────────┘
//! ```

use crate::check::{Invariants, Specified, require};
use crate::kernel::{Circuit, Nothing};
use crate::logic::{Bit, Logic, Signed, Unsigned};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const R: usize> {
        /// What is shifted.
        pub word: L::I<R>,
        /// By how many bits.
        pub by: L::U<6>,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const R: usize> {
        /// By the lowest bit of `by`.
        by_1: L::I<R>,
        /// By two bits of it.
        by_3: L::I<R>,
        /// By three.
        by_7: L::I<R>,
        /// By four.
        by_15: L::I<R>,
        /// By five.
        by_31: L::I<R>,
        /// By all of it.
        pub shifted: L::I<R>,
    }
}

/// Shifter for words of `R` bits.
#[derive(Debug, Clone, Default)]
pub struct Shifter<const R: usize>;

impl<const R: usize> Circuit for Shifter<R> {
    const NAME: &'static str = "shifter";
    const ABOUT: &'static str = "a word divided by a power of two, rounded down";
    type In<L: Logic> = In<L, R>;
    type Reg<L: Logic> = Nothing<L>;
    type Net<L: Logic> = Net<L, R>;

    fn comb<L: Logic>(&self, _: &Nothing<L>, i: &In<L, R>) -> Net<L, R> {
        let stage = |word: L::I<R>, bit: usize| -> L::I<R> {
            i.by.bit(bit).mux(word.shift_right(1 << bit), word)
        };
        let by_1 = stage(i.word, 0);
        let by_3 = stage(by_1, 1);
        let by_7 = stage(by_3, 2);
        let by_15 = stage(by_7, 3);
        let by_31 = stage(by_15, 4);
        Net {
            by_1,
            by_3,
            by_7,
            by_15,
            by_31,
            shifted: stage(by_31, 5),
        }
    }

    fn next<L: Logic>(&self, q: Nothing<L>, _: &Net<L, R>, _: &In<L, R>) -> Nothing<L> {
        q
    }
}

impl<const R: usize> Specified for Shifter<R> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new().always("it is the quotient, rounded down", |now| {
            let divisor = 1i128 << now.i.by.get();
            let expected = i128::from(now.i.word.get()).div_euclid(divisor);
            let shifted = i128::from(now.w.shifted.get());
            require(shifted == expected, ["shifted"], || {
                format!("not {expected}")
            })
        })
    }
}
