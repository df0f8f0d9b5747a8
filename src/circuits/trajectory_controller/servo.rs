//! Servo control 11 of one axis (Fig. 2): reference model 12 and the loops that make the motor
//! follow it.
//!
//! ```text
//!                       ┌───────────────────────────┐
//!  step, preset ───────▶│ reference model 12        ├──▶ torque, saturated, fresh
//!  target ─────────────▶│   ▶ servo_arithmetic      ├──▶ position, lost
//!  a, b ───────────────▶│     ◀▶ scaler             │
//!  gains, inertia, … ──▶│   ◀ quadrature counter    │
//!                       └───────────────────────────┘
//! ```

use super::model_state::ModelGains;
use super::servo_arithmetic::{INERTIA, POSITION, ServoGains, ServoWidths};
use super::{ReferenceModel, Rounding, ServoArithmetic, reference_model, servo_arithmetic};
use crate::circuits::blocks::{QuadratureCounter, Scaler, quadrature_counter, scaler};
use crate::prelude::*;

/// Servo control.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Servo {
    /// Word widths.
    pub widths: ServoWidths,
    /// Rounding of its model.
    pub rounding: Rounding,
}

impl Servo {
    /// Reference model 12.
    pub(super) const fn model(&self) -> ReferenceModel {
        ReferenceModel {
            widths: self.widths.model(),
            rounding: self.rounding,
        }
    }

    const fn scaler(&self) -> Scaler {
        Scaler {
            gain: self.widths.gain,
            value: self.widths.product(),
        }
    }

    /// Ticks from `step` to `fresh`.
    #[must_use]
    pub const fn latency(&self) -> u64 {
        self.model().latency() + 4 * self.scaler().latency() + 2
    }
}

signals! { for Servo as c;
    /// Input ports.
    pub struct In {
        /// The corrected command is new.
        pub step: Bit,
        /// Sets the model to the target, at rest, and restarts the loops. For use between two
        /// paths.
        pub preset: Bit,
        /// Pd: corrected position command in guard units; constant during a step.
        pub target: I(c.widths.position, c.widths.guard()),
        /// Channel A of the encoder, asynchronous.
        pub a: Bit,
        /// Channel B of the encoder, asynchronous.
        pub b: Bit,
        /// Clears `position` and `lost`.
        pub home: Bit,
        /// K1 and K2.
        pub model_gains: ModelGains(&c.widths.model()) as Flat,
        /// Gains of the loops.
        pub gains: ServoGains(&c.widths) as Flat,
    }
    /// The blocks inside.
    pub struct Parts {
        /// Reference model 12.
        pub model: Part<ReferenceModel>(c.model()),
        /// Counter of the motor's position.
        pub detector: Part<QuadratureCounter>(QuadratureCounter { width: c.widths.count }),
        /// Blocks 26 to 31.
        pub arithmetic: Part<ServoArithmetic>(ServoArithmetic { widths: c.widths }),
        /// Multiplier of the arithmetic.
        pub scaler: Part<Scaler>(c.scaler()),
    }
    /// Output ports.
    pub struct Net {
        /// Torque command.
        pub torque: I(c.widths.torque) as Analog,
        /// The torque is limited.
        pub saturated: Bit,
        /// High for one tick: the torque has a new value.
        pub fresh: Bit,
        /// Position of the motor in counts.
        pub position: I(c.widths.count) as Analog,
        /// Both encoder channels have changed at once since `home`: the position is wrong.
        pub lost: Bit,
    }
}

impl Circuit for Servo {
    const NAME: &'static str = "servo";
    const ABOUT: &'static str = "reference model, position and speed control of an axis";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let model = p.model.settle(reference_model::In {
            step: i.step,
            preset: i.preset,
            target: i.target,
            gains: i.model_gains,
        });
        let motor = p.detector.settle(quadrature_counter::In {
            a: i.a,
            b: i.b,
            clear: i.home,
        });
        let arithmetic = p.arithmetic.settle(servo_arithmetic::In {
            step: model.w.fresh,
            clear: i.preset,
            model_position: model.w.position,
            model_velocity: model.w.velocity,
            model_acceleration: model.w.acceleration,
            feedback: motor.q.position,
            gains: i.gains,
            done: p.scaler.q.done,
            scaled: p.scaler.q.scaled,
        });
        p.scaler.settle(scaler::In {
            start: arithmetic.w.scale,
            clear: i.preset,
            value: arithmetic.w.value,
            gain: arithmetic.w.gain,
        });
        let net = Net {
            torque: arithmetic.q.torque,
            saturated: arithmetic.q.saturated,
            fresh: arithmetic.q.fresh,
            position: motor.q.position,
            lost: motor.q.lost,
        };
        (net, Nothing)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (q, scaler) = (&now.p.arithmetic.q, &now.p.scaler.q);
        let multiplies = !q.state.is_zero() & !U::new(INERTIA, 3).below(q.state);
        let (position, product) = (self.widths.position, self.widths.product());
        let widest = U::new(1 << position, product);
        vec![
            Property::helper(
                "the scaler works in the states with a product only",
                &["scaler.busy", "arithmetic.state"],
                !(scaler.busy | scaler.done) | multiplies,
            ),
            Property::helper(
                "the position gain scales a distance between two positions",
                &["scaler.factor"],
                q.state
                    .equals(POSITION)
                    .implies(!widest.below(scaler.factor)),
            ),
            Property::helper(
                "the speed error is at most the sum of its terms",
                &["arithmetic.speed_error"],
                q.speed_error.magnitude().below(1u64 << (position + 2)),
            ),
        ]
    }
}
