//! `equal`: a design proved equal to a circuit by Yosys.

mod check;
mod design;
mod invariants;
mod miter;
mod narrow;
mod netlist;
mod pairs;
mod parts;
mod random;
mod replay;
mod report;
mod script;
mod task;
mod template;
mod tool;
mod trace;
mod vhdl;

use super::chosen::Chosen;
use super::files::Files;
use super::{Failure, print};
use check::{Check, Outcome};
use clap::Args;
use design::Design;
use std::path::PathBuf;
use std::time::{Duration, Instant};

#[cfg(unix)]
pub use tool::stop;

/// Arguments of `equal`.
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    chosen: Chosen,
    /// Files of your design: Verilog, SystemVerilog as .sv, or VHDL as .vhd.
    #[arg(value_name = "DESIGN", required = true)]
    designs: Vec<PathBuf>,
    /// Module of your design; the name of the circuit by default.
    #[arg(long, value_name = "NAME")]
    top: Option<String>,
    /// Gives a parameter or generic of your module a value, `WIDTH=16` for instance, or that of a key of the
    /// circuit, `WIDTH=value`. Narrower widths are then tried if the proof takes too long.
    #[arg(long, value_name = "NAME=VALUE")]
    param: Vec<String>,
    /// Names that differ and signals to leave out, in TOML, as in `compare`.
    #[arg(long, value_name = "FILE")]
    map: Option<PathBuf>,
    /// Proves the connections of the instances in your module, and each instance equal to the
    /// circuit's instance of that name, before the whole.
    #[arg(long, conflicts_with = "after_reset")]
    parts: bool,
    /// Clock of your module, whose rising edge all its registers take.
    #[arg(long, value_name = "NAME", default_value = "clk")]
    clock: String,
    /// Reset of your module: NAME, !NAME if it is active low, or none.
    #[arg(long, value_name = "NAME", default_value = "rst")]
    reset: String,
    /// Compares only after a first tick of reset: for registers without power-on values.
    #[arg(long)]
    after_reset: bool,
    /// Seconds for the proof at full width, for the search for a difference, and for the proofs at
    /// narrower widths.
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, default_value_t = 60, value_parser = clap::value_parser!(u64).range(1..=86_400))]
    limit_seconds: u64,
    /// The program Yosys.
    #[arg(long, value_name = "PROGRAM", default_value = "yosys")]
    yosys: PathBuf,
    /// The program GHDL, for designs in VHDL.
    #[arg(long, value_name = "PROGRAM", default_value = "ghdl")]
    ghdl: PathBuf,
    /// Directory for the scripts, the miter, and the waves of a difference.
    #[arg(long, value_name = "DIR", default_value = "waves/equal")]
    out: PathBuf,
}

impl Arguments {
    /// Returns the end of the time for a proof that begins now.
    fn until(&self) -> Instant {
        Instant::now() + Duration::from_secs(self.limit_seconds)
    }
}

/// Returns the refusal of an argument.
fn refused(field: &'static str, problem: String, allowed: &str) -> Failure {
    Failure::Argument {
        field,
        problem,
        allowed: allowed.to_owned(),
    }
}

/// Proves that the design equals the circuit, or shows where it differs.
pub fn equal(arguments: &Arguments) -> Result<(), Failure> {
    let (entry, pairs) = arguments.chosen.entry()?;
    let design = Design::new(arguments, entry, &pairs)?;
    let changes = arguments.chosen.changes();
    let mut check = Check::new(arguments, &design, entry, &pairs, changes)?;
    // Before the proof, so that a directory that cannot be written costs no time.
    let mut files = Files::begin(&arguments.out, entry.name)?;
    let mut attempt = check.attempt(arguments.until())?;
    if matches!(attempt.outcome, Outcome::Open { late: true, .. })
        && let Some((narrow, other)) = narrow::narrower(&check, &pairs)?
    {
        (check, attempt) = (narrow, other);
    }
    attempt.written.into_files(&check, &mut files)?;
    match attempt.outcome {
        Outcome::Proved(text) => print(&(text + &report::files(&files.commit()?))),
        Outcome::Differs(paired, trace) => replay::differs(&check, files, &paired, &trace),
        Outcome::Open { failure, .. } => {
            print(&report::files(&files.commit()?))?;
            Err(failure)
        }
    }
}
