//! Shifter: divides a word by a power of two that is an input, rounded down.
//!
//! ```text
//!         ┌─────────┐
//!  word ─▶│ shifter ├──▶ shifted
//!  by ───▶│         │
//!         └─────────┘
//! ```

use crate::prelude::*;

/// Shifter for signed words.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Shifter {
    /// Width of a word in bits.
    pub width: usize,
}

signals! { for Shifter as c;
    /// Input ports.
    pub struct In {
        /// Word to shift.
        pub word: I(c.width),
        /// Shift distance in bits.
        pub by: U(6),
    }
    /// Nets.
    pub struct Net {
        /// `word` shifted by bit 0 of `by`.
        by_1: I(c.width),
        /// `word` shifted by bits 1 to 0 of `by`.
        by_3: I(c.width),
        /// `word` shifted by bits 2 to 0 of `by`.
        by_7: I(c.width),
        /// `word` shifted by bits 3 to 0 of `by`.
        by_15: I(c.width),
        /// `word` shifted by bits 4 to 0 of `by`.
        by_31: I(c.width),
        /// `word` shifted right by `by`: divided by 2^by, rounded down.
        pub shifted: I(c.width),
    }
}

impl Circuit for Shifter {
    const NAME: &'static str = "shifter";
    const ABOUT: &'static str = "divides a word by a power of two, rounded down";
    records!(In, Nothing, Net);

    fn tick(&self, i: In, _: Nothing, _: Nothing) -> (Net, Nothing) {
        let stage = |word: I, bit: usize| i.by.bit(bit).mux(word.shift_right(1 << bit), word);
        let by_1 = stage(i.word, 0);
        let by_3 = stage(by_1, 1);
        let by_7 = stage(by_3, 2);
        let by_15 = stage(by_7, 3);
        let by_31 = stage(by_15, 4);
        let shifted = stage(by_31, 5);
        (
            Net {
                by_1,
                by_3,
                by_7,
                by_15,
                by_31,
                shifted,
            },
            Nothing,
        )
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, w) = (&now.i, &now.w);
        // One case for each distance; a shift by a constant is the division.
        let case = |by: usize| {
            let shifted = w.shifted.equals(i.word.shift_right(by));
            i.by.equals(by as u64).implies(shifted)
        };
        vec![Property::always(
            "the result is the word divided by 2^by, rounded down",
            &["shifted"],
            Bit::all((0..64).map(case)),
        )]
    }
}

impl Specified for Shifter {}
