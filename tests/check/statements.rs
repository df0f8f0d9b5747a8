//! Statements of a circuit: words of memories before and after an edge, assumptions, narrowing.

use motion_rtl::check::{Invariants, Monitor, Outcome, Proof};
use motion_rtl::netlist::Claim;
use motion_rtl::prelude::*;
use motion_rtl::sim::{Elaborated, RunError, State};
use motion_rtl::verilog::Verilog;

/// A memory of three stages and four words beside each other.
#[derive(Debug, Clone)]
struct Store {
    /// True for the properties that do not hold.
    wrong: bool,
    /// True if the search looks at one word only.
    narrow: bool,
}

signals! { for Store as _c;
    struct In {
        write: Bit,
        address: U(2),
        word: U(1),
    }
    struct Reg {
        words: Ram(2, 1),
        stages: Shift(3, 1),
    }
}

impl Circuit for Store {
    const NAME: &'static str = "store";
    const ABOUT: &'static str = "a memory and a shift register";
    records!(In, Reg, Nothing);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Nothing, Reg<Edge>) {
        let next = Reg {
            words: q.words.write(i.write, i.address, i.word),
            stages: q.stages.shift(i.write, i.word),
        };
        (Nothing, next)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, next) = (&now.i, &now.q, &now.next.q);
        let written = |at: usize| i.write & i.address.equals(at as u64);
        let words = (0..q.words.len()).map(|at| {
            let wanted = written(at).mux(i.word, q.words.word(at));
            next.words.word(at).equals(wanted)
        });
        let words = words.reduce(|all, word| all & word).expect("four words");
        let beside = q
            .words
            .read(i.address + 1)
            .equals(next.words.read(i.address + 1));
        let moved = |at: usize| match at {
            0 => i.word,
            at => q.stages.word(at - 1),
        };
        let stages = (0..q.stages.len()).map(|at| {
            let wanted = i.write.mux(moved(at), q.stages.word(at));
            next.stages.word(at).equals(wanted)
        });
        let stages = stages
            .reduce(|all, stage| all & stage)
            .expect("three stages");
        let here = q.words.read(i.address).equals(next.words.read(i.address));
        let mut all = vec![
            Property::step(
                "a write changes the word at its address and no other",
                &["words"],
                words,
            ),
            Property::step("a write leaves the word behind its own", &["words"], beside),
            Property::step("a write moves each stage by one", &["stages"], stages),
        ];
        if self.wrong {
            all.push(Property::step(
                "a write leaves its own word",
                &["words"],
                here,
            ));
        }
        if self.narrow {
            all.push(Property::narrowing(
                "the word is 0 without a write",
                i.write | i.word.is_zero(),
            ));
            all.push(Property::given("address 3 is never written", !written(3)));
        }
        all
    }
}

impl Specified for Store {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::of(self)
    }
}

/// The outcome of the search by gates, which is that of the search in simulation.
fn both(circuit: &Store) -> Outcome<Store> {
    let found = prove(circuit).run().unwrap();
    let simulated = prove(circuit).run_simulated().unwrap();
    assert_eq!(found.to_string(), simulated.to_string());
    found
}

fn store(wrong: bool, narrow: bool) -> Store {
    Store { wrong, narrow }
}

#[test]
fn words_of_memories_are_those_before_and_after_the_edge() {
    let proof = both(&store(false, false)).proof().expect("it holds");
    // All words and stages, but the first stage is that of the words if these are alike; every
    // input in each of these states.
    assert_eq!((proof.states, proof.transitions), (120, 120 << 4));
    let found = both(&store(true, false))
        .counterexample()
        .expect("it does not hold");
    assert_eq!(found.invariant, "a write leaves its own word");
    // Words that are not at fault come last in the table.
    let table = found.to_string();
    let first = |name: &str| {
        let mut rows = table.lines();
        let row = rows.position(|row| row.trim_start_matches(['*', ' ']).starts_with(name));
        row.unwrap_or_else(|| panic!("{table}"))
    };
    assert!(first("words") < first("address"), "{table}");
    assert!(first("address") < first("stages"), "{table}");
    assert_eq!((found.tick, found.signals), (0, vec!["words".to_owned()]));
}

#[test]
fn assumptions_and_narrowing_exclude_inputs() {
    let Proof {
        states,
        transitions,
        dead_ends,
        ..
    } = both(&store(false, true)).proof().expect("it holds");
    // The word at address 3 stays 0. Six inputs write, four do not.
    assert_eq!((states, transitions, dead_ends), (56, 56 * 10, 0));
}

#[test]
fn a_run_that_breaks_an_assumption_ends() {
    let circuit = store(false, true);
    let invariants = circuit.invariants();
    let names: Vec<_> = invariants.names().collect();
    assert_eq!(names.len(), 3, "{names:?}");
    let mut simulator = Simulator::new(&circuit).unwrap();
    let quiet = |_: u64, _: &State<'_, Store>| In {
        write: false,
        address: 0,
        word: 1,
    };
    simulator.run(3, quiet, Monitor::new(&invariants)).unwrap();
    let last = |_: u64, _: &State<'_, Store>| In {
        write: true,
        address: 3,
        word: 1,
    };
    match simulator.run(1, last, Monitor::new(&invariants)) {
        Err(RunError::Violation {
            tick: 3, message, ..
        }) => {
            let wanted = "address 3 is never written: assumed of the inputs, which break it";
            assert_eq!(message, wanted);
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn verilog_assumes_what_is_given_and_does_not_narrow() {
    let circuit = store(false, true);
    let model = Elaborated::new(&circuit).unwrap();
    let claims = model.design().modules[0]
        .assertions
        .iter()
        .map(|assertion| assertion.claim);
    assert_eq!(claims.filter(|claim| *claim == Claim::Narrowing).count(), 1);
    let verilog = Verilog::new(&circuit).unwrap();
    assert_eq!(verilog.assertions().len(), 3);
    let text = verilog.top().text;
    assert_eq!(text.matches("assert (").count(), 3, "{text}");
    assert_eq!(text.matches("assume (").count(), 1, "{text}");
    assert!(text.contains("// Address 3 is never written."), "{text}");
    assert!(!text.contains("without a write"), "{text}");
}
