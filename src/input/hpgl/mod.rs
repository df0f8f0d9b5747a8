//! Reader of HPGL and HPGL/2 pen-plotter drawings.
//!
//! | drawn | |
//! |---|---|
//! | PU, PD, PA, PR, PE | lines; PE with pens, fractions, absolute points, base 64 and 32 |
//! | AA, AR, AT, RT, CI, CT | arcs and circles, as chords of the angle given, or 5° |
//! | BZ, BR | Bézier curves, as chords at most 6 µm off |
//! | EA, ER, EW, PM, EP | rectangles, wedges, polygons |
//! | RA, RR, WG, FP, FT, AC, PT, PW, WU | their fillings, by lines: FT 1 to 4 |
//! | LB, BL, PB, CP, DT, SI, SR, DI, DR, SL, LO, DV, ES, SM, UC | labels and symbols, in Hershey's single-stroke Roman letters, all of one width as a plotter's are |
//! | XT, YT, TL | ticks |
//!
//! IN, BP, DF, IP, IR, SC (of every type), IW, RO, PS and SP are supported. Instructions that move
//! no pen, such as VS or LT, are skipped with one warning per kind, and so are escape sequences.
//! Unknown instructions may move the pen: they are refused, unless [`Options::lenient`] skips
//! them.
//!
//! A plotter unit is 0.025 mm. The pen starts up, at the origin of the plotter units, and nothing
//! is added after the last move. IN raises the pen where it is. P1 and P2, and the paper that RO
//! turns and IR divides, start as on an HP 7475A with paper of size A: (250, 279) and (10250,
//! 7479), and 10365 by 7962. RO shifts the origin to the corner that is then at the lower left.
//! The paper's edges do not clip; a window (IW) does.
//!
//! A coordinate pair that does not move the pen gives no [`Move`](super::Move);
//! [`Drawing::zero_length`] counts it, with the pen up or down.

mod areas;
mod curve;
mod draw;
mod encoded;
mod fill;
mod font;
mod label;
mod lexer;
mod paper;
mod parameters;
mod polygon;
mod scale;
mod settings;
mod skipped;
mod text;

use super::{Drawing, Fault, Faults, Options, Zeros};
use curve::Tolerance;
use fill::Fill;
use lexer::{Item, Lexer, Mnemonic};
use paper::{By, Paper, Turn};
use polygon::Polygon;
use scale::{Corners, DEFAULT_CORNERS, Scale, Window};
use text::Text;

/// Reads an HPGL drawing; warnings and faults name the file `file`.
///
/// The text may contain any bytes. Control characters between instructions, such as NUL, are
/// skipped, and so is a byte order mark.
///
/// # Errors
///
/// After a fault the reader continues after the instruction.
///
/// Returns an error for text that is not HPGL, an unknown instruction that may move the pen, an
/// invalid number or one out of range, an odd number of coordinates, a wrong number of other
/// parameters, a scale that maps a length to zero or from zero, a label or string without its end,
/// a coordinate beyond [`super::REACH_MM`], curves, labels and fills of more than four million
/// moves, no move at all.
pub fn read(file: &str, text: &[u8]) -> Result<Drawing, Fault> {
    read_with(file, text, &Options::default())
}

/// Reads an HPGL drawing as [`read`] does, with options. A lenient reader skips, with a warning,
/// instructions that are unknown or lack parameters, text that is not HPGL, excess parameters, and
/// the last of an odd number of coordinates.
///
/// # Errors
///
/// Returns the errors of [`read`], and an error for [`Options::zeros`] that are not zero or
/// [`Options::subroutines`].
pub fn read_with(file: &str, text: &[u8], options: &Options) -> Result<Drawing, Fault> {
    if options.zeros != Zeros::default() {
        let problem = "a drawing in HPGL has no zeros and reference points of its own";
        return Err(Fault::new(
            file,
            0,
            "program",
            problem,
            "them with G-code only",
        ));
    }
    if !options.subroutines.is_empty() {
        let (problem, allowed) = ("a drawing in HPGL calls none", "them with G-code only");
        return Err(Fault::new(file, 0, "subroutines", problem, allowed));
    }
    let fault = match draw_all(Plotter::new(file, text, options.lenient)) {
        Err(fault) if fault.all().any(|fault| fault.field == "PE") => fault,
        result => return result,
    };
    let Some(bytes) = bytes_of_utf8(text) else {
        return Err(fault);
    };
    let mut plotter = Plotter::new(file, &bytes, options.lenient);
    plotter.note("UTF-8", fault.line, || {
        "PE: characters are UTF-8, taken for the bytes they stand for".to_owned()
    });
    draw_all(plotter).map_err(|_| fault)
}

fn draw_all(mut plotter: Plotter<'_>) -> Result<Drawing, Fault> {
    let mut faults = Faults::default();
    loop {
        let done = match plotter.lexer.item() {
            Ok(None) => break,
            Ok(Some(item)) => plotter.run(item),
            Err(fault) => Err(fault),
        };
        if let Err(fault) = done {
            if !faults.add(plotter.lexer.marked(fault)) {
                break;
            }
            plotter.lexer.recover();
        }
    }
    let track = plotter.paper.track;
    faults.or(|| track.finish("an HPGL drawing with at least one move"))
}

/// Restores the bytes of a text that an editor has converted to UTF-8, one character per byte.
fn bytes_of_utf8(text: &[u8]) -> Option<Vec<u8>> {
    let text = str::from_utf8(text).ok()?;
    let byte = |character| u8::try_from(u32::from(character)).ok();
    text.trim_start_matches('\u{feff}')
        .chars()
        .map(byte)
        .collect()
}

/// State that instructions change.
struct Plotter<'a> {
    lexer: Lexer<'a>,
    lenient: bool,
    paper: Paper<'a>,
    down: bool,
    relative: bool,
    pen: Option<f64>,
    corners: Corners,
    window: Option<Window>,
    scale: Scale,
    /// Pen position in user units: integers stay exact, however long a chain of PR.
    at: [f64; 2],
    tolerance: Tolerance,
    polygon: Polygon,
    /// In polygon mode: pen position when it began, and true if it was down.
    recording: Option<([f64; 2], bool)>,
    fill: Fill,
    /// Anchor through which the lines of a hatching pass, in plotter units.
    anchor: [f64; 2],
    pen_width: PenWidth,
    text: Text<'a>,
    /// Lengths of ticks on either side, as parts of the distance of P1 and P2.
    ticks: [f64; 2],
}

/// Width of the pen, on which the lines of a solid fill depend.
#[derive(Debug, Clone, Copy)]
struct PenWidth {
    /// True if PW's number is a percentage of the distance of P1 and P2.
    relative: bool,
    /// Width in plotter units.
    units: f64,
}

impl Default for PenWidth {
    fn default() -> Self {
        PenWidth {
            relative: false,
            units: 0.3 * scale::UNITS_PER_MM,
        }
    }
}

/// Default length of a tick on either side, as a part of the distance of P1 and P2.
const DEFAULT_TICKS: [f64; 2] = [0.005; 2];

impl<'a> Plotter<'a> {
    fn new(file: &'a str, text: &'a [u8], lenient: bool) -> Self {
        Self {
            lexer: Lexer::new(file, text, lenient),
            lenient,
            paper: Paper::new(file),
            down: false,
            relative: false,
            pen: None,
            corners: DEFAULT_CORNERS,
            window: None,
            scale: Scale::new(DEFAULT_CORNERS, None),
            at: [0.0; 2],
            tolerance: Tolerance::default(),
            polygon: Polygon::default(),
            recording: None,
            fill: Fill::default(),
            anchor: [0.0; 2],
            pen_width: PenWidth::default(),
            text: Text::default(),
            ticks: DEFAULT_TICKS,
        }
    }

    fn run(&mut self, item: Item) -> Result<(), Fault> {
        let line = self.lexer.start();
        let mnemonic = match item {
            Item::Instruction(mnemonic) => mnemonic,
            Item::Maker(mnemonic) => return self.makers_own(mnemonic),
            Item::Escape(kind) => {
                let name = format!("ESC {}", kind.escape_default());
                self.note(&name, line, || format!("{name}: escape sequence skipped"));
                return Ok(());
            }
            Item::Job => {
                self.note("@", line, || "@: line skipped".to_owned());
                return Ok(());
            }
            Item::Noise(first) => {
                let text = || format!("'{}': no instruction, skipped", first.escape_default());
                self.note("noise", line, text);
                return Ok(());
            }
        };
        let by = By {
            field: mnemonic.as_str(),
            line,
        };
        if self.recording.is_some() && !may_be_in_a_polygon(&mnemonic) {
            return self.out_of_place(mnemonic, line);
        }
        match &mnemonic.0 {
            b"PU" | b"PD" | b"PA" | b"PR" => self.draw(mnemonic),
            b"PE" => self.draw_encoded(by),
            b"AA" | b"AR" => self.arc(by, mnemonic.0[1] == b'R'),
            b"AT" | b"RT" => self.arc_through(by, mnemonic.0[0] == b'R'),
            b"CI" => self.circle(by),
            b"BZ" | b"BR" => self.bezier(by, mnemonic.0[1] == b'R'),
            b"CT" => self.chord_tolerance(),
            b"EA" | b"ER" => self.rectangle(by, mnemonic.0[1] == b'R', false),
            b"RA" | b"RR" => self.rectangle(by, mnemonic.0[1] == b'R', true),
            b"EW" => self.wedge(by, false),
            b"WG" => self.wedge(by, true),
            b"PM" => self.polygon_mode(),
            b"EP" => {
                self.parameters(&[0])?;
                self.edge_polygon(by)
            }
            b"FP" => self.fill_polygon(by),
            b"FT" => self.fill_type(),
            b"AC" => self.anchor_corner(),
            b"PT" => self.pen_thickness(),
            b"PW" => self.pen_width(),
            b"WU" => self.width_unit(),
            b"SP" => {
                let numbers = self.parameters(&[0, 1])?;
                self.select_pen(line, numbers.first().copied().unwrap_or(0.0))
            }
            b"IP" => self.input_corners(),
            b"IR" => self.input_relative_corners(),
            b"SC" => self.set_window(),
            b"IW" => self.clip(),
            b"RO" => self.rotate(),
            b"PS" => self.plot_size(),
            b"LB" => self.label(by),
            b"BL" => self.buffer_label(),
            b"PB" => self.print_buffer(by),
            b"CP" => self.plot_character(by),
            b"DT" => self.lexer.label_terminator(),
            b"SI" | b"SR" => self.character_size(mnemonic.0[1] == b'R'),
            b"DI" | b"DR" => self.text_direction(mnemonic.0[1] == b'R'),
            b"SL" => self.slant(),
            b"LO" => self.label_origin(),
            b"DV" => self.text_path(),
            b"ES" => self.extra_space(),
            b"SM" => self.symbol_mode(),
            b"UC" => self.user_character(by),
            b"XT" | b"YT" => self.tick(by, mnemonic.0[0] == b'Y'),
            b"TL" => self.tick_length(),
            b"IN" | b"BP" => self.initialise(mnemonic),
            b"DF" => {
                self.parameters(&[0])?;
                self.defaults();
                Ok(())
            }
            _ => self.skip(mnemonic, line),
        }
    }

    fn initialise(&mut self, mnemonic: Mnemonic) -> Result<(), Fault> {
        match &mnemonic.0 {
            // Begins a plot; its kinds and values, texts among them, have no effect here.
            b"BP" => self.lexer.skip_parameters()?,
            _ => drop(self.parameters(&[0, 1])?),
        }
        self.leave_polygon_mode();
        self.turn(Turn::None);
        self.down = false;
        self.corners = DEFAULT_CORNERS;
        self.defaults();
        Ok(())
    }

    fn defaults(&mut self) {
        self.leave_polygon_mode();
        self.relative = false;
        self.window = None;
        self.paper.set_window(None);
        self.tolerance = Tolerance::default();
        self.fill = Fill::default();
        self.anchor = [0.0; 2];
        self.pen_width = PenWidth::default();
        self.ticks = DEFAULT_TICKS;
        self.lexer.reset_terminator();
        self.rescale();
        self.text = Text::default();
        self.mark();
    }

    /// Leaves polygon mode without a polygon; the pen returns to its earlier position.
    fn leave_polygon_mode(&mut self) {
        if let Some((at, _)) = self.recording.take() {
            self.at = at;
        }
        self.polygon = Polygon::default();
    }

    /// Applies changed corners or a changed window. The pen keeps its position on the paper.
    fn rescale(&mut self) {
        let scale = Scale::new(self.corners, self.window);
        if scale != self.scale {
            self.at = scale.to_user(self.scale.to_plotter(self.at));
            if let Some((at, _)) = &mut self.recording {
                *at = scale.to_user(self.scale.to_plotter(*at));
            }
            self.scale = scale;
        }
    }

    /// Returns the pen position in plotter units.
    fn here(&self) -> [f64; 2] {
        self.scale.to_plotter(self.at)
    }

    /// Sets the current position as the target of carriage returns in labels.
    fn mark(&mut self) {
        self.text.carriage = self.here();
    }

    /// Moves the pen to a point in user units, up or down as it is, or records it in the polygon
    /// buffer.
    fn go(&mut self, by: By<'_>, to: [f64; 2]) -> Result<(), Fault> {
        self.at = to;
        let to = self.here();
        if self.recording.is_some() {
            self.polygon.add(to, self.down);
            return Ok(());
        }
        self.paper.go(by, to, self.down)
    }

    /// Selects a pen. Pens are not distinguished; a change to another pen gives a warning.
    fn select_pen(&mut self, line: usize, pen: f64) -> Result<(), Fault> {
        if pen < 0.0 || pen.fract() != 0.0 {
            let problem = format!("{pen} is not a pen");
            return Err(self.lexer.fault(problem, "a whole number from 0"));
        }
        // Pen 0 puts the current pen away.
        if pen > 0.0 && *self.pen.get_or_insert(pen) != pen {
            let text = || "SP: more than one pen; all pens draw alike".to_owned();
            self.note("SP", line, text);
        }
        Ok(())
    }

    fn note(&mut self, key: &str, line: usize, text: impl FnOnce() -> String) {
        self.paper.track.note(key, line, text);
    }
}

/// True if polygon mode accepts an instruction: those that add corners, and those that move no
/// pen.
fn may_be_in_a_polygon(mnemonic: &Mnemonic) -> bool {
    !matches!(
        &mnemonic.0,
        b"EA"
            | b"ER"
            | b"EW"
            | b"EP"
            | b"RA"
            | b"RR"
            | b"WG"
            | b"FP"
            | b"LB"
            | b"PB"
            | b"CP"
            | b"UC"
            | b"XT"
            | b"YT"
            | b"RO"
            | b"PS"
    )
}
