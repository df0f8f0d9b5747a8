//! The commands.

mod arc;
mod arguments;
mod bench;
mod check;
mod chosen;
mod clean;
mod columns;
mod compare;
mod connections;
mod dpi;
mod equal;
mod errors;
mod export;
mod faults;
mod files;
mod from_waves;
mod given;
mod help;
mod job;
mod json;
pub mod keys;
mod lead_angle;
mod limits;
mod linear;
mod list;
mod machine;
mod magnification;
mod mutate;
mod names;
mod notes;
mod page;
mod pieces;
mod plan;
pub mod program;
mod progress;
mod pulse;
mod report;
mod rows;
mod run;
#[cfg(feature = "schema")]
mod schema;
mod series;
#[cfg(not(target_family = "wasm"))]
mod serve;
mod setup;
#[cfg(feature = "shell")]
mod shell;
mod shipped;
mod signals;
mod simulate;
mod source;
mod table;
mod thinned;
mod threads;
mod times;
mod traces;
mod trajectory;
mod verilog;
mod version;
mod vhdl;
mod vhpi;
mod viewer;
mod voice;
mod wave_format;
mod waves_of;
mod written;

use motion_rtl::input::{Fault, LISTED, SHOWN, shown};
use motion_rtl::jobs::JobError;
use motion_rtl::registry::WrongPair;
use motion_rtl::sim::RunError;
use std::borrow::Cow;
use std::io::{self, Write};
use voice::Level;

/// Failures of a command, each with its exit code.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// Bad input: 2.
    #[error(transparent)]
    Input(#[from] Fault),
    /// An argument of the command line that clap cannot judge: 2.
    #[error(
        "{field}: {}; allowed: {}",
        shown(problem, SHOWN),
        shown(allowed, LISTED)
    )]
    Argument {
        /// The argument.
        field: &'static str,
        /// The problem.
        problem: String,
        /// Allowed values.
        allowed: String,
    },
    /// Keys and values that a circuit does not take: 2.
    #[error("{}", lines(.0))]
    Pairs(Vec<WrongPair>),
    /// A file that cannot be written: 2.
    #[error("{0}")]
    File(#[from] io::Error),
    /// A run that a monitor ended, or whose waves cannot be written: 2 for the latter, else 1.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A comparison that its arguments leave undecided: 2.
    #[error("{0}")]
    Undecided(String),
    /// A check that failed: 1.
    #[error("{0}")]
    Check(String),
}

/// A line for each key and value.
fn lines(wrong: &[WrongPair]) -> String {
    let lines = wrong.iter().map(|wrong| {
        let (problem, allowed) = (shown(&wrong.problem, SHOWN), shown(&wrong.allowed, LISTED));
        format!("--set {}: {problem}; allowed: {allowed}", wrong.pair)
    });
    lines.collect::<Vec<_>>().join("\n")
}

impl From<JobError> for Failure {
    fn from(error: JobError) -> Self {
        match error {
            // Settings have been checked; this is for what a check may yet let through.
            JobError::Setting(error) => Failure::Check(error.to_string()),
            JobError::Run(error) => Failure::Run(error),
            JobError::Engine(error) => Failure::Run(error.into()),
        }
    }
}

impl Failure {
    /// Returns the message for standard error.
    pub fn report(&self) -> String {
        let head = voice::head(Level::Error);
        let text = plain(&self.to_string()).into_owned();
        match self {
            Failure::Input(fault) => faults::report(fault),
            // Each line is an error of its own.
            Failure::Pairs(_) => head.clone() + &text.replace('\n', &format!("\n{head}")),
            _ => head + &text,
        }
    }

    /// The exit code.
    pub fn code(&self) -> u8 {
        match self {
            Failure::Check(_) | Failure::Run(RunError::Violation { .. }) => 1,
            _ => 2,
        }
    }
}

/// Returns a name for a message; an empty one in quotes.
fn named(name: &str) -> &str {
    match name {
        "" => "\"\"",
        name => name,
    }
}

/// Prints the outcome of a command, unless `--quiet` is set.
fn print(text: &str) -> Result<(), Failure> {
    match voice::is_quiet() {
        true => Ok(()),
        false => to_standard_output(text),
    }
}

/// Prints to standard output; a reader that has gone away (`| head`) is no failure.
fn to_standard_output(text: &str) -> Result<(), Failure> {
    printed(io::stdout().lock().write_all(plain(text).as_bytes()))
}

/// Lines without control characters, which a terminal would obey: names of files may have them.
pub fn plain(text: &str) -> Cow<'_, str> {
    let obeyed = |c: char| c.is_control() && !matches!(c, '\n' | '\t');
    if !text.contains(obeyed) {
        return Cow::Borrowed(text);
    }
    let mut plain = String::new();
    for character in text.chars() {
        match obeyed(character) {
            true => plain.extend(character.escape_default()),
            false => plain.push(character),
        }
    }
    Cow::Owned(plain)
}

/// Prints a warning on standard error.
fn warn(text: &str) {
    if voice::is_quiet() {
        return;
    }
    // Standard error may be closed.
    let head = voice::head(Level::Warning);
    let _ = writeln!(io::stderr(), "{head}{}", plain(text));
}

/// Returns the result of printing to standard output.
pub fn printed(done: io::Result<()>) -> Result<(), Failure> {
    if limits::is_closed() {
        warn(
            "standard output is closed, or a null device that is open for reading too: what is \
             printed is lost; allowed: > FILE, > /dev/null",
        );
    }
    match done.and_then(|()| io::stdout().flush()) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        done => Ok(done
            .map_err(|error| io::Error::new(error.kind(), format!("standard output: {error}")))?),
    }
}
