//! Arc angle: computes the angle of a length on an arc, as a fraction of a turn.
//!
//! ```text
//!               ┌───────────┐
//!  start ──────▶│           ├──▶ angle
//!  offset ─────▶│ arc_angle ├──▶ done, busy
//!  curvature ──▶│           │
//!  shift ──────▶│           │
//!               └───────────┘
//! ```
//!
//! angle = offset / (2πr), as a product with a reciprocal. The leading bit of `curvature` is set,
//! so the product has as many digits as the offset, whatever the radius. Then the product is
//! shifted up to the unit of the angle. Bits that overflow are whole turns.

use super::widths::{PRODUCT_FRACTION, PointWidths};
use crate::prelude::*;

/// Names of the states.
const STATES: &[&str] = &["idle", "multiply", "shift"];
const IDLE: u64 = 0;
const MULTIPLY: u64 = 1;
const SHIFT: u64 = 2;

/// Angle from an offset and a curvature.
///
/// `done` is high M + 1 + `shift` ticks after `start`.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ArcAngle {
    /// Word widths.
    pub widths: PointWidths,
}

impl ArcAngle {
    /// Ticks from `start` to `done` where `shift` is 0.
    pub const fn latency(&self) -> u64 {
        self.widths.curvature as u64 + 1
    }
}

signals! { for ArcAngle as c;
    /// Input ports. Values given with `start` are taken in that tick and need not be held.
    pub struct In {
        /// Starts a calculation; ignored while `busy`.
        pub start: Bit,
        /// Length on the arc, in guard units.
        pub offset: U(c.widths.point),
        /// 2^(M + n − 4) / (2πr), with the n that gives it M bits.
        pub curvature: U(c.widths.curvature) as Hex,
        /// H − n: shift of the product, in bits.
        pub shift: U(6),
    }
    /// Flip-flops.
    pub struct Reg {
        /// State of the sequence.
        state: U(2) as States(STATES) = 0,
        /// Remaining bits of the curvature, or remaining shifts.
        count: U(6) = 0,
        /// `shift` of the running calculation.
        shifts: U(6) = 0,
        /// Offset with its extra bits below the guard unit.
        factor: U(c.widths.product()) = 0,
        /// Remaining bits of the curvature.
        bits: U(c.widths.curvature) as Hex = 0,
        /// Partial product, scaled to the weight of the next bit.
        product: U(c.widths.product()) = 0,
        /// Angle in units of 2^−H turn; valid from `done` on.
        pub angle: U(c.widths.angle, c.widths.angle) as Analog = 0,
        /// The angle is valid in this tick.
        pub done: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// A start is accepted.
        take: Bit,
        /// Last bit of the curvature, or last shift.
        last: Bit,
        /// Partial product plus the term of the current bit.
        total: U(c.widths.product()),
        /// The angle is complete at the end of this tick.
        complete: Bit,
        /// A calculation is running; a start is ignored.
        pub busy: Bit,
    }
}

impl Circuit for ArcAngle {
    const NAME: &'static str = "arc_angle";
    const ABOUT: &'static str = "length on an arc to a fraction of a turn";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let is = |state: u64| q.state.equals(state);
        let (idle, multiplies, shifts) = (is(IDLE), is(MULTIPLY), is(SHIFT));
        let take = i.start & idle;
        let last = q.count.is_zero();
        let total = q.product + q.bits.bit(0).mux(q.factor, 0);
        let unmoved = multiplies & q.shifts.is_zero();
        let complete = last & (unmoved | shifts);
        let busy = !idle;

        let multiplied = multiplies & last;
        let state = take.mux(MULTIPLY, multiplied.mux(SHIFT, q.state));
        let count = multiplied.mux(q.shifts - 1, q.count - 1);
        let halved = total.shift_right(1);
        let factor = i
            .offset
            .resize(self.widths.product())
            .shift_left(PRODUCT_FRACTION);
        let moved = shifts.mux(q.angle.shift_left(1), q.angle);
        let next = Reg {
            state: complete.mux(IDLE, state),
            count: take.mux(self.widths.curvature as u64 - 1, busy.mux(count, q.count)),
            shifts: take.mux(i.shift, q.shifts),
            factor: take.mux(factor, q.factor),
            bits: take.mux(i.curvature, q.bits.shift_right(1)),
            product: take.mux(0, multiplies.mux(halved, q.product)),
            angle: multiplied.mux(halved.resize(self.widths.angle), moved),
            done: complete,
        };
        (
            Net {
                take,
                last,
                total,
                complete,
                busy,
            },
            next,
        )
    }

    fn objection(&self) -> Option<String> {
        let holds = self.widths.angle <= self.widths.product();
        (!holds).then(|| "the product holds an angle".into())
    }
}
