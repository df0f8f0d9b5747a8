//! `check`: the proofs, in one table.

use super::{Failure, print};
use clap::Args;
use indicatif::{HumanCount, ProgressBar, ProgressStyle};
use motion_rtl::registry::{CATALOGUE, Entry, Verdict, WIDTHS, find};
use std::fmt::Write as _;
use std::path::PathBuf;
use std::time::Instant;

/// What to prove.
#[derive(Debug, Args)]
pub struct Arguments {
    /// A circuit; without it all.
    circuit: Option<String>,
    /// Width of the words, in bits.
    #[arg(long, value_name = "BITS")]
    width: Option<u64>,
    /// What else the circuit is made with, as `list` tells: `--with 1` is the literal variant of
    /// unit_law, pulse_generator and axis.
    #[arg(
        long,
        value_name = "NUMBERS",
        value_delimiter = ',',
        requires = "circuit"
    )]
    with: Vec<u64>,
    /// States after which a proof is given up.
    #[arg(long, value_name = "STATES", default_value_t = 1 << 26)]
    limit: u32,
    /// Where the waves of a counterexample go.
    #[arg(long, value_name = "DIR", default_value = "waves")]
    out: PathBuf,
}

/// The circuit of that name.
pub fn entry(name: &str) -> Result<&'static Entry, Failure> {
    find(name).ok_or_else(|| {
        let names: Vec<&str> = CATALOGUE.iter().map(|entry| entry.name).collect();
        Failure::Argument {
            field: "CIRCUIT",
            problem: format!("there is no {name}"),
            allowed: names.join(", "),
        }
    })
}

/// Proves.
pub fn check(arguments: &Arguments) -> Result<(), Failure> {
    let entries: Vec<_> = match &arguments.circuit {
        None => CATALOGUE.iter().collect(),
        Some(name) => vec![entry(name)?],
    };
    let (entries, others): (Vec<&Entry>, Vec<&Entry>) = entries
        .into_iter()
        .partition(|entry| entry.proof_width.is_some());
    if let [other] = others[..]
        && arguments.circuit.is_some()
    {
        return Err(Failure::Argument {
            field: "CIRCUIT",
            problem: format!("{} is too wide for a proof by exhaustion", other.name),
            allowed: "its blocks; what is tested of it stands in its note".into(),
        });
    }
    if let Some(width) = arguments.width
        && !WIDTHS.contains(&width)
    {
        return Err(Failure::Argument {
            field: "--width",
            problem: format!("is {width}"),
            allowed: format!("{} to {}", WIDTHS.start(), WIDTHS.end()),
        });
    }
    let mut table = String::new();
    let mut broken = Vec::new();
    // Writing to a string does not fail.
    let _ = writeln!(
        table,
        "{:<20} {:>5} {:>11} {:>13} {:>6} {:>8}  invariants",
        "circuit", "width", "states", "transitions", "depth", "time"
    );
    for entry in entries {
        prove(arguments, entry, &mut table, &mut broken)?;
    }
    if !others.is_empty() {
        let names: Vec<_> = others.iter().map(|other| other.name).collect();
        let _ = writeln!(table, "too wide for exhaustion: {}", names.join(", "));
    }
    print(&table)?;
    if broken.is_empty() {
        return Ok(());
    }
    Err(Failure::Check(broken.join("\n")))
}

fn prove(
    arguments: &Arguments,
    entry: &Entry,
    table: &mut String,
    broken: &mut Vec<String>,
) -> Result<(), Failure> {
    let width = arguments.width.or(entry.proof_width).unwrap_or_default();
    let name = entry.name;
    let mut given = vec![width];
    given.extend(&arguments.with);
    let Some(circuit) = (entry.make)(&given) else {
        return Err(Failure::Argument {
            field: "--with",
            problem: format!("{name} cannot be made with {given:?}"),
            allowed: entry.arguments.to_owned(),
        });
    };
    let bar = ProgressBar::new_spinner();
    if let Ok(style) = ProgressStyle::with_template("{spinner} {prefix}: {msg}") {
        bar.set_style(style);
    }
    bar.set_prefix(entry.name);
    let begun = Instant::now();
    let verdict = circuit.prove(arguments.limit, Some(&arguments.out), &mut |progress| {
        let (states, frontier) = (HumanCount(progress.states), HumanCount(progress.frontier));
        bar.set_message(format!("{states} states, {frontier} to go"));
        bar.tick();
    });
    bar.finish_and_clear();
    let time = format!("{:.2} s", begun.elapsed().as_secs_f64());
    let _ = match verdict {
        Err(error) => {
            broken.push(format!(
                "{name} at width {width}: {error}; allowed: a smaller --width"
            ));
            writeln!(
                table,
                "{name:<20} {width:>5} {:>11} {:>13} {:>6} {time:>8}  too wide",
                "", "", ""
            )
        }
        Ok(Verdict::Proved(proof)) => {
            let _ = writeln!(
                table,
                "{name:<20} {width:>5} {:>11} {:>13} {:>6} {time:>8}  proved:",
                proof.states, proof.transitions, proof.depth
            );
            circuit
                .invariants()
                .iter()
                .try_for_each(|invariant| writeln!(table, "{:70}{invariant}", ""))
        }
        Ok(Verdict::Undecided(progress)) => {
            broken.push(format!(
                "{name}: not decided within {} states; allowed: a larger --limit",
                progress.states
            ));
            writeln!(
                table,
                "{name:<20} {width:>5} {:>11} {:>13} {:>6} {time:>8}  not decided",
                progress.states, progress.transitions, progress.depth
            )
        }
        Ok(Verdict::Broken { report, waves }) => {
            let waves = waves?
                .iter()
                .map(|path| path.display().to_string())
                .collect::<Vec<_>>();
            broken.push(format!("{name}: {report}\nwaves: {}", waves.join(", ")));
            writeln!(
                table,
                "{name:<20} {width:>5} {:>11} {:>13} {:>6} {time:>8}  BROKEN",
                "", "", ""
            )
        }
    };
    Ok(())
}
