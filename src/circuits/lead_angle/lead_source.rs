//! Sources of a compensator's lead.

use super::{Division, Form, LeadTable, Memory, SpeedLead, TableLead, TimeLead, grid};
use crate::prelude::*;
use serde::{Deserialize, Serialize};

/// The forms of the time lead that the text gives as equal, each in a compensator.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LeadForm {
    /// Fig. 1: N by the logic circuit 13, subtractor 15 after the take-out 14, multiplier 16.
    #[default]
    Embodiment,
    /// Time data that hold N and Δt/N, without 13.
    DividedTime,
    /// N fixed at 1, without 13 and 16; a history ten times as long for the same times.
    FixedRatio,
    /// (N + 1)·Dx − N·Dx(−Δt/N), without 15 and 17.
    Products,
    /// 2·Dx − Dx(−Δt): the products with N fixed at 1, without 13, 15, 16 and 17.
    FixedRatioProducts,
    /// Subtractor 15 between memory 11 and take-out 14.
    EarlyDifference,
}

impl LeadForm {
    /// All of them.
    pub const ALL: &[Self] = &[
        LeadForm::Embodiment,
        LeadForm::DividedTime,
        LeadForm::FixedRatio,
        LeadForm::Products,
        LeadForm::FixedRatioProducts,
        LeadForm::EarlyDifference,
    ];

    /// Returns the source of its N.
    #[must_use]
    pub fn division(self) -> Division {
        match self {
            LeadForm::DividedTime => Division::Beforehand,
            LeadForm::FixedRatio | LeadForm::FixedRatioProducts => Division::One,
            _ => Division::Logic,
        }
    }

    /// Returns the method of its prediction.
    #[must_use]
    pub fn form(self) -> Form {
        match self {
            LeadForm::Products | LeadForm::FixedRatioProducts => Form::Products,
            LeadForm::EarlyDifference => Form::EarlyDifference,
            _ => Form::Difference,
        }
    }

    /// The time lead of this form, for the times that `stages` stages allow with the ratios of the
    /// table.
    #[must_use]
    pub fn time_lead(self, memory: Memory, stages: usize, position: usize) -> TimeLead {
        TimeLead {
            stages: grid::history(self.division(), stages),
            position,
            memory,
            division: self.division(),
            form: self.form(),
        }
    }
}

/// Source of a compensator's lead.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum LeadFrom {
    /// The time Δt.
    Time {
        /// Memory of the history.
        memory: Memory,
        /// One of the equal forms.
        form: LeadForm,
    },
    /// The speed times a parameter, as in Fig. 7.
    Speed,
    /// The speed by a memory of leads, as in Fig. 7 too.
    Table(LeadTable),
}

choice! {
    /// Circuit of the lead.
    pub enum LeadSource as LeadPart {
        /// The lead of a time.
        Time(TimeLead),
        /// The conventional lead, a product.
        Speed(SpeedLead),
        /// The conventional lead from a memory.
        Table(TableLead),
    }
}
