//! Limit of the times where N is fixed at 1: replaces the ratio logic for learned and written
//! times.
//!
//! ```text
//!               ┌────────────┐
//!  lead_time ──▶│ time limit ├──▶ code, on_grid
//!               └────────────┘
//! ```
//!
//! Every CK of the history is then a time, so nothing is rounded (N=1に固定する場合はこのような論理回路13は不要).
//!
//! Departure: a time beyond the history would give no prediction, and the body would never stop.
//! The longest time of the history is used in its place, and `on_grid` is low.

use super::codes::tap_width;
use crate::prelude::*;

/// Limit of times that are taps. Combinational.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TimeLimit {
    /// Stages of history: the longest time in CKs.
    pub stages: usize,
}

signals! { for TimeLimit as c;
    /// Input ports.
    pub struct In {
        /// Δt in CKs.
        pub lead_time: U(tap_width(c.stages)),
    }
    /// Nets.
    pub struct Net {
        /// The time is longer than the history.
        beyond: Bit,
        /// The time, limited to the longest of the history.
        pub code: U(tap_width(c.stages)),
        /// The time is within the history.
        pub on_grid: Bit,
    }
}

impl Circuit for TimeLimit {
    const NAME: &'static str = "time_limit";
    const ABOUT: &'static str = "limits lead times to the length of the history, for N = 1";
    records!(In, Nothing, Net);

    fn tick(&self, i: In, _: Nothing, _: Nothing) -> (Net, Nothing) {
        let longest = U::new(self.stages as u64, i.lead_time.width());
        let beyond = longest.below(i.lead_time);
        let net = Net {
            beyond,
            code: beyond.mux(longest, i.lead_time),
            on_grid: !beyond,
        };
        (net, Nothing)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (time, w) = (now.i.lead_time, &now.w);
        let longest = self.stages as u64;
        let limited = time.below(longest).mux(time, longest);
        vec![Property::always(
            "code is lead_time limited to the history, and on_grid is low if it was limited",
            &["code", "on_grid"],
            w.code.equals(limited) & w.on_grid.equals(time.equals(w.code)),
        )]
    }
}

impl Specified for TimeLimit {}
