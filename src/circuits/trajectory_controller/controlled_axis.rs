//! One axis of the trajectory controller: servo response 51, vector correction 4, servo control 11.
//!
//! ```text
//!                        ┌──────────────────────────┐
//!  step, preset, command ▶│ response ▶ correction    ├──▶ torque, saturated
//!  correct, reference ──▶│            ▶ servo       ├──▶ answered, driven
//!  a, b, gains… ────────▶│                          ├──▶ position, lost
//!                        └──────────────────────────┘
//! ```

use super::model_state::ModelGains;
use super::servo_arithmetic::ServoGains;
use super::vector_correction::Correction;
use super::{ReferenceModel, Servo, VectorCorrection, reference_model, servo, vector_correction};
use crate::prelude::*;

/// Axis of the trajectory controller.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ControlledAxis {
    /// Servo control 6, 7 (11); the servo response equals its model.
    pub servo: Servo,
    /// Correction added to the commands.
    pub correction: Correction,
}

signals! { for ControlledAxis as c;
    /// Input ports.
    pub struct In {
        /// The position command is new.
        pub step: Bit,
        /// Sets the servo response to the command, at rest; has priority over `step`.
        pub preset: Bit,
        /// Pc: the position command.
        pub command: I(c.servo.widths.position, c.servo.widths.guard()),
        /// Reference point and servo responses are valid.
        pub correct: Bit,
        /// Pr: the reference point, or the error feedback.
        pub target: I(c.servo.widths.position, c.servo.widths.guard()),
        /// Channel A of the encoder, asynchronous.
        pub a: Bit,
        /// Channel B of the encoder, asynchronous.
        pub b: Bit,
        /// K1 and K2 of servo response and servo control.
        pub model_gains: ModelGains(&c.servo.widths.model()) as Flat,
        /// Gains of the servo control's loops.
        pub gains: ServoGains(&c.servo.widths) as Flat,
    }
    /// The blocks inside.
    pub struct Parts {
        /// Servo response 51, 52.
        pub response: Part<ReferenceModel>(c.servo.model()),
        /// Vector correction 4.
        pub corrector: Part<VectorCorrection>(VectorCorrection {
            width: c.servo.widths.position,
            correction: c.correction,
        }),
        /// Servo control 6, 7 (11).
        pub servo: Part<Servo>(c.servo.clone()),
    }
    /// Output ports.
    pub struct Net {
        /// High for one tick: the servo response has a new value.
        pub answered: Bit,
        /// E: correction.
        pub deviation: I(c.servo.widths.position, c.servo.widths.guard()) as Analog,
        /// Pd: corrected position command.
        pub corrected: I(c.servo.widths.position, c.servo.widths.guard()) as Analog,
        /// Torque command.
        pub torque: I(c.servo.widths.torque) as Analog,
        /// The torque is limited.
        pub saturated: Bit,
        /// High for one tick: the torque has a new value.
        pub driven: Bit,
        /// Position of the motor in counts.
        pub position: I(c.servo.widths.count) as Analog,
        /// Both encoder channels have changed at once since power-on: the position is wrong.
        pub lost: Bit,
    }
}

impl Circuit for ControlledAxis {
    const NAME: &'static str = "controlled_axis";
    const ABOUT: &'static str = "servo response, vector correction and servo control of an axis";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let response = p.response.settle(reference_model::In {
            step: i.step,
            preset: i.preset,
            target: i.command,
            gains: i.model_gains.clone(),
        });
        let corrector = p.corrector.settle(vector_correction::In {
            correct: i.correct,
            target: i.target,
            response: response.w.position,
            command: i.command,
        });
        let servo = p.servo.settle(servo::In {
            step: corrector.q.fresh,
            target: corrector.q.corrected,
            a: i.a,
            b: i.b,
            model_gains: i.model_gains,
            gains: i.gains,
            ..servo::In::low(&self.servo)
        });
        let net = Net {
            answered: response.w.fresh,
            deviation: corrector.q.correction,
            corrected: corrector.q.corrected,
            torque: servo.w.torque,
            saturated: servo.w.saturated,
            driven: servo.w.fresh,
            position: servo.w.position,
            lost: servo.w.lost,
        };
        (net, Nothing)
    }
}
