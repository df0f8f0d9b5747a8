//! Results at full width as a table and as JSON.

use crate::cli::Failure;
use crate::cli::chosen::Changes;
use motion_rtl::check::{By, Concluded, Conclusion, Violation};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Text below an open property without a state.
const NO_STATE: &str = "no state is known from which it fails: a memory has more than 131,072 bits, \
                        and each violation that was found needs a word that is not in it";

/// Arguments of the command that the report answers.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Asked {
    /// Circuits; all that state properties if empty.
    pub circuits: Vec<String>,
    /// Changed keys, as on the command line.
    pub changes: Changes,
    /// Processor time for each property in seconds.
    pub limit_seconds: u64,
    /// True if a property without a proof is an error.
    pub require_proofs: bool,
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

impl FullBy {
    /// True if the property holds.
    fn is_proved(&self) -> bool {
        matches!(self, Self::EveryState | Self::Induction | Self::Search)
    }

    /// True if there is no result.
    pub fn is_undecided(&self) -> bool {
        matches!(self, Self::Open | Self::TooLarge)
    }
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
    /// Greatest widths in bits at which a property without a result is proved.
    pub proved_at: Option<BTreeMap<String, u64>>,
    /// Least widths in bits at which a property without a result is refuted.
    pub refuted_at: Option<BTreeMap<String, u64>>,
    /// Seconds of processor time for the search and the second check of its result. What properties
    /// share does not count: making the netlist, lemmas.
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
    /// Duration of the command in seconds.
    pub seconds: f64,
}

impl FullRow {
    pub fn new(
        circuit: &str,
        widths: &BTreeMap<String, u64>,
        concluded: &Concluded<Violation>,
    ) -> Self {
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
            refuted_at: None,
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

    /// Returns why there is no result, and what is known of narrower widths.
    fn narrower(&self, why: &str) -> String {
        match (&self.refuted_at, &self.proved_at) {
            (Some(widths), _) => format!("{why}; REFUTED at {}", range(widths)),
            (None, Some(widths)) => format!("{why}; proved at {}", range(widths)),
            (None, None) => why.to_owned(),
        }
    }

    /// Returns the lines of the row; the circuit has these changed keys.
    pub fn text(&self, changes: &Changes) -> String {
        let mut text = String::new();
        let helper = if self.helper { " (helper)" } else { "" };
        let part = self.part.as_ref().map(|part| format!("{part}: "));
        // Writing to a string does not fail.
        let _ = writeln!(
            text,
            "{:<22} {:>5} {:<20} {:>7.3} s  {}{}{helper}{changes}",
            self.circuit,
            range(&self.widths),
            self.by(),
            self.seconds,
            part.unwrap_or_default(),
            self.property,
        );
        for lemma in &self.with {
            let _ = writeln!(text, "  relies on: {lemma}");
        }
        for clause in &self.clauses {
            let _ = writeln!(text, "  {clause}");
        }
        if self.full_width_by == FullBy::Open {
            let report = self.report.as_deref().unwrap_or(NO_STATE);
            let _ = writeln!(text, "  {}", report.replace('\n', "\n  "));
        }
        if let Some(widths) = &self.refuted_at {
            let widths = widths
                .iter()
                .map(|(key, bits)| format!(" --set {key}={bits}"));
            let widths: String = widths.collect();
            let _ = writeln!(
                text,
                "  refuted by: motion-rtl check {} --full{changes}{widths}",
                self.circuit
            );
        }
        text
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

/// Returns the first line of the table.
pub fn heading() -> String {
    format!(
        "{:<22} {:>5} {:<20} {:>9}  property\n",
        "circuit", "width", "at full width by", "time"
    )
}

impl FullReport {
    /// Returns the number of rows with one of these results.
    fn count(&self, of: fn(&FullBy) -> bool) -> usize {
        let rows = self.rows.iter();
        rows.filter(|row| of(&row.full_width_by)).count()
    }

    /// Returns the last lines of the table.
    pub fn ending(&self) -> String {
        let mut text = String::new();
        // Writing to a string does not fail.
        if !self.without_properties.is_empty() && !self.asked.circuits.is_empty() {
            let names = self.without_properties.join(", ");
            let _ = writeln!(text, "without properties in words of the circuit: {names}");
        }
        let others = [
            ("assumed", self.count(|by| *by == FullBy::Assumed)),
            ("open", self.count(|by| *by == FullBy::Open)),
            ("too large", self.count(|by| *by == FullBy::TooLarge)),
            ("REFUTED", self.count(|by| *by == FullBy::Refuted)),
        ];
        let others = others.iter().filter(|(_, count)| *count > 0);
        let others: String = others
            .map(|(what, count)| format!(", {count} {what}"))
            .collect();
        let proved = self.count(FullBy::is_proved);
        let _ = writeln!(text, "{proved} proved{others}; {:.1} s", self.seconds);
        if self.count(FullBy::is_undecided) > 0 {
            let _ = writeln!(
                text,
                "a property without a result may need more than {} s of processor time: --limit-seconds",
                self.asked.limit_seconds
            );
        }
        text
    }

    /// Fails if a property is refuted, and with another error if one is not decided and proofs are
    /// required.
    pub fn faults(&self) -> Result<(), Failure> {
        let of =
            |is: fn(&FullBy) -> bool| self.rows.iter().filter(move |row| is(&row.full_width_by));
        let refuted = of(|by| *by == FullBy::Refuted).map(|row| {
            let report = row.report.as_deref().unwrap_or_default();
            format!("{}: {report}", row.circuit)
        });
        let refuted: Vec<_> = refuted.collect();
        let undecided = of(FullBy::is_undecided).map(|row| {
            let part = row.part.as_ref().map(|part| format!("{part}: "));
            format!(
                "{}: {}{} is {}; allowed: a larger --limit-seconds, or no --require-proofs",
                row.circuit,
                part.unwrap_or_default(),
                row.property,
                row.by(),
            )
        });
        let undecided: Vec<_> = undecided.filter(|_| self.asked.require_proofs).collect();
        match (&refuted[..], &undecided[..]) {
            ([], []) => Ok(()),
            ([], undecided) => Err(Failure::Undecided(undecided.join("\n"))),
            (refuted, _) => Err(Failure::Check(refuted.join("\n"))),
        }
    }
}
