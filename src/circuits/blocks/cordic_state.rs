//! CORDIC, its registers and adders: a vector is turned by ± arctan 2^−n for n = 0, 1, 2 … towards an
//! angle, around two shifters.
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
//! The vector (radius, offset) is first turned by whole quarters, so the rest of the angle is
//! within an eighth of a turn of zero. Each iteration lengthens the vector by a fixed factor,
//! whatever its sign: by their product, [`GAIN`], in all. To get a vector in its own length,
//! divide it by the gain beforehand.

use crate::prelude::*;
use std::f64::consts::TAU;

/// Factor by which a vector is lengthened: the product of √(1 + 4^−n) over all iterations of a
/// word.
pub const GAIN: f64 = 1.646_760_258_121_065_6;

/// Registers of a CORDIC.
///
/// There are as many iterations as the angle has bits: the remaining angle is then below one of
/// its units.
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
        /// Starts, unless one is running.
        pub start: Bit,
        /// Aborts; a start in the same tick is ignored.
        pub halt: Bit,
        /// First coordinate of the vector, with room for its length times [`GAIN`].
        pub radius: I(c.radius),
        /// The second, 0 for a point of a circle.
        pub offset: I(c.radius),
        /// The angle in units of 2^−H turn.
        pub angle: U(c.angle),
        /// `along` by 2^−iteration.
        pub small_along: I(c.radius),
        /// `across` by 2^−iteration.
        pub small_across: I(c.radius),
    }
    /// Flip-flops.
    pub struct Reg {
        /// A turn is running.
        pub busy: Bit = 0,
        /// The iteration.
        pub iteration: U(6) = 0,
        /// [`GAIN`] · (radius · cos angle − offset · sin angle), from `done` on.
        pub along: I(c.radius) as Analog = 0,
        /// [`GAIN`] · (radius · sin angle + offset · cos angle), from `done` on.
        pub across: I(c.radius) as Analog = 0,
        /// The angle that is left.
        left: I(c.angle) as Analog = 0,
        /// The point is valid in this tick.
        pub done: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// A start is taken.
        take: Bit,
        /// The iteration is the last.
        last: Bit,
        /// The turn continues after this tick.
        goes_on: Bit,
        /// The angle is nearer to the next quarter: the eighths are rounded.
        raised: U(c.angle),
        /// The nearest quarter is the first or third: the coordinates change places.
        upright: Bit,
        /// Second or third quarter: `across` changes its sign. `along` does in the first and second.
        half: Bit,
        /// The nearest quarter.
        quarter: U(c.angle),
        /// The coordinate along after the quarters, but for the sign.
        first: I(c.radius),
        /// The coordinate across after the quarters, but for the sign.
        second: I(c.radius),
        /// The vector turned by it, along.
        begin_along: I(c.radius),
        /// Across.
        begin_across: I(c.radius),
        /// The angle without its quarters.
        rest: I(c.angle),
        /// The remaining angle is below zero: the vector is turned back.
        back: Bit,
        /// arctan 2^−iteration.
        turn: I(c.angle),
    }
}

impl Circuit for CordicState {
    const NAME: &'static str = "cordic_state";
    const ABOUT: &'static str = "a vector and what is left of its angle, an iteration a tick";
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
