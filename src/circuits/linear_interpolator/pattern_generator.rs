//! Position pattern generator 14 (¶0010): acceleration time, deceleration time and steady speed in,
//! a position x(n) each scan out.
//!
//! ```text
//!                          ┌───────────────────┐
//!  start, from, distance ─▶│                   ├──▶ position
//!  speed, …time ──────────▶│ pattern generator ├──▶ valid
//!  advance ───────────────▶│        14         ├──▶ ready
//!  abort ─────────────────▶│                   ├──▶ active
//!                          └───────────────────┘
//! ```
//!
//! Departures: see [`trapezoid`].

pub use super::trapezoid::Cycle as In;
use super::trapezoid::{PEAK, SCAN, TOTAL, WAITING};
use super::{Trapezoid, trapezoid};
use crate::circuits::blocks::mul_div::{DIVIDE, MULTIPLY};
use crate::circuits::blocks::{MulDiv, mul_div};
use crate::prelude::*;

/// Position pattern generator 14.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PatternGenerator {
    /// Width of a position in bits, the P of its ports.
    pub position: usize,
    /// Width of a time in bits, the T of its ports; fewer than a position has.
    pub time: usize,
}

impl PatternGenerator {
    const fn trapezoid(&self) -> Trapezoid {
        Trapezoid {
            position: self.position,
            time: self.time,
        }
    }

    const fn mul_div(&self) -> MulDiv {
        let trapezoid = self.trapezoid();
        MulDiv::new(trapezoid.multiplier(), trapezoid.word())
    }

    /// Ticks from `start` to `ready`: three products and a quotient, each with a tick before it.
    #[must_use]
    pub const fn prepare_latency(&self) -> u64 {
        let mul_div = self.mul_div();
        1 + 3 * (mul_div.product_latency() + 1) + mul_div.latency() + 1
    }

    /// Largest delay, in ticks, of [`prepare_latency`](Self::prepare_latency) while the
    /// multiplier-divider finishes an aborted operation.
    #[must_use]
    pub const fn prepare_delay(&self) -> u64 {
        self.mul_div().latency() - 2
    }

    /// Ticks from `advance` to `valid`, with which `ready` comes back.
    #[must_use]
    pub const fn scan_latency(&self) -> u64 {
        1 + self.mul_div().latency() + 1
    }
}

signals! { for PatternGenerator as c;
    /// The circuits inside.
    pub struct Parts {
        /// Control.
        pub trapezoid: Part<Trapezoid>(c.trapezoid()),
        /// Multiplier-divider.
        pub mul_div: Part<MulDiv>(c.mul_div()),
    }
    /// Output ports.
    pub struct Net {
        /// x(n): position, in counts.
        pub position: I(c.position) as Analog,
        /// A new position is at `position` from this tick on.
        pub valid: Bit,
        /// Ready for `advance`.
        pub ready: Bit,
        /// A cycle is running.
        pub active: Bit,
    }
}

impl Circuit for PatternGenerator {
    const NAME: &'static str = "pattern_generator";
    const ABOUT: &'static str =
        "a position every scan: speeds up, holds speed, slows down, ends exactly";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let trapezoid = p.trapezoid.settle(trapezoid::In {
            cycle: i,
            done: p.mul_div.q.done,
            quotient: p.mul_div.q.quotient,
            remainder: p.mul_div.q.remainder,
        });
        p.mul_div.settle(mul_div::In {
            start: trapezoid.w.compute,
            product_only: trapezoid.w.product_only,
            multiplicand: trapezoid.w.multiplicand,
            multiplier: trapezoid.w.multiplier,
            addend: trapezoid.w.addend,
            divisor: trapezoid.w.divisor,
        });
        let net = Net {
            position: trapezoid.q.position,
            valid: trapezoid.q.valid,
            ready: trapezoid.q.ready,
            active: trapezoid.q.active,
        };
        (net, Nothing)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let helpers = self.helpers(&now.p.trapezoid.q, &now.p.mul_div.q);
        helpers.into_iter().flatten().collect()
    }
}

impl PatternGenerator {
    /// Statements that the assumptions of the multiplier-divider need: no divisor is 0, and no sum
    /// of weights has more than half of the range of a word. They are about its running calculation.
    fn helpers(
        &self,
        q: &trapezoid::Reg<Open>,
        mul_div: &mul_div::Reg<Open>,
    ) -> Option<[Property; 5]> {
        let running = mul_div.sequence.as_ref()?;
        let is = |state: u64| q.state.equals(state);
        let scans = is(WAITING) | is(SCAN);
        let (position, time) = (self.position, self.time);
        let some = |words: &[U]| Bit::all(words.iter().map(|word| !word.is_zero()));
        let below = |word: U, bits: usize| word.shift_right(bits).is_zero();
        let set = some(&[q.ramp_up, q.ramp_down]) & !q.speed_limit.is_zero();
        let steady = (is(PEAK) | is(TOTAL)).implies(below(q.steady_scans, position - 1));
        let peak = (is(TOTAL) | scans).implies(!q.peak.is_zero() & below(q.peak, 2 * time));
        let widest = self.mul_div().word - 1;
        let total = scans.implies(!q.total.is_zero() & below(q.total, widest));
        let busy = !running.state.is_zero() | mul_div.done;
        let computes = q.under_way & !q.request;
        let products = (computes & is(PEAK)).implies(self.product(mul_div, time, time)?)
            & (computes & is(TOTAL)).implies(self.product(mul_div, position + 1, 2 * time)?);
        let rests = mul_div.remainder.is_zero() & !running.state.equals(DIVIDE);
        let multiplies = running.state.equals(MULTIPLY);
        let undivided = multiplies.implies(running.undivided);
        Some([
            Property::helper(
                "a cycle has settings that are not 0, and without one nothing is requested",
                &[
                    "trapezoid.ramp_up",
                    "trapezoid.ramp_down",
                    "trapezoid.speed_limit",
                ],
                q.active.mux(set, !q.request)
                    & !(q.active ^ !q.state.is_zero())
                    & !U::new(SCAN, 3).below(q.state),
            ),
            Property::helper(
                "steady scans, peak and sum of the weights are within their ranges",
                &["trapezoid.peak", "trapezoid.total"],
                steady & peak & total,
            ),
            Property::helper(
                "the multiplier-divider is busy or shows done while an operation is under way",
                &["trapezoid.under_way", "mul_div.done"],
                !(q.under_way ^ busy),
            ),
            Property::helper(
                "the products of peak and weights are of the sizes of their factors",
                &["mul_div.quotient"],
                products,
            ),
            Property::helper(
                "nothing is divided by 0, and a remainder begins with 0",
                &["mul_div.by"],
                running.by.is_zero().implies(rests & undivided)
                    & (!multiplies | mul_div.remainder.is_zero()),
            ),
        ])
    }

    /// High if a product without a division is running or complete, of two factors of these numbers
    /// of bits that are not 0.
    fn product(&self, q: &mul_div::Reg<Open>, first: usize, second: usize) -> Option<Bit> {
        let MulDiv {
            multiplier, word, ..
        } = self.mul_div();
        let running = q.sequence.as_ref()?;
        let below = |word: U, bits: usize| word.shift_right(bits).is_zero();
        let ticks = (0..multiplier).map(|count| {
            let used = count.min(second);
            let short = below(running.shifted, (first + count).min(word))
                & below(running.factor, second - used)
                & below(q.quotient, first + used);
            running.count.equals(count as u64).implies(short)
        });
        let left = !running.shifted.is_zero() & !(running.factor.is_zero() & q.quotient.is_zero());
        let runs = running.state.equals(MULTIPLY) & running.undivided & left & Bit::all(ticks);
        let complete = !q.quotient.is_zero() & below(q.quotient, first + second);
        Some(q.done.mux(running.state.is_zero() & complete, runs))
    }
}
