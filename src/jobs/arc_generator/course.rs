//! Measures of a segment, sample by sample, starting with its first.

use super::bounds::segment_error;
use super::measure::{ArcMeasured, BlendMeasured, Pair};
use super::prepared::{PieceReport, Prepared, Segment, Shape};
use super::settings::Settings;
use crate::input::Point;
use crate::path::circle::Circle;
use crate::path::vector::{add, angle_between, distance, norm, scale};

/// Current segment.
#[derive(Debug)]
pub(super) enum Course<'a> {
    Line,
    Blend(BlendCourse<'a>),
    Arc(ArcCourse<'a>),
}

impl<'a> Course<'a> {
    /// Begins a segment at its first point.
    pub(super) fn begin(
        prepared: &'a Prepared,
        settings: &Settings,
        index: usize,
        point: Point,
    ) -> Self {
        let segment = &prepared.segments[index];
        match segment.shape {
            Shape::Line { .. } => Course::Line,
            Shape::Blend { corner, .. } => {
                let mut blend = BlendCourse {
                    prepared,
                    index,
                    segment,
                    corner,
                    off_path: 0.0,
                    from_corner: f64::INFINITY,
                    along: [0.0; 3],
                    square: 0.0,
                };
                blend.take(0, point, None);
                Course::Blend(blend)
            }
            Shape::Arc { circle, .. } => {
                let mut arc = ArcCourse {
                    prepared,
                    index,
                    segment,
                    circle,
                    bound: segment_error(segment, settings),
                    radius_errors: [f64::INFINITY, f64::NEG_INFINITY],
                    off_plane: 0.0,
                    speed_deviation: 0.0,
                    squares: 0.0,
                    way: 0.0,
                };
                arc.see(point);
                Course::Arc(arc)
            }
        }
    }
}

/// Current blend.
#[derive(Debug)]
pub(super) struct BlendCourse<'a> {
    prepared: &'a Prepared,
    index: usize,
    segment: &'a Segment,
    corner: Point,
    /// Greatest distance from the path and least one from the corner, in mm.
    off_path: f64,
    from_corner: f64,
    /// Projection of the second differences on the blend's shape, and the square of the shape.
    along: Point,
    square: f64,
}

impl BlendCourse<'_> {
    /// Adds sample `step` with the second difference that it ends, if there is one.
    pub(super) fn take(&mut self, step: u64, point: Point, second: Option<Point>) {
        let off = self.prepared.distance(self.segment, point);
        self.off_path = self.off_path.max(off);
        self.from_corner = self.from_corner.min(distance(point, self.corner));
        if let (2.., Some(second)) = (step, second) {
            let n = self.segment.samples as f64;
            let h = (step - 1) as f64 / n;
            let shape = 4.0 * h * (1.0 - h) - 2.0 / (3.0 * n * n);
            self.along = add(self.along, scale(second, shape));
            self.square += shape * shape;
        }
    }

    /// Returns the measures of the whole blend.
    pub(super) fn finish(&self) -> BlendMeasured {
        let (segment, timing) = (self.segment, &self.prepared.timing);
        let pieces = &self.prepared.pieces;
        let piece = &pieces[segment.piece];
        let next = segment.next_piece.and_then(|next| pieces.get(next));
        let turn = |next: &PieceReport| angle_between(piece.directions()[1], next.directions()[0]);
        BlendMeasured {
            segment: self.index,
            piece: segment.piece,
            line: piece.line,
            kind: match (segment.ends_at_rest, next) {
                (true, _) => "to rest",
                (false, None) => "from rest",
                (false, Some(_)) => "joint",
            },
            turn_deg: next.map(|next| turn(next).to_degrees()),
            corner_distance_um: next.and(segment.corner_distance()).map(|mm| Pair {
                measured: self.from_corner * 1e3,
                expected: mm * 1e3,
            }),
            off_path_um: self.off_path * 1e3,
            peak_acceleration_mm_per_s2: Pair {
                measured: self.peak() / (timing.sample_s * timing.sample_s),
                expected: segment.peak_acceleration(timing).unwrap_or(0.0),
            },
        }
    }

    /// Returns the greatest second difference of a blend by projecting the samples' second
    /// differences on the shape of x'' = 12S·h(1 − h), which a step of 1/n reduces by 2S/n².
    fn peak(&self) -> f64 {
        match self.square > 0.0 {
            true => norm(self.along) / self.square,
            false => 0.0,
        }
    }
}

/// Current arc.
#[derive(Debug)]
pub(super) struct ArcCourse<'a> {
    prepared: &'a Prepared,
    index: usize,
    segment: &'a Segment,
    circle: Circle,
    /// Bound of the errors in mm.
    bound: f64,
    /// Least and greatest error of the radius, and greatest distance from the plane, in mm.
    radius_errors: [f64; 2],
    off_plane: f64,
    /// Greatest deviation from the piece's speed from sample to sample, in mm/s.
    speed_deviation: f64,
    /// Sum of the squared radius errors.
    squares: f64,
    /// Length along the samples in mm.
    way: f64,
}

impl ArcCourse<'_> {
    /// Adds the next sample, `way` mm after the one before.
    pub(super) fn take(&mut self, point: Point, way: f64) {
        self.see(point);
        self.way += way;
        let speed = self.prepared.pieces[self.segment.piece].speed;
        let deviation = (way / self.prepared.timing.sample_s - speed).abs();
        self.speed_deviation = self.speed_deviation.max(deviation);
    }

    fn see(&mut self, point: Point) {
        let [outside, height] = self.circle.off(point);
        let [least, most] = self.radius_errors;
        self.radius_errors = [least.min(outside), most.max(outside)];
        self.off_plane = self.off_plane.max(height.abs());
        self.squares += outside * outside;
    }

    /// Returns the measures of the whole arc, which ends at `last`; its ends are measured later.
    pub(super) fn finish(&self, last: Point) -> ArcMeasured {
        let (segment, circle) = (self.segment, &self.circle);
        let piece = &self.prepared.pieces[segment.piece];
        let steps = segment.samples;
        let duration = self.prepared.timing.sample_s * steps as f64;
        ArcMeasured {
            segment: self.index,
            piece: segment.piece,
            line: piece.line,
            radius_mm: circle.radius,
            centre_mm: circle.centre,
            axis: circle.axis,
            angle_deg: circle.angle.to_degrees(),
            blend_angle_deg: piece.arc.map_or(0.0, |arc| arc.blend_angle.to_degrees()),
            samples: piece.samples,
            step_deg: piece.arc.map_or(0.0, |arc| arc.step.to_degrees()),
            speed_wanted_mm_per_s: piece.wanted,
            speed_mm_per_s: Pair {
                measured: self.way / duration,
                expected: piece.speed,
            },
            speed_deviation_mm_per_s: self.speed_deviation,
            radius_error_um: self.radius_errors.map(|mm| mm * 1e3),
            radius_error_rms_um: (self.squares / (steps + 1) as f64).sqrt() * 1e3,
            off_plane_um: self.off_plane * 1e3,
            end_error_um: distance(last, segment.point(steps)) * 1e3,
            bound_um: self.bound * 1e3,
            conventional_radius_error_um: None,
            ends: Vec::new(),
        }
    }
}
