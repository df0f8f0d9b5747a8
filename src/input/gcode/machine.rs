//! What the words of a line do, given the lines before it.

use super::arc;
use super::block::{Block, Code};
use super::screen::Problem;
use crate::input::track::Track;
use crate::input::{Course, Drawing, Fault, Move, ZERO_MM};

const MM_PER_INCH: f64 = 25.4;

const G_CODES: &str = "G0 G1 G2 G3 G4 G17 G20 G21 G40 G49 G54 G61 G64 G80 G90 G91 G91.1 G94";
const M_CODES: &str = "M0 to M9 and M30";

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Motion {
    Rapid,
    Line,
    Arc { clockwise: bool },
}

impl Motion {
    fn name(self) -> &'static str {
        match self {
            Self::Rapid => "G0",
            Self::Line => "G1",
            Self::Arc { clockwise: true } => "G2",
            Self::Arc { clockwise: false } => "G3",
        }
    }
}

/// The modal state.
pub(super) struct Machine<'a> {
    track: Track<'a>,
    /// The programmed position, in millimetres.
    at: [f64; 3],
    motion: Option<Motion>,
    relative: bool,
    mm_per_unit: f64,
    feed_mm_per_min: Option<f64>,
    /// A line with words has been read.
    started: bool,
    ended: bool,
}

impl<'a> Machine<'a> {
    pub(super) fn new(file: &'a str) -> Self {
        Self {
            track: Track::new(file),
            at: [0.0; 3],
            motion: None,
            relative: false,
            mm_per_unit: 1.0,
            feed_mm_per_min: None,
            started: false,
            ended: false,
        }
    }

    /// The program has ended: nothing after this line counts.
    pub(super) fn ended(&self) -> bool {
        self.ended
    }

    /// Notes that there is text after the end of the program.
    pub(super) fn note_rest(&mut self, line: usize) {
        let text = || "text after the end of the program is not read".to_owned();
        self.track.note("rest", line, text);
    }

    pub(super) fn finish(self) -> Result<Drawing, Fault> {
        self.track.finish("a G-code program with at least one move")
    }

    /// Reads and runs one line, without its line feed.
    pub(super) fn run(&mut self, line: usize, text: &[u8]) -> Result<(), Fault> {
        let next = Block::read(text).and_then(|block| self.block(line, &block));
        match next {
            Ok(Some((motion, next))) => self.track.push(motion.name(), next),
            Ok(None) => Ok(()),
            Err(it) => Err(self.track.fault(line, it.field, it.problem, it.allowed)),
        }
    }

    /// The order within a line: units and distances, feed, M words, then the move.
    fn block(&mut self, line: usize, block: &Block) -> Result<Option<(Motion, Move)>, Problem> {
        if *block == Block::default() {
            return Ok(None);
        }
        if block.delimiter {
            if *block != Block::delimiter() {
                return Err(Problem::new(
                    "%",
                    "not alone in its line",
                    "% on a line of its own",
                ));
            }
            // The first % opens the program, the next one closes it.
            self.ended = self.started;
            self.started = true;
            return Ok(None);
        }
        self.started = true;
        let explicit = self.g_words(line, &block.g)?;
        if let Some(feed) = block.feed {
            if feed <= 0.0 {
                return Err(Problem::new(
                    "F",
                    format!("a feed of {feed}"),
                    "a feed above 0",
                ));
            }
            self.feed_mm_per_min = Some(feed * self.mm_per_unit);
        }
        self.m_words(line, &block.m)?;
        for (word, given) in [
            ("S", block.spindle.is_some()),
            ("T", block.tool),
            ("O", block.program_number),
        ] {
            if given {
                self.skip(word, line);
            }
        }
        self.motion(line, block, explicit)
    }

    /// Runs the G words; true where one of them chose how to move.
    fn g_words(&mut self, line: usize, codes: &[Code]) -> Result<bool, Problem> {
        let (mut motion, mut units, mut distance) = (None, None, None);
        for &code in codes {
            match code {
                (0, 0) => choose(&mut motion, code, Some(Motion::Rapid))?,
                (1, 0) => choose(&mut motion, code, Some(Motion::Line))?,
                (2, 0) => choose(&mut motion, code, Some(Motion::Arc { clockwise: true }))?,
                (3, 0) => choose(&mut motion, code, Some(Motion::Arc { clockwise: false }))?,
                (80, 0) => choose(&mut motion, code, None)?,
                (20, 0) => choose(&mut units, code, MM_PER_INCH)?,
                (21, 0) => choose(&mut units, code, 1.0)?,
                (90, 0) => choose(&mut distance, code, false)?,
                (91, 0) => choose(&mut distance, code, true)?,
                // What is so anyway: the plane, no compensation, the arc centre, the feed's unit.
                (17, 0) | (40, 0) | (49, 0) | (91, 1) | (94, 0) => {}
                (4, 0) => self
                    .track
                    .note("G4", line, || "G4: no dwell is made".to_owned()),
                (54 | 61 | 64, 0) => self.skip(&name('G', code), line),
                _ => return Err(Problem::new(name('G', code), "not supported", G_CODES)),
            }
        }
        if let Some((_, mm_per_unit)) = units {
            self.mm_per_unit = mm_per_unit;
        }
        if let Some((_, relative)) = distance {
            self.relative = relative;
        }
        if let Some((_, motion)) = motion {
            self.motion = motion;
        }
        Ok(motion.is_some())
    }

    fn m_words(&mut self, line: usize, codes: &[Code]) -> Result<(), Problem> {
        for &code in codes {
            match code {
                (2 | 30, 0) => self.ended = true,
                (0 | 1 | 3..=9, 0) => self.skip(&name('M', code), line),
                _ => return Err(Problem::new(name('M', code), "not supported", M_CODES)),
            }
        }
        Ok(())
    }

    fn skip(&mut self, word: &str, line: usize) {
        self.track.note(word, line, || format!("{word}: skipped"));
    }

    /// The move of a line, where its words make one.
    fn motion(
        &mut self,
        line: usize,
        block: &Block,
        explicit: bool,
    ) -> Result<Option<(Motion, Move)>, Problem> {
        let dwell = block.g.contains(&(4, 0));
        let moves = block.axes.iter().any(Option::is_some);
        let bends = block.centre.iter().any(Option::is_some) || block.radius.is_some();
        if dwell && (moves || bends || explicit) {
            return Err(Problem::new(
                "G4",
                "a dwell and a move in one line",
                "G4 with P only",
            ));
        }
        if block.dwell.is_some() && !dwell {
            return Err(Problem::new("P", "without G4", "P with G4 only"));
        }
        let arc = matches!(self.motion, Some(Motion::Arc { .. }));
        if !(moves || bends || (arc && explicit)) {
            return Ok(None);
        }
        let Some(motion) = self.motion else {
            return Err(Problem::new(
                "X, Y, Z",
                "no G0, G1, G2 or G3 in force",
                "G0 G1 G2 G3",
            ));
        };
        let from = self.at;
        for (at, word) in self.at.iter_mut().zip(block.axes) {
            if let Some(word) = word.map(|word| word * self.mm_per_unit) {
                *at = if self.relative { *at + word } else { word };
            }
        }
        let (to, course) = match motion {
            Motion::Arc { clockwise } => self.arc(block, from, clockwise)?,
            _ if bends => {
                let problem = format!("with {}", motion.name());
                return Err(Problem::new(
                    "I, J, R",
                    problem,
                    "I, J and R with G2 and G3 only",
                ));
            }
            _ => (self.at, Course::Line),
        };
        let rapid = motion == Motion::Rapid;
        if !rapid && self.feed_mm_per_min.is_none() {
            let text = || "no feed set; the feed of the settings applies".to_owned();
            self.track.note("feed", line, text);
        }
        let next = Move {
            to,
            course,
            rapid,
            feed_mm_per_min: if rapid { None } else { self.feed_mm_per_min },
            line,
        };
        Ok(Some((motion, next)))
    }

    /// The end and the course of an arc from `from` to the programmed position.
    fn arc(
        &self,
        block: &Block,
        from: [f64; 3],
        clockwise: bool,
    ) -> Result<([f64; 3], Course), Problem> {
        const FORMS: &str = "either I and J (the centre from the start) or R (the radius)";
        let [x, y, _] = from;
        let [end_x, end_y, end_z] = self.at;
        let given = |word: Option<f64>| word.unwrap_or(0.0) * self.mm_per_unit;
        let centre = match (block.centre, block.radius) {
            ([None, None], None) => {
                return Err(Problem::new(
                    "I, J, R",
                    "an arc without centre or radius",
                    FORMS,
                ));
            }
            ([i, j], None) => [x + given(i), y + given(j)],
            ([None, None], Some(radius)) => {
                let radius = radius * self.mm_per_unit;
                arc::centre_by_radius([x, y], [end_x, end_y], radius, clockwise).map_err(
                    |problem| Problem::new("R", problem, "half the distance to the end, or more"),
                )?
            }
            _ => return Err(Problem::new("I, J, R", "a centre and a radius", FORMS)),
        };
        arc::check([x, y], [end_x, end_y], centre).map_err(|problem| {
            Problem::new("I, J", problem, "radii that agree to 0.005 mm or 0.1 %")
        })?;
        // Rounding must not turn a full circle into next to nothing.
        let full = (end_x - x).abs() < ZERO_MM && (end_y - y).abs() < ZERO_MM;
        let [here_x, here_y, _] = self.track.here();
        let to = if full {
            [here_x, here_y, end_z]
        } else {
            self.at
        };
        Ok((to, Course::Arc { centre, clockwise }))
    }
}

/// Sets what one word of a line may choose only once.
fn choose<T>(place: &mut Option<(Code, T)>, code: Code, value: T) -> Result<(), Problem> {
    if let Some((other, _)) = place {
        let problem = format!("together with {} in one line", name('G', *other));
        return Err(Problem::new(
            name('G', code),
            problem,
            "one of them in a line",
        ));
    }
    *place = Some((code, value));
    Ok(())
}

fn name(letter: char, (whole, tenths): Code) -> String {
    match tenths {
        0 => format!("{letter}{whole}"),
        _ => format!("{letter}{whole}.{tenths}"),
    }
}
