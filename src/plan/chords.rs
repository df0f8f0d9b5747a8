//! An arc as chords.

use super::geometry::Curve;
use crate::input::{Drawing, Point};

/// The ends of the straight pieces that stand for `drawing.moves[index]`, its own end last: for a
/// line that alone, for an arc as many as keep every piece within `tolerance_mm` of the arc in X
/// and Y. The drawing must have passed [`super::check`].
pub(crate) fn ends(
    drawing: &Drawing,
    index: usize,
    tolerance_mm: f64,
) -> impl Iterator<Item = Point> + use<> {
    let curve = Curve::of_move(drawing, index);
    pieces(curve, curve.chords(tolerance_mm))
}

/// The ends of the straight pieces that stand for `drawing.moves[index]` in a picture, in mm, its
/// own end last: of an arc `per_turn` pieces for a turn. None where there is no such move.
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
