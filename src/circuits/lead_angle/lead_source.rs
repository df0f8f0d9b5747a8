//! Sources of a compensator's lead.

use super::{
    Compensator, Division, Form, LeadTable, Memory, SpeedLead, TableLead, TimeLead, Widths, grid,
    speed_lead, table_lead, time_lead,
};
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

impl LeadFrom {
    /// Returns the form of the lead of a time; for other leads that of the figures.
    pub(super) fn form(&self) -> LeadForm {
        match self {
            LeadFrom::Time { form, .. } => *form,
            LeadFrom::Speed | LeadFrom::Table(_) => LeadForm::default(),
        }
    }

    /// Returns name and description of a compensator with this lead.
    pub(super) fn compensator(&self) -> (&'static str, &'static str) {
        match self {
            LeadFrom::Time { memory, .. } => match memory {
                Memory::ShiftRegister => (Compensator::NAME, Compensator::ABOUT),
                Memory::Ram => (
                    "ram_compensator",
                    "lead-angle compensator with its history in a RAM",
                ),
            },
            LeadFrom::Speed => (
                "conventional_compensator",
                "compensator whose lead is measured speed times a parameter",
            ),
            LeadFrom::Table(_) => (
                "conventional_compensator",
                "compensator whose lead is read from a memory by the speed",
            ),
        }
    }
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

impl LeadSource {
    /// Returns the circuit of a compensator's lead.
    pub(super) fn of(from: &LeadFrom, widths: &Widths) -> Self {
        let Widths {
            stages,
            position,
            cks: gate,
            ..
        } = *widths;
        match from {
            LeadFrom::Time { memory, form } => {
                Self::Time(form.time_lead(*memory, stages, position))
            }
            LeadFrom::Speed => Self::Speed(SpeedLead { position, gate }),
            LeadFrom::Table(table) => Self::Table(TableLead {
                position,
                gate,
                table: table.clone(),
            }),
        }
    }
}

/// Inputs of all leads; each takes its own.
pub(super) struct LeadIn {
    /// CK.
    pub(super) ck: Bit,
    /// Discards the samples taken so far.
    pub(super) restart: Bit,
    /// The position.
    pub(super) position: I,
    /// The time data of this step.
    pub(super) data: U,
    /// a of Fig. 7.
    pub(super) lead_parameter: U,
    /// CKs of a gate of Fig. 7.
    pub(super) gate: U,
}

/// Outputs of a lead.
pub(super) struct Lead {
    /// Dx: the present sample.
    pub(super) present: I,
    /// The lead; of products the place itself.
    pub(super) lead: I,
    /// Sample and lead are new in this tick.
    pub(super) fresh: Bit,
    /// The samples reach back as far as the lead needs.
    pub(super) enough: Bit,
    /// Δt in CKs, whatever the format of the time data.
    pub(super) time: U,
}

impl LeadPart {
    /// Settles it.
    pub(super) fn settle(self, i: LeadIn) -> Lead {
        let (ck, restart, position, gate) = (i.ck, i.restart, i.position, i.gate);
        let (present, lead, fresh, enough, time) = match self {
            LeadPart::Time(part) => {
                let ports = time_lead::In {
                    ck,
                    restart,
                    position,
                    lead_time: i.data,
                };
                let w = part.settle(ports).w;
                (w.present, w.lead, w.fresh, w.enough, w.code)
            }
            LeadPart::Speed(part) => {
                let ports = speed_lead::In {
                    ck,
                    restart,
                    position,
                    lead_parameter: i.lead_parameter,
                    gate,
                };
                let w = part.settle(ports).w;
                (w.present, w.lead, w.fresh, w.enough, None)
            }
            LeadPart::Table(part) => {
                let ports = table_lead::In {
                    ck,
                    restart,
                    position,
                    gate,
                };
                let w = part.settle(ports).w;
                (w.present, w.lead, w.fresh, w.enough, None)
            }
        };
        Lead {
            present,
            lead,
            fresh,
            enough,
            time: time.unwrap_or(i.data),
        }
    }
}
