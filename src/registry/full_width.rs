//! Properties of the catalogue at the widths of its full circuits, and of faults put into them.

use super::{CATALOGUE, Entry, ProofSearch, Verdict};
use crate::check::{Concluded, Conclusion, Violation, conclude};
use crate::circuits::pulse_interpolator::{PulseGenerator, Variant};
use crate::engine::Statement;
use crate::hdl::mutation::{mutated, mutations};
use crate::netlist::Claim;
use crate::sim::Elaborated;
use rayon::prelude::*;
use std::time::{Duration, Instant};

/// Time for a property: far more than a proof takes, as the machine may be busy.
const LIMIT: Duration = Duration::from_secs(60);
/// Time for a property that may stay open.
const ENOUGH: Duration = Duration::from_secs(10);
/// Time for a property of a circuit with a fault: what is left open may take all of it.
const SHORT: Duration = Duration::from_millis(300);

/// Returns the circuits of the catalogue with statements that `is` holds of.
fn with(is: fn(&Statement) -> bool) -> impl Iterator<Item = &'static Entry> {
    CATALOGUE.iter().filter(move |entry| {
        let model = entry.small().model().expect("it can be elaborated");
        let (_, stated) = model.with_parts().expect("it can be flattened");
        stated.iter().any(is)
    })
}

/// Returns the circuits that state properties.
fn circuits() -> impl Iterator<Item = &'static Entry> {
    with(|it| it.path.is_empty() && it.claim.is_proved())
}

/// Returns the circuits that contain a part with an assumption.
fn containers() -> impl Iterator<Item = &'static Entry> {
    with(|it| !it.path.is_empty() && it.claim == Claim::Given)
}

/// Circuits that have properties which are not proved: these compare two different products.
const HARD: &[&str] = &["line_law"];

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

/// Returns the results of what is proved, without what is assumed.
fn concluded(model: &Elaborated, limit: Duration) -> Vec<Concluded<Violation>> {
    let mut all = conclude(model, limit).expect("it has properties");
    all.retain(|it| !matches!(it.conclusion, Conclusion::Assumed));
    all
}

fn is_refuted(concluded: &Concluded<Violation>) -> bool {
    matches!(concluded.conclusion, Conclusion::Refuted(_))
}

/// Property without a proof.
#[derive(Debug, Clone, PartialEq)]
struct Unproved {
    circuit: &'static str,
    /// Path of the part that relies on it.
    part: Option<String>,
    property: String,
}

impl Unproved {
    fn new(circuit: &'static str, concluded: &Concluded<Violation>) -> Self {
        Unproved {
            circuit,
            part: concluded.part.clone(),
            property: concluded.property.clone(),
        }
    }

    fn is_listed(&self) -> bool {
        let Some(part) = &self.part else {
            return NOT_PROVED.contains(&(self.circuit, &self.property));
        };
        let path = format!("{}.{part}", self.circuit);
        let mut listed = NOT_KEPT.iter();
        listed.any(|(end, property, _)| path.ends_with(end) && self.property == *property)
    }
}

/// Returns the number of proved properties of a circuit, and the others.
fn prove(entry: &Entry) -> (usize, Vec<Unproved>) {
    let start = Instant::now();
    let model = entry.full().model().expect("it can be elaborated");
    let (mut proved, mut others) = (0, Vec::new());
    let limit = match HARD.contains(&entry.name) {
        true => ENOUGH,
        false => LIMIT,
    };
    for concluded in concluded(&model, limit) {
        let (time, property) = (concluded.time.as_secs_f64(), &concluded.property);
        assert!(!is_refuted(&concluded), "{}: {concluded:?}", entry.name);
        match &concluded.conclusion {
            Conclusion::Proof { by, with } => {
                println!("{time:>8.4} s  {property}: {by} {with:?}");
                proved += 1;
            }
            _ => others.push(Unproved::new(entry.name, &concluded)),
        }
    }
    println!("{}: {:.3} s", entry.name, start.elapsed().as_secs_f64());
    (proved, others)
}

#[test]
fn properties_are_proved_at_full_width() {
    let mut easy: Vec<_> = circuits().collect();
    easy.retain(|it| !HARD.contains(&it.name) && !LARGE.contains(&it.name));
    let all = easy.into_par_iter().map(prove);
    let all: Vec<_> = all.collect();
    let open: Vec<_> = all.iter().flat_map(|(_, open)| open).collect();
    assert!(open.is_empty(), "{open:#?}");
    let proved: usize = all.iter().map(|(proved, _)| proved).sum();
    assert!(proved >= 200, "{proved}");
}

#[test]
#[ignore = "takes long"]
fn all_properties_but_few_are_proved_at_full_width() {
    let mut all: Vec<_> = circuits().collect();
    all.retain(|it| HARD.contains(&it.name) || LARGE.contains(&it.name));
    let all: Vec<_> = all.into_par_iter().map(prove).collect();
    let open: Vec<_> = all.iter().flat_map(|(_, open)| open).collect();
    println!("{open:#?}");
    let mut others = open.iter().filter(|it| !it.is_listed());
    assert_eq!(others.next(), None);
}

/// Properties that are not proved at full width: they compare two different products.
const NOT_PROVED: &[(&str, &str)] = &[
    ("line_law", "after every scan, Δx·I + B equals Δy·Σδx + B0"),
    (
        "line_law",
        "at the end of the line, I equals Δy and B equals B0",
    ),
    (
        "line_law",
        "a slave with no more distance than its master never moves farther in a scan",
    ),
    ("line_law", "the slave stays within one step of the line"),
];

/// Assumptions of parts that are not proved of all circuits around them: the end of the part's path,
/// the assumption, and the reason.
const NOT_KEPT: &[(&str, &str, &str)] = &[(
    ".tracking",
    "the magnitudes of quadrature and in_phase add up to less than 2^(angle + 1)",
    "the rotation keeps the length of a vector but for its gain: a sum of two squares",
)];

/// Proves the assumptions of the parts of circuits; returns the number of those that are proved.
fn keep(entries: &[&Entry]) -> usize {
    let of = |entry: &&Entry| {
        let start = Instant::now();
        let model = entry.full().model().expect("it can be elaborated");
        let mut all = concluded(&model, LIMIT);
        all.retain(|it| it.part.is_some());
        println!("{}: {:.3} s", entry.name, start.elapsed().as_secs_f64());
        all.into_iter()
            .map(|it| (entry.name, it))
            .collect::<Vec<_>>()
    };
    let all: Vec<_> = entries.par_iter().flat_map(of).collect();
    let open = all.iter().filter(|(_, it)| !it.conclusion.is_proved());
    let open = open.map(|(circuit, it)| Unproved::new(circuit, it));
    let open: Vec<_> = open.filter(|it| !it.is_listed()).collect();
    assert!(open.is_empty(), "{open:#?}");
    assert!(all.iter().all(|(_, it)| !is_refuted(it)), "{all:#?}");
    all.len()
}

/// Circuits whose parts take long.
const LARGE: &[&str] = &[
    "machine",
    "trajectory_controller",
    "arc_generator",
    "line_law",
    "resolver_detector",
    "tracking_converter",
];

/// Those with properties of their own are proved above.
#[test]
#[ignore = "takes long"]
fn circuits_keep_what_their_parts_assume() {
    let all: Vec<_> = containers()
        .filter(|it| !LARGE.contains(&it.name))
        .collect();
    let kept = keep(&all);
    assert!(kept >= 80, "{kept}");
}

#[test]
#[ignore = "takes long"]
fn large_circuits_keep_what_their_parts_assume() {
    let all: Vec<_> = containers().filter(|it| LARGE.contains(&it.name)).collect();
    keep(&all);
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
    let all = concluded(model, ENOUGH);
    let what = format!("{}, {what}: {all:?}", entry.name);
    match visited(entry, model.clone()) {
        Verdict::Proved(_) => {
            let proved = all.iter().all(|it| it.conclusion.is_proved());
            assert!(proved, "{what}, but a visit of all states proves it");
            false
        }
        Verdict::Broken(violation) => {
            let report = violation.to_string();
            let refuted = all.iter().filter(|it| is_refuted(it));
            let named = refuted.clone().any(|it| report.contains(&it.property));
            assert!(named, "{what}, but {report}");
            true
        }
        Verdict::Undecided(_) => false,
    }
}

/// Returns the assumptions of a circuit, with their numbers among its statements.
fn givens(model: &Elaborated) -> Vec<(usize, &'static str)> {
    let module = model.design().modules.last().expect("there is one");
    let all = module.assertions.iter().enumerate();
    let givens = all.filter(|(_, it)| it.claim == Claim::Given);
    givens.map(|(index, it)| (index, it.name)).collect()
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
        for (index, name) in givens(&small) {
            let free = small.without(index).expect("it can be elaborated");
            let violated = agree(entry, &free, &format!("without the assumption that {name}"));
            println!("{}: {name}: needed: {violated}", entry.name);
        }
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

#[test]
#[ignore = "takes long"]
fn results_of_all_circuits_are_those_of_a_visit_of_all_states() {
    compare(&visitable());
}

/// Puts faults into circuits at full width, until three are found in each. A fault that a visit of
/// all states finds at small widths leaves some property without a proof.
fn find(entries: &[&Entry], limit: Duration) {
    entries.par_iter().for_each(|entry| {
        let mut found = 0;
        let few = faulty(entry, 16);
        let mut others = faulty(entry, usize::MAX);
        others.retain(|it| !few.contains(it));
        for (name, mutation) in few.into_iter().chain(others) {
            if found == 3 {
                break;
            }
            let of = |base: &dyn Fn() -> Result<Elaborated, crate::engine::EngineError>| {
                mutated(&mutation, base)?.ok()
            };
            let (Some(small), Some(full)) =
                (of(&|| entry.small().model()), of(&|| entry.full().model()))
            else {
                continue;
            };
            let verdict = visited(entry, small);
            if matches!(verdict, Verdict::Proved(_)) {
                continue;
            }
            let all = concluded(&full, limit);
            let proved = all.iter().all(|it| it.conclusion.is_proved());
            let broken = matches!(verdict, Verdict::Broken(_));
            let name = format!("{}, {name}", entry.name);
            assert!(!broken || !proved, "{name}: proved in spite of it");
            found += usize::from(all.iter().any(is_refuted));
        }
        assert_eq!(found, 3, "{}: faults found", entry.name);
    });
}

#[test]
fn faults_are_found_at_full_width() {
    find(&few(), SHORT);
}

/// Circuits whose faults show only after many ticks at full width: they are left open there.
const LATE: &[&str] = &["axis", "mul_div", "pulse_interpolator"];

#[test]
#[ignore = "takes long"]
fn faults_of_all_circuits_but_few_are_found_at_full_width() {
    let mut all = visitable();
    all.retain(|entry| !LATE.contains(&entry.name));
    find(&all, Duration::from_millis(1500));
}
