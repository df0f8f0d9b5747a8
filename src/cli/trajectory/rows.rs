//! The figures of each segment of the path.

use super::Job;
use super::runs::Runs;
use motion_rtl::jobs::trajectory_controller::speed_limits::spans;
use serde::Serialize;

/// A segment of the path.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SegmentRow {
    /// Its number.
    pub segment: usize,
    /// Its piece.
    pub piece: usize,
    /// Line of the input.
    pub line: Option<usize>,
    /// "line", "arc", "helix", "spline" or "rapid".
    pub kind: &'static str,
    /// Length along the path.
    pub length_mm: f64,
    /// Radius of curvature of an arc or a helix; of a spline the least.
    pub radius_mm: Option<f64>,
    /// Requested speed F.
    pub speed_wanted_mm_per_s: f64,
    /// Limit of F by the acceleration across the path.
    pub speed_limit_mm_per_s: f64,
    /// Highest speed at its start, by the turn.
    pub entry_limit_mm_per_s: f64,
    /// The planned speed there.
    pub entry_mm_per_s: f64,
    /// The highest planned speed within it.
    pub speed_mm_per_s: f64,
    /// Largest distance of the loads from the path next to it, by each correction of the summary but
    /// the one at full feed; without a period there none.
    pub contour_um: Vec<Option<f64>>,
}

pub fn segments(job: &Job, runs: &Runs) -> Vec<SegmentRow> {
    let (path, motion) = (&job.program.path, &job.program.motion);
    let unit = motion.units_per_mm;
    let spans = spans(path, motion);
    let runs = runs.runs.iter().filter(|run| !run.full_feed);
    let errors: Vec<_> = runs.map(|run| &run.segments).collect();
    let profile = &job.program.profile;
    let stretches = path.stretches.iter().zip(&spans).enumerate();
    stretches
        .map(|(number, (stretch, span))| {
            let begin = stretch.begin as f64;
            let before = number.checked_sub(1).map_or(0.0, |k| spans[k].speed);
            SegmentRow {
                segment: number,
                piece: stretch.piece,
                line: stretch.line,
                kind: match (job.is_rapid(stretch.piece), &stretch.segment) {
                    (true, _) => "rapid",
                    (false, segment) => segment.kind(),
                },
                length_mm: stretch.length as f64 / unit,
                radius_mm: stretch.radius,
                speed_wanted_mm_per_s: stretch.speed,
                speed_limit_mm_per_s: span.speed / unit,
                entry_limit_mm_per_s: span.entry.min(span.speed).min(before) / unit,
                entry_mm_per_s: profile.speed_at(begin) / unit,
                speed_mm_per_s: profile.highest_speed(begin, begin + stretch.length as f64) / unit,
                contour_um: errors.iter().map(|of| of[number]).collect(),
            }
        })
        .collect()
}
