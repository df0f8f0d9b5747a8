//! The figures of a run, piece by piece and blend by blend.

use super::Job;
use super::figures::{ArcFigures, Figures};
use motion_rtl::circuits::arc_generator::Widths;
use motion_rtl::input::Point;
use motion_rtl::jobs::arc_generator::bounds::command_error;
use motion_rtl::jobs::arc_generator::measure::{ArcMeasured, BlendMeasured, Measured};
use motion_rtl::jobs::arc_generator::prepared::{Kind, PieceReport, Segment};
use motion_rtl::path::vector::angle_between;
use serde::Serialize;

/// A figure that was measured, and what the closed form says.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Pair {
    /// Measured on the commands.
    pub measured: f64,
    /// By the closed form.
    pub expected: f64,
}

#[derive(Debug, Clone, Serialize)]
pub struct ArcRow {
    /// Its piece, from 0.
    pub piece: usize,
    /// Line of the input.
    pub line: Option<usize>,
    /// R.
    pub radius_mm: f64,
    /// G.
    pub centre_mm: Point,
    /// k.
    pub axis: Point,
    /// θ.
    pub angle_deg: f64,
    /// φ: the part of it that each blend takes.
    pub blend_angle_deg: f64,
    /// N.
    pub samples: u64,
    /// Δθ.
    pub step_deg: f64,
    /// Vs.
    pub speed_wanted_mm_per_s: f64,
    /// v; measured: its mean along the rotation.
    pub speed_mm_per_s: Pair,
    /// Largest deviation from v from one sample to the next.
    pub speed_deviation_mm_per_s: f64,
    /// Least and largest error of the radius, outwards positive.
    pub radius_error_um: [f64; 2],
    /// RMS error of the radius.
    pub radius_error_rms_um: f64,
    /// Distance of the last sample from C⁻.
    pub end_error_um: f64,
    /// Bound of both errors: rotation plus rounding to counts.
    pub bound_um: f64,
    /// Largest radius error of the conventional method, also rounded to counts; omitted without a
    /// comparison.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub conventional_radius_error_um: Option<f64>,
    /// A⁺ and C⁻.
    pub ends: Vec<EndRow>,
}

/// Start or end of the rotation.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct EndRow {
    /// "A+" or "C-".
    pub at: &'static str,
    /// True if the blend there is from or to rest.
    pub rest: bool,
    /// asin(v·ta/2R).
    pub direction_jump_deg: Pair,
    /// v²/R.
    pub acceleration_jump_mm_per_s2: Pair,
    /// Distance between blend and arc, R(1 − cos(φ/2)) if the blend is from or to rest.
    pub off_arc_um: Option<Pair>,
    /// Estimate of that distance, (v·ta)²/8R.
    pub off_arc_estimate_um: Option<f64>,
}

#[derive(Debug, Clone, Copy, Serialize)]
pub struct LineRow {
    /// Its piece, from 0.
    pub piece: usize,
    /// Line of the input.
    pub line: Option<usize>,
    pub length_mm: f64,
    /// Samples between its blends.
    pub samples: u64,
    /// Vs.
    pub speed_wanted_mm_per_s: f64,
    /// v.
    pub speed_mm_per_s: f64,
}

#[derive(Debug, Clone, Copy, Serialize)]
pub struct BlendRow {
    /// Its piece; of a joint the former.
    pub piece: usize,
    /// Line of the input.
    pub line: Option<usize>,
    /// "from rest", "joint" or "to rest".
    pub kind: &'static str,
    /// The turn of a joint.
    pub turn_deg: Option<f64>,
    /// Distance between a joint and its corner, 3/16·|A⁻ − 2A + A⁺|.
    pub corner_distance_um: Option<Pair>,
    /// Largest distance from the lines and arcs that it blends.
    pub off_path_um: f64,
    /// 3·|A⁻ − 2A + A⁺|/(2ta)².
    pub peak_acceleration_mm_per_s2: Pair,
}

/// Every arc.
pub fn arcs(job: &Job, figures: &Figures) -> Vec<ArcRow> {
    let Some(measured) = &figures.measured else {
        return Vec::new();
    };
    let compared = job.loaded.scenario.beside();
    let pairs = figures.arcs.iter().zip(&measured.arcs);
    pairs
        .filter_map(|(arc_figures, arc)| {
            let piece = job.prepared.pieces.get(arc_figures.piece)?;
            let mut row = arc_row(job, measured, piece, arc_figures, arc);
            row.conventional_radius_error_um =
                compared.then(|| figures.beside.radius_error(arc_figures.segment) * 1e3);
            Some(row)
        })
        .collect()
}

/// Returns the bound of an arc's radius error and end error in mm.
pub fn bound(job: &Job, figures: &ArcFigures) -> f64 {
    let samples = job.prepared.segments[figures.segment].samples;
    let per_mm = job.settings.counts_per_mm;
    let radius = figures.report.circle.radius * per_mm;
    command_error(radius, samples, &Widths::FULL, job.settings.rounding) / per_mm
}

fn arc_row(
    job: &Job,
    measured: &Measured,
    piece: &PieceReport,
    figures: &ArcFigures,
    arc: &ArcMeasured,
) -> ArcRow {
    let report = &figures.report;
    ArcRow {
        piece: figures.piece,
        line: piece.line,
        radius_mm: report.circle.radius,
        centre_mm: report.circle.centre,
        axis: report.circle.axis,
        angle_deg: report.circle.angle.to_degrees(),
        blend_angle_deg: report.blend_angle.to_degrees(),
        samples: piece.samples,
        step_deg: report.step.to_degrees(),
        speed_wanted_mm_per_s: piece.wanted,
        speed_mm_per_s: Pair {
            measured: arc.speed,
            expected: piece.speed,
        },
        speed_deviation_mm_per_s: arc.speed_deviation,
        radius_error_um: arc.radius_errors.map(|mm| mm * 1e3),
        radius_error_rms_um: arc.radius_rms * 1e3,
        end_error_um: arc.end_error * 1e3,
        bound_um: bound(job, figures) * 1e3,
        conventional_radius_error_um: None,
        ends: ends(job, measured, figures),
    }
}

/// A⁺ and C⁻ of an arc, each beside its blend.
fn ends(job: &Job, measured: &Measured, figures: &ArcFigures) -> Vec<EndRow> {
    let (report, segment) = (&figures.report, figures.segment);
    // Before and behind every arc is a blend; a joint has the number of the segment that it ends.
    let sides = [
        ("A+", segment.checked_sub(1), segment.checked_sub(1)),
        ("C-", Some(segment), Some(segment + 1)),
    ];
    let side = |(at, joint, blend): (&'static str, Option<usize>, Option<usize>)| {
        let joint = measured.joints.iter().find(|j| Some(j.segment) == joint)?;
        let off = measured.blends.iter().find(|b| Some(b.segment) == blend)?;
        let rest = job.prepared.segments.get(blend?)?.next_piece.is_none();
        Some(EndRow {
            at,
            rest,
            direction_jump_deg: Pair {
                measured: joint.direction_jump.to_degrees(),
                expected: report.direction_jump.to_degrees(),
            },
            acceleration_jump_mm_per_s2: Pair {
                measured: joint.acceleration_jump,
                expected: report.acceleration_jump,
            },
            off_arc_um: rest.then_some(Pair {
                measured: off.off_path * 1e3,
                expected: report.blend_distance * 1e3,
            }),
            off_arc_estimate_um: rest.then_some(report.blend_distance_estimate * 1e3),
        })
    };
    sides.into_iter().filter_map(side).collect()
}

/// Every line.
pub fn lines(job: &Job) -> Vec<LineRow> {
    let pieces = job.prepared.pieces.iter().enumerate();
    pieces
        .filter(|(_, piece)| piece.arc.is_none())
        .map(|(number, piece)| LineRow {
            piece: number,
            line: piece.line,
            length_mm: piece.length,
            samples: piece.samples,
            speed_wanted_mm_per_s: piece.wanted,
            speed_mm_per_s: piece.speed,
        })
        .collect()
}

/// Every blend.
pub fn blends(job: &Job, figures: &Figures) -> Vec<BlendRow> {
    let blends = figures
        .measured
        .iter()
        .flat_map(|measured| &measured.blends);
    blends.filter_map(|blend| blend_row(job, blend)).collect()
}

fn blend_row(job: &Job, blend: &BlendMeasured) -> Option<BlendRow> {
    let prepared = &job.prepared;
    let segment: &Segment = prepared.segments.get(blend.segment)?;
    let piece = prepared.pieces.get(segment.piece)?;
    let next = segment
        .next_piece
        .and_then(|next| prepared.pieces.get(next));
    debug_assert_eq!(segment.kind(), Kind::Blend);
    Some(BlendRow {
        piece: segment.piece,
        line: piece.line,
        kind: match (segment.ends_at_rest, next) {
            (true, _) => "to rest",
            (false, None) => "from rest",
            (false, Some(_)) => "joint",
        },
        turn_deg: next.map(|next| {
            let turn = angle_between(piece.directions()[1], next.directions()[0]);
            turn.to_degrees()
        }),
        corner_distance_um: next.and(segment.corner_distance()).map(|mm| Pair {
            measured: blend.from_corner * 1e3,
            expected: mm * 1e3,
        }),
        off_path_um: blend.off_path * 1e3,
        peak_acceleration_mm_per_s2: Pair {
            measured: blend.peak_acceleration,
            expected: segment.peak_acceleration(&prepared.timing).unwrap_or(0.0),
        },
    })
}
