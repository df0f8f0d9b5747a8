//! The same invariants along simulated runs.

use crate::circuits::*;
use motion_rtl::check::{Invariants, Monitor, Random, require};
use motion_rtl::kernel::{Registers, RunError, Sample, Simulator};

fn on(_: u64, _: &Registers<'_, Up>) -> Enable<motion_rtl::logic::Sim> {
    Enable {
        enable: true.into(),
    }
}

#[test]
fn a_violation_ends_the_run_and_names_everything() {
    let circuit = Up { n: 9 };
    let low = Invariants::new().always("at most 4", |now: &Sample<Up>| {
        require(now.q.count.get() <= 4, ["count"], || "it is 5".into())
    });
    let run = |ticks| {
        Simulator::new(&circuit)
            .unwrap()
            .run(ticks, on, Monitor::new(&low))
    };
    assert_eq!(run(5).unwrap().tick(), 5);
    let error = run(6).unwrap_err();
    assert_eq!(
        error.to_string(),
        "tick 5: at most 4: it is 5 (signals: count)"
    );
    assert!(matches!(error, RunError::Violation { tick: 5, .. }));
}

#[test]
fn a_step_property_is_watched_too() {
    let circuit = Up { n: 9 };
    let invariants = Invariants::new()
        .always("fine", |_: &Sample<Up>| Ok(()))
        .step("never back", |now: &Sample<Up>, next| {
            let back = next.count < now.q.count;
            require(!back, ["count"], || "back".into())
        });
    let run = |ticks| {
        Simulator::new(&circuit)
            .unwrap()
            .run(ticks, on, Monitor::new(&invariants))
    };
    assert!(run(8).is_ok());
    assert!(matches!(run(9), Err(RunError::Violation { tick: 8, .. })));
}

#[test]
fn random_stimulus_finds_it_in_the_end() {
    let circuit = Lock { code: [2, 2, 1] };
    let shut = Invariants::new().always("shut", |now: &Sample<Lock>| {
        require(now.q.right.get() < 3, ["right"], || "open".into())
    });
    let run = |seed| {
        let mut random = Random::new(seed);
        let stimulus = move |_: u64, _: &motion_rtl::kernel::Part<'_, _>| random.signals();
        let end = Simulator::new(&circuit)
            .unwrap()
            .run(10_000, stimulus, Monitor::new(&shut));
        match end {
            Err(RunError::Violation { tick, .. }) => tick,
            other => panic!("{other:?}"),
        }
    };
    assert!(run(1) >= 3);
    assert_eq!(run(1), run(1));
    assert!((2..9).any(|seed| run(seed) != run(1)));
}
