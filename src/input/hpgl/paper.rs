//! Paper: rotates the plotter's coordinates, clips at the window and records the pen's moves.

use crate::input::track::Track;
use crate::input::{Course, Fault, Move, Point};

use super::scale::{DEFAULT_PAGE, UNITS_PER_MM};

/// Greatest number of moves in a drawing made by instructions that expand: curves, labels and
/// fills. Without a limit, a short text could fill any memory.
pub(super) const MOST_MADE: usize = 4_000_000;

/// Rotation of the coordinates in quarter turns (RO).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Turn {
    #[default]
    None,
    Quarter,
    Half,
    ThreeQuarters,
}

/// Rectangle outside of which the pen does not draw, in plotter units (IW).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Window {
    least: [f64; 2],
    most: [f64; 2],
}

impl Window {
    /// Creates a window from two opposite corners.
    pub(super) fn between([x1, y1]: [f64; 2], [x2, y2]: [f64; 2]) -> Self {
        Window {
            least: [x1.min(x2), y1.min(y2)],
            most: [x1.max(x2), y1.max(y2)],
        }
    }

    fn contains(&self, [x, y]: [f64; 2]) -> bool {
        let ([x1, y1], [x2, y2]) = (self.least, self.most);
        (x1..=x2).contains(&x) && (y1..=y2).contains(&y)
    }

    /// Returns the part of a straight line that is inside, if any. Ends inside are unchanged.
    fn clip(&self, from: [f64; 2], to: [f64; 2]) -> Option<[[f64; 2]; 2]> {
        let (mut enters, mut leaves) = (0.0f64, 1.0f64);
        for axis in 0..2 {
            let (start, length) = (from[axis], to[axis] - from[axis]);
            if length == 0.0 {
                if !(self.least[axis]..=self.most[axis]).contains(&start) {
                    return None;
                }
                continue;
            }
            let at = [self.least[axis], self.most[axis]].map(|edge| (edge - start) / length);
            enters = enters.max(at[0].min(at[1]));
            leaves = leaves.min(at[0].max(at[1]));
        }
        if enters > leaves {
            return None;
        }
        let point = |part: f64, whole: [f64; 2]| {
            if self.contains(whole) {
                return whole;
            }
            let on = |axis: usize| {
                let value = from[axis] + part * (to[axis] - from[axis]);
                value.clamp(self.least[axis], self.most[axis])
            };
            [on(0), on(1)]
        };
        Some([point(enters, from), point(leaves, to)])
    }
}

/// Instruction that moves the pen: its name and line, for moves and faults.
#[derive(Clone, Copy)]
pub(super) struct By<'t> {
    pub(super) field: &'t str,
    pub(super) line: usize,
}

/// Moves of the pen so far. Points are in plotter units as seen by the instructions, before the
/// rotation.
pub(super) struct Paper<'a> {
    pub(super) track: Track<'a>,
    /// Size of the paper in plotter units, before the rotation.
    page: [f64; 2],
    turn: Turn,
    window: Option<Window>,
    /// Last target of the pen.
    sent: [f64; 2],
    /// True if the pen is not at its target, which is outside of the window.
    lost: bool,
    made: usize,
}

impl<'a> Paper<'a> {
    pub(super) fn new(file: &'a str) -> Self {
        Self {
            track: Track::new(file),
            page: DEFAULT_PAGE,
            turn: Turn::default(),
            window: None,
            sent: [0.0; 2],
            lost: false,
            made: 0,
        }
    }

    pub(super) fn set_window(&mut self, window: Option<Window>) {
        self.window = window;
    }

    /// Sets the size of the paper. The coordinates must not be rotated.
    pub(super) fn set_page(&mut self, page: [f64; 2]) {
        self.page = page;
    }

    /// Returns the size of the paper in rotated coordinates.
    pub(super) fn size(&self) -> [f64; 2] {
        let [x, y] = self.page;
        match self.turn {
            Turn::None | Turn::Half => [x, y],
            Turn::Quarter | Turn::ThreeQuarters => [y, x],
        }
    }

    /// Rotates the coordinates; converts points from the old to the new ones.
    pub(super) fn turn<const N: usize>(
        &mut self,
        turn: Turn,
        points: [[f64; 2]; N],
    ) -> [[f64; 2]; N] {
        let (page, old) = (self.page, self.turn);
        let to_new = |point| turn.to_units(page, old.to_page(page, point));
        self.turn = turn;
        self.sent = to_new(self.sent);
        points.map(to_new)
    }

    fn to_mm(&self, point: [f64; 2]) -> Point {
        let [x, y] = self.turn.to_page(self.page, point);
        [x / UNITS_PER_MM, y / UNITS_PER_MM, 0.0]
    }

    /// Moves the pen to a point; draws if it is down.
    pub(super) fn go(&mut self, by: By<'_>, to: [f64; 2], down: bool) -> Result<(), Fault> {
        let from = std::mem::replace(&mut self.sent, to);
        let Some(window) = self.window else {
            if down && self.lost {
                self.record(by, from, false)?;
            }
            self.lost = false;
            return self.record(by, to, down);
        };
        let inside = window.contains(to);
        if down {
            if let Some([start, end]) = window.clip(from, to) {
                if !self.is_at(start) {
                    self.record(by, start, false)?;
                }
                self.record(by, end, true)?;
            }
        } else if inside {
            self.record(by, to, false)?;
        }
        self.lost = !inside;
        Ok(())
    }

    /// Moves the raised pen to a point, unless it is already there.
    pub(super) fn travel(&mut self, by: By<'_>, to: [f64; 2]) -> Result<(), Fault> {
        self.make(by, to, false)
    }

    /// Draws a line to a point, unless the pen is already there.
    pub(super) fn line(&mut self, by: By<'_>, to: [f64; 2]) -> Result<(), Fault> {
        self.make(by, to, true)
    }

    /// Draws a line through points, with the pen raised on the way to the first.
    pub(super) fn stroke(
        &mut self,
        by: By<'_>,
        points: impl IntoIterator<Item = [f64; 2]>,
    ) -> Result<(), Fault> {
        let mut down = false;
        for point in points {
            self.make(by, point, down)?;
            down = true;
        }
        Ok(())
    }

    fn make(&mut self, by: By<'_>, to: [f64; 2], down: bool) -> Result<(), Fault> {
        self.count(by, 1)?;
        if !self.lost && self.is_at(to) {
            self.sent = to;
            return Ok(());
        }
        self.go(by, to, down)
    }

    /// Counts moves made by an instruction that expands.
    ///
    /// # Errors
    ///
    /// Returns an error if there are more than [`MOST_MADE`] in total.
    pub(super) fn count(&mut self, by: By<'_>, more: usize) -> Result<(), Fault> {
        self.made = self.made.saturating_add(more);
        if self.made <= MOST_MADE {
            return Ok(());
        }
        let problem = format!("curves, labels and fills make more than {MOST_MADE} moves");
        let allowed = "larger chord angles, wider fills, or less of them";
        Err(self.track.fault(by.line, by.field, problem, allowed))
    }

    /// Returns the number of moves that may still be made.
    pub(super) fn left(&self) -> usize {
        MOST_MADE.saturating_sub(self.made)
    }

    fn is_at(&self, point: [f64; 2]) -> bool {
        self.track.is_at(self.to_mm(point))
    }

    fn record(&mut self, by: By<'_>, to: [f64; 2], down: bool) -> Result<(), Fault> {
        let next = Move {
            to: self.to_mm(to),
            course: Course::Line,
            rapid: !down,
            feed_mm_per_min: None,
            line: by.line,
        };
        self.track.push(by.field, next)
    }
}

impl Turn {
    /// Converts a point from rotated coordinates to the paper. Their origin is at the corner that
    /// is then at the lower left.
    fn to_page(self, [width, height]: [f64; 2], [x, y]: [f64; 2]) -> [f64; 2] {
        match self {
            Turn::None => [x, y],
            Turn::Quarter => [width - y, x],
            Turn::Half => [width - x, height - y],
            Turn::ThreeQuarters => [y, height - x],
        }
    }

    fn to_units(self, [width, height]: [f64; 2], [x, y]: [f64; 2]) -> [f64; 2] {
        match self {
            Turn::None => [x, y],
            Turn::Quarter => [y, width - x],
            Turn::Half => [width - x, height - y],
            Turn::ThreeQuarters => [height - y, x],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const BY: By<'_> = By {
        field: "PD",
        line: 1,
    };

    #[test]
    fn turned_corners_are_corners_of_the_paper() {
        let page = [100.0, 60.0];
        for (turn, origin, along_x) in [
            (Turn::None, [0.0, 0.0], [1.0, 0.0]),
            (Turn::Quarter, [100.0, 0.0], [100.0, 1.0]),
            (Turn::Half, [100.0, 60.0], [99.0, 60.0]),
            (Turn::ThreeQuarters, [0.0, 60.0], [0.0, 59.0]),
        ] {
            assert_eq!(turn.to_page(page, [0.0, 0.0]), origin, "{turn:?}");
            assert_eq!(turn.to_page(page, [1.0, 0.0]), along_x, "{turn:?}");
            let back = turn.to_units(page, turn.to_page(page, [7.0, 9.0]));
            assert_eq!(back, [7.0, 9.0], "{turn:?}");
        }
    }

    #[test]
    fn a_pen_outside_of_the_window_comes_back_where_it_enters() {
        let mut paper = Paper::new("t");
        paper.set_window(Some(Window::between([400.0, 400.0], [0.0, 0.0])));
        for (to, down) in [
            ([200.0, 200.0], false),
            ([600.0, 200.0], true),
            ([600.0, 300.0], true),
            ([200.0, 300.0], true),
            ([-40.0, -40.0], false),
            ([40.0, 40.0], true),
            ([900.0, 40.0], false),
        ] {
            paper.go(BY, to, down).unwrap();
        }
        // Without the window the pen first moves to its last target.
        paper.set_window(None);
        paper.go(BY, [900.0, 80.0], true).unwrap();
        let moves = paper.track.finish("moves").unwrap().moves;
        let shown: Vec<_> = moves.iter().map(|m| (m.to[0], m.to[1], m.rapid)).collect();
        let expected = [
            (5.0, 5.0, true),
            (10.0, 5.0, false),
            (10.0, 7.5, true),
            (5.0, 7.5, false),
            (0.0, 0.0, true),
            (1.0, 1.0, false),
            (22.5, 1.0, true),
            (22.5, 2.0, false),
        ];
        assert_eq!(shown, expected);
    }

    #[test]
    fn what_is_made_has_an_end() {
        let mut paper = Paper::new("t");
        paper.count(BY, MOST_MADE - 1).unwrap();
        assert_eq!(paper.left(), 1);
        paper.travel(BY, [1.0, 0.0]).unwrap();
        let fault = paper.line(BY, [2.0, 0.0]).unwrap_err();
        let text = "curves, labels and fills make more than 4000000 moves";
        assert_eq!(fault.problem, text);
    }

    proptest! {
        /// Everything drawn is inside, and everything inside is drawn.
        #[test]
        fn clipping_keeps_the_inside(
            points in proptest::collection::vec((-300.0..300.0f64, -300.0..300.0f64), 2..20),
        ) {
            let window = Window::between([-100.0, -50.0], [100.0, 50.0]);
            for pair in points.windows(2) {
                let [from, to] = [pair[0], pair[1]].map(|(x, y)| [x, y]);
                let kept = window.clip(from, to);
                if let Some([start, end]) = kept {
                    prop_assert!(window.contains(start) && window.contains(end));
                }
                for step in 0..=50 {
                    let part = f64::from(step) / 50.0;
                    let at = |axis: usize| from[axis] + part * (to[axis] - from[axis]);
                    let point = [at(0), at(1)];
                    let along = |p: [f64; 2]| {
                        (p[0] - from[0]) * (to[0] - from[0]) + (p[1] - from[1]) * (to[1] - from[1])
                    };
                    let within = kept.is_some_and(|[start, end]| {
                        (along(start) - 1e-6..=along(end) + 1e-6).contains(&along(point))
                    });
                    if window.contains(point) {
                        prop_assert!(within, "{point:?} of {from:?} {to:?}");
                    }
                }
            }
        }
    }
}
