//! Time data that need no logic circuit 13: divided into N and Δt/N beforehand, or with N fixed at 1.
//!
//! ```text
//!               ┌──────────────┐
//!  lead_time ──▶│ divided time ├──▶ ratio, tap, code
//!               └──────────────┘
//! ```
//!
//! The text allows both (N=1に固定する場合はこのような論理回路13は不要; 予め分けたデータを供給). The supplier of the data must
//! keep the taps within the history: `enough` is never high for a tap beyond it.
//!
//! Departure: a tap of 0 is no lead, whatever N comes with it.

use super::codes::{tap_width, time_width};
use crate::prelude::*;

/// Source of N.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Division {
    /// The logic circuit 13, from Δt.
    #[default]
    Logic,
    /// The time data, which hold N above Δt/N.
    Beforehand,
    /// None: N is 1, and the time data are the tap.
    One,
}

/// Divided time data. Combinational.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DividedTime {
    /// Stages of history.
    pub stages: usize,
    /// True if N is 1 and is not part of the data.
    pub one: bool,
}

impl DividedTime {
    fn tap(&self) -> usize {
        tap_width(self.stages)
    }

    /// Width of the time data.
    #[must_use]
    pub fn word(&self) -> usize {
        self.tap() + if self.one { 0 } else { 4 }
    }

    /// Width of the time that the data represent.
    #[must_use]
    pub fn time(&self) -> usize {
        match self.one {
            true => self.tap(),
            false => time_width(self.stages),
        }
    }
}

signals! { for DividedTime as c;
    /// Input ports.
    pub struct In {
        /// Time data: Δt in CKs where N is fixed at 1; otherwise N in the upper bits and Δt/N in
        /// the lower bits.
        pub lead_time: U(c.word()) as Hex,
    }
    /// Nets.
    pub struct Net {
        /// N; 0 for no lead.
        pub ratio: U(4),
        /// Δt/N: age of the earlier sample in CKs; 0 for no lead.
        pub tap: U(c.tap()),
        /// N·tap: Δt in CKs.
        pub code: U(c.time()),
    }
}

impl Circuit for DividedTime {
    const NAME: &'static str = "divided_time";
    const ABOUT: &'static str = "ratio N and tap from time data that contain them";
    records!(In, Nothing, Net);

    fn tick(&self, i: In, _: Nothing, _: Nothing) -> (Net, Nothing) {
        let tap = i.lead_time.slice(0, self.tap());
        let ratio = match self.one {
            true => (!tap.is_zero()).word().resize(4),
            false => tap.is_zero().mux(0, i.lead_time.slice(self.tap(), 4)),
        };
        let code = match self.one {
            true => tap,
            false => tap.times(ratio, self.time()),
        };
        (Net { ratio, tap, code }, Nothing)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, w) = (&now.i, &now.w);
        let tap = i.lead_time.slice(0, self.tap());
        let upper = match self.one {
            true => U::new(1, 4),
            false => i.lead_time.slice(self.tap(), 4),
        };
        let ratio = tap.is_zero().mux(0, upper);
        vec![
            Property::always(
                "ratio and tap are the two parts of lead_time, and both are 0 if tap is 0",
                &["ratio", "tap"],
                w.ratio.equals(ratio) & w.tap.equals(tap),
            ),
            Property::always(
                "code is ratio times tap",
                &["code"],
                w.code.equals(w.tap.times(w.ratio, self.time())),
            ),
        ]
    }
}

impl Specified for DividedTime {}
