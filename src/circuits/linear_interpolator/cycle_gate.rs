//! Cycle gate: holds back the next positioning cycle until both axes are in position.
//!
//! ```text
//!                                ┌────────────┐
//!  exact_stop ──────────────────▶│ cycle gate ├──▶ hold
//!  in_position_x, in_position_y ▶│            │
//!                                └────────────┘
//! ```
//!
//! Departure: the text has no such gate. Without it a cycle begins while the motors still follow
//! the previous one, and the motors cut the corner.

use crate::prelude::*;

/// Cycle gate, with a tick of latency.
#[derive(Debug, Clone, Default, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CycleGate {}

signals! { for CycleGate as c;
    /// Input ports.
    pub struct In {
        /// High: a cycle waits until both axes are in position.
        pub exact_stop: Bit,
        /// X is in position.
        pub in_position_x: Bit,
        /// Y is in position.
        pub in_position_y: Bit,
    }
    /// Flip-flops.
    pub struct Reg {
        /// Blocks the start of a new cycle.
        pub hold: Bit = 0,
    }
}

impl Circuit for CycleGate {
    const NAME: &'static str = "cycle_gate";
    const ABOUT: &'static str = "holds the next cycle until both axes are in position";
    records!(In, Reg, Nothing);

    fn tick(&self, i: In, _: Reg, _: Nothing) -> (Nothing, Reg<Edge>) {
        let hold = i.exact_stop & !(i.in_position_x & i.in_position_y);
        (Nothing, Reg { hold })
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, next) = (&now.i, &now.next.q);
        let moves = !i.in_position_x | !i.in_position_y;
        vec![Property::step(
            "hold is high one tick after exact_stop is high and an axis is not in position",
            &["hold"],
            next.hold.equals(i.exact_stop & moves),
        )]
    }
}

impl Specified for CycleGate {}
