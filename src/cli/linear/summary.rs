//! Summary of a run.

use super::Job;
use super::rows::{Figures, Row, rows};
use super::runs::{Run, Runs};
use super::verdict::complaints;
use crate::cli::report::Outcome;
use crate::cli::times::rounded;
use motion_rtl::jobs::linear_interpolator::measure::Played;
use motion_rtl::jobs::linear_interpolator::settings::{AXIS_NAMES, Settings};
use serde::Serialize;

/// The summary of a run.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Summary {
    /// Fields that all summaries share.
    #[serde(flatten)]
    pub outcome: Outcome,
    /// Settings of the run, by the keys of `keys linear_interpolator --json-schema`.
    #[cfg_attr(
        feature = "schema",
        schemars(with = "crate::cli::schema::Settings<Settings>")
    )]
    pub settings: Settings,
    /// Scans of the run.
    pub scans: usize,
    /// True if every cycle ended on its target and stayed as near to its line as the division
    /// allows, and no scan, count or target was lost.
    pub exact: bool,
    /// Points of the drawing that have the counts of the point before.
    pub dropped_points: usize,
    /// Figures of the linear interpolator.
    pub interpolator: SystemSummary,
    /// Master axis of the run with another master.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub other_master: Option<&'static str>,
    /// Figures of that run; omitted if the drawing cannot be run with that master.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interpolator_other_master: Option<SystemSummary>,
    /// The conventional system of Fig. 3, both axes with the same settings.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub conventional: Option<SystemSummary>,
    /// The conventional system, speeds in proportion to the distances, times inverse to them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub conventional_in_proportion: Option<SystemSummary>,
    /// Every cycle.
    pub segments: Vec<Row>,
}

/// Figures of all cycles on one system.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SystemSummary {
    /// Ticks of the run.
    pub ticks: u64,
    /// Duration in seconds.
    pub seconds: f64,
    /// Scans of the run.
    pub scans: usize,
    /// The last command, in counts.
    pub end_position: [i64; 2],
    /// Largest deviation of a command from its line.
    pub deviation_max_lsb: f64,
    /// Largest change of the commanded speed from scan to scan, on the master axis or, without one,
    /// on the axis with the longer way.
    pub master_acceleration_max_counts_per_scan2: u64,
    /// Largest such change on the other axis.
    pub slave_acceleration_max_counts_per_scan2: u64,
    /// Largest contour error of the moves that draw.
    pub contour_error_max_um: f64,
    /// Largest contour error of the rapid moves.
    pub contour_error_max_rapid_um: f64,
    /// X and Y: scans in which the speed command was at its limit.
    pub saturated_scans: [u64; 2],
}

impl SystemSummary {
    fn new(job: &Job, run: &Run, rows: &[Row], of: impl Fn(&Row) -> Option<Figures>) -> Self {
        let played = &run.played;
        let accelerated = |value: fn(Figures) -> u64| {
            let all = rows.iter().filter_map(&of).map(value);
            all.max().unwrap_or(0)
        };
        let largest = |value: &dyn Fn(Figures) -> f64, rapid: &[bool]| {
            rows.iter()
                .filter(|row| rapid.contains(&row.rapid))
                .filter_map(&of)
                .map(value)
                .fold(0.0, f64::max)
        };
        let contour = |figures: Figures| figures.segment.contour_um;
        SystemSummary {
            ticks: played.ticks,
            seconds: played.ticks as f64 / job.settings.clock_hz as f64,
            scans: run.shown.count(),
            end_position: run.end_position,
            master_acceleration_max_counts_per_scan2: accelerated(|figures| {
                figures.segment.master_acceleration
            }),
            slave_acceleration_max_counts_per_scan2: accelerated(|figures| {
                figures.segment.slave_acceleration
            }),
            deviation_max_lsb: largest(&|figures| figures.segment.deviation.lsb(), &[false, true]),
            contour_error_max_um: largest(&contour, &[false]),
            contour_error_max_rapid_um: largest(&contour, &[true]),
            saturated_scans: played.saturated_scans,
        }
    }
}

impl Summary {
    /// The summary of a job that was played.
    pub fn new(job: &Job, runs: &Runs) -> Self {
        let complaints = complaints(job, runs);
        let rows = rows(job, runs);
        let system = |run, of: fn(&Row) -> Option<Figures>| SystemSummary::new(job, run, &rows, of);
        let interpolator = system(&runs.interpolator, |row| Some(row.interpolator));
        let other = runs.other.as_ref();
        let other = other.map(|run| system(run, |row| row.other_master));
        let (conventional, in_proportion) = match &runs.conventional {
            None => (None, None),
            Some([same, inverse]) => (
                Some(system(same, |row| row.conventional)),
                Some(system(inverse, |row| row.conventional_in_proportion)),
            ),
        };
        Summary {
            exact: complaints.is_empty(),
            outcome: Outcome {
                complaints,
                warnings: warnings(job, &runs.interpolator.played),
                ..Outcome::new(
                    "linear_interpolator",
                    &job.drawing.file,
                    job.settings.clock_hz,
                    interpolator.ticks,
                )
            },
            settings: job.settings.clone(),
            other_master: job.other.as_ref().map(|other| other.settings.master.name()),
            interpolator_other_master: other,
            scans: interpolator.scans,
            dropped_points: job.compiled.dropped,
            interpolator,
            conventional,
            conventional_in_proportion: in_proportion,
            segments: rows,
        }
    }
}

/// Returns the warnings: anything skipped, assumed or rounded to make the cycles, and what slowed
/// them down.
fn warnings(job: &Job, played: &Played) -> Vec<String> {
    let file = &job.drawing.file;
    let own = job.drawing.warnings.iter();
    let mut warnings: Vec<String> = own.map(ToString::to_string).collect();
    if job.compiled.moves_in_z {
        warnings.push(format!(
            "{file}: the drawing moves in Z, which no axis drives"
        ));
    }
    match job.compiled.dropped {
        0 => {}
        1 => warnings.push(format!(
            "{file}: 1 point left out that has the counts of the point before"
        )),
        many => warnings.push(format!(
            "{file}: {many} points left out that have the counts of the point before"
        )),
    }
    if let Some(other) = &job.other
        && let Err(error) = &other.compiled
    {
        let master = other.settings.master.name();
        warnings.push(format!(
            "{file}: not drawn with {master} as the master axis for comparison: {error}"
        ));
    }
    if job.compiled.targets.is_empty() {
        warnings.push(format!("{file}: no axis moves"));
    }
    let ramps = job.settings.ramps();
    warnings.extend(ramps.iter().filter_map(|ramp| rounded(ramp, "scan", "")));
    for (axis, name) in AXIS_NAMES.iter().enumerate() {
        let scans = played.saturated_scans[axis];
        if scans > 0 {
            let speed = job.settings.rated_speed_rev_per_min[axis];
            warnings.push(format!(
                "{name}: in {scans} scans the position loop asks for more than {speed} rev/min"
            ));
        }
    }
    warnings
}
