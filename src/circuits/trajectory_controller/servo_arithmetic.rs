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
//! 26: position error = model position − feedback. 27: P control. 28: speed error = model speed +
//! output of 27 − motor speed. Both speeds are distances per step: that of the model is its move in
//! this step, which is its velocity before the step; that of the motor is the move of the feedback
//! since the previous step. 29: PI control. 30: model acceleration times the inertia. 31: sum of
//! all three. Departures: the torque is limited; the integral of 29 stays within the limit, and
//! holds while it would drive the torque farther beyond.
//! beyond.

use super::model_state::ModelWidths;
use crate::prelude::*;

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
pub(super) const POSITION: u64 = 1;
const PROPORTIONAL: u64 = 2;
const INTEGRAL: u64 = 3;
pub(super) const INERTIA: u64 = 4;
const LIMIT: u64 = 5;

/// Bits of the sum below the torque's last.
pub const FINE: usize = 4;

/// Bits by which a value is shifted up before it is scaled to a torque, for gains up to 2^(LEFT −
/// FINE + 1).
pub const LEFT: usize = 6;

/// Widths of a servo control in bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ServoWidths {
    /// W: positions of the motor in counts, signed.
    pub count: usize,
    /// P: positions in guard units, signed, with P − W guard bits.
    pub position: usize,
    /// K: gains of the reference model, with K − 1 fraction bits.
    pub model_gain: usize,
    /// G: gains of the loops; that of the position has G − 1 fraction bits.
    pub gain: usize,
    /// T: torques, signed.
    pub torque: usize,
}

impl ServoWidths {
    /// Bits of a position below the count.
    #[must_use]
    pub const fn guard(&self) -> usize {
        self.position.saturating_sub(self.count)
    }

    /// Width of the arithmetic's sums, and of its scaler's values.
    #[must_use]
    pub const fn product(&self) -> usize {
        self.position + 5 + LEFT
    }

    /// Widths of the reference model.
    #[must_use]
    pub const fn model(&self) -> ModelWidths {
        ModelWidths {
            position: self.position,
            gain: self.model_gain,
        }
    }
}

signals! { for ServoWidths as c;
    /// Gains of a servo control's loops.
    pub struct ServoGains {
        /// Gain of 27: speed per position error, in units of 2^−(G − 1).
        pub position_gain: U(c.gain),
        /// Proportional gain of 29: torque per speed error, in units of 2^(LEFT − FINE − G + 1).
        pub speed_gain: U(c.gain),
        /// Integral gain of 29, per period; in the unit of `speed_gain`.
        pub integral_gain: U(c.gain),
        /// Gain of 30: torque per acceleration, in the unit of `speed_gain`.
        pub inertia: U(c.gain),
        /// Largest torque, below 2^(T − 1).
        pub limit: U(c.torque),
    }
}

/// Arithmetic of a servo control.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ServoArithmetic {
    /// The servo control's widths.
    pub widths: ServoWidths,
}

signals! { for ServoArithmetic as c;
    /// Input ports.
    pub struct In {
        /// The state of the model is new; ignored while `busy`. All inputs but the feedback are
        /// constant during a step.
        pub step: Bit,
        /// Clears integral and torque, and takes over the feedback as that of the last step; aborts
        /// a running step.
        pub clear: Bit,
        /// Position of the reference model, in guard units.
        pub model_position: I(c.widths.position, c.widths.guard()) as Analog,
        /// Velocity of the reference model, per period.
        pub model_velocity: I(c.widths.position, c.widths.guard()),
        /// Acceleration of the reference model, per period squared.
        pub model_acceleration: I(c.widths.position, c.widths.guard()),
        /// Position of the motor in counts; sampled with `step`.
        pub feedback: I(c.widths.count),
        /// Gains of the loops.
        pub gains: ServoGains(&c.widths) as Flat,
        /// The scaler has a result.
        pub done: Bit,
        /// Result of the scaler.
        pub scaled: U(c.widths.product()),
    }
    /// Flip-flops.
    pub struct Reg {
        /// State of the sequence.
        pub(super) state: U(3) as States(STATES) = 0,
        /// The value being scaled is negative.
        negative: Bit = 0,
        /// Feedback of the last step.
        previous: I(c.widths.count) = 0,
        /// Move of the feedback in the last step, in counts.
        speed: I(c.widths.count) = 0,
        /// 28: speed error, in guard units per step.
        pub(super) speed_error: I(c.widths.product()) as Analog = 0,
        /// Sum of the parts of 31 so far, with FINE bits below the torque's lowest bit.
        sum: I(c.widths.product()) as Analog = 0,
        /// Integral of 29, with FINE bits below the torque's lowest bit.
        integral: I(c.widths.product()) as Analog = 0,
        /// Change of the integral in this step.
        increment: I(c.widths.product()) = 0,
        /// Torque command.
        pub torque: I(c.widths.torque) as Analog = 0,
        /// The torque is limited.
        pub saturated: Bit = 0,
        /// High for one tick: the torque has a new value.
        pub fresh: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// A step is accepted.
        take: Bit,
        /// A product is ready.
        product_there: Bit,
        /// Feedback in guard units.
        actual: I(c.widths.product()),
        /// 26: position error, in guard units.
        position_error: I(c.widths.product(), c.widths.guard()) as Analog,
        /// Result of the scaler with its sign.
        product: I(c.widths.product()),
        /// Acceleration of the model.
        change: I(c.widths.product()),
        /// Move of the model in this step, in guard units.
        model_way: I(c.widths.product()),
        /// Move of the motor in this step, in guard units.
        motor_way: I(c.widths.product()),
        /// 28: speed error; valid when the product of 27 is ready.
        speed_demand: I(c.widths.product()),
        /// Next value to scale.
        operand: I(c.widths.product()),
        /// Magnitude of the next value to scale.
        size: U(c.widths.product()),
        /// Starts the scaler.
        pub scale: Bit,
        /// Value for the scaler.
        pub value: U(c.widths.product()),
        /// Gain for the scaler.
        pub gain: U(c.widths.gain),
        /// Largest integral.
        highest: I(c.widths.product()),
        /// Lowest integral.
        lowest: I(c.widths.product()),
        /// Integral plus increment.
        grown: I(c.widths.product()),
        /// `grown`, limited to the range of the integral.
        held: I(c.widths.product()),
        /// 31: sum of all parts, with FINE bits below the torque's lowest bit.
        whole: I(c.widths.product()),
        /// `whole`, rounded to the nearest torque word; halves round up.
        wanted: I(c.widths.product()),
        /// Largest torque.
        most: I(c.widths.product()),
        /// Lowest torque.
        least: I(c.widths.product()),
        /// The torque is above the largest.
        above: Bit,
        /// The torque is below the lowest.
        below_least: Bit,
        /// Torque within its limits.
        limited: I(c.widths.product()),
        /// The integral takes the increment.
        integrates: Bit,
        /// The torque is limited and output, and the step ends.
        ends: Bit,
        /// A step is running; another one is ignored.
        pub busy: Bit,
    }
}

impl Circuit for ServoArithmetic {
    const NAME: &'static str = "servo_arithmetic";
    const ABOUT: &'static str = "position and speed control with the model torque, on one scaler";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        let (count, position) = (self.widths.count, self.widths.position);
        let (sum, torque) = (self.widths.product(), self.widths.torque);
        let fits = sum > torque + FINE + 1 && position > count;
        (!fits).then(|| {
            format!(
                "positions of {position} bits are to have guard bits behind counts of {count}, \
                 and sums of {sum} are to hold torques of {torque} with their fine bits"
            )
        })
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let guard = self.widths.position - self.widths.count;
        let wide = |word: I| word.resize(self.widths.product());
        let units = |counts: I| wide(counts).shift_left(guard);
        let is = |state: u64| q.state.equals(state);
        let take = i.step & is(IDLE) & !i.clear;
        let multiplies = is(POSITION) | is(PROPORTIONAL) | is(INTEGRAL) | is(INERTIA);
        let product_there = i.done & multiplies & !i.clear;
        let actual = units(i.feedback);
        let position_error = wide(i.model_position) - actual;
        let product = i.scaled.signed().negated_by(q.negative);
        let change = wide(i.model_acceleration);
        let model_way = wide(i.model_velocity) - change;
        let motor_way = units(q.speed);
        let speed_demand = model_way + product - motor_way;
        let kept = is(PROPORTIONAL).mux(q.speed_error, change);
        let operand = take.mux(position_error, is(POSITION).mux(speed_demand, kept));
        let size = operand.magnitude();
        let scale = take | (product_there & !is(INERTIA));
        let later = is(INTEGRAL).mux(i.gains.inertia, i.gains.integral_gain);
        let later = is(POSITION).mux(i.gains.speed_gain, later);
        let gain = take.mux(i.gains.position_gain, later);

        let most = i.gains.limit.resize(self.widths.product()).signed();
        let least = -most;
        let grown = q.integral + q.increment;
        let (highest, lowest) = (most.shift_left(FINE), least.shift_left(FINE));
        let held = highest.below(grown).mux(highest, grown);
        let held = grown.below(lowest).mux(lowest, held);
        let whole = q.sum + held;
        let wanted = (whole + (1i64 << (FINE - 1))).shift_right(FINE);
        let (above, below_least) = (most.below(wanted), wanted.below(least));
        let limited = above.mux(most, below_least.mux(least, wanted));
        let rising = !q.speed_error.is_negative() & above;
        let falling = q.speed_error.is_negative() & below_least;
        let integrates = !(rising | falling);
        let ends = is(LIMIT) & !i.clear;

        let there = |state: u64| product_there & is(state);
        let state = take.mux(POSITION, q.state);
        let state = there(POSITION).mux(PROPORTIONAL, state);
        let state = there(PROPORTIONAL).mux(INTEGRAL, state);
        let state = there(INTEGRAL).mux(INERTIA, state);
        let state = there(INERTIA).mux(LIMIT, state);
        let added = there(INERTIA).mux(q.sum + product, q.sum);
        let increment = there(INTEGRAL).mux(product, q.increment);
        let next = Reg {
            state: (ends | i.clear).mux(IDLE, state),
            negative: scale.mux(operand.is_negative(), q.negative),
            previous: (take | i.clear).mux(i.feedback, q.previous),
            speed: take.mux(i.feedback - q.previous, q.speed),
            speed_error: there(POSITION).mux(speed_demand, q.speed_error),
            sum: there(PROPORTIONAL).mux(product, added),
            integral: i.clear.mux(0, (ends & integrates).mux(held, q.integral)),
            increment: i.clear.mux(0, increment),
            torque: i
                .clear
                .mux(0, ends.mux(limited.resize(self.widths.torque), q.torque)),
            saturated: ends.mux(above | below_least, q.saturated) & !i.clear,
            fresh: ends,
        };
        let net = Net {
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
            scale,
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
            limited,
            integrates,
            ends,
            busy: !is(IDLE),
        };
        (net, next)
    }
}
