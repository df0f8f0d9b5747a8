//! Drilling cycles as moves.

use super::block::Block;
use super::machine::{Machine, Piece};
use super::modal::Plane;
use super::problem::Problem;
use crate::input::{Course, Point};
use crate::settings::tidy;

/// How far G73 lifts, and how far above the last depth G83 stops its rapid, in millimetres.
const LIFT_MM: f64 = 0.254;

/// The most pecks of one hole.
const PECKS: f64 = 1.0e4;

/// What a cycle keeps from line to line, from the machine's zero, in millimetres.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Cycle {
    /// Z before the first hole, where G98 ends.
    initial: f64,
    r: Option<f64>,
    z: Option<f64>,
    q: Option<f64>,
}

impl Cycle {
    pub(super) fn from(initial: f64) -> Self {
        Self {
            initial,
            ..Self::default()
        }
    }
}

impl Machine<'_> {
    /// Drills the holes of a line; says how many.
    pub(super) fn drill(
        &mut self,
        line: usize,
        block: &mut Block,
        code: u32,
    ) -> Result<u64, Problem> {
        let field = format!("G{code}");
        if self.modal.plane != Plane::Xy {
            return Err(Problem::new(
                field,
                "outside of G17",
                "cycles in the X-Y plane",
            ));
        }
        let units = self.modal.mm_per_unit;
        let [x, y, z] = block.axes().map(|word| word.map(|word| word * units));
        let zero = self.zero();
        let relative = self.modal.relative;
        if let Some(r) = block.take(b'R') {
            let from = if relative {
                self.cycle.initial
            } else {
                zero[2]
            };
            self.cycle.r = Some(from + r * units);
        }
        let Some(r) = self.cycle.r else {
            return Err(Problem::new(field, "without R", "R with the first hole"));
        };
        if let Some(z) = z {
            self.cycle.z = Some(if relative { r + z } else { zero[2] + z });
        }
        let Some(bottom) = self.cycle.z else {
            return Err(Problem::new(field, "without Z", "Z with the first hole"));
        };
        if bottom > r {
            let problem = format!("R is below Z by {} mm", tidy(bottom - r));
            return Err(Problem::new(field, problem, "R at Z or above"));
        }
        if let (73 | 83, Some(q)) = (code, block.letter(b'Q')) {
            block.take(b'Q');
            self.cycle.q = Some(q * units);
        }
        // A dwell says nothing about the path.
        block.take(b'P');
        let times = block.take(b'L').or_else(|| block.take(b'K')).unwrap_or(1.0);
        if !(0.0..=1.0e6).contains(&times) || times.fract() != 0.0 {
            return Err(Problem::new("L", format!("is {times}"), "0 to 1000000"));
        }
        let step = match (code, self.cycle.q) {
            (73 | 83, Some(q)) if q > 0.0 && (r - bottom) / q <= PECKS => q,
            (73 | 83, _) => {
                let problem = "without a Q that fits the depth";
                return Err(Problem::new(
                    field,
                    problem,
                    "Q above 0, at most 10000 pecks",
                ));
            }
            _ => f64::INFINITY,
        };
        if !self.modal.end_chosen {
            let text = || "neither G98 nor G99: the cycle ends at R, as by G99".to_owned();
            self.note("cycle", line, text);
        }
        self.made_by(field);
        let mut count = 0;
        for _ in 0..times as u64 {
            let [mut hole_x, mut hole_y, top] = self.at;
            for (place, word, zero) in [(&mut hole_x, x, zero[0]), (&mut hole_y, y, zero[1])] {
                if let Some(word) = word {
                    *place = if relative { *place + word } else { zero + word };
                }
            }
            if top < r {
                self.straight([self.at[0], self.at[1], r], true);
            }
            let level = self.at[2];
            self.straight([hole_x, hole_y, level], true);
            self.straight([hole_x, hole_y, r], true);
            let down = |z: f64| [hole_x, hole_y, z];
            let mut depth = r;
            while depth - step > bottom {
                depth -= step;
                self.straight(down(depth), false);
                let lift = LIFT_MM.min(r - depth);
                if code == 83 {
                    self.straight(down(r), true);
                }
                self.straight(down(depth + lift), true);
            }
            self.straight(down(bottom), false);
            // Boring and tapping leave at the feed.
            let slow = matches!(code, 84 | 85 | 89);
            self.straight(down(r), !slow);
            if !self.modal.ends_at_r && self.cycle.initial > r {
                self.straight(down(self.cycle.initial), true);
            }
            count += 1;
            self.not_too_many()?;
        }
        Ok(count)
    }

    /// A straight piece to a point.
    pub(super) fn straight(&mut self, to: Point, rapid: bool) {
        let mut squares = 0.0;
        for (from, to) in self.at.iter().zip(to) {
            squares += (to - from) * (to - from);
        }
        self.pieces.push(Piece {
            to,
            course: Course::Line,
            rapid,
            length: if rapid { 0.0 } else { squares.sqrt() },
        });
        self.at = to;
    }
}
