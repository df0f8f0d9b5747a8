//! Integrator 24 (¶0011–0013, eq. (1)): computes the motion of the slave axis for an increment δx
//! of the master, by an integer division whose remainder is carried into the next one.
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

pub use super::accumulator::Motion as In;
use super::{Accumulator, Rule, accumulator};
use crate::circuits::blocks::{MulDiv, mul_div};
use crate::prelude::*;

/// Integrator 24.
///
/// `valid` comes [`latency`](Integrator::latency) ticks after `start`: one bit of the product and
/// one bit of the quotient a tick.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Integrator {
    /// Width of a position in bits; the divider has twice as many.
    pub position: usize,
    /// Rounding of a quotient.
    pub rule: Rule,
}

impl Integrator {
    const fn mul_div(&self) -> MulDiv {
        MulDiv::new(self.position, 2 * self.position)
    }

    /// Ticks from `start` to `valid`.
    #[must_use]
    pub const fn latency(&self) -> u64 {
        self.mul_div().latency() + 1
    }
}

signals! { for Integrator as c;
    /// The circuits inside.
    pub struct Parts {
        /// I and B.
        pub accumulator: Part<Accumulator>(Accumulator { position: c.position, rule: c.rule }),
        /// Divider.
        pub mul_div: Part<MulDiv>(c.mul_div()),
    }
    /// Output ports.
    pub struct Net {
        /// I: distance moved by the slave axis since the cycle began.
        pub integral: I(c.position) as Analog,
        /// B: remainder of the division, carried into the next one.
        pub remainder: I(c.position) as Analog,
        /// A division is running; a start is ignored.
        pub busy: Bit,
        /// I and B have new values in this tick.
        pub valid: Bit,
    }
}

impl Circuit for Integrator {
    const NAME: &'static str = "integrator";
    const ABOUT: &'static str = "motion of the slave axis, by integer division with remainder";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let accumulator = p.accumulator.settle(accumulator::In {
            motion: i,
            done: p.mul_div.q.done,
            quotient: p.mul_div.q.quotient,
            rest: p.mul_div.q.remainder,
        });
        p.mul_div.settle(mul_div::In {
            start: accumulator.w.divide,
            product_only: Bit::low(),
            multiplicand: accumulator.w.multiplicand,
            multiplier: accumulator.w.multiplier,
            addend: accumulator.w.addend,
            divisor: accumulator.w.divisor,
        });
        let net = Net {
            integral: accumulator.q.integral,
            remainder: accumulator.q.remainder,
            busy: accumulator.q.busy,
            valid: accumulator.q.valid,
        };
        (net, Nothing)
    }
}
