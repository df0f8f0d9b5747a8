//! Motion of a line: lines, arcs and curves.

use std::f64::consts::TAU;

use super::block::Block;
use super::chords;
use super::machine::{Machine, Piece, Words};
use super::modal::{Motion, Plane};
use super::problem::Problem;
use super::{G_MOTIONS, arc};
use crate::input::{Course, Point, ZERO_MM};

const FORMS: &str = "either I and J (the centre from the start) or R (the radius)";

/// Greatest number of turns of an arc.
const TURNS: f64 = 1.0e4;

/// Greatest number of moves of one line.
const MOST_PIECES: usize = 1_000_000;

impl Machine<'_> {
    /// Makes the move of a line, if there is one; returns the number of additional lines that it
    /// counts for.
    pub(super) fn motion(
        &mut self,
        line: usize,
        block: &mut Block,
        words: &Words,
    ) -> Result<u64, Problem> {
        let explicit = words.motion.is_some();
        // The time of a dwell is P or, on some controls, X.
        if words.dwell && block.take(b'P').is_none() && !explicit {
            block.take(b'X');
            if block.moves() || bends(block) {
                let problem = "a dwell and a move in one line";
                return Err(Problem::new("G4", problem, "G4 with P, or with X alone"));
            }
        }
        self.not_within_nurbs(words)?;
        let moves = block.moves();
        let motion = self.modal.motion;
        if let Some(motion @ (Motion::Nurbs | Motion::NurbsEnd | Motion::KnottedNurbs)) = motion
            && (moves || explicit || block.given().next().is_some())
        {
            self.cartesian(block, words, motion)?;
            self.settle(block, motion)?;
            self.made_by(motion.name());
            let to = self.target(block, false);
            self.nurbs(line, block, to, motion)?;
            self.leftover(block)?;
            return self.made(block, None);
        }
        let arc = matches!(motion, Some(Motion::Arc { .. }));
        if words.own.is_some() && !moves {
            return self.leftover(block);
        }
        let drills = matches!(motion, Some(Motion::Cycle(_))) && explicit;
        if !(moves || bends(block) || (arc && explicit) || drills) {
            return self.leftover(block);
        }
        let Some(motion) = motion else {
            let problem = "no G0, G1, G2 or G3 in force";
            return Err(Problem::new("X, Y, Z", problem, G_MOTIONS).following());
        };
        if words.machine && !matches!(motion, Motion::Rapid | Motion::Line) {
            return Err(Problem::new(
                "G53",
                "without G0 or G1",
                "G53 with G0 and G1",
            ));
        }
        self.cartesian(block, words, motion)?;
        self.settle(block, motion)?;
        self.made_by(motion.name());
        if !matches!(motion, Motion::Cubic) {
            self.last_control = None;
        }
        let mut holes = None;
        match motion {
            Motion::Cycle(code) => holes = Some(self.drill(line, block, code)?),
            _ => {
                let (from, to) = (self.at, self.target(block, words.machine));
                if !matches!(motion, Motion::Cubic | Motion::Quadratic) {
                    self.move_w(block, words.machine);
                }
                match motion {
                    Motion::Arc { clockwise } => self.arc(line, block, to, clockwise)?,
                    Motion::Cubic | Motion::Quadratic => {
                        self.spline(line, block, from, to, motion)?;
                    }
                    _ if bends(block) => {
                        let problem = format!("with {}", motion.name());
                        let allowed = "I, J and R with G2 and G3 only";
                        return Err(Problem::new("I, J, R", problem, allowed));
                    }
                    Motion::Probe => {
                        let text = || "G38: moves to its end, nothing is touched".to_owned();
                        self.note("G38", line, text);
                        self.straight(to, false);
                    }
                    _ => self.straight(to, motion == Motion::Rapid),
                }
            }
        }
        self.made(block, holes)
    }

    /// Checks the moves that a line has made.
    fn made(&mut self, block: &mut Block, holes: Option<u64>) -> Result<u64, Problem> {
        if self.modal.inverse_time && self.pieces.iter().any(|piece| !piece.rapid) {
            self.needs_feed()?;
        }
        self.leftover(block)?;
        // Holes and chords count as separate lines.
        Ok(holes.unwrap_or_else(|| (self.pieces.len() as u64).saturating_sub(1)))
    }

    /// Returns the end of a line from its axis words.
    fn target(&self, block: &Block, machine: bool) -> Point {
        let zero = if machine { [0.0; 3] } else { self.zero() };
        let mut to = if machine {
            self.turned(self.at)
        } else {
            self.at
        };
        for ((to, word), zero) in to.iter_mut().zip(block.axes()).zip(zero) {
            if let Some(word) = word.map(|word| word * self.modal.mm_per_unit) {
                let relative = self.modal.relative && !machine;
                *to = if relative { *to + word } else { zero + word };
            }
        }
        if machine { self.unturned(to) } else { to }
    }

    /// Returns an error for words that no instruction of the line has used.
    fn leftover(&self, block: &Block) -> Result<u64, Problem> {
        let mut given = block
            .given()
            .filter(|letter| !matches!(letter, b'X' | b'Y' | b'Z' | b'O'));
        let Some(letter) = given.next() else {
            return Ok(0);
        };
        let allowed = match letter {
            b'P' => "P with G2 to G5, G10, cycles and M words",
            b'Q' => "Q with G5, G64, G73, G83 and M words",
            b'W' => "W with G0 to G3 and G38",
            b'L' => "L with G10, cycles and M words",
            b'I' | b'J' | b'K' | b'R' => "I, J, K and R with arcs, curves and cycles",
            _ => "the letters A B C D E F G H I J K L M N O P Q R S T U V W X Y Z as of RS274",
        };
        let problem = "without a word that it belongs to";
        Err(Problem::new(char::from(letter), problem, allowed))
    }

    fn arc(
        &mut self,
        line: usize,
        block: &mut Block,
        to: Point,
        clockwise: bool,
    ) -> Result<(), Problem> {
        let axes @ [a, b, c] = self.modal.plane.axes();
        let pick = |point: &Point, axis: usize| point.get(axis).copied().unwrap_or(0.0);
        let units = self.modal.mm_per_unit;
        let centre = [b'I', b'J', b'K'].map(|letter| block.take(letter));
        let [first, second, third] = axes.map(|axis| centre.get(axis).copied().flatten());
        let radius = block.take(b'R');
        let turns = block.take(b'P').unwrap_or(1.0);
        if third.is_some_and(|word| word != 0.0) {
            let problem = "a centre outside of the plane";
            return Err(Problem::new(
                "I, J, K",
                problem,
                "the centre in the plane in force",
            ));
        }
        if !(1.0..=TURNS).contains(&turns) || turns.fract() != 0.0 {
            let problem = format!("{turns} turns");
            return Err(Problem::new("P", problem, "1 to 10000 turns"));
        }
        let start = [pick(&self.at, a), pick(&self.at, b)];
        let end = [pick(&to, a), pick(&to, b)];
        let zero = self.zero();
        let place = |word: Option<f64>, axis: usize, start: f64| {
            let word = word.map(|word| word * units);
            match self.modal.centres_absolute {
                true => word.map_or(start, |word| pick(&zero, axis) + word),
                false => start + word.unwrap_or(0.0),
            }
        };
        let centre = match ([first, second], radius) {
            ([None, None], None) => {
                let problem = "an arc without centre or radius";
                return Err(Problem::new("I, J, R", problem, FORMS));
            }
            ([i, j], None) => [place(i, a, start[0]), place(j, b, start[1])],
            ([None, None], Some(radius)) => {
                arc::centre_by_radius(start, end, radius * units, clockwise).map_err(|problem| {
                    let allowed = "half the distance to the end, or more";
                    Problem::new("R", problem, allowed).following()
                })?
            }
            _ => return Err(Problem::new("I, J, R", "a centre and a radius", FORMS)),
        };
        arc::check(start, end, centre, arc::off_mm(units))
            .map_err(|(problem, allowed)| Problem::new("I, J", problem, allowed).following())?;
        // Rounding must not shrink a full circle to nothing.
        let mut end_point = to;
        if (end[0] - start[0]).abs() < ZERO_MM && (end[1] - start[1]).abs() < ZERO_MM {
            let here = match self.is_turned() {
                true => self.at,
                false => self.track.here(),
            };
            for axis in [a, b] {
                if let Some(place) = end_point.get_mut(axis) {
                    *place = pick(&here, axis);
                }
            }
        }
        let angle = chords::angle(start, end, centre, clockwise);
        let whole = (angle + (turns - 1.0) * TAU.copysign(angle)).abs();
        let (rise, size) = (
            pick(&to, c) - pick(&self.at, c),
            (start[0] - centre[0]).hypot(start[1] - centre[1]),
        );
        let at = self.at;
        for turn in 1..=turns as u64 {
            let last = turn as f64 == turns;
            let mut to = if last { end_point } else { self.at };
            let turned = if last { angle } else { TAU.copysign(angle) };
            if let (false, Some(place)) = (last, to.get_mut(c)) {
                *place = pick(&at, c) + rise * (turn as f64 * TAU / whole);
            }
            self.turn(line, to, centre, (clockwise, turned, size), axes);
            self.not_too_many()?;
        }
        self.at = to;
        Ok(())
    }

    /// Adds at most one turn of an arc: as an arc in the X-Y plane, as chords in the others.
    fn turn(
        &mut self,
        line: usize,
        to: Point,
        centre: [f64; 2],
        (clockwise, angle, size): (bool, f64, f64),
        axes: [usize; 3],
    ) {
        if self.modal.plane == Plane::Xy {
            let rise = to[2] - self.at[2];
            self.pieces.push(Piece {
                to,
                course: Course::Arc { centre, clockwise },
                rapid: false,
                length: (size * angle).hypot(rise),
            });
            self.at = to;
            return;
        }
        self.say_chords(line);
        let mut ends = Vec::new();
        chords::arc(self.at, to, centre, angle, axes, |end| ends.push(end));
        for end in ends {
            self.straight(end, false);
        }
    }

    /// Checks the number of moves of one line.
    pub(super) fn not_too_many(&self) -> Result<(), Problem> {
        if self.pieces.len() <= MOST_PIECES {
            return Ok(());
        }
        let problem = format!("more than {MOST_PIECES} moves of one line");
        Err(Problem::new(
            self.made_by.clone(),
            problem,
            "fewer turns or holes",
        ))
    }

    pub(super) fn say_chords(&mut self, line: usize) {
        let off = chords::OFF_MM;
        let text = || format!("arcs outside of G17, and splines, are chords within {off} mm");
        self.note("chords", line, text);
    }

    /// Executes G5 and G5.1.
    fn spline(
        &mut self,
        line: usize,
        block: &mut Block,
        from: Point,
        to: Point,
        motion: Motion,
    ) -> Result<(), Problem> {
        let field = motion.name();
        let units = self.modal.mm_per_unit;
        if self.modal.plane != Plane::Xy || block.letter(b'Z').is_some() {
            let problem = "with Z, or outside of G17";
            return Err(Problem::new(field, problem, "curves in the X-Y plane"));
        }
        let mut pair =
            |letters: [u8; 2]| letters.map(|letter| block.take(letter).map(|word| word * units));
        let first = pair([b'I', b'J']);
        let ([x, y, z], [end_x, end_y, _]) = (from, to);
        let [one, other] = if motion == Motion::Cubic {
            let first = match (first, self.last_control) {
                ([None, None], Some([p, q])) => [Some(-p), Some(-q)],
                _ => first,
            };
            let ([Some(i), Some(j)], [Some(p), Some(q)]) = (first, pair([b'P', b'Q'])) else {
                let problem = "without its control points";
                let allowed = "I, J, P and Q; behind another G5 P and Q";
                return Err(Problem::new(field, problem, allowed).following());
            };
            self.last_control = Some([p, q]);
            [[x + i, y + j], [end_x + p, end_y + q]]
        } else {
            let [i, j] = first.map(|word| word.unwrap_or(0.0));
            if i == 0.0 && j == 0.0 {
                let problem = "without its control point";
                return Err(Problem::new(field, problem, "I and J, not both 0"));
            }
            let control = [x + i, y + j];
            let towards = |[x, y]: [f64; 2]| {
                let part = 2.0 / 3.0;
                [x + (control[0] - x) * part, y + (control[1] - y) * part]
            };
            [towards([x, y]), towards([end_x, end_y])]
        };
        let mut ends = Vec::new();
        let points = [[x, y], one, other, [end_x, end_y]];
        chords::cubic(points, |[x, y]| ends.push([x, y, z]));
        if self.splines {
            let mut at = from;
            let lengths = ends.into_iter().map(|end| {
                let [a, b, _] = std::mem::replace(&mut at, end);
                (end[0] - a).hypot(end[1] - b)
            });
            let length = lengths.sum();
            let controls = [one, other].map(|[x, y]| [x, y, z]);
            self.pieces.push(Piece {
                to,
                course: Course::Spline { controls },
                rapid: false,
                length,
            });
            self.at = to;
            return Ok(());
        }
        self.say_chords(line);
        for end in ends {
            self.straight(end, false);
        }
        Ok(())
    }
}

fn bends(block: &Block) -> bool {
    let given = |letter| block.letter(letter).is_some();
    [b'I', b'J', b'K', b'R'].into_iter().any(given)
}
