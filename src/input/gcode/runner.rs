//! A program line by line, with its calls, branches and loops.

use super::Options;
use super::block::{Block, Code};
use super::expression::{Name, Scanner, Values};
use super::flow::{Index, Keyword, Place, o_word};
use super::machine::Machine;
use super::mark;
use super::modal::Modal;
use super::parameters::{LOCALS, Parameters};
use super::problem::{Problem, shown};
use super::text::{clean, line_at};
use crate::input::{Drawing, Fault, Faults};

/// How deep calls nest.
const DEEPEST: usize = 10;

/// A call that is being run.
#[derive(Debug)]
struct Frame {
    /// Where it goes on after, and that line.
    back: (usize, usize),
    /// Loops that were open before.
    loops: usize,
    /// A program by its number has no parameters of its own.
    program: Option<Again>,
    /// What M73 put aside.
    modal: Option<Modal>,
}

/// A program that M98 calls.
#[derive(Debug, Clone, Copy)]
struct Again {
    place: usize,
    left: u32,
}

/// A program in its text.
pub(super) struct Runner<'a> {
    text: &'a [u8],
    options: &'a Options,
    machine: Machine<'a>,
    parameters: Parameters,
    /// Where the next line begins, and its number.
    at: (usize, usize),
    index: Option<Index>,
    frames: Vec<Frame>,
    /// REPEATs that are being run, and how often yet.
    loops: Vec<(usize, u64)>,
    executed: u64,
    started: bool,
    ended: bool,
    faults: Faults,
}

/// What expressions see.
struct Known<'k, 'a> {
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
            text,
            options,
            machine: Machine::new(file, options),
            parameters: Parameters::new(),
            at: (0, 1),
            index: None,
            frames: Vec::new(),
            loops: Vec::new(),
            executed: 0,
            started: false,
            ended: false,
            faults: Faults::default(),
        }
    }

    /// Runs the program to its end.
    pub(super) fn run(mut self) -> Result<Drawing, Fault> {
        let (mut cleaned, mut block) = (Vec::new(), Block::default());
        while !self.ended {
            let (start, line) = self.at;
            let Some((bytes, next)) = line_at(self.text, start) else {
                break;
            };
            self.at = (next, line + 1);
            let done = self.step(bytes, start, line, &mut cleaned, &mut block);
            if let Err(problem) = done
                && (!problem.follows || self.faults.is_empty())
            {
                let marked = mark::find(bytes, &problem);
                let fault = self.machine.fault(line, problem).marked(bytes, &marked);
                self.ended |= !self.faults.add(fault);
            }
        }
        if self.ended && self.index.is_none() {
            self.look_at_rest();
        }
        let unused = self.index.as_ref().is_some_and(Index::has_subs);
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
        match o_word(cleaned)? {
            Some((_, Keyword::Program, rest)) => {
                self.machine.skip("O", line);
                self.words(rest.rest(), line, block)?;
            }
            Some((label, keyword, rest)) => {
                // Where it would go on is not known after a fault.
                let done = self.flow(start, line, &label, keyword, rest);
                self.ended |= done.is_err();
                return done;
            }
            None => self.words(cleaned, line, block)?,
        }
        self.machine.push(line)
    }

    /// Counts lines that are run.
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

    /// Lines that hold no words: settings of controls, and texts for a display.
    fn outside(&mut self, bytes: &[u8], line: usize) -> Result<bool, Problem> {
        let text = bytes.trim_ascii_start();
        let display = |code: &[u8]| {
            text.get(..4).is_some_and(|m| m.eq_ignore_ascii_case(code))
                && !text.get(4).is_some_and(u8::is_ascii_digit)
        };
        let texts = ["M115", "M117", "M118", "M486", "M862"];
        let what = match text.first() {
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

    /// A macro of a printer's control, as `EXCLUDE_OBJECT_START NAME=a`: no word has a `_` in it.
    fn control_macro(&mut self, text: &[u8], line: usize) -> Result<bool, Problem> {
        let name = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_';
        let end = text.iter().position(|byte| !name(byte));
        let name = text.get(..end.unwrap_or(text.len())).unwrap_or_default();
        if !name.contains(&b'_') {
            return Ok(false);
        }
        let name = String::from_utf8_lossy(name).to_ascii_uppercase();
        let harmless = ["EXCLUDE_OBJECT", "SET_", "TIMELAPSE_"];
        if harmless.iter().any(|start| name.starts_with(start)) && name != "SET_GCODE_OFFSET" {
            self.machine.say_nothing(&shown(&name), line)?;
            return Ok(true);
        }
        let problem = "a macro of a control, which may move";
        let allowed = "words, and macros EXCLUDE_OBJECT_..., SET_... and TIMELAPSE_...";
        Err(Problem::new(shown(&name), problem, allowed))
    }

    /// The first `%` opens the program, the next one closes it.
    fn delimiter(&mut self, cleaned: &[u8]) -> Result<bool, Problem> {
        if !cleaned.contains(&b'%') {
            return Ok(false);
        }
        if cleaned.iter().any(|byte| !matches!(byte, b'%' | b' ')) {
            let allowed = "% on a line of its own";
            return Err(Problem::new("%", "not alone in its line", allowed));
        }
        self.ended = self.started;
        self.started = true;
        Ok(true)
    }

    fn known(&self, line: usize) -> Known<'_, 'a> {
        Known {
            parameters: &self.parameters,
            machine: &self.machine,
            line,
            level: self.frames.len(),
        }
    }

    /// Reads the words of a line and has the machine do them.
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
        if returns {
            block.take(b'P');
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

    fn index(&mut self) -> &Index {
        self.index.get_or_insert_with(|| Index::of(self.text))
    }

    fn place(&mut self, at: Option<usize>) -> Option<&Place> {
        at.and_then(|at| self.index().places.get(at))
    }

    /// Goes on after the line of an O-word.
    fn go_after(&mut self, at: Option<usize>) {
        if let Some(to) = self.place(at).map(|place| (place.next, place.line + 1)) {
            self.at = to;
        }
    }

    fn flow(
        &mut self,
        start: usize,
        line: usize,
        label: &str,
        keyword: Keyword,
        mut rest: Scanner<'_>,
    ) -> Result<(), Problem> {
        use Keyword as K;
        let field = format!("O{label} {}", keyword.name());
        let here = self.index().at(start);
        let lone = || {
            Problem::new(
                &field,
                "without the rest of its block",
                "blocks with both ends",
            )
        };
        let (head, onward, end) = self
            .place(here)
            .map(|place| (place.head, place.onward, place.end))
            .ok_or_else(lone)?;
        let closes = head != here;
        let mut value = None;
        let needs = matches!(keyword, K::If | K::ElseIf | K::While | K::Repeat);
        let mut arguments = Vec::new();
        while rest.next_word() == Some(b'[') {
            arguments.push(rest.value(&self.known(line))?);
        }
        if rest.next_word().is_some() {
            let problem = format!("'{}' behind it", rest.rest_text());
            return Err(Problem::new(field, problem, "nothing but values in []"));
        }
        if keyword != K::Call {
            value = arguments.first().copied();
        }
        if needs && value.is_none() {
            return Err(Problem::new(field, "without a value", "a value in []"));
        }
        let holds = value.is_some_and(|value| value != 0.0);
        let paired = match keyword {
            K::Call | K::Return => true,
            K::Break | K::Continue => head.is_some(),
            _ => end.is_some(),
        };
        if !paired {
            return Err(lone());
        }
        match keyword {
            // Whatever is run ends with its endsub.
            K::Sub | K::Do | K::EndIf | K::Program => {
                if keyword == K::Sub {
                    self.go_after(end);
                }
            }
            K::Call => self.call(label, &arguments)?,
            K::Return | K::EndSub => {
                if !self.leave(value)? {
                    return Err(Problem::new(
                        field,
                        "outside of a call",
                        "inside a called sub",
                    ));
                }
            }
            K::If if !holds => self.branch(onward)?,
            // A branch that was run to its end.
            K::ElseIf | K::Else => self.go_after(end),
            K::While if closes && holds => self.go_after(head),
            K::While if !closes && !holds => self.go_after(end),
            K::If | K::While => {}
            K::EndWhile => self.go_to(head),
            K::Repeat => {
                let times = value.unwrap_or(0.0).round().max(0.0) as u64;
                if times == 0 {
                    self.go_after(end);
                } else if let Some(here) = here {
                    self.loops.push((here, times - 1));
                }
            }
            K::EndRepeat => self.repeat(head),
            K::Break | K::Continue => self.leave_loop(keyword, head)?,
        }
        Ok(())
    }

    /// Goes to the line of an O-word.
    fn go_to(&mut self, at: Option<usize>) {
        if let Some(to) = self.place(at).map(|place| (place.start, place.line)) {
            self.at = to;
        }
    }

    /// Tries the branches behind an IF that does not hold.
    fn branch(&mut self, mut at: Option<usize>) -> Result<(), Problem> {
        while let Some(place) = self.place(at) {
            let (keyword, start, line, onward) =
                (place.keyword, place.start, place.line, place.onward);
            let mut taken = true;
            if keyword == Keyword::ElseIf {
                let (mut cleaned, text) = (Vec::new(), self.text);
                let bytes = line_at(text, start).map_or(&[][..], |(bytes, _)| bytes);
                clean(bytes, &mut cleaned)?;
                if let Some((_, _, mut rest)) = o_word(&cleaned)? {
                    rest.next_word();
                    taken = rest.value(&self.known(line))? != 0.0;
                }
            }
            if taken {
                self.go_after(at);
                return Ok(());
            }
            at = onward;
        }
        Ok(())
    }

    fn repeat(&mut self, head: Option<usize>) {
        match self.loops.last_mut() {
            Some((at, left)) if Some(*at) == head && *left > 0 => {
                *left -= 1;
                self.go_after(head);
            }
            Some((at, _)) if Some(*at) == head => {
                self.loops.pop();
            }
            _ => {}
        }
    }

    fn leave_loop(&mut self, keyword: Keyword, head: Option<usize>) -> Result<(), Problem> {
        let Some(place) = self.place(head) else {
            return Ok(());
        };
        let (kind, end) = (place.keyword, place.end);
        if end.is_none() {
            let name = kind.name();
            return Err(Problem::new(
                name,
                "without its end",
                "blocks with both ends",
            ));
        }
        // Loops inside the one that is left or goes on are over.
        let base = self.frames.last().map_or(0, |frame| frame.loops);
        let inner = |(at, _): &(usize, u64)| Some(*at) > head;
        while self.loops.len() > base && self.loops.last().is_some_and(inner) {
            self.loops.pop();
        }
        if keyword == Keyword::Continue {
            match kind {
                Keyword::While => self.go_to(head),
                Keyword::Repeat => {
                    self.go_after(end);
                    self.repeat(head);
                }
                _ => self.go_to(end),
            }
            return Ok(());
        }
        if kind == Keyword::Repeat {
            self.loops.pop();
        }
        self.go_after(end);
        Ok(())
    }

    fn enter(&mut self, program: Option<Again>) -> Result<(), Problem> {
        if self.frames.len() >= DEEPEST {
            let problem = format!("calls nest deeper than {DEEPEST}");
            return Err(Problem::new(
                "call",
                problem,
                "fewer calls inside each other",
            ));
        }
        self.frames.push(Frame {
            back: self.at,
            loops: self.loops.len(),
            program,
            modal: None,
        });
        Ok(())
    }

    fn call(&mut self, label: &str, arguments: &[f64]) -> Result<(), Problem> {
        let field = format!("O{label} CALL");
        if arguments.len() > LOCALS {
            let problem = format!("{} arguments", arguments.len());
            return Err(Problem::new(field, problem, format!("at most {LOCALS}")));
        }
        let Some(sub) = self.index().sub(label) else {
            let problem = "calls a subroutine that is not in this file";
            return Err(Problem::new(
                field,
                problem,
                "subroutines of the file itself",
            ));
        };
        self.enter(None)?;
        self.parameters.enter(arguments);
        self.go_after(Some(sub));
        Ok(())
    }

    fn call_program(
        &mut self,
        line: usize,
        program: Option<f64>,
        times: Option<f64>,
    ) -> Result<(), Problem> {
        let Some(program) = program else {
            return Err(Problem::new("M98", "without P", "M98 P1000"));
        };
        let times = times.unwrap_or(1.0).round().max(0.0) as u32;
        let number = format!("{program}");
        let Some(place) = self.index().program(&number) else {
            let problem = format!("calls program O{number}, which is not in this file");
            return Err(Problem::new("M98", problem, "programs of the file itself"));
        };
        if times == 0 {
            self.machine.skip("M98 L0", line);
            return Ok(());
        }
        let left = times - 1;
        self.enter(Some(Again { place, left }))?;
        self.go_after(Some(place));
        Ok(())
    }

    /// Returns from a call; false where there is none.
    fn leave(&mut self, value: Option<f64>) -> Result<bool, Problem> {
        let Some(frame) = self.frames.last_mut() else {
            return Ok(false);
        };
        self.loops.truncate(frame.loops);
        if let Some(again) = &mut frame.program
            && again.left > 0
        {
            again.left -= 1;
            let place = again.place;
            self.go_after(Some(place));
            return Ok(true);
        }
        let Some(frame) = self.frames.pop() else {
            return Ok(false);
        };
        if frame.program.is_none() {
            self.parameters.leave();
            let returned = Name::Text("_VALUE_RETURNED".to_owned());
            self.parameters
                .set(returned, f64::from(u8::from(value.is_some())))?;
            if let Some(value) = value {
                self.parameters
                    .set(Name::Text("_VALUE".to_owned()), value)?;
            }
        }
        if let Some(modal) = frame.modal {
            self.machine.restore(modal);
        }
        self.at = frame.back;
        Ok(true)
    }

    /// Warns where there is text after the end.
    fn look_at_rest(&mut self) {
        let (mut at, mut line) = self.at;
        while let Some((bytes, next)) = line_at(self.text, at) {
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
