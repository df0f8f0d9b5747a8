//! Assumptions, limits, progress, what is too wide.

use crate::circuits::*;
use crate::reach::proof;
use motion_rtl::check::{
    CheckError, Invariants, Outcome, Progress, Proof, TooWide, all, reach, require,
};
use motion_rtl::sim::Sample;
use std::collections::HashSet;

#[test]
fn assumptions_are_honoured() {
    let circuit = Up { n: 9 };
    let low = Invariants::new().always("at most 4", |now: &Sample<'_, Up>| {
        require(now.q.count <= 4, ["count"], || "above".into())
    });
    let assumed = reach(&circuit, &low)
        .assume(|q, i| q.q.count < 4 || !i.enable)
        .run()
        .unwrap();
    // Counts 0 to 4, two inputs in each but the last.
    assert_eq!(assumed.proof(), Some(proof(5, 9, 4)));

    // Two assumptions that leave no input at 4, and only one at 0.
    let stuck = reach(&circuit, &low)
        .assume(|q, i| q.q.count < 4 || !i.enable)
        .assume(|q, i| (1..4).contains(&q.q.count) || i.enable)
        .run()
        .unwrap();
    let expected = Proof {
        dead_ends: 1,
        ..proof(5, 7, 4)
    };
    assert_eq!(stuck.proof(), Some(expected));
    assert_eq!(
        stuck.to_string(),
        "proved: 5 states, 7 transitions, depth 4, 1 state without a possible input"
    );

    let free = reach(&circuit, &low).run().unwrap();
    assert_eq!(free.counterexample().unwrap().tick, 5);
}

#[test]
fn assumptions_without_an_input_at_power_on_prove_nothing() {
    let circuit = Up { n: 9 };
    let low = Invariants::new().always("at most 4", |now: &Sample<'_, Up>| {
        require(now.q.count <= 4, ["count"], || "above".into())
    });
    let expected = "modulo: no input keeps all assumptions at power-on";
    let refused = |outcome: Result<Outcome<Up>, CheckError>| {
        let error = outcome.expect_err("there is no input");
        assert!(matches!(error, CheckError::NoInput { .. }), "{error}");
        assert!(error.to_string().starts_with(expected), "{error}");
    };
    let assumed = || reach(&circuit, &low).assume(|q, _| q.q.count > 0);
    refused(assumed().run());
    refused(assumed().run_simulated());
    let none = || reach(&circuit, &low).inputs(|_| false);
    refused(none().run());
    refused(none().run_simulated());
}

#[test]
fn the_inputs_of_a_counterexample_obey_the_assumption() {
    let circuit = Lock { code: [1, 2, 3] };
    let shut = Invariants::new().always("shut", |now: &Sample<'_, Lock>| {
        require(now.q.right < 3, ["right"], || "open".into())
    });
    let outcome = reach(&circuit, &shut)
        .assume(|q, i| q.q.right != 3 || i.digit == 2)
        .run()
        .unwrap();
    let tried = outcome.counterexample().unwrap().inputs;
    let tried: Vec<_> = tried.iter().map(|i| i.digit).collect();
    assert_eq!(tried, [1, 2, 3, 2]);
}

#[test]
fn a_limit_is_no_proof() {
    let circuit = Up { n: 9 };
    let none = Invariants::new();
    for limit in 1..9 {
        let outcome = reach(&circuit, &none).limit(limit).run().unwrap();
        let Outcome::Limit(progress) = &outcome else {
            panic!("{outcome}");
        };
        let limit = u64::from(limit);
        let expected = Progress {
            states: limit,
            frontier: 1,
            transitions: 2 * limit,
            depth: limit - 1,
        };
        assert_eq!(*progress, expected);
        assert_eq!(outcome.proof(), None);
        assert!(
            outcome
                .to_string()
                .starts_with("not decided: the limit was reached")
        );
        assert!(outcome.counterexample().is_none());
    }
    let outcome = reach(&circuit, &none).limit(9).run().unwrap();
    assert_eq!(outcome.proof(), Some(proof(9, 18, 8)));

    // A violation before the limit counts.
    let below = Invariants::new().always("below 3", |now: &Sample<'_, Up>| {
        require(now.q.count < 3, ["count"], || "3".into())
    });
    let outcome = reach(&circuit, &below).limit(4).run().unwrap();
    assert_eq!(outcome.counterexample().unwrap().tick, 3);
}

#[test]
fn progress_is_reported_at_every_depth() {
    let circuit = Up { n: 5 };
    let none = Invariants::new();
    let mut reports = Vec::new();
    let report = |progress: &Progress| reports.push(*progress);
    let outcome = reach(&circuit, &none).progress(report).run().unwrap();
    assert!(outcome.proof().is_some(), "{outcome}");
    let expected: Vec<_> = (0..5)
        .map(|depth| Progress {
            states: depth + 1,
            frontier: 1,
            transitions: 2 * depth,
            depth,
        })
        .collect();
    assert_eq!(reports, expected);

    // One edge leads to any first word, nothing is shifted by a zero; of the words that two edges
    // make none, one or both were shifted.
    let mut reports = Vec::new();
    let report = |progress: &Progress| reports.push((progress.depth, progress.frontier));
    let (circuit, none) = (wide(3, 2), Invariants::new());
    let search = reach(&circuit, &none).progress(report).limit(100);
    assert!(matches!(search.run(), Ok(Outcome::Limit(_))));
    assert_eq!(reports, [(0, 1), (1, 8), (2, 1 + 7 + 7 * 7)]);
}

const fn wide(width: usize, stages: usize) -> Wide {
    Wide { width, stages }
}

#[test]
fn what_is_too_wide_is_refused() {
    let none = Invariants::new();
    let found = reach(&wide(1, 5), &none).run();
    let what = "the registers";
    let expected = TooWide {
        what,
        bits: 77,
        most: 64,
    };
    assert_eq!(found.unwrap_err(), CheckError::TooWide(expected));
    assert_eq!(
        expected.to_string(),
        "the registers have 77 bits, at most 64 can be enumerated"
    );
    let found = reach(&wide(21, 1), &none).run();
    let what = "the inputs";
    assert_eq!(
        found.unwrap_err(),
        CheckError::TooWide(TooWide {
            what,
            bits: 21,
            most: 20
        })
    );

    // 64 and 20 bits are still possible, with the highest bits in use.
    let found = reach(&wide(20, 4), &none).limit(1 << 14).run();
    assert!(matches!(found, Ok(Outcome::Limit(_))));
    let outcome = reach(&wide(1, 4), &none).assume(|_, i| i.word == 1).run();
    // The input shifts ones in: four stages fill, while the count runs through 2^12.
    assert_eq!(
        outcome.unwrap().proof(),
        Some(proof(4 + 4096, 4 + 4096, 4 + 4095))
    );
}

#[test]
fn every_run_ends_the_same() {
    let run = || {
        let shut = Invariants::new().always("shut", |now: &Sample<'_, Lock>| {
            require(now.q.right < 3, ["right"], || "open".into())
        });
        let found = reach(&Lock { code: [0, 3, 0] }, &shut).bitmap_bits(0).run();
        found.unwrap().to_string()
    };
    let first = run();
    assert!((0..10).all(|_| run() == first));
}

#[test]
fn all_inputs_come_once() {
    let text = |port| format!("{port:?}");
    let ports: HashSet<_> = all(&Store).unwrap().map(text).collect();
    assert_eq!(ports.len(), 32);
    assert!(all(&wide(64, 1)).is_err());
    assert!(all(&wide(63, 1)).is_ok());
}
