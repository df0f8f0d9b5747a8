//! The summary for people.

use super::rates;
use super::summary::{Summary, TableSummary};
use crate::cli::columns::Table;
use crate::cli::report::{Outcome, Report};
use crate::cli::rows::{fixed, or_dash};
use motion_rtl::jobs::pulse_interpolator::step_dir::TimingMinima;
use std::fmt::Write;

/// Width of the names of circuits.
const NAME: usize = 31;

/// Appends columns of the shortest times, of which the last has a head that goes on.
pub fn timing<R>(table: Table<R>, of: impl Fn(&R) -> TimingMinima) -> Table<R> {
    table.col(" high   low setup  hold (min ticks)", 0, |row| {
        let TimingMinima {
            high,
            low,
            setup,
            hold,
        } = of(row);
        let cells = [high, low, setup, hold].map(|ticks| format!("{:>5}", or_dash(ticks)));
        format!("{:<35}", cells.join(" "))
    })
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
        let axes = Table::of(self.axes.iter())
            .left("axis", 4, |(name, _)| name)
            .col("steps demanded", 0, |(_, axis)| axis.steps_demanded)
            .col("pulses emitted", 0, |(_, axis)| axis.pulses_emitted)
            .col("up", 6, |(_, axis)| axis.pulses_up)
            .col("down", 6, |(_, axis)| axis.pulses_down)
            .col("end position", 0, |(_, axis)| axis.end_position)
            .col("following error (unit, line)", 0, |(_, axis)| {
                let error = axis.following_error_max;
                let place = format!("({}, {})", error.unit, error.line);
                format!("{:.3} steps {place:>12}", error.steps)
            });
        timing(axes, |(_, axis)| axis.timing_min_ticks).write(text)?;
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
    fn played(&self, text: &mut String) -> std::fmt::Result {
        let rows = self.circuits.iter();
        let searched = rows.clone().any(|row| row.unit_ticks_least.is_some());
        let mut table = Table::of(rows)
            .left("at this program", NAME, |row| row.circuit)
            .col("unit times", 0, |row| row.units)
            .col("late", 4, |row| row.late_units);
        if searched {
            table = table.col("least T", 0, |row| or_dash(row.unit_ticks_least));
        }
        table
            .col("jitter ticks", 0, |row| fixed(row.jitter_ticks_max, 3))
            .col("error steps", 0, |row| fixed(row.end_error_steps_max, 3))
            .col("driver's times", 0, |row| match row.timing_kept {
                true => "kept",
                false => "not kept",
            })
            .write(text)
    }

    fn circuits(&self, text: &mut String) -> std::fmt::Result {
        text.push('\n');
        self.played(text)?;
        text.push('\n');
        Table::of(&self.circuits)
            .left("a circuit has", NAME, |row| row.circuit)
            .col("adders", 0, |row| row.adders)
            .col("their bits", 0, |row| row.adder_bits)
            .col("flip-flops", 0, |row| row.flip_flops)
            .col("memory bits", 0, |row| row.memory_bits)
            .write(text)
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
