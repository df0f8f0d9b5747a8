//! Errors as JSON on standard output, where `--json` is given.

use super::voice::{self, Level};
use super::{Failure, json, plain};
use motion_rtl::input::Fault;
use motion_rtl::sim::RunError;
use serde::Serialize;
use std::borrow::Cow;
use std::io::{Write as _, stderr, stdout};

/// An error as JSON.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Output<'a> {
    /// Version of the keys.
    version: u32,
    /// The error.
    error: Error<'a>,
}

/// A failure of a command.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct Error<'a> {
    /// Kind of the failure.
    kind: Kind,
    /// The message on standard error, without `error:`.
    message: String,
    /// Every fault of a file or of an argument; empty for other kinds.
    faults: Vec<Found<'a>>,
}

/// Kind of a failure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
enum Kind {
    /// A command line that cannot be parsed.
    Usage,
    /// An argument with a wrong value.
    Argument,
    /// A faulty input file.
    Input,
    /// A file that cannot be written.
    File,
    /// A run that ended early.
    Run,
    /// A check that failed.
    Check,
    /// A check whose arguments leave it undecided.
    Undecided,
}

/// A fault with its place.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct Found<'a> {
    /// File with the fault; `null` for an argument.
    file: Option<&'a str>,
    /// Line from 1; `null` if the fault is of the whole file or of an argument.
    line: Option<usize>,
    /// Word, key or argument at fault.
    field: &'a str,
    /// The problem.
    problem: &'a str,
    /// Allowed values.
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
            Failure::Input(fault) => (Kind::Input, fault.all().map(Found::of).collect()),
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
                (Kind::Argument, vec![found])
            }
            Failure::Pairs(wrong) => {
                let found = wrong.iter().map(|wrong| Found {
                    file: None,
                    line: None,
                    field: &wrong.pair.key,
                    problem: &wrong.problem,
                    allowed: &wrong.allowed,
                });
                (Kind::Argument, found.collect())
            }
            Failure::File(_) => (Kind::File, Vec::new()),
            Failure::Run(RunError::Violation { .. }) | Failure::Check(_) => {
                (Kind::Check, Vec::new())
            }
            Failure::Run(_) => (Kind::Run, Vec::new()),
            Failure::Undecided(_) => (Kind::Undecided, Vec::new()),
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
    let text = error.to_string();
    let message = text.strip_prefix("error: ").unwrap_or(&text);
    // If standard error is closed, only the exit code remains.
    let _ = match plain(message) {
        Cow::Owned(message) => write!(stderr(), "{}{message}", voice::head(Level::Error)),
        Cow::Borrowed(_) => error.print(),
    };
    let message = message.split("\n\n").next().unwrap_or(message);
    print(Error {
        kind: Kind::Usage,
        message: message.to_owned(),
        faults: Vec::new(),
    });
}

fn print(error: Error<'_>) {
    if !voice::wants_json() || json::is_printed() {
        return;
    }
    let output = Output {
        version: json::VERSION,
        error,
    };
    // If standard output is closed, only the exit code remains.
    if let Ok(text) = serde_json::to_string_pretty(&output) {
        let _ = writeln!(stdout(), "{}", plain(&text));
    }
}
