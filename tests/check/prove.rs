//! Proofs of a circuit's own specification, and names of signals that do not exist.

use crate::circuits::{Lock, Up};
use crate::reach::proof;
use expect_test::{Expect, expect};
use motion_rtl::check::{CheckError, Outcome, UnknownSignal, prove};
use motion_rtl::hdl::Value;
use motion_rtl::prelude::*;
use motion_rtl::registry::{CATALOGUE, Pair, ProofSearch};
use motion_rtl::sim::Sample;
use std::collections::BTreeSet;

/// Counts up by a port, and relies on rules for the port.
#[derive(Debug, Clone)]
struct Ruled {
    /// Greatest summand that `applies` allows.
    most: u64,
    /// Count from which zero only is given.
    full: u64,
}

signals! { for Ruled as _c;
    struct In { by: U(3) }
    struct Reg { count: U(5) }
}

impl Circuit for Ruled {
    const NAME: &'static str = "ruled";
    const ABOUT: &'static str = "counts up by a port with rules";
    records!(In, Reg, Nothing);
    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Nothing, Reg<Edge>) {
        (
            Nothing,
            Reg {
                count: q.count + i.by.resize(5),
            },
        )
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let few = now.q.count.resize(6).below(self.full);
        let given = few | now.i.by.is_zero();
        vec![Property::given(
            "zero is added from the full count on",
            given,
        )]
    }
}

impl Specified for Ruled {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::of(self).step("never down", |now, next| {
            let (before, after) = (now.q.count, next.q.count);
            require(after >= before, ["count"], || format!("{before}, {after}"))
        })
    }
    fn applies(&self, i: &In<Value>) -> bool {
        i.by <= self.most
    }
}

#[test]
fn a_proof_keeps_the_rules_for_inputs() {
    // Counts up to the sum of 28 and the greatest summand; only zero is added from 28 on.
    for most in [0, 1, 3] {
        let circuit = Ruled { most, full: 28 };
        let outcome = prove(&circuit).run().unwrap();
        let last = if most == 0 { 0 } else { 27 + most };
        let moving = last.min(27) + 1;
        let transitions = moving * (most + 1) + (last + 1 - moving);
        let depth = last.div_ceil(most.max(1));
        assert_eq!(outcome.proof(), Some(proof(last + 1, transitions, depth)));
    }
    // Without the rule for inputs, or without the one for states, the count wraps.
    let broken = |most, full| prove(&Ruled { most, full }).run().unwrap().counterexample();
    assert_eq!(broken(7, 28).expect("27 + 7 wraps").tick, 4);
    assert_eq!(broken(1, 32).expect("31 + 1 wraps").tick, 31);
    let circuit = Ruled { most: 3, full: 28 };
    let limited = prove(&circuit).limit(7).run().unwrap();
    assert!(matches!(limited, Outcome::Limit(_)), "{limited}");
    // `reach` searches every input.
    let law = circuit.invariants();
    assert!(reach(&circuit, &law).run().unwrap().proof().is_none());
}

fn refused<C: Circuit>(circuit: &C, law: &Invariants<'_, C>, expected: &Expect) {
    for simulated in [false, true] {
        let search = reach(circuit, law);
        let outcome = match simulated {
            false => search.run(),
            true => search.run_simulated(),
        };
        expected.assert_eq(&outcome.expect_err("a name is wrong").to_string());
    }
}

#[test]
fn a_signal_that_an_invariant_names_exists() {
    let circuit = Up { n: 5 };
    let law = Invariants::<Up>::new()
        .always("good", |now| {
            require(now.q.count < 5, ["modulo.count"], String::new)
        })
        .always("short", |now| {
            require(now.q.count < 5, ["cuont", "last"], String::new)
        })
        .step("long", |_, next| {
            require(next.q.count < 5, ["parts.count", "enable"], String::new)?;
            require(next.q.count < 6, ["zzz"], String::new)
        });
    refused(
        &circuit,
        &law,
        &expect![[r#"
            modulo: the invariant `short` names `cuont`, but there is no such signal; did you mean count?
            modulo: the invariant `long` names `parts.count`, but there is no such signal
            modulo: the invariant `long` names `zzz`, but there is no such signal"#]],
    );
    let found = reach(&circuit, &law).run().unwrap_err();
    let CheckError::Signals(signals) = found else {
        panic!("{found}");
    };
    let first = UnknownSignal {
        circuit: "modulo".into(),
        invariant: "short".into(),
        signal: "cuont".into(),
        near: Some("count".into()),
    };
    assert_eq!(signals[0], first);
}

/// Circuit whose property names a signal that it does not have.
#[derive(Debug, Clone)]
struct Misspelt;

signals! { for Misspelt as _c;
    struct MisspeltIn { fresh: Bit }
    struct MisspeltReg { words: Shift(2, 1) }
    struct MisspeltNet { stale: Bit }
}

impl Circuit for Misspelt {
    const NAME: &'static str = "misspelt";
    const ABOUT: &'static str = "has a property with a wrong name";
    records!(MisspeltIn, MisspeltReg, MisspeltNet);
    fn tick(&self, i: MisspeltIn, q: MisspeltReg, _: Nothing) -> (MisspeltNet, MisspeltReg<Edge>) {
        let words = q.words.shift(i.fresh, i.fresh.word());
        (MisspeltNet { stale: !i.fresh }, MisspeltReg { words })
    }
    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let one = now.i.fresh ^ now.w.stale;
        vec![
            Property::always("a memory has a name", &["words", "words.stage1"], one),
            Property::always("one of two", &["frehs", "stale"], one),
        ]
    }
}

#[test]
fn a_signal_that_a_property_names_exists() {
    refused(
        &Misspelt,
        &Invariants::of(&Misspelt),
        &expect![
            "misspelt: the invariant `one of two` names `frehs`, but there is no such signal; did you mean fresh?"
        ],
    );
}

/// Names in the invariants of a circuit that do not exist.
fn unknown(circuit: &dyn motion_rtl::registry::AnyCircuit) -> Vec<String> {
    let search = ProofSearch {
        transitions: 1,
        ..ProofSearch::default()
    };
    match circuit.prove(&search, &mut |_| ()) {
        Err(CheckError::Signals(signals)) => signals.iter().map(UnknownSignal::to_string).collect(),
        _ => Vec::new(),
    }
}

#[test]
fn names_in_the_invariants_of_the_catalogue_exist() {
    let mut wrong = Vec::new();
    for entry in CATALOGUE.iter().filter(|entry| entry.proved) {
        let circuit = entry.proof(&[]).expect("it has a proof");
        wrong.extend(unknown(&*circuit));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn names_in_the_invariants_of_all_variants_exist() {
    let mut wrong = BTreeSet::new();
    let mut variants = 0;
    for entry in CATALOGUE.iter().filter(|entry| entry.proved) {
        for key in entry.keys() {
            let words = key
                .range
                .split(|letter: char| !letter.is_alphanumeric() && letter != '_');
            for value in words.filter(|word| word.starts_with(char::is_alphabetic)) {
                if let Ok(circuit) = entry.proof(&[Pair::new(&key.name, value)]) {
                    variants += 1;
                    wrong.extend(unknown(&*circuit));
                }
            }
        }
    }
    assert!(variants > 20, "{variants} variants");
    let wrong: Vec<_> = wrong.into_iter().collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_violation_without_a_message_ends_with_its_name() {
    let shut = Invariants::new().always("right is not 1", |now: &Sample<'_, Lock>| {
        require(now.q.right != 1, ["right"], String::new)
    });
    let circuit = Lock { code: [3, 1, 2] };
    let found = reach(&circuit, &shut).run().unwrap().to_string();
    let first = found.lines().next();
    assert_eq!(first, Some("tick 1: right is not 1 (signals: right)"));
}
