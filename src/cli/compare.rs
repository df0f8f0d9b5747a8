//! `compare`: two waveforms held against each other, tick by tick.

use super::{Failure, json, print, threads, to_standard_output};
use clap::Args;
use motion_rtl::compare::{Map, Settings, compare as hold, template};
use std::path::PathBuf;

/// Arguments of `compare`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Reference waveform: VCD, FST or GHW.
    golden: PathBuf,
    /// Waveform to compare with it: VCD, FST or GHW.
    other: PathBuf,
    /// Names that differ and signals to leave out, in TOML.
    #[arg(long, value_name = "FILE")]
    map: Option<PathBuf>,
    /// The clock, by its path or the end of its path.
    #[arg(long, value_name = "NAME", default_value = "clk")]
    clock: String,
    /// Clock of OTHER, if it has another name.
    #[arg(long, value_name = "NAME")]
    other_clock: Option<String>,
    /// Pairs names that differ only in case, if no name matches exactly.
    #[arg(long)]
    ignore_case: bool,
    /// Output ports of GOLDEN, by their paths or path ends. Needed if the file does not mark them:
    /// waves of this program do, and so does an FST or GHW with directions.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    ports_out: Vec<String>,
    /// Output ports of GOLDEN to leave out, by their paths or path ends. Any other output port that
    /// is not compared is a difference.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    leave: Vec<String>,
    /// Scope of OTHER that corresponds to GOLDEN's outermost scope, by its path or path end. By
    /// default the scope with the most signals of GOLDEN, or none if the map names scopes.
    #[arg(long, value_name = "PATH")]
    scope: Option<String>,
    /// Ticks to skip at the beginning of OTHER, for its reset; negative if OTHER begins later.
    #[arg(
        long,
        value_name = "TICKS",
        allow_negative_numbers = true,
        default_value_t = 0,
        allow_negative_numbers = true
    )]
    skip: i64,
    /// First tick to compare, counted in GOLDEN.
    #[arg(
        long,
        value_name = "TICK",
        allow_negative_numbers = true,
        default_value_t = 0
    )]
    from: u64,
    /// Count of ticks to compare; all by default.
    #[arg(long, value_name = "COUNT", allow_negative_numbers = true)]
    ticks: Option<u64>,
    /// Count of ticks to show before the first mismatch.
    #[arg(
        long,
        value_name = "TICKS",
        allow_negative_numbers = true,
        default_value_t = 4
    )]
    around: u64,
    /// Counts as a difference each signal of GOLDEN that has no partner or no value to compare.
    #[arg(long)]
    strict: bool,
    /// Accepts input ports of GOLDEN's outermost scope without partner, and few signals with one;
    /// otherwise both are differences. Output ports are still compared.
    #[arg(long, conflicts_with = "strict")]
    allow_missing: bool,
    /// Accepts files of different length; otherwise that is a difference.
    #[arg(long)]
    any_length: bool,
    /// Prints full lists, and also lists the signals of OTHER without partner.
    #[arg(long)]
    all: bool,
    /// Prints a map to fill in instead of comparing: the signals of GOLDEN and of OTHER without
    /// partner.
    #[arg(long, conflicts_with_all = ["strict", "any_length", "all", "json"])]
    template: bool,
    /// Prints the report as JSON, with full lists.
    #[arg(long)]
    json: bool,
}

pub fn compare(arguments: &Arguments) -> Result<(), Failure> {
    let map = match &arguments.map {
        Some(path) => Map::read(path)?,
        None => Map::default(),
    };
    if arguments.ticks == Some(0) {
        return Err(Failure::Argument {
            field: "--ticks",
            problem: "is 0".into(),
            allowed: "1 or more".into(),
        });
    }
    let count = arguments.ticks.unwrap_or(u64::MAX);
    let settings = Settings {
        clock: arguments.clock.clone(),
        other_clock: arguments.other_clock.clone(),
        scope: arguments.scope.clone(),
        ignore_case: arguments.ignore_case,
        map,
        ports_out: arguments.ports_out.clone(),
        leave: arguments.leave.clone(),
        skip: arguments.skip,
        ticks: arguments.from..arguments.from.saturating_add(count),
        around: arguments.around,
    };
    threads::start()?;
    if arguments.template {
        return to_standard_output(&template(&arguments.golden, &arguments.other, &settings)?);
    }
    let report = hold(&arguments.golden, &arguments.other, &settings)?;
    match arguments.json {
        true => json::print(&report)?,
        false => print(&report.text(arguments.all))?,
    }
    if report.differs() {
        return Err(Failure::Check("the files differ".into()));
    }
    let missed = report.ports_out_not_compared.len();
    if missed > 0 {
        return Err(Failure::Check(format!(
            "ports out of golden not compared: {missed}; a map pairs them, --leave or leave in a map \
             leaves out those that it names"
        )));
    }
    let ports = report.ports_in_without_partner.len();
    if !arguments.allow_missing && !arguments.strict {
        let what = match ports {
            0 if report.hardly_pairs() => "almost nothing pairs".to_owned(),
            0 => String::new(),
            _ => format!("ports in of golden without partner: {ports}"),
        };
        if !what.is_empty() {
            return Err(Failure::Check(format!(
                "{what}; a map pairs them, --allow-missing takes the rest as equal"
            )));
        }
    }
    if !arguments.any_length && !report.same_length() {
        return Err(Failure::Check(
            "the files end in different ticks; --ticks chooses those of both, --any-length takes \
             the rest as equal"
                .into(),
        ));
    }
    for (what, unheld) in [
        ("golden signals without partner", &report.without_partner),
        ("pairs without a value to compare", &report.without_values),
    ] {
        if arguments.strict && !unheld.is_empty() {
            let count = unheld.len();
            return Err(Failure::Check(format!(
                "{what}: {count}, and --strict is given"
            )));
        }
    }
    Ok(())
}
