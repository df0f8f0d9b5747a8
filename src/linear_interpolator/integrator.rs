//! Integrator 24 (¶0011–0013, eq. (1)): what the slave axis moves when the master moves by δx,
//! by an integer division whose remainder takes part in the next.
//!
//! ```text
//!                     ┌────────────┐
//!  clear ────────────▶│            ├──▶ integral (I)
//!  master, slave ────▶│ integrator ├──▶ remainder (B)
//!  start, increment ─▶│            ├──▶ busy, valid
//!                     └────────────┘
//! ```
//!
//! `(Δy·δx + B) / Δx + I → I`, remainder `→ B`; so `Δx·I + B = Δy·Σδx + B0` on every scan.

use super::{Accumulator, Rule, accumulator};
use crate::blocks::{MulDiv, mul_div};
use crate::kernel::{Circuit, Instance};
use crate::logic::Logic;
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const P: usize> {
        /// A positioning cycle begins: I and B take their first values.
        pub clear: L::Bit,
        /// Δx: signed distance of the master axis, constant from `clear` on for the whole cycle.
        pub master: L::I<P>,
        /// Δy: signed distance of the slave axis, constant likewise.
        pub slave: L::I<P>,
        /// An increment is given; not taken while `busy`.
        pub start: L::Bit,
        /// δx(n): what the master moves in this scan.
        pub increment: L::I<P>,
    }
}

signals! {
    /// Registers of the blocks.
    pub struct Reg<L, const P: usize, const R: usize> {
        /// I and B.
        pub accumulator: accumulator::Reg<L, P>,
        /// The divider.
        pub mul_div: mul_div::Reg<L, P, R>,
    }
}

signals! {
    /// Nets of the blocks, and the ports out.
    pub struct Net<L, const P: usize, const R: usize> {
        /// I and B.
        pub accumulator: Instance<Accumulator<P, R>, L>,
        /// The divider.
        pub mul_div: Instance<MulDiv<P, R>, L>,
        /// I: what the slave has moved since the cycle began.
        pub integral: L::I<P> as Analog,
        /// B: what the division has left over.
        pub remainder: L::I<P> as Analog,
        /// A start is not taken.
        pub busy: L::Bit,
        /// I and B are new in this tick.
        pub valid: L::Bit,
    }
}

/// Integrator 24 of positions of `P` bits, with a divider of `R` = 2·`P` bits.
///
/// `valid` comes [`LATENCY`](Integrator::LATENCY) ticks after `start`: one bit of the product and
/// one bit of the quotient a tick.
#[derive(Debug, Clone, Default)]
pub struct Integrator<const P: usize, const R: usize> {
    /// I and B.
    pub accumulator: Accumulator<P, R>,
    /// The divider.
    pub mul_div: MulDiv<P, R>,
}

impl<const P: usize, const R: usize> Integrator<P, R> {
    /// Ticks from `start` to `valid`.
    pub const LATENCY: u64 = MulDiv::<P, R>::LATENCY + 1;

    /// An integrator that rounds by `rule`.
    pub fn new(rule: Rule) -> Self {
        Integrator {
            accumulator: Accumulator { rule },
            mul_div: MulDiv,
        }
    }
}

impl<const P: usize, const R: usize> Circuit for Integrator<P, R> {
    const NAME: &'static str = "integrator";
    const ABOUT: &'static str = "what the slave axis moves, by integer division with remainder";
    type In<L: Logic> = In<L, P>;
    type Reg<L: Logic> = Reg<L, P, R>;
    type Net<L: Logic> = Net<L, P, R>;

    fn comb<L: Logic>(&self, q: &Reg<L, P, R>, i: &In<L, P>) -> Net<L, P, R> {
        let accumulator = Instance::settle(
            &self.accumulator,
            &q.accumulator,
            accumulator::In {
                clear: i.clear,
                master: i.master,
                slave: i.slave,
                start: i.start,
                increment: i.increment,
                done: q.mul_div.done,
                quotient: q.mul_div.quotient,
                rest: q.mul_div.remainder,
            },
        );
        let mul_div = Instance::settle(
            &self.mul_div,
            &q.mul_div,
            mul_div::In {
                start: accumulator.w.divide,
                product_only: false.into(),
                multiplicand: accumulator.w.multiplicand,
                multiplier: accumulator.w.multiplier,
                addend: accumulator.w.addend,
                divisor: accumulator.w.divisor,
            },
        );
        Net {
            integral: q.accumulator.integral,
            remainder: q.accumulator.remainder,
            busy: q.accumulator.busy,
            valid: q.accumulator.valid,
            accumulator,
            mul_div,
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, P, R>, w: &Net<L, P, R>, _: &In<L, P>) -> Reg<L, P, R> {
        Reg {
            accumulator: w.accumulator.next(&self.accumulator, q.accumulator),
            mul_div: w.mul_div.next(&self.mul_div, q.mul_div),
        }
    }
}
