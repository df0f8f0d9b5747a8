//! Conversion of pieces to segments: every piece gets a speed for which a whole number of samples
//! is between its blends.

use super::prepared::{ArcReport, PieceReport, Prepared, Segment, Shape};
use super::settings::ShortPieces;
use crate::input::Point;
use crate::path::circle::{Circle, CircleError};
use crate::path::error::{PathError, Reason};
use crate::path::pieces::Piece;
use crate::path::vector::{add, angle_between, scale, sub, unit};

/// Relative excess over the greatest speed that still counts as that speed: rounding of numbers
/// that were printed and read again.
const ROUNDING: f64 = 1e-9;

/// Times of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timing {
    /// Sampling time Ts in seconds.
    pub sample_s: f64,
    /// Samples of a blend M = 2ta/Ts; even.
    pub blend_samples: u64,
    /// Greatest angle between two pieces that are joined without a stop, in radians.
    pub corner: f64,
    /// Handling of a piece that is too short or too tight for its speed.
    pub short_pieces: ShortPieces,
    /// Greatest number of samples of a segment.
    pub most_samples: u64,
}

impl Timing {
    /// Returns ta in seconds.
    #[must_use]
    pub fn half_blend_s(&self) -> f64 {
        self.sample_s * self.blend_samples as f64 / 2.0
    }
}

/// Makes the segments of a path that begins at rest at `start` and ends at rest.
///
/// A line of length L has the speed v = L/(Ts(N + M)) with the least N that keeps it within the
/// requested speed; on an arc θ − 2φ = N·v·Ts/R with sin(φ/2) = v·ta/2R. Two pieces that meet at
/// an angle within the corner limit are joined by one blend, others by a stop.
///
/// # Errors
/// Returns an error for a piece without length, speed or number; one whose blends overlap or
/// extend too far around the arc at the requested speed; one with too many samples; an arc that
/// does not meet the path.
pub fn prepare(start: Point, pieces: &[Piece], timing: &Timing) -> Result<Prepared, PathError> {
    let mut from = start;
    let mut legs = Vec::with_capacity(pieces.len());
    for (index, piece) in pieces.iter().enumerate() {
        let refuse = |reason| PathError {
            piece: index,
            line: piece.line,
            reason,
        };
        legs.push(leg(from, piece, timing).map_err(refuse)?);
        from = piece.to;
    }
    if legs.is_empty() {
        return Err(PathError {
            piece: 0,
            line: None,
            reason: Reason::Empty,
        });
    }
    Ok(Prepared {
        segments: join(&legs, timing),
        pieces: legs,
        timing: *timing,
    })
}

/// Returns the segments of all pieces, each between two blends.
fn join(legs: &[PieceReport], timing: &Timing) -> Vec<Segment> {
    let mut segments = Vec::with_capacity(2 * legs.len() + 1);
    let mut at = 0;
    let mut push = |shape, samples, piece, next_piece, ends_at_rest| {
        segments.push(Segment {
            shape,
            samples,
            first_sample: at,
            piece,
            next_piece,
            ends_at_rest,
        });
        at += samples;
    };
    let blend = timing.blend_samples;
    let mut at_rest = true;
    for (index, leg) in legs.iter().enumerate() {
        let [entry, exit] = leg.between_blends();
        if at_rest {
            let shape = Shape::Blend {
                before: leg.from,
                corner: leg.from,
                behind: entry,
            };
            push(shape, blend, index, None, false);
        }
        let shape = match leg.arc {
            None => Shape::Line {
                from: entry,
                to: exit,
            },
            Some(arc) => Shape::Arc {
                circle: arc.circle,
                from: arc.blend_angle,
                step: arc.step,
            },
        };
        push(shape, leg.samples, index, None, false);
        let next = legs.get(index + 1).filter(|next| {
            let turn = angle_between(leg.directions()[1], next.directions()[0]);
            turn <= timing.corner
        });
        at_rest = next.is_none();
        let shape = Shape::Blend {
            before: exit,
            corner: leg.to,
            behind: next.map_or(leg.to, |next| next.between_blends()[0]),
        };
        push(shape, blend, index, next.map(|_| index + 1), at_rest);
    }
    segments
}

/// Returns speed and samples of a piece.
fn leg(from: Point, piece: &Piece, timing: &Timing) -> Result<PieceReport, Reason> {
    piece.check(from)?;
    let arc = piece.course.arc()?;
    let length = piece.course.length(from, piece.to);
    if length <= 0.0 {
        let points = ["start", "end"];
        return Err(CircleError::Coincident { points }.into());
    }
    let (sample, half_blend) = (timing.sample_s, timing.half_blend_s());
    let speed = fitting(piece.speed, arc, length, timing)?;
    // Samples between the blends at that speed, with a tolerance for rounding above a whole
    // number.
    let samples = match arc {
        None => length / (speed * sample) - timing.blend_samples as f64,
        Some(circle) => {
            let between = circle.angle - 2.0 * blend_angle(circle, speed * half_blend);
            between * circle.radius / (speed * sample)
        }
    };
    let samples = (samples * (1.0 - ROUNDING)).ceil().max(1.0);
    if samples > timing.most_samples as f64 {
        return Err(Reason::Samples {
            speed,
            samples,
            most: timing.most_samples,
        });
    }
    let speed = match arc {
        None => length / (sample * (samples + timing.blend_samples as f64)),
        Some(circle) => arc_speed(circle, samples, timing),
    };
    let reach = speed * half_blend;
    let arc = arc.map(|circle| arc_report(circle, speed, reach, samples));
    Ok(PieceReport {
        line: piece.line,
        course: piece.course,
        from,
        to: piece.to,
        length,
        wanted: piece.speed,
        speed,
        samples: samples as u64,
        reach,
        arc,
    })
}

/// Returns the requested speed, or the greatest that fits.
fn fitting(speed: f64, arc: Option<&Circle>, length: f64, timing: &Timing) -> Result<f64, Reason> {
    let half_blend = timing.half_blend_s();
    // With one sample between the blends.
    let (mut most, mut radius) = match arc {
        None => {
            let samples = timing.blend_samples as f64 + 1.0;
            (length / (timing.sample_s * samples), f64::INFINITY)
        }
        Some(circle) => (arc_speed(circle, 1.0, timing), circle.radius),
    };
    let room = match arc {
        None => length - 2.0 * speed * half_blend,
        Some(circle) => circle.angle - 2.0 * blend_angle(circle, speed * half_blend),
    };
    let tight = speed * half_blend > radius * (1.0 + ROUNDING);
    if !tight && (room > 0.0 || speed <= most * (1.0 + ROUNDING)) {
        return Ok(speed);
    }
    most = most.min(radius / half_blend);
    if timing.short_pieces == ShortPieces::Slower {
        return Ok(most);
    }
    radius = radius.min(f64::MAX);
    Err(match tight {
        true => Reason::Tight {
            speed,
            chord: speed * half_blend,
            radius,
            most,
        },
        false => Reason::Overlap {
            speed,
            length,
            most,
        },
    })
}

/// Returns φ, the angle of a chord.
fn blend_angle(circle: &Circle, chord: f64) -> f64 {
    2.0 * (chord / (2.0 * circle.radius)).min(1.0).asin()
}

/// Returns the speed for which `samples` are between the blends of an arc. The remaining angle
/// decreases with the speed, so there is exactly one.
fn arc_speed(circle: &Circle, samples: f64, timing: &Timing) -> f64 {
    let Circle { radius, angle, .. } = *circle;
    let left = |speed: f64| {
        let blends = 2.0 * blend_angle(circle, speed * timing.half_blend_s());
        angle - blends - samples * speed * timing.sample_s / radius
    };
    let [mut slow, mut fast] = [0.0, angle * radius / (samples * timing.sample_s)];
    loop {
        let speed = f64::midpoint(slow, fast);
        let between = slow < speed && speed < fast;
        if !between {
            return slow;
        }
        match left(speed) >= 0.0 {
            true => slow = speed,
            false => fast = speed,
        }
    }
}

fn arc_report(circle: &Circle, speed: f64, reach: f64, samples: f64) -> ArcReport {
    let blend_angle = blend_angle(circle, reach);
    let sagitta = (blend_angle / 4.0).sin();
    ArcReport {
        circle: *circle,
        blend_angle,
        step: (circle.angle - 2.0 * blend_angle) / samples,
        direction_jump: blend_angle / 2.0,
        acceleration_jump: speed * speed / circle.radius,
        // Computes 1 − cos without cancellation.
        blend_distance: 2.0 * circle.radius * sagitta * sagitta,
        blend_distance_estimate: reach * reach / (8.0 * circle.radius),
    }
}

impl PieceReport {
    /// Returns A⁺ and C⁻, the end of its first blend and the start of its last.
    #[must_use]
    pub fn between_blends(&self) -> [Point; 2] {
        match &self.arc {
            None => {
                let part = scale(unit(sub(self.to, self.from)), self.reach);
                [add(self.from, part), sub(self.to, part)]
            }
            Some(arc) => [arc.blend_angle, arc.circle.angle - arc.blend_angle]
                .map(|angle| arc.circle.point(angle)),
        }
    }

    /// Returns the directions of motion at start and end.
    #[must_use]
    pub fn directions(&self) -> [Point; 2] {
        self.course.directions(self.from, self.to)
    }
}
