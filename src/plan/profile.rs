//! Look-ahead: speed at every junction, and speed profile of every move.

use super::geometry::{self, Curve, norm};
use super::sampler::Sampler;
use super::{MotionLimits, PlanError};
use crate::input::{Drawing, Move, Point};

/// Greatest difference of directions, in radians, that counts as tangential: a tangent computed
/// from rounded coordinates must not stop a machine whose corner speed is 0.
const TANGENT: f64 = 1e-6;

/// Move that has a length, with its speeds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Index into the drawing's moves.
    pub index: usize,
    /// Start time in seconds.
    pub start_s: f64,
    /// Length of the path before it, in millimetres.
    pub start_mm: f64,
    /// Own length in millimetres.
    pub length_mm: f64,
    /// Speed at the start, in mm/s.
    pub entry: f64,
    /// Greatest speed, in mm/s.
    pub peak: f64,
    /// Speed at the end, in mm/s.
    pub exit: f64,
}

/// Stored part of a segment: its length is that of the move, its exit speed the entry speed of the
/// next segment.
#[derive(Debug, Clone, Copy)]
struct Packed {
    index: usize,
    start_s: f64,
    start_mm: f64,
    entry: f64,
    peak: f64,
}

/// Speed profile of a segment: lengths and times of its three phases.
#[derive(Debug, Clone, Copy)]
pub(super) struct Phases {
    pub(super) rising_mm: f64,
    pub(super) rising_s: f64,
    pub(super) steady_s: f64,
    pub(super) falling_mm: f64,
    pub(super) falling_s: f64,
}

impl Segment {
    pub(super) fn phases(&self, acceleration: f64) -> Phases {
        // Limited to the length: the speeds are square roots and may be off by rounding.
        let ramp = |end: f64, room: f64| {
            ((self.peak - end) * (self.peak + end) / (2.0 * acceleration)).clamp(0.0, room)
        };
        let rising_mm = ramp(self.entry, self.length_mm);
        let falling_mm = ramp(self.exit, self.length_mm - rising_mm);
        let time = |mm: f64, speeds: f64| if mm > 0.0 { 2.0 * mm / speeds } else { 0.0 };
        Phases {
            rising_mm,
            rising_s: time(rising_mm, self.entry + self.peak),
            steady_s: time(self.length_mm - rising_mm - falling_mm, 2.0 * self.peak),
            falling_mm,
            falling_s: time(falling_mm, self.exit + self.peak),
        }
    }
}

/// Drawing with its timing.
#[derive(Debug, Clone)]
pub struct Plan<'d> {
    pub(super) drawing: &'d Drawing,
    pub(super) acceleration: f64,
    segments: Vec<Packed>,
    duration_s: f64,
    length_mm: f64,
}

impl<'d> Plan<'d> {
    /// Plans the drawing. Moves without length take no time and have no segment.
    ///
    /// # Errors
    ///
    /// Returns a [`PlanError`] if a limit or the drawing contains a value that cannot be planned.
    pub fn new(drawing: &'d Drawing, limits: &MotionLimits) -> Result<Self, PlanError> {
        limits.ranges()?;
        geometry::check(drawing)?;
        let acceleration = limits.acceleration_mm_per_s2;
        let (mut segments, lengths) = limit_speeds(drawing, limits);
        look_ahead(&mut segments, &lengths, acceleration);
        let (mut duration, mut length) = (Sum::default(), Sum::default());
        for (number, length_mm) in lengths.into_iter().enumerate() {
            segments[number].start_s = duration.value();
            segments[number].start_mm = length.value();
            let phases = unpacked(&segments, number, length_mm).phases(acceleration);
            duration.add(phases.rising_s + phases.steady_s + phases.falling_s);
            length.add(length_mm);
        }
        Ok(Self {
            drawing,
            acceleration,
            segments,
            duration_s: duration.value(),
            length_mm: length.value(),
        })
    }

    /// Returns the number of moves that have a length.
    pub(super) fn count(&self) -> usize {
        self.segments.len()
    }

    pub(super) fn segment(&self, number: usize) -> (Segment, Curve) {
        let curve = Curve::of_move(self.drawing, self.segments[number].index);
        (unpacked(&self.segments, number, curve.length), curve)
    }

    /// Returns the last segment that has begun at a time; the first one before its start.
    pub(super) fn under_way(&self, time_s: f64) -> usize {
        let begun = self.segments.partition_point(|s| s.start_s <= time_s);
        begun.saturating_sub(1)
    }

    /// Returns the time from start to end, in seconds.
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        self.duration_s
    }

    /// Returns the length of the path in millimetres.
    #[must_use]
    pub fn length_mm(&self) -> f64 {
        self.length_mm
    }

    /// Returns the moves that have a length, in order.
    #[must_use]
    pub fn segments(&self) -> impl ExactSizeIterator<Item = Segment> {
        (0..self.count()).map(|number| self.segment(number).0)
    }

    /// Returns the start of the path.
    #[must_use]
    pub fn start(&self) -> Point {
        self.drawing.start
    }

    /// Returns the end of the path.
    #[must_use]
    pub fn end(&self) -> Point {
        self.drawing
            .moves
            .last()
            .map_or(self.drawing.start, |m| m.to)
    }

    /// Returns a sampler of the position over time.
    #[must_use]
    pub fn sampler(&self) -> Sampler<'_, 'd> {
        Sampler::new(self)
    }

    /// Returns the end time of a segment, in seconds.
    pub(super) fn end_s(&self, segment: usize) -> f64 {
        self.segments
            .get(segment + 1)
            .map_or(self.duration_s, |next| next.start_s)
    }
}

fn unpacked(segments: &[Packed], number: usize, length_mm: f64) -> Segment {
    let Packed {
        index,
        start_s,
        start_mm,
        entry,
        peak,
    } = segments[number];
    Segment {
        index,
        start_s,
        start_mm,
        length_mm,
        entry,
        peak,
        exit: segments.get(number + 1).map_or(0.0, |next| next.entry),
    }
}

/// Returns the segments with the greatest speed that each allows by itself as peak, and the
/// greatest speed that each junction allows by itself as entry; also their lengths in mm.
fn limit_speeds(drawing: &Drawing, limits: &MotionLimits) -> (Vec<Packed>, Vec<f64>) {
    let corner = limits.corner_mm_per_min / 60.0;
    let count = drawing.moves.len();
    let (mut segments, mut lengths) = (Vec::with_capacity(count), Vec::with_capacity(count));
    let mut before: Option<(f64, Point)> = None;
    for (index, step) in drawing.moves.iter().enumerate() {
        let curve = Curve::of_move(drawing, index);
        if curve.length <= 0.0 {
            continue;
        }
        let peak = nominal_speed(&step, limits).min(curve.fastest(limits.acceleration_mm_per_s2));
        let [first, last] = curve.directions();
        let entry = before.map_or(0.0, |(peak_before, direction)| {
            let turn = norm(std::array::from_fn(|k| direction[k] - first[k]));
            junction(turn, corner).min(peak).min(peak_before)
        });
        before = Some((peak, last));
        segments.push(Packed {
            index,
            start_s: 0.0,
            start_mm: 0.0,
            entry,
            peak,
        });
        lengths.push(curve.length);
    }
    (segments, lengths)
}

/// Returns the speed at which the velocity changes by `corner` at a junction; `turn` is the
/// difference of its unit directions.
pub(crate) fn junction(turn: f64, corner: f64) -> f64 {
    match turn <= TANGENT {
        true => f64::INFINITY,
        false => corner / turn,
    }
}

/// Returns feed or rapid rate of a move, in mm/s.
fn nominal_speed(step: &Move, limits: &MotionLimits) -> f64 {
    let per_minute = if step.rapid {
        limits.rapid_mm_per_min
    } else {
        step.feed_mm_per_min.unwrap_or(limits.feed_mm_per_min)
    };
    per_minute / 60.0
}

/// Lowers the junction speeds until each can be reached from the one before and braked to the
/// next, then the peaks to the speeds that the lengths allow.
fn look_ahead(segments: &mut [Packed], lengths: &[f64], acceleration: f64) {
    let gain = |length_mm: f64| 2.0 * acceleration * length_mm;
    let mut exit = 0f64;
    for (segment, &length_mm) in segments.iter_mut().zip(lengths).rev() {
        segment.entry = segment.entry.min((exit * exit + gain(length_mm)).sqrt());
        exit = segment.entry;
    }
    let mut entry = 0f64;
    for (number, &length_mm) in lengths.iter().enumerate() {
        let reached = (entry * entry + gain(length_mm)).sqrt();
        let exit = segments.get(number + 1).map_or(0.0, |next| next.entry);
        let exit = exit.min(reached);
        let reachable = ((entry * entry + exit * exit + gain(length_mm)) / 2.0).sqrt();
        let segment = &mut segments[number];
        segment.entry = entry;
        segment.peak = segment.peak.min(reachable).max(entry).max(exit);
        entry = exit;
    }
}

/// Compensated sum (Neumaier): many tiny times after a huge one are not lost.
#[derive(Default)]
struct Sum {
    sum: f64,
    lost: f64,
}

impl Sum {
    fn add(&mut self, x: f64) {
        let sum = self.sum + x;
        self.lost += if self.sum.abs() >= x.abs() {
            (self.sum - sum) + x
        } else {
            (x - sum) + self.sum
        };
        self.sum = sum;
    }

    fn value(&self) -> f64 {
        self.sum + self.lost
    }
}
