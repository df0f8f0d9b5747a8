//! What a run or a compilation came to, for people and for machines.

use super::job::Job;
use super::report::{Outcome, Report};
use super::verdict::complaints;
use motion_rtl::pulse_interpolator::job::Played;
use motion_rtl::pulse_interpolator::step_dir::TimingMinima;
use motion_rtl::pulse_interpolator::{AXIS_NAMES, FollowingError, Remedy, StepTiming, Variant};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// The summary of a run.
#[derive(Debug, Serialize)]
pub struct Summary {
    /// What it has as all others.
    #[serde(flatten)]
    pub outcome: Outcome,
    /// What RST cleared.
    pub variant: &'static str,
    /// Whether every unit time has the pulses that its word makes, and every axis ended where it
    /// should and kept the driver's timing.
    pub exact: bool,
    /// Each axis by its name.
    pub axes: BTreeMap<&'static str, AxisSummary>,
    /// The table.
    #[serde(flatten)]
    pub table: TableSummary,
    /// Unit times without pulses between two patterns of the memory.
    pub idle_units: u64,
}

/// The table of a run.
#[derive(Debug, Serialize)]
pub struct TableSummary {
    /// Unit times.
    pub units: usize,
    /// Unit times after the end of the path.
    pub appended_units: usize,
    /// Unit times in which a demand was not attainable.
    pub unattainable_units: usize,
    /// What would make every demand attainable.
    pub remedy: Option<Remedy>,
}

/// One axis of a run, as its motor driver saw it. Steps and positions are signed, from where the
/// axis began.
#[derive(Debug, Serialize)]
pub struct AxisSummary {
    /// Steps from the start to the end of the path.
    pub steps_demanded: i64,
    /// Steps up less steps down.
    pub pulses_emitted: i64,
    /// Steps up.
    pub pulses_up: u64,
    /// Steps down.
    pub pulses_down: u64,
    /// Position at the end, in steps from the drawing's origin.
    pub end_position: i64,
    /// Largest distance from the demand at the end of a unit time.
    pub following_error_max: FollowingError,
    /// Shortest times on the step and direction lines, in ticks; `null` where there was none.
    pub timing_min_ticks: Minima,
}

/// Shortest times on the step and direction lines, in ticks.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Minima {
    high: Option<u64>,
    low: Option<u64>,
    setup: Option<u64>,
    hold: Option<u64>,
}

impl From<TimingMinima> for Minima {
    fn from(minima: TimingMinima) -> Self {
        let TimingMinima {
            high,
            low,
            setup,
            hold,
        } = minima;
        Minima {
            high,
            low,
            setup,
            hold,
        }
    }
}

impl Minima {
    /// The times that are shorter than a driver asks for that wants `timing`.
    pub fn too_short(&self, timing: &StepTiming) -> impl Iterator<Item = String> {
        [
            ("step high time", self.high, timing.min_high),
            ("step low time", self.low, timing.min_low),
            ("direction setup time", self.setup, timing.dir_setup),
            ("direction hold time", self.hold, timing.dir_hold),
        ]
        .into_iter()
        .filter_map(|(what, least, limit)| {
            let ticks = least.filter(|&ticks| ticks < u64::from(limit))?;
            Some(format!(
                "{what} of {ticks} ticks where the driver asks for {limit}"
            ))
        })
    }
}

impl TableSummary {
    /// The table of a job.
    pub fn new(job: &Job) -> Self {
        TableSummary {
            units: job.report.units,
            appended_units: job.report.appended_units,
            unattainable_units: job.report.unattainable_units,
            remedy: job.report.remedy,
        }
    }
}

/// What was skipped or assumed on the way to a job's table.
pub fn warnings(job: &Job) -> Vec<String> {
    let mut warnings: Vec<String> = job
        .drawing
        .warnings
        .iter()
        .map(ToString::to_string)
        .collect();
    for axis in &job.report.undriven {
        warnings.push(format!(
            "{}: the drawing moves in {axis}, which no axis drives",
            job.drawing.file
        ));
    }
    if job
        .report
        .axes
        .iter()
        .all(|axis| axis.pulses_emitted() == 0)
    {
        warnings.push(format!("{}: no axis makes a step", job.drawing.file));
    }
    warnings
}

impl Summary {
    /// The summary of a job that was played.
    pub fn new(job: &Job, played: &Played, errors: &[FollowingError]) -> Self {
        let axes: BTreeMap<_, _> = job
            .report
            .axes
            .iter()
            .zip(&played.axes)
            .zip(errors)
            .zip(AXIS_NAMES)
            .map(|(((report, axis), error), name)| {
                let summary = AxisSummary {
                    steps_demanded: report.steps_demanded,
                    pulses_emitted: axis.position(),
                    pulses_up: axis.pulses_up,
                    pulses_down: axis.pulses_down,
                    end_position: i64::from(report.start_position) + axis.position(),
                    following_error_max: *error,
                    timing_min_ticks: axis.minima.into(),
                };
                (name, summary)
            })
            .collect();
        let complaints = complaints(job, played);
        Summary {
            exact: complaints.is_empty(),
            outcome: Outcome {
                complaints,
                warnings: warnings(job),
                ..Outcome::new(
                    "pulse_interpolator",
                    &job.drawing.file,
                    job.settings.clock_hz,
                    played.ticks,
                )
            },
            variant: match job.variant {
                Variant::Safe => "safe",
                Variant::Literal => "literal",
            },
            axes,
            table: TableSummary::new(job),
            idle_units: played.idle_units,
        }
    }
}

impl Report for Summary {
    fn outcome(&mut self) -> &mut Outcome {
        &mut self.outcome
    }

    fn write(&self, text: &mut String, _: bool) -> std::fmt::Result {
        let Outcome {
            input,
            circuit,
            ticks,
            seconds,
            clock_hz,
            ..
        } = &self.outcome;
        let variant = self.variant;
        writeln!(
            text,
            "{input} on {circuit} ({variant}): {ticks} ticks, {seconds:.3} s at {clock_hz} Hz"
        )?;
        text.push('\n');
        writeln!(
            text,
            "axis  steps demanded  pulses emitted      up    down  end position  following error \
             (unit, line)  high   low setup  hold (min ticks)"
        )?;
        for (name, axis) in &self.axes {
            let error = axis.following_error_max;
            let least = |ticks: Option<u64>| ticks.map_or("-".to_owned(), |t| t.to_string());
            let Minima {
                high,
                low,
                setup,
                hold,
            } = axis.timing_min_ticks;
            writeln!(
                text,
                "{name:<4}  {:>14}  {:>14}  {:>6}  {:>6}  {:>12}  {:>15} {:>12}  {:>5} {:>5} {:>5} {:>5}",
                axis.steps_demanded,
                axis.pulses_emitted,
                axis.pulses_up,
                axis.pulses_down,
                axis.end_position,
                format!("{:.3} steps", error.steps),
                format!("({}, {})", error.unit, error.line),
                least(high),
                least(low),
                least(setup),
                least(hold),
            )?;
        }
        text.push('\n');
        text.push_str(&self.table.text());
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
