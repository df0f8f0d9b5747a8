//! Second order of the correction 28: divides |Δtd| a second time.
//!
//! ```text
//!                                  ┌────────────┐
//!  start, negative ───────────────▶│            ├──▶ divide, first_factor, second_factor
//!  multiplicand, multiplier, … ───▶│ refinement ├──▶ divide_by, addend
//!  divider_done, quotient ────────▶│            ├──▶ done
//!                                  └────────────┘
//! ```
//!
//! For a body that arrives at a constant speed, the error d2 corresponds to Δtd = Δt·d2/d1, where
//! Δt is the time that would have been right. The first order uses Δt1 in its place. Here that is
//! the first division, and the second division uses its result: Δtd = (Δt1 + Δt1·d2/d1)·d2/d1.
//!
//! Departure: the text names a quadratic function and gives none. Where |d2| is not below |d1|, the
//! series that this begins does not converge. There the result of the first division is kept: the
//! first order.

use crate::prelude::*;

/// Names of the states.
const STATES: &[&str] = &["idle", "first", "second"];
const IDLE: u64 = 0;
const FIRST: u64 = 1;
const SECOND: u64 = 2;

/// Refinement of a quotient by a second division.
///
/// The first division begins in the tick of `start`, the second in that of `divider_done`. `done`
/// is high in the tick after the last `divider_done`.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Refinement {
    /// Width of a time.
    pub time: usize,
    /// Width of a position.
    pub position: usize,
}

signals! { for Refinement as c;
    /// Input ports.
    pub struct In {
        /// Starts a correction; ignored while one is running.
        pub start: Bit,
        /// |d2|; sampled with `start`.
        pub multiplicand: U(c.position),
        /// Δt1; constant from `start` to `done`.
        pub multiplier: U(c.time),
        /// |d1|; sampled with `start`.
        pub divisor: U(c.position),
        /// Δtd is negative; valid from the tick after `start`.
        pub negative: Bit,
        /// The divider has a result.
        pub divider_done: Bit,
        /// Quotient from the divider; at most Δt1 where |d2| is below |d1|.
        pub quotient: U(c.time),
    }
    /// Flip-flops.
    pub struct Reg {
        /// State: the division that is running.
        state: U(2) as States(STATES) = 0,
        /// |d2| of the correction.
        error_amount: U(c.position) = 0,
        /// |d1| of the correction.
        pub(super) overrun_amount: U(c.position) = 0,
        /// High for one tick: |Δtd| is valid at the divider.
        pub done: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// A start is accepted.
        take: Bit,
        /// |d2| is below |d1|.
        converges: Bit,
        /// The first division ends, and the second begins.
        refine: Bit,
        /// The last division ends.
        over: Bit,
        /// Δt1 plus the Δtd of the first order.
        first_order: U(c.time + 1),
        /// Starts the divider.
        pub divide: Bit,
        /// First factor: |d2|.
        pub first_factor: U(c.position),
        /// Second factor: Δt1, or `first_order`.
        pub second_factor: U(c.time + 1),
        /// Divisor: |d1|.
        pub divide_by: U(c.position),
        /// Half of the divisor, which rounds the quotient to the nearest.
        pub addend: U(c.position),
    }
}

impl Circuit for Refinement {
    const NAME: &'static str = "refinement";
    const ABOUT: &'static str = "second division of a correction, for the second order";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let (first, second) = (q.state.bit(0), q.state.bit(1));
        let take = i.start & !first & !second;
        let converges = q.error_amount.below(q.overrun_amount);
        let refine = first & i.divider_done & converges;
        let over = (first | second) & i.divider_done & !refine;
        let time = i.multiplier.resize(self.time + 1);
        let by = i.quotient.resize(self.time + 1);
        let first_order = i.negative.mux(time - by, time + by);
        let divide_by = refine.mux(q.overrun_amount, i.divisor);
        let net = Net {
            take,
            converges,
            refine,
            over,
            first_order,
            divide: take | refine,
            first_factor: refine.mux(q.error_amount, i.multiplicand),
            second_factor: refine.mux(first_order, time),
            divide_by,
            addend: divide_by.shift_right(1),
        };
        let state = |state| U::new(state, 2);
        let after = refine.mux(state(SECOND), over.mux(state(IDLE), q.state));
        let edge = Reg {
            state: take.mux(state(FIRST), after),
            error_amount: take.mux(i.multiplicand, q.error_amount),
            overrun_amount: take.mux(i.divisor, q.overrun_amount),
            done: over,
        };
        (net, edge)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, w, next) = (&now.i, &now.q, &now.w, &now.next.q);
        let [idle, first, second] = [IDLE, FIRST, SECOND].map(|state| q.state.equals(state));
        let refined = first & q.error_amount.below(q.overrun_amount);
        let (starts, again) = (idle & i.start, refined & i.divider_done);
        let time = i.multiplier.resize(self.time + 1);
        let first_order = {
            let change = i.quotient.resize(self.time + 1);
            let shorter = time.equals(w.second_factor + change);
            i.negative
                .mux(shorter, w.second_factor.equals(time + change))
        };
        let amounts = |amount, by| w.first_factor.equals(amount) & w.divide_by.equals(by);
        let of_start = amounts(i.multiplicand, i.divisor) & w.second_factor.equals(time);
        let of_first = amounts(q.error_amount, q.overrun_amount) & first_order;
        let words = (!starts | of_start) & (!again | of_first);
        let half = w.addend.equals(w.divide_by.shift_right(1));

        let state = |state| U::new(state, 2);
        let begun = i.start.mux(state(FIRST), state(IDLE));
        let ended = refined.mux(state(SECOND), state(IDLE));
        let expected = idle.mux(begun, i.divider_done.mux(ended, q.state));
        let over = !idle & expected.is_zero();
        let held =
            |error, overrun| next.error_amount.equals(error) & next.overrun_amount.equals(overrun);
        let stored = held(i.multiplicand, i.divisor);
        let stays = held(q.error_amount, q.overrun_amount);
        vec![
            Property::always(
                "divide is high at start, and after a first division with error below overrun",
                &["divide", "second_factor"],
                w.divide.equals(starts | again) & words & half,
            ),
            Property::step(
                "an error below the overrun needs a second division, and done follows the last",
                &["state", "done"],
                next.state.equals(expected) & next.done.equals(over),
            ),
            Property::step(
                "start in idle stores error_amount and overrun_amount, and otherwise they stay",
                &["error_amount", "overrun_amount"],
                starts.mux(stored, stays),
            ),
            Property::helper(
                "state is idle, first or second",
                &["state"],
                idle | first | second,
            ),
        ]
    }
}

impl Specified for Refinement {}
