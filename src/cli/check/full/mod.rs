//! `check --full`: each property at the circuit's own widths.

mod report;

use super::work::{Bars, Waves};
use crate::cli::chosen::{self, entries};
use crate::cli::{Failure, json, print, threads};
use motion_rtl::check::{Conclusion, InductError, NotInductive, Violation};
use motion_rtl::registry::{AnyModel, Base, Entry, Pair};
use motion_rtl::sim::RunError;
use motion_rtl::trace::Clock;
use rayon::prelude::*;
use report::FullRow;
pub use report::{Asked, FullReport};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Proves the properties of the asked circuits. Unless the report is asked for as JSON, the rows of
/// a circuit are printed as soon as they are there.
pub fn run(asked: Asked, out: &Path, as_json: bool) -> Result<FullReport, Failure> {
    if asked.circuits.is_empty() && !asked.changes.is_empty() {
        return Err(chosen::no_circuit(&asked.changes, "check"));
    }
    let mut tasks = Vec::new();
    for entry in entries(&asked.circuits)? {
        let pairs = asked.changes.pairs(entry)?;
        let circuit = entry.made(Base::Full, &pairs);
        let circuit = circuit.map_err(|error| chosen::refused(entry, error))?;
        tasks.push(Task {
            entry,
            pairs,
            circuit,
        });
    }
    threads::start()?;
    let start = Instant::now();
    let work = Work {
        waves: Waves::new(out),
        limit: Duration::from_secs(asked.limit_seconds),
    };
    let bars = Bars::new(tasks.len());
    let heading = Mutex::new(report::heading());
    // A bridge hands the tasks out in their order.
    let all = tasks.iter().enumerate().par_bridge().map(|(index, task)| {
        let line = bars.line(task.entry.name);
        line.set_message("at full width");
        let rows = work.rows(task)?;
        line.finish_and_clear();
        bars.all.inc(1);
        if let Some(rows) = &rows
            && !as_json
        {
            let text: String = rows.iter().map(|row| row.text(&asked.changes)).collect();
            let mut heading = heading.lock().unwrap_or_else(PoisonError::into_inner);
            bars.print(&(std::mem::take(&mut *heading) + &text))?;
        }
        Ok((index, rows))
    });
    let mut all = all.collect::<Result<Vec<_>, Failure>>()?;
    bars.all.finish_and_clear();
    all.sort_by_key(|(index, _)| *index);
    let (mut rows, mut without) = (Vec::new(), Vec::new());
    for (task, (_, of)) in tasks.iter().zip(all) {
        match of {
            Some(of) => rows.extend(of),
            None => without.push(task.entry.name.to_owned()),
        }
    }
    if rows.is_empty() && !asked.circuits.is_empty() {
        return Err(Failure::Argument {
            field: "CIRCUIT",
            problem: format!(
                "{} has no properties in words of the circuit",
                without.join(", ")
            ),
            allowed: "a circuit that `motion-rtl check --full` lists".to_owned(),
        });
    }
    let report = FullReport {
        version: json::VERSION,
        program_version: env!("CARGO_PKG_VERSION").to_owned(),
        asked,
        rows,
        without_properties: without,
        seconds: start.elapsed().as_secs_f64(),
    };
    match as_json {
        true => json::print_alone(&report)?,
        false => print(&report.ending())?,
    }
    Ok(report)
}

/// Circuit whose properties are proved.
struct Task {
    entry: &'static Entry,
    pairs: Vec<Pair>,
    circuit: Box<dyn AnyModel>,
}

/// Proofs of circuits.
struct Work<'a> {
    waves: Waves<'a>,
    limit: Duration,
}

impl Work<'_> {
    /// Returns the rows of a circuit; `None` if there is nothing to prove.
    fn rows(&self, task: &Task) -> Result<Option<Vec<FullRow>>, Failure> {
        let widths = task.entry.widths(Base::Full, &task.pairs);
        let widths: BTreeMap<_, _> = widths.into_iter().collect();
        let concluded = match task.circuit.induct(self.limit) {
            Ok(concluded) => concluded,
            Err(InductError::NoProperties { .. }) => return Ok(None),
            Err(error) => return Err(Failure::Check(error.to_string())),
        };
        let rows = concluded.into_iter().map(|concluded| {
            let mut row = FullRow::new(task.entry.name, &widths, &concluded);
            match concluded.conclusion {
                Conclusion::Refuted(found) => {
                    let waves = save(&found, &*task.circuit, self.waves.directory);
                    row.report = Some(self.waves.with(&found.to_string(), waves));
                }
                Conclusion::Open { from: Some(from) } => {
                    let waves = save_induction(&from, &*task.circuit, self.waves.directory);
                    row.report = Some(self.waves.with(&from.to_string(), waves));
                }
                _ => {}
            }
            row
        });
        let mut rows: Vec<_> = rows.collect();
        self.narrower(task, &mut rows);
        Ok(Some(rows))
    }

    /// Notes the narrower widths at which properties without a result have one.
    fn narrower(&self, task: &Task, rows: &mut [FullRow]) {
        let open = rows.iter_mut();
        let mut open: Vec<_> = open
            .filter(|row| row.full_width_by.is_undecided())
            .collect();
        let asked = open
            .iter()
            .map(|row| (row.part.as_deref(), &row.property[..]));
        let asked: Vec<_> = asked.collect();
        let found = task.entry.narrower(&task.pairs, &asked, self.limit);
        let widths = |of: Option<Vec<(String, u64)>>| Some(of?.into_iter().collect());
        for (row, narrower) in open.iter_mut().zip(found) {
            row.proved_at = widths(narrower.proved);
            row.refuted_at = widths(narrower.refuted);
        }
    }
}

fn save(found: &Violation, circuit: &dyn AnyModel, out: &Path) -> Result<Vec<PathBuf>, RunError> {
    found.save(&circuit.model()?, Clock::default(), out)
}

fn save_induction(
    from: &NotInductive,
    circuit: &dyn AnyModel,
    out: &Path,
) -> Result<Vec<PathBuf>, RunError> {
    from.save(&circuit.model()?, Clock::default(), out)
}
