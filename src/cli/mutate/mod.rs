//! `mutate`: single faults in circuits, and what finds them.

mod single;

#[cfg(feature = "schema")]
pub use single::Report as SingleReport;

use super::chosen::{self, Changes, entries};
use super::notes::NOTES;
use super::{Failure, json, print, threads};
use clap::Args;
use indicatif::{MultiProgress, ProgressBar, ProgressStyle};
use motion_rtl::input::{Fault, or_more_files, read_string};
use motion_rtl::registry::{Campaign, CampaignError, Entry, Fate, Found, Pair, Suspect};
use motion_rtl::sim::RunError;
use motion_rtl::trace::chart::{Chart, parse};
use rayon::prelude::*;
use serde::Serialize;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Notes as `--charts` takes them.
const CHARTS: &str = "Markdown with timing charts, or a folder of it";

/// Arguments of `mutate`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Circuits; all by default.
    #[arg(value_name = "CIRCUIT")]
    circuits: Vec<String>,
    #[command(flatten)]
    changes: Changes,
    /// Notes whose timing charts are run: a file in Markdown or a folder of them; by default those of
    /// the circuits that ship.
    #[arg(long, value_name = "PATH")]
    charts: Option<PathBuf>,
    /// Ticks of each random run that shows whether a fault reaches an output port.
    #[arg(long, value_name = "TICKS", allow_negative_numbers = true, default_value_t = 2_000, value_parser = clap::value_parser!(u64).range(1..=100_000_000))]
    ticks: u64,
    /// Count of random runs.
    #[arg(long, value_name = "RUNS", allow_negative_numbers = true, default_value_t = 8, value_parser = clap::value_parser!(u64).range(1..=10_000))]
    runs: u64,
    /// Transitions after which a proof is given up.
    #[arg(
        long,
        value_name = "TRANSITIONS",
        allow_negative_numbers = true,
        default_value_t = 20_000_000
    )]
    transitions: u64,
    /// Fails if less than this percentage of the faults that show is found.
    #[arg(long, value_name = "PERCENT", conflicts_with = "fault", allow_negative_numbers = true, value_parser = clap::value_parser!(u8).range(0..=100))]
    least: Option<u8>,
    /// Also lists the faults that no random run shows.
    #[arg(long, conflicts_with = "fault")]
    unseen: bool,
    /// Injects only this fault, and shows each check that finds it, with waves: a number of the list
    /// that `--json` prints, or a part of the fault's text.
    #[arg(long, value_name = "FAULT")]
    fault: Option<String>,
    /// Directory for the waves of a single fault.
    #[arg(long, value_name = "DIR", default_value = "waves", requires = "fault")]
    out: PathBuf,
    /// Prints every fault as JSON, or what finds a single one.
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Serialize)]
struct Row {
    circuit: &'static str,
    /// Faults of a circuit that can still be elaborated.
    faults: usize,
    /// Faults found by one of the circuit's charts.
    chart: usize,
    /// Faults found by its proof or a law.
    proof: usize,
    /// Faults found by a chart of a circuit around it.
    around: usize,
    /// Faults that no random run shows.
    unseen: usize,
    /// Faults that a random run shows and nothing finds.
    missed: usize,
    seconds: f64,
    suspects: Vec<Told>,
}

/// A fault and what became of it, in words.
#[derive(Debug, Serialize)]
struct Told {
    /// Number for `--fault`.
    number: usize,
    fault: String,
    fate: &'static str,
    #[serde(skip_serializing_if = "String::is_empty")]
    by: String,
}

#[derive(Debug, Serialize)]
struct Report {
    circuits: Vec<Row>,
    found_percent: f64,
}

/// Puts faults into circuits.
pub fn mutate(arguments: &Arguments) -> Result<(), Failure> {
    let entries = entries(&arguments.circuits)?;
    let charts = match &arguments.charts {
        Some(path) => charts(path)?,
        None => shipped(NOTES)?,
    };
    let (notes, charts): (Vec<_>, Vec<_>) = charts.into_iter().unzip();
    let campaign = Campaign {
        charts,
        ticks: arguments.ticks,
        runs: arguments.runs,
        transitions: arguments.transitions,
    };
    if arguments.circuits.is_empty() && !arguments.changes.is_empty() {
        return Err(chosen::no_circuit(&arguments.changes, "mutate"));
    }
    threads::start()?;
    if let Some(fault) = &arguments.fault {
        return single::run(arguments, (&campaign, &notes), &entries, fault);
    }
    let bars = MultiProgress::new();
    let entries = entries.into_par_iter().with_max_len(1);
    let rows = entries.map(|entry| {
        let pairs = arguments.changes.pairs(entry)?;
        row(&campaign, &notes, (entry, &pairs), &bars)
    });
    let report = Report::of(rows.collect::<Result<_, _>>()?);
    match arguments.json {
        true => json::print(&report)?,
        false => print(&report.text(arguments.unseen))?,
    }
    match arguments.least {
        Some(least) if report.found_percent < f64::from(least) => Err(Failure::Check(format!(
            "{:.2} % of the faults that show are found; wanted: {least} %",
            report.found_percent
        ))),
        _ => Ok(()),
    }
}

/// The charts of the notes that ship, each with the note's name.
fn shipped(notes: &[(&str, &str)]) -> Result<Vec<(String, Chart)>, Failure> {
    if notes.is_empty() {
        return Err(Failure::Argument {
            field: "--charts",
            problem: "this program comes without notes, so the option is needed".into(),
            allowed: CHARTS.to_owned(),
        });
    }
    let mut charts = Vec::new();
    for &(name, text) in notes {
        charts.extend(of_note(name, text)?);
    }
    Ok(charts)
}

fn of_note(name: &str, text: &str) -> Result<Vec<(String, Chart)>, Fault> {
    let parsed = parse(text).map_err(|error| {
        let problem = error.problem.to_string();
        Fault::new(name, error.line, "chart", problem, CHARTS)
    })?;
    Ok(parsed
        .into_iter()
        .map(|chart| (name.to_owned(), chart))
        .collect())
}

/// Adds the notes of a folder and of the folders inside it; links to folders are left out.
fn add_notes(folder: &Path, notes: &mut Vec<PathBuf>) -> Result<(), Fault> {
    let failed = |error: std::io::Error| {
        let problem = format!("cannot be read: {error}");
        let allowed = or_more_files(&error, CHARTS);
        Fault::new(
            &folder.display().to_string(),
            0,
            "--charts",
            problem,
            allowed,
        )
    };
    for entry in folder.read_dir().map_err(failed)? {
        let entry = entry.map_err(failed)?;
        let path = entry.path();
        if entry.file_type().map_err(failed)?.is_dir() {
            add_notes(&path, notes)?;
        } else if path.extension().is_some_and(|extension| extension == "md") {
            notes.push(path);
        }
    }
    Ok(())
}

/// Returns the charts of a note, or of all notes below a folder, each with the note's name.
fn charts(path: &Path) -> Result<Vec<(String, Chart)>, Failure> {
    let mut notes = Vec::new();
    if path.is_dir() {
        add_notes(path, &mut notes)?;
        notes.sort();
    } else {
        notes.push(path.to_owned());
    }
    let mut charts = Vec::new();
    for note in notes {
        let text = read_string(&note, CHARTS)?;
        charts.extend(of_note(&note.display().to_string(), &text)?);
    }
    match charts.is_empty() {
        true => Err(Failure::Argument {
            field: "--charts",
            problem: format!("{} has no timing chart", path.display()),
            allowed: CHARTS.to_owned(),
        }),
        false => Ok(charts),
    }
}

fn row(
    campaign: &Campaign,
    notes: &[String],
    (entry, pairs): (&'static Entry, &[Pair]),
    bars: &MultiProgress,
) -> Result<Row, Failure> {
    let begun = Instant::now();
    let bar = bars.add(ProgressBar::new(0));
    if let Ok(style) = ProgressStyle::with_template("{prefix} {wide_bar} {pos} of {len}") {
        bar.set_style(style);
    }
    bar.set_prefix(entry.name);
    let suspects = campaign.run(entry, pairs, &|all| {
        bar.set_length(all as u64);
        bar.inc(1);
    });
    bar.finish_and_clear();
    let suspects = suspects.map_err(|error| failure(error, entry, campaign, notes))?;
    let count = |is: fn(&Fate) -> bool| suspects.iter().filter(|s| is(&s.fate)).count();
    Ok(Row {
        circuit: entry.name,
        faults: suspects.len() - count(|fate| *fate == Fate::Refused),
        chart: count(|fate| matches!(fate, Fate::Found(Found::Chart(_)))),
        proof: count(|fate| matches!(fate, Fate::Found(Found::Proof | Found::Law))),
        around: count(|fate| matches!(fate, Fate::Found(Found::Around(..)))),
        unseen: count(|fate| *fate == Fate::Unseen),
        missed: count(|fate| matches!(fate, Fate::Missed { .. })),
        seconds: begun.elapsed().as_secs_f64(),
        suspects: suspects.iter().enumerate().map(Told::of).collect(),
    })
}

/// Says why a campaign cannot run.
fn failure(error: CampaignError, entry: &Entry, campaign: &Campaign, notes: &[String]) -> Failure {
    match error {
        CampaignError::Engine(error) => Failure::Run(RunError::from(error)),
        CampaignError::Refused {
            chart: None,
            refused,
            ..
        } => chosen::refused(entry, refused),
        CampaignError::Refused {
            chart: Some(chart),
            circuit,
            refused,
        } => {
            let (line, circuit) = (campaign.charts[chart].line, format!("chart of {circuit}"));
            let problem = refused.to_string();
            Failure::Input(Fault::new(&notes[chart], line, circuit, problem, CHARTS))
        }
        CampaignError::Chart { chart, failure } => {
            Failure::Check(format!("{}: {failure}", notes[chart]))
        }
        error => Failure::Check(error.to_string()),
    }
}

impl Told {
    fn of((index, suspect): (usize, &Suspect)) -> Told {
        let (fate, by) = match &suspect.fate {
            Fate::Found(Found::Chart(title)) => ("chart", title.clone()),
            Fate::Found(Found::Proof) => ("proof", String::new()),
            Fate::Found(Found::Law) => ("law", String::new()),
            Fate::Found(Found::Around(circuit, title)) => ("around", format!("{circuit}: {title}")),
            Fate::Unseen => ("unseen", String::new()),
            Fate::Refused => ("refused", String::new()),
            Fate::Missed {
                made: (base, pairs),
                run,
                tick,
                port,
            } => {
                let made: Vec<_> = pairs.iter().map(Pair::to_string).collect();
                let made = made.join(", ");
                let by = format!("{base}[{made}], random run {run}, tick {tick}: {port}");
                ("missed", by)
            }
        };
        Told {
            number: index + 1,
            fault: suspect.mutation.to_string(),
            fate,
            by,
        }
    }
}

impl Report {
    fn of(circuits: Vec<Row>) -> Self {
        let sum = |of: fn(&Row) -> usize| circuits.iter().map(of).sum::<usize>();
        let missed = sum(|row| row.missed);
        let found = sum(|row| row.chart + row.proof + row.around);
        Report {
            found_percent: percent(found, found + missed),
            circuits,
        }
    }

    fn text(&self, unseen: bool) -> String {
        let mut text = String::new();
        // Writing to a string does not fail.
        let _ = writeln!(
            text,
            "{:<24} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>8} {:>9}",
            "circuit", "faults", "chart", "proof", "around", "unseen", "missed", "found", "time"
        );
        for row in &self.circuits {
            let found = row.chart + row.proof + row.around;
            let _ = writeln!(
                text,
                "{:<24} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6.1} % {:>7.2} s",
                row.circuit,
                row.faults,
                row.chart,
                row.proof,
                row.around,
                row.unseen,
                row.missed,
                percent(found, found + row.missed),
                row.seconds
            );
        }
        let faults: usize = self.circuits.iter().map(|row| row.faults).sum();
        let missed: usize = self.circuits.iter().map(|row| row.missed).sum();
        let hidden: usize = self.circuits.iter().map(|row| row.unseen).sum();
        let _ = writeln!(
            text,
            "{faults} faults, {hidden} of them not seen at a port out; of the others {:.2} % found, {missed} missed",
            self.found_percent
        );
        for row in &self.circuits {
            let shown = row
                .suspects
                .iter()
                .filter(|told| told.fate == "missed" || (unseen && told.fate == "unseen"));
            for told in shown {
                let _ = writeln!(text, "{}: {}: {}", row.circuit, told.fault, told.fate);
                if !told.by.is_empty() {
                    let _ = writeln!(text, "  shows at {}", told.by);
                }
            }
        }
        text
    }
}

fn percent(part: usize, whole: usize) -> f64 {
    match whole {
        0 => 100.0,
        _ => 100.0 * part as f64 / whole as f64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_notes_there_is_no_campaign() {
        let error = shipped(&[]).expect_err("no charts").to_string();
        assert!(
            error.contains("--charts") && error.contains(CHARTS),
            "{error}"
        );
        let charts = shipped(NOTES).unwrap_or_else(|error| panic!("{error}"));
        assert!(charts.len() > 300);
    }
}
