//! Segments of a path: the contents of the segment store and the search.
//!
//! | word | line | arc | spline |
//! |---|---|---|---|
//! | 0 | 0 | bit 0 set, bits 6..1 H − n | bit 7 set, bits 6..1 n |
//! | 1 | 0 | 2^(M + n − 4) / turn, of M bits | 0 |
//! | 2 | 0 | radius / gain of CORDIC, with R − P bits below the guard unit | 0 |
//! | 3, 4, 5 | start | centre | start |
//! | 6, 7, 8 | way / length | direction to the start | direction at the start |
//! | 9, 10, 11 | 0 | direction a quarter turn on | coefficient of the length's square, times 2^n |
//! | 12 | 0 | as word 2, the radius widened for constant speed | 0 |
//! | 13, 14, 15 | not read | not read | coefficient of its cube, times 2^2n |
//!
//! A fourth axis has four more words, base and coefficients like those of x: 16 and, for a line,
//! 17, for an arc 19, which then has bit 7 of word 0 set like a helix. A spline's length has n
//! bits. A helix has the words of an arc with bit 7 of word 0 set, and in words 13 to 15 its rise
//! over its length. Lengths are whole guard units of 2^-G count. A piece's own length is rounded,
//! and the rounding is spread over the piece: a line's coefficients are its way divided by the
//! rounded length, an arc's angle at the rounded length is the arc's own. So each ends where the
//! piece ends. The speed error is as small: half a guard unit in the length of the piece.

use super::extent::{fits, hold, margin};
use super::fourth::beside;
pub use super::fourth::{Fourth, FourthAxis};
use super::speed_limits::Span;
use super::splines;
use crate::circuits::blocks::cordic_state::GAIN;
use crate::circuits::trajectory_controller::Widths;
use crate::circuits::trajectory_controller::path_point::AXES;
use crate::circuits::trajectory_controller::vector_correction::Correction;
use crate::circuits::trajectory_controller::widths::SEGMENT_WORDS;
use crate::input::{COORDINATES, Point};
use crate::path::circle::Circle;
use crate::path::error::{PathError, Reason};
use crate::path::helix::Helix;
use crate::path::pieces::{Course, Piece};
use crate::path::vector::{self, add, cross, dot, scale, sub};
use std::f64::consts::TAU;

/// Coefficients that convert a length within a segment to a point, in guard units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Start of a line; centre of an arc.
    pub base: [i64; COORDINATES],
    /// Way of a line per guard unit of its length; for an arc the direction from the centre to its
    /// start.
    pub along: Point,
    /// Direction of an arc's motion at its start; for a spline the coefficient of the length's
    /// square over 2^n.
    pub across: Point,
    /// Rise of a helix per guard unit of its length; for a spline the coefficient of the length's
    /// cube over 2^2n.
    pub third: Point,
    /// Additional values of an arc or a helix.
    pub arc: Option<Arc>,
    /// Exponent n of a spline: its length is below 2^n, and not below 2^(n − 1).
    pub powers: Option<u32>,
    /// Fourth axis.
    pub fourth: Option<Fourth>,
}

/// Arc in guard units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arc {
    /// Radius r.
    pub radius: f64,
    /// Length of a whole turn: 2πr, except for rounding of the length.
    pub turn: f64,
    /// Radius of the command whose response has radius r at constant speed (¶0004); r before
    /// [`Path::widen`].
    pub widened: f64,
}

impl Segment {
    /// Creates a line from its start and its way per guard unit of its length.
    pub(super) fn line(base: Point, along: Point) -> Self {
        Segment {
            base: base.map(|units| units as i64),
            along,
            across: [0.0; COORDINATES],
            third: [0.0; COORDINATES],
            arc: None,
            powers: None,
            fourth: None,
        }
    }

    /// Returns its words, each below 2^D. A turn must be at least 1.
    #[must_use]
    pub fn words(&self, widths: &Widths) -> [u64; SEGMENT_WORDS] {
        let word = |value: i64| value as u64 & ((1 << widths.data) - 1);
        let mut words = [0; SEGMENT_WORDS];
        if let Some(arc) = self.arc {
            // 2^(n − 4) < turn <= 2^(n − 3): the mantissa has its leading bit set.
            let n = (arc.turn.log2().ceil() as usize + 3).min(widths.angle);
            let mantissa = two_to(widths.curvature + n - 4) / arc.turn;
            words[0] = 1 | ((widths.angle - n) as u64) << 1;
            words[1] = (mantissa.round() as u64).min((1 << widths.curvature) - 1);
            let inside = two_to(widths.radius - widths.point);
            let radius = |radius: f64| (radius / GAIN * inside).round() as u64;
            words[2] = radius(arc.radius);
            words[12] = radius(arc.widened);
        }
        let spatial = self.third != [0.0; COORDINATES] || self.fourth.is_some();
        words[0] |= u64::from(spatial && self.arc.is_some()) << 7;
        if let Some(bits) = self.powers {
            words[0] = 1 << 7 | u64::from(bits) << 1;
        }
        let unit = two_to(widths.coefficient - 2);
        for axis in 0..COORDINATES {
            words[3 + axis] = word(self.base[axis]);
            words[6 + axis] = word((self.along[axis] * unit).round() as i64);
            words[9 + axis] = word((self.across[axis] * unit).round() as i64);
            words[13 + axis] = word((self.third[axis] * unit).round() as i64);
        }
        words
    }

    /// Returns the point at a length after its start, including W, unrounded.
    pub(super) fn place(&self, offset: f64) -> [f64; AXES] {
        let [x, y, z] = self.point(offset);
        [x, y, z, self.fourth_point(offset)]
    }

    /// Returns the name of its kind.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match (self.arc, self.powers) {
            (Some(_), _) if self.third != [0.0; COORDINATES] => "helix",
            (Some(_), _) => "arc",
            (None, Some(_)) => "spline",
            (None, None) => "line",
        }
    }

    /// True if both are arcs of one circle in the same direction.
    #[must_use]
    pub(super) fn same_circle(&self, other: &Segment) -> bool {
        let near = |off: f64| off < 1e-6;
        let axis = |segment: &Segment| cross(segment.along, segment.across);
        match (self.arc, other.arc) {
            (Some(one), Some(two)) => {
                let apart = |k: usize| (self.base[k] - other.base[k]).abs() <= 2;
                near((one.radius / two.radius - 1.0).abs())
                    && (0..COORDINATES).all(apart)
                    && near(crate::plan::norm(sub(axis(self), axis(other))))
            }
            _ => false,
        }
    }

    /// Returns the point at a length after its start, unrounded.
    #[must_use]
    pub fn point(&self, offset: f64) -> Point {
        let [along, across, third] = match (self.arc, self.powers) {
            (None, None) => [offset, 0.0, 0.0],
            (Some(arc), _) => {
                let (sin, cos) = (TAU * (offset / arc.turn)).sin_cos();
                [arc.radius * cos, arc.radius * sin, offset]
            }
            (None, Some(bits)) => {
                let part = offset / f64::from(bits).exp2();
                [offset, offset * part, offset * part * part]
            }
        };
        let way = add(scale(self.along, along), scale(self.across, across));
        let way = add(way, scale(self.third, third));
        add(self.base.map(|units| units as f64), way)
    }
}

/// Segment with its position on the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stretch {
    /// Coefficients.
    pub segment: Segment,
    /// Length at which it begins, in guard units.
    pub begin: u64,
    /// Its length in guard units, at least 1.
    pub length: u64,
    /// Directions of motion at start and end: of length 1 together with a fourth axis.
    pub directions: [Point; 2],
    /// Requested speed in mm/s.
    pub speed: f64,
    /// Radius of curvature of an arc or a helix in mm; for a bent spline the least one.
    pub radius: Option<f64>,
    /// Widening c·v² of a spline in squared guard units, applied by [`Path::widen`].
    pub wider: f64,
    /// Index of its piece.
    pub piece: usize,
    /// Line of the piece in the input.
    pub line: Option<usize>,
}

impl Stretch {
    /// Returns the segment whose words a controller with this correction needs.
    pub(super) fn segment_for(&self, correction: Correction) -> Segment {
        match correction {
            Correction::Steady => self.segment.widened(self.wider),
            _ => self.segment,
        }
    }
}

/// Path by its length.
#[derive(Debug, Clone, PartialEq)]
pub struct Path {
    /// Segments in order; never empty.
    pub stretches: Vec<Stretch>,
    /// Length L in guard units.
    pub length: u64,
    /// Number of pieces that begin and end at the same guard unit and have no segment.
    pub zero_length: usize,
}

impl Path {
    /// Returns the segments of pieces from `start` on, with `counts_per_mm`.
    ///
    /// # Errors
    /// Returns an error for a piece without numbers or speed, or off the path; a coordinate,
    /// centre, radius or length that does not fit, with the W needed; more segments than the
    /// memory holds, with the A needed; no piece with a length.
    pub fn of(
        start: Point,
        pieces: &[Piece],
        counts_per_mm: f64,
        widths: &Widths,
    ) -> Result<Self, PathError> {
        Self::with_fourth(start, pieces, None, counts_per_mm, widths)
    }

    /// Returns the segments with a fourth axis, which is linear with the length within each piece.
    /// Its motion is part of the length and of the speed, like that of the other axes.
    ///
    /// # Errors
    /// Returns the errors of [`Path::of`], and an error if W is not a number, does not fit, or
    /// moves along a spline.
    pub fn with_fourth(
        start: Point,
        pieces: &[Piece],
        fourth: Option<&FourthAxis>,
        counts_per_mm: f64,
        widths: &Widths,
    ) -> Result<Self, PathError> {
        let mut w = fourth.map(|fourth| fourth.from_mm);
        let mut stretches: Vec<Stretch> = Vec::with_capacity(pieces.len());
        let (mut from, mut length, mut zero_length) = (start, 0, 0);
        for (index, piece) in pieces.iter().enumerate() {
            let refuse = |reason| PathError {
                piece: index,
                line: piece.line,
                reason,
            };
            piece.check(from).map_err(refuse)?;
            fits(from, piece, counts_per_mm, &widths.record()).map_err(refuse)?;
            margin(start, piece, counts_per_mm, &widths.record()).map_err(refuse)?;
            let begin = std::mem::replace(&mut from, piece.to);
            let unit = counts_per_mm * two_to(widths.guard());
            let mut made = made(begin, piece, index, [unit, two_to(widths.guard())]);
            if let (Some(axis), Some(from)) = (fourth, &mut w) {
                let to = axis.to_mm.get(index).copied().unwrap_or(*from);
                let places = [*from, to, to - axis.from_mm];
                for (place, room) in places.into_iter().zip([1.0, 1.0, 2.0]) {
                    if !place.is_finite() {
                        let coordinate = Reason::Coordinate {
                            axis: "w",
                            value: place,
                        };
                        return Err(refuse(coordinate));
                    }
                    hold("w", room * place * counts_per_mm, &widths.record()).map_err(refuse)?;
                }
                let ends = [*from, to].map(|mm| (mm * unit).round());
                made = beside(made, begin, piece, index, ends, unit).map_err(refuse)?;
                *from = to;
            }
            zero_length += usize::from(made.is_empty());
            for one in made {
                stretches.push(Stretch {
                    begin: length,
                    ..one
                });
                length += one.length;
            }
            let counts = length as f64 / two_to(widths.guard());
            hold("length", counts, &widths.record()).map_err(refuse)?;
        }
        let (count, most) = (stretches.len(), widths.most_segments());
        if let Some(first) = stretches.get(most) {
            return Err(PathError {
                piece: first.piece,
                line: first.line,
                reason: Reason::Segments {
                    count,
                    most,
                    needed: count.next_power_of_two().ilog2() as usize,
                },
            });
        }
        if stretches.is_empty() {
            return Err(PathError {
                piece: 0,
                line: None,
                reason: Reason::Empty,
            });
        }
        Ok(Path {
            zero_length,
            stretches,
            length,
        })
    }

    /// Widens each arc and each spline by c·v²/r, with the speed v of its span and the radius of
    /// curvature r at every point. This is the first term of a series. The widening is limited to
    /// radii between half and twice the original, beyond which the series is useless; for a spline
    /// the least radius limits it.
    pub fn widen(&mut self, spans: &[Span], c: f64) {
        for (stretch, span) in self.stretches.iter_mut().zip(spans) {
            let by = c * span.speed * span.speed;
            stretch.wider = stretch.segment.most_wider(stretch.length as f64, by);
            if let Some(arc) = &mut stretch.segment.arc {
                // Part of a helix's speed is along its axis, and part belongs to a fourth axis.
                let beside = stretch.segment.fourth.map_or(0.0, |fourth| fourth.along);
                let third = stretch.segment.third;
                let flat = 1.0 - dot(third, third) - beside * beside;
                let by = by * flat / arc.radius;
                arc.widened = arc.radius + by.clamp(-arc.radius / 2.0, arc.radius);
            }
        }
    }

    /// Returns the segment of a length: the last that begins at or before it.
    #[must_use]
    pub fn index(&self, length: f64) -> usize {
        let after = |stretch: &Stretch| stretch.begin as f64 <= length;
        self.stretches.partition_point(after).saturating_sub(1)
    }

    /// Returns the exact point at a length, in guard units (equations (1), (5)); the start before
    /// it, and the end after it.
    #[must_use]
    pub fn point(&self, length: f64) -> Point {
        let [x, y, z, _] = self.place(length);
        [x, y, z]
    }

    /// Returns the point, including W, that a controller looks up for its command: the path's,
    /// except for splines with the steady correction, which is in their words.
    #[must_use]
    pub fn looked_up(&self, length: f64, correction: Correction) -> [f64; AXES] {
        let length = length.clamp(0.0, self.length as f64);
        let stretch = &self.stretches[self.index(length)];
        let segment = stretch.segment_for(correction);
        segment.place(length - stretch.begin as f64)
    }

    /// Returns the exact point at a length, including W; 0 if there is none.
    #[must_use]
    pub fn place(&self, length: f64) -> [f64; AXES] {
        let length = length.clamp(0.0, self.length as f64);
        let stretch = &self.stretches[self.index(length)];
        stretch.segment.place(length - stretch.begin as f64)
    }
}

/// Returns the segments of a piece, for given guard units per millimetre and per count; empty if
/// it has no length. Their start lengths are not set.
fn made(from: Point, piece: &Piece, index: usize, [unit, count]: [f64; 2]) -> Vec<Stretch> {
    let units = |point: Point| point.map(|mm| (mm * unit).round());
    let (segment, length, radius) = match &piece.course {
        Course::Line | Course::Spline(_) => {
            let way = sub(units(piece.to), units(from));
            let length = crate::plan::norm(way).round();
            let line = Segment::line(units(from), scale(way, 1.0 / length));
            (line, length, None)
        }
        Course::Arc(circle) | Course::Helix(Helix { circle, .. }) => {
            let Circle { centre, axis, .. } = *circle;
            let length = (piece.course.length(from, piece.to) * unit).round();
            let along = vector::unit(sub(circle.start, centre));
            let arc = Segment {
                across: cross(axis, along),
                arc: Some(Arc {
                    radius: circle.radius * unit,
                    turn: length * (TAU / circle.angle),
                    widened: circle.radius * unit,
                }),
                ..Segment::line(units(centre), along)
            };
            match &piece.course {
                Course::Helix(helix) => {
                    let third = scale(axis, helix.rise * unit / length);
                    let helical = Segment { third, ..arc };
                    (helical, length, Some(helix.curvature_radius()))
                }
                _ => (arc, length, Some(circle.radius)),
            }
        }
    };
    let stretch = Stretch {
        segment,
        begin: 0,
        length: length as u64,
        directions: piece.course.directions(from, piece.to),
        speed: piece.speed,
        radius,
        wider: 0.0,
        piece: index,
        line: piece.line,
    };
    match &piece.course {
        Course::Spline(cubic) => splines::stretches(cubic, unit, count, stretch),
        _ if length < 1.0 => Vec::new(),
        _ => vec![stretch],
    }
}

pub(super) fn two_to(exponent: usize) -> f64 {
    (exponent as f64).exp2()
}
