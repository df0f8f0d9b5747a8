//! Invariants along simulated runs.

use crate::circuits::*;
use motion_rtl::check::{Invariants, Monitor, Random, require};
use motion_rtl::hdl::Value;
use motion_rtl::sim::{RunError, Sample, Simulator, State};

fn on(_: u64, _: &State<'_, Up>) -> Enable<Value> {
    Enable { enable: true }
}

/// Runs a counter so many ticks; how many it has gone.
fn run(ticks: u64, invariants: &Invariants<'_, Up>) -> Result<u64, RunError> {
    let mut simulator = Simulator::new(&Up { n: 9 })?;
    simulator.run(ticks, on, Monitor::new(invariants))?;
    Ok(simulator.tick())
}

#[test]
fn a_violation_ends_the_run_and_names_everything() {
    let low = Invariants::new().always("at most 4", |now: &Sample<'_, Up>| {
        require(now.q.count <= 4, ["count"], || "it is 5".into())
    });
    assert_eq!(run(5, &low).unwrap(), 5);
    let error = run(6, &low).unwrap_err();
    assert_eq!(
        error.to_string(),
        "tick 5: at most 4: it is 5 (signals: count)"
    );
    assert!(matches!(error, RunError::Violation { tick: 5, .. }));
}

#[test]
fn a_step_property_is_watched_too() {
    let invariants = Invariants::new()
        .always("fine", |_: &Sample<'_, Up>| Ok(()))
        .step("never back", |now, next| {
            let back = next.q.count < now.q.count;
            require(!back, ["count"], || "back".into())
        });
    assert!(run(8, &invariants).is_ok());
    let end = run(9, &invariants);
    assert!(matches!(end, Err(RunError::Violation { tick: 8, .. })));
}

#[test]
fn random_stimulus_finds_it_in_the_end() {
    let circuit = Lock { code: [2, 2, 1] };
    let shut = Invariants::new().always("shut", |now: &Sample<'_, Lock>| {
        require(now.q.right < 3, ["right"], || "open".into())
    });
    let run = |seed| {
        let mut random = Random::new(seed);
        let stimulus = |_: u64, _: &State<'_, Lock>| random.inputs(&circuit);
        let mut simulator = Simulator::new(&circuit).unwrap();
        match simulator.run(10_000, stimulus, Monitor::new(&shut)) {
            Err(RunError::Violation { tick, .. }) => tick,
            other => panic!("{other:?}"),
        }
    };
    assert!(run(1) >= 3);
    assert_eq!(run(1), run(1));
    assert!((2..9).any(|seed| run(seed) != run(1)));
}
