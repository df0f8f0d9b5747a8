//! Lines and curves: PU, PD, PA, PR, PE, AA, AR, AT, RT, CI, BZ, BR, CT.

use super::Plotter;
use super::curve::{self, Arc, Tolerance};
use super::encoded::Base;
use super::lexer::Mnemonic;
use super::paper::By;
use crate::input::Fault;

impl Plotter<'_> {
    pub(super) fn draw(&mut self, mnemonic: Mnemonic) -> Result<(), Fault> {
        match &mnemonic.0 {
            b"PU" => self.down = false,
            b"PD" => self.down = true,
            b"PA" => self.relative = false,
            _ => self.relative = true,
        }
        let mut moved = false;
        while let Some((point, line)) = self.pair()? {
            let to = self.target(point, self.relative);
            let by = By {
                field: mnemonic.as_str(),
                line,
            };
            self.go(by, to)?;
            moved = true;
            self.draw_symbol(by)?;
        }
        if moved {
            self.mark();
        }
        Ok(())
    }

    fn target(&self, [x, y]: [f64; 2], relative: bool) -> [f64; 2] {
        let [from_x, from_y] = self.at;
        if relative {
            [from_x + x, from_y + y]
        } else {
            [x, y]
        }
    }

    /// Draws an encoded polyline. Its points are relative unless marked; PA and PR stay unchanged.
    pub(super) fn draw_encoded(&mut self, by: By<'_>) -> Result<(), Fault> {
        let mut base = Base::default();
        let mut fraction_bits = 0;
        let (mut up, mut absolute, mut moved) = (false, false, false);
        while let Some((byte, place)) = self.lexer.encoded()? {
            let line = self.lexer.line();
            match byte & 0x7f {
                b':' => {
                    let pen = base.number(&mut self.lexer, None)?;
                    self.select_pen(line, pen as f64)?;
                }
                b'>' => {
                    let bits = base.number(&mut self.lexer, None)?;
                    fraction_bits = i32::try_from(bits)
                        .ok()
                        .filter(|bits| (-26..=26).contains(bits))
                        .ok_or_else(|| {
                            let problem = format!("{bits} bits of fraction");
                            self.lexer.fault_here(problem, "-26 to 26")
                        })?;
                }
                b'<' => up = true,
                b'=' => absolute = true,
                b'7' => base = Base::B32,
                _ => {
                    let x = match base.number(&mut self.lexer, Some(byte)) {
                        Ok(x) => x,
                        // Some programs omit the semicolon before the next instruction.
                        Err(_) if self.lexer.back_to_instruction(place) => {
                            let text = || "PE: ends without a semicolon".to_owned();
                            self.note("PE;", line, text);
                            break;
                        }
                        Err(fault) => return Err(fault),
                    };
                    let y = base.number(&mut self.lexer, None)?;
                    let unit = f64::from(fraction_bits).exp2();
                    let to = self.target([x, y].map(|value| value as f64 / unit), !absolute);
                    self.down = !up;
                    let by = By { line, ..by };
                    self.go(by, to)?;
                    self.draw_symbol(by)?;
                    (up, absolute, moved) = (false, false, true);
                }
            }
        }
        if moved {
            self.mark();
        }
        Ok(())
    }

    pub(super) fn chord_tolerance(&mut self) -> Result<(), Fault> {
        self.tolerance = match *self.parameters(&[0, 1])? {
            [] | [0.0] => Tolerance::Angle,
            [1.0, ..] => Tolerance::Deviation,
            [kind, ..] => {
                let allowed = "0 (chord angles) or 1 (deviations)";
                return Err(self
                    .lexer
                    .fault(format!("{kind} is no kind of tolerance"), allowed));
            }
        };
        Ok(())
    }

    pub(super) fn arc(&mut self, by: By<'_>, relative: bool) -> Result<(), Fault> {
        let numbers = self.parameters(&[3, 4])?;
        let &[x, y, sweep_deg, ..] = numbers.as_slice() else {
            return Ok(());
        };
        let arc = Arc {
            centre: self.target([x, y], relative),
            start: self.at,
            sweep_deg,
        };
        self.draw_arc(by, arc, numbers.get(3).copied())
    }

    pub(super) fn arc_through(&mut self, by: By<'_>, relative: bool) -> Result<(), Fault> {
        let numbers = self.parameters(&[4, 5])?;
        let &[x1, y1, x2, y2, ..] = numbers.as_slice() else {
            return Ok(());
        };
        let between = self.target([x1, y1], relative);
        let end = self.target([x2, y2], relative);
        match Arc::through(self.at, between, end) {
            Some(arc) => self.draw_arc(by, arc, numbers.get(4).copied())?,
            None => {
                self.go(by, between)?;
            }
        }
        // Removes the rounding of the arc.
        if self.at != end {
            self.go(by, end)?;
        }
        self.mark();
        Ok(())
    }

    fn draw_arc(&mut self, by: By<'_>, arc: Arc, chord: Option<f64>) -> Result<(), Fault> {
        let chord_deg = self.tolerance.chord_deg(chord, arc.radius());
        for point in arc.chords(chord_deg) {
            self.paper.count(by, 1)?;
            self.go(by, point)?;
        }
        self.mark();
        Ok(())
    }

    /// Draws a circle about the pen, which returns to the centre in its earlier state. In polygon
    /// mode it is a separate part.
    pub(super) fn circle(&mut self, by: By<'_>) -> Result<(), Fault> {
        let numbers = self.parameters(&[1, 2])?;
        let Some(radius) = numbers.first().copied() else {
            return Ok(());
        };
        let chord_deg = self
            .tolerance
            .chord_deg(numbers.get(1).copied(), radius.abs());
        let circle = Arc::around(self.at, radius, 0.0, 360.0);
        let scale = self.scale;
        let to_plotter = move |point| scale.to_plotter(point);
        let points = std::iter::once(circle.start).chain(circle.chords(chord_deg));
        if self.recording.is_some() {
            self.polygon.close(self.down);
            for point in points.map(to_plotter) {
                self.paper.count(by, 1)?;
                self.polygon.add(point, true);
            }
            self.polygon.close(true);
            return Ok(());
        }
        self.paper.stroke(by, points.map(to_plotter))?;
        self.paper.travel(by, self.here())
    }

    pub(super) fn bezier(&mut self, by: By<'_>, relative: bool) -> Result<(), Fault> {
        while let Some((first, line)) = self.pair()? {
            let by = By { line, ..by };
            let (Some((second, _)), Some((third, _))) = (self.pair()?, self.pair()?) else {
                let problem = "a curve without all of its points";
                let allowed = "two control points and an end for each curve";
                self.forgive(self.lexer.fault(problem, allowed), "the curve is skipped")?;
                break;
            };
            let [first, second, end] =
                [first, second, third].map(|point| self.target(point, relative));
            let points = [self.at, first, second, end];
            let count = curve::bezier_chords(points.map(|point| self.scale.to_plotter(point)));
            for k in 1..count {
                self.paper.count(by, 1)?;
                let part = f64::from(k) / f64::from(count);
                self.go(by, curve::bezier(points, part))?;
            }
            self.go(by, end)?;
        }
        self.mark();
        Ok(())
    }
}
