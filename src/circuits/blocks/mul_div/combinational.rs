//! Combinational architecture: a multiplier, and a stage of restoring division for each bit.
//!
//! Only the results are registered. They stay until the next start, as those of the other
//! architectures do, so `done` comes one tick after `start`.

use super::restoring::Divided;
use super::{Array, In, MulDiv, Net, Reg};
use crate::prelude::*;

impl MulDiv {
    /// Returns a tick of the combinational architecture.
    pub(super) fn array(&self, i: &In, q: &Reg) -> (Net, Reg<Edge>) {
        let multiplier = i.multiplier.resize(self.word);
        let sum = i.multiplicand.times(multiplier, self.word) + i.addend;
        let mut divided = Divided {
            remainder: U::new(0, self.word),
            quotient: sum,
        };
        let (mut rest, mut bits) = (Vec::new(), Vec::new());
        for _ in 0..self.word {
            divided = divided.stage(i.divisor).after;
            rest.push(divided.remainder);
            bits.push(divided.quotient);
        }
        let quotient = i.product_only.mux(sum, divided.quotient);
        let remainder = i.product_only.mux(0, divided.remainder);
        let net = Net {
            busy: Bit::low(),
            step: None,
            array: Some(Array { sum, rest, bits }),
        };
        let next = Reg {
            sequence: None,
            quotient: i.start.mux(quotient, q.quotient),
            remainder: i.start.mux(remainder, q.remainder),
            done: i.start,
        };
        (net, next)
    }

    /// Returns the properties of the combinational architecture.
    pub(super) fn array_properties(&self, now: &Moment<Self>) -> Option<Vec<Property>> {
        let (i, q, next) = (&now.i, &now.q, &now.next.q);
        let Array { sum, rest, bits } = now.w.array.as_ref()?;
        let stages = rest.iter().zip(bits);
        let stages = stages.map(|(&remainder, &quotient)| Divided {
            remainder,
            quotient,
        });
        let zero = U::new(0, self.word);
        let before = Divided {
            remainder: zero,
            quotient: *sum,
        };
        let stages: Vec<_> = std::iter::once(before).chain(stages).collect();
        let last = stages.last()?;

        let kept = next.quotient.equals(q.quotient) & next.remainder.equals(q.remainder);
        let undivided = next.quotient.equals(*sum) & next.remainder.is_zero();
        let divided = next.quotient.equals(last.quotient) & next.remainder.equals(last.remainder);
        let multiples = (0..self.multiplier).map(|bit| {
            let multiple = i.multiplicand.shift_left(bit);
            i.multiplier.bit(bit).mux(multiple, 0)
        });
        // Each partial sum is used once: the printed assertion grows with the multiplier, not with
        // two to its power.
        let added = multiples.fold(zero, |sum, multiple| sum + multiple) + i.addend;
        let below = rest.iter().map(|rest| rest.below(i.divisor));
        let becomes = stages
            .windows(2)
            .map(|pair| pair[0].becomes(pair[1], i.divisor));
        let product = last.quotient.times(i.divisor, self.word);
        let divides = !i.divisor.is_zero() & !i.divisor.bit(self.word - 1);
        Some(vec![
            Property::step(
                "done is high in the tick after start, and only there",
                &["done"],
                next.done.equals(i.start),
            ),
            Property::step(
                "the results change only with a start",
                &["quotient", "remainder"],
                i.start | kept,
            ),
            Property::step(
                "the results of a start are the sum, or its quotient and remainder",
                &["quotient", "remainder"],
                i.start.implies(i.product_only.mux(undivided, divided)),
            ),
            Property::always(
                "the sum is product plus addend",
                &["sum"],
                sum.equals(added),
            ),
            Property::always(
                "the remainder of each stage is below the divisor",
                &["sum", "divisor"],
                divides.implies(Bit::all(below)),
            ),
            Property::always(
                "the bit divided by each stage equals quotient times divisor plus remainder",
                &["sum", "divisor"],
                divides.implies(Bit::all(becomes)),
            ),
            Property::always(
                "quotient times divisor plus remainder equals the sum",
                &["sum", "divisor"],
                divides.implies((product + last.remainder).equals(*sum)),
            ),
        ])
    }
}
