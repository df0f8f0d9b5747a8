//! Speed limits along the path, with fast queries of the least limit between two lengths.

use super::axis_limits;
use super::segments::{Path, Stretch};
use super::settings::Motion;
use crate::path::vector::distance;
use crate::plan::junction;

/// Greatest difference of unit directions for which two lines count as chords of a curve: 10°.
const CHORD_TURN: f64 = 0.1743;

/// Segment for the planner. Units of length and time are the caller's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// Length, at least 1.
    pub length: u64,
    /// Greatest speed on it, above 0.
    pub speed: f64,
    /// Greatest speed at its start; 0 for a stop.
    pub entry: f64,
}

/// Returns the spans of a path, in guard units and seconds. Limits are feed or rapid, √(a·r) in
/// curves, with the acceleration that the path, its axes and the contour tolerance allow, and at
/// joints the speed at which the velocity changes by the corner speed.
#[must_use]
pub fn spans(path: &Path, motion: &Motion) -> Vec<Span> {
    let unit = motion.units_per_mm;
    let stretches = &path.stretches;
    let spans = stretches.iter().enumerate().map(|(index, stretch)| {
        let along = motion.slope.acceleration / unit;
        let around = stretch.radius.map(|radius| {
            let across = axis_limits::across(&stretch.segment, &motion.axis_acceleration, along);
            let across = across.min(motion.contour_acceleration);
            (motion.normal_acceleration.min(across) * radius).sqrt()
        });
        let entry = match index {
            0 => 0.0,
            _ => junction(turn(&stretches[index - 1], stretch), motion.corner_speed),
        };
        let near = &stretches[index.saturating_sub(1)..stretches.len().min(index + 2)];
        let chords = near.windows(2).map(|pair| {
            let radius = chord_radius(&pair[0], &pair[1]) / unit;
            (motion.contour_acceleration * radius).sqrt()
        });
        let limits = chords.chain(around);
        Span {
            length: stretch.length,
            speed: unit * limits.fold(stretch.speed, f64::min),
            entry: unit * entry,
        }
    });
    spans.collect()
}

/// Returns the difference of two segments' directions at their joint: an angle if it is small.
fn turn(before: &Stretch, next: &Stretch) -> f64 {
    let [beside, along] =
        [before, next].map(|of| of.segment.fourth.map_or(0.0, |fourth| fourth.along));
    distance(before.directions[1], next.directions[0]).hypot(along - beside)
}

/// Returns the radius of the curve of which two lines are chords, in guard units; infinite if they
/// are not.
fn chord_radius(before: &Stretch, next: &Stretch) -> f64 {
    let (turn, mean) = (
        turn(before, next),
        (before.length + next.length) as f64 / 2.0,
    );
    let is_line = |of: &Stretch| of.segment.arc.is_none() && of.segment.powers.is_none();
    match is_line(before) && is_line(next) && turn <= CHORD_TURN {
        true => mean / turn,
        false => f64::INFINITY,
    }
}

/// Limits by the length along the path.
#[derive(Debug)]
pub(super) struct SpeedLimits {
    /// Starts of the spans, and the end of the last one.
    pub(super) joints: Vec<f64>,
    /// Limit at each joint: never above those of the adjacent spans, 0 at both ends.
    pub(super) at_joint: Vec<f64>,
    /// Limit on each span.
    pub(super) on_span: Vec<f64>,
    /// Row k: the joint with the least limit among 2^k from each.
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

    /// Returns the first joint at or after a length.
    pub(super) fn joint_from(&self, length: f64) -> usize {
        self.joints.partition_point(|&joint| joint < length)
    }

    /// Returns the first joint after a length.
    pub(super) fn joint_behind(&self, length: f64) -> usize {
        self.joints.partition_point(|&joint| joint <= length)
    }

    /// Returns the joint with the least limit from `from` to before `to`; the first of several.
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

/// Clears the last digits of a speed, so that those of equal turns are equal: at most a millionth
/// less.
fn coarse(speed: f64) -> f64 {
    f64::from_bits(speed.to_bits() >> 32 << 32)
}
