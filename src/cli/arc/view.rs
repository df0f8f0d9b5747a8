//! The path as it lies in space, seen in an isometric view, or in its plane from above.

use super::Job;
use super::figures::Figures;
use super::projection::projected;
use super::style::{ARC, ARCS_MARKED, BLEND, EXPECTED, GAP, LINE, Points};
use motion_rtl::input::Point;
use motion_rtl::jobs::arc_generator::prepared::Kind;
use motion_rtl::path::vector::distance;
use motion_rtl::picture::{Curve, Panel};

const FLOOR: &str = "#dcdcdc";

/// The path of the commands.
pub fn path(job: &Job, figures: &Figures) -> Panel {
    let [_, _, [low, high]] = figures.extremes;
    match high - low < 1.0 / job.settings.counts_per_mm {
        true => plan(job, figures),
        false => isometric(job, figures),
    }
}

fn plan(job: &Job, figures: &Figures) -> Panel {
    let panel = Panel::new("path", "x in mm", "y in mm").equal_scales();
    curves(panel, job, figures, |[x, y, _]| (x, y))
}

fn isometric(job: &Job, figures: &Figures) -> Panel {
    let [[west, east], [south, north], [low, high]] = figures.extremes;
    let floor = [
        [west, south, low],
        [east, south, low],
        [east, north, low],
        [west, north, low],
        [west, south, low],
        [west, south, high],
    ];
    let mut panel = Panel::new("path, isometric", "", "")
        .equal_scales()
        .without_scales()
        .curve(Curve::new("box", floor.map(projected).to_vec()).colour(FLOOR));
    let points = figures.shown.iter().map(|shown| shown.measured.point);
    let shadow = points.map(|[x, y, _]| projected([x, y, low]));
    panel = panel.curve(
        Curve::new("from above", shadow.collect())
            .colour(FLOOR)
            .width(2.0),
    );
    // Every taught point, projected onto the floor.
    let taught = job.prepared.pieces.first().map(|piece| piece.from);
    let taught = taught
        .into_iter()
        .chain(job.prepared.pieces.iter().map(|piece| piece.to));
    let drops = taught.flat_map(|[x, y, z]| [projected([x, y, low]), projected([x, y, z]), GAP]);
    panel = panel.curve(
        Curve::new("height", drops.collect())
            .colour(EXPECTED)
            .width(0.7)
            .dashed(),
    );
    let size = distance([east, north, high], [west, south, low]);
    if figures.arcs.len() <= ARCS_MARKED {
        for arc in &figures.arcs {
            let circle = &arc.report.circle;
            if circle.radius > size {
                continue;
            }
            let radii = [circle.start, circle.centre, circle.end()];
            let name = format!("R = {:.1} mm", circle.radius);
            let curve = Curve::new(name, radii.map(projected).to_vec());
            panel = panel
                .curve(curve.colour(ARC).width(0.7).dashed())
                .mark(projected(circle.centre), "G");
        }
    }
    panel = curves(panel, job, figures, projected);
    for (at, words) in [
        (
            [west, south, low],
            format!("{west:.1}, {south:.1}, {low:.1}"),
        ),
        ([east, south, low], format!("x = {east:.1}")),
        ([west, north, low], format!("y = {north:.1}")),
        ([west, south, high], format!("z = {high:.1}")),
    ] {
        panel = panel.mark(projected(at), words);
    }
    for (at, name) in ends(figures) {
        panel = panel.mark(projected(at), name);
    }
    panel
}

/// First and last point.
fn ends(figures: &Figures) -> impl Iterator<Item = (Point, &'static str)> {
    let ends = figures.ends.into_iter().flatten();
    ends.zip(["start", "end"])
}

/// Rapids, lines, arcs and blends, each in its colour.
fn curves(
    mut panel: Panel,
    job: &Job,
    figures: &Figures,
    view: impl Fn(Point) -> (f64, f64),
) -> Panel {
    let rapid = |piece: usize| {
        let drawing = job.drawing.as_ref();
        let step = drawing.and_then(|drawing| drawing.moves.get(piece));
        step.is_some_and(|step| step.rapid)
    };
    let mut parts = [const { Points::new() }; 4];
    for (segment, samples) in figures.by_segment() {
        let segment = &job.prepared.segments[segment];
        let part = match (rapid(segment.piece), segment.kind()) {
            (true, _) => 0,
            (false, Kind::Line) => 1,
            (false, Kind::Arc) => 2,
            (false, Kind::Blend) => 3,
        };
        parts[part].extend(samples.into_iter().map(|at| view(at.point)));
        parts[part].push(GAP);
    }
    let [rapids, lines, arcs, blends] = parts;
    for (name, points, colour, width) in [
        ("rapid", rapids, EXPECTED, 0.7),
        ("line", lines, LINE, 1.8),
        ("arc", arcs, ARC, 1.8),
        ("blend", blends, BLEND, 2.6),
    ] {
        if points.is_empty() {
            continue;
        }
        let curve = Curve::new(name, points).colour(colour).width(width);
        panel = panel.curve(match name {
            "rapid" => curve.dashed(),
            _ => curve,
        });
    }
    panel
}
