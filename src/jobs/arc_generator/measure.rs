//! Measures of a run, from its position commands, sample by sample.

use super::course::Course;
use super::leaving::Leaving;
use super::prepared::Prepared;
use crate::input::{COORDINATES, Point};
use crate::path::vector::{distance, norm, sub};
use std::collections::VecDeque;

/// Measures from the samples of a run.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Measured {
    /// Greatest distance of a sample from its exact point, in mm.
    pub largest_error: f64,
    /// Arcs in order.
    pub arcs: Vec<ArcMeasured>,
    /// Blends in order.
    pub blends: Vec<BlendMeasured>,
    /// Joints of segments in order.
    pub joints: Vec<Joint>,
}

/// Measures of one sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SampleMeasured {
    /// Number of the sample.
    pub sample: u64,
    /// Segment of the sample; a sample between two belongs to the first.
    pub segment: usize,
    /// Point in mm.
    pub point: Point,
    /// Distance from its exact point, in mm.
    pub error: f64,
    /// Speed from the sample before, in mm/s.
    pub speed: Option<f64>,
    /// Acceleration at the sample before, in mm/s².
    pub acceleration: Option<f64>,
}

/// Measures of a rotation's samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArcMeasured {
    /// Index of the segment.
    pub segment: usize,
    /// Least and greatest error of the radius in mm, outwards positive.
    pub radius_errors: [f64; 2],
    /// Greatest distance from the arc's plane, in mm.
    pub off_plane: f64,
    /// Distance of the last sample from C⁻, in mm.
    pub end_error: f64,
    /// Mean speed along the arc, in mm/s.
    pub speed: f64,
    /// Root mean square of the radius error, in mm.
    pub radius_rms: f64,
    /// Greatest deviation from the piece's speed from sample to sample, in mm/s.
    pub speed_deviation: f64,
}

/// Measures of a blend's samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlendMeasured {
    /// Index of the segment.
    pub segment: usize,
    /// Greatest distance from the lines and arcs that it belongs to, in mm.
    pub off_path: f64,
    /// Least distance from the taught point, in mm.
    pub from_corner: f64,
    /// Greatest acceleration in mm/s², by a least-squares parabola through the second differences
    /// of the samples. A single one may be off by two counts over Ts² due to rounding.
    pub peak_acceleration: f64,
}

/// Jumps between two consecutive segments. Each side is a least-squares polynomial of degree 4
/// through the segment's samples next to the joint, up to the number of a blend's samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint {
    /// Index of the segment that ends.
    pub segment: usize,
    /// Number of the sample.
    pub sample: u64,
    /// Angle between the velocities before and after, in radians; 0 at rest.
    pub direction_jump: f64,
    /// Length of the velocity difference, in mm/s.
    pub velocity_jump: f64,
    /// Length of the acceleration difference, in mm/s².
    pub acceleration_jump: f64,
}

impl Measured {
    /// Measures position commands in counts, one for each sample of the path.
    ///
    /// Returns `None` if their number differs from the path's.
    #[must_use]
    pub fn of(
        prepared: &Prepared,
        counts_per_mm: f64,
        commands: &[[i64; COORDINATES]],
    ) -> Option<Self> {
        let mut measuring = Measuring::new(prepared, counts_per_mm);
        for counts in commands {
            measuring.take(*counts);
        }
        measuring.finish()
    }
}

/// Measurement of position commands while they come.
#[derive(Debug)]
pub struct Measuring<'a> {
    prepared: &'a Prepared,
    counts_per_mm: f64,
    measured: Measured,
    samples: u64,
    /// Index of the current segment.
    segment: usize,
    course: Course<'a>,
    /// Latest points, as many as needed to measure one side of a joint.
    recent: VecDeque<Point>,
    /// Joint whose second side is being measured.
    leaving: Option<Leaving>,
}

impl<'a> Measuring<'a> {
    /// Creates a measurement before the first command.
    #[must_use]
    pub fn new(prepared: &'a Prepared, counts_per_mm: f64) -> Self {
        Measuring {
            prepared,
            counts_per_mm,
            measured: Measured::default(),
            samples: 0,
            segment: 0,
            course: Course::Line,
            recent: VecDeque::new(),
            leaving: None,
        }
    }

    /// Adds the next command in counts; returns `None` after the last sample of the path.
    pub fn take(&mut self, counts: [i64; COORDINATES]) -> Option<SampleMeasured> {
        let (prepared, sample) = (self.prepared, self.samples);
        self.samples += 1;
        let mut segment = prepared.segments.get(self.segment)?;
        if sample > segment.end() {
            self.segment += 1;
            segment = prepared.segments.get(self.segment)?;
        }
        let point = counts.map(|counts| counts as f64 / self.counts_per_mm);
        // A joint needs one sample more than a blend has.
        if self.recent.len() as u64 > prepared.timing.blend_samples.max(2) {
            self.recent.pop_front();
        }
        self.recent.push_back(point);
        let error = distance(segment.point(sample - segment.first_sample), point);
        self.measured.largest_error = self.measured.largest_error.max(error);
        let ts = prepared.timing.sample_s;
        let before = |k: usize| Some(self.recent[self.recent.len().checked_sub(k + 1)?]);
        let way = before(1).map(|last| distance(point, last));
        let second = before(2).zip(before(1));
        let second = second.map(|(first, last)| sub(sub(point, last), sub(last, first)));
        self.follow(sample, point, way.unwrap_or(0.0), second);
        Some(SampleMeasured {
            sample,
            segment: self.segment,
            point,
            error,
            speed: way.map(|way| way / ts),
            acceleration: second.map(|second| norm(second) / (ts * ts)),
        })
    }

    /// Returns the measures of the path after all commands; `None` if their number differs from
    /// the path's.
    #[must_use]
    pub fn finish(self) -> Option<Measured> {
        (self.samples == self.prepared.samples()).then_some(self.measured)
    }

    /// Measures the segment of a sample, and at its end begins the next.
    fn follow(&mut self, sample: u64, point: Point, way: f64, second: Option<Point>) {
        let (prepared, index) = (self.prepared, self.segment);
        let segment = &prepared.segments[index];
        let (step, most) = (sample - segment.first_sample, prepared.timing.blend_samples);
        match &mut self.course {
            _ if sample == 0 => self.course = Course::begin(prepared, index, point),
            Course::Line => {}
            Course::Blend(blend) => blend.take(step, point, second),
            Course::Arc(arc) => arc.take(point, way),
        }
        if step == most.min(segment.samples)
            && let Some(leaving) = self.leaving.take()
        {
            let joint = leaving.joint(segment, &self.recent, &prepared.timing);
            self.measured.joints.push(joint);
        }
        if sample < segment.end() {
            return;
        }
        match &self.course {
            Course::Line => {}
            Course::Blend(blend) => self.measured.blends.push(blend.finish(&prepared.timing)),
            Course::Arc(arc) => self.measured.arcs.push(arc.finish(&prepared.timing, point)),
        }
        if index + 1 < prepared.segments.len() {
            self.course = Course::begin(prepared, index + 1, point);
            self.leaving = Some(Leaving::new(index, segment, &self.recent, most));
        }
    }
}
