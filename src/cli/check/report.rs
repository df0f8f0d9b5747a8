//! The result as a table and as JSON.

use super::shard::Shard;
use crate::cli::chosen::Changes;
use crate::cli::{Failure, json};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Problem of a circuit that is neither proved nor swept, and what is done instead.
pub const TOO_WIDE: &str = "is too wide for a proof by exhaustion";
pub const ITS_BLOCKS: &str = "its blocks, or --full for what it and its parts state; what is tested of it stands in its note";

/// Arguments of the command that the report answers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Asked {
    /// Circuits; all if empty.
    pub circuits: Vec<String>,
    /// Changed keys, as on the command line.
    pub changes: Changes,
    /// Text that the properties contain, if only these were asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub property: Option<String>,
    /// States after which a proof is given up.
    pub limit: u32,
    /// Seconds for all widths of a circuit, if they were asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seconds: Option<f64>,
}

/// Kind of a row: a proof over all states or a sweep over all cases.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// A proof over all states.
    Proof,
    /// A sweep over all cases.
    Sweep,
}

/// Outcome of a proof or a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Ended {
    /// The properties hold.
    Holds,
    /// A counterexample or a failing case exists.
    Broken,
    /// More states than the limit.
    NotDecided,
    /// More bits than can be enumerated.
    TooWide,
}

/// A proof or a sweep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// Name of the circuit.
    pub circuit: String,
    /// A proof or a sweep.
    pub kind: Kind,
    /// Widths of the circuit in bits.
    pub widths: BTreeMap<String, u64>,
    /// The properties that were checked.
    pub invariants: Vec<String>,
    /// Outcome.
    pub ended: Ended,
    /// The states of a proof, the cases of a sweep.
    pub states: Option<u64>,
    /// Transitions between the states of a proof.
    pub transitions: Option<u64>,
    /// Most ticks from power-on to a state for the first time.
    pub depth: Option<u64>,
    /// States of a proof in which the assumptions allow no input: it covers less than it seems to
    /// if they contradict each other.
    pub dead_ends: Option<u64>,
    /// Duration in seconds.
    pub seconds: f64,
    /// Report of the failure.
    pub fault: Option<String>,
}

impl Row {
    /// The width, or the least and the greatest of several.
    fn width(&self) -> String {
        let (least, greatest) = (self.widths.values().min(), self.widths.values().max());
        match (least, greatest) {
            (Some(least), Some(greatest)) if least == greatest => least.to_string(),
            (Some(least), Some(greatest)) => format!("{least}-{greatest}"),
            _ => String::new(),
        }
    }
}

/// All rows of a work, or of a part of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Report {
    /// Version of the keys.
    pub version: u32,
    /// Version of the program that checked.
    pub program_version: String,
    /// Arguments of the command.
    pub asked: Asked,
    /// Part of the work.
    pub shard: Shard,
    /// Proofs and sweeps.
    pub rows: Vec<Row>,
    /// The circuits that are neither proved nor swept.
    pub too_wide: Vec<String>,
}

impl Report {
    pub fn new(asked: Asked, shard: Shard, rows: Vec<Row>, too_wide: Vec<String>) -> Self {
        Report {
            version: json::VERSION,
            program_version: env!("CARGO_PKG_VERSION").to_owned(),
            asked,
            shard,
            rows,
            too_wide,
        }
    }

    /// Returns the report as text.
    pub fn table(&self) -> String {
        let mut table = String::new();
        // Writing to a string does not fail.
        let _ = writeln!(
            table,
            "{:<22} {:>5} {:>10} {:>12} {:>5} {:>9}",
            "circuit", "width", "states", "transitions", "depth", "time"
        );
        for row in &self.rows {
            let number = |number: Option<u64>| number.map_or(String::new(), |n| n.to_string());
            let ended = match (row.ended, row.kind) {
                (Ended::Holds, Kind::Proof) => "proved",
                (Ended::Holds, Kind::Sweep) => "every case",
                (Ended::Broken, _) => "BROKEN",
                (Ended::NotDecided, _) => "not decided",
                (Ended::TooWide, _) => "too wide",
            };
            let dead_ends = match row.dead_ends {
                None | Some(0) => String::new(),
                Some(1) => ", 1 state without a possible input".to_owned(),
                Some(states) => format!(", {states} states without a possible input"),
            };
            let _ = writeln!(
                table,
                "{:<22} {:>5} {:>10} {:>12} {:>5} {:>7.2} s  {ended}{dead_ends}{}",
                row.circuit,
                row.width(),
                number(row.states),
                number(row.transitions),
                number(row.depth),
                row.seconds,
                self.asked.changes
            );
            let not = match row.ended {
                Ended::Holds => "",
                Ended::Broken | Ended::NotDecided | Ended::TooWide => "not proved: ",
            };
            for invariant in &row.invariants {
                let _ = writeln!(table, "  {not}{invariant}");
            }
        }
        let is_named = |row: &Row| self.asked.circuits.contains(&row.circuit);
        let named = self.rows.iter().filter(|row| is_named(row));
        let mut named: Vec<_> = named
            .filter(|row| row.kind == Kind::Proof && row.ended == Ended::Holds)
            .map(|row| row.circuit.as_str())
            .collect();
        named.dedup();
        if !named.is_empty() {
            let named = named.join(" ");
            let changes = self.asked.changes.to_string();
            let lead = match changes.is_empty() {
                true => "at full width",
                false => "without visiting states",
            };
            let _ = writeln!(table, "{lead}: motion-rtl check {named} --full{changes}");
        }
        if !self.too_wide.is_empty() {
            let _ = writeln!(
                table,
                "too wide for exhaustion: {}",
                self.too_wide.join(", ")
            );
        }
        if self.shard.of > 1 {
            let _ = writeln!(table, "part {} of {}", self.shard.part, self.shard.of);
        }
        table
    }

    /// Fails if something does not hold, and with another error if the arguments leave something
    /// undecided.
    pub fn faults(&self) -> Result<(), Failure> {
        let mut faults: Vec<_> = self
            .rows
            .iter()
            .filter_map(|row| row.fault.clone())
            .collect();
        if !self.asked.circuits.is_empty() {
            let others = self.too_wide.iter();
            faults.extend(others.map(|name| format!("{name} {TOO_WIDE}; allowed: {ITS_BLOCKS}")));
        }
        let any = |ended: Ended| self.rows.iter().any(|row| row.ended == ended);
        match faults.is_empty() {
            true => Ok(()),
            false if any(Ended::Broken) => Err(Failure::Check(faults.join("\n"))),
            false => Err(Failure::Undecided(faults.join("\n"))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_without_a_possible_input_are_shown() {
        let asked = Asked {
            circuits: Vec::new(),
            changes: Changes::default(),
            property: None,
            limit: 100,
            seconds: None,
        };
        let row = |dead_ends| Row {
            circuit: "divider".to_owned(),
            kind: Kind::Proof,
            widths: BTreeMap::from([("width".to_owned(), 4)]),
            invariants: Vec::new(),
            ended: Ended::Holds,
            states: Some(12),
            transitions: Some(90),
            depth: Some(3),
            dead_ends,
            seconds: 0.0,
            fault: None,
        };
        let rows = [None, Some(0), Some(1), Some(2)].map(row).into();
        let report = Report::new(asked, Shard::default(), rows, Vec::new());
        let table = report.table();
        let ends = table.lines().filter_map(|line| line.split_once(" s  "));
        let ends: Vec<_> = ends.map(|(_, end)| end).collect();
        let proved = "proved";
        let one = "proved, 1 state without a possible input";
        let two = "proved, 2 states without a possible input";
        assert_eq!(ends, [proved, proved, one, two]);
    }
}
