//! Circuits that need each of the ways to a result.

use crate::check::induct::replay;
use crate::check::{Conclusion, InductError, induct};
use crate::hdl::*;
use crate::sim::Elaborated;
use crate::trace::Clock;
use std::time::Duration;

/// Counter that starts again at 40,000, beside two small state machines.
#[derive(Debug, Clone)]
struct Counter {
    stated: fn(&Moment<Counter>) -> Vec<Property>,
}

signals! { for Counter as _c;
    pub struct In { go: Bit, by: U(16) }
    pub struct Reg {
        going: Bit = 0,
        count: U(16) = 0,
        other: U(16) = 0,
        state: U(2) = 0,
        started: Bit = 0,
    }
}

impl Circuit for Counter {
    const NAME: &'static str = "counter";
    const ABOUT: &'static str = "counts to an end";
    records!(In, Reg, Nothing);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Nothing, Reg<Edge>) {
        let last = q.count.equals(40_000);
        let next = last.mux(0, q.count + i.by);
        let count = i.go.mux(next, q.count);
        let turned = q.state.equals(2).mux(0, q.state + 1);
        let next = Reg {
            going: i.go,
            count,
            other: q.other ^ i.by,
            state: i.go.mux(turned, q.state),
            started: i.go | q.started,
        };
        (Nothing, next)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        (self.stated)(now)
    }
}

fn by_is_small(now: &Moment<Counter>) -> Property {
    Property::given("by is 0 or 1", now.i.by.below(2))
}

/// Returns the results of a circuit's properties as text.
fn results(stated: fn(&Moment<Counter>) -> Vec<Property>, limit: u64) -> Vec<String> {
    let counter = Counter { stated };
    let results = induct(&counter).limit(Duration::from_millis(limit)).run();
    let results = results.expect("it has properties").into_iter();
    let text = |it: &Conclusion<_>| match it {
        Conclusion::Proof { by, with } => format!("{by} {}", with.join(", ")),
        Conclusion::Refuted(found) => format!("{found}"),
        Conclusion::Open { from: Some(from) } => from.to_string(),
        Conclusion::Open { from: None } => "open".to_owned(),
        Conclusion::TooLarge => "too large".to_owned(),
        Conclusion::Assumed => "assumed".to_owned(),
    };
    results
        .map(|it| text(&it.conclusion).trim().to_owned())
        .collect()
}

#[test]
fn every_way_to_a_proof_is_taken() {
    let stated: fn(&Moment<Counter>) -> Vec<Property> = |now| {
        let (i, q) = (&now.i, &now.q);
        vec![
            by_is_small(now),
            Property::step(
                "a start is kept",
                &["started"],
                now.next.q.started | !(i.go | q.started),
            ),
            Property::always("the count keeps its end", &["count"], q.count.below(40_001)),
            Property::always(
                "the last state but one does not go",
                &["state"],
                !(q.state.equals(3) & i.go),
            ),
            Property::always(
                "the start is known",
                &["started"],
                q.started | q.count.is_zero() & q.state.is_zero(),
            ),
        ]
    };
    assert_eq!(
        results(stated, 5_000),
        [
            "every state",
            "induction 1",
            "search, 1 clause",
            "induction 1",
            "assumed"
        ]
    );
    let counter = Counter { stated };
    let found = induct(&counter).run().expect("it has properties");
    let Conclusion::Proof { by, .. } = &found[2].conclusion else {
        panic!("{found:?}");
    };
    let crate::check::By::Search { clauses } = by else {
        panic!("{by}");
    };
    assert_eq!(clauses[0].to_string(), "never state[0] & state[1]");
}

/// Nothing reads the register, but the node that it takes is read.
#[test]
fn a_register_outside_of_the_cone_is_no_part_of_a_search() {
    let found = results(
        |now| {
            let (i, q) = (&now.i, &now.q);
            vec![
                Property::always(
                    "the last state but one does not go",
                    &["state"],
                    !(q.state.equals(3) & i.go),
                ),
                Property::step(
                    "going follows go",
                    &["going"],
                    now.next.q.going.equals(i.go),
                ),
            ]
        },
        5_000,
    );
    assert_eq!(found, ["search, 1 clause", "every state"]);
}

#[test]
fn a_property_may_need_another_one() {
    let stated: fn(&Moment<Counter>) -> Vec<Property> = |now| {
        let q = &now.q;
        vec![
            by_is_small(now),
            Property::always(
                "where the count has passed 40,001, the state has too",
                &["count", "state"],
                q.count.below(40_002) | q.state.equals(3),
            ),
            Property::helper("the count keeps its end", &["count"], q.count.below(40_001)),
        ]
    };
    let found = results(stated, 5_000);
    assert_eq!(
        found,
        [
            "induction 1 the count keeps its end",
            "induction 1",
            "assumed"
        ]
    );
    let counter = Counter { stated };
    let found = induct(&counter).run().expect("it has properties");
    let helpers = found.iter().map(|it| it.is_helper);
    assert_eq!(helpers.collect::<Vec<_>>(), [false, true, false]);
}

#[test]
fn what_is_assumed_counts() {
    let found = results(
        |now| {
            let small = now.q.count.below(40_001);
            vec![Property::always(
                "the count keeps its end",
                &["count"],
                small,
            )]
        },
        5_000,
    );
    assert!(found[0].starts_with("tick 1: the count keeps"), "{found:?}");
    // A narrowing is no assumption.
    let narrowed = results(
        |now| {
            let small = now.q.count.below(40_001);
            vec![
                Property::always("the count keeps its end", &["count"], small),
                Property::narrowing("by is 0 or 1", now.i.by.below(2)),
            ]
        },
        5_000,
    );
    assert_eq!(narrowed, found);
}

#[test]
fn a_run_that_breaks_an_assumption_is_no_counterexample() {
    let stated: fn(&Moment<Counter>) -> Vec<Property> = |now| {
        let two = now.q.count.equals(2);
        vec![
            by_is_small(now),
            Property::always("never two", &["count"], !two),
        ]
    };
    let model = Elaborated::new(&Counter { stated }).expect("it can be elaborated");
    let run = |inputs: &[[u64; 2]]| {
        let inputs: Vec<_> = inputs.iter().map(|ports| ports.to_vec()).collect();
        replay(&model, &inputs, 1, &[0])
    };
    assert_eq!(run(&[[1, 1], [1, 1], [0, 0], [0, 0]]), Some(3));
    assert_eq!(run(&[[1, 2], [0, 0]]), None);
    assert_eq!(run(&[[1, 1], [1, 1], [0, 2]]), None);
    assert_eq!(run(&[[1, 1], [1, 1]]), None);
}

#[test]
fn a_counterexample_is_a_run_from_power_on() {
    let stated: fn(&Moment<Counter>) -> Vec<Property> = |now| {
        let three = now.q.count.equals(3) & now.q.state.is_zero();
        vec![
            by_is_small(now),
            Property::always("never three", &["count"], !three),
        ]
    };
    let counter = Counter { stated };
    let found = induct(&counter).run().expect("it has properties").remove(0);
    let found = found.conclusion.counterexample().expect("it is violated");
    assert_eq!((found.tick, found.inputs.len()), (3, 4));
    let counted = found.inputs[..3].iter();
    assert!(counted.map(|i| (i.go, i.by)).all(|i| i == (true, 1)));
    let directory = tempfile::tempdir().expect("a directory");
    let paths = found.save(&counter, Clock::default(), directory.path());
    assert!(paths.expect("it is written")[0].ends_with("counter_never_three.vcd"));
    // One that the search finds, deeper than the first ticks.
    let deep = results(
        |now| {
            let twenty = now.q.count.equals(20) & now.q.state.equals(2);
            vec![
                by_is_small(now),
                Property::always("never twenty", &["count"], !twenty),
            ]
        },
        5_000,
    );
    assert!(deep[0].starts_with("tick 2"), "{deep:?}");
}

/// Far away: no induction decides it, and no search in a short time.
fn far(now: &Moment<Counter>) -> Vec<Property> {
    vec![
        by_is_small(now),
        Property::always("never 39,999", &["count"], !now.q.count.equals(39_999)),
    ]
}

#[test]
fn an_open_property_says_from_which_state_it_would_be_violated() {
    let counter = Counter { stated: far };
    let found = induct(&counter).limit(Duration::from_millis(300)).run();
    let found = found.expect("it has properties").remove(0).conclusion;
    let Conclusion::Open { from: Some(from) } = found else {
        panic!("{found:?}");
    };
    let text = from.to_string();
    let expected = "never 39,999 is not inductive: from count = 39998, a state that may never come, \
                    it is violated a tick later";
    assert!(text.starts_with(expected), "{text}");
    let directory = tempfile::tempdir().expect("a directory");
    let paths = from.save(&counter, Clock::default(), directory.path());
    let paths = paths.expect("it is written");
    let name = "counter_never_39_999_induction.vcd";
    assert_eq!(
        paths[0].file_name().and_then(|name| name.to_str()),
        Some(name)
    );
    let waves = std::fs::read_to_string(&paths[0]).expect("it is there");
    assert!(
        waves.contains("from a state that may never come"),
        "{waves}"
    );
    let count = |number: u64| waves.contains(&format!("b{number:b} "));
    assert!(count(39_998) && count(39_999), "{waves}");
}

#[test]
fn a_question_that_takes_too_long_is_said_to() {
    let found = results(
        |now| {
            let (a, b) = (now.q.count, now.q.other);
            let products = a.times(b, 32).equals(b.times(a, 32));
            vec![Property::always("products commute", &["count"], products)]
        },
        100,
    );
    assert_eq!(found, ["too large"]);
}

#[test]
fn nothing_to_prove_and_no_input_are_errors() {
    let none = Counter {
        stated: |_| Vec::new(),
    };
    let error = induct(&none).run().expect_err("it has none");
    assert!(matches!(error, InductError::NoProperties { .. }), "{error}");
    let dead = Counter {
        stated: |now| {
            vec![
                Property::given("nothing starts", !now.q.started & now.i.go),
                Property::always("nothing has started", &["started"], !now.q.started),
            ]
        },
    };
    let error = induct(&dead)
        .run()
        .expect_err("all inputs are excluded in tick 1");
    let text = "counter: no input keeps all assumptions up to tick 1; correct the statements that \
                `given` makes";
    assert_eq!(error.to_string(), text);
    let late = Counter {
        stated: |now| {
            let one = now.i.go & now.i.by.equals(1);
            vec![
                Property::given("it counts", one),
                Property::given("the count is below nine", now.q.count.below(9)),
                Property::always("the count is not ten", &["count"], !now.q.count.equals(10)),
            ]
        },
    };
    let error = induct(&late).run().expect_err("no run goes beyond tick 8");
    assert!(error.to_string().contains("up to tick 9"), "{error}");
}

#[test]
fn a_limit_may_be_of_any_length() {
    let stated: fn(&Moment<Counter>) -> Vec<Property> = |now| {
        let last = now.q.state.below(3);
        vec![Property::always(
            "the state is one of three",
            &["state"],
            last,
        )]
    };
    let counter = Counter { stated };
    let found = induct(&counter).limit(Duration::MAX).run();
    assert!(found.expect("it has a property")[0].conclusion.is_proved());
    let found = induct(&counter).limit(Duration::ZERO).run();
    assert!(!found.expect("it has a property")[0].conclusion.is_proved());
}

#[test]
fn signals_that_do_not_exist_are_named() {
    let stated: fn(&Moment<Counter>) -> Vec<Property> =
        |now| vec![Property::always("it goes", &["goin"], now.q.going)];
    let found = induct(&Counter { stated }).run();
    let error = found.expect_err("there is no such signal").to_string();
    assert!(
        error.contains("names `goin`") && error.contains("going"),
        "{error}"
    );
}

#[test]
fn properties_with_mistakes_are_refused() {
    let stated: fn(&Moment<Counter>) -> Vec<Property> = |now| {
        let (q, next) = (&now.q, &now.next.q);
        let held = next.count.equals(q.count);
        vec![
            Property::always("the count stays", &["count"], held),
            Property::given("the other stays", next.other.equals(q.other)),
            Property::step("it goes", &["going"], next.going),
            Property::helper("it goes", &["going"], q.going),
            Property::always("two\nlines", &[], q.going),
            Property::always(" ", &[], q.going),
            Property {
                step: true,
                ..Property::given("no edge", q.going)
            },
            Property {
                step: true,
                ..Property::narrowing("one edge", q.going)
            },
        ]
    };
    let wrong = crate::hdl::elaborate(&Counter { stated }).expect_err("it has mistakes");
    let wrong: Vec<_> = wrong.0.iter().map(|it| it.what.as_str()).collect();
    let expected = [
        "property `the count stays` reads registers after the edge, which only `Property::step` may",
        "property `the other stays` reads registers after the edge, which only `Property::step` may",
        "two properties are called `it goes`",
        "property \"two\\nlines\": a name is one line of text and is not empty",
        "property \" \": a name is one line of text and is not empty",
        "assumption `no edge` is about an edge; an assumption is about the input ports of a tick",
        "assumption `one edge` is about an edge; an assumption is about the input ports of a tick",
    ];
    assert_eq!(wrong, expected);
}
