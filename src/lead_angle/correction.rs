//! Correction 23: from a completed positioning to the next lead time of its step.
//!
//! ```text
//!                               ┌────────────┐
//!  fire, complete, position ───▶│            ├──▶ overrun, error
//!  target, lead_time ──────────▶│ correction ├──▶ learned, learned_time
//!  learn, missed, seed ────────▶│            ├──▶ corrected
//!                               └────────────┘
//! ```
//!
//! Error 27, position register 30 and overrun 31, the arithmetic 28 with a sequential
//! multiplier-divider, and the [ratio logic](super::ratio_logic) to put the result on the grid.

use super::{CorrectionArithmetic, RatioLogic, Sign, StopError};
use super::{correction_arithmetic, ratio_logic, stop_error};
use crate::blocks::{MulDiv, mul_div};
use crate::kernel::{Circuit, Instance, Nothing};
use crate::logic::Logic;
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const C: usize, const W: usize> {
        /// The control signal begins.
        pub fire: L::Bit,
        /// The positioning is complete.
        pub complete: L::Bit,
        /// Dx.
        pub position: L::I<W>,
        /// Sx, constant from `fire` to `corrected`.
        pub target: L::I<W>,
        /// Δt1, constant likewise.
        pub lead_time: L::U<C>,
        /// Times are to be learned.
        pub learn: L::Bit,
        /// The control signal was not given by the comparator.
        pub missed: L::Bit,
        /// The time that a step begins with that has none.
        pub seed: L::U<C>,
    }
}

signals! {
    /// Registers of the blocks.
    pub struct Reg<L, const C: usize, const W: usize, const R: usize> {
        /// 27, 30, 31.
        pub stop_error: stop_error::Reg<L, W>,
        /// 28.
        pub arithmetic: correction_arithmetic::Reg<L, C>,
        /// The divider.
        pub mul_div: mul_div::Reg<L, C, R>,
    }
}

signals! {
    /// Nets of the blocks, and the ports out.
    pub struct Net<
        L,
        const K: usize,
        const T: usize,
        const C: usize,
        const W: usize,
        const R: usize,
    > {
        /// 27, 30, 31.
        pub stop_error: Instance<StopError<W>, L>,
        /// 28.
        pub arithmetic: Instance<CorrectionArithmetic<K, C, W, R>, L>,
        /// The divider.
        pub mul_div: Instance<MulDiv<C, R>, L>,
        /// Puts the result on the grid.
        pub grid: Instance<RatioLogic<K, T, C>, L>,
        /// d1: the way since the control signal.
        pub overrun: L::I<W>,
        /// d2: the way past the target.
        pub error: L::I<W>,
        /// Δt2.
        pub learned_time: L::U<C>,
        /// Δt2 is new in this tick.
        pub learned: L::Bit,
        /// The correction is over, with a new time or without; one tick.
        pub corrected: L::Bit,
    }
}

/// Correction 23 with `K` stages of history, taps of `T` bits, times of `C`, positions of `W`, and
/// `R` = `W` + `C`.
///
/// `corrected` comes a tick after `complete`, or, where something is learned by a division,
/// [`LATENCY`](Correction::LATENCY) ticks after it.
#[derive(Debug, Clone, Default)]
pub struct Correction<
    const K: usize,
    const T: usize,
    const C: usize,
    const W: usize,
    const R: usize,
> {
    /// 27, 30, 31.
    pub stop_error: StopError<W>,
    /// 28.
    pub arithmetic: CorrectionArithmetic<K, C, W, R>,
    /// The divider.
    pub mul_div: MulDiv<C, R>,
    /// Puts the result on the grid.
    pub grid: RatioLogic<K, T, C>,
}

impl<const K: usize, const T: usize, const C: usize, const W: usize, const R: usize>
    Correction<K, T, C, W, R>
{
    /// Ticks from `complete` to `corrected` of a division.
    pub const LATENCY: u64 = MulDiv::<C, R>::LATENCY + 1;

    /// A correction whose error counts by `sign`.
    pub fn new(sign: Sign) -> Self {
        Correction {
            stop_error: StopError { sign },
            ..Self::default()
        }
    }
}

impl<const K: usize, const T: usize, const C: usize, const W: usize, const R: usize> Circuit
    for Correction<K, T, C, W, R>
{
    const NAME: &'static str = "correction";
    const ABOUT: &'static str = "learns the lead time of a step from how it stopped";
    type In<L: Logic> = In<L, C, W>;
    type Reg<L: Logic> = Reg<L, C, W, R>;
    type Net<L: Logic> = Net<L, K, T, C, W, R>;

    fn comb<L: Logic>(&self, q: &Reg<L, C, W, R>, i: &In<L, C, W>) -> Net<L, K, T, C, W, R> {
        let stop_error = Instance::settle(
            &self.stop_error,
            &q.stop_error,
            stop_error::In {
                fire: i.fire,
                position: i.position,
                target: i.target,
            },
        );
        let (overrun, error) = (stop_error.w.overrun, stop_error.w.error);
        let arithmetic = Instance::settle(
            &self.arithmetic,
            &q.arithmetic,
            correction_arithmetic::In {
                complete: i.complete,
                learn: i.learn,
                missed: i.missed,
                lead_time: i.lead_time,
                overrun,
                error,
                seed: i.seed,
                done: q.mul_div.done,
                quotient: q.mul_div.quotient,
            },
        );
        let mul_div = Instance::settle(
            &self.mul_div,
            &q.mul_div,
            mul_div::In {
                start: arithmetic.w.divide,
                product_only: false.into(),
                multiplicand: arithmetic.w.multiplicand,
                multiplier: arithmetic.w.multiplier,
                addend: arithmetic.w.addend,
                divisor: arithmetic.w.divisor,
            },
        );
        let grid = Instance::settle(
            &self.grid,
            &Nothing::new(),
            ratio_logic::In {
                lead_time: q.arithmetic.raw,
            },
        );
        Net {
            overrun,
            error,
            learned_time: grid.w.code,
            learned: q.arithmetic.learned,
            corrected: q.arithmetic.corrected,
            stop_error,
            arithmetic,
            mul_div,
            grid,
        }
    }

    fn next<L: Logic>(
        &self,
        q: Reg<L, C, W, R>,
        w: &Net<L, K, T, C, W, R>,
        _: &In<L, C, W>,
    ) -> Reg<L, C, W, R> {
        Reg {
            stop_error: w.stop_error.next(&self.stop_error, q.stop_error),
            arithmetic: w.arithmetic.next(&self.arithmetic, q.arithmetic),
            mul_div: w.mul_div.next(&self.mul_div, q.mul_div),
        }
    }
}
