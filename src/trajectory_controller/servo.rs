//! Servo control 11 of one axis (Fig. 2): reference model 12, and the loops that hold the motor to it.
//!
//! ```text
//!                       ┌───────────────────────────┐
//!  step, preset ───────▶│ reference model 12        ├──▶ torque, saturated, fresh
//!  target ─────────────▶│   ▶ servo_arithmetic      ├──▶ position, lost
//!  a, b ───────────────▶│     ◀▶ scaler             │
//!  gains, inertia, … ──▶│   ◀ quadrature counter    │
//!                       └───────────────────────────┘
//! ```

use super::{
    ReferenceModel, Rounding, Scaler, ServoArithmetic, reference_model, scaler, servo_arithmetic,
};
use crate::blocks::{QuadratureCounter, quadrature_counter};
use crate::kernel::{Circuit, Instance};
use crate::logic::Logic;
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const P: usize, const K: usize, const G: usize, const T: usize> {
        /// The corrected command is new.
        pub step: L::Bit,
        /// Between two paths: the model at the target, at rest; the loops begin anew.
        pub preset: L::Bit,
        /// Pd: the corrected position command in guard units; constant during a step.
        pub target: L::I<P>,
        /// Encoder, channel A.
        pub a: L::Bit,
        /// Channel B.
        pub b: L::Bit,
        /// The counter to 0.
        pub home: L::Bit,
        /// K1, see [`reference_model::In`].
        pub gain_1: L::U<K>,
        /// K2.
        pub gain_2: L::U<K>,
        /// Of 27, see [`servo_arithmetic::In`].
        pub position_gain: L::U<G>,
        /// Of 29, proportional.
        pub speed_gain: L::U<G>,
        /// Of 29, integral.
        pub integral_gain: L::U<G>,
        /// Of 30.
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
        /// Reference model 12.
        pub model: reference_model::Reg<L, P, K, M>,
        /// Position of the motor.
        pub detector: quadrature_counter::Reg<L, W>,
        /// 26 to 31.
        pub arithmetic: servo_arithmetic::Reg<L, W, Q, T>,
        /// Its products.
        pub scaler: scaler::Reg<L, G, Q>,
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
        /// Reference model 12.
        pub model: Instance<ReferenceModel<P, K, M>, L>,
        /// Position of the motor.
        pub detector: Instance<QuadratureCounter<W>, L>,
        /// 26 to 31.
        pub arithmetic: Instance<ServoArithmetic<W, P, G, Q, T>, L>,
        /// Its products.
        pub scaler: Instance<Scaler<G, Q>, L>,
        /// The torque.
        pub torque: L::I<T> as Analog,
        /// It is limited.
        pub saturated: L::Bit,
        /// The torque is new in this tick.
        pub fresh: L::Bit,
        /// Position of the motor in counts.
        pub position: L::I<W> as Analog,
        /// The encoder was too fast since `home`.
        pub lost: L::Bit,
    }
}

/// Servo control with counts of `W` bits, points of `P`, gains of the model of `K` and of the loops
/// of `G`, torques of `T`; `M` = P + K + 1 and `Q` = P + 11 are the words of its products.
#[derive(Debug, Clone, Default)]
pub struct Servo<
    const W: usize,
    const P: usize,
    const K: usize,
    const M: usize,
    const G: usize,
    const Q: usize,
    const T: usize,
> {
    /// Reference model 12.
    pub model: ReferenceModel<P, K, M>,
    /// Position of the motor.
    pub detector: QuadratureCounter<W>,
    /// 26 to 31.
    pub arithmetic: ServoArithmetic<W, P, G, Q, T>,
    /// Its products.
    pub scaler: Scaler<G, Q>,
}

impl<
    const W: usize,
    const P: usize,
    const K: usize,
    const M: usize,
    const G: usize,
    const Q: usize,
    const T: usize,
> Servo<W, P, K, M, G, Q, T>
{
    /// Ticks from `step` to `fresh`.
    pub const LATENCY: u64 = ReferenceModel::<P, K, M>::LATENCY + 4 * Scaler::<G, Q>::LATENCY + 2;

    /// A servo control whose model rounds by `rounding`.
    pub fn new(rounding: Rounding) -> Self {
        Servo {
            model: ReferenceModel::new(rounding),
            ..Default::default()
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
> Circuit for Servo<W, P, K, M, G, Q, T>
{
    const NAME: &'static str = "servo";
    const ABOUT: &'static str = "reference model, position and speed control of an axis";
    type In<L: Logic> = In<L, P, K, G, T>;
    type Reg<L: Logic> = Reg<L, W, P, K, M, G, Q, T>;
    type Net<L: Logic> = Net<L, W, P, K, M, G, Q, T>;

    fn comb<L: Logic>(&self, q: &Self::Reg<L>, i: &Self::In<L>) -> Self::Net<L> {
        let model = Instance::settle(
            &self.model,
            &q.model,
            reference_model::In {
                step: i.step,
                preset: i.preset,
                target: i.target,
                gain_1: i.gain_1,
                gain_2: i.gain_2,
            },
        );
        let detector = Instance::settle(
            &self.detector,
            &q.detector,
            quadrature_counter::In {
                a: i.a,
                b: i.b,
                clear: i.home,
            },
        );
        let arithmetic = Instance::settle(
            &self.arithmetic,
            &q.arithmetic,
            servo_arithmetic::In {
                step: model.w.fresh,
                clear: i.preset,
                model_position: model.w.position,
                model_velocity: model.w.velocity,
                model_acceleration: model.w.acceleration,
                feedback: q.detector.position,
                position_gain: i.position_gain,
                speed_gain: i.speed_gain,
                integral_gain: i.integral_gain,
                inertia: i.inertia,
                limit: i.limit,
                done: q.scaler.done,
                scaled: q.scaler.scaled,
            },
        );
        let scaler = Instance::settle(
            &self.scaler,
            &q.scaler,
            scaler::In {
                start: arithmetic.w.scale,
                clear: i.preset,
                value: arithmetic.w.value,
                gain: arithmetic.w.gain,
            },
        );
        Net {
            torque: q.arithmetic.torque,
            saturated: q.arithmetic.saturated,
            fresh: q.arithmetic.fresh,
            position: q.detector.position,
            lost: q.detector.lost,
            model,
            detector,
            arithmetic,
            scaler,
        }
    }

    fn next<L: Logic>(&self, q: Self::Reg<L>, w: &Self::Net<L>, _: &Self::In<L>) -> Self::Reg<L> {
        Reg {
            model: w.model.next(&self.model, q.model),
            detector: w.detector.next(&self.detector, q.detector),
            arithmetic: w.arithmetic.next(&self.arithmetic, q.arithmetic),
            scaler: w.scaler.next(&self.scaler, q.scaler),
        }
    }
}
