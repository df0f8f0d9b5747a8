//! Integrators 24, 25 and subtractors 20, 22 of the reference model 12 (¶0027). One scaler serves
//! as both multipliers, 21 and 23.
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
//! product keeps its fraction; only the acceleration is rounded. Magnitudes are scaled and their
//! signs restored, so a mirrored target gives the mirrored response.

use super::Rounding;
use crate::prelude::*;

/// Names of the states.
const STATES: &[&str] = &["idle", "first_gain", "second_gain"];
const IDLE: u64 = 0;
pub(super) const FIRST: u64 = 1;
pub(super) const SECOND: u64 = 2;

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
        /// K2, in units of 2^−(K − 1) per period; constant during a step.
        pub gain_2: U(c.gain),
    }
}

/// State of a reference model.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ModelState {
    /// Word widths.
    pub widths: ModelWidths,
    /// Rounding of the acceleration.
    pub rounding: Rounding,
}

signals! { for ModelState as c;
    /// Input ports.
    pub struct In {
        /// An interpolation period begins; ignored while `busy`.
        pub step: Bit,
        /// Sets the position to the target, at rest; aborts a running step.
        pub preset: Bit,
        /// u: target position in guard units; sampled with `step`.
        pub target: I(c.widths.position),
        /// K1 and K2.
        pub gains: ModelGains(&c.widths) as Flat,
        /// The scaler has a result.
        pub done: Bit,
        /// Result of the scaler.
        pub scaled: U(c.widths.product()),
    }
    /// Flip-flops.
    pub struct Reg {
        /// State of the sequence.
        pub(super) state: U(2) as States(STATES) = 0,
        /// Sign of the value being scaled: u − p, then K1(u − p) − v.
        negative: Bit = 0,
        /// p: position of the model, in guard units.
        pub position: I(c.widths.position) as Analog = 0,
        /// v: velocity of the model, per period.
        pub velocity: I(c.widths.position) as Analog = 0,
        /// a: acceleration of the model, per period squared.
        pub acceleration: I(c.widths.position) as Analog = 0,
        /// High for one tick: the state has new values.
        pub fresh: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// A step is accepted.
        take: Bit,
        /// The first product is ready, and the second begins.
        second: Bit,
        /// The second product is ready, and the step ends.
        complete: Bit,
        /// 20: u − p.
        error: I(c.widths.position),
        /// K1(u − p), with K − 1 fraction bits.
        demand: I(c.widths.product()),
        /// v, with K − 1 fraction bits.
        motion: I(c.widths.product()),
        /// 22: K1(u − p) − v, with K − 1 fraction bits.
        difference: I(c.widths.product()),
        /// Starts the scaler.
        pub scale: Bit,
        /// Value for the scaler.
        pub value: U(c.widths.product()),
        /// Gain for the scaler.
        pub gain: U(c.widths.gain),
        /// Product plus the rounding term.
        raised: U(c.widths.product()),
        /// `raised` without its fraction bits.
        cut: U(c.widths.product()),
        /// Magnitude of the new acceleration.
        amount: I(c.widths.position),
        /// New acceleration.
        change: I(c.widths.position),
        /// A step is running; another one is ignored.
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
