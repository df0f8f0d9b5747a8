//! Proofs at all widths, from 1 up.

use super::report::{Ended, Kind, Row};
use super::shard::Shard;
use super::tasks::Task;
use super::work::{self, Bars, Limits, Waves};
use crate::cli::{Failure, threads};
use motion_rtl::registry::{Base, Pair};
use rayon::prelude::*;
use std::path::Path;
use std::time::{Duration, Instant};

/// Reads the time for a circuit.
pub fn seconds(text: &str) -> Result<Duration, &'static str> {
    let seconds = text.parse().ok();
    let seconds = seconds.filter(|seconds: &f64| *seconds > 0.0 && *seconds <= 1e6);
    let seconds = seconds.map(Duration::from_secs_f64);
    seconds.ok_or("allowed: seconds above 0, up to 1000000")
}

/// Returns the rows of all widths of each circuit, until its time is over.
pub fn run(
    tasks: &[Task],
    (states, time): (u32, Duration),
    out: &Path,
) -> Result<Vec<Row>, Failure> {
    threads::start()?;
    let proofs: Vec<_> = tasks
        .iter()
        .filter(|task| task.kind == Kind::Proof)
        .collect();
    let Some(_) = proofs.first() else {
        let names: Vec<_> = tasks.iter().map(Task::circuit).collect();
        return Err(Failure::Argument {
            field: "--all-widths",
            problem: format!("{}: swept, not proved", names.join(", ")),
            allowed: "circuits that are proved".to_owned(),
        });
    };
    let bars = Bars::new(proofs.len());
    let out = Waves::new(out);
    let rows = proofs.into_par_iter().map(|task| {
        let line = bars.line(task.circuit());
        let mut rows = Vec::new();
        let limits = Limits {
            states,
            until: Some(Instant::now() + time),
        };
        for task in steps(task) {
            let mut row = work::row(&task, Shard::default(), limits, &out, &line)?;
            let ended = row.ended;
            // There is always a width that takes too long.
            if matches!(ended, Ended::NotDecided | Ended::TooWide) {
                row.fault = None;
            }
            rows.push(row);
            if ended != Ended::Holds {
                break;
            }
        }
        line.finish_and_clear();
        bars.all.inc(1);
        Ok(rows)
    });
    let rows: Result<Vec<Vec<Row>>, Failure> = rows.collect();
    bars.all.finish_and_clear();
    Ok(rows?.into_iter().flatten().collect())
}

/// Returns the circuit at widths from 1 up: all grow together, those that are less in the small
/// circuit begin later. Without widths it comes once.
fn steps(task: &Task) -> impl Iterator<Item = Task> {
    let small = task.entry.widths(Base::Small, &task.pairs);
    let least = small.iter().map(|(_, bits)| *bits).min().unwrap_or(1);
    let most = if small.is_empty() { 1 } else { 64 };
    let task = task.clone();
    (0..most).filter_map(move |step| {
        let grown = small.iter().map(|(key, bits)| {
            let bits = (bits + step).saturating_sub(least - 1).max(1);
            Pair::new(key, bits.to_string())
        });
        let pairs: Vec<Pair> = task.pairs.iter().cloned().chain(grown).collect();
        // Some circuits need more.
        let invariants = task.entry.proof(&pairs).ok()?.invariants();
        if task.asked(invariants).is_empty() && task.property.is_some() {
            return None;
        }
        Some(Task {
            pairs,
            ..task.clone()
        })
    })
}
