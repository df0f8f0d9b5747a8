//! Checks that a piece of a path fits in the words of its segment, and that its surroundings fit
//! in those of commands.

use crate::circuits::arc_generator::Widths as RecordWidths;
use crate::input::{COORDINATES, Point};
use crate::path::circle::Circle;
use crate::path::error::Reason;
use crate::path::pieces::{Course, Piece};

/// Checks that a piece's points, centre and radius fit in their words.
pub(super) fn fits(
    from: Point,
    piece: &Piece,
    counts_per_mm: f64,
    widths: &RecordWidths,
) -> Result<(), Reason> {
    let check = |names: [&'static str; COORDINATES], point: Point| {
        let mut coordinates = names.into_iter().zip(point);
        coordinates.try_for_each(|(what, mm)| hold(what, mm * counts_per_mm, widths))
    };
    const NAMES: [&str; COORDINATES] = ["x", "y", "z"];
    check(NAMES, from)?;
    check(NAMES, piece.to)?;
    let extremes = piece.course.extremes(piece.to);
    (0..2).try_for_each(|end| check(NAMES, extremes.map(|extreme| extreme[end])))?;
    let Some(circle) = turned(&piece.course) else {
        return Ok(());
    };
    check(["centre x", "centre y", "centre z"], circle.centre)?;
    hold("radius", circle.radius * counts_per_mm, widths)
}

/// Checks that a piece stays within half the range around the path's start, where the motors are
/// at 0: the other half is for the corrected command, and for an overshooting response.
pub(super) fn margin(
    start: Point,
    piece: &Piece,
    counts_per_mm: f64,
    widths: &RecordWidths,
) -> Result<(), Reason> {
    let extremes = piece.course.extremes(piece.to);
    let radius = turned(&piece.course).map_or(0.0, |circle| circle.radius);
    let ways = (0..COORDINATES).flat_map(|axis| {
        let name = ["x from the start", "y from the start", "z from the start"][axis];
        extremes[axis].map(|mm| (name, mm - start[axis]))
    });
    for (what, mm) in ways.chain([("radius", radius)]) {
        let counts = mm * counts_per_mm;
        if !widths.holds(2.0 * counts) {
            return Err(Reason::Reach {
                what,
                counts,
                most: widths.reach() / 2,
                width: widths.position,
                needed: RecordWidths::needed(2.0 * counts),
            });
        }
    }
    Ok(())
}

/// Returns the circle on which a piece turns.
fn turned(course: &Course) -> Option<&Circle> {
    match course {
        Course::Line | Course::Spline(_) => None,
        Course::Arc(circle) => Some(circle),
        Course::Helix(helix) => Some(&helix.circle),
    }
}

/// Checks that counts fit in a word.
pub(super) fn hold(what: &'static str, counts: f64, widths: &RecordWidths) -> Result<(), Reason> {
    match widths.holds(counts) {
        true => Ok(()),
        false => Err(Reason::Reach {
            what,
            counts,
            most: widths.reach(),
            width: widths.position,
            needed: RecordWidths::needed(counts),
        }),
    }
}
