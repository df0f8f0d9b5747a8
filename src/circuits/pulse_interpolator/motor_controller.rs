//! Motor controller 5 of the conventional device (¶0003–0004): computes for every unit time the
//! steps of each axis, and from these the length of its pulses.
//!
//! ```text
//!                       ┌──────────────────┐
//!  command, delta… ────▶│                  ├──▶ ready, prepared, busy, late
//!  units, period ──────▶│ motor controller ├──▶ unit_period
//!  unit_rst ───────────▶│                  ├──▶ amount, half_period, down of each axis
//!                       └──┬────────────▲──┘
//!    start, dividend, addend, divisor   │ done, quotient, remainder
//!                       ┌──▼────────────┴──┐
//!                       │ divider          │
//!                       └──────────────────┘
//! ```
//!
//! A move is a straight line of U unit times. For each axis in turn, a divider computes
//!
//! ```text
//! amount, rest <= (|delta| + rest) / U, remainder     rest = U/2 at the start of a move
//! half_period   = T / (2 · amount), at most the greatest word
//! ```
//!
//! so after u units an axis has gone |delta|·u/U, rounded, and ends exactly. The results for a
//! unit are held until the RST that begins it.
//!
//! The text does not say how the controller computes. This is the cheapest way to make a line.
//! Arcs come from a [circular interpolator](super::circular_interpolator), other curves as short
//! lines, whose points the computer 7 computes.

use super::{AXES_MAX, AXIS_NAMES};
use crate::circuits::blocks::MulDiv;
use crate::prelude::*;

/// Names of the states.
const STATES: &[&str] = &["wait", "amount", "length", "prepared"];
const WAIT: u64 = 0;
const AMOUNT: u64 = 1;
const LENGTH: u64 = 2;
const PREPARED: u64 = 3;

/// Widths of the conventional device in bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ConventionalWidths {
    /// Steps of a move, without their sign.
    pub distance: usize,
    /// A number of unit times.
    pub units: usize,
    /// A half-period.
    pub half_period: usize,
    /// T, the unit time.
    pub period: usize,
}

impl Default for ConventionalWidths {
    fn default() -> Self {
        ConventionalWidths {
            distance: 16,
            units: 16,
            half_period: 16,
            period: 24,
        }
    }
}

impl ConventionalWidths {
    /// Width of the divider's words: a sum, T, twice an amount, and a quotient above the greatest
    /// half-period have room.
    pub fn divider(&self) -> usize {
        let words = [self.distance + 3, self.units + 2, self.half_period + 1];
        words.into_iter().fold(self.period, usize::max)
    }
}

/// Motor controller 5 of 1 to 8 axes.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MotorController {
    /// Number of axes.
    pub axes: usize,
    /// Word widths.
    pub widths: ConventionalWidths,
}

impl MotorController {
    /// The divider that it wants: the multiplier is 1.
    pub fn divider(&self) -> MulDiv {
        MulDiv::new(1, self.widths.divider())
    }

    /// The shortest unit time in ticks in which the next is prepared, where a new move begins.
    pub fn least_period(&self) -> u64 {
        // Two divisions an axis, each handed on in a tick of its own.
        3 + 2 * self.axes as u64 * (self.divider().latency() + 1)
    }
}

signals! { for MotorController as c;
    /// A move, from the computer 7.
    pub struct Move {
        /// Gives a move: `units`, `period` and the steps of all axes are valid.
        pub command: Bit,
        /// Signed steps of the move on this axis.
        pub delta: [I(c.widths.distance + 1); c.axes] as Elements(DELTA),
        /// U: number of unit times of the move; a move with 0 is dropped.
        pub units: U(c.widths.units),
        /// Unit time T of the move, in ticks.
        pub period: U(c.widths.period),
    }
    /// Input ports.
    pub struct In {
        /// Move from the computer 7.
        pub order: Move(c) as Flat,
        /// RST: high in the last tick of the unit time. The prepared unit time is taken over.
        pub unit_rst: Bit,
        /// The divider has a result.
        pub done: Bit,
        /// Quotient from the divider.
        pub quotient: U(c.widths.divider()),
        /// Remainder from the divider.
        pub remainder: U(c.widths.divider()),
    }
    /// Words of an axis.
    pub struct Words {
        /// Signed steps of the waiting move.
        pending_delta: I(c.widths.distance + 1),
        /// Magnitude of the steps of the running move.
        distance: U(c.widths.distance + 1),
        /// Direction of the running move; high counts down.
        pub down: Bit,
        /// Remainder of the division, for the next unit time.
        rest: U(c.widths.units),
        /// Steps of the prepared unit time.
        pub amount: U(c.widths.distance + 1),
        /// Half-period of the prepared unit time, in ticks; 0 if the steps do not fit into T.
        pub half_period: U(c.widths.half_period),
    }
    /// Flip-flops.
    pub struct Reg {
        /// A move is waiting.
        pub pending: Bit,
        /// Number of unit times of the waiting move.
        pending_units: U(c.widths.units),
        /// T of the waiting move, in ticks.
        pending_period: U(c.widths.period),
        /// State of the sequence.
        state: U(2) as States(STATES),
        /// Number of the axis being computed.
        axis: U(3),
        /// U: number of unit times of the running move.
        length: U(c.widths.units),
        /// Unit times of the running move that are not prepared yet.
        left: U(c.widths.units),
        /// T of the running move, in ticks.
        pub unit_period: U(c.widths.period),
        /// Starts the divider.
        pub start: Bit,
        /// A prepared unit time is running.
        pub busy: Bit,
        /// Words of each axis.
        pub words: [Words(c); c.axes] as Elements(&AXIS_NAMES),
    }
    /// Nets.
    pub struct Net {
        /// Ready: a move is accepted.
        pub ready: Bit,
        /// The waiting move begins; it is computed from the next tick on.
        begins: Bit,
        /// A result of the divider is taken.
        divided: Bit,
        /// A result of the divider is taken for this axis.
        result: [Bit; c.axes] as Elements(RESULT),
        /// Half-period from the divider, limited to the greatest word.
        rounded: U(c.widths.half_period),
        /// The next unit time is prepared.
        pub prepared: Bit,
        /// A unit time without pulses follows, because the next unit time of the move is not
        /// prepared.
        pub late: Bit,
        /// Dividend without the addend.
        pub dividend: U(c.widths.divider()),
        /// Addend of the dividend.
        pub addend: U(c.widths.divider()),
        /// Divisor.
        pub divisor: U(c.widths.divider()),
    }
}

/// Names of the results of the axes.
const RESULT: &[&str] = &[
    "result_x", "result_y", "result_z", "result_a", "result_b", "result_c", "result_u", "result_v",
];
/// Names of the steps of a move.
const DELTA: &[&str] = &[
    "delta_x", "delta_y", "delta_z", "delta_a", "delta_b", "delta_c", "delta_u", "delta_v",
];

impl Circuit for MotorController {
    const NAME: &'static str = "motor_controller";
    const ABOUT: &'static str = "conventional: steps and pulse length of every axis and unit time";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        let wrong = !(1..=AXES_MAX).contains(&self.axes);
        wrong.then(|| format!("a motor controller has 1 to {AXES_MAX} axes"))
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let word = self.widths.divider();
        let state = |number| q.state.equals(number);
        let (waiting, amounts, lengths) = (state(WAIT), state(AMOUNT), state(LENGTH));
        let prepared = state(PREPARED);
        let none_left = q.left.is_zero();
        let begins = waiting & none_left & q.pending;
        let divided = i.done & (amounts | lengths);
        let taken = i.unit_rst & prepared;
        let accept = i.order.command & !q.pending;

        let is = |axis: usize| q.axis.equals(axis as u64);
        let last_axis = is(self.axes - 1);
        // The words of the axis that is computed.
        let chosen = |of: &dyn Fn(&Words) -> U| {
            let words = q
                .words
                .iter()
                .enumerate()
                .map(|(axis, words)| (is(axis), of(words)));
            let chosen = words.reduce(|(_, others), (this, word)| (this, this.mux(word, others)));
            let (_, chosen) = chosen.unwrap_or((last_axis, U::new(0, word)));
            chosen.resize(word)
        };
        let half_period = self.widths.half_period;
        let above = !i.quotient.shift_right(half_period).is_zero();
        let net = Net {
            ready: !q.pending,
            begins,
            divided,
            result: (0..self.axes).map(|axis| divided & is(axis)).collect(),
            rounded: above.mux(u64::MAX.cut(half_period), i.quotient.resize(half_period)),
            prepared,
            late: i.unit_rst & !prepared & (q.pending | !none_left),
            dividend: lengths.mux(q.unit_period.resize(word), chosen(&|words| words.distance)),
            addend: lengths.mux(0, chosen(&|words| words.rest)),
            divisor: lengths.mux(
                chosen(&|words| words.amount).shift_left(1),
                q.length.resize(word),
            ),
        };

        let words = q.words.iter().zip(&i.order.delta).enumerate();
        let words = words.map(|(axis, (words, &delta))| {
            let this: Bit = net.result[axis];
            let amount = i.quotient.resize(words.amount.width());
            let half = q.pending_units.shift_right(1);
            let rest = i.remainder.resize(self.widths.units);
            Words {
                pending_delta: accept.mux(delta, words.pending_delta),
                distance: begins.mux(words.pending_delta.magnitude(), words.distance),
                down: begins.mux(words.pending_delta.is_negative(), words.down),
                rest: begins.mux(half, (this & amounts).mux(rest, words.rest)),
                amount: (this & amounts).mux(amount, words.amount),
                half_period: (this & lengths).mux(net.rounded, words.half_period),
            }
        });
        let number = |state| U::new(state, 2);
        let after_length = last_axis.mux(number(PREPARED), number(AMOUNT));
        let after = divided.mux(amounts.mux(LENGTH, after_length), q.state);
        let first = waiting & !none_left;
        let after = first.mux(AMOUNT, after);
        let computed = divided & lengths;
        let next = Reg {
            pending: accept | (q.pending & !begins),
            pending_units: accept.mux(i.order.units, q.pending_units),
            pending_period: accept.mux(i.order.period, q.pending_period),
            state: taken.mux(WAIT, after),
            axis: computed.mux(last_axis.mux(0, q.axis + 1), q.axis),
            length: begins.mux(q.pending_units, q.length),
            left: begins.mux(
                q.pending_units,
                (computed & last_axis).mux(q.left - 1, q.left),
            ),
            unit_period: begins.mux(q.pending_period, q.unit_period),
            start: first | (divided & !(lengths & last_axis)),
            busy: i.unit_rst.mux(prepared, q.busy),
            words: words.collect(),
        };
        (net, next)
    }
}
