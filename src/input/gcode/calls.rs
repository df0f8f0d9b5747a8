//! Calls of subroutines and programs, and their returns.

use std::rc::Rc;

use super::expression::Name;
use super::library::{Source, not_there};
use super::modal::Modal;
use super::parameters::LOCALS;
use super::problem::Problem;
use super::runner::Runner;

/// Greatest nesting depth of calls.
const DEEPEST: usize = 10;

/// Active call.
#[derive(Debug)]
pub(super) struct Frame<'a> {
    /// Position after the call, and its line.
    back: (usize, usize),
    /// Text that contains the call.
    pub(super) source: Rc<Source<'a>>,
    /// Line of the call.
    pub(super) line: usize,
    /// Number of loops that were open before.
    pub(super) loops: usize,
    /// Program called by number, which has no parameters of its own.
    program: Option<Again>,
    /// Modal state saved by M73.
    pub(super) modal: Option<Modal>,
}

/// Program called by M98.
#[derive(Debug, Clone, Copy)]
struct Again {
    place: usize,
    left: u32,
}

impl<'a> Runner<'a> {
    fn enter(
        &mut self,
        line: usize,
        source: Rc<Source<'a>>,
        program: Option<Again>,
    ) -> Result<(), Problem> {
        if self.frames.len() >= DEEPEST {
            let problem = format!("calls nest deeper than {DEEPEST}");
            return Err(Problem::new(
                "call",
                problem,
                "fewer calls inside each other",
            ));
        }
        let source = std::mem::replace(&mut self.source, source);
        self.frames.push(Frame {
            back: self.at,
            source,
            line,
            loops: self.loops.len(),
            program,
            modal: None,
        });
        Ok(())
    }

    pub(super) fn call(
        &mut self,
        line: usize,
        label: &str,
        arguments: &[f64],
    ) -> Result<(), Problem> {
        let field = format!("O{label} CALL");
        if arguments.len() > LOCALS {
            let problem = format!("{} arguments", arguments.len());
            return Err(Problem::new(field, problem, format!("at most {LOCALS}")));
        }
        let (source, sub) = self.subroutine(&field, line, label)?;
        self.enter(line, source, None)?;
        self.parameters.enter(arguments);
        self.go_after(Some(sub));
        Ok(())
    }

    /// Returns the subroutine of a label: from this file, the program, or a file of its own.
    fn subroutine(
        &mut self,
        field: &str,
        line: usize,
        label: &str,
    ) -> Result<(Rc<Source<'a>>, usize), Problem> {
        let own = self.source.index().sub(label);
        let own_line = self.place(own).map(|place| place.line);
        let own = own.map(|sub| (Rc::clone(&self.source), sub));
        if own_line.is_some_and(|begin| begin < line) {
            return own.ok_or_else(|| not_there(field, "a subroutine"));
        }
        // A file has precedence over a subroutine after the call, as in LinuxCNC; other controls
        // do the opposite.
        if let Some(found) = self.library.find(field, label)? {
            let file = found.file.clone().unwrap_or_default();
            if own.is_some() && !Rc::ptr_eq(&found, &self.source) {
                let problem = format!("may be the one behind it, or that of {file}");
                return Err(Problem::new(
                    field,
                    problem,
                    "subroutines before their calls",
                ));
            }
            let sub = found.index().sub(label).ok_or_else(|| {
                let problem = format!("calls {file}, which has no O{label} SUB");
                Problem::new(field, problem, "a file with the subroutine of its name")
            })?;
            let end = found.index().places.get(sub).and_then(|place| place.end);
            if end.is_none() {
                let problem = format!("calls {file}, whose O{label} SUB has no ENDSUB");
                return Err(Problem::new(field, problem, "subroutines with both ends"));
            }
            return Ok((found, sub));
        }
        let program = self.program_source();
        let seen = program
            .index()
            .sub(label)
            .filter(|_| !self.source.is_program());
        let seen = seen.map(|sub| (program, sub));
        own.or(seen).ok_or_else(|| not_there(field, "a subroutine"))
    }

    pub(super) fn call_program(
        &mut self,
        line: usize,
        program: Option<f64>,
        times: Option<f64>,
    ) -> Result<(), Problem> {
        let Some(program) = program else {
            return Err(Problem::new("M98", "without P", "M98 P1000"));
        };
        let mut repeats = times.unwrap_or(1.0);
        let mut found = self.numbered(&format!("{program}"))?;
        // P30002 is program 2 three times, if there is no program 30002.
        if found.is_none() && times.is_none() && program > 9999.0 && program.fract() == 0.0 {
            found = self.numbered(&format!("{}", program % 10_000.0))?;
            repeats = (program / 10_000.0).floor();
        }
        let times = repeats.round().max(0.0) as u32;
        let Some((source, place)) = found else {
            return Err(not_there("M98", &format!("program O{program}")));
        };
        if times == 0 {
            self.machine.skip("M98 L0", line);
            return Ok(());
        }
        let left = times - 1;
        self.enter(line, source, Some(Again { place, left }))?;
        self.go_after(Some(place));
        Ok(())
    }

    /// Returns the program of a number: from this file, the program, or a file of its own.
    fn numbered(&mut self, number: &str) -> Result<Option<(Rc<Source<'a>>, usize)>, Problem> {
        for source in [Rc::clone(&self.source), self.program_source()] {
            if let Some(place) = source.index().program(number) {
                return Ok(Some((source, place)));
            }
        }
        if !number.bytes().all(|byte| byte.is_ascii_digit()) {
            return Ok(None);
        }
        let Some(source) = self.library.find("M98", number)? else {
            return Ok(None);
        };
        let place = source.index().program(number).ok_or_else(|| {
            let file = source.file.as_deref().unwrap_or_default();
            let problem = format!("calls {file}, which has no line O{number}");
            Problem::new("M98", problem, "a file with the program of its name")
        })?;
        Ok(Some((source, place)))
    }

    /// Returns the text of the main program, whatever file is running.
    fn program_source(&self) -> Rc<Source<'a>> {
        let frame = self.frames.first();
        Rc::clone(frame.map_or(&self.source, |frame| &frame.source))
    }

    /// Returns the line of the program for a line of the running text: the call in the program
    /// that led to a file of subroutines.
    pub(super) fn line_of_program(&self, line: usize) -> usize {
        if self.source.is_program() {
            return line;
        }
        let mut frames = self.frames.iter().rev();
        let call = frames.find(|frame| frame.source.is_program());
        call.map_or(line, |frame| frame.line)
    }

    /// Returns from a call; returns false if there is none.
    pub(super) fn leave(&mut self, value: Option<f64>) -> Result<bool, Problem> {
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
        self.source = frame.source;
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
}
