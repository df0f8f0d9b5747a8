//! The blend into an arc that the picture shows.

use super::Job;
use motion_rtl::input::Point;
use motion_rtl::jobs::arc_generator::prepared::ArcReport;
use motion_rtl::path::vector::distance;
use std::ops::RangeInclusive;

/// An arc of a path.
#[derive(Debug, Clone, Copy)]
pub struct ArcFigures {
    /// Index of its segment.
    pub segment: usize,
    /// Index of its piece.
    pub piece: usize,
    pub report: ArcReport,
}

/// A blend into an arc with as much of the arc.
#[derive(Debug)]
pub struct Blended {
    pub arc: ArcFigures,
    pub samples: RangeInclusive<u64>,
    /// Points in mm.
    pub points: Vec<Point>,
}

impl Blended {
    /// Returns the blend that leaves its arc farthest; `None` if there is no arc.
    pub fn of(job: &Job, arcs: &[ArcFigures]) -> Option<Self> {
        let far = |arc: &&ArcFigures| arc.report.blend_distance;
        let arc = *arcs.iter().max_by(|a, b| far(a).total_cmp(&far(b)))?;
        let segments = &job.prepared.segments;
        let (blend, rotation) = (
            segments.get(arc.segment.checked_sub(1)?)?,
            segments[arc.segment],
        );
        let last = (blend.end() + blend.samples).min(rotation.end());
        Some(Blended {
            arc,
            samples: blend.first_sample..=last,
            points: Vec::new(),
        })
    }

    /// Way to each of its points in mm.
    pub fn ways(&self) -> Vec<f64> {
        let ways = self.points.windows(2).scan(0.0, |way, pair| {
            *way += distance(pair[0], pair[1]);
            Some(*way)
        });
        std::iter::once(0.0).chain(ways).collect()
    }
}
