//! Properties of the catalogue at the widths of its full circuits, and of faults put into them.

use super::{CATALOGUE, Entry, ProofSearch, Verdict};
use crate::check::{Concluded, Conclusion, Violation, conclude};
use crate::circuits::pulse_interpolator::{PulseGenerator, Variant};
use crate::hdl::mutation::{mutated, mutations};
use crate::sim::Elaborated;
use rayon::prelude::*;
use std::time::{Duration, Instant};

/// Time for a property.
const LIMIT: Duration = Duration::from_secs(10);
/// Time for a property that is hard.
const LONG: Duration = Duration::from_secs(60);
/// Time for a property of a circuit with a fault: what is left open may take all of it.
const SHORT: Duration = Duration::from_millis(300);

/// Returns the circuits of the catalogue that state properties.
fn circuits() -> impl Iterator<Item = &'static Entry> {
    CATALOGUE.iter().filter(|entry| {
        let model = entry.small().model().expect("it can be elaborated");
        model.stated().iter().any(|it| it.claim.is_proved())
    })
}

/// Circuits that have properties which are not proved, or not in a second: with divisions, products
/// of two words, or many words of memory.
const HARD: &[&str] = &[
    "unit_law",
    "pulse_interpolator",
    "line_law",
    "tracking_loop",
    "target_data",
    "difference_history",
    "vector_correction",
    "shifter",
];

/// Circuits whose faults are looked for in every run of the tests.
const FEW: &[&str] = &[
    "pulse_generator",
    "sync_stage",
    "command_port",
    "enable_counter",
    "sequencer",
];

/// Returns those that a visit of all states proves.
fn visitable() -> Vec<&'static Entry> {
    circuits().filter(|entry| entry.proved).collect()
}

fn few() -> Vec<&'static Entry> {
    let mut all = visitable();
    all.retain(|entry| FEW.contains(&entry.name));
    all
}

fn concluded(model: &Elaborated, limit: Duration) -> Vec<Concluded<Violation>> {
    conclude(model, limit).expect("it has properties")
}

fn is_refuted(concluded: &Concluded<Violation>) -> bool {
    matches!(concluded.conclusion, Conclusion::Refuted(_))
}

/// Returns the number of proved properties of a circuit, and the others.
fn prove(entry: &Entry, limit: Duration) -> (usize, Vec<String>) {
    let start = Instant::now();
    let model = entry.full().model().expect("it can be elaborated");
    let (mut proved, mut others) = (0, Vec::new());
    for concluded in concluded(&model, limit) {
        let (time, property) = (concluded.time.as_secs_f64(), &concluded.property);
        assert!(!is_refuted(&concluded), "{}: {concluded:?}", entry.name);
        match &concluded.conclusion {
            Conclusion::Proof { by, with } => {
                println!("{time:>8.4} s  {property}: {by} {with:?}");
                proved += 1;
            }
            _ => others.push(format!("{}: {property}", entry.name)),
        }
    }
    println!("{}: {:.3} s", entry.name, start.elapsed().as_secs_f64());
    (proved, others)
}

#[test]
fn properties_are_proved_at_full_width() {
    let easy: Vec<_> = circuits().filter(|it| !HARD.contains(&it.name)).collect();
    let all = easy.into_par_iter().map(|entry| prove(entry, LIMIT));
    let all: Vec<_> = all.collect();
    let open: Vec<_> = all.iter().flat_map(|(_, open)| open).collect();
    assert!(open.is_empty(), "{open:#?}");
    let proved: usize = all.iter().map(|(proved, _)| proved).sum();
    assert!(proved >= 170, "{proved}");
}

#[test]
#[ignore = "takes long"]
fn all_properties_but_few_are_proved_at_full_width() {
    let all: Vec<_> = circuits().collect();
    let all = all.into_par_iter().map(|entry| prove(entry, LONG));
    let all: Vec<_> = all.collect();
    let open: Vec<_> = all.iter().flat_map(|(_, open)| open).collect();
    println!("{open:#?}");
    assert!(open.len() <= 12, "{open:#?}");
}

#[test]
fn the_literal_pulse_generator_is_refuted_at_full_width() {
    let literal = PulseGenerator {
        width: 16,
        variant: Variant::Literal,
    };
    let model = Elaborated::new(&literal).expect("it can be elaborated");
    let all = concluded(&model, SHORT);
    let refuted: Vec<_> = all.iter().filter(|it| is_refuted(it)).collect();
    assert!(refuted.len() >= 2, "{all:?}");
    let Conclusion::Refuted(violation) = &refuted[0].conclusion else {
        unreachable!("it is one of those");
    };
    assert!(violation.to_string().contains("* unit_rst"), "{violation}");
    // One is violated only after 65,535 ticks.
    assert!(
        all.iter()
            .all(|it| !it.property.contains("greatest") || !it.conclusion.is_proved())
    );
}

/// Result of the proof by a visit of all states, of which there may be too many.
fn visited(entry: &Entry, model: Elaborated) -> Verdict {
    let search = ProofSearch {
        transitions: 200_000,
        model: Some(model),
        ..ProofSearch::default()
    };
    let circuit = entry.proof(&[]).expect("it has a proof");
    circuit.prove(&search, &mut |_| {}).expect("it is narrow")
}

/// Compares the results for a netlist of the small circuit with a visit of all its states. Returns
/// true if both find a violation.
fn agree(entry: &Entry, model: &Elaborated, what: &str) -> bool {
    let all = concluded(model, LIMIT);
    let what = format!("{}, {what}: {all:?}", entry.name);
    match visited(entry, model.clone()) {
        Verdict::Proved(_) => {
            let proved = all.iter().all(|it| it.conclusion.is_proved());
            assert!(proved, "{what}, but a visit of all states proves it");
            false
        }
        Verdict::Broken { report, .. } => {
            let refuted = all.iter().filter(|it| is_refuted(it));
            let named = refuted.clone().any(|it| report.contains(&it.property));
            assert!(named, "{what}, but {report}");
            true
        }
        Verdict::Undecided(_) => false,
    }
}

/// Puts faults into a circuit, `few` of them, evenly over all.
fn faulty(entry: &Entry, few: usize) -> Vec<(String, crate::hdl::Mutation)> {
    let small = entry.small();
    let all = mutations(small.name(), || small.model()).1;
    let step = all.len().div_ceil(few).max(1);
    let chosen = all.into_iter().step_by(step);
    chosen
        .map(|mutation| (mutation.to_string(), mutation))
        .collect()
}

/// Compares the results at small widths with a visit of all states, with faults and without.
fn compare(entries: &[&Entry]) {
    entries.par_iter().for_each(|entry| {
        let small = entry.small().model().expect("it can be elaborated");
        assert!(!agree(entry, &small, "without a fault"));
        let mut found = 0;
        for (name, mutation) in faulty(entry, 10) {
            let Some(Ok(model)) = mutated(&mutation, || entry.small().model()) else {
                continue;
            };
            found += usize::from(agree(entry, &model, &name));
        }
        println!("{}: {found} faults found", entry.name);
    });
}

#[test]
fn results_at_small_widths_are_those_of_a_visit_of_all_states() {
    compare(&few());
}

/// Puts faults into circuits at full width, until three are found in each. A fault that a visit of
/// all states finds at small widths leaves some property without a proof.
fn find(entries: &[&Entry]) {
    entries.par_iter().for_each(|entry| {
        let mut found = 0;
        for (name, mutation) in faulty(entry, 16) {
            let of = |base: &dyn Fn() -> Result<Elaborated, crate::engine::EngineError>| {
                mutated(&mutation, base)?.ok()
            };
            let (Some(small), Some(full)) =
                (of(&|| entry.small().model()), of(&|| entry.full().model()))
            else {
                continue;
            };
            let verdict = visited(entry, small);
            if found == 3 || matches!(verdict, Verdict::Proved(_)) {
                continue;
            }
            let all = concluded(&full, SHORT);
            let proved = all.iter().all(|it| it.conclusion.is_proved());
            let broken = matches!(verdict, Verdict::Broken { .. });
            let name = format!("{}, {name}", entry.name);
            assert!(!broken || !proved, "{name}: proved in spite of it");
            found += usize::from(all.iter().any(is_refuted));
        }
        assert_eq!(found, 3, "{}: faults found", entry.name);
    });
}

#[test]
fn faults_are_found_at_full_width() {
    find(&few());
}
