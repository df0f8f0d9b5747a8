//! Arcs of the conventional device (¶0003–0004): the amount of motion of every unit time from the
//! parameters of an arc, as moves of one unit time for the [motor controller](super::motor_controller).
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
//! An arc turns the first two axes around a centre, from its start angle on, by the same angle in
//! every unit time. The amounts are the differences of rounded points: they add up to the distance
//! from the first rounded point to the last, and no rounding is lost or doubled.

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
    /// An arc, in place of the steps of a move; its unit times and T are those of the move.
    pub struct ArcMove {
        /// The move is an arc.
        pub circular: Bit,
        /// Its radius divided by the gain of the CORDIC, in units of 2^−G step.
        pub radius: U(c.radius()),
        /// Start angle, in units of 2^−H turn.
        pub angle: U(c.angle),
        /// Rotation in a unit time, in units of 2^−H turn; above half a turn it is a turn
        /// backwards.
        pub turn: U(c.angle),
    }
    /// Input ports.
    pub struct In {
        /// The move that is given; with 0 unit times it is dropped.
        pub order: Move(&c.controller) as Flat,
        /// Parameters of the move as an arc.
        pub arc: ArcMove(c) as Flat,
        /// A move waits in the controller.
        pub pending: Bit,
        /// The point of the CORDIC is valid.
        pub done: Bit,
        /// Its first coordinate, in units of 2^−G step.
        pub along: I(c.radius() + 2),
        /// Its second.
        pub across: I(c.radius() + 2),
    }
    /// Flip-flops.
    pub struct Reg {
        /// State of the sequence.
        state: U(2) as States(STATES) = 0,
        /// The point is the one where the arc begins.
        first: Bit = 0,
        /// Remaining unit times.
        left: U(c.controller.widths.units) = 0,
        /// T of the arc, in ticks.
        held_period: U(c.controller.widths.period) = 0,
        /// The radius, as the CORDIC takes it.
        pub wide_radius: I(c.radius() + 2) = 0,
        /// The angle of the point.
        pub place: U(c.angle) = 0,
        /// Rotation in a unit time.
        held_turn: U(c.angle) = 0,
        /// The rounded point before, in steps.
        last_along: I(c.controller.widths.distance + 1) = 0,
        /// Its second coordinate.
        last_across: I(c.controller.widths.distance + 1) = 0,
        /// The CORDIC begins.
        pub start: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// A move would be accepted.
        pub idle: Bit,
        /// An arc begins.
        begins: Bit,
        /// The controller takes the move of a unit time.
        given: Bit,
        /// The point arrives.
        arrives: Bit,
        /// The point is kept, for the difference to the next.
        kept: Bit,
        /// Starts the CORDIC for the next point.
        again: Bit,
        /// The first coordinate and half a step, in whole steps.
        raised_along: I(c.radius() + 2),
        /// The second coordinate and half a step, in whole steps.
        raised_across: I(c.radius() + 2),
        /// The point in whole steps, a half upwards.
        rounded_along: I(c.controller.widths.distance + 1),
        /// Its second coordinate.
        rounded_across: I(c.controller.widths.distance + 1),
        /// Move for the controller.
        pub next_order: Move(&c.controller),
    }
}

impl Circuit for CircularInterpolator {
    const NAME: &'static str = "circular_interpolator";
    const ABOUT: &'static str =
        "conventional: the amounts of an arc's unit times, from its parameters";
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
