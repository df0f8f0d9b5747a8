//! What a compensator can take its lead from.

use super::{Memory, SpeedLead, TimeLead};
use crate::hdl::prelude::*;

/// Where a compensator's lead comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LeadFrom {
    /// The time Δt, with what keeps the history.
    Time(Memory),
    /// The speed, as in Fig. 7.
    Speed,
}

choice! {
    /// What makes the lead.
    pub enum LeadSource as LeadPart {
        /// The lead of a time.
        Time(TimeLead),
        /// The conventional lead.
        Speed(SpeedLead),
    }
}
