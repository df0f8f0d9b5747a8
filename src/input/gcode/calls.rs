//! Calls of subroutines and programs, and the ways back.

use super::expression::Name;
use super::modal::Modal;
use super::parameters::LOCALS;
use super::problem::Problem;
use super::runner::Runner;

/// How deep calls nest.
const DEEPEST: usize = 10;

/// A call that is being run.
#[derive(Debug)]
pub(super) struct Frame {
    /// Where it goes on after, and that line.
    pub(super) back: (usize, usize),
    /// Loops that were open before.
    pub(super) loops: usize,
    /// A program by its number has no parameters of its own.
    pub(super) program: Option<Again>,
    /// What M73 put aside.
    pub(super) modal: Option<Modal>,
}

/// A program that M98 calls.
#[derive(Debug, Clone, Copy)]
pub(super) struct Again {
    pub(super) place: usize,
    pub(super) left: u32,
}

impl Runner<'_> {
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

    pub(super) fn call(&mut self, label: &str, arguments: &[f64]) -> Result<(), Problem> {
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

    pub(super) fn call_program(
        &mut self,
        line: usize,
        program: Option<f64>,
        times: Option<f64>,
    ) -> Result<(), Problem> {
        let Some(program) = program else {
            return Err(Problem::new("M98", "without P", "M98 P1000"));
        };
        let mut number = format!("{program}");
        let mut repeats = times.unwrap_or(1.0);
        let mut found = self.index().program(&number);
        // P30002 is program 2 three times, where there is no program 30002.
        if found.is_none() && times.is_none() && program > 9999.0 && program.fract() == 0.0 {
            let last = format!("{}", program % 10_000.0);
            found = self.index().program(&last);
            if found.is_some() {
                (number, repeats) = (last, (program / 10_000.0).floor());
            }
        }
        let times = repeats.round().max(0.0) as u32;
        let Some(place) = found else {
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
