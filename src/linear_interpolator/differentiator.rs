//! Differentiator 21 (¶0013): delay element 22 and subtractor 23. How far the position command has
//! moved since the scan before.
//!
//! ```text
//!               ┌────────────────┐
//!  load, from ─▶│                │
//!  valid ──────▶│ differentiator ├──▶ increment
//!  position ───▶│                │
//!               └────────────────┘
//! ```
//!
//! Departure: the delay element is loaded with the start at the beginning of a positioning cycle,
//! so that the first increment is that of the first scan.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const P: usize> {
        /// A positioning cycle begins.
        pub load: L::Bit,
        /// Where it begins.
        pub from: L::I<P>,
        /// `position` is new.
        pub valid: L::Bit,
        /// Position command x(n).
        pub position: L::I<P> as Analog,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const P: usize> {
        /// 22: the position command of the scan before, x(n − 1).
        pub(crate) lagged: L::I<P> as Analog = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const P: usize> {
        /// 23: δx(n), which is meant in the tick of `valid`.
        pub increment: L::I<P>,
    }
}

/// Differentiator 21 of a position of `P` bits; without latency.
#[derive(Debug, Clone, Default)]
pub struct Differentiator<const P: usize>;

impl<const P: usize> Circuit for Differentiator<P> {
    const NAME: &'static str = "differentiator";
    const ABOUT: &'static str = "increment of the position command since the scan before";
    type In<L: Logic> = In<L, P>;
    type Reg<L: Logic> = Reg<L, P>;
    type Net<L: Logic> = Net<L, P>;

    fn comb<L: Logic>(&self, q: &Reg<L, P>, i: &In<L, P>) -> Net<L, P> {
        Net {
            increment: i.position - q.lagged,
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, P>, _: &Net<L, P>, i: &In<L, P>) -> Reg<L, P> {
        Reg {
            lagged: i.load.mux(i.from, i.valid.mux(i.position, q.lagged)),
        }
    }
}

impl<const P: usize> Specified for Differentiator<P> {
    fn invariants(&self) -> Invariants<'_, Self> {
        let modulus = 1i64 << P;
        Invariants::<Self>::new()
            .always(
                "increment and delay element add up to the position",
                move |now| {
                    let sum = now.w.increment.get() + now.q.lagged.get();
                    let right = (sum - now.i.position.get()).rem_euclid(modulus) == 0;
                    require(right, ["increment", "lagged", "position"], || {
                        format!("{sum}")
                    })
                },
            )
            .step(
                "the delay element takes the start, else a new position, else nothing",
                |now, next| {
                    let expected = match (now.i.load.get(), now.i.valid.get()) {
                        (true, _) => now.i.from,
                        (false, true) => now.i.position,
                        (false, false) => now.q.lagged,
                    };
                    require(next.lagged == expected, ["lagged"], || {
                        format!("{:?}", next.lagged)
                    })
                },
            )
    }
}
