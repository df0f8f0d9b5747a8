//! A column of the difference engine: a number as whole and part, and the adder that takes the
//! column below to it.
//!
//! ```text
//!                       ┌───────────────────┐
//!  load, word, data ───▶│                   ├──▶ whole, part
//!  modulus, step ──────▶│ difference_column │
//!  by_whole, by_part ──▶│                   ├──▶ nearest
//!                       └───────────────────┘
//! ```
//!
//! The number is `whole + part / modulus` with `0 <= part < modulus`, so a quotient is carried
//! without an error whatever the modulus, and without a divider: the part wraps at the modulus and
//! carries into the whole. The whole wraps at its width; sums are linear, so it comes out right
//! whenever the number itself fits, whatever the columns below did on the way.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Sim, Unsigned};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const P: usize, const F: usize, const D: usize> {
        /// `data` is word `word` of a record.
        pub load: L::Bit,
        /// Number of the word.
        pub word: L::U<5>,
        /// Its data.
        pub data: L::U<D> as Hex,
        /// What a part wraps at: 1 to 2^(F − 1).
        pub modulus: L::U<F>,
        /// Adds the column below; not with `load`.
        pub step: L::Bit,
        /// Whole of the column below.
        pub by_whole: L::I<P>,
        /// Its part, below the modulus.
        pub by_part: L::U<F>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const P: usize, const F: usize> {
        /// The whole: the number, rounded down.
        pub whole: L::I<P> as Analog = 0,
        /// What it is above the whole, in parts of the modulus.
        pub part: L::U<F> = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const P: usize, const F: usize> {
        /// Sum of the parts; below 2^F, since both are below the modulus.
        sum: L::U<F>,
        /// They make a whole.
        carry: L::Bit,
        /// The word is this column's whole.
        load_whole: L::Bit,
        /// The word is its part.
        load_part: L::Bit,
        /// The number, rounded to the nearest whole, a half upwards.
        pub nearest: L::I<P> as Analog,
    }
}

/// Column with a whole of `P` bits and a part of `F`, for records with words of `D` bits.
#[derive(Debug, Clone, Default)]
pub struct DifferenceColumn<const P: usize, const F: usize, const D: usize> {
    /// The word of a record that is its whole. It clears the part.
    pub whole_word: u64,
    /// The word that is its part, after the whole; none where a record's part is always 0.
    pub part_word: Option<u64>,
}

impl<const P: usize, const F: usize, const D: usize> Circuit for DifferenceColumn<P, F, D> {
    const NAME: &'static str = "difference_column";
    const ABOUT: &'static str = "whole and part of a number, and the adder of the column below";
    type In<L: Logic> = In<L, P, F, D>;
    type Reg<L: Logic> = Reg<L, P, F>;
    type Net<L: Logic> = Net<L, P, F>;

    fn comb<L: Logic>(&self, q: &Reg<L, P, F>, i: &In<L, P, F, D>) -> Net<L, P, F> {
        const { assert!(D >= P && D >= F, "a word of a record holds whole and part") };
        let sum = q.part + i.by_part;
        let whole_word = L::parameter("whole_word", self.whole_word);
        let load_part = match self.part_word {
            Some(word) => i.load & i.word.equals(L::parameter("part_word", word)),
            None => false.into(),
        };
        let up = !q.part.shift_left(1).below(i.modulus);
        Net {
            sum,
            carry: !sum.below(i.modulus),
            load_whole: i.load & i.word.equals(whole_word),
            load_part,
            nearest: up.mux(q.whole + 1, q.whole),
        }
    }

    fn next<L: Logic>(
        &self,
        q: Reg<L, P, F>,
        w: &Net<L, P, F>,
        i: &In<L, P, F, D>,
    ) -> Reg<L, P, F> {
        let moved = q.whole + i.by_whole;
        let whole = w.carry.mux(moved + 1, moved);
        let part = w.carry.mux(w.sum - i.modulus, w.sum);
        Reg {
            whole: w
                .load_whole
                .mux(i.data.resize().signed(), i.step.mux(whole, q.whole)),
            part: w.load_whole.mux(
                0.into(),
                w.load_part.mux(i.data.resize(), i.step.mux(part, q.part)),
            ),
        }
    }
}

impl<const P: usize, const F: usize, const D: usize> Specified for DifferenceColumn<P, F, D> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step("a step adds the column below, exactly", |now, next| {
                let modulus = now.i.modulus.get() as i64;
                let number = |whole: i64, part: u64| whole * modulus + part as i64;
                let sum = number(now.q.whole.get(), now.q.part.get())
                    + number(now.i.by_whole.get(), now.i.by_part.get());
                let after = number(next.whole.get(), next.part.get());
                let right = (after - sum).rem_euclid(modulus << P) == 0;
                let steps = now.i.step.get() && !now.i.load.get();
                require(right || !steps, ["whole", "part"], || {
                    format!("{after} / {modulus}, not {sum} / {modulus}")
                })
            })
            .step("the part stays below the modulus", |now, next| {
                let right = next.part.get() < now.i.modulus.get();
                let loaded = now.w.load_part.get();
                require(right || loaded, ["part"], || "too large".into())
            })
            .step("its words are loaded, others are not", |now, next| {
                let word = now.i.load.get().then(|| now.i.word.get());
                let (mut whole, mut part) = (now.q.whole, now.q.part);
                if word == Some(self.whole_word) {
                    whole = (now.i.data.get() as i64).into();
                    part = 0.into();
                } else if word.is_some() && word == self.part_word {
                    part = now.i.data.get().into();
                }
                let right = next.whole == whole && next.part == part;
                require(right || now.i.step.get(), ["whole", "part"], || {
                    format!("not {whole:?} and {part:?}")
                })
            })
            .always("the nearest whole is within a half", |now| {
                let modulus = now.i.modulus.get() as i64;
                let part = now.q.part.get() as i64;
                let up = (now.w.nearest.get() - now.q.whole.get()).rem_euclid(1 << P);
                let doubled = 2 * (up * modulus - part);
                let right = -modulus < doubled && doubled <= modulus;
                require(right, ["nearest"], || format!("{up} above the whole"))
            })
    }

    /// A word that is not the column's, does not differ from another such.
    fn applies(&self, i: &In<Sim, P, F, D>) -> bool {
        let other = (0..32).find(|word| *word != self.whole_word && Some(*word) != self.part_word);
        let words = [Some(self.whole_word), self.part_word, other];
        let word = match i.load.get() {
            true => words.contains(&Some(i.word.get())),
            false => i.word.get() == 0 && i.data.get() == 0,
        };
        let modulus = i.modulus.get();
        word && (1..=1 << (F - 1)).contains(&modulus)
            && i.by_part.get() < modulus
            && !(i.load.get() && i.step.get())
    }

    /// The modulus comes with the parts that are below it.
    fn assumes(&self, q: &Reg<Sim, P, F>, i: &In<Sim, P, F, D>) -> bool {
        q.part.get() < i.modulus.get()
    }
}
