//! Reference model 12 (¶0027, equation (2)): predicts the response of the servo system to a
//! position command.
//!
//! ```text
//!                  ┌─────────────────┐
//!  step, preset ──▶│                 ├──▶ position, velocity, acceleration
//!  target ────────▶│ reference_model ├──▶ fresh, busy
//!  gain_1, gain_2 ▶│                 │
//!                  └─────────────────┘
//! ```
//!
//! This circuit is also the servo response 51, 52 of an axis, the tangential servo response 50, and
//! the model 12 inside a servo control 11. All of them agree to the bit (¶0030).

use super::model_state::{FIRST, ModelGains, ModelWidths, SECOND};
use super::{ModelState, Rounding, model_state};
use crate::circuits::blocks::{Scaler, scaler};
use crate::prelude::*;

/// Reference model.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReferenceModel {
    /// Word widths.
    pub widths: ModelWidths,
    /// Rounding of the acceleration.
    pub rounding: Rounding,
}

impl ReferenceModel {
    const fn scaler(&self) -> Scaler {
        Scaler {
            gain: self.widths.gain,
            value: self.widths.product(),
        }
    }

    /// Ticks from `step` to `fresh`.
    #[must_use]
    pub const fn latency(&self) -> u64 {
        2 * self.scaler().latency() + 1
    }
}

signals! { for ReferenceModel as c;
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
    }
    /// The blocks inside.
    pub struct Parts {
        /// Integrators 24, 25 and subtractors 20, 22.
        pub integrators: Part<ModelState>(ModelState { widths: c.widths, rounding: c.rounding }),
        /// Multipliers 21, 23.
        pub scaler: Part<Scaler>(c.scaler()),
    }
    /// Output ports.
    pub struct Net {
        /// p: position of the model, in guard units.
        pub position: I(c.widths.position) as Analog,
        /// v: velocity of the model, per period.
        pub velocity: I(c.widths.position) as Analog,
        /// a: acceleration of the model, per period squared.
        pub acceleration: I(c.widths.position) as Analog,
        /// High for one tick: the state has new values.
        pub fresh: Bit,
        /// A step is running; another one is ignored.
        pub busy: Bit,
    }
}

impl Circuit for ReferenceModel {
    const NAME: &'static str = "reference_model";
    const ABOUT: &'static str = "predicts the response of the servo system to a position command";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let model = p.integrators.settle(model_state::In {
            step: i.step,
            preset: i.preset,
            target: i.target,
            gains: i.gains,
            done: p.scaler.q.done,
            scaled: p.scaler.q.scaled,
        });
        p.scaler.settle(scaler::In {
            start: model.w.scale,
            clear: i.preset,
            value: model.w.value,
            gain: model.w.gain,
        });
        let net = Net {
            position: model.q.position,
            velocity: model.q.velocity,
            acceleration: model.q.acceleration,
            fresh: model.q.fresh,
            busy: model.w.busy,
        };
        (net, Nothing)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (state, scaler) = (now.p.integrators.q.state, &now.p.scaler.q);
        let first = state.equals(FIRST);
        // A distance is at most half of the range of positions.
        let widest = U::new(
            1 << (self.widths.position + self.widths.gain - 2),
            self.widths.product(),
        );
        vec![
            Property::helper(
                "the scaler works for the first and the second gain only",
                &["scaler.busy", "integrators.state"],
                !(scaler.busy | scaler.done) | first | state.equals(SECOND),
            ),
            Property::helper(
                "the first gain scales a distance between two positions",
                &["scaler.factor"],
                first.implies(!widest.below(scaler.factor)),
            ),
        ]
    }
}
