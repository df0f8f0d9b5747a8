//! Approximation of arcs by chords.

use super::geometry::Curve;
use crate::input::{Drawing, Point};

/// Returns the ends of straight pieces for `drawing.moves[index]`, the last one its own end: one
/// piece for a line; for an arc the number that keeps every piece within `tolerance_mm` of the arc
/// in X and Y. The drawing must have passed [`super::check`].
pub(crate) fn ends(
    drawing: &Drawing,
    index: usize,
    tolerance_mm: f64,
) -> impl Iterator<Item = Point> + use<> {
    let curve = Curve::of_move(drawing, index);
    pieces(curve, curve.chords(tolerance_mm))
}

/// Returns the ends of straight pieces for `drawing.moves[index]` in a picture, in mm, the last
/// one its own end: `per_turn` pieces per turn of an arc. Empty if there is no such move.
pub fn outline(
    drawing: &Drawing,
    index: usize,
    per_turn: u32,
) -> impl Iterator<Item = Point> + use<> {
    let curve = (index < drawing.moves.len()).then(|| Curve::of_move(drawing, index));
    let pieces = move |curve: Curve| pieces(curve, curve.pieces(per_turn));
    curve.into_iter().flat_map(pieces)
}

fn pieces(curve: Curve, count: u64) -> impl Iterator<Item = Point> {
    (1..=count).map(move |k| match k == count {
        true => curve.at(curve.length),
        false => curve.at(curve.length * (k as f64 / count as f64)),
    })
}
