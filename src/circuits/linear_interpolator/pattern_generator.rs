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

pub use super::trapezoid::Cycle as In;
use super::{Trapezoid, trapezoid};
use crate::circuits::blocks::{MulDiv, mul_div};
use crate::prelude::*;

/// Position pattern generator 14.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PatternGenerator {
    /// Width of a position in bits, the P of its ports.
    pub position: usize,
    /// Width of a time in bits, the T of its ports; fewer than a position has.
    pub time: usize,
}

impl PatternGenerator {
    const fn trapezoid(&self) -> Trapezoid {
        Trapezoid {
            position: self.position,
            time: self.time,
        }
    }

    const fn mul_div(&self) -> MulDiv {
        let trapezoid = self.trapezoid();
        MulDiv {
            multiplier: trapezoid.multiplier(),
            word: trapezoid.word(),
        }
    }

    /// Ticks from `start` to `ready`: three products and a quotient, each with a tick before it.
    #[must_use]
    pub const fn prepare_latency(&self) -> u64 {
        let mul_div = self.mul_div();
        1 + 3 * (mul_div.product_latency() + 1) + mul_div.latency() + 1
    }

    /// Largest delay, in ticks, of [`prepare_latency`](Self::prepare_latency) while the
    /// multiplier-divider finishes an aborted operation.
    #[must_use]
    pub const fn prepare_delay(&self) -> u64 {
        self.mul_div().latency() - 2
    }

    /// Ticks from `advance` to `valid`, with which `ready` comes back.
    #[must_use]
    pub const fn scan_latency(&self) -> u64 {
        1 + self.mul_div().latency() + 1
    }
}

signals! { for PatternGenerator as c;
    /// The circuits inside.
    pub struct Parts {
        /// Control.
        pub trapezoid: Part<Trapezoid>(c.trapezoid()),
        /// Multiplier-divider.
        pub mul_div: Part<MulDiv>(c.mul_div()),
    }
    /// Output ports.
    pub struct Net {
        /// x(n): position, in counts.
        pub position: I(c.position) as Analog,
        /// A new position is at `position` from this tick on.
        pub valid: Bit,
        /// Ready for `advance`.
        pub ready: Bit,
        /// A cycle is running.
        pub active: Bit,
    }
}

impl Circuit for PatternGenerator {
    const NAME: &'static str = "pattern_generator";
    const ABOUT: &'static str =
        "a position every scan: speeds up, holds speed, slows down, ends exactly";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let trapezoid = p.trapezoid.settle(trapezoid::In {
            cycle: i,
            done: p.mul_div.q.done,
            quotient: p.mul_div.q.quotient,
            remainder: p.mul_div.q.remainder,
        });
        p.mul_div.settle(mul_div::In {
            start: trapezoid.w.compute,
            product_only: trapezoid.w.product_only,
            multiplicand: trapezoid.w.multiplicand,
            multiplier: trapezoid.w.multiplier,
            addend: trapezoid.w.addend,
            divisor: trapezoid.w.divisor,
        });
        let net = Net {
            position: trapezoid.q.position,
            valid: trapezoid.q.valid,
            ready: trapezoid.q.ready,
            active: trapezoid.q.active,
        };
        (net, Nothing)
    }
}
