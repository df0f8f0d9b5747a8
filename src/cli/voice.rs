//! Verbosity and colours of the output: options of all commands.

use clap::{ArgAction, Args, ColorChoice, ValueEnum};
use std::ffi::OsString;
use std::io::{IsTerminal, stderr};
use std::sync::atomic::{AtomicBool, AtomicU8, Ordering::Relaxed};

/// When the output is coloured.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, ValueEnum)]
#[repr(u8)]
pub enum Color {
    /// On a terminal, unless NO_COLOR is set.
    #[default]
    Auto,
    /// Always.
    Always,
    /// Never.
    Never,
}

/// Options of all commands.
#[derive(Debug, Args)]
pub struct Voice {
    /// Prints only errors, JSON, and lists that a command is asked for.
    #[arg(long, short, global = true, conflicts_with = "verbose")]
    quiet: bool,
    /// Reports inputs, stages and their start times on standard error.
    #[arg(long, short, global = true, action = ArgAction::SetTrue)]
    verbose: bool,
    /// When help and errors are coloured.
    #[arg(long, global = true, value_enum, value_name = "WHEN", default_value_t)]
    color: Color,
}

/// Severity of a message.
#[derive(Debug, Clone, Copy)]
pub enum Level {
    Error,
    Warning,
}

static QUIET: AtomicBool = AtomicBool::new(false);
static VERBOSE: AtomicBool = AtomicBool::new(false);
static JSON: AtomicBool = AtomicBool::new(false);
static COLOR: AtomicU8 = AtomicU8::new(Color::Auto as u8);

impl Voice {
    /// Applies the options from now on.
    pub fn set(&self) {
        QUIET.store(self.quiet, Relaxed);
        VERBOSE.store(self.verbose, Relaxed);
        COLOR.store(self.color as u8, Relaxed);
    }
}

/// True if the word is one of these options, without a value of its own.
pub fn is_option(word: &str) -> bool {
    let plain = ["-q", "--quiet", "-v", "--verbose"];
    plain.contains(&word) || word.starts_with("--color=")
}

/// Takes `--color` and `--json` from words that may not be parsed at all.
pub fn look_ahead(words: &[OsString]) {
    let words = words.iter().filter_map(|word| word.to_str());
    let words: Vec<_> = words.take_while(|word| *word != "--").collect();
    JSON.store(words.contains(&"--json"), Relaxed);
    let joined = words.iter().find_map(|word| word.strip_prefix("--color="));
    let pairs = || words.iter().zip(words.iter().skip(1));
    let apart = || pairs().find_map(|(name, value)| (*name == "--color").then_some(*value));
    let color = joined.or_else(apart);
    let color = color.and_then(|color| Color::from_str(color, false).ok());
    COLOR.store(color.unwrap_or_default() as u8, Relaxed);
}

/// True if only errors and JSON are printed.
pub fn is_quiet() -> bool {
    QUIET.load(Relaxed)
}

/// True if `--verbose` is set.
pub fn is_verbose() -> bool {
    VERBOSE.load(Relaxed)
}

/// True if JSON is asked for.
pub fn wants_json() -> bool {
    JSON.load(Relaxed)
}

/// Returns when help is coloured.
pub fn color() -> ColorChoice {
    match COLOR.load(Relaxed) {
        color if color == Color::Always as u8 => ColorChoice::Always,
        color if color == Color::Never as u8 => ColorChoice::Never,
        _ => ColorChoice::Auto,
    }
}

/// Returns the beginning of a message on standard error, in a colour where errors are coloured.
pub fn head(level: Level) -> String {
    let (name, code) = match level {
        Level::Error => ("error", "1;31"),
        Level::Warning => ("warning", "1;33"),
    };
    match colors_errors() {
        true => format!("\x1b[{code}m{name}:\x1b[0m "),
        false => format!("{name}: "),
    }
}

/// True if errors are coloured.
pub fn colors_errors() -> bool {
    match color() {
        ColorChoice::Always => true,
        ColorChoice::Never => false,
        ColorChoice::Auto => stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none(),
    }
}
