//! Proofs that do not hold are refused by their check.

use crate::check::induct::certify::check;
use crate::check::induct::clauses::Answer;
use crate::check::induct::prover::{Basis, Grounds, Task};
use crate::check::induct::search::StateBit;
use crate::engine::Place;
use crate::engine::random::parts::{Flat, Node, Op, Register};
use std::time::Duration;

/// Returns a counter that counts 0, 1, 2 and starts again. Properties: it is below 3; it is not 3;
/// it is not 1; it is below 3 in the next tick.
fn counter() -> Flat {
    let mut flat = Flat::default();
    let mut node = |op, width| {
        flat.nodes.push(Node {
            op,
            width,
            instance: 0,
        });
        flat.nodes.len() as u32 - 1
    };
    let count = node(Op::Register(0), 2);
    let [zero, one, two, three] = [0, 1, 2, 3].map(|bits| node(Op::Constant(bits), 2));
    let sum = node(Op::Add(count, one), 2);
    let last = node(Op::Equal(count, two), 1);
    let next = node(Op::Mux(last, zero, sum), 2);
    let below = node(Op::Below(count, three), 1);
    let is_three = node(Op::Equal(count, three), 1);
    let other = node(Op::Not(is_three), 1);
    let is_one = node(Op::Equal(count, one), 1);
    let not_one = node(Op::Not(is_one), 1);
    let next_below = node(Op::Below(next, three), 1);
    flat.registers = vec![Register {
        width: 2,
        power_on: 0,
        next,
        instance: 0,
    }];
    flat.properties = vec![below, other, not_one, next_below];
    flat
}

fn grounds(basis: Basis, step: usize, with: &[usize]) -> Option<Grounds> {
    let with = with.to_vec();
    Some(Grounds { basis, step, with })
}

fn bit(bit: usize, high: bool) -> StateBit {
    let place = Place::Register(0);
    StateBit { place, bit, high }
}

/// Returns the answer for the first of these properties that has grounds.
fn answer(all: &[Option<Grounds>]) -> Answer {
    let flat = counter();
    let task = Task {
        flat: &flat,
        properties: (0..4).collect(),
        lemmas: Vec::new(),
        givens: Vec::new(),
        memory_bits: 0,
        limit: Duration::from_secs(10),
    };
    let first = all.iter().position(Option::is_some).expect("one has");
    check(&task, all, first).expect("few gates")
}

#[test]
fn right_proofs_are_confirmed() {
    let three = vec![bit(0, true), bit(1, true)];
    let right = [
        vec![grounds(Basis::Induction(1), 1, &[])],
        vec![None, grounds(Basis::Induction(2), 1, &[])],
        vec![None, grounds(Basis::Search(vec![three]), 1, &[])],
        vec![
            None,
            grounds(Basis::Search(Vec::new()), 2, &[3]),
            None,
            grounds(Basis::Induction(1), 1, &[]),
        ],
    ];
    // The last relies on a property that says nothing of this tick.
    let answers = right.map(|all| answer(&all));
    assert_eq!(answers[..3], [Answer::Impossible; 3]);
    assert_eq!(answers[3], Answer::Possible);
    let relies = [
        grounds(Basis::EveryState, 2, &[1]),
        grounds(Basis::Induction(1), 1, &[]),
    ];
    assert_eq!(answer(&relies), Answer::Possible);
}

#[test]
fn wrong_proofs_are_refused() {
    let [zero, one, three] = [0, 1, 3].map(|word: usize| {
        let bits = [0, 1].map(|at| bit(at, word >> at & 1 == 1));
        bits.to_vec()
    });
    let wrong = [
        // Three violates it.
        vec![grounds(Basis::EveryState, 0, &[])],
        // Its start violates it in tick 1.
        vec![None, None, grounds(Basis::Induction(2), 1, &[])],
        // Zero leads to one.
        vec![None, None, grounds(Basis::Induction(1), 1, &[])],
        vec![
            None,
            None,
            grounds(Basis::Search(vec![one.clone()]), 1, &[]),
        ],
        // The state at power-on is excluded.
        vec![grounds(Basis::Search(vec![zero, three.clone()]), 1, &[])],
        // An invariant from which the property does not follow.
        vec![grounds(Basis::Search(Vec::new()), 1, &[])],
        vec![grounds(Basis::Search(vec![one]), 1, &[])],
        // Nothing proves the property that it relies on.
        vec![grounds(Basis::Search(Vec::new()), 1, &[1])],
        // Each relies on the other.
        vec![
            grounds(Basis::Search(Vec::new()), 1, &[1]),
            grounds(Basis::Search(Vec::new()), 1, &[0]),
        ],
        // Another induction is not one with this.
        vec![
            grounds(Basis::Induction(1), 1, &[1]),
            grounds(Basis::Induction(2), 1, &[]),
        ],
    ];
    for (index, all) in wrong.iter().enumerate() {
        assert_eq!(answer(all), Answer::Possible, "case {index}");
    }
}
