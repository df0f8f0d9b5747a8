//! Fourth axis beside a path in space: W, linear with the length of each piece.

use super::segments::{Arc, Segment, Stretch, two_to};
use crate::circuits::trajectory_controller::Widths;
use crate::input::{COORDINATES, Point};
use crate::path::error::Reason;
use crate::path::pieces::{Course, Piece};
use crate::path::vector::scale;

/// Fourth coordinate of a segment, linear with the length, in guard units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fourth {
    /// Value at the start.
    pub base: i64,
    /// Change per guard unit of length.
    pub along: f64,
}

/// Values of W on the pieces of a path.
#[derive(Debug, Clone, PartialEq)]
pub struct FourthAxis {
    /// Start in mm.
    pub from_mm: f64,
    /// Values at the end of each piece, in mm.
    pub to_mm: Vec<f64>,
}

impl Segment {
    /// Returns the words of a fourth axis, which follow these. An arc has them like a helix has
    /// its rise.
    #[must_use]
    pub fn fourth_words(&self, widths: &Widths) -> Option<[u64; 4]> {
        let Fourth { base, along } = self.fourth?;
        let unit = two_to(widths.coefficient - 2);
        let word = |value: i64| value as u64 & ((1 << widths.data) - 1);
        let along = word((along * unit).round() as i64);
        let [of_line, of_arc] = match self.arc {
            None => [along, 0],
            Some(_) => [0, along],
        };
        Some([word(base), of_line, 0, of_arc])
    }

    /// Returns W at a length after its start, unrounded; 0 if there is none.
    #[must_use]
    pub fn fourth_point(&self, offset: f64) -> f64 {
        let at = |Fourth { base, along }| base as f64 + along * offset;
        self.fourth.map_or(0.0, at)
    }

    /// Returns the segment with W added, and its new length; `length` is the old one in guard
    /// units. Its points are unchanged, parametrised by the greater length.
    fn with_fourth(self, length: u64, base: i64, way: f64) -> (Self, u64) {
        let longer = (length as f64).hypot(way).round();
        let part = length as f64 / longer;
        let arc = self.arc.map(|arc| Arc {
            turn: arc.turn / part,
            ..arc
        });
        let along = match arc {
            None => scale(self.along, part),
            Some(_) => self.along,
        };
        let segment = Segment {
            along,
            arc,
            third: scale(self.third, part),
            fourth: Some(Fourth {
                base,
                along: way / longer,
            }),
            ..self
        };
        (segment, longer as u64)
    }
}

/// Returns the segments of a piece with W from one value to another, in guard units.
pub(super) fn beside(
    made: Vec<Stretch>,
    from: Point,
    piece: &Piece,
    index: usize,
    [begin, end]: [f64; 2],
    unit: f64,
) -> Result<Vec<Stretch>, Reason> {
    let (way, base) = (end - begin, begin as i64);
    let still = |stretch: Stretch| Stretch {
        segment: Segment {
            fourth: Some(Fourth { base, along: 0.0 }),
            ..stretch.segment
        },
        ..stretch
    };
    if way == 0.0 {
        return Ok(made.into_iter().map(still).collect());
    }
    if matches!(piece.course, Course::Spline(_)) {
        return Err(Reason::Climb);
    }
    // W moves alone while the others rest.
    let alone = || Stretch {
        segment: Segment::line(from.map(|mm| (mm * unit).round()), [0.0; COORDINATES]),
        begin: 0,
        length: 0,
        directions: [[0.0; COORDINATES]; 2],
        speed: piece.speed,
        wider: 0.0,
        radius: None,
        piece: index,
        line: piece.line,
    };
    let of = made.into_iter().next().unwrap_or_else(alone);
    let (segment, length) = of.segment.with_fourth(of.length, base, way);
    let part = of.length as f64 / length as f64;
    Ok(vec![Stretch {
        segment,
        length,
        directions: of.directions.map(|direction| scale(direction, part)),
        ..of
    }])
}
