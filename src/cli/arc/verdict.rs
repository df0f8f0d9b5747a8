//! Whether a run did what its path says.

use super::Job;
use super::figures::Figures;
use super::rows::{ArcRow, bound};
use motion_rtl::arc_generator::job::Played;
use motion_rtl::arc_generator::vector::distance;
use motion_rtl::arc_generator::widths::Widths;

/// What is wrong with a run; empty where nothing is.
pub fn complaints(job: &Job, played: &Played, figures: &Figures, arcs: &[ArcRow]) -> Vec<String> {
    let mut all = Vec::new();
    if played.late {
        all.push("a sampling time began before its point was ready".to_owned());
    }
    if played.starved {
        all.push("the path ended in motion".to_owned());
    }
    let (sampled, wanted) = (played.commands.len() as u64, job.prepared.samples());
    if sampled != wanted {
        all.push(format!("{sampled} samples where the path has {wanted}"));
        return all;
    }
    all.extend(end(job, played));
    for arc in arcs {
        let [least, most] = arc.radius_error_um;
        let (error, bound) = (most.max(-least), arc.bound_um);
        if error > bound {
            let piece = arc.piece;
            all.push(format!(
                "piece {piece}: the radius is {error:.3} um off, its bound is {bound:.3} um"
            ));
        }
    }
    all.extend(astray(job, figures));
    all
}

/// Whether the last command is the end of the path, rounded: twice, to guard units and to counts.
fn end(job: &Job, played: &Played) -> Option<String> {
    let (last, piece) = (played.commands.last()?, job.prepared.pieces.last()?);
    let wanted = piece.to.map(|mm| mm * job.settings.counts_per_mm);
    let tolerance = 0.5 + (-f64::from(Widths::FULL.guard())).exp2();
    let mut pairs = last.counts.iter().zip(wanted);
    // Written so that NaN fails.
    let exact = pairs.all(|(counts, wanted)| (*counts as f64 - wanted).abs() <= tolerance);
    let counts = last.counts;
    (!exact).then(|| format!("ends at {counts:?} counts, the path at {wanted:.3?}"))
}

/// The first command that is farther from its exact point than arithmetic and rounding allow.
fn astray(job: &Job, figures: &Figures) -> Option<String> {
    let bounds = bounds(job, figures);
    let samples = (0..).zip(&figures.points);
    let mut astray = samples.filter_map(|(sample, point)| {
        let off = distance(job.prepared.point(sample)?, *point);
        let most = bounds.get(job.prepared.place(sample)?.segment)?;
        // Written so that NaN fails.
        let within = off <= *most;
        (!within).then(|| {
            let (off, most) = (off * 1e3, most * 1e3);
            format!("sample {sample} is {off:.3} um off its exact point, its bound is {most:.3} um")
        })
    });
    let text = astray.next()?;
    Some(match astray.count() {
        0 => text,
        more => format!("{text} (and {more} more like it)"),
    })
}

/// How far the samples of each segment may be off, in mm.
pub fn bounds(job: &Job, figures: &Figures) -> Vec<f64> {
    let mut bounds = vec![straight(job); job.prepared.segments.len()];
    for arc in &figures.arcs {
        bounds[arc.segment] = bound(job, arc);
    }
    bounds
}

/// The same on lines and blends, whose points are exact but for the rounding: √3/2 counts, and the
/// same of a guard unit for what goes in and for what comes out.
fn straight(job: &Job) -> f64 {
    let unit = (-f64::from(Widths::FULL.guard())).exp2();
    3f64.sqrt() / 2.0 * (1.0 + 2.0 * unit) / job.settings.counts_per_mm
}
