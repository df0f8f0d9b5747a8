//! Polar coordinates: X and Y under G16, and the words `@` and `^`.

use super::block::Block;
use super::frame::sin_cos;
use super::machine::{Machine, Words};
use super::modal::{Motion, Plane};
use super::problem::Problem;

/// Radius and angle, if given.
pub(super) type Polar = [Option<f64>; 2];

impl Machine<'_> {
    /// Converts polar words to Cartesian ones; a cycle keeps its `@` and `^`.
    pub(super) fn cartesian(
        &mut self,
        block: &mut Block,
        words: &Words,
        motion: Motion,
    ) -> Result<(), Problem> {
        if block.is_polar() {
            return self.by_polar_words(block, words, motion);
        }
        let (x, y) = (block.letter(b'X'), block.letter(b'Y'));
        let centre = [b'I', b'J'].iter().any(|&of| block.letter(of).is_some());
        let Some(kept) = self.polar else {
            return Ok(());
        };
        let wrong = |problem: &str, allowed: &str| Err(Problem::new("G16", problem, allowed));
        match motion {
            Motion::Rapid | Motion::Line | Motion::Probe | Motion::Cycle(_) => {}
            Motion::Arc { .. } if !centre => {}
            _ => return wrong("with I and J, or a curve", "G0, G1, arcs by R, and cycles"),
        }
        if x.is_none() && y.is_none() {
            return Ok(());
        }
        if self.modal.relative || words.machine {
            return wrong(
                "with G91 or G53",
                "a radius and an angle from the zero in force",
            );
        }
        if self.modal.plane != Plane::Xy {
            return wrong("outside of G17", "polar coordinates in the X-Y plane");
        }
        let [Some(radius), Some(angle)] = [x.or(kept[0]), y.or(kept[1])] else {
            return wrong(
                "without its radius or angle",
                "X and Y with the first move behind G16",
            );
        };
        self.polar = Some([Some(radius), Some(angle)]);
        let (sin, cos) = sin_cos(angle);
        block.place(b'X', radius * cos);
        block.place(b'Y', radius * sin);
        Ok(())
    }

    fn by_polar_words(
        &mut self,
        block: &mut Block,
        words: &Words,
        motion: Motion,
    ) -> Result<(), Problem> {
        let wrong = |problem: &str, allowed: &str| Err(Problem::new("@, ^", problem, allowed));
        let [x, y, _] = block.axes().map(|word| word.is_some());
        if x || y || words.machine || self.polar.is_some() {
            return wrong("with X, Y, G16 or G53", "a radius and an angle");
        }
        let plain = matches!(
            motion,
            Motion::Rapid | Motion::Line | Motion::Probe | Motion::Arc { .. } | Motion::Cycle(_)
        );
        if self.modal.plane != Plane::Xy || !plain {
            return wrong(
                "outside of G17, or with a curve",
                "polar coordinates in the X-Y plane",
            );
        }
        if let Motion::Cycle(_) = motion {
            return Ok(());
        }
        let [here_x, here_y, _] = self.here();
        let [x, y] = self.polar_to([here_x, here_y], block.take_polar())?;
        let units = self.modal.mm_per_unit;
        let [from_x, from_y] = if self.modal.relative {
            [here_x, here_y]
        } else {
            [0.0; 2]
        };
        block.place(b'X', (x - from_x) / units);
        block.place(b'Y', (y - from_y) / units);
        Ok(())
    }

    /// Returns the point that `@` and `^` give from another one, as in LinuxCNC: under G91 they
    /// are increments, and a missing one is unchanged. All points are in millimetres from the
    /// program's zero.
    pub(super) fn polar_to(&self, [x, y]: [f64; 2], polar: Polar) -> Result<[f64; 2], Problem> {
        let [radius, angle] = polar;
        let whole = radius.is_some() && angle.is_some() && !self.modal.relative;
        if x == 0.0 && y == 0.0 && !whole {
            let problem = "from the zero, where there is no angle";
            return Err(Problem::new("@, ^", problem, "@ and ^ under G90"));
        }
        let radius = radius.map(|radius| radius * self.modal.mm_per_unit);
        let (size, direction) = (x.hypot(y), y.atan2(x).to_degrees());
        let (radius, angle) = match self.modal.relative {
            true => (
                size + radius.unwrap_or(0.0),
                direction + angle.unwrap_or(0.0),
            ),
            false => (radius.unwrap_or(size), angle.unwrap_or(direction)),
        };
        let (sin, cos) = sin_cos(angle);
        Ok([radius * cos, radius * sin])
    }
}
