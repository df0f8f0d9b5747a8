//! The summary for people.

use super::summary::{Lead, Phase, StepSummary, Summary, error_name};
use crate::cli::columns::Table;
use crate::cli::report::{Outcome, Report};
use motion_rtl::jobs::lead_angle::settings::{Action, Detector, Function, LeadBy, LeadForm};
use std::fmt::Write;

/// Least width of a column of stop errors.
const SHORTEST: usize = 8;

/// Returns the name of a setting's value in scenarios.
fn name(value: impl serde::Serialize) -> String {
    let json = serde_json::to_value(value).unwrap_or_default();
    json.as_str().unwrap_or_default().to_owned()
}

/// Appends columns of a lead time and the travel of one code.
fn lead_columns<R>(table: Table<R>, of: impl Fn(&R) -> Option<Lead>) -> Table<R> {
    let cell = |show: fn(Lead) -> String| {
        let of = &of;
        move |row: &R| of(row).map_or(String::new(), show)
    };
    table
        .col("lead", 8, cell(|lead| format!("{:.1} ms", lead.lead_ms)))
        .col(
            "one code",
            0,
            cell(|lead| format!("{:.1}", lead.code_travel_counts)),
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
        let head = match self.settings.action {
            Action::Stop => "stop error in counts",
            Action::Operate => "effect error, counts",
        };
        Table::of(&self.systems)
            .left(head, 20, |system| system.name)
            .col("largest", 8, |system| system.error_max_counts)
            .col("rms", 8, |system| format!("{:.1}", system.error_rms_counts))
            .col("missed", 0, |system| system.missed)
            .col("timed out", 0, |system| system.timed_out)
            .left("", 0, |system| if system.own { "in the waves" } else { "" })
            .write(text)?;
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
    /// Appends a column of stop errors for each system, with a mark where the body had not stopped.
    fn errors<R>(&self, table: Table<R>, of: impl Fn(&R) -> (&[i64], &[bool])) -> Table<R> {
        let systems = self.systems.iter().enumerate();
        systems.fold(table, |table, (place, system)| {
            table.col(system.name, SHORTEST, |row| {
                let (errors, timed_out) = of(row);
                let mark = if timed_out[place] { "*" } else { "" };
                format!("{}{mark}", errors[place])
            })
        })
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
        let after = |settled: Option<usize>| match settled {
            Some(after) => after.to_string(),
            None => "never".to_owned(),
        };
        let table = Table::of(&phase.steps)
            .col("step", 0, |step| step.step)
            .col("target", 8, |step| step.target)
            .col("speed", 6, |step| step.speed_counts_per_s);
        let mut table = self.errors(table, |step| {
            (&step.last_error_counts, &step.last_timed_out)
        });
        if self.lead_times_of.is_some() {
            let last = |step: &&StepSummary| Some(step.lead.as_ref()?.last);
            let settled = |step: &&StepSummary| Some(after(step.lead.as_ref()?.settled_after));
            table = lead_columns(table, last)
                .col("settled after", 0, |step| settled(step).unwrap_or_default());
        }
        let functions = |step: &StepSummary| step.lead.as_ref()?.settled_by_function;
        if phase.steps.iter().any(|step| functions(step).is_some()) {
            table = table.col("1st, 2nd, exact", 0, |step| {
                functions(step).map_or(String::new(), |by| {
                    let each = [by.first_order, by.second_order, by.exact].map(after);
                    each.join(", ")
                })
            });
        }
        table.write_apart(text)
    }

    fn every_positioning(&self, text: &mut String) -> std::fmt::Result {
        let table = Table::of(&self.positionings)
            .col("positioning", 0, |row| row.positioning)
            .col("step", 0, |row| row.step);
        let mut table = self.errors(table, |row| (&row.error_counts, &row.timed_out));
        if self.lead_times_of.is_some() {
            table = lead_columns(table, |row| row.lead);
        }
        table.write_apart(text)
    }
}
