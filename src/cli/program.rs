//! The program: its commands, the options that all of them have, and how it ends.

use super::voice::{self, Voice};
use super::{Failure, errors, help, limits, named, printed, signals, version};
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use motion_rtl::nearest::did_you_mean;
use std::ffi::OsString;
use std::io::{Write as _, stderr};
use std::path::Path;

/// Motion-control patents as cycle-accurate RTL models: drawings in, pulses and waves out.
#[derive(Debug, Parser)]
#[command(
    name = "motion-rtl",
    version = version::short(),
    long_version = version::long(),
    about,
    max_term_width = 100,
    override_usage = "motion-rtl [OPTIONS] [FILE]\n       motion-rtl [OPTIONS] <COMMAND>",
    after_help = help::PROGRAM
)]
struct Arguments {
    #[command(flatten)]
    voice: Voice,
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Runs a scenario, a drawing or a part program; writes waves, save file and picture.
    #[command(after_help = help::RUN, after_long_help = help::run())]
    Run(super::arguments::Arguments),
    /// Compiles a drawing or a part program into the pattern memory's table.
    #[command(after_help = help::TABLE)]
    Table(super::table::Arguments),
    /// Proves the invariants of circuits over every state and input, at small widths.
    #[command(after_help = help::CHECK)]
    Check(super::check::Arguments),
    /// Injects single faults into circuits, and lists those that no chart, proof or law finds.
    #[command(after_help = help::MUTATE)]
    Mutate(super::mutate::Arguments),
    #[cfg(not(target_family = "wasm"))]
    #[command(flatten)]
    Hdl(Hdl),
    /// Lists circuits with ports and keys, and scenarios; or one circuit with its parts.
    #[command(after_help = help::LIST)]
    List(super::list::Arguments),
    /// Lists the keys of a job's scenarios or of a circuit: types, units, values and ranges.
    #[command(after_help = help::KEYS)]
    Keys(super::keys::Arguments),
    #[cfg(not(target_family = "wasm"))]
    #[command(flatten)]
    Machine(Machine),
    /// Prints a JSON schema of what `run --json` and `check --json` print, and of errors.
    #[cfg(feature = "schema")]
    #[command(after_help = help::SCHEMA)]
    Schema,
    /// Prints the completions of a shell.
    #[cfg(feature = "shell")]
    #[command(after_help = help::COMPLETIONS)]
    Completions(super::shell::Completions),
    /// Writes the man pages of the program and of its commands.
    #[cfg(feature = "shell")]
    #[command(after_help = help::MAN)]
    Man(super::shell::Man),
}

/// Commands for HDL, and the engine's plan of a circuit; the program for browsers does without.
#[cfg(not(target_family = "wasm"))]
#[derive(Debug, Subcommand)]
enum Hdl {
    /// Writes a circuit as Verilog, with a testbench, its stimulus and the golden waves.
    #[command(after_help = help::VERILOG)]
    Verilog(super::verilog::Arguments),
    /// Writes a circuit as VHDL, with a testbench, its stimulus and the golden waves.
    #[command(after_help = help::VHDL)]
    Vhdl(super::vhdl::Arguments),
    /// Compares a waveform, such as a simulator's, with a golden one, tick by tick.
    #[command(after_help = help::COMPARE)]
    Compare(super::compare::Arguments),
    /// Proves that a design in Verilog or VHDL equals a circuit, or shows where it differs. Needs Yosys.
    #[command(after_help = help::EQUAL)]
    Equal(super::equal::Arguments),
    /// Shows how the engine runs a circuit: its blocks, what wakes them, how often each runs.
    #[command(after_help = help::PLAN)]
    Plan(super::plan::Arguments),
}

/// Commands for this machine: its browsers and its files.
#[cfg(not(target_family = "wasm"))]
#[derive(Debug, Subcommand)]
enum Machine {
    /// Serves a page in which jobs run and are looked at, on this machine alone.
    #[command(after_help = help::SERVE)]
    Serve(super::serve::Arguments),
    /// Writes that page with the program inside, for a browser alone.
    #[command(after_help = help::PAGE)]
    Page(super::page::Arguments),
    /// Removes the files that commands have written into a directory, after naming them: waves,
    /// pictures, counterexamples, tables, Verilog, VHDL and stimuli.
    #[command(after_help = help::CLEAN)]
    Clean(super::clean::Arguments),
}

/// Commands that a program may be built without, and the features that they need.
const OPTIONAL: [(&str, &str); 3] = [
    ("completions", "shell"),
    ("man", "shell"),
    ("schema", "schema"),
];

/// Returns the description of the command line.
pub fn description() -> clap::Command {
    // A table is of the pulse interpolator, which takes fewer inputs than `run`.
    Arguments::command().mut_subcommands(|command| match command.get_name() {
        "table" => command.mut_arg("input", |file| file.help(TABLE_FILE)),
        _ => command,
    })
}

/// Input of `table` in its help.
const TABLE_FILE: &str = "Scenario of the pulse interpolator (.toml), HPGL drawing or G-code \
                          program; `-` for standard input";

/// Runs the program with the words of its command line, of which the first is its name; returns
/// the exit code.
pub fn main(words: Vec<OsString>) -> u8 {
    voice::look_ahead(&words);
    if let Err(failure) = limits::check() {
        return failed(&failure);
    }
    signals::watch();
    let words = match with_run(words) {
        Ok(words) => words,
        Err(failure) => return failed(&failure),
    };
    let described = description().color(voice::color());
    let parsed = described
        .try_get_matches_from(words)
        .and_then(|matches| Arguments::from_arg_matches(&matches));
    let done = match parsed {
        Ok(Arguments { voice, command }) => {
            voice.set();
            run(command)
        }
        Err(error) if error.use_stderr() => {
            errors::usage(&error);
            return 2;
        }
        // Help or the version.
        Err(asked) => printed(asked.print()),
    };
    match done {
        Ok(()) => 0,
        Err(failure) => failed(&failure),
    }
}

fn failed(failure: &Failure) -> u8 {
    // If standard error is closed, only the exit code remains.
    let _ = writeln!(stderr(), "{}", failure.report());
    errors::as_json(failure);
    failure.code()
}

/// Returns the words with `run` before the first that is neither a command nor an option of all
/// commands.
fn with_run(mut words: Vec<OsString>) -> Result<Vec<OsString>, Failure> {
    let Some(at) = first_word(&words) else {
        return Ok(words);
    };
    let word = words[at].to_string_lossy().into_owned();
    let described = description();
    let commands: Vec<_> = described
        .get_subcommands()
        .map(|command| command.get_name().to_owned())
        .collect();
    if word == "help" {
        return Ok(options_first(words, at));
    }
    if word == "-V" {
        words[at] = "--version".into();
    }
    let asked = ["-h", "--help", "-V", "--version"];
    if asked.contains(&&*word) || commands.contains(&word) {
        return Ok(words);
    }
    let optional = OPTIONAL.iter().find(|(name, _)| *name == word);
    if let Some((name, feature)) = optional
        && !Path::new(name).exists()
    {
        return Err(Failure::Argument {
            field: "COMMAND",
            problem: format!("{name} is left out of this program"),
            allowed: format!("a program built with `cargo build --release --features {feature}`"),
        });
    }
    let is_path = word.starts_with('-') || word.contains(['.', '/', '\\']);
    if !is_path && !Path::new(&words[at]).exists() {
        let near = did_you_mean(&word, commands.iter().map(String::as_str));
        return Err(Failure::Argument {
            field: "COMMAND",
            problem: format!(
                "there is no command {}, and no file of that name{near}",
                named(&word)
            ),
            allowed: format!("a file, or a command: {}", commands.join(", ")),
        });
    }
    words.insert(at, "run".into());
    Ok(words)
}

/// Returns the words with options of all commands before `help` at `at`, which takes only names of
/// commands.
fn options_first(mut words: Vec<OsString>, at: usize) -> Vec<OsString> {
    let mut names = words.split_off(at).into_iter().peekable();
    let mut others = Vec::new();
    while let Some(word) = names.next() {
        match word.to_str() {
            Some("--color") if names.peek().is_some() => {
                words.push(word);
                words.extend(names.next());
            }
            Some(option) if voice::is_option(option) => words.push(word),
            _ => others.push(word),
        }
    }
    words.extend(others);
    words
}

/// Returns the index of the first word that is no option of all commands.
fn first_word(words: &[OsString]) -> Option<usize> {
    let mut index = 1;
    loop {
        let word = words.get(index)?.to_str();
        match word {
            Some("--color") => index += 2,
            Some(word) if voice::is_option(word) => index += 1,
            _ => return Some(index),
        }
    }
}

fn run(command: Option<Command>) -> Result<(), Failure> {
    match command {
        None => super::run::run(&super::arguments::Arguments::default()),
        Some(Command::Run(arguments)) => super::run::run(&arguments),
        Some(Command::Table(arguments)) => super::table::table(&arguments),
        Some(Command::Check(arguments)) => super::check::check(&arguments),
        Some(Command::Mutate(arguments)) => super::mutate::mutate(&arguments),
        #[cfg(not(target_family = "wasm"))]
        Some(Command::Hdl(hdl)) => hdl.run(),
        Some(Command::List(arguments)) => super::list::list(&arguments),
        Some(Command::Keys(arguments)) => super::keys::keys(&arguments),
        #[cfg(not(target_family = "wasm"))]
        Some(Command::Machine(machine)) => machine.run(),
        #[cfg(feature = "schema")]
        Some(Command::Schema) => super::schema::schema(),
        #[cfg(feature = "shell")]
        Some(Command::Completions(arguments)) => super::shell::completions(&arguments),
        #[cfg(feature = "shell")]
        Some(Command::Man(arguments)) => super::shell::man(&arguments),
    }
}

#[cfg(not(target_family = "wasm"))]
impl Hdl {
    fn run(&self) -> Result<(), Failure> {
        match self {
            Hdl::Verilog(arguments) => super::verilog::verilog(arguments),
            Hdl::Vhdl(arguments) => super::vhdl::vhdl(arguments),
            Hdl::Compare(arguments) => super::compare::compare(arguments),
            Hdl::Equal(arguments) => super::equal::equal(arguments),
            Hdl::Plan(arguments) => super::plan::plan(arguments),
        }
    }
}

#[cfg(not(target_family = "wasm"))]
impl Machine {
    fn run(&self) -> Result<(), Failure> {
        match self {
            Machine::Serve(arguments) => super::serve::serve(arguments),
            Machine::Page(arguments) => super::page::page(arguments),
            Machine::Clean(arguments) => super::clean::clean(arguments),
        }
    }
}
