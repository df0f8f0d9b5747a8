//! Measures of a run, from its position commands, sample by sample.

use super::bounds::segment_error;
use super::course::Course;
use super::leaving::Leaving;
use super::prepared::{PieceReport, Prepared};
use super::settings::Settings;
use crate::input::{COORDINATES, Point};
use crate::path::vector::{distance, norm, sub};
use serde::Serialize;
use std::collections::VecDeque;

/// Figure that was measured, and what its closed form says.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Pair {
    /// Measured on the commands.
    pub measured: f64,
    /// By the closed form.
    pub expected: f64,
}

/// Measures from the samples of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Measured {
    /// Greatest distance of a sample from its exact point.
    pub error_max_um: f64,
    /// Bound of `error_max_um`.
    pub error_bound_um: f64,
    /// Arcs in order.
    pub arcs: Vec<ArcMeasured>,
    /// Lines in order.
    pub lines: Vec<LinePlanned>,
    /// Blends in order.
    pub blends: Vec<BlendMeasured>,
    /// Joints of segments in order.
    #[serde(skip)]
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

/// Arc and the measures of its rotation's samples.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ArcMeasured {
    /// Index of the segment.
    #[serde(skip)]
    pub segment: usize,
    /// Index of the piece, from 0.
    pub piece: usize,
    /// Line of the input.
    pub line: Option<usize>,
    /// Radius R.
    pub radius_mm: f64,
    /// Centre G.
    pub centre_mm: Point,
    /// Unit vector k of the axis.
    pub axis: Point,
    /// Angle θ from start to end.
    pub angle_deg: f64,
    /// Angle φ: the part of θ that each blend takes.
    pub blend_angle_deg: f64,
    /// Number N of samples between the blends.
    pub samples: u64,
    /// Angle Δθ per sample.
    pub step_deg: f64,
    /// Requested speed Vs.
    pub speed_wanted_mm_per_s: f64,
    /// Speed v; measured: its mean along the rotation.
    pub speed_mm_per_s: Pair,
    /// Greatest deviation from v from one sample to the next.
    pub speed_deviation_mm_per_s: f64,
    /// Least and greatest error of the radius, outwards positive.
    pub radius_error_um: [f64; 2],
    /// RMS error of the radius.
    pub radius_error_rms_um: f64,
    /// Greatest distance from the arc's plane.
    #[serde(skip)]
    pub off_plane_um: f64,
    /// Distance of the last sample from C⁻.
    pub end_error_um: f64,
    /// Bound of both errors: rotation plus rounding to counts.
    pub bound_um: f64,
    /// Greatest radius error of the conventional method, also rounded to counts; omitted without
    /// a comparison.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub conventional_radius_error_um: Option<f64>,
    /// Start A⁺ and end C⁻ of the rotation.
    pub ends: Vec<EndMeasured>,
}

/// Start or end of a rotation beside its blend.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EndMeasured {
    /// "A+" or "C-".
    pub at: &'static str,
    /// True if the blend there is from or to rest.
    pub rest: bool,
    /// Jump of the velocity's direction, asin(v·ta/2R).
    pub direction_jump_deg: Pair,
    /// Jump of the acceleration, v²/R.
    pub acceleration_jump_mm_per_s2: Pair,
    /// Distance between blend and arc, R(1 − cos(φ/2)) if the blend is from or to rest.
    pub off_arc_um: Option<Pair>,
    /// Estimate of that distance, (v·ta)²/8R.
    pub off_arc_estimate_um: Option<f64>,
}

/// Line of a path.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LinePlanned {
    /// Index of the piece, from 0.
    pub piece: usize,
    /// Line of the input.
    pub line: Option<usize>,
    /// Length of the piece.
    pub length_mm: f64,
    /// Number of samples between its blends.
    pub samples: u64,
    /// Requested speed Vs.
    pub speed_wanted_mm_per_s: f64,
    /// Speed v.
    pub speed_mm_per_s: f64,
}

/// Blend and the measures of its samples.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct BlendMeasured {
    /// Index of the segment.
    #[serde(skip)]
    pub segment: usize,
    /// Index of the piece, from 0; for a joint the former.
    pub piece: usize,
    /// Line of the input.
    pub line: Option<usize>,
    /// "from rest", "joint" or "to rest".
    pub kind: &'static str,
    /// Turn of a joint.
    pub turn_deg: Option<f64>,
    /// Least distance between a joint and its taught point, 3/16·|A⁻ − 2A + A⁺|.
    pub corner_distance_um: Option<Pair>,
    /// Greatest distance from the lines and arcs that it blends.
    pub off_path_um: f64,
    /// Greatest acceleration, 3·|A⁻ − 2A + A⁺|/(2ta)²; measured by a least-squares parabola
    /// through the second differences of the samples. A single one may be off by two counts over
    /// Ts² due to rounding.
    pub peak_acceleration_mm_per_s2: Pair,
}

/// Jumps between two consecutive segments. Each side is a least-squares polynomial of degree 4
/// through the segment's samples next to the joint, up to the number of a blend's samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint {
    /// Index of the segment that ends.
    pub segment: usize,
    /// Number of the sample.
    pub sample: u64,
    /// Angle between the velocities before and after; 0 at rest.
    pub direction_jump_deg: f64,
    /// Length of the velocity difference.
    pub velocity_jump_mm_per_s: f64,
    /// Length of the acceleration difference.
    pub acceleration_jump_mm_per_s2: f64,
}

impl Measured {
    /// Measures position commands in counts, one for each sample of the path.
    ///
    /// Returns `None` if their number differs from the path's.
    #[must_use]
    pub fn of(
        prepared: &Prepared,
        settings: &Settings,
        commands: &[[i64; COORDINATES]],
    ) -> Option<Self> {
        let mut measuring = Measuring::new(prepared, settings);
        for counts in commands {
            measuring.take(*counts);
        }
        measuring.finish()
    }

    /// Returns what is known of a path before it is run: its lines and its error bound.
    #[must_use]
    pub fn planned(prepared: &Prepared, settings: &Settings) -> Self {
        let bounds = prepared.segments.iter();
        let bounds = bounds.map(|segment| segment_error(segment, settings));
        Measured {
            error_max_um: 0.0,
            error_bound_um: bounds.fold(0.0, f64::max) * 1e3,
            arcs: Vec::new(),
            lines: lines(prepared),
            blends: Vec::new(),
            joints: Vec::new(),
        }
    }
}

fn lines(prepared: &Prepared) -> Vec<LinePlanned> {
    let pieces = prepared.pieces.iter().enumerate();
    let lines = pieces.filter(|(_, piece)| piece.arc.is_none());
    let line = |(number, piece): (usize, &PieceReport)| LinePlanned {
        piece: number,
        line: piece.line,
        length_mm: piece.length,
        samples: piece.samples,
        speed_wanted_mm_per_s: piece.wanted,
        speed_mm_per_s: piece.speed,
    };
    lines.map(line).collect()
}

/// Measurement of position commands while they come.
#[derive(Debug)]
pub struct Measuring<'a> {
    prepared: &'a Prepared,
    settings: &'a Settings,
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
    pub fn new(prepared: &'a Prepared, settings: &'a Settings) -> Self {
        Measuring {
            prepared,
            settings,
            measured: Measured::planned(prepared, settings),
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
        let point = counts.map(|counts| counts as f64 / self.settings.counts_per_mm);
        // A joint needs one sample more than a blend has.
        if self.recent.len() as u64 > prepared.timing.blend_samples.max(2) {
            self.recent.pop_front();
        }
        self.recent.push_back(point);
        let error = distance(segment.point(sample - segment.first_sample), point);
        self.measured.error_max_um = self.measured.error_max_um.max(error * 1e3);
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
    pub fn finish(mut self) -> Option<Measured> {
        for arc in 0..self.measured.arcs.len() {
            self.measured.arcs[arc].ends = self.ends(&self.measured.arcs[arc]);
        }
        (self.samples == self.prepared.samples()).then_some(self.measured)
    }

    /// Returns start and end of a rotation, each beside its blend.
    fn ends(&self, arc: &ArcMeasured) -> Vec<EndMeasured> {
        let Some(report) = self.prepared.pieces[arc.piece].arc else {
            return Vec::new();
        };
        // Before and behind every arc is a blend; a joint has the number of the segment that it ends.
        let before = arc.segment.checked_sub(1);
        let sides = [
            ("A+", before, before),
            ("C-", Some(arc.segment), Some(arc.segment + 1)),
        ];
        let Measured { joints, blends, .. } = &self.measured;
        let side = |(at, joint, blend): (&'static str, Option<usize>, Option<usize>)| {
            let joint = joints.iter().find(|j| Some(j.segment) == joint)?;
            let off = blends.iter().find(|b| Some(b.segment) == blend)?;
            let rest = self.prepared.segments.get(blend?)?.next_piece.is_none();
            Some(EndMeasured {
                at,
                rest,
                direction_jump_deg: Pair {
                    measured: joint.direction_jump_deg,
                    expected: report.direction_jump.to_degrees(),
                },
                acceleration_jump_mm_per_s2: Pair {
                    measured: joint.acceleration_jump_mm_per_s2,
                    expected: report.acceleration_jump,
                },
                off_arc_um: rest.then_some(Pair {
                    measured: off.off_path_um,
                    expected: report.blend_distance * 1e3,
                }),
                off_arc_estimate_um: rest.then_some(report.blend_distance_estimate * 1e3),
            })
        };
        sides.into_iter().filter_map(side).collect()
    }

    /// Measures the segment of a sample, and at its end begins the next.
    fn follow(&mut self, sample: u64, point: Point, way: f64, second: Option<Point>) {
        let (prepared, index) = (self.prepared, self.segment);
        let segment = &prepared.segments[index];
        let (step, most) = (sample - segment.first_sample, prepared.timing.blend_samples);
        match &mut self.course {
            _ if sample == 0 => self.course = Course::begin(prepared, self.settings, index, point),
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
            Course::Blend(blend) => self.measured.blends.push(blend.finish()),
            Course::Arc(arc) => self.measured.arcs.push(arc.finish(point)),
        }
        if index + 1 < prepared.segments.len() {
            self.course = Course::begin(prepared, self.settings, index + 1, point);
            self.leaving = Some(Leaving::new(index, segment, &self.recent, most));
        }
    }
}
