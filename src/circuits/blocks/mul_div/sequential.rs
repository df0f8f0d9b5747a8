//! Sequential architectures: one or two bits per tick.
//!
//! The product starts from the addend and takes the multiplier's bits from the lowest up. The
//! division is restoring and takes the dividend's bits from the highest down. Dividend and quotient
//! share a register. Two bits per tick are two such steps in a row; of an odd number of dividend bits
//! the last one is divided alone.

use super::restoring::Divided;
use super::{DIVIDE, IDLE, In, MULTIPLY, MulDiv, Net, Reg, Sequence, Step};
use crate::prelude::*;

impl MulDiv {
    /// Returns a tick of a sequential architecture.
    pub(super) fn step(&self, i: &In, q: &Reg, running: &Sequence) -> (Net, Reg<Edge>) {
        let &Sequence {
            state,
            count,
            undivided,
            shifted,
            factor,
            by,
        } = running;
        let (multiplies, divides) = (state.bit(0), state.bit(1));
        let busy = multiplies | divides;
        let take = i.start & !busy;
        let before = Divided {
            remainder: q.remainder,
            quotient: q.quotient,
        };
        let first = before.stage(by);
        let end = |bits: usize| U::new(self.ticks(bits) - 1, 6);
        let end = divides.mux(end(self.word), end(self.multiplier));
        let last = count.equals(end);
        let complete = last & (divides | (multiplies & undivided));

        let second = (self.bits(self.word) > 1).then(|| first.after.stage(by));
        let divided = match second {
            None => first.after,
            Some(second) if self.word.is_multiple_of(2) => second.after,
            Some(second) => Divided {
                remainder: last.mux(first.after.remainder, second.after.remainder),
                quotient: last.mux(first.after.quotient, second.after.quotient),
            },
        };
        let added = q.quotient + factor.bit(0).mux(shifted, 0);
        let both_added = (self.bits(self.multiplier) > 1)
            .then(|| added + factor.bit(1).mux(shifted.shift_left(1), 0));
        let sum = both_added.unwrap_or(added);

        let named = |state| U::new(state, 2);
        let after = (multiplies & !undivided).mux(named(DIVIDE), named(IDLE));
        let after = (busy & last).mux(after, state);
        let quotient = divides.mux(divided.quotient, multiplies.mux(sum, q.quotient));
        let remainder = divides.mux(divided.remainder, q.remainder);
        let bits = self.bits(self.multiplier);
        let next_shifted = multiplies.mux(shifted.shift_left(bits), shifted);
        let next_factor = multiplies.mux(factor.shift_right(bits), factor);
        let net = Net {
            busy,
            step: Some(Step {
                take,
                partial: first.partial,
                fits: first.fits,
                second_partial: second.map(|second| second.partial),
                second_fits: second.map(|second| second.fits),
                added: both_added.map(|_| added),
                both_added,
                last,
                complete,
            }),
            array: None,
        };
        let next = Reg {
            sequence: Some(Sequence {
                state: take.mux(MULTIPLY, after),
                count: (take | last).mux(0, busy.mux(count + 1, count)),
                undivided: take.mux(i.product_only, undivided),
                shifted: take.mux(i.multiplicand, next_shifted),
                factor: take.mux(i.multiplier, next_factor),
                by: take.mux(i.divisor, by),
            }),
            quotient: take.mux(i.addend, quotient),
            remainder: take.mux(0, remainder),
            done: complete,
        };
        (net, next)
    }

    /// Bits per tick of a multiplier or a word that is `width` bits wide.
    pub(super) fn bits(&self, width: usize) -> usize {
        if self.is_radix4() { width.min(2) } else { 1 }
    }

    /// Returns the properties of a sequential architecture.
    pub(super) fn step_properties(&self, now: &Moment<Self>) -> Option<Vec<Property>> {
        let (i, q, next) = (&now.i, &now.q, &now.next.q);
        let (running, then) = (q.sequence.as_ref()?, next.sequence.as_ref()?);
        let [idle, multiplies, divides] =
            [IDLE, MULTIPLY, DIVIDE].map(|state| running.state.equals(state));
        let restarts = then.state.equals(MULTIPLY) & then.count.is_zero();
        let counted = then.count.equals(running.count + 1) & !then.count.is_zero();
        let goes_on = then.state.equals(running.state) & counted;
        let end = |bits: usize| running.count.equals(self.ticks(bits) - 1);
        let over = multiplies.mux(end(self.multiplier), end(self.word));
        let length = match self.is_radix4() {
            false => {
                "a multiplication takes a tick per multiplier bit, a division a tick per word bit"
            }
            true => "two multiplier bits take a tick, and two dividend bits",
        };
        let mut all = vec![
            Property::step(
                "a start in idle begins an operation",
                &["state", "quotient"],
                (i.start & idle).implies(restarts & next.quotient.equals(i.addend)),
            ),
            Property::step(length, &["state", "count"], idle | (over ^ goes_on)),
            Property::step(
                "done is high only in the tick after the last bit",
                &["done"],
                next.done.equals(!idle & then.state.equals(IDLE)),
            ),
            Property::always(
                "the remainder stays below the divisor",
                &["remainder", "by"],
                running.by.is_zero() | q.remainder.below(running.by),
            ),
            Property::step(
                "the bits divided so far equal quotient times divisor plus remainder",
                &["quotient", "remainder"],
                divides.implies(
                    running.by.is_zero()
                        | (self.divided(now, running)? & then.by.equals(running.by)),
                ),
            ),
        ];
        if self.is_radix4() {
            all.push(Property::step(
                "each tick of a multiplication adds the multiples of its two multiplier bits",
                &["quotient", "shifted", "factor"],
                multiplies.implies(self.multiplied(now, running, then)),
            ));
        }
        all.extend(self.helpers(running));
        Some(all)
    }

    /// High if the edge adds the first factor times the next multiplier bits, and moves on to the bits
    /// after them.
    fn multiplied(
        &self,
        now: &Moment<Self>,
        running: &Sequence<Open>,
        then: &Sequence<Open>,
    ) -> Bit {
        let bits = self.bits(self.multiplier);
        let digit = running.factor.slice(0, bits).resize(self.word);
        let added = running.shifted.times(digit, self.word);
        now.next.q.quotient.equals(now.q.quotient + added)
            & then.shifted.equals(running.shifted.shift_left(bits))
            & then.factor.equals(running.factor.shift_right(bits))
    }

    /// High if the edge appends the next dividend bits to the remainder, and the bits of their
    /// division to the quotient.
    fn divided(&self, now: &Moment<Self>, running: &Sequence<Open>) -> Option<Bit> {
        let of = |q: &Reg<Open>| Divided {
            remainder: q.remainder,
            quotient: q.quotient,
        };
        let (before, after, by) = (of(&now.q), of(&now.next.q), running.by);
        let one = before.becomes(after, by);
        let Some(partial) = now.w.step.as_ref()?.second_partial else {
            return Some(one);
        };
        let bit = partial.slice(0, 1).resize(self.word);
        let between = Divided {
            remainder: partial.shift_right(1),
            quotient: bit.shift_left(self.word - 1) | after.quotient.shift_right(1),
        };
        let two = before.becomes(between, by) & between.becomes(after, by);
        let last = running.count.equals(self.ticks(self.word) - 1);
        Some(match self.word % 2 {
            0 => two,
            _ => last.mux(one, two),
        })
    }

    /// Statements about the state that the proofs of the others need.
    fn helpers(&self, running: &Sequence<Open>) -> [Property; 3] {
        let Sequence { state, count, .. } = running;
        let end = |bits: usize| U::new(self.ticks(bits) - 1, 6);
        let in_multiply = !state.equals(MULTIPLY) | !end(self.multiplier).below(*count);
        let in_divide = !state.equals(DIVIDE) | !end(self.word).below(*count);
        [
            Property::helper(
                "the state is idle, multiply or divide",
                &["state"],
                !U::new(DIVIDE, 2).below(*state),
            ),
            Property::helper(
                match self.is_radix4() {
                    false => "the count is below the number of bits that the state takes",
                    true => "the count is below the number of ticks that the state takes",
                },
                &["count", "state"],
                in_multiply & in_divide,
            ),
            Property::helper(
                "the divisor of the running calculation is below half of the range",
                &["by"],
                !running.by.bit(self.word - 1),
            ),
        ]
    }
}
