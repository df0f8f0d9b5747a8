//! Exact relation of the correction 28: divides by the distance that the lead gave.
//!
//! ```text
//!                    ┌────────────────┐
//!  overrun, error ──▶│ exact relation ├──▶ divide_by, addend
//!                    └────────────────┘
//! ```
//!
//! A body that arrives at a constant speed v moves d1 − d2 = v·Δt1 from the control signal to the
//! target, and its overrun does not depend on the lead. So the right time is Δt1·d1/(d1 − d2),
//! which is Δt1 + Δt1·d2/(d1 − d2): the division of the first order with another divisor.
//!
//! Departure: the text names an accurate function and gives none. Where the body has already
//! reached the target when the control signal comes, d1 − d2 says nothing about the speed. Then the
//! divisor is |d1|, as in the first order, which at least doubles the time.

use crate::prelude::*;

/// Divisor of the exact relation.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExactRelation {
    /// Width of a position.
    pub position: usize,
}

signals! { for ExactRelation as c;
    /// Input ports.
    pub struct In {
        /// d1: distance since the control signal.
        pub overrun: I(c.position),
        /// d2: distance past the target.
        pub error: I(c.position),
    }
    /// Nets.
    pub struct Net {
        /// d1 − d2: distance from the control signal to the target.
        distance: I(c.position + 1),
        /// The target was ahead, in the direction of the overrun.
        ahead: Bit,
        /// d1 − d2 if the target was ahead, otherwise d1.
        way: I(c.position + 1),
        /// Magnitude of `way`.
        amount: U(c.position + 1),
        /// Divisor: |d1 − d2| if the target was ahead, otherwise |d1|.
        pub divide_by: U(c.position),
        /// Half of the divisor, which rounds the quotient to the nearest.
        pub addend: U(c.position),
    }
}

impl Circuit for ExactRelation {
    const NAME: &'static str = "exact_relation";
    const ABOUT: &'static str = "divisor of a correction: distance from control signal to target";
    records!(In, Nothing, Net);

    fn tick(&self, i: In, _: Nothing, _: Nothing) -> (Net, Nothing) {
        let distance = i.overrun.minus(i.error);
        let opposed = distance.is_negative() ^ i.overrun.is_negative();
        let ahead = !opposed & !distance.is_zero();
        let overrun = i.overrun.resize(self.position + 1);
        let way = ahead.mux(distance, overrun);
        let amount = way.magnitude();
        // No two positions are 2^W apart.
        let divide_by = amount.resize(self.position);
        let net = Net {
            distance,
            ahead,
            way,
            amount,
            divide_by,
            addend: divide_by.shift_right(1),
        };
        (net, Nothing)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, w) = (&now.i, &now.w);
        let (forwards, backwards) = (i.error.below(i.overrun), i.overrun.below(i.error));
        let is_negative = i.overrun.is_negative();
        let ahead = is_negative.mux(backwards, forwards);
        let overrun = i.overrun.resize(self.position + 1);
        // It has the sign of the overrun.
        let way = ahead.mux(i.overrun.minus(i.error), overrun);
        let amount = way.negated_by(is_negative).unsigned();
        let right = w.divide_by.equals_any(amount);
        vec![Property::always(
            "divide_by is the distance to a target that lay ahead, otherwise the overrun",
            &["divide_by", "addend"],
            right & w.addend.equals(w.divide_by.shift_right(1)),
        )]
    }
}

impl Specified for ExactRelation {}
