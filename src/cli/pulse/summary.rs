//! Summary of a run or a compilation.

use super::Job;
use super::beside::Row;
use super::by_axis::ByAxis;
use super::rates::{self, Rows};
use super::verdict::complaints;
use crate::cli::report::Outcome;
use motion_rtl::jobs::pulse_interpolator::job::Played;
use motion_rtl::jobs::pulse_interpolator::step_dir::TimingMinima;
use motion_rtl::jobs::pulse_interpolator::{FollowingError, Remedy};
use serde::Serialize;

/// The summary of a run.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Summary {
    /// Fields that all summaries share.
    #[serde(flatten)]
    pub outcome: Outcome,
    /// Reset variant: the state that RST clears.
    pub variant: &'static str,
    /// True if every unit time has the pulses of its word, and every axis ended at its demanded
    /// position and met the driver's timing.
    pub exact: bool,
    /// Each axis of the run.
    pub axes: ByAxis<AxisSummary>,
    /// Step rates of each axis, and its motor.
    pub step_rates: Rows,
    /// The table.
    #[serde(flatten)]
    pub table: TableSummary,
    /// Unit times without pulses between two patterns of the memory.
    pub idle_units: u64,
    /// The device and, in a comparison, the conventional one with the same program.
    pub circuits: Vec<Row>,
}

/// The table of a run.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TableSummary {
    /// Unit times of the table.
    pub units: usize,
    /// Unit times after the end of the path.
    pub appended_units: usize,
    /// Unit times in which a demand was not attainable.
    pub unattainable_units: usize,
    /// Settings that would make every demand attainable.
    pub remedy: Option<Remedy>,
}

/// One axis of a run, as its motor driver saw it. Steps and positions are signed, from where the
/// axis began.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AxisSummary {
    /// Steps from the start to the end of the path.
    pub steps_demanded: i64,
    /// Steps up less steps down.
    pub pulses_emitted: i64,
    /// Pulses in the positive direction.
    pub pulses_up: u64,
    /// Pulses in the negative direction.
    pub pulses_down: u64,
    /// Position at the end, in steps from the drawing's origin.
    pub end_position: i64,
    /// Largest distance from the demand, at whatever time.
    pub following_error_max: FollowingError,
    /// Shortest times on the step and direction lines, in ticks; `null` where there was none.
    pub timing_min_ticks: TimingMinima,
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

/// Returns the warnings of the drawing and of its compilation into a table.
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
    pub fn new(
        job: &Job,
        played: &Played,
        errors: &[FollowingError],
        (circuits, astray): (Vec<Row>, Vec<String>),
    ) -> Self {
        let axes = job
            .report
            .axes
            .iter()
            .zip(&played.axes)
            .zip(errors)
            .map(|((report, axis), error)| AxisSummary {
                steps_demanded: report.steps_demanded,
                pulses_emitted: axis.position(),
                pulses_up: axis.pulses_up,
                pulses_down: axis.pulses_down,
                end_position: i64::from(report.start_position) + axis.position(),
                following_error_max: *error,
                timing_min_ticks: axis.minima,
            })
            .collect();
        let mut complaints = complaints(job, played);
        let exact = complaints.is_empty();
        let step_rates = rates::rows(&job.table, played);
        complaints.extend(rates::complaints(&step_rates));
        complaints.extend(astray);
        Summary {
            exact,
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
            variant: job.variant.name(),
            axes,
            step_rates,
            table: TableSummary::new(job),
            idle_units: played.idle_units,
            circuits,
        }
    }
}
