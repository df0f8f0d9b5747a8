//! CORDIC, its registers and adders: a vector is turned by ± arctan 2^−n for n = 0, 1, 2 … towards an
//! angle, around two shifters.
//!
//! ```text
//!                           ┌──────────────┐
//!  start, radius, angle ───▶│              ├──▶ along, across, done, busy
//!  small_along ────────────▶│ cordic_state ├──▶ iteration ──▶ shifters
//!  small_across ───────────▶│              │◀── shifters
//!                           └──────────────┘
//! ```
//!
//! The vector (radius, 0) is first turned by whole quarters, so what is left is within an eighth of a
//! turn of zero. Each turn lengthens the vector by the same factor, whatever its sign, so the radius
//! that is given is divided by their product, [`GAIN`], beforehand.

use crate::kernel::Circuit;
use crate::logic::{Bit, Image, Logic, Signed, Unsigned};
use crate::signals;
use std::f64::consts::TAU;

/// By what a vector is lengthened: the product of √(1 + 4^−n) over all iterations of a word.
pub const GAIN: f64 = 1.646_760_258_121_065_6;

signals! {
    /// Ports in. What is given with `start` is taken in that tick and need not be held.
    pub struct In<L, const R: usize, const H: usize> {
        /// Begins, unless one is under way.
        pub start: L::Bit,
        /// The radius divided by [`GAIN`]; not negative, with room for the gain.
        pub radius: L::I<R>,
        /// The angle in units of 2^−H turn.
        pub angle: L::U<H>,
        /// `along` by 2^−iteration.
        pub small_along: L::I<R>,
        /// `across` by 2^−iteration.
        pub small_across: L::I<R>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const R: usize, const H: usize> {
        /// A turn is under way.
        pub busy: L::Bit = 0,
        /// The iteration.
        pub iteration: L::U<6> = 0,
        /// radius · cos angle, from `done` on.
        pub along: L::I<R> as Analog = 0,
        /// radius · sin angle, from `done` on.
        pub across: L::I<R> as Analog = 0,
        /// The angle that is left.
        left: L::I<H> as Analog = 0,
        /// The point stands in this tick.
        pub done: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const R: usize, const H: usize> {
        /// A start is taken.
        take: L::Bit,
        /// The iteration is the last.
        last: L::Bit,
        /// The angle is nearer to the next quarter: the eighths are rounded.
        raised: L::U<H>,
        /// The nearest quarter is the first or third: the vector is upright.
        upright: L::Bit,
        /// It is the first or second: `along` is negative, or `across` in the first.
        half: L::Bit,
        /// The nearest quarter.
        quarter: L::U<H>,
        /// The vector's coordinate that is not 0 there.
        beginning: L::I<R>,
        /// The angle without its quarters.
        rest: L::I<H>,
        /// What is left is below zero: the vector is turned back.
        back: L::Bit,
        /// arctan 2^−iteration.
        turn: L::I<H>,
    }
}

/// Registers of a CORDIC with coordinates of `R` bits, angles of `H` and so many iterations.
#[derive(Debug, Clone)]
pub struct CordicState<const R: usize, const H: usize> {
    /// arctan 2^−n in units of 2^−H turn.
    pub angles: Image<6, H>,
    /// The number of iterations, up to 63.
    pub iterations: u64,
}

impl<const R: usize, const H: usize> Default for CordicState<R, H> {
    /// As many iterations as the angle has bits: what is left then is below one of its units.
    fn default() -> Self {
        let units = (H as f64).exp2() / TAU;
        let angle = |n: i32| ((-f64::from(n)).exp2().atan() * units).round() as u64;
        CordicState {
            angles: Image::new((0..64).map(angle)),
            iterations: H as u64,
        }
    }
}

impl<const R: usize, const H: usize> Circuit for CordicState<R, H> {
    const NAME: &'static str = "cordic_state";
    const ABOUT: &'static str = "a vector and what is left of its angle, an iteration a tick";
    type In<L: Logic> = In<L, R, H>;
    type Reg<L: Logic> = Reg<L, R, H>;
    type Net<L: Logic> = Net<L, R, H>;

    fn comb<L: Logic>(&self, q: &Reg<L, R, H>, i: &In<L, R, H>) -> Net<L, R, H> {
        let raised = i.angle + (1u64 << (H - 3));
        let (upright, half) = (raised.bit(H - 2), raised.bit(H - 1));
        let low: L::U<H> = upright.mux((1u64 << (H - 2)).into(), 0.into());
        let high: L::U<H> = half.mux((1u64 << (H - 1)).into(), 0.into());
        let quarter = low + high;
        Net {
            take: i.start & !q.busy,
            last: q.iteration.equals((self.iterations - 1).into()),
            raised,
            upright,
            half,
            quarter,
            beginning: half.mux(-i.radius, i.radius),
            rest: (i.angle - quarter).signed(),
            back: q.left.is_negative(),
            turn: self.angles.read::<L>(q.iteration).signed(),
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, R, H>, w: &Net<L, R, H>, i: &In<L, R, H>) -> Reg<L, R, H> {
        let begin_along = w.upright.mux(0.into(), w.beginning);
        let begin_across = w.upright.mux(w.beginning, 0.into());
        let turned_along = w
            .back
            .mux(q.along + i.small_across, q.along - i.small_across);
        let turned_across = w
            .back
            .mux(q.across - i.small_along, q.across + i.small_along);
        let turned = w.back.mux(q.left + w.turn, q.left - w.turn);
        Reg {
            busy: w.take | (q.busy & !w.last),
            iteration: (q.busy & !w.last).mux(q.iteration + 1, 0.into()),
            along: w.take.mux(begin_along, q.busy.mux(turned_along, q.along)),
            across: w
                .take
                .mux(begin_across, q.busy.mux(turned_across, q.across)),
            left: w.take.mux(w.rest, q.busy.mux(turned, q.left)),
            done: q.busy & w.last,
        }
    }
}
