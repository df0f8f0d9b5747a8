//! The summary of a log for people.

use super::Summary;
use crate::cli::report::{Outcome, Report};
use std::fmt::Write;

/// Signals that are shown, unless all are asked for.
const SHOWN: usize = 16;

impl Report for Summary {
    fn outcome(&mut self) -> &mut Outcome {
        &mut self.outcome
    }

    fn write(&self, text: &mut String, all: bool) -> std::fmt::Result {
        writeln!(
            text,
            "{}: {} samples, {}, CK of {} ticks",
            self.outcome.subject(),
            self.samples,
            self.outcome.length(),
            self.ck_ticks
        )?;
        let others = match self.counts_named {
            true => "",
            false => ", the first that fits; --set log_column=NAME takes another",
        };
        writeln!(
            text,
            "times from {} in {}, by {}; counts from {}{others}\n",
            self.time_column, self.time_unit, self.time_unit_from, self.counts_column
        )?;
        self.predictions(text)?;
        self.signals(text, all)?;
        Ok(())
    }
}

impl Summary {
    fn predictions(&self, text: &mut String) -> std::fmt::Result {
        if self.predictions == 0 {
            return writeln!(text, "no prediction with a lead\n");
        }
        writeln!(text, "prediction error in counts   largest       rms")?;
        for (name, largest, rms) in [
            (
                "with the lead",
                self.error_max_counts,
                self.error_rms_counts,
            ),
            (
                "without",
                self.without_lead_max_counts,
                self.without_lead_rms_counts,
            ),
        ] {
            writeln!(text, "{name:<26}  {largest:>8.1}  {rms:>8.1}")?;
        }
        writeln!(text, "in {} CKs\n", self.predictions)
    }

    fn signals(&self, text: &mut String, all: bool) -> std::fmt::Result {
        if self.signals.is_empty() {
            return writeln!(
                text,
                "no signal: the log does not reach the target of step 0; a scenario, or \
                 --set step=[...], has others\n"
            );
        }
        let shown = match all {
            true => self.signals.len(),
            false => SHOWN.min(self.signals.len()),
        };
        let operates = self
            .signals
            .iter()
            .any(|row| row.effect_error_counts.is_some());
        writeln!(
            text,
            "signal of step    target       time      lead  position  a lead later     error{}",
            if operates { "  at effect" } else { "" }
        )?;
        for row in &self.signals[..shown] {
            let [after, error] = [row.position_after, row.error_counts].map(tenths);
            write!(
                text,
                "{:>14}  {:>8}  {:>7.3} s  {:>5.1} ms  {:>8}  {after:>12}  {error:>8}",
                row.step, row.target, row.seconds, row.lead_ms, row.position
            )?;
            if operates {
                write!(text, "  {:>9}", tenths(row.effect_error_counts))?;
            }
            text.push('\n');
        }
        writeln!(text, "times are from the first sample of the log on")?;
        let more = self.signals.len() - shown;
        if more > 0 {
            writeln!(text, "and {more} more: --segments shows all")?;
        }
        text.push('\n');
        Ok(())
    }
}

/// Counts with a digit behind the point, without the sign of what rounds to nothing.
fn tenths(counts: Option<f64>) -> String {
    counts.map_or("-".to_owned(), |counts| {
        format!("{:.1}", (counts * 10.0).round() / 10.0 + 0.0)
    })
}
