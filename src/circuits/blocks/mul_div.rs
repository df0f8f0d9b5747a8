//! Sequential multiplier-divider: `(multiplicand · multiplier + addend) / divisor` with remainder,
//! one bit per tick.
//!
//! ```text
//!                                       ┌─────────┐
//!  start, product_only ────────────────▶│         ├──▶ busy, done
//!  multiplicand, multiplier, addend ───▶│ mul_div ├──▶ quotient
//!  divisor ────────────────────────────▶│         ├──▶ remainder
//!                                       └─────────┘
//! ```
//!
//! The product starts from the addend and takes the multiplier's bits from the lowest up. The
//! division is restoring and takes the dividend's bits from the highest down. Dividend and quotient
//! share a register.

use crate::prelude::*;

/// Names of the states.
const STATES: &[&str] = &["idle", "multiply", "divide"];
const IDLE: u64 = 0;
pub(crate) const MULTIPLY: u64 = 1;
pub(crate) const DIVIDE: u64 = 2;

/// Multiplier-divider of words of Q = `word` bits by a multiplier of M = `multiplier` bits.
///
/// `done` is high M + Q + 1 ticks after `start`, M + 1 with `product_only`.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MulDiv {
    /// M: width of the multiplier in bits.
    pub multiplier: usize,
    /// Q: width of all other words.
    pub word: usize,
}

impl MulDiv {
    /// Ticks from `start` to `done`.
    pub const fn latency(&self) -> u64 {
        self.product_latency() + self.word as u64
    }

    /// Ticks from `start` to `done` with `product_only`.
    pub const fn product_latency(&self) -> u64 {
        self.multiplier as u64 + 1
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
    /// Flip-flops.
    pub struct Reg {
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
        /// Product so far; in the division, dividend bits above and quotient bits below; at the end
        /// the result.
        pub quotient: U(c.word) = 0,
        /// Remainder of the division.
        pub remainder: U(c.word) = 0,
        /// High for one tick: `quotient` and `remainder` are valid from this tick until the next
        /// start.
        pub done: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// A calculation is running; a start is ignored.
        pub busy: Bit,
        /// A start is accepted.
        take: Bit,
        /// Remainder with the next dividend bit appended.
        partial: U(c.word),
        /// `partial` is at least the divisor: the quotient bit is 1.
        fits: Bit,
        /// Last tick of the running state.
        last: Bit,
        /// The result is complete at the end of this tick.
        complete: Bit,
    }
}

impl Circuit for MulDiv {
    const NAME: &'static str = "mul_div";
    const ABOUT: &'static str = "multiplies, adds and divides with remainder, one bit per tick";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let (multiplies, divides) = (q.state.bit(0), q.state.bit(1));
        let busy = multiplies | divides;
        let take = i.start & !busy;
        let highest = q.quotient.bit(self.word - 1).word();
        let partial = q.remainder.shift_left(1) | highest.resize(self.word);
        let fits = !partial.below(q.by);
        let end = |bits: usize| U::new(bits as u64 - 1, 6);
        let end = divides.mux(end(self.word), end(self.multiplier));
        let last = q.count.equals(end);
        let complete = last & (divides | (multiplies & q.undivided));

        let state = |state| U::new(state, 2);
        let after = (multiplies & !q.undivided).mux(state(DIVIDE), state(IDLE));
        let after = (busy & last).mux(after, q.state);
        let sum = q.quotient + q.factor.bit(0).mux(q.shifted, 0);
        let divided = q.quotient.shift_left(1) | fits.word().resize(self.word);
        let quotient = divides.mux(divided, multiplies.mux(sum, q.quotient));
        let remainder = divides.mux(fits.mux(partial - q.by, partial), q.remainder);
        let shifted = multiplies.mux(q.shifted.shift_left(1), q.shifted);
        let factor = multiplies.mux(q.factor.shift_right(1), q.factor);
        let net = Net {
            busy,
            take,
            partial,
            fits,
            last,
            complete,
        };
        let next = Reg {
            state: take.mux(MULTIPLY, after),
            count: (take | last).mux(0, busy.mux(q.count + 1, q.count)),
            undivided: take.mux(i.product_only, q.undivided),
            shifted: take.mux(i.multiplicand, shifted),
            factor: take.mux(i.multiplier, factor),
            by: take.mux(i.divisor, q.by),
            quotient: take.mux(i.addend, quotient),
            remainder: take.mux(0, remainder),
            done: complete,
        };
        (net, next)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, next) = (&now.i, &now.q, &now.next.q);
        let [idle, multiplies, divides] =
            [IDLE, MULTIPLY, DIVIDE].map(|state| q.state.equals(state));
        let restarts = next.state.equals(MULTIPLY) & next.count.is_zero();
        let counted = next.count.equals(q.count + 1) & !next.count.is_zero();
        let goes_on = next.state.equals(q.state) & counted;
        let end = |bits: usize| q.count.equals(bits as u64 - 1);
        let over = multiplies.mux(end(self.multiplier), end(self.word));
        let mut all = vec![
            Property::given(
                "the divisor is below half of the range when start is high",
                i.start.implies(!i.divisor.bit(self.word - 1)),
            ),
            Property::given(
                "the product plus the addend fits a word when start is high",
                i.start.implies(self.fits(i)),
            ),
            Property::step(
                "a start in idle begins an operation",
                &["state", "quotient"],
                (i.start & idle).implies(restarts & next.quotient.equals(i.addend)),
            ),
            Property::step(
                "a multiplication takes a tick per multiplier bit, a division a tick per word bit",
                &["state", "count"],
                idle | (over ^ goes_on),
            ),
            Property::step(
                "done is high only in the tick after the last bit",
                &["done"],
                next.done.equals(!idle & next.state.equals(IDLE)),
            ),
            Property::always(
                "the remainder stays below the divisor",
                &["remainder", "by"],
                q.by.is_zero() | q.remainder.below(q.by),
            ),
            Property::step(
                "the bits divided so far equal quotient times divisor plus remainder",
                &["quotient", "remainder"],
                divides.implies(q.by.is_zero() | self.divides(q, next)),
            ),
        ];
        all.extend(self.helpers(q));
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

    /// High if the edge appends the next dividend bit to the remainder, and the bit of its division
    /// to the quotient.
    fn divides(&self, q: &Reg<Open>, next: &Reg<Open>) -> Bit {
        // A word of 64 bits needs no further bit, as the divisor is below half of its range.
        let wide = |word: U| word.resize((self.word + 1).min(64));
        let highest = q.quotient.bit(self.word - 1).word();
        let partial = wide(q.remainder).shift_left(1) | wide(highest);
        let taken = next.quotient.bit(0).mux(wide(q.by), 0);
        let divided = partial.equals(wide(next.remainder) + taken);
        let shifted = (q.quotient.shift_left(1) ^ next.quotient).shift_right(1);
        divided & shifted.is_zero() & next.by.equals(q.by)
    }

    /// Statements about the state that the proofs of the others need.
    fn helpers(&self, q: &Reg<Open>) -> [Property; 3] {
        let end = |bits: usize| U::new(bits as u64 - 1, 6);
        let in_multiply = !q.state.equals(MULTIPLY) | !end(self.multiplier).below(q.count);
        let in_divide = !q.state.equals(DIVIDE) | !end(self.word).below(q.count);
        [
            Property::helper(
                "the state is idle, multiply or divide",
                &["state"],
                !U::new(DIVIDE, 2).below(q.state),
            ),
            Property::helper(
                "the count is below the number of bits that the state takes",
                &["count", "state"],
                in_multiply & in_divide,
            ),
            Property::helper(
                "the divisor of the running calculation is below half of the range",
                &["by"],
                !q.by.bit(self.word - 1),
            ),
        ]
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
