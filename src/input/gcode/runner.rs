//! Execution of a program line by line, with its calls, branches and loops.

use std::rc::Rc;

use super::Options;
use super::block::{Block, Code};
use super::calls::Frame;
use super::expression::{Name, Values};
use super::flow::{Index, Keyword, Place, o_word};
use super::library::{Library, Source};
use super::machine::Machine;
use super::mark;
use super::parameters::Parameters;
use super::problem::Problem;
use super::text::{clean, line_at};
use crate::input::brief;
use crate::input::{Drawing, Fault, Faults};

/// Program being executed.
pub(super) struct Runner<'a> {
    /// Current text: the program, or a file that it calls.
    pub(super) source: Rc<Source<'a>>,
    pub(super) library: Library<'a>,
    options: &'a Options,
    pub(super) machine: Machine<'a>,
    pub(super) parameters: Parameters,
    /// Offset and number of the next line.
    pub(super) at: (usize, usize),
    pub(super) frames: Vec<Frame<'a>>,
    /// Active REPEATs with their number of repetitions so far.
    pub(super) loops: Vec<(usize, u64)>,
    executed: u64,
    started: bool,
    pub(super) ended: bool,
    faults: Faults,
}

/// Values that expressions can read.
pub(super) struct Known<'k, 'a> {
    parameters: &'k Parameters,
    machine: &'k Machine<'a>,
    line: usize,
    level: usize,
}

impl Values for Known<'_, '_> {
    fn value(&self, name: &Name) -> Result<Option<f64>, Problem> {
        let machine = match name {
            Name::Number(number) => self.machine.parameter(*number),
            Name::Text(text) => match text.as_str() {
                "_LINE" => Some(self.line as f64),
                "_CALL_LEVEL" => Some(self.level as f64),
                text => self.machine.named(text),
            },
        };
        match machine {
            Some(value) => Ok(Some(value)),
            None => self.parameters.get(name),
        }
    }
}

impl<'a> Runner<'a> {
    pub(super) fn new(file: &'a str, text: &'a [u8], options: &'a Options) -> Self {
        Self {
            source: Rc::new(Source::program(text)),
            library: Library::new(&options.subroutines),
            options,
            machine: Machine::new(file, options),
            parameters: Parameters::new(),
            at: (0, 1),
            frames: Vec::new(),
            loops: Vec::new(),
            executed: 0,
            started: false,
            ended: false,
            faults: Faults::default(),
        }
    }

    /// Executes the program to its end.
    pub(super) fn run(mut self) -> Result<Drawing, Fault> {
        let (mut cleaned, mut block) = (Vec::new(), Block::default());
        while !self.ended {
            let (start, line) = self.at;
            let source = Rc::clone(&self.source);
            self.machine.track.within(source.file.as_deref());
            let Some((bytes, next)) = line_at(&source.text, start) else {
                if !source.is_program() {
                    let fault = self.machine.fault(line - 1, unended());
                    self.faults.add(fault);
                }
                break;
            };
            self.at = (next, line + 1);
            let done = self.step(bytes, start, line, &mut cleaned, &mut block);
            self.machine.track.within(source.file.as_deref());
            if let Err(problem) = done
                && (!problem.follows || self.faults.is_empty())
            {
                let marked = mark::find(bytes, &problem);
                let fault = self.machine.fault(line, problem).marked(bytes, &marked);
                self.ended |= !self.faults.add(fault);
            }
        }
        let source = Rc::clone(&self.source);
        let known = source.known_index();
        if self.ended && known.is_none() && source.is_program() {
            self.look_at_rest();
        }
        let unused = known.is_some_and(Index::has_subs);
        self.faults.or(|| self.machine.finish(unused))
    }

    fn step(
        &mut self,
        bytes: &[u8],
        start: usize,
        line: usize,
        cleaned: &mut Vec<u8>,
        block: &mut Block,
    ) -> Result<(), Problem> {
        self.count(1)?;
        if self.outside(bytes, line)? {
            return Ok(());
        }
        clean(bytes, cleaned)?;
        if cleaned.iter().all(|byte| *byte == b' ') || self.delimiter(cleaned)? {
            return Ok(());
        }
        self.started = true;
        let word = o_word(cleaned, Some(&self.known(line)))?;
        match word {
            Some((_, Keyword::Program, rest)) => {
                self.machine.skip("O", line);
                self.words(rest.rest(), line, block)?;
            }
            Some((label, keyword, rest)) => {
                // After a fault the continuation is unknown.
                let done = self.flow(start, line, &label, keyword, rest);
                self.ended |= done.is_err();
                return done;
            }
            None => self.words(cleaned, line, block)?,
        }
        self.machine.push(line, self.line_of_program(line))
    }

    /// Counts executed lines.
    fn count(&mut self, lines: u64) -> Result<(), Problem> {
        self.executed = self.executed.saturating_add(lines);
        let most = self.options.most_lines;
        if self.executed <= most {
            return Ok(());
        }
        self.ended = true;
        let problem = format!("more than {most} lines are run");
        let allowed = "a program that ends before; --most-lines for more";
        Err(Problem::new("program", problem, allowed))
    }

    /// Handles lines without words: settings of controls, and texts for a display.
    fn outside(&mut self, bytes: &[u8], line: usize) -> Result<bool, Problem> {
        let text = bytes.trim_ascii_start();
        let display = |code: &[u8]| {
            text.get(..4).is_some_and(|m| m.eq_ignore_ascii_case(code))
                && !text.get(4).is_some_and(u8::is_ascii_digit)
        };
        let texts = ["M115", "M117", "M118", "M486", "M862"];
        let what = match text.first() {
            Some(b'$') if !is_setting(text) => {
                let text = brief(&String::from_utf8_lossy(text));
                let problem = "a command of a control that may move";
                return Err(Problem::new(
                    text,
                    problem,
                    "$ and settings such as $110=500",
                ));
            }
            Some(b'$') => "$",
            Some(b'M' | b'm') => match texts.iter().find(|code| display(code.as_bytes())) {
                Some(code) => code,
                None => return Ok(false),
            },
            Some(byte) if byte.is_ascii_alphabetic() => return self.control_macro(text, line),
            _ => return Ok(false),
        };
        self.machine.say_nothing(what, line)?;
        Ok(true)
    }

    /// Skips a macro of a printer's control, such as `EXCLUDE_OBJECT_START NAME=a`: no word
    /// contains a `_`.
    fn control_macro(&mut self, text: &[u8], line: usize) -> Result<bool, Problem> {
        let name = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_';
        let end = text.iter().position(|byte| !name(byte));
        let name = text.get(..end.unwrap_or(text.len())).unwrap_or_default();
        if !name.contains(&b'_') {
            return Ok(false);
        }
        let name = String::from_utf8_lossy(name).to_ascii_uppercase();
        let harmless = ["EXCLUDE_OBJECT_", "SET_", "TIMELAPSE_"];
        let moves = [
            "SET_GCODE_OFFSET",
            "SET_KINEMATIC_POSITION",
            "SET_SKEW",
            "SET_DUAL_CARRIAGE",
            "SET_STEPPER_CARRIAGES",
            "SET_Z_THERMAL_ADJUST",
        ];
        if harmless.iter().any(|start| name.starts_with(start)) && !moves.contains(&&*name) {
            self.machine.say_nothing(&brief(&name), line)?;
            return Ok(true);
        }
        let problem = "a macro of a control, which may move";
        let allowed =
            "words, and macros EXCLUDE_OBJECT_..., TIMELAPSE_... and SET_... without a move";
        Err(Problem::new(brief(&name), problem, allowed))
    }

    /// Handles `%`: the first opens the program, the next one closes it.
    fn delimiter(&mut self, cleaned: &[u8]) -> Result<bool, Problem> {
        if !cleaned.contains(&b'%') {
            return Ok(false);
        }
        if cleaned.iter().any(|byte| !matches!(byte, b'%' | b' ')) {
            let allowed = "% on a line of its own";
            return Err(Problem::new("%", "not alone in its line", allowed));
        }
        if !self.source.is_program() {
            self.ended = true;
            return Err(unended());
        }
        self.ended = self.started;
        self.started = true;
        Ok(true)
    }

    pub(super) fn known(&self, line: usize) -> Known<'_, 'a> {
        Known {
            parameters: &self.parameters,
            machine: &self.machine,
            line,
            level: self.frames.len(),
        }
    }

    /// Parses the words of a line and executes them.
    fn words(&mut self, cleaned: &[u8], line: usize, block: &mut Block) -> Result<(), Problem> {
        block.read(cleaned, &self.known(line))?;
        for (name, value) in block.sets.drain(..) {
            self.parameters.set(name, value)?;
        }
        if !block.any {
            return Ok(());
        }
        let has = |code: Code| block.m.contains(&code);
        let (calls, returns, keeps) = (has((98, 0)), has((99, 0)), has((73, 0)));
        let ends = has((2, 0)) || has((30, 0));
        let called = calls.then(|| (block.take(b'P'), block.take(b'L')));
        let keeps = keeps && block.letter(b'P').is_none() && block.letter(b'R').is_none();
        if keeps && let Some(frame) = self.frames.last_mut() {
            frame.modal = Some(self.machine.modal());
        }
        if returns && block.letter(b'P').is_some() {
            let problem = "with M99: a jump to a line number, which is not understood";
            return Err(Problem::new('P', problem, "M99 alone"));
        }
        let repeats = self.machine.run(line, block)?;
        self.count(repeats)?;
        if let Some((program, times)) = called {
            self.call_program(line, program, times)?;
        }
        if returns && !self.leave(None)? {
            let text = || "M99 outside of a subprogram: the program ends".to_owned();
            self.machine.note("M99", line, text);
            self.ended = true;
        }
        self.ended |= ends;
        Ok(())
    }

    pub(super) fn place(&self, at: Option<usize>) -> Option<&Place> {
        at.and_then(|at| self.source.index().places.get(at))
    }

    /// Continues after the line of an O-word.
    pub(super) fn go_after(&mut self, at: Option<usize>) {
        if let Some(to) = self.place(at).map(|place| (place.next, place.line + 1)) {
            self.at = to;
        }
    }

    /// Warns about text after the end.
    fn look_at_rest(&mut self) {
        let (mut at, mut line) = self.at;
        let source = Rc::clone(&self.source);
        while let Some((bytes, next)) = line_at(&source.text, at) {
            let first = bytes.trim_ascii().first();
            if !matches!(first, None | Some(b'%' | b';' | b'(')) {
                let text = || "text after the end of the program is not read".to_owned();
                self.machine.note("rest", line, text);
                return;
            }
            (at, line) = (next, line + 1);
        }
    }
}

/// Returns the error of a file that ends, or would end the program, inside a call.
fn unended() -> Problem {
    let problem = "ends inside a call";
    Problem::new(
        "file",
        problem,
        "ENDSUB, RETURN or M99 before the end of the file",
    )
}

/// True if a line with `$` shows or sets a parameter of a control; `$H`, `$J` and others move.
fn is_setting(text: &[u8]) -> bool {
    let name = text.get(1..).unwrap_or_default().trim_ascii();
    let name = name.split(|byte| *byte == b'=').next().unwrap_or_default();
    let number = name.strip_prefix(b"N").or_else(|| name.strip_prefix(b"n"));
    number.unwrap_or(name).iter().all(u8::is_ascii_digit)
        || matches!(name, b"$" | b"#" | b"G" | b"g" | b"I" | b"i" | b"X" | b"x")
}
