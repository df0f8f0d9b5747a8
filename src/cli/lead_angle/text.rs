//! The summary for people.

use super::summary::{Lead, Phase, StepSummary, Summary, SystemSummary, error_name};
use crate::cli::report::{Outcome, Report};
use motion_rtl::jobs::lead_angle::settings::{Action, Detector, Function, LeadBy, LeadForm};
use std::fmt::Write;

/// Characters of a column of stop errors at least.
const SHORTEST: usize = 8;

/// A name of the settings as scenarios have it.
fn name(value: impl serde::Serialize) -> String {
    let json = serde_json::to_value(value).unwrap_or_default();
    json.as_str().unwrap_or_default().to_owned()
}

/// A lead time and its code below their heads.
fn columns(lead: &Lead) -> String {
    format!(
        "  {:>5.1} ms  {:>8.1}",
        lead.lead_ms, lead.code_travel_counts
    )
}

impl Report for Summary {
    fn outcome(&mut self) -> &mut Outcome {
        &mut self.outcome
    }

    fn write(&self, text: &mut String, all: bool) -> std::fmt::Result {
        writeln!(
            text,
            "{}: {} positionings, {}, CK of {} ticks",
            self.outcome.subject(),
            self.positionings.len(),
            self.outcome.length(),
            self.settings.ck_ticks
        )?;
        writeln!(
            text,
            "{}history {}, {}lead on {}, comparing {}, complete by {}, {}\n",
            match self.settings.detector {
                Detector::Incremental => "",
                Detector::Absolute => "absolute encoder, ",
                Detector::PhaseShift => "phase-shift detector, ",
                Detector::Resolver => "resolver, ",
            },
            name(self.settings.history),
            match self.settings.form {
                LeadForm::Embodiment => String::new(),
                form => format!("form {}, ", name(form)),
            },
            name(self.settings.placement),
            name(self.settings.comparing),
            match self.settings.action {
                Action::Stop => name(self.settings.completion).replace('_', " "),
                Action::Operate => "effect".to_owned(),
            },
            match (self.settings.lead, self.settings.learn) {
                (LeadBy::Speed | LeadBy::Table, _) =>
                    format!("lead by {}", name(self.settings.lead)),
                (LeadBy::Time, true) => format!(
                    "learning {}, sign {}",
                    match self.settings.function {
                        Function::FirstOrder => "to first order",
                        Function::SecondOrder => "to second order",
                        Function::Exact => "by the exact relation",
                    },
                    name(self.settings.sign)
                ),
                (LeadBy::Time, false) => "not learning".to_owned(),
            }
        )?;
        writeln!(
            text,
            "{:<20}   largest       rms  missed  timed out",
            match self.settings.action {
                Action::Stop => "stop error in counts",
                Action::Operate => "effect error, counts",
            }
        )?;
        for system in &self.systems {
            writeln!(
                text,
                "{:<20}  {:>8}  {:>8.1}  {:>6}  {:>9}{}",
                system.name,
                system.error_max_counts,
                system.error_rms_counts,
                system.missed,
                system.timed_out,
                if system.own { "  in the waves" } else { "" },
            )?;
        }
        text.push('\n');
        for phase in &self.phases {
            self.phase(text, phase)?;
        }
        if all {
            self.every_positioning(text)?;
        }
        if self.systems.iter().any(|system| system.timed_out > 0) {
            writeln!(
                text,
                "* its time was over: where the body was then, not where it {}\n",
                match self.settings.action {
                    Action::Stop => "stopped",
                    Action::Operate => "took effect",
                }
            )?;
        }
        Ok(())
    }
}

impl Summary {
    /// The names of the systems as heads of columns.
    fn heads(&self) -> String {
        let names = self.systems.iter().map(|system| system.name);
        names.map(|name| format!("  {name:>SHORTEST$}")).collect()
    }

    /// Stop errors below their heads, with a mark where the body had not stopped.
    fn errors(&self, errors: &[i64], timed_out: &[bool]) -> String {
        let columns = self.systems.iter().zip(errors).zip(timed_out);
        let cell = |((system, error), timed_out): ((&SystemSummary, &i64), &bool)| {
            let width = system.name.len().max(SHORTEST);
            let mark = if *timed_out { "*" } else { "" };
            format!("  {:>width$}", format!("{error}{mark}"))
        };
        columns.map(cell).collect()
    }

    fn phase(&self, text: &mut String, phase: &Phase) -> std::fmt::Result {
        writeln!(
            text,
            "positionings {} to {}{}: {} of the last of each step{}",
            phase.from,
            phase.to.saturating_sub(1),
            if phase.loaded {
                ", with the other load"
            } else {
                ""
            },
            error_name(self.settings.action),
            match self.lead_times_of {
                Some(name) => format!("; lead of {name}"),
                None => String::new(),
            }
        )?;
        let compared = |step: &StepSummary| {
            let lead = step.lead.as_ref();
            lead.is_some_and(|lead| lead.settled_by_function.is_some())
        };
        writeln!(
            text,
            "step    target   speed{}{}{}",
            self.heads(),
            match self.lead_times_of {
                Some(_) => "      lead  one code  settled after",
                None => "",
            },
            match phase.steps.iter().any(compared) {
                true => "  1st, 2nd, exact",
                false => "",
            }
        )?;
        for step in &phase.steps {
            write!(
                text,
                "{:>4}  {:>8}  {:>6}{}",
                step.step,
                step.target,
                step.speed_counts_per_s,
                self.errors(&step.last_error_counts, &step.last_timed_out)
            )?;
            let after = |settled: Option<usize>| match settled {
                Some(after) => after.to_string(),
                None => "never".to_owned(),
            };
            if let Some(lead) = &step.lead {
                let settled = after(lead.settled_after);
                write!(text, "{}  {settled:>13}", columns(&lead.last))?;
                if let Some(by) = lead.settled_by_function {
                    let each = [by.first_order, by.second_order, by.exact].map(after);
                    write!(text, "  {:>15}", each.join(", "))?;
                }
            }
            text.push('\n');
        }
        text.push('\n');
        Ok(())
    }

    fn every_positioning(&self, text: &mut String) -> std::fmt::Result {
        writeln!(
            text,
            "positioning  step{}{}",
            self.heads(),
            match self.lead_times_of {
                Some(_) => "      lead  one code",
                None => "",
            }
        )?;
        for row in &self.positionings {
            writeln!(
                text,
                "{:>11}  {:>4}{}{}",
                row.positioning,
                row.step,
                self.errors(&row.error_counts, &row.timed_out),
                row.lead.as_ref().map(columns).unwrap_or_default()
            )?;
        }
        text.push('\n');
        Ok(())
    }
}
