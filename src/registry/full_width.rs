//! Properties of the catalogue at the widths of its full circuits, and of faults put into them.

use super::{CATALOGUE, Entry, ProofSearch, Verdict};
use crate::check::{Concluded, Conclusion, Violation, conclude};
use crate::circuits::pulse_interpolator::{PulseGenerator, Variant};
use crate::hdl::mutation::{mutated, mutations};
use crate::sim::Elaborated;
use std::time::{Duration, Instant};

/// Time for a property.
const LIMIT: Duration = Duration::from_secs(10);
/// Time for a property of a circuit with a fault: what is left open may take all of it.
const SHORT: Duration = Duration::from_millis(300);

/// Returns the circuits of the catalogue that state properties.
fn circuits() -> impl Iterator<Item = &'static Entry> {
    CATALOGUE.iter().filter(|entry| {
        let model = entry.small().model().expect("it can be elaborated");
        let module = model.design().modules.last().expect("there is one");
        module.assertions.iter().any(|it| it.claim.is_proved())
    })
}

/// Returns those that a visit of all states proves.
fn visitable() -> impl Iterator<Item = &'static Entry> {
    circuits().filter(|entry| entry.proved)
}

fn concluded(model: &Elaborated, limit: Duration) -> Vec<Concluded<Violation>> {
    conclude(model, limit).expect("it has properties")
}

fn is_refuted(concluded: &Concluded<Violation>) -> bool {
    matches!(concluded.conclusion, Conclusion::Refuted(_))
}

#[test]
fn every_property_of_the_catalogue_is_proved_at_full_width() {
    let mut proved = 0;
    for entry in circuits() {
        let start = Instant::now();
        let model = entry.full().model().expect("it can be elaborated");
        for concluded in concluded(&model, LIMIT) {
            let Conclusion::Proof { by, with } = &concluded.conclusion else {
                panic!("{}: {concluded:?}", entry.name);
            };
            let (time, property) = (concluded.time.as_secs_f64(), &concluded.property);
            println!("{time:>8.4} s  {property}: {by} {with:?}");
            proved += 1;
        }
        println!("{}: {:.3} s", entry.name, start.elapsed().as_secs_f64());
    }
    assert!(proved >= 27, "{proved}");
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

#[test]
fn results_at_small_widths_are_those_of_a_visit_of_all_states() {
    for entry in visitable() {
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
    }
}

#[test]
fn faults_are_found_at_full_width() {
    for entry in visitable() {
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
            assert!(
                !broken || !proved,
                "{}, {name}: proved in spite of it",
                entry.name
            );
            found += usize::from(all.iter().any(is_refuted));
        }
        assert_eq!(found, 3, "{}: faults found", entry.name);
    }
}
