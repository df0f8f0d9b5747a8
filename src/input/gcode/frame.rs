//! Rotations in the X-Y plane: by G68, and of a coordinate system by G10 L2 R.
//!
//! The reader works in unrotated coordinates. Stored and emitted points, such as ends of moves and
//! reference points, are in machine coordinates.

use super::block::{Block, Code, name};
use super::machine::{Machine, Words};
use super::modal::{Motion, Plane};
use super::offsets::Own;
use super::problem::Problem;
use crate::input::{Course, Point};

/// Rotation with a shift, from reader to machine coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Frame {
    cos: f64,
    sin: f64,
    shift: [f64; 2],
}

impl Frame {
    /// Creates a counter-clockwise rotation about a point.
    fn about([x, y]: [f64; 2], degrees: f64) -> Self {
        let (sin, cos) = sin_cos(degrees);
        Self {
            cos,
            sin,
            shift: [x - x * cos + y * sin, y - x * sin - y * cos],
        }
    }

    /// Returns the rotation after another one.
    fn after(self, first: Self) -> Self {
        Self {
            cos: self.cos * first.cos - self.sin * first.sin,
            sin: self.sin * first.cos + self.cos * first.sin,
            shift: self.turn(first.shift),
        }
    }

    fn turn(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [dx, dy] = self.shift;
        [
            x * self.cos - y * self.sin + dx,
            x * self.sin + y * self.cos + dy,
        ]
    }

    fn back(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [x, y] = [x - self.shift[0], y - self.shift[1]];
        [x * self.cos + y * self.sin, y * self.cos - x * self.sin]
    }
}

/// Returns sine and cosine, exact at right angles.
pub(super) fn sin_cos(degrees: f64) -> (f64, f64) {
    match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        degrees => degrees.to_radians().sin_cos(),
    }
}

/// State of G68: centre from the program's zero, in millimetres, and angle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turn {
    centre: [f64; 2],
    degrees: f64,
}

/// Current rotation.
#[derive(Debug, Default)]
pub(super) struct Rotation {
    turn: Option<Turn>,
    frame: Option<Frame>,
    /// Code after which no move to both X and Y has come: controls differ in the position.
    unsettled: Option<Code>,
    /// Start of the line's move.
    began: Point,
}

impl Machine<'_> {
    /// Converts a point from reader to machine coordinates.
    pub(super) fn turned(&self, [x, y, z]: Point) -> Point {
        let frame = self.rotation.frame;
        let [x, y] = frame.map_or([x, y], |frame| frame.turn([x, y]));
        [x, y, z]
    }

    /// Converts a point from machine to reader coordinates.
    pub(super) fn unturned(&self, [x, y, z]: Point) -> Point {
        let frame = self.rotation.frame;
        let [x, y] = frame.map_or([x, y], |frame| frame.back([x, y]));
        [x, y, z]
    }

    pub(super) fn is_turned(&self) -> bool {
        self.rotation.frame.is_some()
    }

    /// Returns the frame of a coordinate system, without G68.
    pub(super) fn frame_of(&self, system: usize) -> Option<Frame> {
        let degrees = self.offsets.rotation(system);
        let ([x, y, _], [tool_x, tool_y, _]) = (self.offsets.system(system), self.modal.tool);
        (degrees != 0.0).then(|| Frame::about([x + tool_x, y + tool_y], degrees))
    }

    /// Keeps the tool's position when the rotation changes.
    pub(super) fn reframe(&mut self) {
        let zero = self.zero();
        let turn = self.rotation.turn.map(|turn| {
            let [x, y] = turn.centre;
            Frame::about([zero[0] + x, zero[1] + y], turn.degrees)
        });
        let frame = match (self.frame_of(self.modal.system), turn) {
            (Some(system), Some(turn)) => Some(system.after(turn)),
            (system, turn) => system.or(turn),
        };
        if frame != self.rotation.frame {
            let at = self.turned(self.at);
            self.rotation.frame = frame;
            self.at = self.unturned(at);
        }
    }

    /// Returns the position of the tool in a coordinate system.
    pub(super) fn shown_by(&self, system: usize) -> [f64; 2] {
        let [x, y, _] = self.turned(self.at);
        let place = self
            .frame_of(system)
            .map_or([x, y], |frame| frame.back([x, y]));
        let zero = self.offsets.system(system);
        let [shift, tool] = [self.offsets.shift(), self.modal.tool];
        [0, 1].map(|axis| place[axis] - zero[axis] - shift[axis] - tool[axis])
    }

    /// Executes G68.
    pub(super) fn rotate(
        &mut self,
        block: &mut Block,
        words: [Option<f64>; 3],
    ) -> Result<(), Problem> {
        let wrong = |problem: &str, allowed: &str| Err(Problem::new("G68", problem, allowed));
        if self.modal.plane != Plane::Xy {
            return wrong("outside of G17", "a rotation in the X-Y plane");
        }
        if self.modal.relative {
            return wrong("under G91, of which controls differ", "G68 under G90");
        }
        let centre = match words {
            [Some(x), Some(y), None] => [x, y],
            [None, None, None] if self.rotation.turn.is_none() => {
                let [x, y, _] = self.here();
                [x, y]
            }
            _ => {
                let problem = "without a centre by X and Y";
                return wrong(problem, "X and Y, or neither where no G68 is in force");
            }
        };
        let Some(degrees) = block.take(b'R') else {
            return wrong("without an angle", "R with the angle in degrees");
        };
        if degrees.abs() > 360.0 {
            let problem = format!("an angle of {degrees} degrees");
            return Err(Problem::new("R", problem, "-360 to 360"));
        }
        self.rotation.turn = Some(Turn { centre, degrees });
        self.rotation.unsettled = Some((68, 0));
        Ok(())
    }

    /// Executes G69.
    pub(super) fn end_rotation(&mut self) {
        if self.rotation.turn.take().is_some() {
            self.rotation.unsettled = Some((69, 0));
        }
    }

    /// Returns an error for words that controls reject or interpret differently under G68 and just
    /// after it.
    pub(super) fn fits_rotation(&self, words: &Words, system: bool) -> Result<(), Problem> {
        if self.rotation.turn.is_none() {
            return Ok(());
        }
        let own = words.own.filter(|(_, own)| *own != Own::Turn);
        let field = match own {
            Some((code, _)) => name('G', code),
            None if words.machine => "G53".to_owned(),
            None if system => "G54 to G59.3".to_owned(),
            None if self.modal.plane != Plane::Xy => "G18, G19".to_owned(),
            None => return Ok(()),
        };
        Err(Problem::new(field, "under G68", "G69 before"))
    }

    /// Requires the first move after G68 or G69 to give its full position.
    pub(super) fn settle(&mut self, block: &Block, motion: Motion) -> Result<(), Problem> {
        self.rotation.began = self.at;
        let Some(code) = self.rotation.unsettled else {
            return Ok(());
        };
        let [x, y, _] = block.axes().map(|word| word.is_some());
        let bends = !matches!(motion, Motion::Rapid | Motion::Line | Motion::Probe)
            && !matches!(motion, Motion::Cycle(_));
        match (x, y) {
            (false, false) if !bends => return Ok(()),
            (true, true) if !self.modal.relative => {
                self.rotation.unsettled = None;
                return Ok(());
            }
            // After G68 an increment is rotated, wherever the centre is.
            _ if self.modal.relative && code == (68, 0) && (x || y) => return Ok(()),
            _ => {}
        }
        let problem = format!("the first move behind {}", name('G', code));
        let allowed = "X and Y under G90";
        Err(Problem::new("X, Y", problem, allowed))
    }

    /// Returns the course of a piece in machine coordinates. A full circle ends where it begins,
    /// despite rounding.
    pub(super) fn turned_piece(&mut self, to: Point, course: Course) -> (Point, Course) {
        let from = std::mem::replace(&mut self.rotation.began, to);
        if !self.is_turned() {
            return (to, course);
        }
        let mut end = self.turned(to);
        let course = match course {
            Course::Line => course,
            Course::Arc {
                centre: [x, y],
                clockwise,
            } => {
                if from[..2] == to[..2] {
                    let [x, y, _] = self.track.here();
                    end = [x, y, end[2]];
                }
                let [x, y, _] = self.turned([x, y, 0.0]);
                Course::Arc {
                    centre: [x, y],
                    clockwise,
                }
            }
            Course::Spline { controls } => Course::Spline {
                controls: controls.map(|control| self.turned(control)),
            },
        };
        (end, course)
    }
}
