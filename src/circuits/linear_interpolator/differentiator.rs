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

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, w, next) = (&now.i, &now.q, &now.w, &now.next.q);
        let kept = !i.load & !i.valid & next.lagged.equals(q.lagged);
        let loaded = i.load & next.lagged.equals(i.from);
        let moved = !i.load & i.valid & next.lagged.equals(i.position);
        vec![
            Property::always(
                "increment plus lagged equals position",
                &["increment", "lagged", "position"],
                (w.increment + q.lagged).equals(i.position),
            ),
            Property::step(
                "lagged takes from at load, position at valid without load, and otherwise stays",
                &["lagged"],
                loaded | moved | kept,
            ),
        ]
    }
}

impl Specified for Differentiator {}
