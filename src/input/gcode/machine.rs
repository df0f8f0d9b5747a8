//! Effect of a line's words, given the lines before it.

use super::block::{Block, Code};
use super::cycle::Cycle;
use super::frame::Rotation;
use super::modal::{Modal, Motion};
use super::nurbs::Nurbs;
use super::offsets::{Offsets, Own};
use super::polar::Polar;
use super::problem::Problem;
use super::tools::{Length, Tools};
use crate::input::track::Track;
use crate::input::{Course, Drawing, Fault, Move, Options, Point};

/// Piece of a line's move.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    pub(super) to: Point,
    pub(super) course: Course,
    pub(super) rapid: bool,
    /// Length in millimetres, needed by an inverse time feed.
    pub(super) length: f64,
}

/// Machine: its modal state, its offsets, and its moves so far.
pub(super) struct Machine<'a> {
    pub(super) track: Track<'a>,
    /// Programmed position from the machine's zero, in millimetres, unrotated.
    pub(super) at: Point,
    /// W in millimetres before and after the current line, if it is an axis.
    w: [f64; 2],
    fourth: bool,
    pub(super) modal: Modal,
    pub(super) saved: Option<Modal>,
    pub(super) offsets: Offsets,
    pub(super) tools: Tools,
    pub(super) cycle: Cycle,
    pub(super) rotation: Rotation,
    /// Last radius and angle under G16.
    pub(super) polar: Option<Polar>,
    /// End control point of a G5 relative to its end, for the next one.
    pub(super) last_control: Option<[f64; 2]>,
    /// NURBS under construction.
    pub(super) nurbs: Option<Nurbs>,
    pub(super) pieces: Vec<Piece>,
    /// Instruction that made the pieces.
    pub(super) made_by: String,
    /// F as written.
    pub(super) feed_word: Option<f64>,
    pub(super) spindle: f64,
    pub(super) tool: f64,
    /// Tool that M6 or M61 has loaded, if known.
    pub(super) loaded: Option<f64>,
    pub(super) strict: bool,
    /// True if G5 and G5.1 are not converted to chords.
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

    /// Returns the drawing; `subs` is true if the program may consist of subroutines only.
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

    /// Skips a word without effect on the path, unless the reader is strict.
    pub(super) fn say_nothing(&mut self, word: &str, line: usize) -> Result<(), Problem> {
        if self.strict {
            let problem = "says nothing about the path, which --strict refuses";
            return Err(Problem::new(word, problem, "words that move"));
        }
        self.skip(word, line);
        Ok(())
    }

    /// Records the moves of the executed line, under its line of the program.
    pub(super) fn push(&mut self, line: usize, of_program: usize) -> Result<(), Problem> {
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
                line: of_program,
            };
            length += piece.length;
            // Chords and turns of an arc have their shares of W.
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

    /// Executes the words of a line, and returns the number of additional lines that it counts
    /// for. The order is: units, planes and distances, feed, M words, offsets, then the move.
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
        self.inline_power(line, block, &words)?;
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

    /// Skips the I of inline power of lasers. With an arc it may belong to a centre.
    fn inline_power(&mut self, line: usize, block: &Block, words: &Words) -> Result<(), Problem> {
        if !block.inline {
            return Ok(());
        }
        let moves = words.motion.is_some() || block.moves();
        let straight = matches!(self.modal.motion, None | Some(Motion::Rapid | Motion::Line));
        if moves && !straight {
            let problem = "without its number, in the line of an arc or a curve";
            return Err(Problem::new(
                'I',
                problem,
                "I alone with M3 to M5, G0 and G1",
            ));
        }
        self.say_nothing("I", line)
    }

    /// Loads the tool that T has chosen, in this line or before.
    fn change_tool(&mut self, block: &Block) {
        if block.m.contains(&(6, 0)) {
            let chosen = block.letter(b'T').unwrap_or(self.tool);
            self.loaded = Some(chosen).filter(|tool| *tool != 0.0);
        } else if block.m.contains(&(61, 0)) {
            self.loaded = block.letter(b'Q');
        }
    }

    /// Returns the position of W from the machine's zero, in millimetres.
    pub(super) fn w(&self) -> f64 {
        self.w[1]
    }

    /// Sets the end of W from its word.
    pub(super) fn move_w(&mut self, block: &mut Block, machine: bool) {
        if let Some(word) = block.take(b'W').map(|word| word * self.modal.mm_per_unit) {
            let relative = self.modal.relative && !machine;
            self.w[1] = if relative { self.w[0] + word } else { word };
        }
    }

    /// Checks the rotary and parallel axes, which no circuit has: they may be named as long as
    /// they do not move. Includes W if it is not an axis.
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
        // An inverse time is valid for its line only.
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
}

/// Choices made by the G words of a line.
#[derive(Debug, Default)]
pub(super) struct Words {
    pub(super) motion: Option<(Code, Motion)>,
    /// Instruction that takes the axis words for itself.
    pub(super) own: Option<(Code, Own)>,
    /// Tool length from the tool table.
    pub(super) length: Option<(Code, Length)>,
    pub(super) cancels: bool,
    /// True for G53.
    pub(super) machine: bool,
    pub(super) dwell: bool,
}

impl Machine<'_> {
    /// Returns an error unless the line gives a feed under inverse time.
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
