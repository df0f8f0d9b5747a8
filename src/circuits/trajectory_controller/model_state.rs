//! Integrators 24, 25 and subtractors 20, 22 of the reference model 12 (¶0027), around a scaler that
//! is both multipliers, 21 and 23.
//!
//! ```text
//!                      ┌─────────────┐
//!  step, preset ──────▶│             ├──▶ position, velocity, acceleration
//!  target ────────────▶│ model_state ├──▶ fresh, busy
//!  gain_1, gain_2 ────▶│             ├──▶ scale, value, gain ──▶ scaler
//!  done, scaled ──────▶│             │◀── scaler
//!                      └─────────────┘
//! ```
//!
//! a = K2·(K1·(u − p) − v), p' = p + v, v' = v + a, all from the values before the step. The first
//! product keeps its fraction; the acceleration alone is rounded. Magnitudes are scaled and signs
//! put back, so a mirrored target gives the mirrored response.

use super::Rounding;
use crate::prelude::*;

/// Names of the states.
const STATES: &[&str] = &["idle", "first_gain", "second_gain"];
const IDLE: u64 = 0;
const FIRST: u64 = 1;
const SECOND: u64 = 2;

/// Widths of a reference model in bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ModelWidths {
    /// P: positions, velocities, accelerations, signed.
    pub position: usize,
    /// K: gains, with K − 1 fraction bits.
    pub gain: usize,
}

impl ModelWidths {
    /// Width of its scaler's values: a product with its fraction, and a difference of two.
    #[must_use]
    pub const fn product(&self) -> usize {
        self.position + self.gain + 1
    }
}

signals! { for ModelWidths as c;
    /// Gains of a reference model.
    pub struct ModelGains {
        /// K1, in units of 2^−(K − 1) per period; constant during a step.
        pub gain_1: U(c.gain),
        /// K2, in the same unit; constant during a step.
        pub gain_2: U(c.gain),
    }
}

/// State of a reference model.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ModelState {
    /// Its widths.
    pub widths: ModelWidths,
    /// Rounding of the acceleration.
    pub rounding: Rounding,
}

signals! { for ModelState as c;
    /// Input ports.
    pub struct In {
        /// An interpolation period begins; not taken while `busy`.
        pub step: Bit,
        /// Sets the position to the target, at rest; a running step is aborted.
        pub preset: Bit,
        /// u: the target position, taken with `step`.
        pub target: I(c.widths.position),
        /// K1 and K2.
        pub gains: ModelGains(&c.widths) as Flat,
        /// The scaler is done.
        pub done: Bit,
        /// Its result.
        pub scaled: U(c.widths.product()),
    }
    /// Flip-flops.
    pub struct Reg {
        /// State of the sequence.
        state: U(2) as States(STATES) = 0,
        /// u − p is negative; then: K1(u − p) − v is negative.
        negative: Bit = 0,
        /// p: the model's position.
        pub position: I(c.widths.position) as Analog = 0,
        /// v: its velocity, per period.
        pub velocity: I(c.widths.position) as Analog = 0,
        /// a: its acceleration, per period squared.
        pub acceleration: I(c.widths.position) as Analog = 0,
        /// High in the tick with new values.
        pub fresh: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// A step is taken.
        take: Bit,
        /// The first product is ready.
        second: Bit,
        /// The second product is ready.
        complete: Bit,
        /// 20: u − p.
        error: I(c.widths.position),
        /// K1(u − p), with K − 1 bits of fraction.
        demand: I(c.widths.product()),
        /// v, with K − 1 bits of fraction.
        motion: I(c.widths.product()),
        /// 22: K1(u − p) − v, with the fraction.
        difference: I(c.widths.product()),
        /// The scaler begins.
        pub scale: Bit,
        /// With this value,
        pub value: U(c.widths.product()),
        /// by this gain.
        pub gain: U(c.widths.gain),
        /// Product plus the rounding term.
        raised: U(c.widths.product()),
        /// `raised` without its fraction.
        cut: U(c.widths.product()),
        /// |a|.
        amount: I(c.widths.position),
        /// a.
        change: I(c.widths.position),
        /// A step is not taken.
        pub busy: Bit,
    }
}

impl Circuit for ModelState {
    const NAME: &'static str = "model_state";
    const ABOUT: &'static str = "position and velocity of the reference model, around its scaler";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        let halves = self.widths.gain >= 2;
        (!halves).then(|| "a gain has a bit before the point and one behind".into())
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let product = self.widths.product();
        let fraction = self.widths.gain - 1;
        let is = |state: u64| q.state.equals(state);
        let take = i.step & is(IDLE) & !i.preset;
        let second = i.done & is(FIRST) & !i.preset;
        let complete = i.done & is(SECOND) & !i.preset;
        let error = i.target - q.position;
        let demand = i.scaled.signed().negated_by(q.negative);
        let motion = q.velocity.resize(product).shift_left(fraction);
        let difference = demand - motion;
        let whole = error.magnitude().resize(product);
        let raised = match self.rounding {
            Rounding::Nearest => i.scaled + (1u64 << (fraction - 1)),
            Rounding::Floor => i.scaled,
        };
        let cut = raised.shift_right(fraction);
        let amount = cut.signed().resize(self.widths.position);
        let change = amount.negated_by(q.negative);

        let state = take.mux(FIRST, q.state);
        let state = second.mux(SECOND, state);
        let negative = take.mux(error.is_negative(), q.negative);
        let position = complete.mux(q.position + q.velocity, q.position);
        let velocity = complete.mux(q.velocity + change, q.velocity);
        let acceleration = complete.mux(change, q.acceleration);
        let next = Reg {
            state: (complete | i.preset).mux(IDLE, state),
            negative: second.mux(difference.is_negative(), negative),
            position: i.preset.mux(i.target, position),
            velocity: i.preset.mux(0, velocity),
            acceleration: i.preset.mux(0, acceleration),
            fresh: complete | i.preset,
        };
        let net = Net {
            take,
            second,
            complete,
            error,
            demand,
            motion,
            difference,
            scale: take | second,
            value: second.mux(difference.magnitude(), whole.shift_left(fraction)),
            gain: second.mux(i.gains.gain_2, i.gains.gain_1),
            raised,
            cut,
            amount,
            change,
            busy: !is(IDLE),
        };
        (net, next)
    }
}
