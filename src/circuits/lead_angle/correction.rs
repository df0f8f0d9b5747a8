//! Correction 23: computes the next lead time of a step from its completed positioning.
//!
//! ```text
//!                               ┌────────────┐
//!  fire, complete, position ───▶│            ├──▶ overrun, error
//!  target, lead_time ──────────▶│ correction ├──▶ learned, learned_time
//!  learn, missed, seed ────────▶│            ├──▶ corrected
//!                               └────────────┘
//! ```
//!
//! Contains error 27, position register 30 and overrun 31, the arithmetic 28 with a sequential
//! multiplier-divider, and the [grid] for the result. Unless N is fixed at 1, this is the grid of
//! the ratio logic. For the second order, the [refinement] divides twice. For the [exact
//! relation](exact_relation), there is one division, by another divisor.

use super::grid::{self, Grid, GridPart};
use super::{CorrectionArithmetic, Division, ExactRelation, Refinement, Sign, StopError};
use super::{correction_arithmetic, exact_relation, refinement, stop_error};
use crate::circuits::blocks::mul_div::{DIVIDE, MULTIPLY};
use crate::circuits::blocks::{MulDiv, mul_div};
use crate::prelude::*;
use serde::{Deserialize, Serialize};

/// Δtd that the correction 28 makes of error and overrun.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Function {
    /// Δtd = Δt1·d2/d1.
    #[default]
    FirstOrder,
    /// Δtd = (Δt1 + Δt1·d2/d1)·d2/d1 where |d2| < |d1|, or else the first order.
    SecondOrder,
    /// Δtd = Δt1·d2/(d1 − d2), so Δt2 = Δt1·d1/(d1 − d2), where d1 − d2 has the direction of d1, or
    /// else the first order.
    Exact,
}

/// Correction 23.
///
/// `corrected` is high one tick after `complete`; where a division is needed,
/// [`latency`](Correction::latency) ticks after it.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Correction {
    /// Stages of history.
    pub stages: usize,
    /// Width of a position.
    pub position: usize,
    /// Sign convention of the error.
    pub sign: Sign,
    /// Function of error and overrun.
    pub function: Function,
    /// Format of the time data for the learned time.
    pub division: Division,
}

impl Correction {
    /// Ticks from `complete` to `corrected` where `divisions` are made, one or two. Two are made to
    /// second order, of an error that is less than the overrun.
    #[must_use]
    pub fn latency(&self, divisions: u64) -> u64 {
        let refined = u64::from(self.second_order());
        divisions * self.mul_div().latency() + refined + 1
    }

    fn second_order(&self) -> bool {
        self.function == Function::SecondOrder
    }

    fn exact(&self) -> bool {
        self.function == Function::Exact
    }

    fn arithmetic(&self) -> CorrectionArithmetic {
        CorrectionArithmetic {
            stages: self.stages,
            position: self.position,
        }
    }

    fn refinement(&self) -> Refinement {
        Refinement {
            time: self.arithmetic().time(),
            position: self.position,
        }
    }

    fn exact_relation(&self) -> ExactRelation {
        ExactRelation {
            position: self.position,
        }
    }

    /// To second order a factor can be twice a time.
    fn mul_div(&self) -> MulDiv {
        let arithmetic = self.arithmetic();
        let multiplier = arithmetic.time() + usize::from(self.second_order());
        MulDiv::new(multiplier, arithmetic.word())
    }
}

signals! { for Correction as c;
    /// Input ports.
    pub struct In {
        /// High for one tick: the control signal begins.
        pub fire: Bit,
        /// High for one tick: the positioning is complete.
        pub complete: Bit,
        /// Dx.
        pub position: I(c.position),
        /// Sx; constant from `fire` to `corrected`.
        pub target: I(c.position),
        /// Δt1 in CKs; constant from `fire` to `corrected`.
        pub lead_time: U(c.arithmetic().time()),
        /// Enables learning.
        pub learn: Bit,
        /// The control signal did not come from the comparator.
        pub missed: Bit,
        /// Lead time, in CKs, that a step without one gets after its first stop error.
        pub seed: U(c.arithmetic().time()),
    }
    /// The circuits inside.
    pub struct Parts {
        /// Error 27, position register 30, overrun 31.
        pub stop_error: Part<StopError>(StopError { position: c.position, sign: c.sign }),
        /// Arithmetic 28.
        pub arithmetic: Part<CorrectionArithmetic>(c.arithmetic()),
        /// Second division, for the second order.
        pub refinement: Part<Refinement>(c.refinement()) if c.second_order(),
        /// Choice of the divisor, for the exact relation.
        pub exact_relation: Part<ExactRelation>(c.exact_relation()) if c.exact(),
        /// Divider.
        pub mul_div: Part<MulDiv>(c.mul_div()),
        /// Puts the result on the grid.
        pub grid: GridPart(&Grid::of(c.division, c.stages)),
    }
    /// Output ports.
    pub struct Net {
        /// d1: distance since the control signal, positive upwards.
        pub overrun: I(c.position),
        /// d2: distance past the target, positive upwards.
        pub error: I(c.position),
        /// Δt2 in CKs, on the grid.
        pub learned_time: U(c.arithmetic().time()),
        /// Δt2 as divided time data: N in the upper bits, Δt/N in the lower bits.
        pub learned_data: U(grid::word(c.division, c.stages))
            if (c.division == Division::Beforehand),
        /// High for one tick: Δt2 is a new time.
        pub learned: Bit,
        /// High for one tick: the correction is over, with or without a new time.
        pub corrected: Bit,
    }
}

impl Correction {
    /// Helpers: a quotient has no more than half of the range of a word, because only a divisor of 1
    /// leaves the dividend as it is.
    fn bounds(&self, q: &mul_div::Reg<Open>) -> Option<[Property; 3]> {
        let MulDiv {
            multiplier, word, ..
        } = self.mul_div();
        let running = q.sequence.as_ref()?;
        let [multiplies, divides] = [MULTIPLY, DIVIDE].map(|state| running.state.equals(state));
        let time = multiplier - usize::from(self.second_order());
        let highest = q.quotient.bit(word - 1);
        let at = |count: usize, holds: Bit| running.count.equals(count as u64).implies(holds);
        // The product before each bit of the multiplier.
        let product = (0..multiplier).map(|count| {
            let most = U::new(1 << (self.position - 1 + count), word);
            let short = running.shifted.is_zero()
                | running.factor.shift_right(time - count.min(time)).is_zero();
            at(count, short & !most.below(running.shifted))
        });
        let less = q.quotient.is_zero() | q.quotient.below(running.shifted);
        let alone = less & Bit::all(product);
        let by_one = running.by.equals(1);
        // The first bit of the quotient, where it is after each tick.
        let bits = (1..word).map(|count| at(count, !q.quotient.bit(count - 1)));
        let begins = at(0, q.remainder.is_zero() & !(by_one & highest));
        Some([
            Property::helper(
                "a product that is divided by 1 is less than half of the range",
                &["mul_div.quotient", "mul_div.shifted"],
                (multiplies & by_one).implies(alone),
            ),
            Property::helper(
                "a correction is never divided by 0, and its remainder begins with 0",
                &["mul_div.by", "mul_div.remainder"],
                (multiplies | divides).implies(!running.by.is_zero())
                    & multiplies.implies(q.remainder.is_zero() & !running.undivided),
            ),
            Property::helper(
                "the first bit of a quotient is low",
                &["mul_div.quotient"],
                divides.implies(begins & Bit::all(bits)) & q.done.implies(!highest),
            ),
        ])
    }
}

impl Circuit for Correction {
    const NAME: &'static str = "correction";
    const ABOUT: &'static str = "learns the lead time of a step from the stop error";
    records!(In, Nothing, Net, Parts);

    fn name(&self) -> &'static str {
        match self.function {
            Function::FirstOrder => Self::NAME,
            Function::SecondOrder => "second_order_correction",
            Function::Exact => "exact_correction",
        }
    }

    fn about(&self) -> &'static str {
        match self.function {
            Function::FirstOrder => Self::ABOUT,
            Function::SecondOrder => "learns the lead time of a step to second order",
            Function::Exact => "learns the lead time of a step by the exact relation",
        }
    }

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let divider = &p.mul_div.q;
        let (divider_done, quotient) = (divider.done, divider.quotient);
        let done = p
            .refinement
            .as_ref()
            .map_or(divider_done, |part| part.q.done);
        let stop_error = p.stop_error.settle(stop_error::In {
            fire: i.fire,
            position: i.position,
            target: i.target,
        });
        let arithmetic = p.arithmetic.settle(correction_arithmetic::In {
            complete: i.complete,
            learn: i.learn,
            missed: i.missed,
            lead_time: i.lead_time,
            overrun: stop_error.w.overrun,
            error: stop_error.w.error,
            seed: i.seed,
            done,
            quotient,
        });
        let w = &arithmetic.w;
        let mut divided = mul_div::In {
            start: w.divide,
            product_only: Bit::low(),
            multiplicand: w.multiplicand,
            multiplier: w.multiplier,
            addend: w.addend,
            divisor: w.divisor,
        };
        if let Some(part) = p.refinement {
            let refined = part.settle(refinement::In {
                start: w.divide,
                multiplicand: w.multiplicand.resize(self.position),
                multiplier: w.multiplier,
                divisor: w.divisor.resize(self.position),
                negative: arithmetic.q.negative,
                divider_done,
                quotient: quotient.resize(w.multiplier.width()),
            });
            let word = w.divisor.width();
            divided = mul_div::In {
                start: refined.w.divide,
                product_only: Bit::low(),
                multiplicand: refined.w.first_factor.resize(word),
                multiplier: refined.w.second_factor,
                addend: refined.w.addend.resize(word),
                divisor: refined.w.divide_by.resize(word),
            };
        }
        if let Some(part) = p.exact_relation {
            let exact = part.settle(exact_relation::In {
                overrun: stop_error.w.overrun,
                error: stop_error.w.error,
            });
            let word = w.divisor.width();
            divided.divisor = exact.w.divide_by.resize(word);
            divided.addend = exact.w.addend.resize(word);
        }
        p.mul_div.settle(divided);
        let grid = p.grid.settle(arithmetic.q.raw);
        let net = Net {
            overrun: stop_error.w.overrun,
            error: stop_error.w.error,
            learned_time: grid.code,
            learned_data: grid.divided,
            learned: arithmetic.q.learned,
            corrected: arithmetic.q.corrected,
        };
        (net, Nothing)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let time = now.i.lead_time;
        let last = U::new(self.arithmetic().last(), time.width());
        let is_code = !time.is_zero() & !last.below(time);
        let mut all = vec![Property::given(
            "lead_time is from 1 to the largest code while a division is running",
            now.p.arithmetic.q.dividing.implies(is_code),
        )];
        if let Some(part) = &now.p.refinement {
            let widest = U::new(1 << (self.position - 1), self.position);
            all.push(Property::helper(
                "the overrun of a refinement is a magnitude",
                &["refinement.overrun_amount"],
                !widest.below(part.q.overrun_amount),
            ));
        }
        all.extend(self.bounds(&now.p.mul_div.q).into_iter().flatten());
        all
    }
}
