//! Length powers: square and cube of the length on a spline, in proportion to its longest length.
//!
//! ```text
//!           ┌───────────────┐
//!  start ──▶│               ├──▶ factor, product
//!  offset ─▶│ length_powers ├──▶ done, busy
//!  shift ──▶│               │
//!           └───────────────┘
//! ```
//!
//! With u = offset and n = shift, u < 2^n: computes u²/2^n, then u³/2^2n, each rounded down to an
//! inner unit. So all three powers are below 2^n guard units, and the coefficients of all powers
//! have the same format as those of a line (¶0031: "coefficients as path data").

use super::widths::PointWidths;
use crate::prelude::*;

/// Names of the states.
const STATES: &[&str] = &["idle", "square", "cube"];
const IDLE: u64 = 0;
const SQUARE: u64 = 1;
const CUBE: u64 = 2;

/// Square and cube of a length.
///
/// `done` is high 2·shift + 1 ticks after `start`.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LengthPowers {
    /// Word widths.
    pub widths: PointWidths,
}

impl LengthPowers {
    /// Ticks from `start` to `done` of the longest lengths, those of P − 1 bits.
    pub const fn latency(&self) -> u64 {
        2 * (self.widths.point as u64 - 1) + 1
    }
}

signals! { for LengthPowers as c;
    /// Input ports.
    pub struct In {
        /// Starts a calculation; ignored while `busy`.
        pub start: Bit,
        /// Length on the spline in guard units, below 2^shift; constant from `start` to `done`.
        pub offset: U(c.widths.point),
        /// n: width of the spline's length in bits, 1 to P − 1; constant from `start` to `done`.
        pub shift: U(6),
    }
    /// Flip-flops.
    pub struct Reg {
        /// State of the sequence.
        state: U(2) as States(STATES) = 0,
        /// Bits of the offset that follow the current one.
        count: U(6) = 0,
        /// Remaining bits of the offset.
        bits: U(c.widths.point) as Hex = 0,
        /// Multiplicand, with R − P bits below the guard unit: the offset, then the square, also
        /// from `done` on.
        pub factor: U(c.widths.radius) as Analog = 0,
        /// Partial product, scaled to the weight of the next bit; the cube from `done` on.
        pub product: U(c.widths.radius) as Analog = 0,
        /// Square and cube are valid in this tick.
        pub done: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// A start is accepted.
        take: Bit,
        /// The current bit is the last of the offset.
        last: Bit,
        /// Partial product plus the term of the current bit.
        total: U(c.widths.radius),
        /// The square is complete at the end of this tick.
        squared: Bit,
        /// The cube is complete at the end of this tick.
        complete: Bit,
        /// A calculation is running; a start is ignored.
        pub busy: Bit,
    }
}

impl Circuit for LengthPowers {
    const NAME: &'static str = "length_powers";
    const ABOUT: &'static str = "square and cube of a length on a spline, one bit per tick";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let is = |state: u64| q.state.equals(state);
        let take = i.start & is(IDLE);
        let last = q.count.is_zero();
        let total = q.product + q.bits.bit(0).mux(q.factor, 0);
        let halved = total.shift_right(1);
        let (squared, complete) = (is(SQUARE) & last, is(CUBE) & last);
        let busy = !is(IDLE);

        let begins = take | squared;
        let state = take.mux(SQUARE, squared.mux(CUBE, q.state));
        let length = i.offset.resize(self.widths.radius);
        let length = length.shift_left(self.widths.fine());
        let next = Reg {
            state: complete.mux(IDLE, state),
            count: begins.mux(i.shift - 1, busy.mux(q.count - 1, q.count)),
            bits: begins.mux(i.offset, q.bits.shift_right(1)),
            factor: take.mux(length, squared.mux(halved, q.factor)),
            product: begins.mux(0, busy.mux(halved, q.product)),
            done: complete,
        };
        let net = Net {
            take,
            last,
            total,
            squared,
            complete,
            busy,
        };
        (net, next)
    }

    fn objection(&self) -> Option<String> {
        let holds = self.widths.radius > self.widths.point;
        (!holds).then(|| "a radius has bits below the guard unit".into())
    }
}
