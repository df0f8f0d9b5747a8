//! Coordinate systems, offsets and reference points.

use super::block::{Block, Code, name};
use super::frame::sin_cos;
use super::machine::{Machine, Piece};
use super::problem::Problem;
use crate::input::{Course, Point, Zeros};

/// Instruction that takes the axis words for itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Own {
    /// G10.
    Set,
    /// G28 and G30.
    Go(usize),
    /// G28.1 and G30.1.
    Keep(usize),
    /// G92.
    Shift,
    /// G43.1.
    Length,
    /// G68.
    Turn,
    /// G52.
    Local,
    /// G92.1.
    Forget,
    /// G92.2.
    Suspend,
    /// G92.3.
    Resume,
}

/// Zeros in machine coordinates, in millimetres.
#[derive(Debug)]
pub(super) struct Offsets {
    zeros: Zeros,
    /// Angles of the systems in degrees.
    rotations: [f64; 9],
    shift: Point,
    /// Offset suspended by G92.2.
    suspended: Point,
}

impl Offsets {
    pub(super) fn new(zeros: Zeros) -> Self {
        Self {
            zeros,
            rotations: [0.0; 9],
            shift: Point::default(),
            suspended: Point::default(),
        }
    }

    pub(super) fn system(&self, number: usize) -> Point {
        self.zeros.systems.get(number).copied().unwrap_or_default()
    }

    /// Returns the angle of a system by G10 L2 R, in degrees.
    pub(super) fn rotation(&self, number: usize) -> f64 {
        self.rotations.get(number).copied().unwrap_or_default()
    }

    pub(super) fn shift(&self) -> Point {
        self.shift
    }

    pub(super) fn reference(&self, number: usize) -> Point {
        self.zeros
            .references
            .get(number)
            .copied()
            .unwrap_or_default()
    }
}

impl Machine<'_> {
    /// Returns the zero of the program from the machine's.
    pub(super) fn zero(&self) -> Point {
        let system = self.offsets.system(self.modal.system);
        let mut zero = self.offsets.shift;
        for ((zero, system), tool) in zero.iter_mut().zip(system).zip(self.modal.tool) {
            *zero += system + tool;
        }
        zero
    }

    /// Returns the programmed position from the program's zero, in millimetres.
    pub(super) fn here(&self) -> Point {
        let mut here = self.at;
        for (here, zero) in here.iter_mut().zip(self.zero()) {
            *here -= zero;
        }
        here
    }

    /// Executes an instruction that takes the axis words for itself, and removes them.
    pub(super) fn own(
        &mut self,
        line: usize,
        block: &mut Block,
        (code, own): (Code, Own),
        moves: bool,
    ) -> Result<(), Problem> {
        let axes = block.axes();
        // The axis words belong to it, not to a motion.
        let takes = !matches!(own, Own::Forget | Own::Suspend | Own::Resume | Own::Keep(_));
        if takes && block.letter(b'W').is_some() {
            let problem = format!("with {}", name('G', code));
            return Err(Problem::new('W', problem, "X, Y and Z: W has no offsets"));
        }
        if moves && takes {
            // G0 G28 X0 is common; G28 makes the move.
            if !matches!(own, Own::Go(_) | Own::Shift | Own::Set) {
                let problem = "together with a motion in one line";
                return Err(Problem::new(name('G', code), problem, "a line of its own"));
            }
        }
        if takes && block.is_polar() {
            let problem = format!("with {}", name('G', code));
            return Err(Problem::new(
                "@, ^",
                problem,
                "polar coordinates with motions",
            ));
        }
        let words = axes.map(|word| word.map(|word| word * self.modal.mm_per_unit));
        let given = words.iter().any(Option::is_some);
        match own {
            Own::Set => self.set_offsets(line, block, words)?,
            Own::Go(number) => self.go_home(block, number, words, name('G', code))?,
            Own::Turn => self.rotate(block, words)?,
            Own::Length => {
                if let Some(h) = block.letter(b'H') {
                    let problem = format!("{h} with G43.1");
                    return Err(Problem::new('H', problem, "X, Y and Z with G43.1; G43 H"));
                }
                for (tool, word) in self.modal.tool.iter_mut().zip(words) {
                    *tool = word.unwrap_or(*tool);
                }
            }
            Own::Keep(number) => {
                let at = self.turned(self.at);
                if let Some(place) = self.offsets.zeros.references.get_mut(number) {
                    *place = at;
                }
            }
            Own::Shift if !given => {
                let system = self.offsets.system(self.modal.system);
                let places = self.offsets.shift.iter_mut().zip(self.at).zip(system);
                let places = places.zip(self.modal.tool);
                // Printers reset their extruder with G92 E0; G92 alone applies to all axes.
                if block.given().next().is_none() && !block.extruder {
                    for (((shift, at), system), tool) in places {
                        *shift = at - system - tool;
                    }
                }
            }
            Own::Shift => {
                let system = self.offsets.system(self.modal.system);
                let places = self.offsets.shift.iter_mut().zip(self.at).zip(system);
                let places = places.zip(self.modal.tool);
                for ((((shift, at), system), tool), word) in places.zip(words) {
                    if let Some(word) = word {
                        *shift = at - system - tool - word;
                    }
                }
            }
            Own::Local => {
                for (shift, word) in self.offsets.shift.iter_mut().zip(words) {
                    *shift = word.unwrap_or(*shift);
                }
            }
            Own::Forget => {
                self.offsets.shift = [0.0; 3];
                self.offsets.suspended = [0.0; 3];
            }
            Own::Suspend => {
                self.offsets.suspended = std::mem::take(&mut self.offsets.shift);
            }
            Own::Resume => self.offsets.shift = self.offsets.suspended,
        }
        if takes {
            for letter in [b'X', b'Y', b'Z'] {
                block.take(letter);
            }
        }
        Ok(())
    }

    /// Executes G10: offsets of coordinate systems, lengths of tools.
    fn set_offsets(
        &mut self,
        line: usize,
        block: &mut Block,
        words: [Option<f64>; 3],
    ) -> Result<(), Problem> {
        let what = block.take(b'L').unwrap_or(0.0);
        let number = block.take(b'P').unwrap_or(0.0);
        let turn = block.take(b'R');
        if [1.0, 10.0, 11.0, 12.0, 13.0].contains(&what) {
            for letter in [b'I', b'J', b'Q'] {
                block.take(letter);
            }
            return self.set_tool(line, (what, number), words, turn.is_some());
        }
        if what != 2.0 && what != 20.0 {
            let allowed = "L2 and L20; L1, L10 and L11 are skipped";
            return Err(Problem::new("G10", format!("with L{what}"), allowed));
        }
        if turn.is_some() && what == 20.0 {
            return Err(Problem::new("G10 R", "with L20", "R with L2"));
        }
        let system = match number {
            0.0 => Some(self.modal.system),
            number => (1..=self.offsets.zeros.systems.len())
                .find(|&n| n as f64 == number)
                .map(|n| n - 1),
        };
        let Some(system) = system else {
            let problem = format!("the coordinate system P{number}");
            return Err(Problem::new("G10 P", problem, "0 to 9"));
        };
        if let (Some(degrees), Some(place)) = (turn, self.offsets.rotations.get_mut(system)) {
            *place = degrees;
        }
        let mut to = self.offsets.system(system);
        if what == 2.0 {
            for (to, word) in to.iter_mut().zip(words) {
                *to = word.unwrap_or(*to);
            }
        } else {
            to = self.zero_by_place(system, to, words);
        }
        if let Some(place) = self.offsets.zeros.systems.get_mut(system) {
            *place = to;
        }
        Ok(())
    }

    /// Returns the zero of a system for which the tool is at the given words.
    fn zero_by_place(&self, system: usize, zero: Point, words: [Option<f64>; 3]) -> Point {
        let mut to = zero;
        let places = to.iter_mut().zip(self.turned(self.at)).zip(words);
        let (shift, tool) = (self.offsets.shift, self.modal.tool);
        for (((to, at), word), (shift, tool)) in places.zip(shift.into_iter().zip(tool)) {
            *to = word.map_or(*to, |word| at - (shift + tool) - word);
        }
        let degrees = self.offsets.rotation(system);
        let [x, y, _] = words;
        if degrees != 0.0 && (x.is_some() || y.is_some()) {
            // From the old to the new zero, in machine coordinates.
            let (sin, cos) = sin_cos(degrees);
            let [here_x, here_y] = self.shown_by(system);
            let (dx, dy) = (here_x - x.unwrap_or(here_x), here_y - y.unwrap_or(here_y));
            to[0] = zero[0] + dx * cos - dy * sin;
            to[1] = zero[1] + dx * sin + dy * cos;
        }
        to
    }

    /// Moves to a reference point through the point of the axis words; without any, all axes move
    /// there. A letter without a number is an axis that moves there straight.
    fn go_home(
        &mut self,
        block: &mut Block,
        number: usize,
        words: [Option<f64>; 3],
        by: String,
    ) -> Result<(), Problem> {
        let [x, y, _] = words.map(|word| word.is_some());
        if self.is_turned() && (x != y || block.is_bare(b'X') || block.is_bare(b'Y')) {
            let problem = "with one of X and Y where the coordinates are rotated";
            return Err(Problem::new(by, problem, "both or none"));
        }
        let zero = self.zero();
        let reference = self.unturned(self.offsets.reference(number));
        let all = words.iter().all(Option::is_none);
        let (mut by_way, mut home) = (self.at, self.at);
        let letters = [b'X', b'Y', b'Z'];
        let bare = |axis: usize| letters.get(axis).is_some_and(|&of| block.is_bare(of));
        for axis in 0..3 {
            let (Some(way), Some(home)) = (by_way.get_mut(axis), home.get_mut(axis)) else {
                continue;
            };
            let at = |point: &Point| point.get(axis).copied().unwrap_or(0.0);
            if let Some(word) = words.get(axis).copied().flatten() {
                if !bare(axis) {
                    let from = if self.modal.relative { *way } else { at(&zero) };
                    *way = from + word;
                }
            } else if !all {
                continue;
            }
            *home = at(&reference);
        }
        let rapid = |to| Piece {
            to,
            course: Course::Line,
            rapid: true,
            length: 0.0,
        };
        if !all {
            self.pieces.push(rapid(by_way));
        }
        self.pieces.push(rapid(home));
        self.at = home;
        self.made_by(by);
        block.clear_bare();
        Ok(())
    }
}
