//! Reference model 12 (¶0027, equation (2)): what the servo system will answer to a position command.
//!
//! ```text
//!                  ┌─────────────────┐
//!  step, preset ──▶│                 ├──▶ position, velocity, acceleration
//!  target ────────▶│ reference_model ├──▶ fresh, busy
//!  gain_1, gain_2 ▶│                 │
//!                  └─────────────────┘
//! ```
//!
//! The same circuit is the servo response of an axis 51, 52, the tangential servo response 50, and
//! the model 12 inside a servo control 11: all of them are the same to the bit (¶0030).

use super::{ModelState, Rounding, Scaler, model_state, scaler};
use crate::kernel::{Circuit, Instance};
use crate::logic::Logic;
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const P: usize, const K: usize> {
        /// An interpolation period begins; not taken while `busy`.
        pub step: L::Bit,
        /// Position at the target, at rest; a step that is under way is given up.
        pub preset: L::Bit,
        /// u: where it is to go, taken with `step`.
        pub target: L::I<P>,
        /// K1, in units of 2^−(K − 1) a period; constant during a step.
        pub gain_1: L::U<K>,
        /// K2, likewise.
        pub gain_2: L::U<K>,
    }
}

signals! {
    /// Registers of the blocks.
    pub struct Reg<L, const P: usize, const K: usize, const Q: usize> {
        /// 20, 22, 24, 25.
        pub integrators: model_state::Reg<L, P>,
        /// 21, 23.
        pub scaler: scaler::Reg<L, K, Q>,
    }
}

signals! {
    /// Nets of the blocks, and the ports out.
    pub struct Net<L, const P: usize, const K: usize, const Q: usize> {
        /// 20, 22, 24, 25.
        pub integrators: Instance<ModelState<P, K, Q>, L>,
        /// 21, 23.
        pub scaler: Instance<Scaler<K, Q>, L>,
        /// p: the model's position.
        pub position: L::I<P> as Analog,
        /// v: its velocity, in a period.
        pub velocity: L::I<P> as Analog,
        /// a: its acceleration, in a period squared.
        pub acceleration: L::I<P> as Analog,
        /// They are new in this tick.
        pub fresh: L::Bit,
        /// A step is not taken.
        pub busy: L::Bit,
    }
}

/// Reference model with positions of `P` bits and gains of `K`; `Q` = `P` + `K` + 1.
#[derive(Debug, Clone, Default)]
pub struct ReferenceModel<const P: usize, const K: usize, const Q: usize> {
    /// 20, 22, 24, 25.
    pub integrators: ModelState<P, K, Q>,
    /// 21, 23.
    pub scaler: Scaler<K, Q>,
}

impl<const P: usize, const K: usize, const Q: usize> ReferenceModel<P, K, Q> {
    /// Ticks from `step` to `fresh`.
    pub const LATENCY: u64 = 2 * Scaler::<K, Q>::LATENCY + 1;

    /// A model whose acceleration is rounded by `rounding`.
    pub fn new(rounding: Rounding) -> Self {
        ReferenceModel {
            integrators: ModelState { rounding },
            scaler: Scaler,
        }
    }
}

impl<const P: usize, const K: usize, const Q: usize> Circuit for ReferenceModel<P, K, Q> {
    const NAME: &'static str = "reference_model";
    const ABOUT: &'static str = "what the servo system will answer to a position command";
    type In<L: Logic> = In<L, P, K>;
    type Reg<L: Logic> = Reg<L, P, K, Q>;
    type Net<L: Logic> = Net<L, P, K, Q>;

    fn comb<L: Logic>(&self, q: &Reg<L, P, K, Q>, i: &In<L, P, K>) -> Net<L, P, K, Q> {
        let integrators = Instance::settle(
            &self.integrators,
            &q.integrators,
            model_state::In {
                step: i.step,
                preset: i.preset,
                target: i.target,
                gain_1: i.gain_1,
                gain_2: i.gain_2,
                done: q.scaler.done,
                scaled: q.scaler.scaled,
            },
        );
        let scaler = Instance::settle(
            &self.scaler,
            &q.scaler,
            scaler::In {
                start: integrators.w.scale,
                clear: i.preset,
                value: integrators.w.value,
                gain: integrators.w.gain,
            },
        );
        Net {
            position: q.integrators.position,
            velocity: q.integrators.velocity,
            acceleration: q.integrators.acceleration,
            fresh: q.integrators.fresh,
            busy: integrators.w.busy,
            integrators,
            scaler,
        }
    }

    fn next<L: Logic>(
        &self,
        q: Reg<L, P, K, Q>,
        w: &Net<L, P, K, Q>,
        _: &In<L, P, K>,
    ) -> Reg<L, P, K, Q> {
        Reg {
            integrators: w.integrators.next(&self.integrators, q.integrators),
            scaler: w.scaler.next(&self.scaler, q.scaler),
        }
    }
}
