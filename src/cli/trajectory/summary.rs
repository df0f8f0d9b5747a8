//! Summary of the runs.

use super::Job;
use super::rows::{self, SegmentRow};
use super::runs::{Run, Runs};
use super::verdict::{NOT_SETTLED, compared, complaints};
use crate::cli::report::Outcome;
use motion_rtl::circuits::trajectory_controller::Widths;
use motion_rtl::jobs::trajectory_controller::settings::Settings;
use motion_rtl::path::pieces::Speeds;
use serde::Serialize;

/// The summary of a run.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Summary<'r> {
    /// Fields that all summaries share.
    #[serde(flatten)]
    pub outcome: Outcome,
    /// Settings of the run, by the keys of `keys trajectory_controller --json-schema`.
    #[cfg_attr(
        feature = "schema",
        schemars(with = "crate::cli::schema::Settings<Settings>")
    )]
    pub settings: Settings,
    /// Number of axes.
    pub axes: usize,
    /// Δt in ticks.
    pub period_ticks: u32,
    /// Ticks that the circuit needs of them.
    pub period_ticks_needed: u64,
    /// Gains of the feedback, along the path and across it.
    pub feedback_gains: [f64; 2],
    /// Ticks of it in which the path was written, before it began.
    pub loading_ticks: u64,
    /// Interpolation periods.
    pub periods: usize,
    /// True if every command is on the path and every run came to rest at the path's end.
    pub exact: bool,
    /// The path.
    pub path: PathSummary,
    /// The plan of its speed.
    pub plan: PlanSummary,
    /// Results by correction.
    pub corrections: &'r [Run],
    /// Every segment of the path.
    pub segments: Vec<SegmentRow>,
}

/// A path by its length.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PathSummary {
    /// Number of segments.
    pub segments: usize,
    /// Length L of the path.
    pub length_mm: f64,
    /// Pieces without a segment: they begin and end at the same guard unit.
    pub zero_length: usize,
}

/// Result of the look-ahead.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlanSummary {
    /// T: from the first period to the last command.
    pub seconds: f64,
    /// Highest planned speed along the path.
    pub speed_max_mm_per_s: f64,
    /// Acceleration along the path.
    pub acceleration_mm_per_s2: f64,
    /// Joints of two segments at which the path stops.
    pub stops: usize,
    /// Slowest of the other joints, rapid moves excluded.
    pub slowest_joint: Option<Joint>,
}

/// Joint of two segments.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Joint {
    /// The segment that begins.
    pub segment: usize,
    /// Line of the input.
    pub line: Option<usize>,
    /// The speed there.
    pub speed_mm_per_s: f64,
    /// Speed limit by the turn.
    pub limit_mm_per_s: f64,
}

impl<'r> Summary<'r> {
    /// The summary of a path that was run by each correction.
    pub fn new(job: &Job, runs: &'r Runs) -> Self {
        let (settings, program) = (&job.settings, &job.program);
        let complaints = complaints(job, runs);
        let segments = rows::segments(job, runs);
        let traced = runs.traced();
        let input = match &job.drawing {
            Some(drawing) => &drawing.file,
            None => &job.stem,
        };
        Summary {
            exact: complaints.is_empty(),
            outcome: Outcome {
                complaints,
                warnings: warnings(job, runs),
                ..Outcome::new(
                    "trajectory_controller",
                    input,
                    settings.clock_hz,
                    traced.ticks,
                )
            },
            settings: settings.clone(),
            axes: job.axes(),
            period_ticks: program.period_ticks,
            period_ticks_needed: job.period_ticks_needed(),
            feedback_gains: program.feedback.parts(&Widths::FULL),
            loading_ticks: traced.start,
            periods: traced.periods,
            path: PathSummary {
                segments: program.path.stretches.len(),
                length_mm: program.path.length as f64 / program.motion.units_per_mm,
                zero_length: program.path.zero_length,
            },
            plan: plan(job, &segments),
            corrections: &runs.runs,
            segments,
        }
    }
}

fn plan(job: &Job, segments: &[SegmentRow]) -> PlanSummary {
    let motion = &job.program.motion;
    let joints = segments.windows(2);
    let stop = |row: &SegmentRow| row.entry_limit_mm_per_s <= 0.0;
    let at_feed = joints.clone().filter(|pair| {
        let rapid = pair.iter().any(|row| row.kind == "rapid");
        !rapid && !stop(&pair[1])
    });
    let passed = at_feed.map(|pair| Joint {
        segment: pair[1].segment,
        line: pair[1].line,
        speed_mm_per_s: pair[1].entry_mm_per_s,
        limit_mm_per_s: pair[1].entry_limit_mm_per_s,
    });
    let speeds = segments.iter().map(|row| row.speed_mm_per_s);
    PlanSummary {
        seconds: job.program.profile.duration,
        speed_max_mm_per_s: speeds.fold(0.0, f64::max),
        acceleration_mm_per_s2: motion.slope.acceleration / motion.units_per_mm,
        stops: joints.filter(|pair| stop(&pair[1])).count(),
        slowest_joint: passed.min_by(|a, b| a.speed_mm_per_s.total_cmp(&b.speed_mm_per_s)),
    }
}

/// Returns the warnings of the drawing and the path, and of torques at their limits.
fn warnings(job: &Job, runs: &Runs) -> Vec<String> {
    let own = job.drawing.iter().flat_map(|drawing| &drawing.warnings);
    let mut warnings: Vec<String> = own.map(ToString::to_string).collect();
    match job.program.path.zero_length {
        0 => {}
        1 => warnings.push("1 piece left out that has no length".to_owned()),
        many => warnings.push(format!("{many} pieces left out that have no length")),
    }
    warnings.extend(other_feeds(job));
    for run in &runs.runs {
        if compared(run, runs) && !run.settled {
            warnings.push(format!("feedback: {NOT_SETTLED}, with these gains"));
        }
        for (axis, machine) in run.measured.axes.iter().zip(&job.machines) {
            if axis.saturated_periods > 0 {
                warnings.push(format!(
                    "{}: in {} periods {} asks for more than {} Nm",
                    run.name(),
                    axis.saturated_periods,
                    axis.axis,
                    machine.max_torque_nm
                ));
            }
        }
    }
    warnings
}

/// Feeds that an acceleration time also goes for, where that could be taken for the time to
/// `feed_mm_per_min` alone.
fn other_feeds(job: &Job) -> Option<String> {
    let time_ms = job.settings.acceleration_time_ms?;
    let feed = Speeds::from(&job.settings).wanted?;
    let stretches = job.program.path.stretches.iter();
    let others = stretches.map(|stretch| stretch.speed);
    let other = others.filter(|&speed| speed != feed).reduce(f64::min)?;
    Some(format!(
        "acceleration_time_ms = {time_ms} is the time from rest to each feed: to {feed} mm/s with {} \
         mm/s2, to {other} mm/s with {} mm/s2; acceleration_mm_per_s2 = {} is the same for all",
        1e3 * feed / time_ms,
        1e3 * other / time_ms,
        1e3 * feed / time_ms,
    ))
}
