//! What came out: measured from position commands, sample by sample.

use super::course::Course;
use super::leaving::Leaving;
use super::prepared::Prepared;
use crate::input::{COORDINATES, Point};
use crate::path::vector::{distance, norm, sub};
use std::collections::VecDeque;

/// Measured from the samples of a run.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Measured {
    /// Largest distance of a sample from its exact point, in mm.
    pub largest_error: f64,
    /// The arcs, in order.
    pub arcs: Vec<ArcMeasured>,
    /// The blends, in order.
    pub blends: Vec<BlendMeasured>,
    /// The joints of segments, in order.
    pub joints: Vec<Joint>,
}

/// A sample as it comes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SampleMeasured {
    /// Its number.
    pub sample: u64,
    /// Its segment. A sample between two belongs to the former.
    pub segment: usize,
    /// Its point, in mm.
    pub point: Point,
    /// Its distance from its exact point, in mm.
    pub error: f64,
    /// Speed in mm/s from the sample before to it.
    pub speed: Option<f64>,
    /// Acceleration in mm/s² at the sample before.
    pub acceleration: Option<f64>,
}

/// Measured on the samples of a rotation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArcMeasured {
    /// The segment.
    pub segment: usize,
    /// Least and largest error of the radius, in mm, outwards positive.
    pub radius_errors: [f64; 2],
    /// Largest distance from the arc's plane, in mm.
    pub off_plane: f64,
    /// Distance of its last sample from C⁻, in mm.
    pub end_error: f64,
    /// Mean speed along the arc, in mm/s.
    pub speed: f64,
    /// Root of the mean square of the radius error, in mm.
    pub radius_rms: f64,
    /// Largest deviation from the piece's speed from sample to sample, in mm/s.
    pub speed_deviation: f64,
}

/// Measured on the samples of a blend.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlendMeasured {
    /// The segment.
    pub segment: usize,
    /// Largest distance from the lines and arcs that it belongs to, in mm.
    pub off_path: f64,
    /// Least distance from the taught point, in mm.
    pub from_corner: f64,
    /// Largest acceleration, in mm/s²: that of the parabola of least squares through the second
    /// differences of the samples. One of them alone may be off by two counts over Ts² for rounding.
    pub peak_acceleration: f64,
}

/// What jumps where a segment ends and the next begins. Each side is a polynomial of degree 4 of
/// least squares through the segment's samples next to the joint, as many as a blend has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint {
    /// The segment that ends.
    pub segment: usize,
    /// The sample.
    pub sample: u64,
    /// Angle between the velocities before and after, in radians; 0 if it rests.
    pub direction_jump: f64,
    /// Length of the difference of both velocities, in mm/s.
    pub velocity_jump: f64,
    /// Length of the difference of both accelerations, in mm/s².
    pub acceleration_jump: f64,
}

impl Measured {
    /// Measures position commands in counts, one for each sample of the path.
    ///
    /// `None` unless there are as many as the path has.
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

/// Measures position commands while they come.
#[derive(Debug)]
pub struct Measuring<'a> {
    prepared: &'a Prepared,
    counts_per_mm: f64,
    measured: Measured,
    samples: u64,
    /// The segment under way.
    segment: usize,
    course: Course<'a>,
    /// The latest points, as many as a joint is measured with on one side.
    recent: VecDeque<Point>,
    /// The joint whose second side is under way.
    leaving: Option<Leaving>,
}

impl<'a> Measuring<'a> {
    /// One before the first command.
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

    /// Takes the next command in counts; `None` behind the last sample of the path.
    pub fn take(&mut self, counts: [i64; COORDINATES]) -> Option<SampleMeasured> {
        let (prepared, sample) = (self.prepared, self.samples);
        self.samples += 1;
        let mut segment = prepared.segments.get(self.segment)?;
        if sample > segment.end() {
            self.segment += 1;
            segment = prepared.segments.get(self.segment)?;
        }
        let point = counts.map(|counts| counts as f64 / self.counts_per_mm);
        // A joint is measured with a sample more than a blend has.
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

    /// Measures of the path, all commands being taken; `None` unless there were as many as it has.
    #[must_use]
    pub fn finish(self) -> Option<Measured> {
        (self.samples == self.prepared.samples()).then_some(self.measured)
    }

    /// Measures the segment that a sample belongs to, and at its end begins the next.
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
