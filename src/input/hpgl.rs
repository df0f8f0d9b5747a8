//! HPGL and HPGL/2 pen-plotter drawings.
//!
//! Understood are IN, DF, SP, PU, PD, PA, PR, IP, SC (anisotropic and isotropic) and, so that the
//! letters of a label are not taken for instructions, DT. Every other instruction and every
//! escape sequence is skipped with one warning for each kind.
//!
//! A plotter unit is 0.025 mm. The pen starts up, at the origin of the plotter units, and nothing
//! is added after the last move. IN raises the pen where it is. P1 and P2 start where an HP 7475A
//! with A4 paper has them: (250, 279) and (10250, 7479).
//!
//! A coordinate pair that does not move the pen gives no [`Move`]; [`Drawing::zero_length`]
//! counts it, with the pen up or down.

mod lexer;
mod scale;

use super::track::Track;
use super::{Course, Drawing, Fault, Move};
use lexer::{Item, Lexer, Mnemonic};
use scale::{Corners, DEFAULT_CORNERS, Scale, Window};

/// Reads an HPGL drawing; `file` is the name that warnings and faults carry.
///
/// The text may hold any bytes: labels are skipped whatever their character set.
///
/// # Errors
///
/// Text that is not HPGL, a number that is none or is out of range, an odd count of coordinates,
/// a wrong count of other parameters, a scale that maps a length to zero or from zero, a
/// label or string without its end, a coordinate beyond [`super::REACH_MM`], no move at all.
pub fn read(file: &str, text: &[u8]) -> Result<Drawing, Fault> {
    let mut plotter = Plotter::new(file, text);
    while let Some(item) = plotter.lexer.item()? {
        plotter.run(item)?;
    }
    plotter
        .track
        .finish("an HPGL drawing with at least one move")
}

/// The state an instruction may change.
struct Plotter<'a> {
    lexer: Lexer<'a>,
    track: Track<'a>,
    down: bool,
    relative: bool,
    pen: Option<f64>,
    corners: Corners,
    window: Option<Window>,
    scale: Scale,
    /// Where the pen is, in user units: integers stay exact, however long a chain of PR.
    at: [f64; 2],
}

impl<'a> Plotter<'a> {
    fn new(file: &'a str, text: &'a [u8]) -> Self {
        Self {
            lexer: Lexer::new(file, text),
            track: Track::new(file),
            down: false,
            relative: false,
            pen: None,
            corners: DEFAULT_CORNERS,
            window: None,
            scale: Scale::new(DEFAULT_CORNERS, None),
            at: [0.0; 2],
        }
    }

    fn run(&mut self, item: Item) -> Result<(), Fault> {
        let line = self.lexer.line();
        let mnemonic = match item {
            Item::Instruction(mnemonic) => mnemonic,
            Item::Escape(kind) => {
                let name = format!("ESC {}", kind.escape_default());
                self.track
                    .note(&name, line, || format!("{name}: escape sequence skipped"));
                return Ok(());
            }
            Item::Job => {
                self.track.note("@", line, || "@: line skipped".to_owned());
                return Ok(());
            }
        };
        match &mnemonic.0 {
            b"PU" | b"PD" | b"PA" | b"PR" => self.draw(mnemonic),
            b"SP" => self.select_pen(line),
            b"IP" => self.input_corners(),
            b"SC" => self.set_window(),
            b"DT" => self.lexer.label_terminator(),
            b"IN" => {
                self.parameters(&[0, 1])?;
                self.down = false;
                self.corners = DEFAULT_CORNERS;
                self.defaults();
                Ok(())
            }
            b"DF" => {
                self.parameters(&[0])?;
                self.defaults();
                Ok(())
            }
            _ => self.skip(mnemonic, line),
        }
    }

    fn defaults(&mut self) {
        self.relative = false;
        self.window = None;
        self.lexer.reset_terminator();
        self.rescale();
    }

    /// Takes up changed corners or a changed window. The pen stays where it is on the paper.
    fn rescale(&mut self) {
        let scale = Scale::new(self.corners, self.window);
        if scale != self.scale {
            self.at = scale.to_user(self.scale.to_mm(self.at));
            self.scale = scale;
        }
    }

    fn draw(&mut self, mnemonic: Mnemonic) -> Result<(), Fault> {
        match &mnemonic.0 {
            b"PU" => self.down = false,
            b"PD" => self.down = true,
            b"PA" => self.relative = false,
            _ => self.relative = true,
        }
        let field = mnemonic.to_string();
        while let Some(x) = self.lexer.number()? {
            let line = self.lexer.line();
            let Some(y) = self.lexer.number()? else {
                let problem = "an X without its Y: an odd count of coordinates";
                return Err(self.track.fault(line, field, problem, "pairs of X and Y"));
            };
            let [from_x, from_y] = self.at;
            self.at = if self.relative {
                [from_x + x, from_y + y]
            } else {
                [x, y]
            };
            let [x, y] = self.scale.to_mm(self.at);
            let next = Move {
                to: [x, y, 0.0],
                course: Course::Line,
                rapid: !self.down,
                feed_mm_per_min: None,
                line,
            };
            self.track.push(&field, next)?;
        }
        Ok(())
    }

    /// Pens are not told apart; a change from one to another is worth a warning.
    fn select_pen(&mut self, line: usize) -> Result<(), Fault> {
        let numbers = self.parameters(&[0, 1])?;
        let pen = numbers.first().copied().unwrap_or(0.0);
        if pen < 0.0 || pen.fract() != 0.0 {
            let problem = format!("{pen} is not a pen");
            return Err(self.lexer.fault(problem, "a whole number from 0"));
        }
        // Pen 0 is no pen: the one in use goes back to its stall.
        if pen > 0.0 && *self.pen.get_or_insert(pen) != pen {
            let text = || "SP: more than one pen; all pens draw alike".to_owned();
            self.track.note("SP", line, text);
        }
        Ok(())
    }

    fn input_corners(&mut self) -> Result<(), Fault> {
        let corners = match *self.parameters(&[0, 2, 4])? {
            [x1, y1, x2, y2] => Corners {
                p1: [x1, y1],
                p2: [x2, y2],
            },
            [x1, y1] => {
                let ([old_x1, old_y1], [old_x2, old_y2]) = (self.corners.p1, self.corners.p2);
                Corners {
                    p1: [x1, y1],
                    p2: [x1 + (old_x2 - old_x1), y1 + (old_y2 - old_y1)],
                }
            }
            _ => DEFAULT_CORNERS,
        };
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

    fn set_window(&mut self) -> Result<(), Fault> {
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
            [_, _, _, _, kind, ..] => {
                let allowed = "0 (anisotropic, without further parameters) or 1 (isotropic)";
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
        self.window = Some(Window {
            x,
            y,
            isotropic: isotropic.map(|shares: [f64; 2]| shares.map(|share| share / 100.0)),
        });
        self.rescale();
        Ok(())
    }

    /// The parameters of an instruction that takes one of the given counts, in rising order.
    fn parameters(&mut self, counts: &[usize]) -> Result<Vec<f64>, Fault> {
        let most = counts.last().copied().unwrap_or(0);
        let mut numbers = Vec::new();
        while let Some(number) = self.lexer.number()? {
            numbers.push(number);
            if numbers.len() > most {
                let allowed = format!("at most {most}");
                return Err(self.lexer.fault("too many parameters", allowed));
            }
        }
        if !counts.contains(&numbers.len()) {
            let counts: Vec<String> = counts.iter().map(usize::to_string).collect();
            let problem = format!("{} parameters", numbers.len());
            return Err(self
                .lexer
                .fault(problem, format!("{} parameters", counts.join(", "))));
        }
        Ok(numbers)
    }

    fn skip(&mut self, mnemonic: Mnemonic, line: usize) -> Result<(), Fault> {
        let field = mnemonic.to_string();
        self.track
            .note(&field, line, || match changes_the_drawing(mnemonic) {
                true => format!("{mnemonic}: skipped; what it draws or moves is missing"),
                false => format!("{mnemonic}: skipped"),
            });
        match &mnemonic.0 {
            b"LB" | b"BL" | b"WD" => self.lexer.skip_label(),
            b"PE" | b"MG" => self.lexer.skip_to_semicolon(),
            b"SM" => self.lexer.skip_character(),
            _ => self.lexer.skip_parameters(),
        }
    }
}

/// Whether a skipped instruction would have drawn, moved the pen, or changed where or whether
/// the next ones draw.
fn changes_the_drawing(mnemonic: Mnemonic) -> bool {
    const THEY_DO: [&[u8; 2]; 28] = [
        b"AA", b"AR", b"AT", b"BR", b"BZ", b"CI", b"CP", b"EA", b"EP", b"ER", b"EW", b"FP", b"IR",
        b"IW", b"LB", b"PB", b"PE", b"PM", b"RA", b"RO", b"RR", b"RT", b"SM", b"UC", b"WG", b"XT",
        b"YT", b"RP",
    ];
    THEY_DO.contains(&&mnemonic.0)
}
