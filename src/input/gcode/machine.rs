//! What the words of a line do, given the lines before it.

use super::block::{Block, Code, name};
use super::codes;
use super::cycle::Cycle;
use super::frame::Rotation;
use super::modal::{Modal, Motion, Plane};
use super::nurbs::Nurbs;
use super::offsets::{Offsets, Own};
use super::polar::Polar;
use super::problem::Problem;
use super::tools::{Length, Tools};
use crate::input::track::Track;
use crate::input::{Course, Drawing, Fault, Move, Options, Point};

const MM_PER_INCH: f64 = 25.4;

pub(super) const G_CODES: &str = "G0 to G5 G5.1 to G5.3 G6.2 G8 G10 G11 G15 to G21 G28 G30 G38.2 to G38.5 \
                                  G40 G43 G49 G52 to G59.3 G61 G64 G68 G69 G73 G80 to G86 G89 to G94 \
                                  G97 to G99";

/// A piece of the move of a line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    pub(super) to: Point,
    pub(super) course: Course,
    pub(super) rapid: bool,
    /// Its length in millimetres, where an inverse time needs it.
    pub(super) length: f64,
}

/// The machine: its modal state, its offsets, and the moves it has made.
pub(super) struct Machine<'a> {
    pub(super) track: Track<'a>,
    /// The programmed position from the machine's zero, in millimetres, not rotated.
    pub(super) at: Point,
    /// W likewise, where it is an axis: before the line that is run, and behind it.
    w: [f64; 2],
    fourth: bool,
    pub(super) modal: Modal,
    pub(super) saved: Option<Modal>,
    pub(super) offsets: Offsets,
    pub(super) tools: Tools,
    pub(super) cycle: Cycle,
    pub(super) rotation: Rotation,
    /// The last radius and angle under G16.
    pub(super) polar: Option<Polar>,
    /// The end control point of a G5 from its end, for the one that follows.
    pub(super) last_control: Option<[f64; 2]>,
    /// The NURBS that is being read.
    pub(super) nurbs: Option<Nurbs>,
    pub(super) pieces: Vec<Piece>,
    /// The instruction that made them.
    pub(super) made_by: String,
    /// F as it is written.
    pub(super) feed_word: Option<f64>,
    pub(super) spindle: f64,
    pub(super) tool: f64,
    /// The tool that M6 or M61 has put into the spindle, if known.
    pub(super) loaded: Option<f64>,
    pub(super) strict: bool,
    /// G5 and G5.1 are no chords.
    pub(super) splines: bool,
}

impl<'a> Machine<'a> {
    pub(super) fn new(file: &'a str, options: &Options) -> Self {
        Self {
            track: Track::new(file),
            at: [0.0; 3],
            w: [0.0; 2],
            fourth: options.fourth,
            modal: Modal::default(),
            saved: None,
            offsets: Offsets::new(options.zeros),
            tools: Tools::default(),
            cycle: Cycle::default(),
            rotation: Rotation::default(),
            polar: None,
            last_control: None,
            nurbs: None,
            pieces: Vec::new(),
            made_by: String::new(),
            feed_word: None,
            spindle: 0.0,
            tool: 0.0,
            loaded: None,
            strict: options.strict,
            splines: options.splines,
        }
    }

    pub(super) fn note(&mut self, key: &str, line: usize, text: impl FnOnce() -> String) {
        self.track.note(key, line, text);
    }

    pub(super) fn fault(&self, line: usize, it: Problem) -> Fault {
        self.track.fault(line, it.field, it.problem, it.allowed)
    }

    /// The drawing; the program may have been subroutines alone.
    pub(super) fn finish(self, subs: bool) -> Result<Drawing, Fault> {
        if let Some(curve) = &self.nurbs {
            let allowed = "G5.3 behind a G5.2, and as many equal knots as the order behind a G6.2";
            let problem = Problem::new(curve.name(), "without its end", allowed);
            return Err(self.fault(curve.line, problem));
        }
        self.track.finish(match subs {
            true => "a G-code program that calls its subroutines and makes at least one move",
            false => "a G-code program with at least one move",
        })
    }

    pub(super) fn modal(&self) -> Modal {
        self.modal
    }

    pub(super) fn restore(&mut self, modal: Modal) {
        self.modal = modal;
        self.reframe();
    }

    pub(super) fn skip(&mut self, word: &str, line: usize) {
        self.track.note(word, line, || format!("{word}: skipped"));
    }

    /// Skips what says nothing about the path, unless the reader is strict.
    pub(super) fn say_nothing(&mut self, word: &str, line: usize) -> Result<(), Problem> {
        if self.strict {
            let problem = "says nothing about the path, which --strict refuses";
            return Err(Problem::new(word, problem, "words that move"));
        }
        self.skip(word, line);
        Ok(())
    }

    /// Records the moves of the line that was run.
    pub(super) fn push(&mut self, line: usize) -> Result<(), Problem> {
        let total: f64 = self.pieces.iter().map(|piece| piece.length).sum();
        let [from, end] = self.w;
        let length = total.hypot(end - from);
        let feed_mm_per_min = match (self.modal.inverse_time, self.feed_word) {
            (true, Some(per_min)) if length > 0.0 => Some(per_min * length),
            (true, _) => None,
            (false, _) => self.modal.feed_mm_per_min,
        };
        let (mut length, last) = (0.0, self.pieces.len().saturating_sub(1));
        for (index, piece) in std::mem::take(&mut self.pieces).into_iter().enumerate() {
            if !piece.rapid && feed_mm_per_min.is_none() {
                let text = || "no feed set; the feed of the settings applies".to_owned();
                self.track.note("feed", line, text);
            }
            let (to, course) = self.turned_piece(piece.to, piece.course);
            let next = Move {
                to,
                course,
                rapid: piece.rapid,
                feed_mm_per_min: feed_mm_per_min.filter(|_| !piece.rapid),
                line,
            };
            length += piece.length;
            // The chords and turns of an arc have their parts of W.
            let w = match index == last || end == from {
                true => end,
                false => from + (end - from) * (length / total),
            };
            let pushed = match self.fourth {
                true => self.track.push_with(&self.made_by, next, w),
                false => self.track.push(&self.made_by, next),
            };
            pushed
                .map_err(|far| Problem::new(&self.made_by, far.problem, far.allowed).following())?;
        }
        Ok(())
    }

    /// Runs the words of a line, and says how many more lines it counts for. The order is: units,
    /// planes and distances, feed, M words, offsets, then the move.
    pub(super) fn run(&mut self, line: usize, block: &mut Block) -> Result<u64, Problem> {
        self.pieces.clear();
        self.w[0] = self.w();
        if block.optional {
            self.say_nothing("/", line)?;
        }
        self.change_tool(block);
        self.m_words(line, block)?;
        let words = self.g_words(line, block)?;
        if let Some(problem) = block.take_unclear() {
            return Err(problem);
        }
        self.feed(block)?;
        if let Some(spindle) = block.take(b'S') {
            self.spindle = spindle;
            self.skip("S", line);
        }
        if let Some(tool) = block.take(b'T') {
            self.tool = tool;
            self.skip("T", line);
        }
        self.reframe();
        if let Some((code, length)) = words.length {
            self.tool_length(line, block, code, length)?;
        }
        for letter in [b'E', b'H', b'D'] {
            match block.take(letter) {
                None => {}
                Some(value) if letter == b'H' && value != 0.0 => {
                    let problem = "without G43; some controls move to a switch by it";
                    return Err(Problem::new('H', problem, "H with G43, G44 or G43.2; H0"));
                }
                Some(_) => self.say_nothing(&char::from(letter).to_string(), line)?,
            }
        }
        self.still_axes(line, block)?;
        if let Some(own) = words.own {
            self.own(line, block, own, words.motion.is_some())?;
        }
        self.reframe();
        self.motion(line, block, &words)
    }

    /// Puts the tool into the spindle that T has chosen, in this line or before.
    fn change_tool(&mut self, block: &Block) {
        if block.m.contains(&(6, 0)) {
            let chosen = block.letter(b'T').unwrap_or(self.tool);
            self.loaded = Some(chosen).filter(|tool| *tool != 0.0);
        } else if block.m.contains(&(61, 0)) {
            self.loaded = block.letter(b'Q');
        }
    }

    /// Where W is, from the machine's zero, in millimetres.
    pub(super) fn w(&self) -> f64 {
        self.w[1]
    }

    /// Takes the word of W for the end of a line's move.
    pub(super) fn move_w(&mut self, block: &mut Block, machine: bool) {
        if let Some(word) = block.take(b'W').map(|word| word * self.modal.mm_per_unit) {
            let relative = self.modal.relative && !machine;
            self.w[1] = if relative { self.w[0] + word } else { word };
        }
    }

    /// Rotary and parallel axes, which no circuit has, may be named as long as they stand still; W
    /// where it is no axis.
    fn still_axes(&mut self, line: usize, block: &mut Block) -> Result<(), Problem> {
        let letters = [b'A', b'B', b'C', b'U', b'V', b'W'];
        for letter in &letters[..if self.fourth { 5 } else { 6 }] {
            let letter = *letter;
            match block.take(letter) {
                None => {}
                Some(0.0) => self.say_nothing(&char::from(letter).to_string(), line)?,
                Some(value) if letter == b'W' => {
                    let allowed = "W at 0; any with axes = 4 of the trajectory controller";
                    return Err(Problem::new(
                        'W',
                        format!("{value}: a fourth axis"),
                        allowed,
                    ));
                }
                Some(value) => {
                    let problem = format!("{value}: an axis that no circuit has");
                    let allowed = "X, Y and Z; A, B, C, U, V and W at 0";
                    return Err(Problem::new(char::from(letter), problem, allowed));
                }
            }
        }
        Ok(())
    }

    fn feed(&mut self, block: &mut Block) -> Result<(), Problem> {
        // An inverse time holds for its line alone.
        let word = block.take(b'F');
        if self.modal.inverse_time {
            self.feed_word = None;
        }
        let Some(feed) = word else {
            return Ok(());
        };
        if feed <= 0.0 {
            let problem = format!("a feed of {feed}");
            return Err(Problem::new("F", problem, "a feed above 0"));
        }
        self.feed_word = Some(feed);
        if !self.modal.inverse_time {
            self.modal.feed_mm_per_min = Some(feed * self.modal.mm_per_unit);
        }
        Ok(())
    }

    fn g_words(&mut self, line: usize, block: &mut Block) -> Result<Words, Problem> {
        let mut words = Words::default();
        let (mut plane, mut units, mut distance) = (None, None, None);
        let (mut centres, mut feeds, mut system, mut ends) = (None, None, None, None);
        let (mut polar, mut turn) = (None, None);
        for index in 0..block.g.len() {
            let Some(&code) = block.g.get(index) else {
                break;
            };
            match code {
                (0, 0) => choose(&mut words.motion, code, Motion::Rapid)?,
                (1, 0) => choose(&mut words.motion, code, Motion::Line)?,
                (2, 0) => choose(&mut words.motion, code, Motion::Arc { clockwise: true })?,
                (3, 0) => choose(&mut words.motion, code, Motion::Arc { clockwise: false })?,
                (5, 0) => choose(&mut words.motion, code, Motion::Cubic)?,
                (5, 1) => choose(&mut words.motion, code, Motion::Quadratic)?,
                (5, 2) => choose(&mut words.motion, code, Motion::Nurbs)?,
                (5, 3) => choose(&mut words.motion, code, Motion::NurbsEnd)?,
                (6, 2) => choose(&mut words.motion, code, Motion::KnottedNurbs)?,
                (38, 2..=5) => choose(&mut words.motion, code, Motion::Probe)?,
                (73 | 81..=86 | 89, 0) => choose(&mut words.motion, code, Motion::Cycle(code.0))?,
                (80, 0) => words.cancels = true,
                (17, 0) => choose(&mut plane, code, Plane::Xy)?,
                (18, 0) => choose(&mut plane, code, Plane::Zx)?,
                (19, 0) => choose(&mut plane, code, Plane::Yz)?,
                (20, 0) => choose(&mut units, code, MM_PER_INCH)?,
                (21, 0) => choose(&mut units, code, 1.0)?,
                (90, 0) => choose(&mut distance, code, false)?,
                (91, 0) => choose(&mut distance, code, true)?,
                (90, 1) => choose(&mut centres, code, true)?,
                (91, 1) => choose(&mut centres, code, false)?,
                (93, 0) => choose(&mut feeds, code, true)?,
                (94, 0) => choose(&mut feeds, code, false)?,
                (98, 0) => choose(&mut ends, code, false)?,
                (99, 0) => choose(&mut ends, code, true)?,
                (54..=58, 0) => choose(&mut system, code, code.0 as usize - 54)?,
                (59, 0..=3) => choose(&mut system, code, 5 + code.1 as usize)?,
                (53, 0) => words.machine = true,
                (15, 0) => choose(&mut polar, code, false)?,
                (16, 0) => choose(&mut polar, code, true)?,
                (68, 0) => {
                    choose(&mut turn, code, true)?;
                    choose(&mut words.own, code, Own::Turn)?;
                }
                (69, 0) => choose(&mut turn, code, false)?,
                // What is so anyway: no compensation, diameter or scaling.
                (8 | 40 | 50 | 97, 0) | (50, 1) | (69, 1) => {
                    if code.0 == 50 && block.axes().iter().any(Option::is_some) {
                        let problem = "sets coordinates, as controls of lathes do";
                        return Err(Problem::new("G50", problem, "G50 alone; G92"));
                    }
                    if code == (97, 0) {
                        self.say_nothing("G97", line)?;
                    }
                }
                (4, 0) => {
                    words.dwell = true;
                    self.note("G4", line, || "G4: no dwell is made".to_owned());
                }
                (61 | 64, 0) => self.skip(&name('G', code), line),
                (61, 1) => self.say_nothing("G61.1", line)?,
                (96, 0) => self.say_nothing("G96", line)?,
                (49, 0) => choose(&mut words.length, code, Length::Cancel)?,
                (43, 0) => choose(&mut words.length, code, Length::Of { sign: 1.0 })?,
                (44, 0) => choose(&mut words.length, code, Length::Of { sign: -1.0 })?,
                (43, 2) => choose(&mut words.length, code, Length::Add)?,
                (43, 1) => choose(&mut words.own, code, Own::Length)?,
                (10, 0) if block.letter(b'L').is_some() => choose(&mut words.own, code, Own::Set)?,
                // Printers take filament back, and level their bed.
                (10 | 11 | 29 | 34, 0) if block.given().next().is_none() => {
                    self.say_nothing(&name('G', code), line)?;
                }
                (28, 0) => choose(&mut words.own, code, Own::Go(0))?,
                (30, 0) => choose(&mut words.own, code, Own::Go(1))?,
                (28, 1) => choose(&mut words.own, code, Own::Keep(0))?,
                (30, 1) => choose(&mut words.own, code, Own::Keep(1))?,
                (92, 0) => choose(&mut words.own, code, Own::Shift)?,
                (52, 0) => choose(&mut words.own, code, Own::Local)?,
                (92, 1) => choose(&mut words.own, code, Own::Forget)?,
                (92, 2) => choose(&mut words.own, code, Own::Suspend)?,
                (92, 3) => choose(&mut words.own, code, Own::Resume)?,
                _ => {
                    let reason = codes::g_reason(code);
                    return Err(Problem::new(name('G', code), reason, G_CODES));
                }
            }
        }
        // P, Q and R of G64 are tolerances.
        if block.g.contains(&(64, 0)) {
            for letter in [b'P', b'Q', b'R'] {
                if block.take(letter).is_some() && self.strict {
                    self.say_nothing("P, Q, R", line)?;
                }
            }
        }
        if let Some((_, false)) = turn {
            self.end_rotation();
        }
        if let Some((_, polar)) = polar {
            self.polar = polar.then(Polar::default);
        }
        let modal = &mut self.modal;
        let before = modal.plane;
        set(&mut modal.plane, plane);
        set(&mut modal.mm_per_unit, units);
        set(&mut modal.relative, distance);
        set(&mut modal.centres_absolute, centres);
        set(&mut modal.system, system);
        modal.end_chosen |= ends.is_some();
        set(&mut modal.ends_at_r, ends);
        if let Some((_, inverse)) = feeds {
            modal.inverse_time = inverse;
            self.feed_word = None;
        }
        let drilled = matches!(modal.motion, Some(Motion::Cycle(_))) && modal.plane == before;
        match words.motion {
            Some((_, motion)) => {
                modal.motion = Some(motion);
            }
            None if words.cancels => modal.motion = None,
            None => {}
        }
        if let (Some(Motion::Cycle(_)), false) = (modal.motion, drilled) {
            let [_, _, along] = modal.plane.axes();
            self.cycle = Cycle::from(self.at.get(along).copied().unwrap_or(0.0));
        }
        self.fits_rotation(&words, system.is_some())?;
        Ok(words)
    }
}

/// What the G words of a line choose.
#[derive(Debug, Default)]
pub(super) struct Words {
    pub(super) motion: Option<(Code, Motion)>,
    /// An instruction that takes the axis words for itself.
    pub(super) own: Option<(Code, Own)>,
    /// A tool length from the table of tools.
    length: Option<(Code, Length)>,
    cancels: bool,
    /// G53.
    pub(super) machine: bool,
    pub(super) dwell: bool,
}

impl Machine<'_> {
    /// An inverse time is given in every line that moves.
    pub(super) fn needs_feed(&self) -> Result<(), Problem> {
        match self.feed_word {
            Some(_) => Ok(()),
            None => Err(Problem::new(
                "F",
                "missing under G93",
                "F in every line that moves",
            )),
        }
    }

    pub(super) fn made_by(&mut self, name: String) {
        self.made_by = name;
    }
}

fn set<T>(place: &mut T, chosen: Option<(Code, T)>) {
    if let Some((_, value)) = chosen {
        *place = value;
    }
}

/// Sets what the words of a line may choose once; saying it again is no harm.
fn choose<T>(place: &mut Option<(Code, T)>, code: Code, value: T) -> Result<(), Problem> {
    if let Some((other, _)) = place
        && *other != code
    {
        let problem = format!("together with {} in one line", name('G', *other));
        let allowed = "one of them in a line";
        return Err(Problem::new(name('G', code), problem, allowed));
    }
    *place = Some((code, value));
    Ok(())
}
