//! The summary for people.

use super::rates;
use super::summary::{Minima, Summary, TableSummary};
use crate::cli::report::{Outcome, Report};
use crate::cli::rows::{fixed, or_dash, table};
use std::fmt::Write;

/// The column of the least T, where that was looked for.
const LEAST_T: usize = 3;

/// Columns of the shortest times.
pub fn timing(minima: &Minima) -> String {
    let Minima {
        high,
        low,
        setup,
        hold,
    } = minima;
    let columns = [high, low, setup, hold].map(|ticks| format!("{:>5}", or_dash(*ticks)));
    columns.join(" ")
}

impl Report for Summary {
    fn outcome(&mut self) -> &mut Outcome {
        &mut self.outcome
    }

    fn write(&self, text: &mut String, _: bool) -> std::fmt::Result {
        writeln!(
            text,
            "{} ({}): {}",
            self.outcome.subject(),
            self.variant,
            self.outcome.length()
        )?;
        text.push('\n');
        writeln!(
            text,
            "axis  steps demanded  pulses emitted      up    down  end position  following error \
             (unit, line)  high   low setup  hold (min ticks)"
        )?;
        for (name, axis) in self.axes.iter() {
            let error = axis.following_error_max;
            writeln!(
                text,
                "{name:<4}  {:>14}  {:>14}  {:>6}  {:>6}  {:>12}  {:>15} {:>12}  {}",
                axis.steps_demanded,
                axis.pulses_emitted,
                axis.pulses_up,
                axis.pulses_down,
                axis.end_position,
                format!("{:.3} steps", error.steps),
                format!("({}, {})", error.unit, error.line),
                timing(&axis.timing_min_ticks),
            )?;
        }
        text.push('\n');
        rates::write(&self.step_rates, text)?;
        text.push('\n');
        text.push_str(&self.table.text());
        if self.idle_units > 0 {
            let idle = self.idle_units;
            writeln!(
                text,
                "{idle} unit times without pulses between two patterns"
            )?;
        }
        self.circuits(text)
    }
}

impl Summary {
    /// Writes how well each device played the program, with the least T if it was searched for.
    fn played(&self, text: &mut String, name: impl Fn(&str) -> String) -> std::fmt::Result {
        let rows = self.circuits.iter();
        let searched = rows.clone().any(|row| row.unit_ticks_least.is_some());
        let mut heads = vec![
            ("at this program                ", 0),
            ("unit times", 0),
            ("late", 4),
            ("jitter ticks", 0),
            ("error steps", 0),
            ("driver's times", 0),
        ];
        if searched {
            heads.insert(LEAST_T, ("least T", 0));
        }
        let cells = rows.map(|row| {
            let kept = if row.timing_kept { "kept" } else { "not kept" };
            let mut cells = vec![
                name(row.circuit),
                row.units.to_string(),
                row.late_units.to_string(),
                fixed(row.jitter_ticks_max, 3),
                fixed(row.end_error_steps_max, 3),
                kept.to_owned(),
            ];
            if searched {
                cells.insert(LEAST_T, or_dash(row.unit_ticks_least));
            }
            cells
        });
        table(text, heads, cells)
    }

    fn circuits(&self, text: &mut String) -> std::fmt::Result {
        let name = |circuit: &str| format!("{circuit:<31}");
        text.push('\n');
        self.played(text, name)?;
        text.push('\n');
        let heads = [
            ("a circuit has                  ", 0),
            ("adders", 0),
            ("their bits", 0),
            ("flip-flops", 0),
            ("memory bits", 0),
        ];
        let cells = self.circuits.iter().map(|row| {
            [
                name(row.circuit),
                row.adders.to_string(),
                row.adder_bits.to_string(),
                row.flip_flops.to_string(),
                row.memory_bits.to_string(),
            ]
        });
        table(text, heads, cells)
    }
}

impl TableSummary {
    /// The table for people.
    pub fn text(&self) -> String {
        let mut text = format!("{} unit times", self.units);
        if self.appended_units > 0 {
            let _ = write!(
                text,
                ", {} of them appended after the path",
                self.appended_units
            );
        }
        let _ = match (self.unattainable_units, self.remedy) {
            (0, _) => write!(text, ", every demand attainable"),
            (units, Some(remedy)) => write!(
                text,
                ", {units} with a demand that is not attainable: with T = {} it would be",
                remedy.period
            ),
            (units, None) => write!(
                text,
                ", {units} with a demand that is not attainable, nor with a shorter T"
            ),
        };
        text + "\n"
    }
}
