//! Does it, on all cores, and shows how far it is.

use super::report::{Ended, Kind, Row};
use super::shard::Shard;
use super::tasks::{self, Task};
use crate::cli::written::Written;
use crate::cli::{Failure, print, threads};
use indicatif::{HumanCount, MultiProgress, ProgressBar, ProgressStyle};
use motion_rtl::check::{CheckError, Proof, Violation};
use motion_rtl::engine::EngineError;
use motion_rtl::registry::{AnyCircuit, AnySweep, Base, ProofSearch, Verdict};
use motion_rtl::sim::{Elaborated, RunError};
use motion_rtl::trace::Clock;
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// A bar over all tasks, and a line for each that is under way.
pub struct Bars {
    lines: MultiProgress,
    pub all: ProgressBar,
}

impl Bars {
    pub fn new(tasks: usize) -> Self {
        let lines = MultiProgress::new();
        let all = lines.add(ProgressBar::new(tasks as u64));
        if let Ok(style) = ProgressStyle::with_template("{wide_bar} {pos} of {len}") {
            all.set_style(style);
        }
        Bars { lines, all }
    }

    /// Adds a line for a circuit.
    pub fn line(&self, circuit: &'static str) -> ProgressBar {
        let line = self.lines.add(ProgressBar::new_spinner());
        if let Ok(style) = ProgressStyle::with_template("{spinner} {prefix}: {msg}") {
            line.set_style(style);
        }
        line.set_prefix(circuit);
        line
    }

    /// Prints a text above the bars.
    pub fn print(&self, text: &str) -> Result<(), Failure> {
        self.lines.suspend(|| print(text))
    }
}

/// Place for the waves of counterexamples.
pub struct Waves<'a> {
    pub directory: &'a Path,
    /// Files that `clean` knows.
    list: Written,
}

impl<'a> Waves<'a> {
    /// Made before the first counterexample: files that are there are not of this command.
    pub fn new(directory: &'a Path) -> Self {
        Waves {
            directory,
            list: Written::read(directory),
        }
    }

    /// Lists waves that were written for `clean`, and returns their paths; or says why there are none.
    pub fn listed(&self, waves: Result<Vec<PathBuf>, RunError>) -> Result<Vec<String>, String> {
        let paths =
            waves.map_err(|error| format!("none: {error}; allowed: another --out, a directory"))?;
        self.list.add(paths.iter().map(PathBuf::as_path));
        Ok(paths
            .iter()
            .map(|path| path.display().to_string())
            .collect())
    }

    /// Returns a report with the paths of its waves. It counts even if they cannot be written.
    pub fn with(&self, report: &str, waves: Result<Vec<PathBuf>, RunError>) -> String {
        let waves = self.listed(waves);
        let waves = waves.map_or_else(|problem| problem, |paths| paths.join(", "));
        format!("{}\nwaves: {waves}", report.trim_end())
    }
}

/// Limits of a proof.
#[derive(Clone, Copy)]
pub struct Limits {
    pub states: u32,
    pub until: Option<Instant>,
}

/// The rows of a part of the tasks, in their order. Proofs run side by side, a thread each; then the
/// sweeps one by one, each on all threads, so that the time of a row is its own.
pub fn run(tasks: &[Task], shard: Shard, limit: u32, out: &Path) -> Result<Vec<Row>, Failure> {
    threads::start()?;
    let mine = tasks::of_shard(shard, tasks);
    let bars = Bars::new(mine.len());
    let out = Waves::new(out);
    let limits = Limits {
        states: limit,
        until: None,
    };
    let done = |(index, task): (usize, &Task)| {
        let line = bars.line(task.circuit());
        let row = row(task, shard, limits, &out, &line);
        line.finish_and_clear();
        bars.all.inc(1);
        row.map(|row| (index, row))
    };
    let (proofs, sweeps): (Vec<_>, Vec<_>) = mine
        .into_iter()
        .enumerate()
        .partition(|(_, task)| task.kind == Kind::Proof);
    let proofs: Vec<_> = proofs.into_par_iter().map(done).collect();
    let rows = proofs.into_iter().chain(sweeps.into_iter().map(done));
    let mut rows = rows.collect::<Result<Vec<_>, _>>()?;
    bars.all.finish_and_clear();
    rows.sort_by_key(|(index, _)| *index);
    Ok(rows.into_iter().map(|(_, row)| row).collect())
}

/// Proves or sweeps.
pub fn row(
    task: &Task,
    shard: Shard,
    limits: Limits,
    out: &Waves<'_>,
    line: &ProgressBar,
) -> Result<Row, Failure> {
    let start = Instant::now();
    let mut row = match task.kind {
        Kind::Proof => match task.entry.proof(&task.pairs) {
            Ok(circuit) => prove(task, &*circuit, limits, out, line)?,
            Err(_) => return Err(unmade(task)),
        },
        Kind::Sweep => match task.entry.law(&task.pairs) {
            Ok(law) => sweep(task, &*law, shard, out, line)?,
            Err(_) => return Err(unmade(task)),
        },
    };
    row.seconds = start.elapsed().as_secs_f64();
    Ok(row)
}

/// Returns the error for a circuit that cannot be made; the tasks name only circuits that can.
fn unmade(task: &Task) -> Failure {
    Failure::Check(format!("{}: cannot be made", task.circuit()))
}

/// A row of which nothing is known yet.
fn begun(task: &Task, invariants: Vec<String>) -> Row {
    let widths = task.entry.widths(Base::Small, &task.pairs);
    Row {
        circuit: task.circuit().to_owned(),
        kind: task.kind,
        widths: widths.into_iter().collect(),
        invariants,
        ended: Ended::Holds,
        states: None,
        transitions: None,
        depth: None,
        dead_ends: None,
        seconds: 0.0,
        fault: None,
    }
}

fn prove(
    task: &Task,
    circuit: &dyn AnyCircuit,
    limits: Limits,
    out: &Waves<'_>,
    line: &ProgressBar,
) -> Result<Row, Failure> {
    let name = task.circuit();
    let invariants = task.asked(circuit.invariants());
    let row = begun(task, invariants.clone());
    let search = ProofSearch {
        states: limits.states,
        until: limits.until,
        invariants: task.property.is_some().then_some(&invariants),
        ..ProofSearch::default()
    };
    let verdict = circuit.prove(&search, &mut |progress| {
        let (states, frontier) = (HumanCount(progress.states), HumanCount(progress.frontier));
        line.set_message(format!("{states} states, {frontier} to go"));
        line.tick();
    });
    Ok(match verdict {
        Err(error @ CheckError::NoInput { .. }) => return Err(Failure::Check(error.to_string())),
        Err(error) => Row {
            ended: Ended::TooWide,
            fault: Some(format!("{name}: {error}; allowed: smaller widths")),
            ..row
        },
        Ok(Verdict::Proved(Proof {
            states,
            transitions,
            depth,
            dead_ends,
        })) => Row {
            states: Some(states),
            transitions: Some(transitions),
            depth: Some(depth),
            dead_ends: Some(dead_ends),
            ..row
        },
        Ok(Verdict::Undecided(progress)) => Row {
            ended: Ended::NotDecided,
            states: Some(progress.states),
            transitions: Some(progress.transitions),
            depth: Some(progress.depth),
            fault: Some(format!(
                "{name}: not decided within {} states; allowed: a larger --limit",
                progress.states
            )),
            ..row
        },
        Ok(Verdict::Broken(found)) => broken(row, &found, circuit.model(), out),
    })
}

fn sweep(
    task: &Task,
    law: &dyn AnySweep,
    shard: Shard,
    out: &Waves<'_>,
    line: &ProgressBar,
) -> Result<Row, Failure> {
    let name = task.circuit();
    let row = begun(task, vec![law.law().to_owned()]);
    if let Some(problem) = tasks::too_wide(law) {
        return Ok(Row {
            ended: Ended::TooWide,
            fault: Some(format!(
                "{name}: {problem}; allowed: {}",
                tasks::allowed_cases()
            )),
            ..row
        });
    }
    let swept = law.cases().and_then(|cases| {
        let range = shard.range(cases);
        line.set_length(range.end - range.start);
        law.sweep(range, None, &|cases| {
            line.inc(cases);
            let (done, all) = (HumanCount(line.position()), line.length().unwrap_or(0));
            line.set_message(format!("{done} of {} cases", HumanCount(all)));
        })
    });
    Ok(match swept {
        Ok(Verdict::Proved(cases)) => Row {
            states: Some(cases),
            ..row
        },
        Ok(Verdict::Broken(found)) => broken(row, &found, law.model(), out),
        Ok(Verdict::Undecided(_)) => Row {
            ended: Ended::NotDecided,
            fault: Some(format!("{name}: not decided")),
            ..row
        },
        Err(error) => Row {
            ended: Ended::TooWide,
            fault: Some(format!("{name}: {error}; allowed: smaller widths")),
            ..row
        },
    })
}

/// Returns the row of a broken property, with waves of the circuit.
fn broken(
    row: Row,
    found: &Violation,
    circuit: Result<Elaborated, EngineError>,
    out: &Waves<'_>,
) -> Row {
    let waves = circuit.map_err(RunError::from);
    let waves = waves.and_then(|model| found.save(&model, Clock::default(), out.directory));
    let report = out.with(&found.to_string(), waves);
    Row {
        ended: Ended::Broken,
        fault: Some(format!("{}: {report}", row.circuit)),
        ..row
    }
}
