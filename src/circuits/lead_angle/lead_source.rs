//! What a compensator can take its lead from.

use super::{LeadTable, Memory, SpeedLead, TableLead, TimeLead};
use crate::hdl::prelude::*;

/// Where a compensator's lead comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum LeadFrom {
    /// The time Δt, with what keeps the history.
    Time(Memory),
    /// The speed times a parameter, as in Fig. 7.
    Speed,
    /// The speed by a memory of leads, as in Fig. 7 too.
    Table(LeadTable),
}

choice! {
    /// What makes the lead.
    pub enum LeadSource as LeadPart {
        /// The lead of a time.
        Time(TimeLead),
        /// The conventional lead, a product.
        Speed(SpeedLead),
        /// The conventional lead from a memory.
        Table(TableLead),
    }
}
