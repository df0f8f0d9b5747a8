//! CORDIC: the point of an arc around its centre at an angle, an iteration a tick.
//!
//! ```text
//!           ┌──────────────────────────┐
//!  start ──▶│ cordic_state             ├──▶ along, across
//!  radius ─▶│   ◀▶ shifters of along   ├──▶ done, busy
//!  angle ──▶│        and across        │
//!           └──────────────────────────┘
//! ```

use super::{CordicState, Shifter, cordic_state, shifter};
use crate::kernel::{Circuit, Instance, Nothing};
use crate::logic::Logic;
use crate::signals;

signals! {
    /// Ports in. What is given with `start` is taken in that tick and need not be held.
    pub struct In<L, const R: usize, const H: usize> {
        /// Begins, unless one is under way.
        pub start: L::Bit,
        /// The radius divided by [`GAIN`](cordic_state::GAIN); not negative, with room for the gain.
        pub radius: L::I<R>,
        /// The angle in units of 2^−H turn.
        pub angle: L::U<H>,
    }
}

signals! {
    /// Registers of the blocks.
    pub struct Reg<L, const R: usize, const H: usize> {
        /// Vector and angle.
        pub turning: cordic_state::Reg<L, R, H>,
    }
}

signals! {
    /// Nets of the blocks, and the ports out.
    pub struct Net<L, const R: usize, const H: usize> {
        /// Vector and angle.
        pub turning: Instance<CordicState<R, H>, L>,
        /// `along` by 2^−iteration.
        pub shift_along: Instance<Shifter<R>, L>,
        /// `across` by 2^−iteration.
        pub shift_across: Instance<Shifter<R>, L>,
        /// radius · cos angle, from `done` on.
        pub along: L::I<R> as Analog,
        /// radius · sin angle, from `done` on.
        pub across: L::I<R> as Analog,
        /// The point stands in this tick.
        pub done: L::Bit,
        /// A start is not taken.
        pub busy: L::Bit,
    }
}

/// CORDIC with coordinates of `R` bits and angles of `H`.
///
/// `done` is high `H` + 1 ticks after `start`, with as many iterations as the angle has bits.
#[derive(Debug, Clone, Default)]
pub struct Cordic<const R: usize, const H: usize> {
    /// Vector and angle.
    pub turning: CordicState<R, H>,
    /// Of both coordinates.
    pub shifter: Shifter<R>,
}

impl<const R: usize, const H: usize> Cordic<R, H> {
    /// Ticks from `start` to `done`.
    pub const LATENCY: u64 = H as u64 + 1;
}

impl<const R: usize, const H: usize> Circuit for Cordic<R, H> {
    const NAME: &'static str = "cordic";
    const ABOUT: &'static str =
        "radius and angle to the point around the centre, an iteration a tick";
    type In<L: Logic> = In<L, R, H>;
    type Reg<L: Logic> = Reg<L, R, H>;
    type Net<L: Logic> = Net<L, R, H>;

    fn comb<L: Logic>(&self, q: &Reg<L, R, H>, i: &In<L, R, H>) -> Net<L, R, H> {
        let shift = |word| {
            let by = q.turning.iteration;
            Instance::settle(&self.shifter, &Nothing::new(), shifter::In { word, by })
        };
        let (shift_along, shift_across) = (shift(q.turning.along), shift(q.turning.across));
        let turning = Instance::settle(
            &self.turning,
            &q.turning,
            cordic_state::In {
                start: i.start,
                radius: i.radius,
                angle: i.angle,
                small_along: shift_along.w.shifted,
                small_across: shift_across.w.shifted,
            },
        );
        Net {
            along: q.turning.along,
            across: q.turning.across,
            done: q.turning.done,
            busy: q.turning.busy,
            turning,
            shift_along,
            shift_across,
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, R, H>, w: &Net<L, R, H>, _: &In<L, R, H>) -> Reg<L, R, H> {
        Reg {
            turning: w.turning.next(&self.turning, q.turning),
        }
    }
}
