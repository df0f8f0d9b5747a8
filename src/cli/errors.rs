//! Errors as JSON on standard output, where `--json` is given.

use super::{Failure, plain, voice};
use motion_rtl::input::Fault;
use motion_rtl::sim::RunError;
use serde::Serialize;
use std::io::{Write as _, stderr, stdout};
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// Version of what is printed as JSON; it grows when a key goes or changes its meaning.
pub const VERSION: u32 = 1;

/// True once a result was printed as JSON: it has what is wrong in it.
static PRINTED: AtomicBool = AtomicBool::new(false);

/// Notes that standard output has its JSON.
pub fn is_printed() {
    PRINTED.store(true, Relaxed);
}

#[derive(Debug, Serialize)]
struct Output<'a> {
    version: u32,
    error: Error<'a>,
}

#[derive(Debug, Serialize)]
struct Error<'a> {
    kind: &'static str,
    message: String,
    /// Every fault of a file or of an argument; empty for other kinds.
    faults: Vec<Found<'a>>,
}

#[derive(Debug, Serialize)]
struct Found<'a> {
    file: Option<&'a str>,
    line: Option<usize>,
    field: &'a str,
    problem: &'a str,
    allowed: &'a str,
}

impl<'a> Found<'a> {
    fn of(fault: &'a Fault) -> Self {
        Found {
            file: Some(&fault.file),
            line: (fault.line > 0).then_some(fault.line),
            field: &fault.field,
            problem: &fault.problem,
            allowed: &fault.allowed,
        }
    }
}

impl<'a> Error<'a> {
    fn of(failure: &'a Failure) -> Self {
        let (kind, faults) = match failure {
            Failure::Input(fault) => ("input", fault.all().map(Found::of).collect()),
            Failure::Argument {
                field,
                problem,
                allowed,
            } => {
                let found = Found {
                    file: None,
                    line: None,
                    field,
                    problem,
                    allowed,
                };
                ("argument", vec![found])
            }
            Failure::Pairs(wrong) => {
                let found = wrong.iter().map(|wrong| Found {
                    file: None,
                    line: None,
                    field: &wrong.pair.key,
                    problem: &wrong.problem,
                    allowed: &wrong.allowed,
                });
                ("argument", found.collect())
            }
            Failure::File(_) => ("file", Vec::new()),
            Failure::Run(RunError::Violation { .. }) | Failure::Check(_) => ("check", Vec::new()),
            Failure::Run(_) => ("run", Vec::new()),
            Failure::Undecided(_) => ("undecided", Vec::new()),
        };
        Error {
            kind,
            message: failure.to_string(),
            faults,
        }
    }
}

/// Prints a failure as JSON, where that is asked for and no result was printed.
pub fn as_json(failure: &Failure) {
    print(Error::of(failure));
}

/// Reports a command line that cannot be parsed.
pub fn usage(error: &clap::Error) {
    // If standard error is closed, only the exit code remains.
    let _ = match std::env::args().any(|word| word.contains(char::is_control)) {
        true => write!(stderr(), "{}", plain(&error.to_string())),
        false => error.print(),
    };
    let text = error.to_string();
    let message = text.strip_prefix("error: ").unwrap_or(&text);
    let message = message.split("\n\n").next().unwrap_or(message);
    print(Error {
        kind: "usage",
        message: message.to_owned(),
        faults: Vec::new(),
    });
}

fn print(error: Error<'_>) {
    if !voice::wants_json() || PRINTED.load(Relaxed) {
        return;
    }
    let output = Output {
        version: VERSION,
        error,
    };
    // If standard output is closed, only the exit code remains.
    if let Ok(text) = serde_json::to_string_pretty(&output) {
        let _ = writeln!(stdout(), "{}", plain(&text));
    }
}
