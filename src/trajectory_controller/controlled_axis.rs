//! One axis of the trajectory controller: servo response 51, vector correction 4, servo control 11.
//!
//! ```text
//!                        ┌──────────────────────────┐
//!  step, preset, command ▶│ response ▶ correction    ├──▶ torque, saturated
//!  correct, reference ──▶│            ▶ servo       ├──▶ answered, driven
//!  a, b, gains… ────────▶│                          ├──▶ position, lost
//!                        └──────────────────────────┘
//! ```

use super::vector_correction::Correction;
use super::{
    ReferenceModel, Rounding, Servo, VectorCorrection, reference_model, servo, vector_correction,
};
use crate::kernel::{Circuit, Instance};
use crate::logic::Logic;
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const P: usize, const K: usize, const G: usize, const T: usize> {
        /// The position command is new.
        pub step: L::Bit,
        /// The servo response goes to it at once, at rest; beats a step of its tick.
        pub preset: L::Bit,
        /// Pc: the position command.
        pub command: L::I<P>,
        /// The reference point stands, and the responses.
        pub correct: L::Bit,
        /// Pr: the reference point.
        pub target: L::I<P>,
        /// Encoder, channel A.
        pub a: L::Bit,
        /// Channel B.
        pub b: L::Bit,
        /// K1, the same for all axes, see [`reference_model::In`].
        pub gain_1: L::U<K>,
        /// K2.
        pub gain_2: L::U<K>,
        /// Of the position control 27.
        pub position_gain: L::U<G>,
        /// Of the speed control 29, proportional.
        pub speed_gain: L::U<G>,
        /// Integral.
        pub integral_gain: L::U<G>,
        /// Of the feed-forward 30.
        pub inertia: L::U<G>,
        /// Largest torque.
        pub limit: L::U<T>,
    }
}

signals! {
    /// Registers of the blocks.
    pub struct Reg<
        L,
        const W: usize,
        const P: usize,
        const K: usize,
        const M: usize,
        const G: usize,
        const Q: usize,
        const T: usize,
    > {
        /// Servo response 51, 52.
        pub response: reference_model::Reg<L, P, K, M>,
        /// Vector correction 4.
        pub corrector: vector_correction::Reg<L, P>,
        /// Servo control 6, 7 (11).
        pub servo: servo::Reg<L, W, P, K, M, G, Q, T>,
    }
}

signals! {
    /// Nets of the blocks, and the ports out.
    pub struct Net<
        L,
        const W: usize,
        const P: usize,
        const K: usize,
        const M: usize,
        const G: usize,
        const Q: usize,
        const T: usize,
    > {
        /// Servo response 51, 52.
        pub response: Instance<ReferenceModel<P, K, M>, L>,
        /// Vector correction 4.
        pub corrector: Instance<VectorCorrection<P>, L>,
        /// Servo control 6, 7 (11).
        pub servo: Instance<Servo<W, P, K, M, G, Q, T>, L>,
        /// The servo response stands in this tick.
        pub answered: L::Bit,
        /// E: the correction.
        pub deviation: L::I<P> as Analog,
        /// Pd: the corrected command.
        pub corrected: L::I<P> as Analog,
        /// The torque.
        pub torque: L::I<T> as Analog,
        /// It is limited.
        pub saturated: L::Bit,
        /// The torque is new in this tick.
        pub driven: L::Bit,
        /// Position of the motor in counts.
        pub position: L::I<W> as Analog,
        /// The encoder was too fast.
        pub lost: L::Bit,
    }
}

/// Axis with the widths of [`Servo`].
#[derive(Debug, Clone, Default)]
pub struct ControlledAxis<
    const W: usize,
    const P: usize,
    const K: usize,
    const M: usize,
    const G: usize,
    const Q: usize,
    const T: usize,
> {
    /// Servo response 51, 52.
    pub response: ReferenceModel<P, K, M>,
    /// Vector correction 4.
    pub corrector: VectorCorrection<P>,
    /// Servo control 6, 7 (11).
    pub servo: Servo<W, P, K, M, G, Q, T>,
}

impl<
    const W: usize,
    const P: usize,
    const K: usize,
    const M: usize,
    const G: usize,
    const Q: usize,
    const T: usize,
> ControlledAxis<W, P, K, M, G, Q, T>
{
    /// An axis whose commands are corrected so, and whose models round so.
    pub fn new(correction: Correction, rounding: Rounding) -> Self {
        ControlledAxis {
            response: ReferenceModel::new(rounding),
            corrector: VectorCorrection { correction },
            servo: Servo::new(rounding),
        }
    }
}

impl<
    const W: usize,
    const P: usize,
    const K: usize,
    const M: usize,
    const G: usize,
    const Q: usize,
    const T: usize,
> Circuit for ControlledAxis<W, P, K, M, G, Q, T>
{
    const NAME: &'static str = "controlled_axis";
    const ABOUT: &'static str = "servo response, vector correction and servo control of an axis";
    type In<L: Logic> = In<L, P, K, G, T>;
    type Reg<L: Logic> = Reg<L, W, P, K, M, G, Q, T>;
    type Net<L: Logic> = Net<L, W, P, K, M, G, Q, T>;

    fn comb<L: Logic>(&self, q: &Self::Reg<L>, i: &Self::In<L>) -> Self::Net<L> {
        let response = Instance::settle(
            &self.response,
            &q.response,
            reference_model::In {
                step: i.step,
                preset: i.preset,
                target: i.command,
                gain_1: i.gain_1,
                gain_2: i.gain_2,
            },
        );
        let corrector = Instance::settle(
            &self.corrector,
            &q.corrector,
            vector_correction::In {
                correct: i.correct,
                target: i.target,
                response: response.w.position,
                command: i.command,
            },
        );
        let servo = Instance::settle(
            &self.servo,
            &q.servo,
            servo::In {
                step: q.corrector.fresh,
                preset: false.into(),
                target: q.corrector.corrected,
                a: i.a,
                b: i.b,
                home: false.into(),
                gain_1: i.gain_1,
                gain_2: i.gain_2,
                position_gain: i.position_gain,
                speed_gain: i.speed_gain,
                integral_gain: i.integral_gain,
                inertia: i.inertia,
                limit: i.limit,
            },
        );
        Net {
            answered: response.w.fresh,
            deviation: q.corrector.correction,
            corrected: q.corrector.corrected,
            torque: servo.w.torque,
            saturated: servo.w.saturated,
            driven: servo.w.fresh,
            position: servo.w.position,
            lost: servo.w.lost,
            response,
            corrector,
            servo,
        }
    }

    fn next<L: Logic>(&self, q: Self::Reg<L>, w: &Self::Net<L>, _: &Self::In<L>) -> Self::Reg<L> {
        Reg {
            response: w.response.next(&self.response, q.response),
            corrector: w.corrector.next(&self.corrector, q.corrector),
            servo: w.servo.next(&self.servo, q.servo),
        }
    }
}
