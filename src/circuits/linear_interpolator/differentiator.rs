//! Differentiator 21 (¶0013): delay element 22 and subtractor 23. Computes the increment of the
//! position command since the previous scan.
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

use super::wrapped;
use crate::prelude::*;

/// Differentiator 21; without latency.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Differentiator {
    /// Width of a position in bits.
    pub position: usize,
}

signals! { for Differentiator as c;
    /// Input ports.
    pub struct In {
        /// A positioning cycle begins.
        pub load: Bit,
        /// Position at the start of the cycle.
        pub from: I(c.position),
        /// `position` has a new value.
        pub valid: Bit,
        /// Position command x(n).
        pub position: I(c.position) as Analog,
    }
    /// Flip-flops.
    pub struct Reg {
        /// 22: position command of the previous scan, x(n − 1).
        pub(crate) lagged: I(c.position) as Analog = 0,
    }
    /// Nets.
    pub struct Net {
        /// 23: δx(n); valid in the tick of `valid`.
        pub increment: I(c.position),
    }
}

impl Circuit for Differentiator {
    const NAME: &'static str = "differentiator";
    const ABOUT: &'static str = "increment of the position command since the previous scan";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let increment = i.position - q.lagged;
        let lagged = i.load.mux(i.from, i.valid.mux(i.position, q.lagged));
        (Net { increment }, Reg { lagged })
    }
}

impl Specified for Differentiator {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .always("increment plus lagged equals position", |now| {
                let sum = now.w.increment + now.q.lagged;
                let right = wrapped(sum - now.i.position, self.position) == 0;
                require(right, ["increment", "lagged", "position"], || {
                    format!("{sum}")
                })
            })
            .step(
                "lagged takes from at load, position at valid without load, and otherwise stays",
                |now, next| {
                    let expected = match (now.i.load, now.i.valid) {
                        (true, _) => now.i.from,
                        (false, true) => now.i.position,
                        (false, false) => now.q.lagged,
                    };
                    require(next.q.lagged == expected, ["lagged"], || {
                        format!("{:?}", next.q.lagged)
                    })
                },
            )
    }
}
