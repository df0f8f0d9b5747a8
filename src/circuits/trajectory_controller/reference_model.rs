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
//! This circuit is also the servo response of an axis 51, 52, the tangential servo response 50,
//! and the model 12 inside a servo control 11: all of them agree to the bit (¶0030).

use super::model_state::{ModelGains, ModelWidths};
use super::{ModelState, Rounding, model_state};
use crate::circuits::blocks::{Scaler, scaler};
use crate::prelude::*;

/// Reference model.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReferenceModel {
    /// Its widths.
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
        /// An interpolation period begins; not taken while `busy`.
        pub step: Bit,
        /// Sets the position to the target, at rest; a running step is aborted.
        pub preset: Bit,
        /// u: the target position, taken with `step`.
        pub target: I(c.widths.position),
        /// K1 and K2.
        pub gains: ModelGains(&c.widths) as Flat,
    }
    /// The blocks inside.
    pub struct Parts {
        /// 20, 22, 24, 25.
        pub integrators: Part<ModelState>(ModelState { widths: c.widths, rounding: c.rounding }),
        /// 21, 23.
        pub scaler: Part<Scaler>(c.scaler()),
    }
    /// Output ports.
    pub struct Net {
        /// p: the model's position.
        pub position: I(c.widths.position) as Analog,
        /// v: its velocity, per period.
        pub velocity: I(c.widths.position) as Analog,
        /// a: its acceleration, per period squared.
        pub acceleration: I(c.widths.position) as Analog,
        /// High in the tick with new values.
        pub fresh: Bit,
        /// A step is not taken.
        pub busy: Bit,
    }
}

impl Circuit for ReferenceModel {
    const NAME: &'static str = "reference_model";
    const ABOUT: &'static str = "what the servo system will answer to a position command";
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
}
