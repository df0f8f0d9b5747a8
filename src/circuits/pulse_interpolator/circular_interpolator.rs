//! Arcs of the conventional device (¶0003–0004): computes the steps of every unit time from the
//! parameters of an arc, and passes them to the [motor controller](super::motor_controller) as
//! moves of one unit time.
//!
//! ```text
//!                       ┌───────────────────────┐
//!  command, delta… ────▶│                       ├──▶ order ──▶ motor controller
//!  circular, radius… ──▶│ circular_interpolator │◀── pending ◀──
//!                       │                       ├──▶ idle
//!                       └──┬─────────────────▲──┘
//!                    start, angle       along, across, done
//!                       ┌──▼─────────────────┴──┐
//!                       │ cordic                │
//!                       └───────────────────────┘
//! ```
//!
//! An arc moves the first two axes around a centre, from its start angle on, by the same angle in
//! every unit time. The steps of a unit time are the difference of two rounded points, so rounding
//! errors do not add up.

use super::motor_controller::{MotorController, Move};
use crate::circuits::blocks::Cordic;
use crate::prelude::*;

/// G: bits of a coordinate below the step.
pub const GUARD: usize = 8;

/// Names of the states.
const STATES: &[&str] = &["idle", "turn", "offer"];
const IDLE: u64 = 0;
const TURN: u64 = 1;
const OFFER: u64 = 2;

/// Circular interpolator in front of a motor controller of 2 axes or more.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CircularInterpolator {
    /// Motor controller that takes the moves.
    pub controller: MotorController,
    /// H: width of an angle, in units of 2^−H turn.
    pub angle: usize,
}

impl CircularInterpolator {
    /// Its CORDIC.
    pub const fn cordic(&self) -> Cordic {
        Cordic {
            // A sign, and room for the excess of a rounded point over its radius.
            radius: self.radius() + 2,
            angle: self.angle,
        }
    }

    /// Width of a radius.
    pub const fn radius(&self) -> usize {
        self.controller.widths.distance + GUARD
    }

    /// Ticks from an order to the first move, and from one to the next if the controller takes
    /// them immediately.
    pub const fn latency(&self) -> [u64; 2] {
        let point = 1 + self.cordic().latency();
        [2 * point + 1, point + 1]
    }
}

signals! { for CircularInterpolator as c;
    /// Arc in place of the steps of a move; number of unit times and T are those of the move.
    pub struct ArcMove {
        /// The move is an arc.
        pub circular: Bit,
        /// Radius of the arc divided by the gain of the CORDIC, in units of 2^−G step.
        pub radius: U(c.radius()),
        /// Start angle, in units of 2^−H turn.
        pub angle: U(c.angle),
        /// Rotation per unit time, in units of 2^−H turn; values above half a turn rotate
        /// backwards.
        pub turn: U(c.angle),
    }
    /// Input ports.
    pub struct In {
        /// Move from the computer; a move of 0 unit times is dropped.
        pub order: Move(&c.controller) as Flat,
        /// Parameters of the move if it is an arc.
        pub arc: ArcMove(c) as Flat,
        /// A move is waiting in the motor controller.
        pub pending: Bit,
        /// The CORDIC has a point.
        pub done: Bit,
        /// First coordinate of the point, in units of 2^−G step.
        pub along: I(c.radius() + 2),
        /// Second coordinate of the point, in units of 2^−G step.
        pub across: I(c.radius() + 2),
    }
    /// Flip-flops.
    pub struct Reg {
        /// State of the sequence.
        state: U(2) as States(STATES) = 0,
        /// The point being computed is the start of the arc.
        first: Bit = 0,
        /// Remaining unit times of the arc.
        left: U(c.controller.widths.units) = 0,
        /// T of the arc, in ticks.
        held_period: U(c.controller.widths.period) = 0,
        /// Radius for the CORDIC, in units of 2^−G step.
        pub wide_radius: I(c.radius() + 2) = 0,
        /// Angle of the point being computed, in units of 2^−H turn.
        pub place: U(c.angle) = 0,
        /// Rotation per unit time, in units of 2^−H turn.
        held_turn: U(c.angle) = 0,
        /// First coordinate of the previous point, in whole steps.
        last_along: I(c.controller.widths.distance + 1) = 0,
        /// Second coordinate of the previous point, in whole steps.
        last_across: I(c.controller.widths.distance + 1) = 0,
        /// Starts the CORDIC.
        pub start: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// Ready: a move is accepted.
        pub idle: Bit,
        /// An arc begins.
        begins: Bit,
        /// The motor controller accepts the move of one unit time.
        given: Bit,
        /// The CORDIC delivers a point.
        arrives: Bit,
        /// The rounded point is stored, for the difference to the next one.
        kept: Bit,
        /// Starts the CORDIC for the next point.
        again: Bit,
        /// First coordinate plus half a step, rounded down to whole steps.
        raised_along: I(c.radius() + 2),
        /// Second coordinate plus half a step, rounded down to whole steps.
        raised_across: I(c.radius() + 2),
        /// First coordinate of the point, rounded to whole steps; halves round up.
        rounded_along: I(c.controller.widths.distance + 1),
        /// Second coordinate of the point, rounded to whole steps; halves round up.
        rounded_across: I(c.controller.widths.distance + 1),
        /// Move for the motor controller.
        pub next_order: Move(&c.controller),
    }
}

impl Circuit for CircularInterpolator {
    const NAME: &'static str = "circular_interpolator";
    const ABOUT: &'static str = "conventional: steps of every unit time of an arc";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        let wrong = self.controller.axes < 2;
        wrong.then(|| "an arc has two axes".into())
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let state = |number| q.state.equals(number);
        let (idles, turns, offers) = (state(IDLE), state(TURN), state(OFFER));
        let idle = idles & !i.pending;
        let circular = i.arc.circular & i.order.command;
        let begins = idle & circular & !i.order.units.is_zero();
        let given = offers & !i.pending;
        let steps = self.controller.widths.distance + 1;
        let raised = |word: I| (word + (1i64 << (GUARD - 1))).shift_right(GUARD);
        let (raised_along, raised_across) = (raised(i.along), raised(i.across));
        let (along, across) = (raised_along.resize(steps), raised_across.resize(steps));
        let deltas = [along - q.last_along, across - q.last_across];
        let delta = i.order.delta.iter().enumerate();
        let delta = delta.map(|(axis, &straight)| match deltas.get(axis) {
            Some(&arc) => offers.mux(arc, straight),
            None => offers.mux(0, straight),
        });
        let next_order = Move {
            command: given | (idle & i.order.command & !i.arc.circular),
            delta: delta.collect(),
            units: offers.mux(1, i.order.units),
            period: offers.mux(q.held_period, i.order.period),
        };
        let arrives = turns & i.done;
        let last = q.left.equals(1);
        let again = (arrives & q.first) | (given & !last);
        let number = |state| U::new(state, 2);
        let after = given.mux(last.mux(number(IDLE), number(TURN)), q.state);
        let after = (arrives & !q.first).mux(OFFER, after);
        let kept = (arrives & q.first) | given;
        let place = again.mux(q.place + q.held_turn, q.place);
        let next = Reg {
            state: begins.mux(TURN, after),
            first: begins | (q.first & !arrives),
            left: begins.mux(i.order.units, given.mux(q.left - 1, q.left)),
            held_period: begins.mux(i.order.period, q.held_period),
            wide_radius: begins.mux(
                i.arc.radius.resize(self.radius() + 2).signed(),
                q.wide_radius,
            ),
            place: begins.mux(i.arc.angle, place),
            held_turn: begins.mux(i.arc.turn, q.held_turn),
            last_along: kept.mux(along, q.last_along),
            last_across: kept.mux(across, q.last_across),
            start: begins | again,
        };
        let net = Net {
            idle,
            begins,
            given,
            arrives,
            kept,
            again,
            raised_along,
            raised_across,
            rounded_along: along,
            rounded_across: across,
            next_order,
        };
        (net, next)
    }
}
