//! Every timing chart of every note runs on the circuit it names.

use super::links::prose;
use super::{Note, expect_none, notes};
use motion_rtl::registry::{Base, CATALOGUE, find};
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
    let circuit = match entry.made(Base::Small, &chart.pairs) {
        Ok(circuit) => circuit,
        Err(refused) => return Some(format!("{place}: {}: {refused}", entry.name)),
    };
    let failure = circuit.chart(chart).err()?;
    Some(format!("{place}: {}: {failure}", entry.name))
}

/// True if a table of signals stands on the page, not in an example on it.
fn has_signals(note: &Note) -> bool {
    let begin = "<!-- begin generated: signals";
    prose(&note.text).any(|(_, line)| line.starts_with(begin))
}

#[test]
fn every_chart_runs() {
    let mut wrong = Vec::new();
    for note in notes() {
        match charts(&note) {
            Ok(charts) if charts.is_empty() && has_signals(&note) => {
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

/// The page that explains a circuit holds the table of its signals and a chart of it.
#[test]
fn every_circuit_has_a_page_with_its_signals_and_a_chart() {
    let notes = notes();
    let mut wrong = Vec::new();
    for entry in CATALOGUE {
        let marker = format!("<!-- begin generated: signals {} -->", entry.name);
        let explained = notes.iter().any(|note| {
            let own = |charts: Vec<Chart>| charts.iter().any(|c| c.circuit == entry.name);
            note.text.contains(&marker) && charts(note).is_ok_and(own)
        });
        if !explained {
            wrong.push(format!(
                "{}: no page has both `{marker}` and a chart of it",
                entry.name
            ));
        }
    }
    expect_none(&wrong);
}
