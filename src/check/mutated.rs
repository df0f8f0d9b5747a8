//! Faults that are put into a circuit do what they say, and proofs find them.

use super::{Invariants, Outcome, reach};
use crate::engine::Watch;
use crate::hdl::mutation::mutated;
use crate::hdl::mutation::tests::{Sum, all};
use crate::sim::Elaborated;

/// Returns the registers after each tick, and the net in it.
fn run(model: &Elaborated, inputs: &[[i64; 4]]) -> Vec<(i64, u64)> {
    let mut engine = model.engine(Watch::All);
    let mut seen = Vec::new();
    for ports in inputs {
        let ports = ports.map(|port| port as u64 & 0xf);
        engine.drive_all(&[ports[0] & 1, ports[1] & 1, ports[2], ports[3]]);
        engine.settle();
        let over = engine.word(5);
        engine.edge();
        seen.push((((engine.word(4) << 60) as i64) >> 60, over));
    }
    seen
}

/// Input ports, tick by tick: sums of either sign, a limit that is met, a `clear` that comes with
/// `add`.
const INPUTS: [[i64; 4]; 8] = [
    [0, 1, 3, 7],
    [0, 1, -6, 7],
    [0, 0, 5, 7],
    [0, 1, 7, 4],
    [0, 1, 1, 3],
    [1, 1, 1, 7],
    [0, 1, -1, 1],
    [0, 1, 2, -3],
];

/// Runs the model of the circuit on numbers.
fn steps(step: impl Fn(i64, [i64; 4]) -> (i64, bool)) -> Vec<(i64, u64)> {
    let mut sum = 2;
    let steps = INPUTS.map(|inputs| {
        let (next, over) = step(sum, inputs);
        // Four bits.
        sum = next << 60 >> 60;
        (sum, u64::from(over))
    });
    steps.into()
}

/// Returns the next sum, and whether it passes the limit.
fn limited(next: i64, over: bool, sum: i64, [clear, add, _, limit]: [i64; 4]) -> (i64, bool) {
    let added = if over { limit } else { next };
    let then = if add == 1 { added } else { sum };
    (if clear == 1 { 2 } else { then }, over)
}

/// Returns a circuit with the fault whose text ends so.
fn faulty(circuit: &Sum, fault: &str) -> Elaborated {
    let all = all(circuit);
    let mut those = all
        .iter()
        .filter(|other| other.to_string().ends_with(fault));
    let (mutation, another) = (those.next().expect(fault), those.next());
    assert_eq!(another, None);
    let model = mutated(mutation, || Elaborated::new(circuit)).expect("it has a place");
    model.expect("it can be elaborated")
}

#[test]
fn a_fault_does_what_it_says() {
    let sum = Sum { width: 4 };
    let right = |sum: i64, i: [i64; 4]| {
        let next = sum + i[2];
        limited(next, i[3] < next, sum, i)
    };
    assert_eq!(run(&Elaborated::new(&sum).unwrap(), &INPUTS), steps(right));
    type Step = fn(i64, [i64; 4]) -> (i64, bool);
    let faults: [(&str, Step); 8] = [
        ("sum: another operator", |sum, i| {
            let next = sum - i[2];
            limited(next, i[3] < next, sum, i)
        }),
        ("26: extension: left out", |sum, i| {
            // Of five bits.
            let next = ((sum & 0xf) + i[2]) << 59 >> 59;
            limited(next, i[3] < next, sum, i)
        }),
        ("below: another operator", |sum, i| {
            let next = sum + i[2];
            limited(next, i[3] <= next, sum, i)
        }),
        ("below: operands exchanged", |sum, i| {
            let next = sum + i[2];
            limited(next, next < i[3], sum, i)
        }),
        ("slice: one bit more", |sum, i| {
            let next = sum + i[2];
            limited(next >> 1, i[3] < next, sum, i)
        }),
        ("the next choice comes first", |sum, i| {
            let next = sum + i[2];
            let (then, over) = limited(next, i[3] < next, sum, [0, i[1], i[2], i[3]]);
            match i[..2] {
                [1, 0] => (2, over),
                _ => (then, over),
            }
        }),
        ("constant 1 one more", |sum, i| {
            let next = sum + i[2];
            let (then, over) = limited(next, i[3] < next, sum, i);
            (if i[0] == 1 { 3 } else { then }, over)
        }),
        ("over: low", |sum, i| limited(sum + i[2], false, sum, i)),
    ];
    for (fault, step) in faults {
        let expected = steps(step);
        assert_ne!(expected, steps(right), "{fault}: nothing shows it");
        assert_eq!(run(&faulty(&sum, fault), &INPUTS), expected, "{fault}");
    }
}

#[test]
fn another_value_at_power_on_is_there_from_the_first_tick() {
    let sum = Sum { width: 4 };
    let idle = run(&faulty(&sum, "sum: another value at power-on"), &[[0; 4]]);
    assert_eq!(idle, vec![(3, 1)]);
}

#[test]
fn a_property_does_not_share_the_fault_that_it_is_to_find() {
    let sum = Sum { width: 3 };
    for fault in ["below: another operator", "below: operands exchanged"] {
        let invariants = Invariants::of(&sum);
        let search = reach(&sum, &invariants).model(faulty(&sum, fault));
        let outcome = search.run().expect("it is narrow");
        assert!(
            matches!(outcome, Outcome::Counterexample(_)),
            "{fault}: {outcome}"
        );
    }
    let invariants = Invariants::of(&sum);
    let outcome = reach(&sum, &invariants).run().expect("it is narrow");
    assert!(outcome.proof().is_some(), "{outcome}");
}
