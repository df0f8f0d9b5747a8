//! Multiplier-divider: `(multiplicand · multiplier + addend) / divisor` with remainder.
//!
//! ```text
//!                                       ┌─────────┐
//!  start, product_only ────────────────▶│         ├──▶ busy, done
//!  multiplicand, multiplier, addend ───▶│ mul_div ├──▶ quotient
//!  divisor ────────────────────────────▶│         ├──▶ remainder
//!                                       └─────────┘
//! ```
//!
//! [`Architecture`] selects how many bits are computed per tick: one, two or all of them. Ports and
//! results are the same.

mod combinational;
mod restoring;
mod sequential;
#[cfg(test)]
mod tests;

use crate::prelude::*;
use serde::{Deserialize, Serialize};

/// Names of the states.
const STATES: &[&str] = &["idle", "multiply", "divide"];
const IDLE: u64 = 0;
pub(crate) const MULTIPLY: u64 = 1;
pub(crate) const DIVIDE: u64 = 2;

/// Number of bits of a product or a quotient that are computed per tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Architecture {
    /// Sequential, one bit per tick.
    #[default]
    Radix2,
    /// Sequential, two bits per tick.
    Radix4,
    /// All bits in one tick, by a multiplier and an array of restoring stages.
    Combinational,
}

/// Multiplier-divider of words of Q = `word` bits by a multiplier of M = `multiplier` bits.
///
/// `done` is high [`latency`](Self::latency) ticks after `start`, or
/// [`product_latency`](Self::product_latency) with `product_only`.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MulDiv {
    /// M: width of the multiplier in bits.
    pub multiplier: usize,
    /// Q: width of all other words.
    pub word: usize,
    /// Bits that are computed per tick.
    pub architecture: Architecture,
}

impl MulDiv {
    /// Creates a multiplier-divider of one bit per tick.
    pub const fn new(multiplier: usize, word: usize) -> Self {
        MulDiv {
            multiplier,
            word,
            architecture: Architecture::Radix2,
        }
    }

    /// Ticks from `start` to `done`: M + Q + 1 for [`Radix2`](Architecture::Radix2), ⌈M/2⌉ + ⌈Q/2⌉ + 1
    /// for [`Radix4`](Architecture::Radix4), 1 for [`Combinational`](Architecture::Combinational).
    pub const fn latency(&self) -> u64 {
        self.product_latency() + self.ticks(self.word)
    }

    /// Ticks from `start` to `done` with `product_only`: without those for Q.
    pub const fn product_latency(&self) -> u64 {
        self.ticks(self.multiplier) + 1
    }

    /// Ticks between `start` and `done` in which that many bits are computed.
    const fn ticks(&self, bits: usize) -> u64 {
        match self.architecture {
            Architecture::Radix2 => bits as u64,
            Architecture::Radix4 => bits.div_ceil(2) as u64,
            Architecture::Combinational => 0,
        }
    }

    fn is_combinational(&self) -> bool {
        self.architecture == Architecture::Combinational
    }

    fn is_sequential(&self) -> bool {
        !self.is_combinational()
    }

    fn is_radix4(&self) -> bool {
        self.architecture == Architecture::Radix4
    }
}

signals! { for MulDiv as c;
    /// Input ports. Values given with `start` are taken in that tick and need not be held.
    pub struct In {
        /// Starts a calculation; ignored while `busy`.
        pub start: Bit,
        /// Skips the division: `quotient` is then the product plus the addend.
        pub product_only: Bit,
        /// First factor.
        pub multiplicand: U(c.word),
        /// Second factor.
        pub multiplier: U(c.multiplier),
        /// Addend of the product. Product plus addend must be below 2^Q.
        pub addend: U(c.word),
        /// Divisor of the sum; below 2^(Q − 1). A divisor of 0 gives a quotient of all ones.
        pub divisor: U(c.word),
    }
    /// Flip-flops of a sequential architecture: the running calculation.
    pub struct Sequence {
        /// State of the sequence.
        pub(crate) state: U(2) as States(STATES) = 0,
        /// Ticks since the state began.
        pub(crate) count: U(6) = 0,
        /// `product_only` of the running calculation.
        pub(crate) undivided: Bit = 0,
        /// First factor times the weight of the next multiplier bit.
        pub(crate) shifted: U(c.word) = 0,
        /// Remaining bits of the multiplier.
        pub(crate) factor: U(c.multiplier) = 0,
        /// Divisor of the running calculation.
        pub(crate) by: U(c.word) = 0,
    }
    /// Flip-flops.
    pub struct Reg {
        /// The running calculation.
        pub(crate) sequence: Sequence(c) as Flat if c.is_sequential(),
        /// Product so far; in the division, dividend bits above and quotient bits below; at the end
        /// the result.
        pub quotient: U(c.word) = 0,
        /// Remainder of the division.
        pub remainder: U(c.word) = 0,
        /// High if a result is new: `quotient` and `remainder` are valid from this tick until the next
        /// start.
        pub done: Bit = 0,
    }
    /// Nets of a sequential architecture.
    pub struct Step {
        /// A start is accepted.
        take: Bit,
        /// Remainder with the next dividend bit appended.
        partial: U(c.word),
        /// `partial` is at least the divisor: the quotient bit is 1.
        fits: Bit,
        /// Remainder after this bit, with the second dividend bit of the tick appended.
        second_partial: U(c.word) if (c.bits(c.word) > 1),
        /// `second_partial` is at least the divisor: the second quotient bit is 1.
        second_fits: Bit if (c.bits(c.word) > 1),
        /// Product so far with the multiple of the next multiplier bit added.
        added: U(c.word) if (c.bits(c.multiplier) > 1),
        /// `added` with the multiple of the second multiplier bit of the tick added.
        both_added: U(c.word) if (c.bits(c.multiplier) > 1),
        /// Last tick of the running state.
        last: Bit,
        /// The result is complete at the end of this tick.
        complete: Bit,
    }
    /// Nets of the combinational architecture.
    pub struct Array {
        /// Product plus addend: the dividend.
        sum: U(c.word),
        /// Remainder after a stage of the division.
        rest: [U(c.word); c.word],
        /// Remaining dividend bits above and quotient bits below, after a stage.
        bits: [U(c.word); c.word],
    }
    /// Nets.
    pub struct Net {
        /// A calculation is running; a start is ignored.
        pub busy: Bit,
        /// Step of a sequential architecture.
        step: Step(c) as Flat if c.is_sequential(),
        /// Multiplier and divider array.
        array: Array(c) as Flat if c.is_combinational(),
    }
}

impl Circuit for MulDiv {
    const NAME: &'static str = "mul_div";
    const ABOUT: &'static str =
        "multiplies, adds and divides with remainder, one, two or all bits per tick";
    records!(In, Reg, Net);

    fn about(&self) -> &'static str {
        match self.architecture {
            Architecture::Radix2 => Self::ABOUT,
            Architecture::Radix4 => {
                "multiplies, adds and divides with remainder, two bits per tick"
            }
            Architecture::Combinational => {
                "multiplies, adds and divides with remainder, in one tick"
            }
        }
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        match &q.sequence {
            Some(running) => self.step(&i, &q, running),
            None => self.array(&i, &q),
        }
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let i = &now.i;
        let mut all = vec![
            Property::given(
                "the divisor is below half of the range when start is high",
                i.start.implies(!i.divisor.bit(self.word - 1)),
            ),
            Property::given(
                "the product plus the addend fits a word when start is high",
                i.start.implies(self.fits(i)),
            ),
        ];
        all.extend(self.step_properties(now).unwrap_or_default());
        all.extend(self.array_properties(now).unwrap_or_default());
        all
    }
}

impl MulDiv {
    /// High if the product plus the addend is below 2^Q.
    fn fits(&self, i: &In) -> Bit {
        let zero = U::new(0, self.word);
        // The order does not matter for the sum. But a proof sees at once that there is no carry
        // where an addend is short, or a product.
        let (_, addend_first) = self.sum(i, i.addend);
        let (product, fits) = self.sum(i, zero);
        addend_first | (fits & !self.carry(product, i.addend))
    }

    /// Returns the product plus a word, and high if this is below 2^Q.
    fn sum(&self, i: &In, mut sum: U) -> (U, Bit) {
        // The first factor times 2^k, and high while it has lost no bit.
        let (mut term, mut whole) = (i.multiplicand, Bit::high());
        let mut fits = Bit::high();
        for k in 0..self.multiplier {
            let is_added = i.multiplier.bit(k);
            fits = fits & ((whole & !self.carry(sum, term)) | !is_added);
            sum = is_added.mux(sum + term, sum);
            whole = whole & !term.bit(self.word - 1);
            term = term.shift_left(1);
        }
        (sum, fits)
    }

    /// High if a sum of two words has a carry: a word of 64 bits has no room for it.
    fn carry(&self, a: U, b: U) -> Bit {
        let [x, y, sum] = [a, b, a + b].map(|word| word.bit(self.word - 1));
        (x & y) | ((x | y) & !sum)
    }
}

impl Specified for MulDiv {
    /// Without `start` the other ports are not looked at.
    fn applies(&self, i: &In<Value>) -> bool {
        let words = [i.multiplicand, i.multiplier, i.addend, i.divisor];
        let given = words.iter().any(|&word| word > 0) || i.product_only;
        i.start || !given
    }
}
