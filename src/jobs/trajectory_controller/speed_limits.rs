//! How fast the path may be run where, and the lowest limit between two lengths at once.

use super::axis_limits;
use super::segments::Path;
use super::settings::Motion;
use crate::path::vector::distance;
use crate::plan::junction;

/// A segment for the planner. Units of length and time are the caller's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// Its length, 1 or more.
    pub length: u64,
    /// The highest speed on it, above 0.
    pub speed: f64,
    /// The highest speed where it begins; 0 for a stop.
    pub entry: f64,
}

/// The spans of a path, in guard units and seconds: feed or rapid, √(a·r) in curves, with the
/// acceleration that the path and its axes allow, and where two meet, the speed at which the velocity
/// changes by the corner speed.
#[must_use]
pub fn spans(path: &Path, motion: &Motion) -> Vec<Span> {
    let unit = motion.units_per_mm;
    let mut before = None;
    let spans = path.stretches.iter().map(|stretch| {
        let along = motion.slope.acceleration / unit;
        let around = stretch.radius.map(|radius| {
            let across = axis_limits::across(&stretch.segment, &motion.axis_acceleration, along);
            (motion.normal_acceleration.min(across) * radius).sqrt()
        });
        let [first, last] = stretch.directions;
        let along = stretch.segment.fourth.map_or(0.0, |fourth| fourth.along);
        let entry = before.map_or(0.0, |(before, beside)| {
            let turn = distance(before, first).hypot(along - beside);
            junction(turn, motion.corner_speed)
        });
        before = Some((last, along));
        Span {
            length: stretch.length,
            speed: unit * stretch.speed.min(around.unwrap_or(f64::INFINITY)),
            entry: unit * entry,
        }
    });
    spans.collect()
}

/// Limits by the length along the path.
#[derive(Debug)]
pub(super) struct SpeedLimits {
    /// Where the spans begin, and where the last one ends.
    pub(super) joints: Vec<f64>,
    /// Limit at each joint: never above those of the spans at it, 0 at both ends.
    pub(super) at_joint: Vec<f64>,
    /// Limit on each span.
    pub(super) on_span: Vec<f64>,
    /// Row k: the joint with the lowest limit of 2^k from each.
    lowest: Vec<Vec<u32>>,
}

impl SpeedLimits {
    pub(super) fn new(spans: &[Span]) -> Self {
        let mut at = 0;
        let mut joints = vec![0.0];
        joints.extend(spans.iter().map(|span| {
            at += span.length;
            at as f64
        }));
        let mut at_joint = vec![0.0; joints.len()];
        for (joint, pair) in spans.windows(2).enumerate() {
            let speed = pair[0].speed.min(pair[1].speed);
            at_joint[joint + 1] = speed.min(coarse(pair[1].entry));
        }
        let lower = |one: u32, other: u32| match at_joint[other as usize] < at_joint[one as usize] {
            true => other,
            false => one,
        };
        let mut lowest: Vec<Vec<u32>> = vec![(0..joints.len() as u32).collect()];
        let mut width = 1;
        while 2 * width <= joints.len() {
            let row = &lowest[lowest.len() - 1];
            let row = (0..=joints.len() - 2 * width).map(|k| lower(row[k], row[k + width]));
            lowest.push(row.collect());
            width *= 2;
        }
        SpeedLimits {
            joints,
            at_joint,
            on_span: spans.iter().map(|span| span.speed).collect(),
            lowest,
        }
    }

    /// The first joint at or behind a length.
    pub(super) fn joint_from(&self, length: f64) -> usize {
        self.joints.partition_point(|&joint| joint < length)
    }

    /// The first joint behind a length.
    pub(super) fn joint_behind(&self, length: f64) -> usize {
        self.joints.partition_point(|&joint| joint <= length)
    }

    /// The first of the joints `from` to before `to` with the lowest limit.
    pub(super) fn lowest(&self, from: usize, to: usize) -> Option<usize> {
        let row = (to.checked_sub(from)?).checked_ilog2()?;
        let row = (&self.lowest[row as usize], to - (1 << row));
        let (one, other) = (row.0[from] as usize, row.0[row.1] as usize);
        match self.at_joint[other] < self.at_joint[one] {
            true => Some(other),
            false => Some(one),
        }
    }
}

/// A speed without its last digits, so that those of equal turns are equal: less by no more than a
/// millionth.
fn coarse(speed: f64) -> f64 {
    f64::from_bits(speed.to_bits() >> 32 << 32)
}
