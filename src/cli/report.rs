//! End of every run: the fields that all summaries share, and their output.

use super::files::{Files, Named, parent, refuse_file};
use super::setup::Setup;
use super::viewer::Viewer;
use super::written::Written;
use super::{Failure, json, page, print, progress, warn};
use motion_rtl::files::write;
use serde::Serialize;
use std::fmt::{self, Write as _};
use std::ops::Range;
use std::path::Path;

/// Fields that all summaries share.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Outcome {
    /// The circuit that ran.
    pub circuit: &'static str,
    /// The input file, or the scenario's name.
    pub input: String,
    /// Reference clock in Hz.
    pub clock_hz: u64,
    /// Ticks of the run; of several runs, those of the run in the waves.
    pub ticks: u64,
    /// Duration of the run in seconds.
    pub seconds: f64,
    /// Faults of the run; empty if it succeeded.
    pub complaints: Vec<String>,
    /// Warnings: anything skipped, assumed or rounded, and other remarks.
    pub warnings: Vec<String>,
    /// Ticks in the waves, half-open; `null` without waves.
    pub vcd_window: Option<[u64; 2]>,
    /// Written files.
    pub files: Vec<Named>,
}

impl Outcome {
    /// Creates the outcome of a run without complaints, before its files are written.
    pub fn new(circuit: &'static str, input: &str, clock_hz: u64, ticks: u64) -> Self {
        Outcome {
            circuit,
            input: input.to_owned(),
            clock_hz,
            ticks,
            seconds: ticks as f64 / clock_hz as f64,
            complaints: Vec::new(),
            warnings: Vec::new(),
            vcd_window: None,
            files: Vec::new(),
        }
    }

    /// Returns input and circuit, the beginning of every summary's text.
    pub fn subject(&self) -> String {
        format!("{} on {}", self.input, self.circuit)
    }

    /// Returns the length of the run as text.
    pub fn length(&self) -> String {
        format!(
            "{} ticks, {:.3} s at {} Hz",
            self.ticks, self.seconds, self.clock_hz
        )
    }

    /// Writes the end of every summary's text: the window of the waves and the files.
    fn tail(&self, text: &mut String) -> fmt::Result {
        if let Some([from, to]) = self.vcd_window
            && (from > 0 || to < self.ticks)
        {
            writeln!(
                text,
                "the waves show ticks {from} to {to} of {}: --from and --to choose others",
                self.ticks
            )?;
        }
        for file in &self.files {
            writeln!(text, "wrote {file}")?;
        }
        Ok(())
    }
}

/// The summary of a run.
pub trait Report: Serialize {
    /// Returns the shared fields.
    fn outcome(&mut self) -> &mut Outcome;
    /// Writes the summary as text, with every part of the run if `all` is set.
    fn write(&self, text: &mut String, all: bool) -> fmt::Result;
}

/// Ends a run: names its files, prints its summary, fails where it complains.
pub fn conclude(
    setup: &Setup<'_>,
    mut files: Files,
    mut summary: impl Report,
) -> Result<(), Failure> {
    let Setup {
        arguments, options, ..
    } = setup;
    let viewer = arguments.open.then(Viewer::find).transpose()?;
    let Range { start, end } = options.ticks;
    let outcome = summary.outcome();
    let window = [start, end.min(outcome.ticks).max(start)];
    outcome.vcd_window = (!arguments.no_vcd).then_some(window);
    progress::end();
    outcome.warnings.extend(files.take_notes());
    outcome.files = files.commit()?;
    // In a browser, the page shows the run that it has asked for.
    if let Some(path) = &arguments.html
        && !cfg!(target_family = "wasm")
    {
        let written = write_page(path, &mut summary)?;
        summary.outcome().files.push(written);
    }
    match arguments.json {
        true => json::print(&summary)?,
        false => {
            let mut text = String::new();
            // Writing to a string does not fail.
            let _ = summary.write(&mut text, arguments.segments);
            let outcome = summary.outcome();
            let _ = outcome.tail(&mut text);
            for warning in &outcome.warnings {
                warn(warning);
            }
            print(&text)?;
        }
    }
    let outcome = summary.outcome();
    if let Some(viewer) = viewer {
        viewer.open(&outcome.files);
    }
    match &outcome.complaints[..] {
        [] => Ok(()),
        complaints => Err(Failure::Check(complaints.join("\n"))),
    }
}

/// Writes the page of a run, from its summary and its files.
fn write_page(path: &Path, summary: &mut impl Report) -> Result<Named, Failure> {
    let text = json::text(summary)?;
    let outcome = summary.outcome();
    let files = outcome.files.iter().map(|file| Path::new(&file.path));
    let page = page::of_run(text, !outcome.complaints.is_empty(), files)?;
    let list = Written::read(parent(path));
    let written = write(path, page).map_err(|error| refuse_file("--html", &error))?;
    list.add([written.as_path()].into_iter());
    Ok(Named::new(&written))
}

/// Returns the first complaint of one kind and the count of the others.
pub fn first(all: impl Iterator<Item = String>) -> Option<String> {
    let mut first = First::default();
    all.for_each(|text| first.add(|| text));
    first.text()
}

/// Collector of complaints of one kind: keeps the first and counts the others.
#[derive(Debug, Default)]
pub struct First {
    text: Option<String>,
    more: usize,
}

impl First {
    pub fn add(&mut self, text: impl FnOnce() -> String) {
        match self.text {
            None => self.text = Some(text()),
            Some(_) => self.more += 1,
        }
    }

    /// The first, and how many more there are.
    pub fn text(self) -> Option<String> {
        let text = self.text?;
        Some(match self.more {
            0 => text,
            more => format!("{text} (and {more} more like it)"),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::first;

    #[test]
    fn the_first_of_many_stands_for_all() {
        let all = |count: usize| first((0..count).map(|k| format!("{k} ends")));
        assert_eq!(all(0), None);
        assert_eq!(all(1).unwrap(), "0 ends");
        assert_eq!(all(2).unwrap(), "0 ends (and 1 more like it)");
        assert_eq!(all(4).unwrap(), "0 ends (and 3 more like it)");
    }
}
