//! Registers and adders of a CORDIC: rotates a vector by ± arctan 2^−n for n = 0, 1, 2 … towards an
//! angle. Two shifters outside supply the shifted coordinates.
//!
//! ```text
//!                           ┌──────────────┐
//!  start, halt ────────────▶│              ├──▶ along, across, done, busy
//!  radius, offset, angle ──▶│              │
//!  small_along ────────────▶│ cordic_state ├──▶ iteration ──▶ shifters
//!  small_across ───────────▶│              │◀── shifters
//!                           └──────────────┘
//! ```
//!
//! The vector (radius, offset) is first rotated by whole quarter turns, so that at most an eighth
//! of a turn remains in either direction. Each iteration lengthens the vector by a fixed factor,
//! whatever the direction of its rotation. The product of these factors is [`GAIN`]. To keep the
//! length of a vector, divide the vector by the gain beforehand.

use crate::prelude::*;
use std::f64::consts::TAU;

/// Factor by which a vector is lengthened: the product of √(1 + 4^−n) over all iterations of a
/// word.
pub const GAIN: f64 = 1.646_760_258_121_065_6;

/// Registers of a CORDIC.
///
/// The number of iterations is the width of an angle. The angle that remains is then less than one
/// unit.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CordicState {
    /// R: width of a coordinate in bits.
    pub radius: usize,
    /// H: width of an angle, in units of 2^−H turn.
    pub angle: usize,
}

impl CordicState {
    /// arctan 2^−n in units of 2^−H turn.
    fn angles(&self) -> Image {
        let width = self.angle;
        let units = (width as f64).exp2() / TAU;
        Image::from_fn(6, width, |n| {
            ((-(n as f64)).exp2().atan() * units).round() as u64
        })
    }
}

signals! { for CordicState as c;
    /// Input ports. Values given with `start` are taken in that tick and need not be held.
    pub struct In {
        /// Starts a rotation; ignored while `busy`.
        pub start: Bit,
        /// Aborts; a start in the same tick is ignored.
        pub halt: Bit,
        /// First coordinate of the vector. The width leaves room for the length of the vector times
        /// [`GAIN`].
        pub radius: I(c.radius),
        /// Second coordinate of the vector; 0 for a point of a circle.
        pub offset: I(c.radius),
        /// Angle of the rotation, in units of 2^−H turn.
        pub angle: U(c.angle),
        /// `along` times 2^−iteration, rounded down.
        pub small_along: I(c.radius),
        /// `across` times 2^−iteration, rounded down.
        pub small_across: I(c.radius),
    }
    /// Flip-flops.
    pub struct Reg {
        /// A rotation is running.
        pub busy: Bit = 0,
        /// Number of the iteration, from 0 on; 0 between rotations.
        pub iteration: U(6) = 0,
        /// [`GAIN`] · (radius · cos angle − offset · sin angle); valid from `done` on.
        pub along: I(c.radius) as Analog = 0,
        /// [`GAIN`] · (radius · sin angle + offset · cos angle); valid from `done` on.
        pub across: I(c.radius) as Analog = 0,
        /// Remaining angle, in units of 2^−H turn.
        left: I(c.angle) as Analog = 0,
        /// The point is valid in this tick.
        pub done: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// A start is accepted.
        take: Bit,
        /// The iteration is the last one.
        last: Bit,
        /// The rotation continues in the next tick.
        goes_on: Bit,
        /// Angle plus an eighth of a turn: its upper two bits are the nearest quarter.
        raised: U(c.angle),
        /// The nearest quarter is 1 or 3: the coordinates are swapped.
        upright: Bit,
        /// The nearest quarter is 2 or 3: the sign of `across` is inverted. That of `along` is
        /// inverted for 1 and 2.
        half: Bit,
        /// Nearest multiple of a quarter turn, in units of 2^−H turn.
        quarter: U(c.angle),
        /// First coordinate after rotation by `quarter`, before its sign is set.
        first: I(c.radius),
        /// Second coordinate after rotation by `quarter`, before its sign is set.
        second: I(c.radius),
        /// First coordinate after rotation by `quarter`.
        begin_along: I(c.radius),
        /// Second coordinate after rotation by `quarter`.
        begin_across: I(c.radius),
        /// Angle that is left after rotation by `quarter`.
        rest: I(c.angle),
        /// The remaining angle is negative: this iteration rotates backwards.
        back: Bit,
        /// arctan 2^−iteration, in units of 2^−H turn.
        turn: I(c.angle),
    }
}

impl Circuit for CordicState {
    const NAME: &'static str = "cordic_state";
    const ABOUT: &'static str = "registers and adders of a CORDIC, one iteration per tick";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        let halved = self.angle >= 3;
        (!halved).then(|| "an angle has eighths of a turn".into())
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let width = self.angle;
        let angle = |value: u64| U::new(value, width);
        let (half_turn, quarter_turn) = (width - 1, width - 2);
        let raised = i.angle + (1u64 << (width - 3));
        let (upright, half) = (raised.bit(quarter_turn), raised.bit(half_turn));
        let low = upright.mux(angle(1 << quarter_turn), 0);
        let high = half.mux(angle(1 << half_turn), 0);
        let quarter = low + high;
        let take = i.start & !q.busy & !i.halt;
        let last = q.iteration.equals(width as u64 - 1);
        let rest = (i.angle - quarter).signed();
        let back = q.left.is_negative();
        let turn = self.angles().rom(q.iteration).signed();

        let goes_on = q.busy & !last & !i.halt;
        let first = upright.mux(i.offset, i.radius);
        let second = upright.mux(i.radius, i.offset);
        let begin_along = first.negated_by(upright ^ half);
        let begin_across = second.negated_by(half);
        let turned_along = back.mux(q.along + i.small_across, q.along - i.small_across);
        let turned_across = back.mux(q.across - i.small_along, q.across + i.small_along);
        let turned = back.mux(q.left + turn, q.left - turn);
        let next = Reg {
            busy: take | goes_on,
            iteration: goes_on.mux(q.iteration + 1, 0),
            along: take.mux(begin_along, q.busy.mux(turned_along, q.along)),
            across: take.mux(begin_across, q.busy.mux(turned_across, q.across)),
            left: take.mux(rest, q.busy.mux(turned, q.left)),
            done: q.busy & last & !i.halt,
        };
        let net = Net {
            take,
            last,
            goes_on,
            raised,
            upright,
            half,
            quarter,
            first,
            second,
            begin_along,
            begin_across,
            rest,
            back,
            turn,
        };
        (net, next)
    }
}
