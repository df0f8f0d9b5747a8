//! Packed list of a drawing's moves.

use super::{Course, Move, Point};
use std::ops::Range;

/// List of moves, 32 bytes each if feeds and courses seldom change.
///
/// ```
/// use motion_rtl::input::{Course, Move, Moves};
///
/// let step = Move {
///     to: [1.0, 2.0, 0.0],
///     course: Course::Line,
///     rapid: false,
///     feed_mm_per_min: Some(600.0),
///     line: 3,
/// };
/// let moves: Moves = [step].into_iter().collect();
/// assert_eq!(moves.get(0), Some(step));
/// assert!(moves.iter().all(|one| one.to == step.to));
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Moves {
    ends: Vec<(Point, usize)>,
    /// Changes of rapid and feed, each from a move on.
    speeds: Vec<(usize, bool, Option<f64>)>,
    /// Moves that are not lines.
    curves: Vec<(usize, Course)>,
}

impl Moves {
    /// Adds a move at the end.
    pub fn push(&mut self, step: Move) {
        let Move {
            to,
            course,
            rapid,
            feed_mm_per_min,
            line,
        } = step;
        let index = self.ends.len();
        let same = |(_, a, b): &(usize, bool, Option<f64>)| (*a, *b) == (rapid, feed_mm_per_min);
        if !self.speeds.last().is_some_and(same) {
            self.speeds.push((index, rapid, feed_mm_per_min));
        }
        if course != Course::Line {
            self.curves.push((index, course));
        }
        self.ends.push((to, line));
    }

    /// Returns a move by its index; `None` after the last.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<Move> {
        let &(to, line) = self.ends.get(index)?;
        let speed = self.speeds.partition_point(|speed| speed.0 <= index);
        let &(_, rapid, feed_mm_per_min) = self.speeds.get(speed.checked_sub(1)?)?;
        let curve = self.curves.binary_search_by_key(&index, |curve| curve.0);
        let course = curve.map_or(Course::Line, |curve| self.curves[curve].1);
        Some(Move {
            to,
            course,
            rapid,
            feed_mm_per_min,
            line,
        })
    }

    /// Returns the end of a move.
    #[must_use]
    pub fn end(&self, index: usize) -> Option<Point> {
        self.ends.get(index).map(|end| end.0)
    }

    #[must_use]
    pub fn last(&self) -> Option<Move> {
        self.get(self.len().checked_sub(1)?)
    }

    /// Returns the number of moves.
    #[must_use]
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// True if there are no moves.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// Returns the moves in order.
    #[must_use]
    pub fn iter(&self) -> Iter<'_> {
        Iter {
            moves: self,
            range: 0..self.len(),
        }
    }
}

/// Iterator over the moves of a drawing.
#[derive(Debug, Clone)]
pub struct Iter<'a> {
    moves: &'a Moves,
    range: Range<usize>,
}

impl Iterator for Iter<'_> {
    type Item = Move;

    fn next(&mut self) -> Option<Move> {
        self.moves.get(self.range.next()?)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.range.size_hint()
    }
}

impl ExactSizeIterator for Iter<'_> {}

impl<'a> IntoIterator for &'a Moves {
    type Item = Move;
    type IntoIter = Iter<'a>;

    fn into_iter(self) -> Iter<'a> {
        self.iter()
    }
}

impl Extend<Move> for Moves {
    fn extend<I: IntoIterator<Item = Move>>(&mut self, moves: I) {
        moves.into_iter().for_each(|step| self.push(step));
    }
}

impl FromIterator<Move> for Moves {
    fn from_iter<I: IntoIterator<Item = Move>>(moves: I) -> Self {
        let mut all = Moves::default();
        all.extend(moves);
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_move_comes_back() {
        let feeds = [None, Some(60.0), Some(60.0), Some(1.5)];
        let arc = Course::Arc {
            centre: [3.0, -1.0],
            clockwise: true,
        };
        let spline = Course::Spline {
            controls: [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]],
        };
        let step = |k: usize| Move {
            to: [k as f64, -0.5 * k as f64, (k % 7) as f64],
            course: [Course::Line, Course::Line, arc, spline, arc][k % 5],
            rapid: k % 6 < 2,
            feed_mm_per_min: feeds[k % 4],
            line: 1000 - k,
        };
        let all: Vec<Move> = (0..200).map(step).collect();
        let moves: Moves = all.iter().copied().collect();
        assert!(moves.iter().eq(all.iter().copied()));
        assert_eq!((moves.len(), moves.iter().len()), (200, 200));
        assert_eq!((moves.get(199), moves.get(200)), (Some(step(199)), None));
        assert_eq!(
            (moves.end(7), moves.last()),
            (Some(step(7).to), Some(step(199)))
        );
        let none = Moves::default();
        assert!(none.is_empty() && none.last().is_none() && !moves.is_empty());
    }

    #[test]
    fn a_line_at_the_feed_of_the_one_before_takes_its_end_and_line_only() {
        assert_eq!(size_of::<(Point, usize)>(), 32);
        let step = Move {
            to: [0.0; 3],
            course: Course::Line,
            rapid: false,
            feed_mm_per_min: Some(1.0),
            line: 1,
        };
        let moves: Moves = std::iter::repeat_n(step, 1000).collect();
        assert_eq!((moves.speeds.len(), moves.curves.len()), (1, 0));
    }
}
