//! Column of a difference engine: a number as whole and part, and the adder for the column below.
//!
//! ```text
//!                       ┌───────────────────┐
//!  load, word, data ───▶│                   ├──▶ whole, part
//!  modulus, step ──────▶│ difference_column │
//!  by_whole, by_part ──▶│                   ├──▶ nearest
//!                       └───────────────────┘
//! ```
//!
//! The number is `whole + part / modulus` with `0 <= part < modulus`. So a quotient is exact for
//! every modulus and needs no divider: the part wraps at the modulus and carries into the whole.
//! The whole wraps at its width. Because sums are linear, the result is right whenever the number
//! itself fits, even if the columns below have wrapped.

use super::record_memory::RecordWord;
use crate::hdl::Registers;
use crate::prelude::*;

/// Widths of a column and of the records it is loaded from, in bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Widths {
    /// A whole.
    pub whole: usize,
    /// F: a part, and the modulus.
    pub part: usize,
    /// A word of a record, which holds a whole or a part.
    pub data: usize,
}

impl Default for Widths {
    fn default() -> Self {
        Widths {
            whole: 40,
            part: 41,
            data: 42,
        }
    }
}

/// Column of a number.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DifferenceColumn {
    /// Widths of the number and of the records.
    pub widths: Widths,
    /// Number of the record word that holds the whole. Loading the whole clears the part.
    pub whole_word: u64,
    /// Number of the record word that holds the part, sent after the whole; `None` if the part is
    /// always 0.
    pub part_word: Option<u64>,
}

signals! { for DifferenceColumn as c;
    /// Input ports.
    pub struct In {
        /// Word of a record.
        pub record: RecordWord(&c.widths.data) as Flat,
        /// Modulus of the parts: 1 to 2^(F − 1).
        pub modulus: U(c.widths.part),
        /// Adds the column below. Not allowed together with `load`.
        pub step: Bit,
        /// Whole of the column below.
        pub by_whole: I(c.widths.whole),
        /// Part of the column below; less than the modulus.
        pub by_part: U(c.widths.part),
    }
    /// Flip-flops.
    pub struct Reg {
        /// Whole of the number: the number rounded down.
        pub whole: I(c.widths.whole) as Analog = 0,
        /// Fraction above the whole, in units of 1/modulus.
        pub part: U(c.widths.part) = 0,
    }
    /// Nets.
    pub struct Net {
        /// Sum of the parts; below 2^F, since both are below the modulus.
        sum: U(c.widths.part),
        /// The sum of the parts carries into the whole.
        carry: Bit,
        /// The record word is the whole of this column.
        load_whole: Bit,
        /// The record word is the part of this column.
        load_part: Bit,
        /// Number, rounded to the nearest integer; halves round up.
        pub nearest: I(c.widths.whole) as Analog,
    }
}

impl Circuit for DifferenceColumn {
    const NAME: &'static str = "difference_column";
    const ABOUT: &'static str = "a number as whole and part, and the adder for the column below";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        let Widths { whole, part, data } = self.widths;
        (data < whole.max(part)).then(|| "a word of a record holds whole and part".into())
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let sum = q.part + i.by_part;
        let carry = !sum.below(i.modulus);
        let load_whole = i.record.is("whole_word", self.whole_word);
        let load_part = match self.part_word {
            Some(word) => i.record.is("part_word", word),
            None => Bit::low(),
        };
        let up = !q.part.shift_left(1).below(i.modulus);
        let moved = q.whole + i.by_whole;
        let whole = carry.mux(moved + 1, moved);
        let part = carry.mux(sum - i.modulus, sum);
        let loaded_whole = i.record.data.resize(self.widths.whole).signed();
        let loaded_part = i.record.data.resize(self.widths.part);
        let stepped_part = load_part.mux(loaded_part, i.step.mux(part, q.part));
        let net = Net {
            sum,
            carry,
            load_whole,
            load_part,
            nearest: up.mux(q.whole + 1, q.whole),
        };
        let next = Reg {
            whole: load_whole.mux(loaded_whole, i.step.mux(whole, q.whole)),
            part: load_whole.mux(0, stepped_part),
        };
        (net, next)
    }
}

impl Specified for DifferenceColumn {
    fn invariants(&self) -> Invariants<'_, Self> {
        let Widths { whole, part, .. } = self.widths;
        Invariants::<Self>::new()
            .step(
                "a step adds the number of the column below without an error",
                move |now, next| {
                    let modulus = now.i.modulus as i64;
                    let number = |whole: i64, part: u64| whole * modulus + part as i64;
                    let sum =
                        number(now.q.whole, now.q.part) + number(now.i.by_whole, now.i.by_part);
                    let after = number(next.q.whole, next.q.part);
                    let right = (after - sum).rem_euclid(modulus << whole) == 0;
                    let steps = now.i.step && !now.i.record.load;
                    require(right || !steps, ["whole", "part"], || {
                        format!("{after} / {modulus}, not {sum} / {modulus}")
                    })
                },
            )
            .step("the part stays below the modulus", |now, next| {
                let right = next.q.part < now.i.modulus;
                require(right || now.w.load_part, ["part"], || "too large".into())
            })
            .step(
                "the column loads its own words and no others",
                move |now, next| {
                    let record = &now.i.record;
                    let word = record.load.then_some(record.word);
                    let (mut expected, mut parts) = (now.q.whole, now.q.part);
                    if word == Some(self.whole_word) {
                        (expected, parts) = (record.data as i64, 0);
                    } else if word.is_some() && word == self.part_word {
                        parts = record.data;
                    }
                    let right = (next.q.whole - expected).rem_euclid(1 << whole) == 0
                        && next.q.part == parts % (1 << part);
                    require(right || now.i.step, ["whole", "part"], || {
                        format!("not {expected} and {parts}")
                    })
                },
            )
            .always(
                "the nearest integer differs from the number by at most a half",
                move |now| {
                    let modulus = now.i.modulus as i64;
                    let part = now.q.part as i64;
                    let up = (now.w.nearest - now.q.whole).rem_euclid(1 << whole);
                    let doubled = 2 * (up * modulus - part);
                    let right = -modulus < doubled && doubled <= modulus;
                    require(right, ["nearest"], || format!("{up} above the whole"))
                },
            )
    }

    /// A word that is not the column's, does not differ from another such.
    fn applies(&self, i: &In<Value>) -> bool {
        let other = (0..32).find(|word| *word != self.whole_word && Some(*word) != self.part_word);
        let words = [Some(self.whole_word), self.part_word, other];
        i.record
            .is_among(&words.map(|word| word.unwrap_or(self.whole_word)))
            && (1..=1 << (self.widths.part - 1)).contains(&i.modulus)
            && i.by_part < i.modulus
            && !(i.record.load && i.step)
    }

    /// The modulus comes with the parts that are below it.
    fn assumes(&self, now: &Registers<Self>, i: &In<Value>) -> bool {
        now.q.part < i.modulus
    }
}
