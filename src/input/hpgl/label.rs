//! Labels, symbols and ticks: LB, BL, PB, CP, SI, SR, DI, DR, SL, LO, DV, ES, SM, UC, XT, YT, TL.

use super::font;
use super::paper::By;
use super::text::{Direction, Frame, Path, Size, add};
use super::{DEFAULT_TICKS, Plotter};
use crate::input::Fault;

const BACKSPACE: u8 = 8;
const TAB: u8 = 9;
const LINE_FEED: u8 = 10;
const VERTICAL_TAB: u8 = 11;
const CARRIAGE_RETURN: u8 = 13;

impl<'a> Plotter<'a> {
    pub(super) fn label(&mut self, by: By<'_>) -> Result<(), Fault> {
        let text = self.lexer.label()?;
        self.write(by, text)
    }

    pub(super) fn buffer_label(&mut self) -> Result<(), Fault> {
        self.text.buffer = self.lexer.label()?;
        Ok(())
    }

    pub(super) fn print_buffer(&mut self, by: By<'_>) -> Result<(), Fault> {
        self.parameters(&[0])?;
        self.write(by, self.text.buffer)
    }

    fn frame(&self) -> Frame {
        self.text.frame(&self.corners)
    }

    /// Writes a label. The pen ends where the next label continues; with an origin that is not at
    /// the label's left end, it ends where the label began.
    fn write(&mut self, by: By<'_>, text: &[u8]) -> Result<(), Fault> {
        let frame = self.frame();
        let path = self.text.path;
        let start = self.here();
        let mut at = start;
        // Each line separately: the origin applies to each.
        for (number, line) in text.split(|&byte| byte == CARRIAGE_RETURN).enumerate() {
            if number > 0 {
                at = self.text.carriage;
            }
            let shift = self.origin_shift(&frame, line);
            at = add(at, shift, 1.0);
            for &byte in line {
                match byte {
                    BACKSPACE => at = add(at, frame.step(path), -1.0),
                    // Half a step back, as on an HP 7475A.
                    TAB => at = add(at, frame.step(path), -0.5),
                    LINE_FEED | VERTICAL_TAB => {
                        let lines = if byte == LINE_FEED { 1.0 } else { -1.0 };
                        at = add(at, frame.feed(path), lines);
                        self.text.carriage = add(self.text.carriage, frame.feed(path), lines);
                    }
                    ..b' ' | 0x7f => {}
                    _ => {
                        self.character(by, &frame, at, byte)?;
                        at = add(at, frame.step(path), 1.0);
                    }
                }
            }
            at = add(at, shift, -1.0);
        }
        let to = if self.ends_at_its_end() { at } else { start };
        self.put(by, to)
    }

    /// Moves the raised pen to a point in plotter units.
    fn put(&mut self, by: By<'_>, to: [f64; 2]) -> Result<(), Fault> {
        self.at = self.scale.to_user(to);
        self.paper.travel(by, to)
    }

    /// True if labels continue where the last one ended, depending on the origin.
    fn ends_at_its_end(&self) -> bool {
        let column = (self.text.origin % 10).saturating_sub(1) / 3;
        match self.text.path {
            Path::Left => column == 2,
            Path::Right | Path::Down | Path::Up => column == 0,
        }
    }

    fn character(
        &mut self,
        by: By<'_>,
        frame: &Frame,
        at: [f64; 2],
        byte: u8,
    ) -> Result<(), Fault> {
        let Some(glyph) = font::glyph(byte) else {
            let text = || "characters that are not in ASCII stay blank in labels".to_owned();
            self.note("character", by.line, text);
            return Ok(());
        };
        for stroke in glyph {
            let points = stroke.iter().map(|&point| frame.point(at, point));
            self.paper.stroke(by, points)?;
        }
        Ok(())
    }

    /// Returns the shift of a label's line for its origin.
    fn origin_shift(&self, frame: &Frame, line: &[u8]) -> [f64; 2] {
        let origin = self.text.origin;
        let place = (origin % 10).saturating_sub(1);
        if origin == 1 || place > 8 {
            return [0.0; 2];
        }
        let letters = line
            .iter()
            .filter(|&&byte| byte >= b' ' && byte != 0x7f)
            .count() as f64;
        let steps = (letters - 1.0).max(0.0);
        // Extent of the line from its lower left, in letters.
        let end = add([0.0; 2], frame.step(self.text.path), steps);
        let across = f64::from(place / 3) / 2.0;
        let up = f64::from(place % 3) / 2.0;
        let mut shift = add([0.0; 2], end, -across);
        shift = add(
            shift,
            frame.width,
            if letters > 0.0 { -across } else { 0.0 },
        );
        shift = add(shift, frame.upright, -up);
        if origin > 10 {
            // Half a letter away from the point, on any side.
            shift = add(shift, frame.width, 0.5 - across);
            shift = add(shift, frame.upright, 0.5 - up);
        }
        shift
    }

    pub(super) fn plot_character(&mut self, by: By<'_>) -> Result<(), Fault> {
        let frame = self.frame();
        let path = self.text.path;
        let to = match *self.parameters(&[0, 2])? {
            [spaces, lines] => {
                self.text.carriage = add(self.text.carriage, frame.feed(path), -lines);
                add(
                    add(self.here(), frame.step(path), spaces),
                    frame.feed(path),
                    -lines,
                )
            }
            _ => {
                self.text.carriage = add(self.text.carriage, frame.feed(path), 1.0);
                self.text.carriage
            }
        };
        self.put(by, to)
    }

    pub(super) fn character_size(&mut self, relative: bool) -> Result<(), Fault> {
        let size = match *self.parameters(&[0, 2])? {
            [width, height] => [width, height],
            _ if relative => [0.75, 1.5],
            _ => {
                self.text.size = Size::default();
                return Ok(());
            }
        };
        if size.contains(&0.0) {
            let allowed = "a width and a height other than 0";
            return Err(self.lexer.fault("letters without a size", allowed));
        }
        self.text.size = match relative {
            true => Size::Percent(size),
            false => Size::Centimetres(size),
        };
        Ok(())
    }

    pub(super) fn text_direction(&mut self, relative: bool) -> Result<(), Fault> {
        let direction = match *self.parameters(&[0, 2])? {
            [0.0, 0.0] => {
                let problem = "a direction without a run or a rise";
                return Err(self.lexer.fault(problem, "a run and a rise, not both 0"));
            }
            [run, rise] => [run, rise],
            _ => [1.0, 0.0],
        };
        self.text.direction = match relative {
            true => Direction::Relative(direction),
            false => Direction::Absolute(direction),
        };
        self.mark();
        Ok(())
    }

    pub(super) fn slant(&mut self) -> Result<(), Fault> {
        self.text.slant = self.parameters(&[0, 1])?.first().copied().unwrap_or(0.0);
        Ok(())
    }

    pub(super) fn label_origin(&mut self) -> Result<(), Fault> {
        let origin = self.parameters(&[0, 1])?.first().copied().unwrap_or(1.0);
        let known = |&origin: &u8| matches!(origin, 1..=9 | 11..=19 | 21);
        let whole = (0..=21u8).find(|&whole| f64::from(whole) == origin);
        self.text.origin = whole.filter(known).ok_or_else(|| {
            let problem = format!("{origin} is no origin of labels");
            self.lexer.fault(problem, "1 to 9, 11 to 19 or 21")
        })?;
        self.mark();
        Ok(())
    }

    pub(super) fn text_path(&mut self) -> Result<(), Fault> {
        let path = self.parameters(&[0, 1, 2])?.first().copied().unwrap_or(0.0);
        self.text.path = match path {
            0.0 => Path::Right,
            1.0 => Path::Down,
            2.0 => Path::Left,
            3.0 => Path::Up,
            _ => {
                let problem = format!("{path} is no path of labels");
                return Err(self.lexer.fault(problem, "0 to 3"));
            }
        };
        self.mark();
        Ok(())
    }

    pub(super) fn extra_space(&mut self) -> Result<(), Fault> {
        let numbers = self.parameters(&[0, 1, 2])?;
        let number = |place: usize| numbers.get(place).copied().unwrap_or(0.0);
        self.text.extra = [number(0), number(1)];
        Ok(())
    }

    pub(super) fn symbol_mode(&mut self) -> Result<(), Fault> {
        let symbol = self.lexer.character()?;
        self.text.symbol = symbol.filter(|&byte| byte > b' ' && byte != 0x7f);
        Ok(())
    }

    /// Draws the symbol, if there is one, centred at the pen, and returns the pen.
    pub(super) fn draw_symbol(&mut self, by: By<'_>) -> Result<(), Fault> {
        let Some(symbol) = self.text.symbol else {
            return Ok(());
        };
        if self.recording.is_some() {
            return Ok(());
        }
        let frame = self.frame();
        let here = self.here();
        let corner = add(add(here, frame.width, -0.5), frame.height, -0.5);
        self.character(by, &frame, corner, symbol)?;
        self.paper.travel(by, here)
    }

    /// Draws a user-defined character on a grid of 4 by 8 per letter. The pen advances to the next
    /// cell.
    pub(super) fn user_character(&mut self, by: By<'_>) -> Result<(), Fault> {
        const PEN: f64 = 99.0;
        let frame = self.frame();
        let start = self.here();
        let mut at = start;
        let mut down = false;
        while let Some(number) = self.lexer.number()? {
            if number.abs() >= PEN {
                down = number > 0.0;
                continue;
            }
            let Some(rise) = self.lexer.number()? else {
                let problem = "an X without its Y: an odd count of coordinates";
                return Err(self.lexer.fault(problem, "pairs of X and Y"));
            };
            at = add(add(at, frame.width, number / 4.0), frame.height, rise / 8.0);
            match down {
                true => self.paper.line(by, at)?,
                false => self.paper.travel(by, at)?,
            }
        }
        self.put(by, add(start, frame.step(self.text.path), 1.0))
    }

    pub(super) fn tick_length(&mut self) -> Result<(), Fault> {
        self.ticks = match *self.parameters(&[0, 1, 2])? {
            [after, before] => [after / 100.0, before / 100.0],
            [after] => [after / 100.0, 0.0],
            _ => DEFAULT_TICKS,
        };
        Ok(())
    }

    /// Draws a tick across an axis: vertical on X, horizontal on Y. The pen returns.
    pub(super) fn tick(&mut self, by: By<'_>, of_y: bool) -> Result<(), Fault> {
        self.parameters(&[0])?;
        let [across, up] = self.corners.span();
        let length = if of_y { [across, 0.0] } else { [0.0, up] };
        let [after, before] = self.ticks;
        let here = self.here();
        let ends = [add(here, length, after), add(here, length, -before)];
        self.paper.stroke(by, ends)?;
        self.paper.travel(by, here)
    }
}
