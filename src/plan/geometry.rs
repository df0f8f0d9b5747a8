//! Curve of one move, parametrised by length.

use super::{CENTRE_REACH_MM, FEED_RANGE, PlanError};
use crate::input::{Course, Drawing, Point, REACH_MM};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Curve of a move from its start, parametrised by a length in millimetres.
///
/// A line and a true arc or helix use their own length. An arc whose start and end radius differ
/// is a spiral with the radius linear in the angle. Its length is that of the outer radius, so
/// that the speed along the spiral is never above the nominal one, and only slightly below if the
/// radii are meant to be equal.
#[derive(Debug, Clone, Copy)]
pub(super) struct Curve {
    from: Point,
    to: Point,
    pub(super) length: f64,
    arc: Option<Arc>,
}

#[derive(Debug, Clone, Copy)]
struct Arc {
    centre: [f64; 2],
    start_angle: f64,
    sweep: f64,
    start_radius: f64,
    end_radius: f64,
}

impl Curve {
    /// Returns the curve of `drawing.moves[index]`.
    pub(super) fn of_move(drawing: &Drawing, index: usize) -> Self {
        let from = start_of(drawing, index);
        // A missing move has no length.
        let step = drawing.moves.get(index);
        let (to, course) = step.map_or((from, Course::Line), |step| (step.to, step.course));
        let rise = to[2] - from[2];
        match course {
            // `check` refuses splines.
            Course::Line | Course::Spline { .. } => Self {
                from,
                to,
                length: norm([to[0] - from[0], to[1] - from[1], rise]),
                arc: None,
            },
            Course::Arc { centre, clockwise } => {
                let arc = Arc::new(from, to, centre, clockwise);
                let around = arc.start_radius.max(arc.end_radius) * arc.sweep;
                Self {
                    from,
                    to,
                    length: norm([around, arc.end_radius - arc.start_radius, rise]),
                    arc: Some(arc),
                }
            }
        }
    }

    /// Returns the point `along` millimetres from the start; exact at both ends.
    pub(super) fn at(&self, along: f64) -> Point {
        if along >= self.length {
            return self.to;
        }
        if along <= 0.0 {
            return self.from;
        }
        let share = along / self.length;
        let blend = |k: usize| {
            // Computed from the nearer end, so that rounding vanishes at both.
            if share <= 0.5 {
                self.from[k] + (self.to[k] - self.from[k]) * share
            } else {
                self.to[k] - (self.to[k] - self.from[k]) * (1.0 - share)
            }
        };
        match &self.arc {
            None => [blend(0), blend(1), blend(2)],
            Some(arc) => {
                let (sin, cos) = (arc.start_angle + arc.sweep * share).sin_cos();
                let radius = arc.radius(share);
                [
                    arc.centre[0] + radius * cos,
                    arc.centre[1] + radius * sin,
                    blend(2),
                ]
            }
        }
    }

    /// Returns the derivative of the point by the length at the start and at the end: vectors of
    /// length 1 at most.
    pub(super) fn directions(&self) -> [Point; 2] {
        let per_length = |v: Point| v.map(|x| x / self.length);
        let rise = self.to[2] - self.from[2];
        match &self.arc {
            None => {
                let v = per_length([self.to[0] - self.from[0], self.to[1] - self.from[1], rise]);
                [v, v]
            }
            Some(arc) => [0.0, 1.0].map(|share| {
                let (sin, cos) = (arc.start_angle + arc.sweep * share).sin_cos();
                let (outward, around) = (
                    arc.end_radius - arc.start_radius,
                    arc.radius(share) * arc.sweep,
                );
                per_length([
                    outward * cos - around * sin,
                    outward * sin + around * cos,
                    rise,
                ])
            }),
        }
    }

    /// Returns the greatest speed at which the centripetal acceleration stays within
    /// `acceleration`: √(a·R), and more on a helix, since only a part of its speed is around the
    /// axis.
    pub(super) fn fastest(&self, acceleration: f64) -> f64 {
        self.arc.as_ref().map_or(f64::INFINITY, |arc| {
            let around = arc.start_radius.max(arc.end_radius) * arc.sweep.abs();
            let radius = arc.start_radius.min(arc.end_radius);
            (acceleration * radius).sqrt() * (self.length / around)
        })
    }

    /// Returns the least number of equal pieces whose chords are within `tolerance` of the curve.
    /// A chord over the angle φ of a circle deviates by at most 2·R·sin²(φ/4); a change Δ of the
    /// radius over that angle adds Δ·φ/4.
    pub(super) fn chords(&self, tolerance: f64) -> u64 {
        self.arc.as_ref().map_or(1, |arc| {
            let radius = arc.start_radius.max(arc.end_radius);
            let angle = 4.0 * (tolerance / (2.0 * radius)).sqrt().min(1.0).asin();
            // At least three pieces per circle, whose chords still enclose the centre.
            let angle = angle.min(std::f64::consts::TAU / 3.0);
            let sweep = arc.sweep.abs();
            let change = (arc.end_radius - arc.start_radius).abs();
            let spiral = (sweep * change / (4.0 * tolerance)).sqrt();
            ((sweep / angle).hypot(spiral).ceil() as u64).max(1)
        })
    }

    /// Returns the number of equal pieces, at `per_turn` per turn; one for a line.
    pub(super) fn pieces(&self, per_turn: u32) -> u64 {
        self.arc.as_ref().map_or(1, |arc| {
            ((arc.sweep.abs() / TAU * f64::from(per_turn)).ceil() as u64).max(1)
        })
    }

    /// Returns the lengths along an arc at which its angle is a multiple of a right angle: X or Y
    /// reverses there. On a spiral with a small change of the radius they are near that.
    pub(super) fn quarters(&self) -> impl Iterator<Item = f64> + '_ {
        let length = self.length;
        self.arc.iter().flat_map(move |arc| {
            let [first, last] = [arc.start_angle, arc.start_angle + arc.sweep];
            let (least, most) = (first.min(last) / FRAC_PI_2, first.max(last) / FRAC_PI_2);
            // A turn has four; a single move has only a few turns.
            let quarters = (least.ceil() as i64)..=(most.floor() as i64);
            quarters.map(move |quarter| {
                let share = (quarter as f64 * FRAC_PI_2 - first) / arc.sweep;
                length * share.clamp(0.0, 1.0)
            })
        })
    }

    pub(super) fn is_arc(&self) -> bool {
        self.arc.is_some()
    }
}

impl Arc {
    fn new(from: Point, to: Point, centre: [f64; 2], clockwise: bool) -> Self {
        let start = [from[0] - centre[0], from[1] - centre[1]];
        let end = [to[0] - centre[0], to[1] - centre[1]];
        let cross = start[0] * end[1] - start[1] * end[0];
        let dot = start[0] * end[0] + start[1] * end[1];
        let turn = if clockwise { -TAU } else { TAU };
        // From the vectors rather than from two angles: a short arc at a large angle keeps its
        // digits.
        let between = cross.atan2(dot);
        let sweep = if start == end || between == 0.0 {
            turn
        } else if (between < 0.0) == clockwise {
            between
        } else {
            between + turn
        };
        Self {
            centre,
            start_angle: start[1].atan2(start[0]),
            sweep,
            start_radius: start[0].hypot(start[1]),
            end_radius: end[0].hypot(end[1]),
        }
    }

    fn radius(&self, share: f64) -> f64 {
        self.start_radius + (self.end_radius - self.start_radius) * share
    }
}

/// Returns the start of `drawing.moves[index]`.
pub(super) fn start_of(drawing: &Drawing, index: usize) -> Point {
    let before = index.checked_sub(1);
    let end = before.and_then(|before| drawing.moves.end(before));
    end.unwrap_or(drawing.start)
}

pub(crate) fn norm(v: Point) -> f64 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}

/// Checks everything in the drawing that the planner uses.
pub(crate) fn check(drawing: &Drawing) -> Result<(), PlanError> {
    check_point(0, drawing.start)?;
    for (index, step) in drawing.moves.iter().enumerate() {
        let line = step.line;
        check_point(line, step.to)?;
        if let Some(value) = step.feed_mm_per_min.filter(|f| !FEED_RANGE.contains(f)) {
            return Err(PlanError::Feed { line, value });
        }
        if let Course::Spline { .. } = step.course {
            return Err(PlanError::Spline { line });
        }
        if let Course::Arc { centre, .. } = step.course {
            for (coordinate, value) in ["centre X", "centre Y"].into_iter().zip(centre) {
                check_coordinate(line, coordinate, value, CENTRE_REACH_MM)?;
            }
            let radius_mm = [start_of(drawing, index), step.to]
                .map(|p| (p[0] - centre[0]).hypot(p[1] - centre[1]))
                .into_iter()
                .fold(f64::INFINITY, f64::min);
            if radius_mm <= 0.0 {
                return Err(PlanError::Radius { line, radius_mm });
            }
        }
    }
    Ok(())
}

fn check_point(line: usize, point: Point) -> Result<(), PlanError> {
    ["X", "Y", "Z"]
        .into_iter()
        .zip(point)
        .try_for_each(|(coordinate, value)| check_coordinate(line, coordinate, value, REACH_MM))
}

fn check_coordinate(
    line: usize,
    coordinate: &'static str,
    value: f64,
    reach: f64,
) -> Result<(), PlanError> {
    // Written so that NaN fails.
    if value.abs() <= reach {
        return Ok(());
    }
    Err(PlanError::Coordinate {
        line,
        coordinate,
        value,
        reach,
    })
}
