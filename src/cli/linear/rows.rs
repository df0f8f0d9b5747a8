//! The figures of a run, cycle by cycle.

use super::Job;
use super::runs::{Run, Runs};
use motion_rtl::jobs::linear_interpolator::measure::Segment;
use motion_rtl::jobs::linear_interpolator::settings::AXIS_NAMES;
use motion_rtl::jobs::linear_interpolator::targets::Target;
use serde::Serialize;

/// One cycle, played by all systems.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Row {
    /// Its number, from 0.
    pub segment: usize,
    /// Line of the input.
    pub line: usize,
    /// True if the pen is up.
    pub rapid: bool,
    /// Start in counts.
    pub from: [i64; 2],
    /// End in counts.
    pub to: [i64; 2],
    /// Δx and Δy in counts.
    pub delta: [i64; 2],
    /// Master axis.
    pub master: &'static str,
    /// Speed of that axis, in counts per scan.
    pub speed_counts_per_scan: f64,
    /// Requested speed along the line.
    pub speed_asked_mm_per_min: f64,
    /// Highest speed that the linear interpolator reaches; less on a line that is too short.
    pub speed_reached_mm_per_min: f64,
    /// Figures of the linear interpolator.
    pub interpolator: Figures,
    /// Figures of the linear interpolator with another master axis.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub other_master: Option<Figures>,
    /// The conventional system, both axes with the same settings.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub conventional: Option<Figures>,
    /// The conventional system, speeds in proportion to the distances, times inverse to them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub conventional_in_proportion: Option<Figures>,
}

/// Measures of a cycle on one system.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Figures {
    /// Scans from the first command to the last, in seconds.
    seconds: f64,
    #[serde(flatten)]
    pub segment: Segment,
}

impl Figures {
    fn new(segment: &Segment, scan_s: f64) -> Self {
        Figures {
            seconds: segment.scans as f64 * scan_s,
            segment: *segment,
        }
    }
}

/// Every cycle that all systems of a run have played.
pub fn rows(job: &Job, runs: &Runs) -> Vec<Row> {
    let scan_s = job.settings.scan_s();
    let targets = job.compiled.targets.iter();
    let cycles = runs.interpolator.played.cycles.iter();
    let ours = &runs.interpolator.segments;
    let figures = |run: &Run, segment: usize| {
        let segment = run.segments.get(segment)?;
        Some(Figures::new(segment, scan_s))
    };
    let other = |segment: usize| figures(runs.other.as_ref()?, segment);
    let way = |way: usize, segment: usize| figures(&runs.conventional.as_ref()?[way], segment);
    let ways = runs.conventional.iter().flatten();
    let ways = ways.map(|run| run.segments.len());
    let played = ways.fold(ours.len(), usize::min);
    targets
        .zip(cycles)
        .zip(&ours[..played])
        .enumerate()
        .map(|(segment, ((target, cycle), ours))| Row {
            segment,
            line: target.line,
            rapid: target.rapid,
            from: cycle.from,
            to: cycle.to,
            delta: ours.delta,
            master: AXIS_NAMES[ours.master],
            speed_counts_per_scan: target.profiles[0].counts_per_scan(),
            speed_asked_mm_per_min: target.feed_mm_per_min,
            speed_reached_mm_per_min: reached(job, target, ours),
            interpolator: Figures::new(ours, scan_s),
            other_master: other(segment),
            conventional: way(0, segment),
            conventional_in_proportion: way(1, segment),
        })
        .collect()
}

/// The speed along the line in the steady scans, or at the peak where there are none: two ramps
/// and what is steady between them make the length in the scans that were seen.
fn reached(job: &Job, target: &Target, segment: &Segment) -> f64 {
    let per_mm = job.settings.counts_per_mm;
    let [x, y] = [0, 1].map(|axis| segment.delta[axis] as f64 / per_mm[axis]);
    let [profile] = target.profiles;
    let ramps = (profile.acceleration_scans + profile.deceleration_scans) as f64;
    let scans = segment.scans as f64 - ramps / 2.0;
    60.0 * x.hypot(y) / (scans * job.settings.scan_s())
}
