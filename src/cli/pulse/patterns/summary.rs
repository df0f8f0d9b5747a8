//! Summary of a run of patterns.

use super::Job;
use crate::cli::columns::Table;
use crate::cli::pulse::by_axis::ByAxis;
use crate::cli::pulse::rates::{self, Rows};
use crate::cli::pulse::text::timing;
use crate::cli::pulse::verdict::miscount;
use crate::cli::report::{Outcome, Report};
use motion_rtl::circuits::pulse_interpolator::AXIS_NAMES;
use motion_rtl::jobs::pulse_interpolator::job::Played;
use motion_rtl::jobs::pulse_interpolator::positions::steps_of;
use motion_rtl::jobs::pulse_interpolator::step_dir::TimingMinima;
use motion_rtl::jobs::pulse_interpolator::{self, AxisScaling, StepTiming};
use serde::Serialize;
use std::fmt::Write as _;

/// Summary of a run of patterns.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Summary {
    /// Fields that all summaries share.
    #[serde(flatten)]
    outcome: Outcome,
    /// Reset variant: the state that RST clears.
    variant: &'static str,
    /// True if every unit time has the pulses of its word and every axis met the driver's timing.
    exact: bool,
    /// True without a control computer.
    standalone: bool,
    /// Commands that the control computer gave.
    commands: usize,
    /// Number of times that it wrote T during playback.
    rewrites: usize,
    /// Words of memory per axis: used by the patterns, and in total.
    memory_words: [u64; 2],
    /// Patterns of the memory.
    patterns: Vec<PatternSummary>,
    /// Each axis of the run.
    axes: ByAxis<AxisSummary>,
    /// Step rates of each axis, and its motor.
    step_rates: Rows,
    /// Unit times played.
    units: usize,
    /// Unit times without pulses between two patterns.
    idle_units: u64,
}

/// A pattern of the memory.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct PatternSummary {
    /// Name of the pattern.
    name: String,
    /// Table of the pattern.
    table: String,
    /// First and last address.
    addresses: [u64; 2],
    /// Unit times T in the order of playback.
    unit_ticks: Vec<u32>,
    /// True if the path in the input ends where it begins.
    closed: bool,
    /// Steps from the start to the end of the played pattern, per axis.
    end_steps: Vec<i64>,
    /// Factor by which the data were scaled.
    scale: Option<String>,
    /// Effect of scaling on each axis; on a closed path `drift_steps` is the gap.
    scaling: Option<Vec<AxisScaling>>,
}

/// An axis, as its motor driver saw it.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(super) struct AxisSummary {
    /// Pulses in the positive direction.
    pulses_up: u64,
    /// Pulses in the negative direction.
    pulses_down: u64,
    /// Position at the end, in steps.
    end_position: i64,
    /// Shortest times on the step and direction lines, in ticks.
    timing_min_ticks: TimingMinima,
}

/// Steps of each axis over a table, by the count law.
fn steps(table: &pulse_interpolator::Table) -> Vec<i64> {
    let mut steps = vec![0; table.axes()];
    for (period, words) in table.iter() {
        for (sum, word) in steps.iter_mut().zip(words.iter()) {
            *sum += steps_of(*word, period);
        }
    }
    steps
}

/// The axes that played a table, and what is wrong with them.
pub(super) fn axes(
    table: &pulse_interpolator::Table,
    played: &Played,
    timing: &StepTiming,
) -> (ByAxis<AxisSummary>, Vec<String>) {
    let mut complaints = Vec::new();
    let mut axes = Vec::new();
    for (axis, (name, seen)) in AXIS_NAMES.into_iter().zip(&played.axes).enumerate() {
        let miscounted = miscount(table, played, axis);
        let short = seen.minima.too_short(timing);
        let all = miscounted.into_iter().chain(short);
        complaints.extend(all.map(|text| format!("{name}: {text}")));
        axes.push(AxisSummary {
            pulses_up: seen.pulses_up,
            pulses_down: seen.pulses_down,
            end_position: seen.position(),
            timing_min_ticks: seen.minima,
        });
    }
    (axes.into_iter().collect(), complaints)
}

/// Returns numbers with commas between them.
fn joined(numbers: &[impl ToString]) -> String {
    let numbers: Vec<_> = numbers.iter().map(ToString::to_string).collect();
    numbers.join(", ")
}

/// Writes a row for each axis.
pub(super) fn write_axes(axes: &ByAxis<AxisSummary>, text: &mut String) -> std::fmt::Result {
    let axes = Table::of(axes.iter())
        .left("axis", 4, |(name, _)| name)
        .col("up", 6, |(_, axis)| axis.pulses_up)
        .col("down", 6, |(_, axis)| axis.pulses_down)
        .col("end position", 0, |(_, axis)| axis.end_position);
    timing(axes, |(_, axis)| axis.timing_min_ticks).write(text)
}

impl Summary {
    pub fn new(job: &Job, played: &Played) -> Self {
        let stored = &job.stored;
        let (axes, mut complaints) = axes(&stored.played, played, &job.timing);
        let patterns = job.patterns.iter().zip(&stored.places);
        let patterns = patterns.map(|(pattern, place)| PatternSummary {
            name: pattern.keys.name.clone(),
            table: pattern.keys.table.display().to_string(),
            addresses: *place,
            unit_ticks: pattern
                .given
                .patterns()
                .iter()
                .map(|part| part.period)
                .collect(),
            closed: steps(&pattern.given).iter().all(|steps| *steps == 0),
            end_steps: steps(&pattern.table),
            scale: pattern.keys.scale.clone(),
            scaling: pattern.scaling.clone(),
        });
        let exact = complaints.is_empty();
        let step_rates = rates::rows(&stored.played, played);
        complaints.extend(rates::complaints(&step_rates));
        Summary {
            exact,
            variant: job.scenario.variant.name(),
            standalone: job.scenario.standalone,
            commands: stored.commands.len(),
            rewrites: stored.writes.len(),
            memory_words: [
                stored.places.last().map_or(0, |[_, last]| last + 1),
                1 << stored.group.widths.address,
            ],
            patterns: patterns.collect(),
            axes,
            step_rates,
            units: stored.played.units(),
            idle_units: played.idle_units,
            outcome: Outcome {
                complaints,
                ..Outcome::new(
                    "pulse_interpolator",
                    &job.stem,
                    job.scenario.clock_hz,
                    played.ticks,
                )
            },
        }
    }
}

impl Report for Summary {
    fn outcome(&mut self) -> &mut Outcome {
        &mut self.outcome
    }

    fn write(&self, text: &mut String, _: bool) -> std::fmt::Result {
        let (subject, length) = (self.outcome.subject(), self.outcome.length());
        writeln!(text, "{subject} ({}): {length}", self.variant)?;
        let [taken, room] = self.memory_words;
        let by = match (self.standalone, self.commands) {
            (true, _) => "no control computer".to_owned(),
            (false, 1) => "1 command".to_owned(),
            (false, commands) => format!("{commands} commands"),
        };
        let by = match self.rewrites {
            0 => by,
            1 => format!("{by}, T rewritten once"),
            times => format!("{by}, T rewritten {times} times"),
        };
        writeln!(
            text,
            "{taken} of {room} words of the memory, none rewritten; {by}\n"
        )?;
        Table::of(&self.patterns)
            .left("pattern", 12, |pattern| &pattern.name)
            .col("addresses", 0, |pattern| {
                let [first, last] = pattern.addresses;
                format!("{first}-{last}")
            })
            .col("T (ticks)", 13, |pattern| joined(&pattern.unit_ticks))
            .left("end (steps)", 0, |pattern| joined(&pattern.end_steps))
            .write(text)?;
        for pattern in &self.patterns {
            let scaled = pattern.scale.iter().zip(&pattern.scaling);
            for (ratio, axes) in scaled {
                let name = &pattern.name;
                writeln!(text, "{name}: data times {ratio}")?;
                for (axis, name) in axes.iter().zip(AXIS_NAMES) {
                    let end = match pattern.closed {
                        true => "the closed path ends",
                        false => "the end is",
                    };
                    writeln!(
                        text,
                        "  {name}: {end} {:+.3} steps off, at most {:.3} pulses in a unit time",
                        axis.drift, axis.largest_deviation
                    )?;
                }
            }
        }
        text.push('\n');
        write_axes(&self.axes, text)?;
        text.push('\n');
        rates::write(&self.step_rates, text)?;
        writeln!(text, "\n{} unit times", self.units)?;
        if self.idle_units > 0 {
            let idle = self.idle_units;
            writeln!(
                text,
                "{idle} unit times without pulses between two patterns"
            )?;
        }
        Ok(())
    }
}
