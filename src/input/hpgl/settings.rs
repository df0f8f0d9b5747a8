//! Coordinate settings: IP, IR, SC, IW, RO, PS.

use super::Plotter;
use super::paper::{self, Turn};
use super::scale::{Corners, DEFAULT_CORNERS, Window};
use crate::input::Fault;

impl Plotter<'_> {
    pub(super) fn input_corners(&mut self) -> Result<(), Fault> {
        let corners = match *self.parameters(&[0, 2, 4])? {
            [x1, y1, x2, y2] => Corners {
                p1: [x1, y1],
                p2: [x2, y2],
            },
            [x1, y1] => self.moved_corners([x1, y1]),
            _ => DEFAULT_CORNERS,
        };
        self.set_corners(corners)
    }

    /// Sets P1 and P2 as percentages of the paper's size (IR).
    pub(super) fn input_relative_corners(&mut self) -> Result<(), Fault> {
        let size = self.paper.size();
        let on = |axis: usize, percent: f64| size[axis] * percent / 100.0;
        let corners = match *self.parameters(&[0, 2, 4])? {
            [x1, y1, x2, y2] => Corners {
                p1: [on(0, x1), on(1, y1)],
                p2: [on(0, x2), on(1, y2)],
            },
            [x1, y1] => self.moved_corners([on(0, x1), on(1, y1)]),
            _ => Corners {
                p1: [0.0; 2],
                p2: size,
            },
        };
        self.set_corners(corners)
    }

    /// Returns the corners with P1 moved and P2 at the same distance from it.
    fn moved_corners(&self, p1: [f64; 2]) -> Corners {
        let [x, y] = self.corners.span();
        Corners {
            p1,
            p2: [p1[0] + x, p1[1] + y],
        }
    }

    fn set_corners(&mut self, corners: Corners) -> Result<(), Fault> {
        let mut pairs = corners.p1.iter().zip(&corners.p2);
        if pairs.any(|(p1, p2)| p1 == p2) {
            let allowed = "P1 and P2 that differ in X and in Y";
            return Err(self
                .lexer
                .fault("P1 and P2 leave no area between them", allowed));
        }
        self.corners = corners;
        self.rescale();
        Ok(())
    }

    pub(super) fn set_window(&mut self) -> Result<(), Fault> {
        let numbers = self.parameters(&[0, 4, 5, 7])?;
        let (x, y, isotropic) = match *numbers {
            [] => {
                self.window = None;
                self.rescale();
                return Ok(());
            }
            [x1, x2, y1, y2] | [x1, x2, y1, y2, 0.0] => ([x1, x2], [y1, y2], None),
            [x1, x2, y1, y2, 1.0] => ([x1, x2], [y1, y2], Some([50.0, 50.0])),
            [x1, x2, y1, y2, 1.0, left, bottom] => ([x1, x2], [y1, y2], Some([left, bottom])),
            [x, x_factor, y, y_factor, 2.0] => {
                return self.set_factors([x, y], [x_factor, y_factor]);
            }
            [_, _, _, _, kind, ..] => {
                let allowed = "0 (anisotropic) or 2 (factors), both without further parameters, or \
                               1 (isotropic)";
                return Err(self.lexer.fault(format!("scaling of type {kind}"), allowed));
            }
            _ => {
                return Err(self
                    .lexer
                    .fault("too few parameters", "4, 5 or 7 parameters"));
            }
        };
        for (axis, [first, last]) in [("X", x), ("Y", y)] {
            if first == last {
                let problem = format!("{axis} runs from {first} to {last}");
                return Err(self
                    .lexer
                    .fault(problem, "a minimum and a maximum that differ"));
            }
        }
        for share in isotropic.into_iter().flatten() {
            if !(0.0..=100.0).contains(&share) {
                let problem = format!("{share} % of the room left over");
                return Err(self.lexer.fault(problem, "0 to 100 %"));
            }
        }
        self.window = Some(Window::Ranges {
            x,
            y,
            isotropic: isotropic.map(|shares: [f64; 2]| shares.map(|share| share / 100.0)),
        });
        self.rescale();
        Ok(())
    }

    fn set_factors(&mut self, p1: [f64; 2], factors: [f64; 2]) -> Result<(), Fault> {
        if factors.contains(&0.0) {
            let allowed = "factors of plotter units a user unit other than 0";
            return Err(self.lexer.fault("a factor of 0", allowed));
        }
        self.window = Some(Window::Factors { p1, factors });
        self.rescale();
        Ok(())
    }

    /// Sets the window outside of which nothing is drawn; its corners are in user units.
    pub(super) fn clip(&mut self) -> Result<(), Fault> {
        let window = match *self.parameters(&[0, 4])? {
            [x1, y1, x2, y2] => {
                let [first, second] =
                    [[x1, y1], [x2, y2]].map(|corner| self.scale.to_plotter(corner));
                Some(paper::Window::between(first, second))
            }
            _ => None,
        };
        self.paper.set_window(window);
        Ok(())
    }

    pub(super) fn rotate(&mut self) -> Result<(), Fault> {
        let turn = match self.parameters(&[0, 1])?.first().copied() {
            None | Some(0.0) => Turn::None,
            Some(90.0) => Turn::Quarter,
            Some(180.0) => Turn::Half,
            Some(270.0) => Turn::ThreeQuarters,
            Some(angle) => {
                let problem = format!("a turn of {angle} degrees");
                return Err(self.lexer.fault(problem, "0, 90, 180 or 270"));
            }
        };
        self.turn(turn);
        Ok(())
    }

    /// Rotates the coordinates. The pen keeps its position on the paper; P1, P2 and the window
    /// keep their coordinates.
    pub(super) fn turn(&mut self, turn: Turn) {
        let here = self.here();
        let [new, carriage] = self.paper.turn(turn, [here, self.text.carriage]);
        // Without a rotation not even the rounding changes.
        if new != here {
            self.at = self.scale.to_user(new);
        }
        self.text.carriage = carriage;
    }

    /// Sets the size of the paper, which rotations and IR use. P1 and P2 stay.
    pub(super) fn plot_size(&mut self) -> Result<(), Fault> {
        let line = self.lexer.start();
        match *self.parameters(&[0, 1, 2])? {
            // On the HP 7475A, one number, 0 to 127, chooses one of two sizes.
            [] | [_] => self.note("PS", line, || "PS: skipped".to_owned()),
            [length, width] if length > 0.0 && width > 0.0 => {
                self.turn(Turn::None);
                self.paper.set_page([length, width]);
            }
            _ => {
                return Err(self
                    .lexer
                    .fault("paper without a size", "two sizes above 0"));
            }
        }
        Ok(())
    }
}
