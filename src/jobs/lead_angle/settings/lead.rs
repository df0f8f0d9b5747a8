//! Lead and lead times of the settings: what they are of, and which can be set.

use super::{History, LeadBy, Placement, SettingError, Settings};
use crate::circuits::lead_angle::codes::{Code, LARGEST, STAGES, code, neighbours};
use crate::circuits::lead_angle::grid::history;
use crate::circuits::lead_angle::{Division, Form, LeadFrom};
use crate::jobs::lead_angle::lead_table::lead_table;
use crate::settings::Place;

impl Settings {
    /// Returns the source of the lead in the compensator.
    #[must_use]
    pub fn lead_from(&self) -> LeadFrom {
        match self.lead {
            LeadBy::Speed => LeadFrom::Speed,
            LeadBy::Table => LeadFrom::Table(lead_table(self)),
            LeadBy::Time => LeadFrom::Time {
                memory: self.history.memory(),
                form: self.form,
            },
        }
    }

    /// Returns the code of a lead time; `None` if it cannot be set.
    #[must_use]
    pub fn code(&self, lead_ms: f64) -> Option<u64> {
        let cks = lead_ms / self.ck_ms();
        let time = cks.round() as u64;
        // A time written in milliseconds has its rounding.
        let meant = lead_ms >= 0.0 && (cks - time as f64).abs() < 1e-6;
        (meant && (time == 0 || self.known(time).is_some())).then_some(time)
    }

    /// A lead time that can be set: one of the codes, or with N fixed at 1 any up to the longest.
    fn known(&self, time: u64) -> Option<Code> {
        code(self.stages(), time).filter(|code| code.time <= LARGEST)
    }

    /// Stages of the history, in either kind of memory.
    fn stages(&self) -> u64 {
        history(self.form.division(), STAGES as usize) as u64
    }

    /// N of a lead time: its smallest change in CKs.
    #[must_use]
    pub fn ratio(&self, time: u64) -> u64 {
        self.known(time).map_or(1, |code| code.ratio)
    }

    /// A code as a lead time in milliseconds, without the digits that floating point adds.
    #[must_use]
    pub fn lead_ms(&self, code: u64) -> f64 {
        (code as f64 * self.ck_ms() * 1e9).round() / 1e9
    }

    /// Not every form goes with every memory and placement.
    pub(super) fn validate_form(&self) -> Result<(), SettingError> {
        if self.form.form() == Form::EarlyDifference && self.history == History::Ram {
            let allowed = "another with history = \"ram\", which is its own take-out, or \
                           history = \"shift_register\"";
            return Err(SettingError::value("form", "early_difference", allowed));
        }
        if self.form.form() != Form::Products || self.placement == Placement::Position {
            return Ok(());
        }
        let value = match self.placement {
            Placement::Halves => "halves",
            _ => "target",
        };
        let form = match self.form.division() {
            Division::One => "fixed_ratio_products",
            _ => "products",
        };
        let allowed = format!("position with form = \"{form}\": its products are the place itself");
        Err(SettingError::value("placement", value, allowed))
    }

    /// Times for another load need one, and go with the steps that have a time.
    pub(super) fn validate_load_leads(&self) -> Result<(), SettingError> {
        for (index, step) in self.steps.iter().enumerate() {
            let Some(ms) = step.load_lead_ms else {
                continue;
            };
            let refused = match (self.load_change_after, self.common_time && index > 0) {
                (None, _) => Some("it with load_change_after only"),
                (_, true) => Some("none: with common_time all steps take that of step 0"),
                _ => None,
            };
            let checked = match refused {
                Some(allowed) => Err(SettingError::value("load_lead_ms", ms, allowed)),
                None => self.check_lead("load_lead_ms", ms),
            };
            checked.map_err(|error| error.at(Place::Row("step", index)))?;
        }
        Ok(())
    }

    /// A lead time must be on the grid of the codes.
    pub(super) fn check_lead(&self, field: &'static str, ms: f64) -> Result<(), SettingError> {
        if self.code(ms).is_some() {
            return Ok(());
        }
        let shown = |code: u64| self.lead_ms(code);
        let (below, above) = neighbours(self.stages(), ms / self.ck_ms());
        let allowed = match (below.min(LARGEST), above.filter(|code| *code <= LARGEST)) {
            (below, Some(above)) if ms > 0.0 => format!("{} or {}", shown(below), shown(above)),
            (below, None) if ms > 0.0 => format!("at most {}", shown(below)),
            _ => format!("0 for none, {} to {}", shown(1), shown(LARGEST)),
        };
        Err(SettingError::value(field, ms, allowed))
    }
}
