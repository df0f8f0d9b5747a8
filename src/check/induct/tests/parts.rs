//! Assumptions of parts as obligations of the circuits around them.

use crate::check::{Concluded, Conclusion, Counterexample, InductError, induct};
use crate::hdl::*;
use std::time::Duration;

/// Sum of words below 2, and a flag that a larger word sets.
#[derive(Debug, Clone)]
struct Sum;

signals! { for Sum as _c;
    pub struct In { pub by: U(8) }
    pub struct Reg { pub sum: U(24) = 0, pub spoilt: Bit = 0 }
    pub struct Net { pub doubled: U(8) }
}

impl Circuit for Sum {
    const NAME: &'static str = "summer";
    const ABOUT: &'static str = "adds words below 2";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let next = Reg {
            sum: q.sum + i.by.resize(24),
            spoilt: q.spoilt | !i.by.below(2),
        };
        let doubled = i.by.shift_left(1);
        (Net { doubled }, next)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        vec![
            Property::given("by is below 2", now.i.by.below(2)),
            Property::always("never spoilt", &["spoilt"], !now.q.spoilt),
            Property::always("doubled is below 3", &["doubled"], now.w.doubled.below(3)),
        ]
    }
}

mod around {
    use super::{Sum, sum_in};
    use crate::hdl::*;

    /// Two sums, with words that a function makes for each.
    #[derive(Debug, Clone)]
    pub(super) struct Around {
        pub words: fn(U, &Seen2) -> [U; 2],
        pub stated: fn(&Moment<Around>) -> Vec<Property>,
    }

    /// Registers of the sums that the words may depend on.
    #[derive(Debug, Clone, Copy)]
    pub(super) struct Seen2 {
        pub spoilt: [Bit; 2],
        pub sum: [U; 2],
    }

    signals! { for Around as _c;
        pub struct In { pub word: U(8) }
        pub struct Parts {
            pub first: Part<Sum>(Sum),
            pub second: Part<Sum>(Sum),
        }
    }

    impl Circuit for Around {
        const NAME: &'static str = "around";
        const ABOUT: &'static str = "two sums";
        records!(In, Nothing, Nothing, Parts);

        fn tick(&self, i: In, _: Nothing, p: Parts) -> (Nothing, Nothing) {
            let seen = Seen2 {
                spoilt: [p.first.q.spoilt, p.second.q.spoilt],
                sum: [p.first.q.sum, p.second.q.sum],
            };
            let [first, second] = (self.words)(i.word, &seen);
            p.first.settle(sum_in(first));
            p.second.settle(sum_in(second));
            (Nothing, Nothing)
        }

        fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
            (self.stated)(now)
        }
    }

    signals! { for Outer as _c;
        pub struct OuterIn { pub word: U(8) }
        pub struct OuterParts { pub inner: Part<Around>(_c.around.clone()) }
    }

    /// Circuit around [`Around`].
    #[derive(Debug, Clone)]
    pub(super) struct Outer {
        pub around: Around,
    }

    impl Circuit for Outer {
        const NAME: &'static str = "outer";
        const ABOUT: &'static str = "two sums, one level deeper";
        records!(OuterIn, Nothing, Nothing, OuterParts);

        fn tick(&self, i: OuterIn, _: Nothing, p: OuterParts) -> (Nothing, Nothing) {
            p.inner.settle(In {
                word: i.word.slice(0, 1).resize(8),
            });
            (Nothing, Nothing)
        }
    }
}

use around::{Around, Outer};

fn sum_in(by: U) -> In {
    In { by }
}

fn prove<C: Circuit>(circuit: &C) -> Vec<Concluded<Counterexample<C>>> {
    let limit = Duration::from_millis(400);
    induct(circuit)
        .limit(limit)
        .run()
        .expect("there is something to prove")
}

/// Returns title and short result of each row.
fn rows<C: Circuit>(circuit: &C) -> Vec<String> {
    let text = |it: &Concluded<_>| {
        let result = match &it.conclusion {
            Conclusion::Proof { by, with } => format!("{by} {}", with.join(", ")),
            Conclusion::Refuted(_) => "refuted".to_owned(),
            Conclusion::Open { .. } => "open".to_owned(),
            Conclusion::TooLarge => "too large".to_owned(),
            Conclusion::Assumed => "assumed".to_owned(),
        };
        let part = it.part.iter().map(|part| format!("{part}: "));
        let title: String = part.chain([it.property.clone()]).collect();
        format!("{title} = {}", result.trim())
    };
    prove(circuit).iter().map(text).collect()
}

fn nothing(_: &Moment<Around>) -> Vec<Property> {
    Vec::new()
}

#[test]
fn an_assumption_of_a_part_is_proved_of_the_circuit_around_it() {
    let circuit = Around {
        words: |word, _| [word.bit(0).mux(1, U::new(0, 8)), U::new(1, 8)],
        stated: nothing,
    };
    let expected = [
        "first: by is below 2 = every state",
        "second: by is below 2 = every state",
    ];
    assert_eq!(rows(&circuit), expected);
    // At every depth.
    let outer = Outer {
        around: Around {
            words: |word, _| [word, U::new(1, 8)],
            stated: |now| vec![Property::given("word is below 2", now.i.word.below(2))],
        },
    };
    let expected = [
        "inner: word is below 2 = every state",
        "inner.first: by is below 2 = every state",
        "inner.second: by is below 2 = every state",
    ];
    assert_eq!(rows(&outer), expected);
}

#[test]
fn an_assumption_of_the_circuit_itself_is_listed_and_used() {
    let circuit = Around {
        words: |word, _| [word, U::new(0, 8)],
        stated: |now| vec![Property::given("word is below 2", now.i.word.below(2))],
    };
    let expected = [
        "first: by is below 2 = every state",
        "second: by is below 2 = every state",
        "word is below 2 = assumed",
    ];
    assert_eq!(rows(&circuit), expected);
}

#[test]
fn each_part_is_asked_about_its_own_inputs() {
    let circuit = Around {
        words: |word, _| [U::new(1, 8), word],
        stated: nothing,
    };
    let expected = [
        "first: by is below 2 = every state",
        "second: by is below 2 = refuted",
    ];
    assert_eq!(rows(&circuit), expected);
    let results = prove(&circuit);
    let found = results.into_iter().nth(1).expect("two rows");
    let found = found.conclusion.counterexample().expect("refuted");
    let last = found.inputs.last().expect("it has a tick");
    assert!(last.word >= 2, "{found}");
    assert_eq!(found.invariant, "second: by is below 2");
}

#[test]
fn properties_of_a_part_are_lemmas() {
    // What spoils the sum depends on that it is not spoilt.
    let circuit = Around {
        words: |word, seen| [seen.spoilt[0].mux(word, 1), U::new(0, 8)],
        stated: nothing,
    };
    let expected = [
        "first: by is below 2 = induction 1 first: never spoilt",
        "second: by is below 2 = every state",
    ];
    assert_eq!(rows(&circuit), expected);
}

#[test]
fn a_part_does_not_prove_its_own_assumption() {
    // "doubled is below 3" and "by is below 2" say the same. Each follows from the other in one
    // tick; neither holds.
    let circuit = Around {
        words: |word, _| [word, word],
        stated: nothing,
    };
    let expected = [
        "first: by is below 2 = refuted",
        "second: by is below 2 = refuted",
    ];
    assert_eq!(rows(&circuit), expected);
    // The first violation comes too late for a trace. The assumption fails when the property of the
    // part does, and not before; nor do two parts prove those of each other.
    let own = Around {
        words: |word, seen| {
            let far = seen.sum[0].equals(5_000);
            [(seen.spoilt[0] | far).mux(word, 1), U::new(0, 8)]
        },
        stated: nothing,
    };
    assert_eq!(rows(&own)[0], "first: by is below 2 = open");
    let each_other = Around {
        words: |word, seen| {
            let word = |other: usize| {
                let far = seen.sum[other].equals(5_000);
                (seen.spoilt[other] | far).mux(word, 1)
            };
            [word(1), word(0)]
        },
        stated: nothing,
    };
    let expected = [
        "first: by is below 2 = open",
        "second: by is below 2 = open",
    ];
    assert_eq!(rows(&each_other), expected);
}

#[test]
fn an_open_assumption_has_its_name_in_the_state_from_which_it_fails() {
    let circuit = Around {
        words: |word, seen| [U::new(1, 8), seen.sum[0].equals(5_000).mux(word, 1)],
        stated: nothing,
    };
    let results = prove(&circuit);
    let Conclusion::Open { from: Some(from) } = &results[1].conclusion else {
        panic!("{results:?}");
    };
    let text = from.to_string();
    assert!(
        text.starts_with("second: by is below 2 is not inductive: from first.sum = 4999"),
        "{text}"
    );
}

#[test]
fn a_circuit_whose_parts_assume_nothing_has_nothing_to_prove() {
    let error = induct(&Plain).run().expect_err("nothing is stated");
    assert!(matches!(error, InductError::NoProperties { .. }), "{error}");
}

/// Part without an assumption, inside a circuit without properties.
#[derive(Debug, Clone)]
struct Wire1;

signals! { for Wire1 as _c;
    pub struct WireIn { pub a: Bit }
    pub struct WireNet { pub b: Bit }
}

impl Circuit for Wire1 {
    const NAME: &'static str = "wire_one";
    const ABOUT: &'static str = "passes a bit on";
    records!(WireIn, Nothing, WireNet);

    fn tick(&self, i: WireIn, _: Nothing, _: Nothing) -> (WireNet, Nothing) {
        (WireNet { b: i.a }, Nothing)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        vec![Property::always("b is a", &["b"], !(now.w.b ^ now.i.a))]
    }
}

#[derive(Debug, Clone)]
struct Plain;

signals! { for Plain as _c;
    pub struct PlainIn { pub a: Bit }
    pub struct PlainParts { part: Part<Wire1>(Wire1) }
}

impl Circuit for Plain {
    const NAME: &'static str = "plain";
    const ABOUT: &'static str = "contains a part without an assumption";
    records!(PlainIn, Nothing, Nothing, PlainParts);

    fn tick(&self, i: PlainIn, _: Nothing, p: PlainParts) -> (Nothing, Nothing) {
        p.part.settle(WireIn { a: i.a });
        (Nothing, Nothing)
    }
}
