//! Prepared path: consecutive segments, each of a whole number of samples.

use super::prepare::Timing;
use crate::input::Point;
use crate::path::circle::Circle;
use crate::path::pieces::Course;
use crate::path::vector::{distance, norm, sub};

/// Prepared path.
#[derive(Debug, Clone, PartialEq)]
pub struct Prepared {
    /// Segments in order; each begins at the last sample of the one before.
    pub segments: Vec<Segment>,
    /// Pieces of the path.
    pub pieces: Vec<PieceReport>,
    /// Times of the path.
    pub timing: Timing,
}

/// Segment of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Geometry.
    pub shape: Shape,
    /// Number of samples after the one at which it begins, at least 1.
    pub samples: u64,
    /// Sample at which it begins; sample 0 is the start of the path.
    pub first_sample: u64,
    /// Index of its piece; for a blend between two pieces the first.
    pub piece: usize,
    /// Index of the piece into which it blends.
    pub next_piece: Option<usize>,
    pub ends_at_rest: bool,
}

/// Geometry of a segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// Quartic from one point to another, past the corner between them (\[5\], \[10\]).
    Blend {
        /// Start A⁻; the corner itself if that is at rest.
        before: Point,
        /// Taught point A.
        corner: Point,
        /// End A⁺; the corner itself if that is at rest.
        behind: Point,
    },
    /// Straight line at constant speed.
    Line {
        /// Start.
        from: Point,
        /// End.
        to: Point,
    },
    /// Rotation at constant speed.
    Arc {
        /// Whole arc of the piece.
        circle: Circle,
        /// Angle φ on it at which the segment begins.
        from: f64,
        /// Angle Δθ per sample.
        step: f64,
    },
}

/// Kind of a segment, numbered as in a record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Quartic.
    Blend = 0,
    /// Straight.
    Line = 1,
    /// Rotation.
    Arc = 2,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PieceReport {
    /// Line of the piece in the input.
    pub line: Option<usize>,
    /// Line or arc.
    pub course: Course,
    /// Start.
    pub from: Point,
    /// End.
    pub to: Point,
    /// Length in mm.
    pub length: f64,
    /// Requested speed Vs in mm/s.
    pub wanted: f64,
    /// Speed v in mm/s.
    pub speed: f64,
    /// Number N of samples between its blends.
    pub samples: u64,
    /// Distance v·ta of the blends' ends from its ends, in a straight line, in mm.
    pub reach: f64,
    /// Additional values of an arc.
    pub arc: Option<ArcReport>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArcReport {
    /// Centre, axis, radius and angle.
    pub circle: Circle,
    /// Angle φ that a blend takes at each end, in radians.
    pub blend_angle: f64,
    /// Angle Δθ per sample, in radians.
    pub step: f64,
    /// Jump of the velocity's direction at A⁺ and C⁻: asin(v·ta/2R), in radians.
    pub direction_jump: f64,
    /// Jump of the acceleration there: v²/R, in mm/s².
    pub acceleration_jump: f64,
    /// Deviation from the arc of a blend from or to rest: R(1 − cos(φ/2)), in mm.
    pub blend_distance: f64,
    /// Common approximation of that deviation: (v·ta)²/8R, in mm.
    pub blend_distance_estimate: f64,
}

/// Position of a sample in the path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Place {
    /// Index of its segment; a sample between two belongs to the first.
    pub segment: usize,
    /// Number in the segment, from 1; 0 only for the start of the path.
    pub step: u64,
}

impl Prepared {
    /// Returns the number of samples, including the start.
    #[must_use]
    pub fn samples(&self) -> u64 {
        self.segments.last().map_or(0, Segment::end) + 1
    }

    /// Returns the position of a sample; `None` after the last.
    #[must_use]
    pub fn place(&self, sample: u64) -> Option<Place> {
        let segment = self.segments.partition_point(|s| s.end() < sample);
        let first = self.segments.get(segment)?.first_sample;
        Some(Place {
            segment,
            step: sample - first,
        })
    }

    /// Returns the exact point of a sample in mm; `None` after the last.
    #[must_use]
    pub fn point(&self, sample: u64) -> Option<Point> {
        let Place { segment, step } = self.place(sample)?;
        self.segments.get(segment).map(|s| s.point(step))
    }

    /// Returns the distance of a point from the pieces of a segment.
    #[must_use]
    pub fn distance(&self, segment: &Segment, point: Point) -> f64 {
        let pieces = std::iter::once(segment.piece).chain(segment.next_piece);
        let distances = pieces
            .filter_map(|piece| self.pieces.get(piece))
            .map(|piece| piece.distance(point));
        distances.fold(f64::INFINITY, f64::min)
    }
}

impl Segment {
    /// Returns the kind of the segment.
    #[must_use]
    pub fn kind(&self) -> Kind {
        match self.shape {
            Shape::Blend { .. } => Kind::Blend,
            Shape::Line { .. } => Kind::Line,
            Shape::Arc { .. } => Kind::Arc,
        }
    }

    /// Returns the last sample.
    #[must_use]
    pub fn end(&self) -> u64 {
        self.first_sample + self.samples
    }

    /// Returns the exact point of sample `step`; 0 is the start.
    #[must_use]
    pub fn point(&self, step: u64) -> Point {
        let share = step as f64 / self.samples as f64;
        match &self.shape {
            Shape::Blend {
                before,
                corner,
                behind,
            } => blend(*before, *corner, *behind, share),
            Shape::Line { from, to } => {
                std::array::from_fn(|k| from[k] * (1.0 - share) + to[k] * share)
            }
            Shape::Arc { circle, from, step } => {
                circle.point(from + step * self.samples as f64 * share)
            }
        }
    }

    /// Returns the distance of a blend from its corner at half its time: 3/16·|A⁻ − 2A + A⁺|;
    /// `None` for other segments.
    #[must_use]
    pub fn corner_distance(&self) -> Option<f64> {
        self.bend().map(|bend| 3.0 / 16.0 * norm(bend))
    }

    /// Returns the greatest acceleration of a blend of duration 2ta, at half its time: 3·|A⁻ − 2A
    /// + A⁺|/(2ta)²; `None` for other segments.
    #[must_use]
    pub fn peak_acceleration(&self, timing: &Timing) -> Option<f64> {
        let duration = 2.0 * timing.half_blend_s();
        self.bend()
            .map(|bend| 3.0 * norm(bend) / (duration * duration))
    }

    /// Returns S = A⁻ − 2A + A⁺.
    fn bend(&self) -> Option<Point> {
        match self.shape {
            Shape::Blend {
                before,
                corner,
                behind,
            } => Some(sub(sub(before, corner), sub(corner, behind))),
            Shape::Line { .. } | Shape::Arc { .. } => None,
        }
    }
}

impl PieceReport {
    /// Returns the distance of a point from the piece.
    #[must_use]
    pub fn distance(&self, point: Point) -> f64 {
        distance(point, self.course.nearest(self.from, self.to, point))
    }
}

/// Returns x = A⁻ + 2(A − A⁻)h + (A⁻ − 2A + A⁺)(2 − h)h³ (\[5\]).
fn blend(before: Point, corner: Point, behind: Point, h: f64) -> Point {
    // Weights of the three points, exact at both ends.
    let (rest, third) = (1.0 - h, h * h * h);
    let first = rest * rest * rest * (1.0 + h);
    let last = third * (2.0 - h);
    let middle = 2.0 * h * rest * (1.0 + h - h * h);
    std::array::from_fn(|k| before[k] * first + corner[k] * middle + behind[k] * last)
}
