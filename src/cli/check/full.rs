//! `check --full`: each property at the circuit's own widths.

use crate::cli::chosen::{self, Changes, entries};
use crate::cli::written::Written;
use crate::cli::{Failure, json, threads};
use motion_rtl::check::{By, Concluded, Conclusion, InductError, NotInductive, Violation};
use motion_rtl::registry::{AnyModel, Base, Entry, Pair};
use motion_rtl::sim::RunError;
use motion_rtl::trace::Clock;
use rayon::prelude::*;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Arguments of the command that the report answers.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Asked {
    /// Circuits; all that state properties if empty.
    pub circuits: Vec<String>,
    /// Changed keys, as on the command line.
    pub changes: Changes,
    /// Time for each property in seconds.
    pub limit_seconds: u64,
}

/// Way to the result of a property, or the result without a proof.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum FullBy {
    /// Proved: no state violates it, reachable or not.
    EveryState,
    /// Proved by induction.
    Induction,
    /// Proved by a search for clauses that hold in every reachable state.
    Search,
    /// A run from power-on violates it.
    Refuted,
    /// Neither a proof nor a counterexample was found in time.
    Open,
    /// A single question took too long, or the circuit has too many gates.
    TooLarge,
    /// Not proved: the circuit relies on it. A circuit around this one has to keep it.
    Assumed,
}

/// Result of a property at the circuit's own widths.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FullRow {
    /// Name of the circuit.
    pub circuit: String,
    /// Widths of the circuit in bits.
    pub widths: BTreeMap<String, u64>,
    /// The property.
    pub property: String,
    /// Path of the part of the circuit that assumes it; `null` for one of the circuit itself.
    pub part: Option<String>,
    /// True if the property is there only to make the proofs of others possible.
    pub helper: bool,
    /// Way to the result.
    pub full_width_by: FullBy,
    /// Ticks that an induction assumes.
    pub ticks: Option<u64>,
    /// Clauses that a search found.
    pub clauses: Vec<String>,
    /// Other properties on which the proof relies.
    pub with: Vec<String>,
    /// Greatest widths in bits at which a property that is too large is proved.
    pub proved_at: Option<BTreeMap<String, u64>>,
    /// Duration in seconds.
    pub seconds: f64,
    /// Report of a counterexample, or the state from which an open property would be violated.
    pub report: Option<String>,
}

/// Results of all properties at full width.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FullReport {
    /// Version of the keys.
    pub version: u32,
    /// Version of the program that checked.
    pub program_version: String,
    /// Arguments of the command.
    pub asked: Asked,
    /// Properties, and what the parts of the circuits assume.
    pub rows: Vec<FullRow>,
    /// Circuits that state no property in words of the circuit, nor contain a part that assumes one.
    pub without_properties: Vec<String>,
}

/// Proves the properties of the asked circuits.
pub fn run(asked: Asked, out: &Path) -> Result<FullReport, Failure> {
    if asked.circuits.is_empty() && !asked.changes.is_empty() {
        return Err(chosen::no_circuit(&asked.changes, "check"));
    }
    let mut tasks = Vec::new();
    for entry in entries(&asked.circuits)? {
        let pairs = asked.changes.pairs(entry)?;
        let circuit = entry.made(Base::Full, &pairs);
        let circuit = circuit.map_err(|error| chosen::refused(entry, error))?;
        tasks.push((entry, pairs, circuit));
    }
    threads::start()?;
    // Before the first counterexample: files that are there are not of this command.
    let list = Written::read(out);
    let limit = Duration::from_secs(asked.limit_seconds);
    let of = |(entry, pairs, circuit): &(&'static Entry, Vec<Pair>, Box<dyn AnyModel>)| {
        let widths: BTreeMap<_, _> = entry.widths(Base::Full, pairs).into_iter().collect();
        let concluded = match circuit.induct(limit) {
            Ok(concluded) => concluded,
            Err(InductError::NoProperties { .. }) => return Ok(None),
            Err(error) => return Err(Failure::Check(error.to_string())),
        };
        let rows = concluded.into_iter().map(|concluded| {
            let mut row = row(entry.name, &widths, &concluded);
            match concluded.conclusion {
                Conclusion::Refuted(found) => {
                    let waves = save(&found, &**circuit, out);
                    row.report = Some(with_waves(&found.to_string(), waves, &list));
                }
                Conclusion::Open { from: Some(from) } => {
                    let waves = save_induction(&from, &**circuit, out);
                    row.report = Some(with_waves(&from.to_string(), waves, &list));
                }
                _ => {}
            }
            if matches!(row.full_width_by, FullBy::Open | FullBy::TooLarge) {
                let narrower = entry.narrower(pairs, (row.part.as_deref(), &row.property), limit);
                row.proved_at = narrower.map(|widths| widths.into_iter().collect());
            }
            row
        });
        Ok(Some(rows.collect::<Vec<_>>()))
    };
    let all: Vec<_> = tasks.par_iter().map(of).collect::<Result<_, Failure>>()?;
    let (mut rows, mut without) = (Vec::new(), Vec::new());
    for ((entry, _, _), of) in tasks.iter().zip(all) {
        match of {
            Some(of) => rows.extend(of),
            None => without.push(entry.name.to_owned()),
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
    Ok(FullReport {
        version: json::VERSION,
        program_version: env!("CARGO_PKG_VERSION").to_owned(),
        asked,
        rows,
        without_properties: without,
    })
}

fn row(circuit: &str, widths: &BTreeMap<String, u64>, concluded: &Concluded<Violation>) -> FullRow {
    let mut row = FullRow {
        circuit: circuit.to_owned(),
        widths: widths.clone(),
        property: concluded.property.clone(),
        part: concluded.part.clone(),
        helper: concluded.is_helper,
        full_width_by: FullBy::Open,
        ticks: None,
        clauses: Vec::new(),
        with: Vec::new(),
        proved_at: None,
        seconds: concluded.time.as_secs_f64(),
        report: None,
    };
    row.full_width_by = match &concluded.conclusion {
        Conclusion::Refuted(_) => FullBy::Refuted,
        Conclusion::Open { .. } => FullBy::Open,
        Conclusion::TooLarge => FullBy::TooLarge,
        Conclusion::Assumed => FullBy::Assumed,
        Conclusion::Proof { by, with } => {
            row.with.clone_from(with);
            match by {
                By::EveryState => FullBy::EveryState,
                By::Induction(ticks) => {
                    row.ticks = Some(*ticks as u64);
                    FullBy::Induction
                }
                By::Search { clauses } => {
                    row.clauses = clauses.iter().map(ToString::to_string).collect();
                    FullBy::Search
                }
            }
        }
    };
    row
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

/// Returns a report with the paths of its waves. The report counts even if they cannot be written.
fn with_waves(report: &str, waves: Result<Vec<PathBuf>, RunError>, list: &Written) -> String {
    let waves = match waves {
        Ok(paths) => {
            list.add(paths.iter().map(PathBuf::as_path));
            let paths = paths.iter().map(|path| path.display().to_string());
            paths.collect::<Vec<_>>().join(", ")
        }
        Err(error) => format!("none: {error}; allowed: another --out, a directory"),
    };
    format!("{}\nwaves: {waves}", report.trim_end())
}

impl FullRow {
    fn by(&self) -> String {
        let clauses = self.clauses.len();
        match self.full_width_by {
            FullBy::EveryState => "every state".to_owned(),
            FullBy::Induction => format!("induction {}", self.ticks.unwrap_or_default()),
            FullBy::Search if clauses == 1 => "search, 1 clause".to_owned(),
            FullBy::Search => format!("search, {clauses} clauses"),
            FullBy::Refuted => "REFUTED".to_owned(),
            FullBy::Assumed => "assumed".to_owned(),
            FullBy::Open => self.narrower("open"),
            FullBy::TooLarge => self.narrower("too large"),
        }
    }

    /// Returns why there is no proof, and the widest width at which there is one.
    fn narrower(&self, why: &str) -> String {
        match &self.proved_at {
            Some(widths) => format!("{why}; proved at {}", range(widths)),
            None => why.to_owned(),
        }
    }
}

/// Returns the width, or the least and the greatest of several.
fn range(widths: &BTreeMap<String, u64>) -> String {
    match (widths.values().min(), widths.values().max()) {
        (Some(least), Some(greatest)) if least == greatest => least.to_string(),
        (Some(least), Some(greatest)) => format!("{least}-{greatest}"),
        _ => String::new(),
    }
}

impl FullReport {
    /// Returns the report as text.
    pub fn table(&self) -> String {
        let mut table = String::new();
        // Writing to a string does not fail.
        let _ = writeln!(
            table,
            "{:<22} {:>5} {:<20} {:>9}  property",
            "circuit", "width", "at full width by", "time"
        );
        for row in &self.rows {
            let helper = if row.helper { " (helper)" } else { "" };
            let part = row.part.as_ref().map(|part| format!("{part}: "));
            let part = part.unwrap_or_default();
            let _ = writeln!(
                table,
                "{:<22} {:>5} {:<20} {:>7.3} s  {part}{}{helper}{}",
                row.circuit,
                range(&row.widths),
                row.by(),
                row.seconds,
                row.property,
                self.asked.changes
            );
            for lemma in &row.with {
                let _ = writeln!(table, "  relies on: {lemma}");
            }
            for clause in &row.clauses {
                let _ = writeln!(table, "  {clause}");
            }
            if row.full_width_by == FullBy::Open {
                let report = row
                    .report
                    .as_deref()
                    .unwrap_or("no state is known from which it fails");
                let _ = writeln!(table, "  {}", report.replace('\n', "\n  "));
            }
        }
        if !self.without_properties.is_empty() && !self.asked.circuits.is_empty() {
            let names = self.without_properties.join(", ");
            let _ = writeln!(table, "without properties in words of the circuit: {names}");
        }
        table
    }

    /// Fails if a property is refuted. A property that is open or too large is no failure.
    pub fn faults(&self) -> Result<(), Failure> {
        let refuted = self
            .rows
            .iter()
            .filter(|row| row.full_width_by == FullBy::Refuted);
        let faults: Vec<_> = refuted
            .map(|row| {
                format!(
                    "{}: {}",
                    row.circuit,
                    row.report.as_deref().unwrap_or_default()
                )
            })
            .collect();
        match faults.is_empty() {
            true => Ok(()),
            false => Err(Failure::Check(faults.join("\n"))),
        }
    }
}
