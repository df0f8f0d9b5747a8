//! Every timing chart of every note runs on the circuit it names.

use super::{Note, expect_none, notes};
use motion_rtl::registry::{CATALOGUE, find};
use motion_rtl::trace::chart::{Chart, parse};
use std::collections::HashSet;

/// The charts of a note.
fn charts(note: &Note) -> Result<Vec<Chart>, String> {
    parse(&note.text).map_err(|error| format!("{}:{}: {}", note.name, error.line, error.problem))
}

/// What is wrong with a chart, if anything.
fn fault(note: &Note, chart: &Chart) -> Option<String> {
    let place = format!("{}:{}", note.name, chart.line);
    let Some(entry) = find(&chart.circuit) else {
        let names: Vec<_> = CATALOGUE.iter().map(|entry| entry.name).collect();
        let known = names.join(", ");
        return Some(format!(
            "{place}: no circuit {}; known: {known}",
            chart.circuit
        ));
    };
    let Some(circuit) = entry.model(&chart.args) else {
        return Some(format!(
            "{place}: no {} with {:?}; it is made with: {}",
            entry.name, chart.args, entry.arguments
        ));
    };
    let failure = circuit.chart(chart).err()?;
    Some(format!("{place}: {}: {failure}", entry.name))
}

#[test]
fn every_chart_runs() {
    let mut wrong = Vec::new();
    for note in notes() {
        match charts(&note) {
            Ok(charts) if charts.is_empty() && note.text.contains("generated: signals") => {
                wrong.push(format!("{}: has no chart", note.name))
            }
            Ok(charts) => wrong.extend(charts.iter().filter_map(|chart| fault(&note, chart))),
            Err(error) => wrong.push(error),
        }
    }
    expect_none(&wrong);
}

#[test]
fn every_chart_says_what_it_shows() {
    let mut wrong = Vec::new();
    for note in notes() {
        let mut titles = HashSet::new();
        for chart in charts(&note).expect("the charts can be read") {
            if chart.title.is_empty() || !titles.insert(chart.title.clone()) {
                wrong.push(format!("{}:{}: a title of its own", note.name, chart.line));
            }
        }
    }
    expect_none(&wrong);
}

/// The section of a note that explains a circuit holds the table of its signals and a chart of it.
#[test]
fn every_circuit_has_a_section_with_its_signals_and_a_chart() {
    let mut wrong = Vec::new();
    for entry in CATALOGUE {
        let marker = format!("<!-- begin generated: signals {} -->", entry.name);
        let explained = notes().iter().any(|note| {
            let sections = note.text.split("\n## ");
            let mut own = sections.filter(|section| section.contains(&marker));
            own.any(|section| {
                parse(section).is_ok_and(|charts| charts.iter().any(|c| c.circuit == entry.name))
            })
        });
        if !explained {
            wrong.push(format!(
                "{}: no section of a note has both `{marker}` and a chart of it",
                entry.name
            ));
        }
    }
    expect_none(&wrong);
}
