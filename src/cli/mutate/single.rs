//! `mutate --fault`: a single fault, and each check that finds it.

use super::{Arguments, failure};
use crate::cli::check::Waves;
use crate::cli::chosen::matching;
use crate::cli::{Failure, json, named, print};
use motion_rtl::hdl::Mutation;
use motion_rtl::nearest::did_you_mean;
use motion_rtl::registry::{Campaign, Entry, Found, Single, Witness};
use serde::Serialize;
use std::fmt::Write as _;

/// Most faults that a message lists.
const LISTED: usize = 8;

/// Check that finds a fault, or the run that shows it.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
enum By {
    /// A timing chart of the circuit.
    Chart,
    /// The proof of a property.
    Proof,
    /// The sweep of a law.
    Law,
    /// A timing chart of a circuit around it.
    Around,
    /// A run on random inputs: it shows the fault, but does not find it.
    Random,
}

/// A run on which a fault shows.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct Run {
    /// Check that finds the fault.
    by: By,
    /// Title of the chart, the property, the law, or the number of the random run.
    name: String,
    /// Circuit that was run: the circuit of the fault or one around it.
    circuit: &'static str,
    /// Tick at which the fault shows.
    tick: u64,
    /// Description of the failure.
    report: String,
    /// First signal that differs from the circuit without the fault: tick, signal and values.
    first_difference: Option<String>,
    /// Paths of the waves with and without the fault, and of their save file.
    waves: Vec<String>,
}

/// Checks that find a single fault, and properties that do not.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Report {
    /// Name of the circuit.
    circuit: &'static str,
    /// Number of the fault in the list of `mutate`, from 1.
    number: usize,
    /// Place of the fault and its change.
    fault: String,
    /// Checks that find the fault.
    found: Vec<Run>,
    /// Properties that hold in spite of the fault.
    hold: Vec<String>,
    /// Properties without a result.
    undecided: Vec<String>,
    /// Reason why they have none.
    undecided_because: Option<String>,
    /// Random run that shows the fault at an output port, if no check of the circuit finds it.
    random: Option<Run>,
    /// Reason why the circuit cannot be elaborated with the fault.
    refused: Option<String>,
}

/// Injects a fault into the one circuit that is asked for.
pub fn run(
    arguments: &Arguments,
    (campaign, notes): (&Campaign, &[String]),
    entries: &[&'static Entry],
    fault: &str,
) -> Result<(), Failure> {
    let [entry] = entries else {
        return Err(Failure::Argument {
            field: "CIRCUIT",
            problem: match arguments.circuits.is_empty() {
                true => "missing beside --fault".to_owned(),
                false => "--fault takes one circuit".to_owned(),
            },
            allowed: "one circuit, as in `mutate comparator --fault 1`".to_owned(),
        });
    };
    let pairs = arguments.changes.pairs(entry)?;
    let failed = |error| failure(error, entry, campaign, notes);
    let faults = campaign.faults(entry, &pairs).map_err(failed)?;
    let index = chosen(entry.name, fault, &faults)?;
    let waves = Waves::new(&arguments.out);
    let single = campaign.single(entry, &pairs, &faults[index], &arguments.out);
    let single = single.map_err(failed)?;
    let report = Report::new(entry.name, (index, &faults[index]), single, &waves);
    match arguments.json {
        true => json::print(&report),
        false => print(&report.text()),
    }
}

/// Returns the index of a fault that is given by its number or a part of its text.
fn chosen(circuit: &str, wanted: &str, faults: &[Mutation]) -> Result<usize, Failure> {
    let refused = |problem: String| {
        let count = faults.len();
        let allowed = format!(
            "1 to {count}, or a part of the text of one fault; `motion-rtl mutate {circuit} --json` lists them"
        );
        let field = "--fault";
        Err(Failure::Argument {
            field,
            problem,
            allowed,
        })
    };
    if let Ok(number) = wanted.parse::<usize>() {
        return match number.checked_sub(1).filter(|index| *index < faults.len()) {
            Some(index) => Ok(index),
            None => refused(format!("{circuit} has no fault {number}")),
        };
    }
    let texts: Vec<_> = faults.iter().map(Mutation::to_string).collect();
    let found = matching(wanted, texts.iter().map(String::as_str));
    match found[..] {
        [index] => Ok(index),
        [] => {
            let near = did_you_mean(wanted, texts.iter().map(String::as_str));
            refused(format!("{circuit} has no fault {}{near}", named(wanted)))
        }
        _ => {
            let listed = found.iter().take(LISTED);
            let listed: Vec<_> = listed
                .map(|index| format!("{} ({})", index + 1, texts[*index]))
                .collect();
            let more = match found.len().saturating_sub(LISTED) {
                0 => String::new(),
                more => format!(" and {more} more"),
            };
            let wanted = named(wanted);
            let listed = listed.join(", ");
            refused(format!("{wanted} is a part of several: {listed}{more}"))
        }
    }
}

impl Run {
    fn new(witness: Witness, waves: &Waves<'_>) -> Self {
        let (files, unwritten) = match waves.listed(witness.waves) {
            Ok(paths) => (paths, None),
            Err(problem) => (Vec::new(), Some(problem)),
        };
        let report = witness.report.trim_end().to_owned();
        Run {
            by: match witness.by {
                Some(Found::Chart(_)) => By::Chart,
                Some(Found::Proof) => By::Proof,
                Some(Found::Law) => By::Law,
                Some(Found::Around(..)) => By::Around,
                None => By::Random,
            },
            name: witness.name,
            circuit: witness.circuit,
            tick: witness.tick,
            report: match unwritten {
                None => report,
                Some(problem) => format!("{report}\nwaves: {problem}"),
            },
            first_difference: witness.first,
            waves: files,
        }
    }

    fn text(&self) -> String {
        let title = match self.by {
            By::Chart => format!("found by chart: {}", self.name),
            By::Proof => format!("found by property: {}", self.name),
            By::Law => format!("found by law: {}", self.name),
            By::Around => format!("found by chart of {}: {}", self.circuit, self.name),
            By::Random => format!("shown by {}", self.name),
        };
        let mut text = format!("{title}\n");
        let first = self.first_difference.as_ref();
        let first = first.map(|first| format!("first difference: {first}"));
        let waves = self.waves.join(", ");
        let waves = (!waves.is_empty()).then(|| format!("waves: {waves}"));
        let lines = self.report.lines();
        let lines = lines.chain(first.as_deref()).chain(waves.as_deref());
        for line in lines {
            // Writing to a string does not fail.
            let _ = writeln!(text, "  {line}");
        }
        text
    }
}

impl Report {
    fn new(
        circuit: &'static str,
        (index, mutation): (usize, &Mutation),
        single: Single,
        waves: &Waves<'_>,
    ) -> Self {
        let run = |witness| Run::new(witness, waves);
        let (undecided, because) = single.undecided.unzip();
        Report {
            circuit,
            number: index + 1,
            fault: mutation.to_string(),
            found: single.found.into_iter().map(run).collect(),
            hold: single.hold,
            undecided: undecided.unwrap_or_default(),
            undecided_because: because,
            random: single.random.map(run),
            refused: single.refused,
        }
    }

    fn text(&self) -> String {
        let mut text = format!("{}: fault {}: {}\n", self.circuit, self.number, self.fault);
        // Writing to a string does not fail.
        if let Some(reason) = &self.refused {
            let _ = writeln!(text, "cannot be elaborated: {reason}");
            return text;
        }
        for run in self.found.iter().chain(&self.random) {
            text += &run.text();
        }
        if self.found.is_empty() {
            text += match self.random {
                Some(_) => "no chart, property or law finds it\n",
                None => "no check finds it, and no random run shows it at an output port\n",
            };
        }
        for property in &self.hold {
            let _ = writeln!(text, "holds in spite of it: {property}");
        }
        let because = self.undecided_because.as_deref().unwrap_or_default();
        for property in &self.undecided {
            let _ = writeln!(text, "not decided: {property}: {because}");
        }
        text
    }
}
