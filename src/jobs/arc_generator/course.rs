//! Measures of a segment, sample by sample, starting with its first.

use super::measure::{ArcMeasured, BlendMeasured};
use super::prepare::Timing;
use super::prepared::{Prepared, Segment, Shape};
use crate::input::Point;
use crate::path::circle::Circle;
use crate::path::vector::{add, distance, norm, scale};

/// Current segment.
#[derive(Debug)]
pub(super) enum Course<'a> {
    Line,
    Blend(BlendCourse<'a>),
    Arc(ArcCourse<'a>),
}

impl<'a> Course<'a> {
    /// Begins a segment at its first point.
    pub(super) fn begin(prepared: &'a Prepared, index: usize, point: Point) -> Self {
        let segment = &prepared.segments[index];
        match segment.shape {
            Shape::Line { .. } => Course::Line,
            Shape::Blend { corner, .. } => {
                let mut blend = BlendCourse {
                    prepared,
                    segment,
                    corner,
                    measured: BlendMeasured {
                        segment: index,
                        off_path: 0.0,
                        from_corner: f64::INFINITY,
                        peak_acceleration: 0.0,
                    },
                    along: [0.0; 3],
                    square: 0.0,
                };
                blend.take(0, point, None);
                Course::Blend(blend)
            }
            Shape::Arc { circle, .. } => {
                let piece = prepared.pieces.get(segment.piece);
                let mut arc = ArcCourse {
                    segment,
                    circle,
                    wanted: piece.map_or(0.0, |piece| piece.speed),
                    sample_s: prepared.timing.sample_s,
                    measured: ArcMeasured {
                        segment: index,
                        radius_errors: [f64::INFINITY, f64::NEG_INFINITY],
                        off_plane: 0.0,
                        end_error: 0.0,
                        speed: 0.0,
                        radius_rms: 0.0,
                        speed_deviation: 0.0,
                    },
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
    segment: &'a Segment,
    corner: Point,
    measured: BlendMeasured,
    /// Projection of the second differences on the blend's shape, and the square of the shape.
    along: Point,
    square: f64,
}

impl BlendCourse<'_> {
    /// Adds sample `step` with the second difference that it ends, if there is one.
    pub(super) fn take(&mut self, step: u64, point: Point, second: Option<Point>) {
        let measured = &mut self.measured;
        let off = self.prepared.distance(self.segment, point);
        measured.off_path = measured.off_path.max(off);
        measured.from_corner = measured.from_corner.min(distance(point, self.corner));
        if let (2.., Some(second)) = (step, second) {
            let n = self.segment.samples as f64;
            let h = (step - 1) as f64 / n;
            let shape = 4.0 * h * (1.0 - h) - 2.0 / (3.0 * n * n);
            self.along = add(self.along, scale(second, shape));
            self.square += shape * shape;
        }
    }

    /// Returns the measures of the whole blend.
    pub(super) fn finish(&self, timing: &Timing) -> BlendMeasured {
        let ts = timing.sample_s;
        BlendMeasured {
            peak_acceleration: self.peak() / (ts * ts),
            ..self.measured
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
    segment: &'a Segment,
    circle: Circle,
    /// Speed of its piece in mm/s.
    wanted: f64,
    sample_s: f64,
    measured: ArcMeasured,
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
        let deviation = (way / self.sample_s - self.wanted).abs();
        self.measured.speed_deviation = self.measured.speed_deviation.max(deviation);
    }

    fn see(&mut self, point: Point) {
        let [outside, height] = self.circle.off(point);
        let measured = &mut self.measured;
        let [least, most] = measured.radius_errors;
        measured.radius_errors = [least.min(outside), most.max(outside)];
        measured.off_plane = measured.off_plane.max(height.abs());
        self.squares += outside * outside;
    }

    /// Returns the measures of the whole arc, which ends at `last`.
    pub(super) fn finish(&self, timing: &Timing, last: Point) -> ArcMeasured {
        let steps = self.segment.samples;
        ArcMeasured {
            end_error: distance(last, self.segment.point(steps)),
            speed: self.way / (timing.sample_s * steps as f64),
            radius_rms: (self.squares / (steps + 1) as f64).sqrt(),
            ..self.measured
        }
    }
}
