//! Position pattern generator 14 (¶0010): acceleration time, deceleration time and steady speed in,
//! a position x(n) each scan out.
//!
//! ```text
//!                          ┌───────────────────┐
//!  start, from, distance ─▶│                   ├──▶ position
//!  speed, …time ──────────▶│ pattern generator ├──▶ valid
//!  advance ───────────────▶│        14         ├──▶ ready
//!  abort ─────────────────▶│                   ├──▶ active
//!                          └───────────────────┘
//! ```
//!
//! Departures: see [`trapezoid`].

use super::{Trapezoid, trapezoid};
use crate::blocks::{MulDiv, mul_div};
use crate::kernel::{Circuit, Instance};
use crate::logic::Logic;
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const P: usize, const T: usize> {
        /// Begins a cycle, unless one is under way; the ports down to `deceleration_time` are
        /// taken with it.
        pub start: L::Bit,
        /// Position at the start.
        pub from: L::I<P>,
        /// Distance to go; with 0 there is no cycle.
        pub distance: L::I<P>,
        /// V: greatest speed, in counts a scan with `T` bits of fraction; 0 counts as the least.
        pub speed: L::U<P>,
        /// Ta in scans; 0 counts as 1.
        pub acceleration_time: L::U<T>,
        /// Td in scans; 0 counts as 1.
        pub deceleration_time: L::U<T>,
        /// Makes the next position, if `ready`.
        pub advance: L::Bit,
        /// Ends the cycle: before its first scan at once, later by a ramp down.
        pub halt: L::Bit,
    }
}

signals! {
    /// Registers of the blocks.
    pub struct Reg<L, const P: usize, const T: usize, const M: usize, const Q: usize> {
        /// Control.
        pub trapezoid: trapezoid::Reg<L, P, T, M, Q>,
        /// Multiplier-divider.
        pub mul_div: mul_div::Reg<L, M, Q>,
    }
}

signals! {
    /// Nets of the blocks, and the ports out.
    pub struct Net<L, const P: usize, const T: usize, const M: usize, const Q: usize> {
        /// Control.
        pub trapezoid: Instance<Trapezoid<P, T, M, Q>, L>,
        /// Multiplier-divider.
        pub mul_div: Instance<MulDiv<M, Q>, L>,
        /// x(n): the position.
        pub position: L::I<P> as Analog,
        /// A new position stands at `position` from this tick on.
        pub valid: L::Bit,
        /// `advance` is taken.
        pub ready: L::Bit,
        /// A cycle is under way.
        pub active: L::Bit,
    }
}

/// Position pattern generator 14 with positions of `P` bits and times of `T`, fewer than P;
/// M = 2T + 1 and Q = P + 2T + 2, at most 64.
#[derive(Debug, Clone, Default)]
pub struct PatternGenerator<
    const P: usize = 32,
    const T: usize = 12,
    const M: usize = 25,
    const Q: usize = 58,
> {
    /// Control.
    pub trapezoid: Trapezoid<P, T, M, Q>,
    /// Multiplier-divider.
    pub mul_div: MulDiv<M, Q>,
}

impl<const P: usize, const T: usize, const M: usize, const Q: usize> PatternGenerator<P, T, M, Q> {
    /// Ticks from `start` to `ready`: three products and a quotient, each with a tick before it.
    pub const PREPARE_LATENCY: u64 =
        1 + 3 * (MulDiv::<M, Q>::PRODUCT_LATENCY + 1) + MulDiv::<M, Q>::LATENCY + 1;
    /// Ticks by which [`PREPARE_LATENCY`](Self::PREPARE_LATENCY) grows at most where the
    /// multiplier-divider is still at what an abort has dropped.
    pub const PREPARE_DELAY: u64 = (M + Q - 1) as u64;
    /// Ticks from `advance` to `valid`, with which `ready` comes back.
    pub const SCAN_LATENCY: u64 = 1 + MulDiv::<M, Q>::LATENCY + 1;
}

impl<const P: usize, const T: usize, const M: usize, const Q: usize> Circuit
    for PatternGenerator<P, T, M, Q>
{
    const NAME: &'static str = "pattern_generator";
    const ABOUT: &'static str =
        "a position each scan: speeds up, is steady, slows down, ends exactly";
    type In<L: Logic> = In<L, P, T>;
    type Reg<L: Logic> = Reg<L, P, T, M, Q>;
    type Net<L: Logic> = Net<L, P, T, M, Q>;

    fn comb<L: Logic>(&self, q: &Reg<L, P, T, M, Q>, i: &In<L, P, T>) -> Net<L, P, T, M, Q> {
        let trapezoid = Instance::settle(
            &self.trapezoid,
            &q.trapezoid,
            trapezoid::In {
                start: i.start,
                from: i.from,
                distance: i.distance,
                speed: i.speed,
                acceleration_time: i.acceleration_time,
                deceleration_time: i.deceleration_time,
                advance: i.advance,
                halt: i.halt,
                done: q.mul_div.done,
                quotient: q.mul_div.quotient,
                remainder: q.mul_div.remainder,
            },
        );
        let mul_div = Instance::settle(
            &self.mul_div,
            &q.mul_div,
            mul_div::In {
                start: trapezoid.w.compute,
                product_only: trapezoid.w.product_only,
                multiplicand: trapezoid.w.multiplicand,
                multiplier: trapezoid.w.multiplier,
                addend: trapezoid.w.addend,
                divisor: trapezoid.w.divisor,
            },
        );
        Net {
            trapezoid,
            mul_div,
            position: q.trapezoid.position,
            valid: q.trapezoid.valid,
            ready: q.trapezoid.ready,
            active: q.trapezoid.active,
        }
    }

    fn next<L: Logic>(
        &self,
        q: Reg<L, P, T, M, Q>,
        w: &Net<L, P, T, M, Q>,
        _: &In<L, P, T>,
    ) -> Reg<L, P, T, M, Q> {
        Reg {
            trapezoid: w.trapezoid.next(&self.trapezoid, q.trapezoid),
            mul_div: w.mul_div.next(&self.mul_div, q.mul_div),
        }
    }
}
