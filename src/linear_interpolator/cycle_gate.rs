//! Cycle gate: keeps the next positioning cycle back until both axes are in position.
//!
//! ```text
//!                                ┌────────────┐
//!  exact_stop ──────────────────▶│ cycle gate ├──▶ hold
//!  in_position_x, in_position_y ▶│            │
//!                                └────────────┘
//! ```
//!
//! Departure: the text has no such gate. Without it a cycle begins while the motors still follow
//! the one before, and they cut the corner.

use crate::check::{Invariants, Specified, require};
use crate::kernel::{Circuit, Nothing};
use crate::logic::Logic;
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L> {
        /// Cycles wait for the axes.
        pub exact_stop: L::Bit,
        /// X is in position.
        pub in_position_x: L::Bit,
        /// Y is in position.
        pub in_position_y: L::Bit,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L> {
        /// No new cycle begins.
        pub hold: L::Bit = 0,
    }
}

/// Cycle gate, with a tick of latency.
#[derive(Debug, Clone, Default)]
pub struct CycleGate;

impl Circuit for CycleGate {
    const NAME: &'static str = "cycle_gate";
    const ABOUT: &'static str = "holds the next cycle until both axes are in position";
    type In<L: Logic> = In<L>;
    type Reg<L: Logic> = Reg<L>;
    type Net<L: Logic> = Nothing<L>;

    fn comb<L: Logic>(&self, _: &Reg<L>, _: &In<L>) -> Nothing<L> {
        Nothing::new()
    }

    fn next<L: Logic>(&self, _: Reg<L>, _: &Nothing<L>, i: &In<L>) -> Reg<L> {
        Reg { hold: holds(i) }
    }
}

/// The level of `hold` after the edge.
fn holds<L: Logic>(i: &In<L>) -> L::Bit {
    i.exact_stop & !(i.in_position_x & i.in_position_y)
}

impl Specified for CycleGate {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new().step(
            "cycles wait for an axis that is not in position",
            |now, next| {
                let i = now.i;
                let there = [i.in_position_x, i.in_position_y]
                    .iter()
                    .all(|axis| axis.get());
                let right = next.hold.get() == (i.exact_stop.get() && !there);
                require(right, ["hold"], || format!("{:?}", next.hold))
            },
        )
    }
}
