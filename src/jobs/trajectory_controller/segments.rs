//! A path as segments: what the segment store and the search are filled with.
//!
//! | word | line | arc | spline |
//! |---|---|---|---|
//! | 0 | 0 | bit 0 set, bits 6..1 H − n | bit 7 set, bits 6..1 n |
//! | 1 | 0 | 2^(M + n − 4) / turn, of M bits | 0 |
//! | 2 | 0 | radius / gain of CORDIC, with R − P bits behind the guard unit | 0 |
//! | 3, 4, 5 | where it begins | the centre | where it begins |
//! | 6, 7, 8 | way / length | direction to where it begins | direction where it begins |
//! | 9, 10, 11 | 0 | direction a quarter turn on | that of the length's square, times 2^n |
//! | 12 | 0 | as word 2, the radius widened for constant speed | 0 |
//! | 13, 14, 15 | not looked at | not looked at | that of its cube, times 2^2n |
//!
//! A fourth axis has four words more, base and coefficients as those of x: 16 and, of a line, 17, of
//! an arc 19, which then has bit 7 of word 0 set as a helix has. A spline's length has n bits. A helix
//! has the words of an arc with bit 7 of word 0 set, and in words 13 to 15 its rise over its length.
//! Lengths are whole guard units of 2^-G count. A piece's
//! own length is rounded, and what the rounding takes is spread over the piece: a line's
//! coefficients are its way divided by the rounded length, an arc's angle at the rounded length is
//! the arc's own. So each ends where the piece ends. The speed is off by as little: half a guard
//! unit in the length of the piece.

use super::extent::{fits, hold, margin};
use super::fourth::beside;
pub use super::fourth::{Fourth, FourthAxis};
use super::speed_limits::Span;
use super::splines;
use crate::circuits::blocks::cordic_state::GAIN;
use crate::circuits::trajectory_controller::Widths;
use crate::circuits::trajectory_controller::path_point::AXES;
use crate::circuits::trajectory_controller::segment_store::WORDS;
use crate::circuits::trajectory_controller::vector_correction::Correction;
use crate::input::{COORDINATES, Point};
use crate::path::circle::Circle;
use crate::path::error::{PathError, Reason};
use crate::path::helix::Helix;
use crate::path::pieces::{Course, Piece};
use crate::path::vector::{self, add, cross, dot, scale, sub};
use std::f64::consts::TAU;

/// What a length within a segment becomes a point by. All in guard units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Where a line begins; the centre of an arc.
    pub base: [i64; COORDINATES],
    /// A line's way in a guard unit of its length; of an arc the direction from the centre to where
    /// it begins.
    pub along: Point,
    /// Of an arc the direction of its motion where it begins; of a spline the part of the length's
    /// square over 2^n.
    pub across: Point,
    /// Of a helix its rise in a guard unit of its length; of a spline the part of the length's cube
    /// over 2^2n.
    pub third: Point,
    /// What an arc or a helix has besides.
    pub arc: Option<Arc>,
    /// n of a spline: its length is below 2^n, and not below 2^(n − 1).
    pub powers: Option<u32>,
    /// What it has of a fourth axis.
    pub fourth: Option<Fourth>,
}

/// An arc, in guard units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arc {
    /// r.
    pub radius: f64,
    /// Length of a whole turn: 2πr, but for the rounding of the length.
    pub turn: f64,
    /// The radius of the command whose response has radius r at constant speed (¶0004); r before
    /// [`Path::widen`].
    pub widened: f64,
}

impl Segment {
    /// A line, by where it begins and its way in a guard unit of its length.
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

    /// Its words, each below 2^D. A turn is 1 or longer.
    #[must_use]
    pub fn words(&self, widths: &Widths) -> [u64; WORDS] {
        let word = |value: i64| value as u64 & ((1 << widths.data) - 1);
        let mut words = [0; WORDS];
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

    /// The point at a length behind its beginning with W, unrounded.
    pub(super) fn place(&self, offset: f64) -> [f64; AXES] {
        let [x, y, z] = self.point(offset);
        [x, y, z, self.fourth_point(offset)]
    }

    /// What it is called.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match (self.arc, self.powers) {
            (Some(_), _) if self.third != [0.0; COORDINATES] => "helix",
            (Some(_), _) => "arc",
            (None, Some(_)) => "spline",
            (None, None) => "line",
        }
    }

    /// Whether both are arcs of one circle, run the same way.
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

    /// The point at a length behind its beginning, unrounded.
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

/// A segment where it is on the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stretch {
    /// Its points.
    pub segment: Segment,
    /// The length at which it begins, in guard units.
    pub begin: u64,
    /// Its length in guard units, 1 or more.
    pub length: u64,
    /// Direction of motion at its start and at its end: of length 1 together with a fourth axis.
    pub directions: [Point; 2],
    /// The speed that is wanted, in mm/s.
    pub speed: f64,
    /// Radius of curvature of an arc or a helix in mm; of a spline the least, where it is bent.
    pub radius: Option<f64>,
    /// c·v² of a spline in the square of guard units, by which [`Path::widen`] widens it.
    pub wider: f64,
    /// The piece it comes from.
    pub piece: usize,
    /// Line of the input that stands in.
    pub line: Option<usize>,
}

impl Stretch {
    /// The segment whose words a controller with this correction is given.
    pub(super) fn segment_for(&self, correction: Correction) -> Segment {
        match correction {
            Correction::Steady => self.segment.widened(self.wider),
            _ => self.segment,
        }
    }
}

/// A path by its length.
#[derive(Debug, Clone, PartialEq)]
pub struct Path {
    /// One after the other; never empty.
    pub stretches: Vec<Stretch>,
    /// L in guard units.
    pub length: u64,
    /// Pieces that begin and end at the same guard unit: they have no segment.
    pub zero_length: usize,
}

impl Path {
    /// The segments of pieces from `start` on, at so many counts per millimetre.
    ///
    /// # Errors
    /// A piece without numbers or speed, or off the path; a coordinate, centre, radius or length
    /// that does not fit, with the W that it needs; more segments than the memory holds, with the A
    /// that they need; no piece with a length.
    pub fn of(
        start: Point,
        pieces: &[Piece],
        counts_per_mm: f64,
        widths: &Widths,
    ) -> Result<Self, PathError> {
        Self::with_fourth(start, pieces, None, counts_per_mm, widths)
    }

    /// The same with a fourth axis, which goes linearly with the length within each piece. Its way is
    /// part of the length, and of the speed, as those of the others are.
    ///
    /// # Errors
    /// As [`Path::of`]; W is no number or does not fit, or moves along a spline.
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

    /// Widens each arc and each spline by c·v²/r, v being the speed on its span and r its radius of
    /// curvature at every point; to twice the radius at most, where the series that this is the first
    /// of is long worthless, and half of it at least. Of a spline the least radius limits it.
    pub fn widen(&mut self, spans: &[Span], c: f64) {
        for (stretch, span) in self.stretches.iter_mut().zip(spans) {
            let by = c * span.speed * span.speed;
            stretch.wider = stretch.segment.most_wider(stretch.length as f64, by);
            if let Some(arc) = &mut stretch.segment.arc {
                // Of the speed of a helix a part goes up, and one to a fourth axis.
                let beside = stretch.segment.fourth.map_or(0.0, |fourth| fourth.along);
                let third = stretch.segment.third;
                let flat = 1.0 - dot(third, third) - beside * beside;
                let by = by * flat / arc.radius;
                arc.widened = arc.radius + by.clamp(-arc.radius / 2.0, arc.radius);
            }
        }
    }

    /// The segment that a length belongs to: the last that begins at or before it.
    #[must_use]
    pub fn index(&self, length: f64) -> usize {
        let after = |stretch: &Stretch| stretch.begin as f64 <= length;
        self.stretches.partition_point(after).saturating_sub(1)
    }

    /// Equations (1), (5): the exact point at a length, in guard units; before the start and behind
    /// the end, the start and the end.
    #[must_use]
    pub fn point(&self, length: f64) -> Point {
        let [x, y, z, _] = self.place(length);
        [x, y, z]
    }

    /// The point that a controller looks up for its command, with W: that of the path, but on splines
    /// with the steady correction, which is in their words.
    #[must_use]
    pub fn looked_up(&self, length: f64, correction: Correction) -> [f64; AXES] {
        let length = length.clamp(0.0, self.length as f64);
        let stretch = &self.stretches[self.index(length)];
        let segment = stretch.segment_for(correction);
        segment.place(length - stretch.begin as f64)
    }

    /// The same with W; 0 where there is none.
    #[must_use]
    pub fn place(&self, length: f64) -> [f64; AXES] {
        let length = length.clamp(0.0, self.length as f64);
        let stretch = &self.stretches[self.index(length)];
        stretch.segment.place(length - stretch.begin as f64)
    }
}

/// The segments of a piece, with so many guard units a millimetre and a count; none where it has no
/// length. Where they begin is not in them.
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
