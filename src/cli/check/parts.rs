//! Parts of a work that is done in several places, and how they come together.

use super::report::{Asked, Ended, Report, Row};
use super::shard::Shard;
use super::tasks::{self, Task};
use crate::cli::{Failure, json};
use motion_rtl::input::{Fault, read_string};
use std::path::{Path, PathBuf};

/// Contents of a part's file, for messages.
const PRINTED: &str = "what `check --shard --json` printed";
/// Most missing parts that a message lists.
const LISTED: usize = 10;

fn fault(file: &Path, line: usize, field: &str, problem: String, allowed: String) -> Failure {
    let file = file.display().to_string();
    Failure::Input(Fault::new(&file, line, field, problem, allowed))
}

/// Reads a part, and holds it against the tasks that its own arguments ask for.
fn read(path: &Path) -> Result<(Report, Vec<Task>), Failure> {
    let text = read_string(path, PRINTED)?;
    let mut json = serde_json::Deserializer::from_str(&text);
    let report: Result<Report, _> = serde_path_to_error::deserialize(&mut json);
    let report = report.map_err(|error| {
        let (field, error) = (error.path().to_string(), error.into_inner());
        fault(
            path,
            error.line(),
            &field,
            error.to_string(),
            PRINTED.into(),
        )
    })?;
    let (own, program) = (json::VERSION, env!("CARGO_PKG_VERSION"));
    if report.version != own {
        let problem = format!("is {}", report.version);
        return Err(fault(path, 0, "version", problem, own.to_string()));
    }
    if report.program_version != program {
        let problem = format!("is {}", report.program_version);
        let allowed = program.to_owned();
        return Err(fault(path, 0, "program_version", problem, allowed));
    }
    let Shard { part, of } = report.shard;
    if !(1..=of).contains(&part) {
        let problem = format!("is {part} of {of}");
        return Err(fault(path, 0, "shard", problem, format!("1 to {of}")));
    }
    let (tasks, _) = tasks::of(&report.asked)?;
    let mine = tasks::of_shard(report.shard, &tasks);
    let of_task = |task: &Task| (task.circuit(), task.kind);
    let of_row = |row: &Row| (row.circuit.clone(), row.kind);
    for (index, row) in report.rows.iter().enumerate() {
        let right = mine.get(index).is_some_and(|task| {
            let (circuit, kind) = of_task(task);
            of_row(row) == (circuit.to_owned(), kind)
        });
        if !right {
            let field = format!("rows[{index}].circuit");
            let allowed = mine
                .get(index)
                .map_or("no more rows", |task| task.circuit());
            let problem = format!("is {}", row.circuit);
            return Err(fault(path, 0, &field, problem, allowed.to_owned()));
        }
    }
    if let Some(task) = mine.get(report.rows.len()) {
        let problem = format!("without {}", task.circuit());
        let allowed = format!("{} rows", mine.len());
        return Err(fault(path, 0, "rows", problem, allowed));
    }
    Ok((report, tasks))
}

/// Puts the parts together.
pub fn merge(paths: &[PathBuf]) -> Result<Report, Failure> {
    let mut parts: Vec<(Report, &PathBuf)> = Vec::new();
    let mut all = Vec::new();
    for path in paths {
        let (report, tasks) = read(path)?;
        if let Some((first, other)) = parts.first() {
            let other = other.display();
            let differs = |field, problem: String, allowed: String| {
                let problem = format!("{problem}, that of {other} {allowed}");
                Err(fault(path, 0, field, problem, "parts of one work".into()))
            };
            if report.asked != first.asked {
                return differs("asked", told(&report.asked), told(&first.asked));
            }
            if report.shard.of != first.shard.of {
                let (this, that) = (report.shard.of, first.shard.of);
                return differs("shard.of", this.to_string(), that.to_string());
            }
        }
        let same = parts.iter().find(|(other, _)| other.shard == report.shard);
        if let Some((_, other)) = same {
            let problem = format!("is {}, as that of {}", report.shard.part, other.display());
            let allowed = "each part once".to_owned();
            return Err(fault(path, 0, "shard.part", problem, allowed));
        }
        all = tasks;
        parts.push((report, path));
    }
    parts.sort_by_key(|(report, _)| report.shard.part);
    let of = parts.first().map_or(1, |(first, _)| first.shard.of);
    let there = |part: &u32| parts.iter().any(|(report, _)| report.shard.part == *part);
    // Each is there once, and none above `of`.
    let missing = of as usize - parts.len();
    if missing > 0 {
        // Not all of them: `of` is whatever a file says.
        let listed = (1..=of).filter(|part| !there(part)).take(LISTED);
        let listed: Vec<_> = listed.map(|part| format!("{part}/{of}")).collect();
        let mut problem = format!("without part {}", listed.join(", "));
        if missing > listed.len() {
            problem.push_str(&format!(" and {} more", missing - listed.len()));
        }
        return Err(Failure::Argument {
            field: "--merge",
            problem,
            allowed: format!("all {of} parts"),
        });
    }
    let mut rows: Vec<_> = parts
        .iter()
        .map(|(report, _)| report.rows.clone().into_iter().peekable())
        .collect();
    let merged = all.iter().filter_map(|task| {
        let mut whole: Option<Row> = None;
        for rows in &mut rows {
            let belongs = |row: &Row| row.circuit == task.circuit() && row.kind == task.kind;
            if let Some(row) = rows.next_if(belongs) {
                whole = Some(match whole {
                    None => row,
                    Some(before) => joined(before, row),
                });
            }
        }
        whole
    });
    let merged = merged.collect();
    let mut parts = parts.into_iter();
    let Some((first, _)) = parts.next() else {
        return Err(unread());
    };
    Ok(Report {
        shard: Shard::default(),
        rows: merged,
        ..first
    })
}

/// There is at least one file, or the command line is refused.
fn unread() -> Failure {
    Failure::Argument {
        field: "--merge",
        problem: "names no file".into(),
        allowed: "the files of all parts".into(),
    }
}

/// Returns the request as a command line.
fn told(asked: &Asked) -> String {
    let names = asked.circuits.iter().map(|name| format!(" {name}"));
    let names: String = names.collect();
    let property = asked.property.iter();
    let property: String = property
        .map(|text| format!(" --property {text:?}"))
        .collect();
    format!(
        "check{names}{}{property} --limit {}",
        asked.changes, asked.limit
    )
}

/// The parts of a sweep, that of the lower cases first.
fn joined(before: Row, row: Row) -> Row {
    let seconds = before.seconds + row.seconds;
    let whole = match (before.ended, row.ended) {
        (Ended::Holds, Ended::Holds) => Row {
            states: Some(
                before
                    .states
                    .unwrap_or(0)
                    .saturating_add(row.states.unwrap_or(0)),
            ),
            ..before
        },
        // The fault of the lowest case counts; a counterexample takes precedence over all else.
        (Ended::Broken, _) => before,
        (Ended::Holds, _) | (_, Ended::Broken) => row,
        _ => before,
    };
    Row { seconds, ..whole }
}
