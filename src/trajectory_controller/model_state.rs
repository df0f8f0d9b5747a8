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
//! put back, so what is mirrored is answered by what is mirrored.

use super::Rounding;
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Signed, Unsigned};
use crate::signals;

/// Names of the states.
const STATES: &[&str] = &["idle", "first_gain", "second_gain"];
const IDLE: u64 = 0;
const FIRST: u64 = 1;
const SECOND: u64 = 2;

signals! {
    /// Ports in.
    pub struct In<L, const P: usize, const K: usize, const Q: usize> {
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
        /// The scaler is done.
        pub done: L::Bit,
        /// Its result.
        pub scaled: L::U<Q>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const P: usize> {
        /// What it does.
        state: L::U<2> as States(STATES) = 0,
        /// u − p is negative; then the same of K1(u − p) − v.
        negative: L::Bit = 0,
        /// p: the model's position.
        pub position: L::I<P> as Analog = 0,
        /// v: its velocity, in a period.
        pub velocity: L::I<P> as Analog = 0,
        /// a: its acceleration, in a period squared.
        pub acceleration: L::I<P> as Analog = 0,
        /// They are new in this tick.
        pub fresh: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const P: usize, const K: usize, const Q: usize> {
        /// A step is taken.
        take: L::Bit,
        /// The first product is there.
        second: L::Bit,
        /// The second product is there.
        complete: L::Bit,
        /// 20: u − p.
        error: L::I<P>,
        /// K1(u − p), with K − 1 bits of fraction.
        demand: L::I<Q>,
        /// v likewise.
        motion: L::I<Q>,
        /// 22: K1(u − p) − v, with the fraction.
        difference: L::I<Q>,
        /// The scaler begins.
        pub scale: L::Bit,
        /// With this value,
        pub value: L::U<Q>,
        /// by this gain.
        pub gain: L::U<K>,
        /// The product with what rounds it.
        raised: L::U<Q>,
        /// The same without its fraction.
        cut: L::U<Q>,
        /// |a|.
        amount: L::I<P>,
        /// a.
        change: L::I<P>,
        /// A step is not taken.
        pub busy: L::Bit,
    }
}

/// State of a reference model with positions of `P` bits and gains of `K`; `Q` = `P` + `K` + 1 is the
/// word of its scaler.
#[derive(Debug, Clone, Default)]
pub struct ModelState<const P: usize, const K: usize, const Q: usize> {
    /// How the acceleration is rounded.
    pub rounding: Rounding,
}

/// `word`, or its negative.
fn signed_by<L: Logic, const N: usize>(negative: L::Bit, word: L::I<N>) -> L::I<N> {
    negative.mux(-word, word)
}

impl<const P: usize, const K: usize, const Q: usize> Circuit for ModelState<P, K, Q> {
    const NAME: &'static str = "model_state";
    const ABOUT: &'static str = "position and velocity of the reference model, around its scaler";
    type In<L: Logic> = In<L, P, K, Q>;
    type Reg<L: Logic> = Reg<L, P>;
    type Net<L: Logic> = Net<L, P, K, Q>;

    fn comb<L: Logic>(&self, q: &Reg<L, P>, i: &In<L, P, K, Q>) -> Net<L, P, K, Q> {
        const {
            assert!(
                Q == P + K + 1,
                "a product with its fraction, and a difference of two"
            )
        };
        let is = |state: u64| q.state.equals(state.into());
        let take = i.step & is(IDLE) & !i.preset;
        let second = i.done & is(FIRST) & !i.preset;
        let complete = i.done & is(SECOND) & !i.preset;
        let error = i.target - q.position;
        let demand = signed_by::<L, Q>(q.negative, i.scaled.signed());
        let wide: L::I<Q> = q.velocity.resize();
        let motion = wide.shift_left(K - 1);
        let difference = demand - motion;
        let whole: L::U<Q> = error.magnitude().resize();
        let raised = match self.rounding {
            Rounding::Nearest => i.scaled + (1u64 << (K - 2)),
            Rounding::Floor => i.scaled,
        };
        let cut = raised.shift_right(K - 1);
        let amount: L::I<P> = cut.signed().resize();
        Net {
            take,
            second,
            complete,
            error,
            demand,
            motion,
            difference,
            scale: take | second,
            value: second.mux(difference.magnitude(), whole.shift_left(K - 1)),
            gain: second.mux(i.gain_2, i.gain_1),
            raised,
            cut,
            amount,
            change: signed_by::<L, P>(q.negative, amount),
            busy: !is(IDLE),
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, P>, w: &Net<L, P, K, Q>, i: &In<L, P, K, Q>) -> Reg<L, P> {
        let to = |state: u64| -> L::U<2> { state.into() };
        let state = w.take.mux(to(FIRST), q.state);
        let state = w.second.mux(to(SECOND), state);
        let state = (w.complete | i.preset).mux(to(IDLE), state);
        let negative = w.take.mux(w.error.is_negative(), q.negative);
        let position = w.complete.mux(q.position + q.velocity, q.position);
        let velocity = w.complete.mux(q.velocity + w.change, q.velocity);
        let acceleration = w.complete.mux(w.change, q.acceleration);
        Reg {
            state,
            negative: w.second.mux(w.difference.is_negative(), negative),
            position: i.preset.mux(i.target, position),
            velocity: i.preset.mux(0.into(), velocity),
            acceleration: i.preset.mux(0.into(), acceleration),
            fresh: w.complete | i.preset,
        }
    }
}
