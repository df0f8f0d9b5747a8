//! Arc angle: what part of a turn a length on an arc is.
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
//! angle = offset / (2πr), as a product by the reciprocal: `curvature` has its leading bit set, so the
//! product has as many digits as the offset, whatever the radius; then it is moved up to the angle's
//! unit. What falls off above are whole turns.

use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Unsigned};
use crate::signals;

/// Names of the states.
const STATES: &[&str] = &["idle", "multiply", "shift"];
const IDLE: u64 = 0;
const MULTIPLY: u64 = 1;
const SHIFT: u64 = 2;
/// Bits behind the offset's last that the product keeps.
pub const EXTRA: usize = 4;

signals! {
    /// Ports in. What is given with `start` is taken in that tick and need not be held.
    pub struct In<L, const P: usize, const M: usize> {
        /// Begins, unless one is under way.
        pub start: L::Bit,
        /// The length on the arc in guard units.
        pub offset: L::U<P>,
        /// 2^(M + n − 4) / (2πr) with the n for which it has M bits.
        pub curvature: L::U<M> as Hex,
        /// H − n.
        pub shift: L::U<6>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const P: usize, const M: usize, const H: usize, const X: usize> {
        /// What it does.
        state: L::U<2> as States(STATES) = 0,
        /// Bits of the curvature, or shifts, that are yet to come.
        count: L::U<6> = 0,
        /// By how much the product is moved up.
        shifts: L::U<6> = 0,
        /// The offset with bits behind it.
        factor: L::U<X> = 0,
        /// Bits of the curvature that are yet to come.
        bits: L::U<M> as Hex = 0,
        /// The product so far, by the weight of the bit to come.
        product: L::U<X> = 0,
        /// The angle in units of 2^−H turn, from `done` on.
        pub angle: L::U<H> as Analog = 0,
        /// The angle stands in this tick.
        pub done: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const X: usize> {
        /// A start is taken.
        take: L::Bit,
        /// The last bit of the curvature, or the last shift.
        last: L::Bit,
        /// The product with what the bit adds.
        total: L::U<X>,
        /// The angle is complete after this tick.
        complete: L::Bit,
        /// A start is not taken.
        pub busy: L::Bit,
    }
}

/// Angle of `H` bits from offsets of `P` and curvatures of `M`; `X` = `P` + 5 is the word of its
/// product.
///
/// `done` is high `M` + 1 ticks after `start`, and as many more as `shift` says.
#[derive(Debug, Clone, Default)]
pub struct ArcAngle<const P: usize, const M: usize, const H: usize, const X: usize>;

impl<const P: usize, const M: usize, const H: usize, const X: usize> ArcAngle<P, M, H, X> {
    /// Ticks from `start` to `done` where `shift` is 0.
    pub const LATENCY: u64 = M as u64 + 1;
}

impl<const P: usize, const M: usize, const H: usize, const X: usize> Circuit
    for ArcAngle<P, M, H, X>
{
    const NAME: &'static str = "arc_angle";
    const ABOUT: &'static str = "length on an arc as part of a turn";
    type In<L: Logic> = In<L, P, M>;
    type Reg<L: Logic> = Reg<L, P, M, H, X>;
    type Net<L: Logic> = Net<L, X>;

    fn comb<L: Logic>(&self, q: &Reg<L, P, M, H, X>, i: &In<L, P, M>) -> Net<L, X> {
        const {
            assert!(
                X == P + EXTRA + 1 && H <= X,
                "a sum of two offsets with their bits"
            )
        };
        let is = |state: u64| q.state.equals(state.into());
        let last = q.count.is_zero();
        let unmoved = is(MULTIPLY) & q.shifts.is_zero();
        Net {
            take: i.start & is(IDLE),
            last,
            total: q.product + q.bits.bit(0).mux(q.factor, 0.into()),
            complete: last & (unmoved | is(SHIFT)),
            busy: !is(IDLE),
        }
    }

    fn next<L: Logic>(
        &self,
        q: Reg<L, P, M, H, X>,
        w: &Net<L, X>,
        i: &In<L, P, M>,
    ) -> Reg<L, P, M, H, X> {
        let is = |state: u64| q.state.equals(state.into());
        let to = |state: u64| -> L::U<2> { state.into() };
        let (multiplies, shifts) = (is(MULTIPLY), is(SHIFT));
        let multiplied = multiplies & w.last;
        let state = w.take.mux(to(MULTIPLY), multiplied.mux(to(SHIFT), q.state));
        let count = multiplied.mux(q.shifts - 1, q.count - 1);
        let halved = w.total.shift_right(1);
        let wide: L::U<X> = i.offset.resize();
        let angle = multiplied.mux(halved.resize(), shifts.mux(q.angle.shift_left(1), q.angle));
        Reg {
            state: w.complete.mux(to(IDLE), state),
            count: w
                .take
                .mux((M as u64 - 1).into(), w.busy.mux(count, q.count)),
            shifts: w.take.mux(i.shift, q.shifts),
            factor: w.take.mux(wide.shift_left(EXTRA), q.factor),
            bits: w.take.mux(i.curvature, q.bits.shift_right(1)),
            product: w.take.mux(0.into(), multiplies.mux(halved, q.product)),
            angle,
            done: w.complete,
        }
    }
}
