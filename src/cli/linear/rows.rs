//! The figures of a run, cycle by cycle.

use super::{Job, Runs};
use motion_rtl::linear_interpolator::measure::Segment;
use motion_rtl::linear_interpolator::settings::AXIS_NAMES;
use serde::Serialize;

/// One cycle, played by both systems.
#[derive(Debug, Clone, Serialize)]
pub struct Row {
    /// Its number, from 0.
    pub segment: usize,
    /// Line of the input.
    pub line: usize,
    /// Whether the pen is up.
    pub rapid: bool,
    /// Where it starts, in counts.
    pub from: [i64; 2],
    /// Where it ends, in counts.
    pub to: [i64; 2],
    /// Δx and Δy in counts.
    pub delta: [i64; 2],
    /// The axis with the longer way.
    pub master: &'static str,
    /// Speed of that axis, in counts per scan.
    pub speed_counts_per_scan: u64,
    /// The linear interpolator.
    pub interpolator: Figures,
    /// The conventional system.
    pub conventional: Figures,
}

/// What one system made of a cycle.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Figures {
    /// Scans from the first command to the last.
    pub scans: usize,
    /// The same in seconds.
    pub seconds: f64,
    /// The command at the end less the target, in counts.
    pub end_error_counts: [i64; 2],
    /// Largest deviation of the commands from the ideal line, along the slave axis.
    pub deviation_lsb: f64,
    /// The same perpendicular to the line.
    pub deviation_perpendicular_counts: f64,
    /// Largest distance of the motors from the line, until the next cycle begins.
    pub contour_error_counts: f64,
    /// The same in micrometres.
    pub contour_error_um: f64,
}

impl Figures {
    fn new(segment: &Segment, scan_s: f64) -> Self {
        Figures {
            scans: segment.scans,
            seconds: segment.scans as f64 * scan_s,
            end_error_counts: segment.end_error,
            deviation_lsb: segment.deviation.lsb(),
            deviation_perpendicular_counts: segment.perpendicular_counts,
            contour_error_counts: segment.contour_counts,
            contour_error_um: segment.contour_um,
        }
    }
}

/// Every cycle that both systems have played.
pub fn rows(job: &Job, runs: &Runs, segments: [&[Segment]; 2]) -> Vec<Row> {
    let scan_s = job.settings.scan_s();
    let targets = job.compiled.targets.iter();
    let cycles = runs.interpolator.cycles.iter();
    let segments = segments[0].iter().zip(segments[1]);
    targets
        .zip(cycles)
        .zip(segments)
        .enumerate()
        .map(|(segment, ((target, cycle), (ours, other)))| Row {
            segment,
            line: target.line,
            rapid: target.rapid,
            from: cycle.from,
            to: cycle.to,
            delta: ours.delta,
            master: AXIS_NAMES[ours.master],
            speed_counts_per_scan: target.speed,
            interpolator: Figures::new(ours, scan_s),
            conventional: Figures::new(other, scan_s),
        })
        .collect()
}
