//! The command line of `motion-rtl`.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod cli;

use clap::{Parser, Subcommand};
use std::io::Write as _;
use std::process::ExitCode;

/// Motion-control patents as cycle-accurate RTL models: drawings in, pulses and waves out.
#[derive(Debug, Parser)]
#[command(version, about, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Runs a scenario, a drawing or a part program; writes waves, save file and picture.
    Run(cli::run::Arguments),
    /// Compiles a drawing or a part program into the pattern memory's table.
    Table(cli::table::Arguments),
    /// Proves the invariants of the circuits over every state and input at small widths.
    Check(cli::check::Arguments),
    /// Puts single faults into circuits, and says which no chart, proof or law finds.
    Mutate(cli::mutate::Arguments),
    /// Writes a circuit as Verilog, with a testbench, its stimulus and the golden waves.
    Verilog(cli::verilog::Arguments),
    /// Holds a waveform, such as a simulator's, against a golden one, tick by tick.
    Compare(cli::compare::Arguments),
    /// Shows how a circuit is run: its blocks, what wakes them, how often each runs.
    Plan(cli::plan::Arguments),
    /// Lists circuits with ports and widths, and scenarios; or a circuit with what it is made of.
    List(cli::list::Arguments),
}

fn main() -> ExitCode {
    if let Err(failure) = cli::limits::check() {
        return failed(&failure);
    }
    cli::signals::watch();
    let done = match Arguments::try_parse() {
        Ok(arguments) => run(arguments.command),
        Err(error) if error.use_stderr() => {
            // Where standard error is gone, the exit code is all there is to say.
            let _ = match std::env::args().any(|word| word.contains(char::is_control)) {
                true => write!(std::io::stderr(), "{}", cli::plain(&error.to_string())),
                false => error.print(),
            };
            return ExitCode::from(2);
        }
        // Help or the version.
        Err(asked) => cli::printed(asked.print()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failed(&failure),
    }
}

fn failed(failure: &cli::Failure) -> ExitCode {
    // Where standard error is gone, the exit code is all there is to say.
    let _ = writeln!(std::io::stderr(), "{}", failure.report());
    failure.code()
}

fn run(command: Option<Command>) -> Result<(), cli::Failure> {
    match command {
        None => cli::run::run(&cli::run::Arguments::default()),
        Some(Command::Run(arguments)) => cli::run::run(&arguments),
        Some(Command::Table(arguments)) => cli::table::table(&arguments),
        Some(Command::Check(arguments)) => cli::check::check(&arguments),
        Some(Command::Mutate(arguments)) => cli::mutate::mutate(&arguments),
        Some(Command::Verilog(arguments)) => cli::verilog::verilog(&arguments),
        Some(Command::Compare(arguments)) => cli::compare::compare(&arguments),
        Some(Command::Plan(arguments)) => cli::plan::plan(&arguments),
        Some(Command::List(arguments)) => cli::list::list(&arguments),
    }
}
