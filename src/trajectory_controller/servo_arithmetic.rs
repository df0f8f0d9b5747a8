//! Servo arithmetic: position control 27, speed control 29 and the model torque 30 of servo control
//! 11 (¶0028), one product after the other on one scaler.
//!
//! ```text
//!                         ┌──────────────────┐
//!  step ─────────────────▶│                  ├──▶ torque, saturated
//!  model_…, feedback ────▶│                  ├──▶ fresh, busy
//!  gains, limit, clear ──▶│ servo_arithmetic ├──▶ scale, value, gain ──▶ scaler
//!  done, scaled ─────────▶│                  │◀── scaler
//!                         └──────────────────┘
//! ```
//!
//! 26: position error = model position − feedback. 27: P. 28: speed error = model speed + P − speed,
//! both being ways from step to step: of the model, what it moved in this step, which is its velocity
//! before it; of the motor, what the feedback moved since the step before. 29: PI. 30: model
//! acceleration times the inertia. 31: all three added. Departures: the torque is limited; the
//! integral of 29 stays within the limit, and holds while it would drive the torque farther beyond.

use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Signed, Unsigned};
use crate::signals;

/// Names of the states.
const STATES: &[&str] = &[
    "idle",
    "position",
    "proportional",
    "integral",
    "inertia",
    "limit",
];
const IDLE: u64 = 0;
const POSITION: u64 = 1;
const PROPORTIONAL: u64 = 2;
const INTEGRAL: u64 = 3;
const INERTIA: u64 = 4;
const LIMIT: u64 = 5;

/// Bits behind the torque's last that its sum keeps.
pub const FINE: usize = 4;

/// Bits by which what becomes a torque is shifted up before it is scaled, for gains up to
/// 2^(LEFT − FINE + 1).
pub const LEFT: usize = 6;

signals! {
    /// Ports in.
    pub struct In<
        L,
        const W: usize,
        const P: usize,
        const G: usize,
        const Q: usize,
        const T: usize,
    > {
        /// The model's state is new; not taken while `busy`. All words but the
        /// feedback are constant during a step.
        pub step: L::Bit,
        /// Speed and integral to 0, feedback taken over; a step that is under way is given up.
        pub clear: L::Bit,
        /// Position of the reference model.
        pub model_position: L::I<P>,
        /// Its velocity, in a period.
        pub model_velocity: L::I<P>,
        /// Its acceleration, in a period squared.
        pub model_acceleration: L::I<P>,
        /// Position of the motor in counts; taken over with `step`.
        pub feedback: L::I<W>,
        /// Of 27: speed for a position error, in units of 2^−(G − 1).
        pub position_gain: L::U<G>,
        /// Of 29, proportional: torque for a speed error, in units of 2^(LEFT − FINE − G + 1).
        pub speed_gain: L::U<G>,
        /// Of 29, integral, likewise, a period.
        pub integral_gain: L::U<G>,
        /// Of 30: torque for an acceleration, likewise.
        pub inertia: L::U<G>,
        /// Largest torque, below 2^(T − 1).
        pub limit: L::U<T>,
        /// The scaler is done.
        pub done: L::Bit,
        /// Its result.
        pub scaled: L::U<Q>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const W: usize, const Q: usize, const T: usize> {
        /// What it does.
        state: L::U<3> as States(STATES) = 0,
        /// What is being scaled is negative.
        negative: L::Bit = 0,
        /// The feedback of the last step.
        previous: L::I<W> = 0,
        /// What it moved in that period.
        speed: L::I<W> = 0,
        /// 28: the speed error.
        speed_error: L::I<Q> as Analog = 0,
        /// The parts of 31 so far, with FINE bits behind the torque's last.
        sum: L::I<Q> as Analog = 0,
        /// Integral of 29, likewise.
        integral: L::I<Q> as Analog = 0,
        /// What the period would add to the integral.
        increment: L::I<Q> = 0,
        /// The torque.
        pub torque: L::I<T> as Analog = 0,
        /// It is limited.
        pub saturated: L::Bit = 0,
        /// They are new in this tick.
        pub fresh: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const G: usize, const Q: usize> {
        /// A step is taken.
        take: L::Bit,
        /// A product is there.
        product_there: L::Bit,
        /// The feedback in guard units.
        actual: L::I<Q>,
        /// 26: the position error.
        position_error: L::I<Q>,
        /// The product with its sign.
        product: L::I<Q>,
        /// The model's acceleration.
        change: L::I<Q>,
        /// What the model moved in this step.
        model_way: L::I<Q>,
        /// What the motor moved, in guard units.
        motor_way: L::I<Q>,
        /// 28, when the product of 27 is there.
        speed_demand: L::I<Q>,
        /// What is scaled next.
        operand: L::I<Q>,
        /// Its magnitude.
        size: L::U<Q>,
        /// The scaler begins.
        pub scale: L::Bit,
        /// With this value,
        pub value: L::U<Q>,
        /// by this gain.
        pub gain: L::U<G>,
        /// Largest integral.
        highest: L::I<Q>,
        /// Least integral.
        lowest: L::I<Q>,
        /// The integral with what the period adds.
        grown: L::I<Q>,
        /// The same within the torque's limits.
        held: L::I<Q>,
        /// 31: the whole torque with the fine bits.
        whole: L::I<Q>,
        /// The same to the nearest, a half upwards.
        wanted: L::I<Q>,
        /// Largest torque.
        most: L::I<Q>,
        /// Least torque.
        least: L::I<Q>,
        /// The torque is above the largest.
        above: L::Bit,
        /// It is below the least.
        below_least: L::Bit,
        /// The torque within its limits.
        limited: L::I<Q>,
        /// The integral may take what the period adds.
        integrates: L::Bit,
        /// The torque is limited, and the step ends.
        ends: L::Bit,
        /// A step is not taken.
        pub busy: L::Bit,
    }
}

/// Arithmetic for counts of `W` bits, positions of `P` with P − W guard bits, gains of `G`, torques
/// of `T`; `Q` = `P` + 11 is the word of its sums and of its scaler.
#[derive(Debug, Clone, Default)]
pub struct ServoArithmetic<
    const W: usize,
    const P: usize,
    const G: usize,
    const Q: usize,
    const T: usize,
>;

impl<const W: usize, const P: usize, const G: usize, const Q: usize, const T: usize> Circuit
    for ServoArithmetic<W, P, G, Q, T>
{
    const NAME: &'static str = "servo_arithmetic";
    const ABOUT: &'static str = "position and speed control with the model torque, on one scaler";
    type In<L: Logic> = In<L, W, P, G, Q, T>;
    type Reg<L: Logic> = Reg<L, W, Q, T>;
    type Net<L: Logic> = Net<L, G, Q>;

    fn comb<L: Logic>(&self, q: &Reg<L, W, Q, T>, i: &In<L, W, P, G, Q, T>) -> Net<L, G, Q> {
        const {
            assert!(
                Q == P + 5 + LEFT && Q > T + FINE + 1 && P > W,
                "a product of the speed demand, the integral and the inertia's torque fit"
            )
        };
        let is = |state: u64| q.state.equals(state.into());
        let wide = |word: L::I<P>| -> L::I<Q> { word.resize() };
        let take = i.step & is(IDLE) & !i.clear;
        let (at_position, at_proportional) = (is(POSITION), is(PROPORTIONAL));
        let (at_integral, at_inertia) = (is(INTEGRAL), is(INERTIA));
        let multiplies = at_position | at_proportional | at_integral | at_inertia;
        let product_there = i.done & multiplies & !i.clear;
        let units = |word: L::I<W>| -> L::I<Q> {
            let wide: L::I<Q> = word.resize();
            wide.shift_left(P - W)
        };
        let actual = units(i.feedback);
        let position_error = wide(i.model_position) - actual;
        let signed: L::I<Q> = i.scaled.signed();
        let product = q.negative.mux(-signed, signed);
        let change = wide(i.model_acceleration);
        let model_way = wide(i.model_velocity) - change;
        let motor_way = units(q.speed);
        let speed_demand = model_way + product - motor_way;
        let kept = at_proportional.mux(q.speed_error, change);
        let operand = take.mux(position_error, at_position.mux(speed_demand, kept));
        let size = operand.magnitude();
        let later = at_integral.mux(i.inertia, i.integral_gain);
        let gain = take.mux(i.position_gain, at_position.mux(i.speed_gain, later));
        let limit: L::U<Q> = i.limit.resize();
        let most = limit.signed();
        let least = -most;
        let grown = q.integral + q.increment;
        let (highest, lowest) = (most.shift_left(FINE), least.shift_left(FINE));
        let held = highest.below(grown).mux(highest, grown);
        let held = grown.below(lowest).mux(lowest, held);
        let whole = q.sum + held;
        let wanted = (whole + (1i64 << (FINE - 1))).shift_right(FINE);
        let (above, below_least) = (most.below(wanted), wanted.below(least));
        let rising = !q.speed_error.is_negative() & above;
        let falling = q.speed_error.is_negative() & below_least;
        Net {
            take,
            product_there,
            actual,
            position_error,
            product,
            change,
            model_way,
            motor_way,
            speed_demand,
            operand,
            size,
            scale: take | (product_there & !at_inertia),
            value: take.mux(size, size.shift_left(LEFT)),
            gain,
            highest,
            lowest,
            grown,
            held,
            whole,
            wanted,
            most,
            least,
            above,
            below_least,
            limited: above.mux(most, below_least.mux(least, wanted)),
            integrates: !(rising | falling),
            ends: is(LIMIT) & !i.clear,
            busy: !is(IDLE),
        }
    }

    fn next<L: Logic>(
        &self,
        q: Reg<L, W, Q, T>,
        w: &Net<L, G, Q>,
        i: &In<L, W, P, G, Q, T>,
    ) -> Reg<L, W, Q, T> {
        let is = |state: u64| q.state.equals(state.into());
        let to = |state: u64| -> L::U<3> { state.into() };
        let there = w.product_there;
        let (at_position, at_proportional) = (there & is(POSITION), there & is(PROPORTIONAL));
        let (at_integral, at_inertia) = (there & is(INTEGRAL), there & is(INERTIA));
        let state = w.take.mux(to(POSITION), q.state);
        let state = at_position.mux(to(PROPORTIONAL), state);
        let state = at_proportional.mux(to(INTEGRAL), state);
        let state = at_integral.mux(to(INERTIA), state);
        let state = at_inertia.mux(to(LIMIT), state);
        let state = (w.ends | i.clear).mux(to(IDLE), state);
        let zero = || -> L::I<Q> { 0.into() };
        let sum = at_proportional.mux(w.product, at_inertia.mux(q.sum + w.product, q.sum));
        let integral = (w.ends & w.integrates).mux(w.held, q.integral);
        Reg {
            state,
            negative: w.scale.mux(w.operand.is_negative(), q.negative),
            previous: (w.take | i.clear).mux(i.feedback, q.previous),
            speed: w.take.mux(i.feedback - q.previous, q.speed),
            speed_error: at_position.mux(w.speed_demand, q.speed_error),
            sum,
            integral: i.clear.mux(zero(), integral),
            increment: i.clear.mux(zero(), at_integral.mux(w.product, q.increment)),
            torque: i
                .clear
                .mux(0.into(), w.ends.mux(w.limited.resize(), q.torque)),
            saturated: w.ends.mux(w.above | w.below_least, q.saturated) & !i.clear,
            fresh: w.ends,
        }
    }
}
