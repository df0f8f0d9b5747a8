//! Conversion of drilling cycles into moves.

use super::block::Block;
use super::machine::{Machine, Piece};
use super::modal::Plane;
use super::problem::Problem;
use crate::input::{Course, Point};
use crate::settings::tidy;

/// Lift of G73, and distance above the last depth at which the rapid of G83 stops, in millimetres.
const LIFT_MM: f64 = 0.254;

/// Greatest number of pecks of one hole.
const PECKS: f64 = 1.0e4;

/// Modal values of a cycle along its drilling axis, from the machine's zero, in millimetres.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Cycle {
    /// Position before the first hole, where G98 ends.
    initial: f64,
    r: Option<f64>,
    bottom: Option<f64>,
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
    /// Drills the holes of a line; returns their number.
    pub(super) fn drill(
        &mut self,
        line: usize,
        block: &mut Block,
        code: u32,
    ) -> Result<u64, Problem> {
        let field = format!("G{code}");
        // LinuxCNC's interpreter mixes up the axes in this case.
        if code == 84 && self.modal.plane != Plane::Xy {
            let problem = "outside of G17, where controls differ";
            return Err(Problem::new(field, problem, "tapping in the X-Y plane"));
        }
        let axes @ [_, _, along] = self.modal.plane.axes();
        let units = self.modal.mm_per_unit;
        let words = block.axes().map(|word| word.map(|word| word * units));
        let zero = self.zero();
        let pick = |point: &Point, axis: usize| point.get(axis).copied().unwrap_or(0.0);
        let polar = block.take_polar();
        let relative = self.modal.relative;
        if let Some(r) = block.take(b'R') {
            let from = if relative {
                self.cycle.initial
            } else {
                pick(&zero, along)
            };
            self.cycle.r = Some(from + r * units);
        }
        let Some(r) = self.cycle.r else {
            return Err(Problem::new(field, "without R", "R with the first hole"));
        };
        let letter = ["X", "Y", "Z"].get(along).copied().unwrap_or_default();
        if let Some(depth) = words.get(along).copied().flatten() {
            let from = if relative { r } else { pick(&zero, along) };
            self.cycle.bottom = Some(from + depth);
        }
        let Some(bottom) = self.cycle.bottom else {
            let allowed = format!("{letter} with the first hole");
            return Err(Problem::new(field, format!("without {letter}"), allowed));
        };
        if bottom > r {
            let problem = format!("R is below {letter} by {} mm", tidy(bottom - r));
            return Err(Problem::new(
                field,
                problem,
                format!("R at {letter} or above"),
            ));
        }
        if let (73 | 83, Some(q)) = (code, block.letter(b'Q')) {
            block.take(b'Q');
            self.cycle.q = Some(q * units);
        }
        // A dwell has no effect on the path.
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
            let mut hole = self.at;
            for axis in [axes[0], axes[1]] {
                let word = words.get(axis).copied().flatten();
                if let (Some(place), Some(word)) = (hole.get_mut(axis), word) {
                    *place = if relative { *place } else { pick(&zero, axis) } + word;
                }
            }
            if polar.iter().any(Option::is_some) {
                let [x, y, _] = self.here();
                let [x, y] = self.polar_to([x, y], polar)?;
                [hole[0], hole[1]] = [zero[0] + x, zero[1] + y];
            }
            let at_depth = |mut point: Point, depth: f64| {
                if let Some(place) = point.get_mut(along) {
                    *place = depth;
                }
                point
            };
            if pick(&self.at, along) < r {
                self.straight(at_depth(self.at, r), true);
            }
            let level = pick(&self.at, along);
            self.straight(at_depth(hole, level), true);
            let down = |depth: f64| at_depth(hole, depth);
            self.straight(down(r), true);
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

    /// Adds a straight piece to a point.
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
