//! The picture of a run: the path, speed and acceleration over time with the jumps where the
//! rotation begins and ends, the radius error within its bound, a blend's distance from its arc.

use super::Job;
use super::blended::{ArcFigures, Blended};
use super::figures::Figures;
use super::style::{ARC, ARCS_MARKED, BLEND, EXPECTED, GAP, LINE, Points};
use super::view::path;
use motion_rtl::jobs::arc_generator::bounds::segment_error;
use motion_rtl::jobs::arc_generator::prepared::Segment;
use motion_rtl::picture::{Curve, Panel, Picture};

const TIME: &str = "time in s";

/// The picture as SVG.
pub fn draw(job: &Job, figures: &Figures) -> String {
    let title = format!("{}: arc generator", job.stem);
    let mut picture = Picture::new(title).panel(path(job, figures));
    if figures.measured.is_none() {
        return picture.render();
    }
    picture = picture
        .panel(speed(job, figures))
        .panel(acceleration(job, figures));
    if !figures.arcs.is_empty() {
        picture = picture.panel(radius_error(job, figures));
    }
    let blended = figures.blended.as_ref();
    if let Some(panel) = blended.and_then(|blended| off_arc(job, figures, blended)) {
        picture = picture.panel(panel);
    }
    picture.render()
}

fn seconds(job: &Job, sample: f64) -> f64 {
    sample * job.prepared.timing.sample_s
}

/// A curve of what holds from one end of each segment to the other, in steps.
fn steps<'a>(job: &Job, values: impl Iterator<Item = (&'a Segment, f64)>) -> Points {
    let ends = |(segment, value): (&Segment, f64)| {
        let ends = [segment.first_sample, segment.end()];
        let [from, to] = ends.map(|sample| (seconds(job, sample as f64), value));
        [from, to, GAP]
    };
    values.flat_map(ends).collect()
}

/// The segments that are arcs, with their figures.
fn arcs<'a>(
    job: &'a Job,
    figures: &'a Figures,
) -> impl Iterator<Item = (&'a Segment, &'a ArcFigures)> {
    let segments = &job.prepared.segments;
    figures.arcs.iter().map(|arc| (&segments[arc.segment], arc))
}

fn speed(job: &Job, figures: &Figures) -> Panel {
    let pieces = &job.prepared.pieces;
    let between = job.prepared.segments.iter().filter(|segment| {
        // Blends have no speed of their own.
        segment.corner_distance().is_none()
    });
    let wanted = steps(
        job,
        between.map(|segment| (segment, pieces[segment.piece].wanted)),
    );
    let speeds = figures.samples().filter_map(|at| {
        let middle = at.sample as f64 - 0.5;
        Some((seconds(job, middle), at.speed?))
    });
    let speeds: Points = speeds.collect();
    let mut panel = Panel::new("speed", TIME, "mm/s")
        .curve(Curve::new("wanted", wanted).colour(EXPECTED).dashed())
        .curve(Curve::new("of the commands", speeds).colour(LINE));
    if figures.arcs.len() <= ARCS_MARKED {
        for (segment, arc) in arcs(job, figures) {
            let speed = pieces[arc.piece].speed;
            for (name, sample) in [("A+", segment.first_sample), ("C-", segment.end())] {
                let at = (seconds(job, sample as f64), speed);
                panel = panel.mark(at, name);
            }
        }
    }
    panel
}

fn acceleration(job: &Job, figures: &Figures) -> Panel {
    let curve = figures.samples().filter_map(|at| {
        let before = at.sample as f64 - 1.0;
        Some((seconds(job, before), at.acceleration?))
    });
    let curve: Points = curve.collect();
    let towards_centre =
        arcs(job, figures).map(|(segment, arc)| (segment, arc.report.acceleration_jump));
    let towards_centre = steps(job, towards_centre);
    let mut panel = Panel::new("acceleration", TIME, "mm/s²")
        .curve(Curve::new("of the commands", curve).colour(LINE).width(0.9));
    if !towards_centre.is_empty() {
        let curve = Curve::new("v²/R", towards_centre);
        panel = panel.curve(curve.colour(ARC).width(1.6));
    }
    if figures.arcs.len() <= ARCS_MARKED {
        for (segment, arc) in arcs(job, figures) {
            let jump = arc.report.acceleration_jump;
            let (first, last) = (segment.first_sample as f64, segment.end() as f64);
            panel = panel
                .mark(
                    (seconds(job, first), jump),
                    format!("A+: jump of {jump:.2} mm/s²"),
                )
                .mark((seconds(job, last), jump), "C-");
        }
    }
    panel
}

fn radius_error(job: &Job, figures: &Figures) -> Panel {
    // The whole time, though there are not arcs all the time.
    let last = job.prepared.samples() as f64 - 1.0;
    let mut errors = vec![(0.0, f64::NAN), (seconds(job, last), f64::NAN)];
    let arcs_shown = figures
        .by_segment()
        .into_iter()
        .filter_map(|(segment, samples)| {
            let place = figures
                .arcs
                .binary_search_by_key(&segment, |arc| arc.segment);
            Some((&figures.arcs[place.ok()?], samples))
        });
    for (arc, samples) in arcs_shown {
        errors.extend(samples.into_iter().map(|at| {
            let [error, _] = arc.report.circle.off(at.point);
            (seconds(job, at.sample as f64), error * 1e3)
        }));
        errors.push(GAP);
    }
    let limit = |sign: f64| {
        let bound = |segment| sign * segment_error(segment, &job.settings) * 1e3;
        let bounds = arcs(job, figures).map(|(segment, _)| (segment, bound(segment)));
        steps(job, bounds)
    };
    let limits = [limit(1.0), limit(-1.0)].concat();
    Panel::new("radius error on the arcs", TIME, "µm")
        .curve(Curve::new("bound", limits).colour(EXPECTED).dashed())
        .curve(Curve::new("of the commands", errors).colour(ARC).width(0.8))
}

/// Panel of the distance between the blend into an arc and the arc, over the way.
fn off_arc(job: &Job, figures: &Figures, blended: &Blended) -> Option<Panel> {
    let (arc, points) = (&blended.arc, &blended.points);
    let blend = job.prepared.segments.get(arc.segment.checked_sub(1)?)?;
    let rest = blend.next_piece.is_none();
    let off = |point| match rest {
        true => arc.report.circle.off(point)[0] * 1e3,
        false => job.prepared.distance(blend, point) * 1e3,
    };
    let change = blend.samples as usize;
    let ways = blended.ways();
    let curve: Points = ways
        .iter()
        .zip(points)
        .map(|(way, point)| (*way, off(*point)))
        .collect();
    let (blended, rotated) = (curve[..=change].to_vec(), curve[change..].to_vec());
    let ([_, .., end], at) = (&blended[..], blended.last().copied()?) else {
        return None;
    };
    let title = match job.prepared.pieces.len() {
        1 => "distance of the blend from the arc".to_owned(),
        _ => format!(
            "distance of the blend into piece {} from the path",
            arc.piece
        ),
    };
    let mut panel = Panel::new(title, "way in mm", "µm");
    if rest {
        let depth = -arc.report.blend_distance * 1e3;
        let curve = Curve::new("R(1 - cos(φ/2))", vec![(0.0, depth), (end.0, depth)]);
        panel = panel.curve(curve.colour(EXPECTED).dashed());
        let conventional = &figures.beside.start;
        if !conventional.is_empty() {
            let curve = Curve::new("conventional", conventional.clone());
            panel = panel.curve(curve.colour("#cc79a7").width(0.9));
        }
    }
    let jump = arc.report.direction_jump.to_degrees();
    Some(
        panel
            .curve(Curve::new("blend", blended).colour(BLEND).width(1.6))
            .curve(Curve::new("rotation", rotated).colour(ARC))
            .mark(at, format!("A+: the direction jumps by {jump:.3}°")),
    )
}
