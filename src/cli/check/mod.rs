//! `check`: proofs and sweeps, in one table.

mod climb;
mod full;
mod parts;
mod report;
mod shard;
mod tasks;
mod work;

use super::chosen::Changes;
use super::{Failure, json, print};
use clap::Args;
#[cfg(feature = "schema")]
pub use full::FullReport;
use report::Asked;
pub use report::Report;
use shard::Shard;
use std::path::PathBuf;
use std::time::Duration;
pub use work::Waves;

/// Arguments of `check`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Circuits; all by default.
    #[arg(value_name = "CIRCUIT")]
    circuits: Vec<String>,
    #[command(flatten)]
    changes: Changes,
    /// Proves only the properties whose text contains TEXT; `list NAME` shows the properties.
    #[arg(long, value_name = "TEXT", conflicts_with = "full")]
    property: Option<String>,
    /// States after which a proof is given up.
    #[arg(long, value_name = "STATES", allow_negative_numbers = true, default_value_t = 1 << 26)]
    limit: u32,
    /// Proves each circuit at all widths, from 1 up, until it has taken SECONDS (10 by default).
    #[arg(
        long,
        value_name = "SECONDS",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "10",
        value_parser = climb::seconds,
        conflicts_with_all = ["shard", "width", "full"]
    )]
    all_widths: Option<Duration>,
    /// Proves each property at the circuit's own widths, by induction and a search for invariants.
    #[arg(long, conflicts_with_all = ["limit", "shard"])]
    full: bool,
    /// Seconds of processor time for each property at full width.
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, requires = "full", default_value_t = 10, value_parser = clap::value_parser!(u64).range(1..=86_400))]
    limit_seconds: u64,
    /// Fails if a property at full width is neither proved nor refuted: exit code 2.
    #[arg(long, requires = "full")]
    require_proofs: bool,
    /// Directory for the waves of a counterexample.
    #[arg(long, value_name = "DIR", default_value = "waves")]
    out: PathBuf,
    /// Does part I of N of the work.
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// Joins the parts that `--shard --json` printed into one table.
    #[arg(
        long,
        value_name = "FILES",
        num_args = 1..,
        conflicts_with_all = ["circuits", "set", "width", "property", "limit", "all_widths", "out", "shard", "full"]
    )]
    merge: Vec<PathBuf>,
    /// Prints the table as JSON.
    #[arg(long)]
    json: bool,
}

/// Proves and sweeps, or puts together what was proved and swept elsewhere.
pub fn check(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.full {
        let asked = full::Asked {
            circuits: arguments.circuits.clone(),
            changes: arguments.changes.clone(),
            limit_seconds: arguments.limit_seconds,
            require_proofs: arguments.require_proofs,
        };
        return full::run(asked, &arguments.out, arguments.json)?.faults();
    }
    let numbers = arguments
        .circuits
        .iter()
        .find(|name| climb::seconds(name).is_ok());
    if let (Some(number), Some(_)) = (numbers, arguments.all_widths) {
        return Err(Failure::Argument {
            field: "--all-widths",
            problem: format!("{number} stands for a circuit here"),
            allowed: format!("--all-widths={number}"),
        });
    }
    let report = if arguments.merge.is_empty() {
        let asked = Asked {
            circuits: arguments.circuits.clone(),
            changes: arguments.changes.clone(),
            property: arguments.property.clone(),
            limit: arguments.limit,
            seconds: arguments.all_widths.map(|limit| limit.as_secs_f64()),
        };
        let (tasks, others) = tasks::of(&asked)?;
        let shard = arguments.shard.unwrap_or_default();
        let rows = match arguments.all_widths {
            None => work::run(&tasks, shard, arguments.limit, &arguments.out)?,
            Some(time) => climb::run(&tasks, (arguments.limit, time), &arguments.out)?,
        };
        Report::new(asked, shard, rows, others)
    } else {
        parts::merge(&arguments.merge)?
    };
    match arguments.json {
        true => json::print_alone(&report)?,
        false => print(&report.table())?,
    }
    report.faults()
}
