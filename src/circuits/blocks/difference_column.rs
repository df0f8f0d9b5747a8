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
        /// Modulus of the parts: 1 to 2^(F − 1) when `step` is high.
        pub modulus: U(c.widths.part),
        /// Adds the column below. Not allowed together with `load`.
        pub step: Bit,
        /// Whole of the column below.
        pub by_whole: I(c.widths.whole),
        /// Part of the column below; less than the modulus when `step` is high.
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

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, w, next) = (&now.i, &now.q, &now.w, &now.next.q);
        let doubled = q.part.shift_left(1);
        let down = w.nearest.equals(q.whole) & doubled.below(i.modulus);
        let up = w.nearest.equals(q.whole + 1) & !doubled.below(i.modulus);
        let mut all = self.given(i, q.part);
        all.extend([
            Property::step(
                "a step adds the number of the column below without an error",
                &["whole", "part"],
                i.step.implies(i.record.load | self.adds(i, q, next)),
            ),
            Property::step(
                "after a step, the part is below the modulus",
                &["part"],
                !i.step | i.record.load | next.part.below(i.modulus),
            ),
            Property::step(
                "the column loads its own words and no others",
                &["whole", "part"],
                i.step | self.loads(i, q, next),
            ),
            Property::always(
                "the nearest integer differs from the number by at most a half",
                &["nearest"],
                down | up,
            ),
        ]);
        all
    }
}

/// High if a word is from 1 to half of its range.
pub(crate) fn is_modulus(word: U) -> Bit {
    let half = U::new(1 << (word.width() - 1), word.width());
    !word.is_zero() & !half.below(word)
}

/// Returns the assumptions of a circuit with columns. `are_parts` is high if the parts that it adds
/// are less than the modulus, which `parts` states for steps.
pub(crate) fn given(
    step: Bit,
    load: Bit,
    modulus: U,
    (parts, are_parts): (&'static str, Bit),
) -> Vec<Property> {
    vec![
        Property::given(
            "the modulus is from 1 to half of its range when step is high",
            !step | is_modulus(modulus),
        ),
        Property::given(parts, !step | are_parts),
        Property::given("load and step are never high together", !(load & step)),
    ]
}

impl DifferenceColumn {
    /// Statements about the inputs that the circuits around a column keep.
    fn given(&self, i: &In, part: U) -> Vec<Property> {
        let below = "the part of the column below is less than the modulus when step is high";
        let below = (below, i.by_part.below(i.modulus));
        let mut all = given(i.step, i.record.load, i.modulus, below);
        all.push(Property::given(
            "the part that the column holds is less than the modulus when step is high",
            !i.step | part.below(i.modulus),
        ));
        all
    }

    /// High if the edge adds the number of the column below.
    fn adds(&self, i: &In, q: &Reg<Open>, next: &Reg<Open>) -> Bit {
        // The sum of the parts does not wrap: both are below the modulus, which is at most half of
        // the range.
        let (parts, wholes) = (q.part + i.by_part, q.whole + i.by_whole);
        let plain = next.part.equals(parts) & next.whole.equals(wholes);
        let wrapped = !parts.below(i.modulus) & next.part.equals(parts - i.modulus);
        plain | (wrapped & next.whole.equals(wholes + 1))
    }

    /// High if the edge loads a record word that is the column's own, and nothing else.
    fn loads(&self, i: &In, q: &Reg<Open>, next: &Reg<Open>) -> Bit {
        let Widths { whole, part, .. } = self.widths;
        let is = |name, number| i.record.word.equals(U::parameter(name, number, 5));
        let whole_comes = i.record.load & is("whole_word", self.whole_word);
        let part_comes = match self.part_word {
            Some(number) => i.record.load & is("part_word", number),
            None => Bit::low(),
        };
        let data = i.record.data;
        let part_word = part_comes.mux(data.resize(part), q.part);
        let is_whole = next
            .whole
            .equals(whole_comes.mux(data.resize(whole).signed(), q.whole));
        is_whole & next.part.equals(whole_comes.mux(0, part_word))
    }
}

impl Specified for DifferenceColumn {
    /// All words that are not of the column have the same effect.
    fn applies(&self, i: &In<Value>) -> bool {
        let other = (0..32).find(|word| *word != self.whole_word && Some(*word) != self.part_word);
        let words = [Some(self.whole_word), self.part_word, other];
        i.record
            .is_among(&words.map(|word| word.unwrap_or(self.whole_word)))
    }
}
