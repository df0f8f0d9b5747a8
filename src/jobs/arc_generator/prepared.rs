//! A path as it is generated: segments, one after the other, each of a whole number of samples.

use super::prepare::Timing;
use crate::input::Point;
use crate::path::circle::Circle;
use crate::path::pieces::Course;
use crate::path::vector::{distance, norm, sub};

/// What a path became.
#[derive(Debug, Clone, PartialEq)]
pub struct Prepared {
    /// The segments in order. Each begins at the last sample of the one before.
    pub segments: Vec<Segment>,
    /// The pieces they came from.
    pub pieces: Vec<PieceReport>,
    /// The times it was made with.
    pub timing: Timing,
}

/// A segment of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Its points.
    pub shape: Shape,
    /// How many samples it has after the one it begins at, 1 or more.
    pub samples: u64,
    /// The sample it begins at; sample 0 is the start of the path.
    pub first_sample: u64,
    /// The piece it belongs to; for a blend from one piece to the next the former.
    pub piece: usize,
    /// The piece that it blends into.
    pub next_piece: Option<usize>,
    /// It ends at rest.
    pub ends_at_rest: bool,
}

/// The points of a segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// \[5\], \[10\]: a quartic from one point to another, past the corner between them.
    Blend {
        /// A⁻: where it begins; the corner itself if that is at rest.
        before: Point,
        /// A: the taught point.
        corner: Point,
        /// A⁺: where it ends; the corner itself if that is at rest.
        behind: Point,
    },
    /// A straight line at constant speed.
    Line {
        /// Where it begins.
        from: Point,
        /// Where it ends.
        to: Point,
    },
    /// A rotation at constant speed.
    Arc {
        /// The whole arc of the piece.
        circle: Circle,
        /// φ: where the segment begins on it.
        from: f64,
        /// Δθ: angle of a sample.
        step: f64,
    },
}

/// Kinds of segments, by the number that a record has for them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A quartic.
    Blend = 0,
    /// Straight.
    Line = 1,
    /// A rotation.
    Arc = 2,
}

/// What became of a piece.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PieceReport {
    /// Line of the input it stands in.
    pub line: Option<usize>,
    /// Straight or on an arc.
    pub course: Course,
    /// Where it begins.
    pub from: Point,
    /// Where it ends.
    pub to: Point,
    /// Its length in mm.
    pub length: f64,
    /// Vs: the speed that was wanted, in mm/s.
    pub wanted: f64,
    /// v: its speed, in mm/s.
    pub speed: f64,
    /// N: samples between its blends.
    pub samples: u64,
    /// v·ta: how far from its ends the blends reach, in a straight line.
    pub reach: f64,
    /// What an arc has besides.
    pub arc: Option<ArcReport>,
}

/// What became of an arc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArcReport {
    /// Centre, axis, radius and angle.
    pub circle: Circle,
    /// φ: angle of the arc that a blend takes at either end.
    pub blend_angle: f64,
    /// Δθ: angle of a sample.
    pub step: f64,
    /// How much the direction of the velocity jumps at A⁺ and C⁻: asin(v·ta/2R).
    pub direction_jump: f64,
    /// How much the acceleration jumps there, in mm/s²: v²/R.
    pub acceleration_jump: f64,
    /// How far a blend from or to rest leaves the arc, in mm: R(1 − cos(φ/2)).
    pub blend_distance: f64,
    /// The same in the common approximation: (v·ta)²/8R.
    pub blend_distance_estimate: f64,
}

/// Where a sample is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Place {
    /// Its segment. A sample between two belongs to the former.
    pub segment: usize,
    /// Its number in the segment: 1 to the segment's samples; 0 for the start of the path only.
    pub step: u64,
}

impl Prepared {
    /// Number of samples, the start with them.
    #[must_use]
    pub fn samples(&self) -> u64 {
        self.segments.last().map_or(0, Segment::end) + 1
    }

    /// Where a sample is; `None` behind the last.
    #[must_use]
    pub fn place(&self, sample: u64) -> Option<Place> {
        let segment = self.segments.partition_point(|s| s.end() < sample);
        let first = self.segments.get(segment)?.first_sample;
        Some(Place {
            segment,
            step: sample - first,
        })
    }

    /// The exact point of a sample, in mm; `None` behind the last.
    #[must_use]
    pub fn point(&self, sample: u64) -> Option<Point> {
        let Place { segment, step } = self.place(sample)?;
        self.segments.get(segment).map(|s| s.point(step))
    }

    /// Distance of a point from the pieces that a segment belongs to.
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
    /// Blend, line or arc.
    #[must_use]
    pub fn kind(&self) -> Kind {
        match self.shape {
            Shape::Blend { .. } => Kind::Blend,
            Shape::Line { .. } => Kind::Line,
            Shape::Arc { .. } => Kind::Arc,
        }
    }

    /// Its last sample.
    #[must_use]
    pub fn end(&self) -> u64 {
        self.first_sample + self.samples
    }

    /// The exact point of its sample number `step`, 0 being where it begins.
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

    /// Distance of a blend from its corner at half its time: 3/16·|A⁻ − 2A + A⁺|. Other segments
    /// have none.
    #[must_use]
    pub fn corner_distance(&self) -> Option<f64> {
        self.bend().map(|bend| 3.0 / 16.0 * norm(bend))
    }

    /// Largest acceleration of a blend of the duration 2ta, at half its time: 3·|A⁻ − 2A + A⁺|/(2ta)².
    /// Other segments have none.
    #[must_use]
    pub fn peak_acceleration(&self, timing: &Timing) -> Option<f64> {
        let duration = 2.0 * timing.half_blend_s();
        self.bend()
            .map(|bend| 3.0 * norm(bend) / (duration * duration))
    }

    /// S = A⁻ − 2A + A⁺.
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
    /// Distance of a point from the piece.
    #[must_use]
    pub fn distance(&self, point: Point) -> f64 {
        distance(point, self.course.nearest(self.from, self.to, point))
    }
}

/// \[5\]: x = A⁻ + 2(A − A⁻)h + (A⁻ − 2A + A⁺)(2 − h)h³.
fn blend(before: Point, corner: Point, behind: Point, h: f64) -> Point {
    // As weights of the three points: at both ends exactly the point.
    let (rest, third) = (1.0 - h, h * h * h);
    let first = rest * rest * rest * (1.0 + h);
    let last = third * (2.0 - h);
    let middle = 2.0 * h * rest * (1.0 + h - h * h);
    std::array::from_fn(|k| before[k] * first + corner[k] * middle + behind[k] * last)
}
