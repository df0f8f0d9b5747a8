//! The summary of a log for people.

use super::Summary;
use crate::cli::columns::Table;
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
        let of = &self.predictions;
        if of.count == 0 {
            return writeln!(text, "no prediction with a lead\n");
        }
        let with = ("with the lead", of.largest, of.rms);
        let without = ("without", of.largest_without, of.rms_without);
        Table::of([with, without])
            .left("prediction error in counts", 0, |(name, ..)| *name)
            .col("largest", 8, |(_, largest, _)| format!("{largest:.1}"))
            .col("rms", 8, |(.., rms)| format!("{rms:.1}"))
            .write(text)?;
        writeln!(text, "in {} CKs\n", of.count)
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
        let mut table = Table::of(&self.signals[..shown])
            .col("signal of step", 0, |row| row.step)
            .col("target", 8, |row| row.target)
            .col("time", 9, |row| format!("{:.3} s", row.seconds))
            .col("lead", 8, |row| format!("{:.1} ms", row.lead_ms))
            .col("position", 0, |row| row.position)
            .col("a lead later", 0, |row| tenths(row.position_after))
            .col("error", 8, |row| tenths(row.error_counts));
        if operates {
            table = table.col("at effect", 0, |row| tenths(row.effect_error_counts));
        }
        table.write(text)?;
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
