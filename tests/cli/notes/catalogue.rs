//! What every circuit of the catalogue has to keep to.

use super::expect_none;
use motion_rtl::registry::{AnyModel, CATALOGUE, find};
use std::collections::HashSet;

#[test]
fn every_signal_has_a_name_of_its_own_and_a_meaning() {
    let mut wrong = Vec::new();
    for entry in CATALOGUE {
        let mut paths = HashSet::new();
        for leaf in entry.declarations().leaves {
            let path = leaf.path();
            // The words of a memory have no text of their own.
            let is_word = leaf.name.starts_with("word") || leaf.name.starts_with("stage");
            if leaf.field.doc.trim().is_empty() && !is_word {
                wrong.push(format!("{path}: has no doc comment"));
            }
            if !paths.insert(path.clone()) {
                wrong.push(format!("{path}: is declared twice"));
            }
        }
    }
    expect_none(&wrong);
}

#[test]
fn every_circuit_can_be_made_proved_and_dumped() {
    let mut wrong = Vec::new();
    for entry in CATALOGUE {
        if find(entry.name).map(|found| found.about) != Some(entry.about) {
            wrong.push(format!("{}: the name is taken", entry.name));
        }
        if let Err(error) = entry.full().layout() {
            wrong.push(format!("{}: {error}", entry.name));
        }
        if let Err(error) = entry.small().layout() {
            wrong.push(format!("{}, small: {error}", entry.name));
        }
        let Ok(circuit) = entry.proof(&[]) else {
            continue;
        };
        let model: &dyn AnyModel = &*circuit;
        if let Err(error) = model.layout() {
            wrong.push(format!("{}: {error}", entry.name));
        }
        let names = circuit.invariants();
        if names.is_empty() || names.iter().collect::<HashSet<_>>().len() != names.len() {
            wrong.push(format!(
                "{}: needs invariants of different names",
                entry.name
            ));
        }
    }
    expect_none(&wrong);
}
