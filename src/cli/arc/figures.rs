//! What is measured on the commands of a run, sample by sample.

use super::Job;
use super::beside::Beside;
use motion_rtl::input::Point;
use motion_rtl::jobs::arc_generator::job::Played;
use motion_rtl::jobs::arc_generator::measure::Measured;
use motion_rtl::jobs::arc_generator::prepared::{ArcReport, PieceReport, Segment, Shape};
use motion_rtl::path::circle::Circle;

/// The figures of a run.
#[derive(Debug)]
pub struct Figures {
    /// The commands, in mm.
    pub points: Vec<Point>,
    /// Measured on them; none where their number is not that of the path's samples.
    pub measured: Option<Measured>,
    /// The arcs, in order.
    pub arcs: Vec<ArcFigures>,
    /// The arcs by the conventional method.
    pub beside: Beside,
    /// The same without ramps.
    pub even: Beside,
}

/// The figures of an arc.
#[derive(Debug)]
pub struct ArcFigures {
    /// Its segment.
    pub segment: usize,
    /// Its piece.
    pub piece: usize,
    /// What became of it.
    pub report: ArcReport,
    /// Radius error of each of its samples from A⁺ on, outwards positive, in mm.
    pub radius_errors: Vec<f64>,
    /// Largest deviation of its speed from what it should be, from sample to sample, in mm/s.
    pub speed_deviation: f64,
    /// The same arc from rest to rest on the conventional circuit: its points and their radius
    /// errors in mm.
    pub conventional: Vec<(Point, f64)>,
}

impl Figures {
    /// Of what was played.
    pub fn of(job: &Job, played: &Played, [beside, even]: [Beside; 2]) -> Self {
        let counts: Vec<_> = played
            .commands
            .iter()
            .map(|command| command.counts)
            .collect();
        let measured = Measured::of(&job.prepared, job.settings.counts_per_mm, &counts);
        let points: Vec<Point> = counts.into_iter().map(|counts| job.mm(counts)).collect();
        let arcs = match &measured {
            None => Vec::new(),
            Some(measured) => arcs(job, &points, measured, &beside),
        };
        Figures {
            points,
            measured,
            arcs,
            beside,
            even,
        }
    }
}

fn arcs(job: &Job, points: &[Point], measured: &Measured, beside: &Beside) -> Vec<ArcFigures> {
    let segments = job.prepared.segments.iter().enumerate();
    segments
        .filter_map(|(index, segment)| {
            let (piece, report, circle) = arc(job, segment)?;
            let samples = segment.first_sample as usize..=segment.end() as usize;
            let speeds = &measured.speeds[*samples.start()..*samples.end()];
            let own = &points[samples];
            Some(ArcFigures {
                segment: index,
                piece: segment.piece,
                report,
                radius_errors: own.iter().map(|point| circle.off(*point)[0]).collect(),
                speed_deviation: speeds
                    .iter()
                    .map(|speed| (speed - piece.speed).abs())
                    .fold(0.0, f64::max),
                conventional: conventional(beside.points(index), &circle),
            })
        })
        .collect()
}

/// A segment that is an arc, with its piece.
fn arc<'a>(job: &'a Job, segment: &Segment) -> Option<(&'a PieceReport, ArcReport, Circle)> {
    let Shape::Arc { circle, .. } = segment.shape else {
        return None;
    };
    let piece = job.prepared.pieces.get(segment.piece)?;
    Some((piece, piece.arc?, circle))
}

fn conventional(points: &[Point], circle: &Circle) -> Vec<(Point, f64)> {
    let off = |point: &Point| (*point, circle.off(*point)[0]);
    points.iter().map(off).collect()
}
