//! The figures of a run: by each correction, of each axis, of each segment.

use super::Job;
use super::runs::{Run, Runs};
use motion_rtl::circuits::trajectory_controller::path_point::AXIS_NAMES;
use motion_rtl::jobs::trajectory_controller::closed::{Steady, Variants};
use motion_rtl::jobs::trajectory_controller::measure::Errors;
use motion_rtl::jobs::trajectory_controller::profile::Profile;
use motion_rtl::jobs::trajectory_controller::settings::Correction;
use motion_rtl::jobs::trajectory_controller::speed_limits::spans;
use motion_rtl::plant::TwoMassAxis;
use serde::Serialize;

/// Figures of the run by one correction.
#[derive(Debug, Serialize)]
pub struct CorrectionRow {
    /// Name of the run.
    #[serde(skip)]
    pub name: &'static str,
    pub correction: &'static str,
    /// True at full feed, beside runs that a contour tolerance limits.
    pub full_feed: bool,
    /// Planned duration of the path.
    pub planned_seconds: f64,
    /// True if its waves are written.
    pub in_waves: bool,
    /// Ticks of the run.
    pub ticks: u64,
    /// Interpolation periods until models and motors have settled.
    pub periods: usize,
    /// Errors of the servos' models, which the motors follow.
    pub model: ErrorRow,
    /// Errors of the motors by their encoders.
    pub motor: ErrorRow,
    /// Errors of the loads.
    pub load: ErrorRow,
    pub axes: Vec<AxisRow>,
    /// Errors on a circle, if the path has one that is long enough.
    pub circle: Option<CircleRow>,
}

/// Distances from the path and from the commands.
#[derive(Debug, Serialize)]
pub struct ErrorRow {
    /// Largest distance from the path.
    pub contour_max_um: f64,
    /// RMS distance from the path.
    pub contour_rms_um: f64,
    /// Length along the path at the largest distance.
    pub at_mm: f64,
    /// Tick of the largest distance.
    pub at_tick: u64,
    /// Largest distance from the command of the same period.
    pub following_max_mm: f64,
    /// Distance from the path's end when the run is over.
    pub end_um: f64,
}

/// An axis of a run.
#[derive(Debug, Serialize)]
pub struct AxisRow {
    /// Its name.
    pub axis: &'static str,
    /// End position of its motor, in counts from the path's start.
    pub end_position: i64,
    pub torque_max_nm: f64,
    /// Periods in which the torque was limited.
    pub saturated_periods: usize,
    /// Largest distance of its motor from its model.
    pub off_model_um: f64,
}

/// Mean of the steady part on a circle, inwards positive where there is a sign.
#[derive(Debug, Serialize)]
pub struct CircleRow {
    /// r.
    pub radius_mm: f64,
    /// v.
    pub speed_mm_per_s: f64,
    /// Periods of the steady part.
    pub periods: usize,
    /// Distance of the models from the circle.
    pub model_um: f64,
    /// Distance of the loads from the circle.
    pub load_um: f64,
    /// Distance by the closed form of continuous models.
    pub continuous_um: f64,
    /// Distance by the closed form of the sampled models.
    pub sampled_um: f64,
}

/// A segment of the path.
#[derive(Debug, Serialize)]
pub struct SegmentRow {
    /// Its number.
    pub segment: usize,
    /// Its piece.
    pub piece: usize,
    /// Line of the input.
    pub line: Option<usize>,
    /// "line", "arc", "helix", "spline" or "rapid".
    pub kind: &'static str,
    pub length_mm: f64,
    /// Radius of curvature of an arc or a helix; of a spline the least.
    pub radius_mm: Option<f64>,
    /// F.
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

/// Returns the figures of each correction.
pub fn corrections(job: &Job, runs: &Runs) -> Vec<CorrectionRow> {
    let row = |run: &Run| CorrectionRow {
        name: run.name(),
        correction: run.correction.name(),
        full_feed: run.full_feed,
        planned_seconds: run.planned_s,
        in_waves: run.correction == runs.traced && !run.full_feed,
        ticks: run.ticks,
        periods: run.periods,
        model: error_row(&run.measured.model),
        motor: error_row(&run.measured.motor),
        load: error_row(&run.measured.load),
        axes: axes(job, run),
        circle: run
            .circle
            .as_ref()
            .map(|circle| circle_row(run.correction, circle)),
    };
    runs.runs.iter().map(row).collect()
}

fn error_row(errors: &Errors) -> ErrorRow {
    ErrorRow {
        contour_max_um: errors.contour.mm * 1e3,
        contour_rms_um: errors.contour_rms_mm * 1e3,
        at_mm: errors.contour.length_mm,
        at_tick: errors.contour.tick,
        following_max_mm: errors.following.mm,
        end_um: errors.final_mm * 1e3,
    }
}

fn axes(job: &Job, run: &Run) -> Vec<AxisRow> {
    let machines = job.machines.iter().enumerate();
    machines
        .map(|(axis, machine)| AxisRow {
            axis: AXIS_NAMES[axis],
            end_position: run.end_counts[axis],
            torque_max_nm: run.measured.torque[axis] as f64 / TwoMassAxis::FULL_SCALE as f64
                * machine.max_torque_nm,
            saturated_periods: run.measured.saturated[axis],
            off_model_um: run.measured.off_model_mm[axis] * 1e3,
        })
        .collect()
}

fn circle_row(correction: Correction, circle: &Steady) -> CircleRow {
    let um = |forms: &Variants| forms.of(correction) * 1e3;
    CircleRow {
        radius_mm: circle.forms.radius_mm,
        speed_mm_per_s: circle.forms.speed_mm_per_s,
        periods: circle.periods,
        model_um: circle.model_mm * 1e3,
        load_um: circle.load_mm * 1e3,
        continuous_um: um(&circle.forms.continuous),
        sampled_um: um(&circle.forms.sampled),
    }
}

pub fn segments(job: &Job, runs: &Runs) -> Vec<SegmentRow> {
    let (path, motion) = (&job.program.path, &job.program.motion);
    let unit = motion.units_per_mm;
    let spans = spans(path, motion);
    let runs = runs.runs.iter().filter(|run| !run.full_feed);
    let errors: Vec<_> = runs.map(|run| &run.segments).collect();
    let speeds = Speeds::of(&job.program.profile);
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
                entry_mm_per_s: speeds.at(begin) / unit,
                speed_mm_per_s: speeds.highest(begin, begin + stretch.length as f64) / unit,
                contour_um: errors.iter().map(|of| of[number]).collect(),
            }
        })
        .collect()
}

/// The planned speed by the length along the path.
struct Speeds<'a> {
    profile: &'a Profile,
}

impl<'a> Speeds<'a> {
    fn of(profile: &'a Profile) -> Self {
        Speeds { profile }
    }

    /// The speed at a length.
    fn at(&self, length: f64) -> f64 {
        self.profile.at(self.time(length))[1]
    }

    /// When a length is reached.
    fn time(&self, length: f64) -> f64 {
        let pieces = &self.profile.pieces;
        let index = pieces.partition_point(|piece| piece.q <= length);
        let from = pieces[..index].last().map_or(0.0, |piece| piece.t);
        let to = pieces
            .get(index)
            .map_or(self.profile.duration, |next| next.t);
        // The length never falls, so bisection finds it.
        let (mut early, mut late) = (from, to);
        for _ in 0..60 {
            let middle = f64::midpoint(early, late);
            match self.profile.at(middle)[0] < length {
                true => early = middle,
                false => late = middle,
            }
        }
        early
    }

    /// The highest speed between two lengths: at one of them, or where a piece begins.
    fn highest(&self, from: f64, to: f64) -> f64 {
        let pieces = &self.profile.pieces;
        let first = pieces.partition_point(|piece| piece.q <= from);
        let inside = pieces[first..].iter().take_while(|piece| piece.q < to);
        inside
            .map(|piece| piece.v)
            .fold(self.at(from).max(self.at(to)), f64::max)
    }
}
