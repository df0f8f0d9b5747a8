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
use crate::circuits::blocks::{MulDiv, mul_div};
use crate::hdl::prelude::*;

/// Correction 23.
///
/// `corrected` comes a tick after `complete`, or, where something is learned by a division,
/// [`latency`](Correction::latency) ticks after it.
#[derive(Debug, Clone)]
pub struct Correction {
    /// Stages of history.
    pub stages: usize,
    /// Width of a position.
    pub position: usize,
    /// Which way the error counts.
    pub sign: Sign,
}

impl Correction {
    /// Ticks from `complete` to `corrected` of a division.
    #[must_use]
    pub fn latency(&self) -> u64 {
        self.mul_div().latency() + 1
    }

    fn arithmetic(&self) -> CorrectionArithmetic {
        CorrectionArithmetic {
            stages: self.stages,
            position: self.position,
        }
    }

    fn mul_div(&self) -> MulDiv {
        let arithmetic = self.arithmetic();
        MulDiv {
            multiplier: arithmetic.time(),
            word: arithmetic.word(),
        }
    }
}

signals! { for Correction as c;
    /// Ports in.
    pub struct In {
        /// The control signal begins.
        pub fire: Bit,
        /// The positioning is complete.
        pub complete: Bit,
        /// Dx.
        pub position: I(c.position),
        /// Sx, constant from `fire` to `corrected`.
        pub target: I(c.position),
        /// Δt1, constant likewise.
        pub lead_time: U(c.arithmetic().time()),
        /// Times are to be learned.
        pub learn: Bit,
        /// The control signal was not given by the comparator.
        pub missed: Bit,
        /// The time that a step begins with that has none.
        pub seed: U(c.arithmetic().time()),
    }
    /// The circuits inside.
    pub struct Parts {
        /// 27, 30, 31.
        pub stop_error: Part<StopError>(StopError { position: c.position, sign: c.sign }),
        /// 28.
        pub arithmetic: Part<CorrectionArithmetic>(c.arithmetic()),
        /// The divider.
        pub mul_div: Part<MulDiv>(c.mul_div()),
        /// Puts the result on the grid.
        pub grid: Part<RatioLogic>(RatioLogic { stages: c.stages }),
    }
    /// Ports out.
    pub struct Net {
        /// d1: the way since the control signal.
        pub overrun: I(c.position),
        /// d2: the way past the target.
        pub error: I(c.position),
        /// Δt2.
        pub learned_time: U(c.arithmetic().time()),
        /// Δt2 is new in this tick.
        pub learned: Bit,
        /// The correction is over, with a new time or without; one tick.
        pub corrected: Bit,
    }
}

impl Circuit for Correction {
    const NAME: &'static str = "correction";
    const ABOUT: &'static str = "learns the lead time of a step from how it stopped";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let stop_error = p.stop_error.settle(stop_error::In {
            fire: i.fire,
            position: i.position,
            target: i.target,
        });
        let arithmetic = p.arithmetic.settle(correction_arithmetic::In {
            complete: i.complete,
            learn: i.learn,
            missed: i.missed,
            lead_time: i.lead_time,
            overrun: stop_error.w.overrun,
            error: stop_error.w.error,
            seed: i.seed,
            done: p.mul_div.q.done,
            quotient: p.mul_div.q.quotient,
        });
        p.mul_div.settle(mul_div::In {
            start: arithmetic.w.divide,
            product_only: Bit::low(),
            multiplicand: arithmetic.w.multiplicand,
            multiplier: arithmetic.w.multiplier,
            addend: arithmetic.w.addend,
            divisor: arithmetic.w.divisor,
        });
        let grid = p.grid.settle(ratio_logic::In {
            lead_time: arithmetic.q.raw,
        });
        let net = Net {
            overrun: stop_error.w.overrun,
            error: stop_error.w.error,
            learned_time: grid.w.code,
            learned: arithmetic.q.learned,
            corrected: arithmetic.q.corrected,
        };
        (net, Nothing)
    }
}
