//! Size, direction and spacing of labels.

use super::scale::{Corners, UNITS_PER_MM};

/// Settings of labels.
#[derive(Debug, Clone)]
pub(super) struct Text<'a> {
    pub(super) size: Size,
    pub(super) direction: Direction,
    /// Tangent of the slant angle of letters (SL).
    pub(super) slant: f64,
    /// Position of the label relative to the pen (LO).
    pub(super) origin: u8,
    pub(super) path: Path,
    /// Additional space between letters and lines, in widths and heights of cells (ES).
    pub(super) extra: [f64; 2],
    /// Text written by PB (BL).
    pub(super) buffer: &'a [u8],
    /// Symbol drawn at every point (SM).
    pub(super) symbol: Option<u8>,
    /// Target of carriage returns in plotter units.
    pub(super) carriage: [f64; 2],
}

impl Default for Text<'_> {
    fn default() -> Self {
        Text {
            size: Size::default(),
            direction: Direction::default(),
            slant: 0.0,
            origin: 1,
            path: Path::default(),
            extra: [0.0; 2],
            buffer: &[],
            symbol: None,
            carriage: [0.0; 2],
        }
    }
}

/// Width and height of a capital letter (SI, SR).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Size {
    Centimetres([f64; 2]),
    /// Percentage of the distance of P1 and P2.
    Percent([f64; 2]),
}

impl Default for Size {
    /// Returns the size on an HP 7475A with paper of size A.
    fn default() -> Self {
        Size::Centimetres([0.187, 0.269])
    }
}

/// Direction of the base line: run and rise (DI, DR).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Direction {
    Absolute([f64; 2]),
    /// Percentage of the distance of P1 and P2.
    Relative([f64; 2]),
}

impl Default for Direction {
    fn default() -> Self {
        Direction::Absolute([1.0, 0.0])
    }
}

/// Direction from a letter to the next (DV).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Path {
    #[default]
    Right,
    Down,
    Left,
    Up,
}

/// Axes of a letter in plotter units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Frame {
    /// Along the base line, with the length of a capital letter's width.
    pub(super) width: [f64; 2],
    /// Up from the base line, with the length of a capital letter's height, slanted.
    pub(super) height: [f64; 2],
    /// Up from the base line, not slanted.
    pub(super) upright: [f64; 2],
    /// From a cell to the next along the base line.
    pub(super) column: [f64; 2],
    /// From a line to the one above.
    pub(super) row: [f64; 2],
}

/// Width and height of a cell in letters.
const CELL: [f64; 2] = [1.5, 2.0];

impl Text<'_> {
    /// Returns the axes of letters for the given corners.
    pub(super) fn frame(&self, corners: &Corners) -> Frame {
        let [across, up] = corners.span();
        let [width, height] = match self.size {
            Size::Centimetres(size) => size.map(|cm| cm * 10.0 * UNITS_PER_MM),
            Size::Percent([x, y]) => [x / 100.0 * across, y / 100.0 * up],
        };
        let [run, rise] = match self.direction {
            Direction::Absolute(direction) => direction,
            Direction::Relative([run, rise]) => [run * across, rise * up],
        };
        let length = run.hypot(rise);
        let [x, y] = [run / length, rise / length];
        let upright = [-y * height, x * height];
        let lean = self.slant * height;
        let [wider, higher] = self.extra;
        let column = CELL[0] * (1.0 + wider) * width;
        let row = CELL[1] * (1.0 + higher);
        Frame {
            width: [x * width, y * width],
            height: [upright[0] + lean * x, upright[1] + lean * y],
            upright,
            column: [x * column, y * column],
            row: upright.map(|part| part * row),
        }
    }
}

impl Frame {
    /// Returns a point of a letter at `at`.
    pub(super) fn point(&self, at: [f64; 2], [x, y]: [f64; 2]) -> [f64; 2] {
        add(add(at, self.width, x), self.height, y)
    }

    /// Returns the step from one letter to the next.
    pub(super) fn step(&self, path: Path) -> [f64; 2] {
        match path {
            Path::Right => self.column,
            Path::Down => self.row.map(|part| -part),
            Path::Left => self.column.map(|part| -part),
            Path::Up => self.row,
        }
    }

    /// Returns the step from one line to the next.
    pub(super) fn feed(&self, path: Path) -> [f64; 2] {
        match path {
            Path::Right | Path::Left => self.row.map(|part| -part),
            Path::Down | Path::Up => self.column.map(|part| -part),
        }
    }
}

/// Returns a point plus a multiple of a step.
pub(super) fn add(at: [f64; 2], step: [f64; 2], times: f64) -> [f64; 2] {
    [at[0] + step[0] * times, at[1] + step[1] * times]
}

#[cfg(test)]
mod tests {
    use super::super::scale::DEFAULT_CORNERS;
    use super::*;

    fn near(a: [f64; 2], b: [f64; 2]) -> bool {
        (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-9
    }

    #[test]
    fn a_cell_is_one_and_a_half_by_two_letters() {
        let frame = Text::default().frame(&DEFAULT_CORNERS);
        assert!(near(frame.width, [74.8, 0.0]), "{frame:?}");
        assert!(near(frame.height, [0.0, 107.6]));
        assert!(near(frame.column, [112.2, 0.0]));
        assert!(near(frame.row, [0.0, 215.2]));
        assert!(near(frame.step(Path::Down), [0.0, -215.2]));
        assert!(near(frame.feed(Path::Right), [0.0, -215.2]));
        assert!(near(frame.feed(Path::Down), [-112.2, 0.0]));
    }

    #[test]
    fn sizes_and_directions_of_the_corners_go_with_them() {
        // 10000 by 7200 units.
        let text = Text {
            size: Size::Percent([1.0, 2.0]),
            direction: Direction::Relative([0.0, 5.0]),
            slant: 0.5,
            extra: [0.5, -0.25],
            ..Text::default()
        };
        let frame = text.frame(&DEFAULT_CORNERS);
        assert!(near(frame.width, [0.0, 100.0]), "{frame:?}");
        assert!(near(frame.upright, [-144.0, 0.0]));
        assert!(near(frame.height, [-144.0, 72.0]));
        assert!(near(frame.column, [0.0, 225.0]));
        assert!(near(frame.row, [-216.0, 0.0]));
        assert!(near(frame.point([5.0, 5.0], [1.0, 0.5]), [-67.0, 141.0]));
    }
}
