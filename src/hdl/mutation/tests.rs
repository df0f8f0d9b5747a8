use super::{Change, Mutation, Place, mutated, mutations};
use crate::check::{Invariants, Outcome, reach};
use crate::engine::Watch;
use crate::hdl::prelude::*;
use crate::hdl::{Model, Moment, Property, model};
use expect_test::expect;

/// Adds up its input to a limit, and starts again at `clear`.
#[derive(Debug, Clone)]
struct Sum {
    width: usize,
}

signals! { for Sum as c;
    /// Ports in.
    pub struct In {
        /// Starts the sum again.
        clear: Bit,
        /// Adds `by`.
        add: Bit,
        /// Summand.
        by: I(c.width),
        /// Greatest sum.
        limit: I(c.width),
    }
    /// Registers.
    pub struct Reg {
        /// The sum.
        pub sum: I(c.width) = 2,
    }
    /// Nets.
    pub struct Net {
        /// High if the sum would pass the limit.
        pub over: Bit,
    }
}

impl Circuit for Sum {
    const NAME: &'static str = "adder";
    const ABOUT: &'static str = "adds up to a limit";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let next = q.sum.plus(i.by);
        let over = i.limit.below_any(next);
        let added = over.mux(i.limit, next.resize(self.width));
        let sum = i.clear.mux(2, i.add.mux(added, q.sum));
        (Net { over }, Reg { sum })
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let next = now.q.sum.plus(now.i.by);
        let over = now.i.limit.below_any(next);
        vec![Property::always(
            "over says so",
            &["over"],
            !(now.w.over ^ over),
        )]
    }
}

fn all(circuit: &Sum) -> Vec<Mutation> {
    mutations("adder", || model(circuit)).1
}

/// Returns the registers after each tick, and the net in it.
fn run(model: &Model, inputs: &[[i64; 4]]) -> Vec<(i64, u64)> {
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

#[test]
fn every_fault_of_a_circuit_is_listed() {
    let faults = all(&Sum { width: 4 });
    let faults: Vec<_> = faults.iter().map(short).collect();
    expect![[r#"
        44:26: extension: left out
        44:26: extension 2: left out
        44:26: sum: another operator
        45:28: extension: left out
        45:28: below: another operator
        45:28: below: operands exchanged
        46:44: slice: one bit more
        46:26: choice: always the first
        46:26: choice: always the second
        47:40: choice: always the first
        47:40: choice: always the second
        47:27: choice: always the first
        47:27: choice: always the second
        47:27: choice: the next choice comes first
        47:27: choice: constant 1 one more
        47:27: choice: constant 1 one less
        sum: another value at power-on
        over: low
    "#]]
    .assert_eq(&(faults.join("\n") + "\n"));
}

/// Returns the text of a fault without its file.
fn short(fault: &Mutation) -> String {
    let text = fault.to_string();
    text.replace("src/hdl/mutation/tests.rs:", "")
}

/// Returns a circuit with the fault whose text ends so.
fn faulty(circuit: &Sum, fault: &str) -> Model {
    let all = all(circuit);
    let mut those = all
        .iter()
        .filter(|other| other.to_string().ends_with(fault));
    let (mutation, another) = (those.next().expect(fault), those.next());
    assert_eq!(another, None);
    let model = mutated(mutation, || model(circuit)).expect("it has a place");
    model.expect("it can be elaborated")
}

#[test]
fn a_fault_does_what_it_says() {
    let sum = Sum { width: 4 };
    let right = |sum: i64, i: [i64; 4]| {
        let next = sum + i[2];
        limited(next, i[3] < next, sum, i)
    };
    assert_eq!(run(&model(&sum).unwrap(), &INPUTS), steps(right));
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
fn a_fault_is_the_same_one_at_another_width() {
    let (narrow, wide) = (Sum { width: 4 }, Sum { width: 9 });
    assert_eq!(all(&narrow), all(&wide));
    for fault in all(&narrow) {
        let made = mutated(&fault, || model(&wide)).expect("it has a place");
        assert_ne!(made.unwrap().design(), model(&wide).unwrap().design());
    }
}

#[test]
fn without_a_fault_a_circuit_is_as_before() {
    let sum = Sum { width: 4 };
    let before = model(&sum).unwrap();
    for fault in all(&sum) {
        let _ = mutated(&fault, || model(&sum));
        assert_eq!(model(&sum).unwrap().design(), before.design());
    }
    let other = Mutation {
        circuit: "adder".to_owned(),
        place: Place::Signal("over".to_owned()),
        change: Change::PowerOn,
    };
    assert!(
        mutated(&other, || model(&sum)).is_none(),
        "a net has no power-on"
    );
    let elsewhere = Mutation {
        circuit: "difference".to_owned(),
        ..all(&sum)[0].clone()
    };
    assert!(mutated(&elsewhere, || model(&sum)).is_none());
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
