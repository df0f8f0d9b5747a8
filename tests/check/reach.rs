//! Proofs and shortest counterexamples.

use crate::circuits::*;
use motion_rtl::check::{Proof, Random};
use motion_rtl::prelude::*;
use motion_rtl::sim::{Sample, State};
use std::collections::{BTreeSet, HashSet};

pub fn proof(states: u64, transitions: u64, depth: u64) -> Proof {
    Proof {
        states,
        transitions,
        depth,
        dead_ends: 0,
    }
}

/// The proof that a search without invariants ends in.
fn space<C: Circuit>(circuit: &C) -> Proof {
    let none = Invariants::new();
    reach(circuit, &none).run().unwrap().proof().unwrap()
}

/// Result of a search, which gates and simulation agree on.
fn both<C: Circuit>(circuit: &C, invariants: &Invariants<'_, C>, limit: u32) -> String {
    let search = || reach(circuit, invariants).limit(limit);
    let gates = search().run().unwrap().to_string();
    let simulated = search().run_simulated().unwrap().to_string();
    assert_eq!(gates, simulated);
    gates
}

/// Counts up to a number and stays there; one of its properties is wrong about the number.
#[derive(Debug, Clone)]
struct Climb(u64);

signals! { for Climb as _c;
    struct ClimbIn { enable: Bit }
    struct ClimbReg { count: U(4) }
    struct ClimbNet { top: Bit }
}

impl Circuit for Climb {
    const NAME: &'static str = "climb";
    const ABOUT: &'static str = "counts up to 9 and stays there";
    records!(ClimbIn, ClimbReg, ClimbNet);
    fn tick(&self, i: ClimbIn, q: ClimbReg, _: Nothing) -> (ClimbNet, ClimbReg<Edge>) {
        let top = q.count.equals(9);
        let count = (i.enable & !top).mux(q.count + 1, q.count);
        (ClimbNet { top }, ClimbReg { count })
    }
    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let most = now.next.q.count.below(self.0);
        vec![
            Property::always("it is a digit", &["count"], now.q.count.below(10)),
            Property::step("it stays below", &["count", "top"], most),
        ]
    }
}

#[test]
fn gates_and_simulation_find_the_same() {
    for below in 0..12 {
        let circuit = Climb(below);
        let found = both(&circuit, &Invariants::of(&circuit), 100);
        assert_eq!(found.contains("proved"), below >= 10, "{found}");
        assert_eq!(found.contains("it stays below"), below < 10, "{found}");
    }
    for limit in 1..30 {
        both(&Store, &Invariants::new(), limit);
        both(&Climb(15), &Invariants::of(&Climb(15)), limit);
    }
    for code in [[0, 3, 0], [1, 1, 1]] {
        let circuit = Lock { code };
        let shut = Invariants::new()
            .always("shut", |now: &Sample<'_, Lock>| {
                require(now.q.right != 3, ["right"], || "open".into())
            })
            .step("never from two to open", |now, next| {
                let opens = now.q.right == 2 && next.q.right == 3;
                require(!opens, ["right"], || "opens".into())
            });
        assert!(both(&circuit, &shut, 100).contains("never from two to open"));
    }
}

#[test]
fn a_counter_has_as_many_states_as_it_counts() {
    for n in 1..=16 {
        let below = Invariants::new().always("below n", |now: &Sample<'_, Up>| {
            require(now.q.count < n, ["count"], || "too far".into())
        });
        let circuit = Up { n };
        let outcome = reach(&circuit, &below).run().unwrap();
        assert_eq!(outcome.proof(), Some(proof(n, 2 * n, n - 1)));
    }
}

#[test]
fn a_violation_is_found_on_its_first_tick() {
    let circuit = Up { n: 9 };
    for bound in 0..9 {
        let below = Invariants::new().always("below the bound", |now: &Sample<'_, Up>| {
            require(now.q.count < bound, ["count", "last"], || {
                format!("{} ticks", now.tick)
            })
        });
        let outcome = reach(&circuit, &below).run().unwrap();
        assert!(outcome.proof().is_none());
        let found = outcome.counterexample().unwrap();
        assert_eq!(found.tick, bound);
        assert_eq!(found.inputs.len() as u64, bound + 1);
        let steps = &found.inputs[..bound as usize];
        assert!(steps.iter().all(|i| i.enable));
        assert_eq!(found.invariant, "below the bound");
        assert_eq!(found.signals, ["count", "last"]);
        assert_eq!(found.message, format!("{bound} ticks"));
    }
}

#[test]
fn the_lock_is_opened_by_its_code() {
    for number in 0..64 {
        let code = [number & 3, number >> 2 & 3, number >> 4];
        let circuit = Lock { code };
        let shut = Invariants::new().always("shut", |now: &Sample<'_, Lock>| {
            require(now.q.right < 3, ["right"], || "open".into())
        });
        let found = reach(&circuit, &shut).run().unwrap();
        let found = found.counterexample().unwrap();
        let tried: Vec<_> = found.inputs.iter().map(|i| i.digit).collect();
        assert_eq!(tried[..3], code);
        assert_eq!(tried.len(), 4);
        // States 0 to 3, four digits in each.
        assert_eq!(space(&circuit), proof(4, 16, 3));
    }
}

#[test]
fn the_arbiter_never_grants_twice() {
    let exclusive = Invariants::new().always("exclusive", |now: &Sample<'_, Arbiter>| {
        let both = now.w.grant[0] && now.w.grant[1];
        require(!both, ["grant0", "grant1"], || "both".into())
    });
    let served = exclusive.step("served", |now: &Sample<'_, Arbiter>, next| {
        let alone = now.w.grant[1] != now.w.grant[0];
        let right = next.q.served == now.w.grant[1];
        require(!alone || right, ["served"], || "another".into())
    });

    let circuit = Arbiter { flawed: false };
    let outcome = reach(&circuit, &served).run().unwrap();
    assert_eq!(outcome.proof(), Some(proof(2, 8, 1)));

    let flawed = Arbiter { flawed: true };
    let found = reach(&flawed, &served).run().unwrap();
    let found = found.counterexample().unwrap();
    assert_eq!((found.tick, found.invariant.as_str()), (1, "exclusive"));
    let requests: Vec<_> = found.inputs.iter().map(|i| &i.request[..]).collect();
    // The second is served first: alone, for the flaw shows when both ask a tick later.
    assert_eq!(requests[1], [true, true]);
    assert!(requests[0][1]);
}

#[test]
fn a_step_property_sees_the_registers_after_the_edge() {
    let circuit = Up { n: 5 };
    let held = Invariants::new()
        .step("counts", |now: &Sample<'_, Up>, next| {
            let sum = (now.q.count + u64::from(now.i.enable)) % 5;
            require(next.q.count == sum, ["count"], || "miscounted".into())
        })
        .step("never one", |_, next| {
            require(next.q.count != 1, ["count"], || "one".into())
        });
    let found = reach(&circuit, &held).run().unwrap();
    let found = found.counterexample().unwrap();
    assert_eq!((found.tick, found.invariant.as_str()), (0, "never one"));
    assert!(found.inputs[0].enable);
}

#[test]
fn of_two_violations_the_one_added_first_is_named() {
    let no = |_: &Sample<'_, Up>| require(false, [], || "no".into());
    let both = Invariants::new().always("first", no).always("second", no);
    assert_eq!(both.names().collect::<Vec<_>>(), ["first", "second"]);
    let circuit = Up { n: 2 };
    let found = reach(&circuit, &both).run().unwrap().counterexample();
    assert_eq!(found.unwrap().invariant, "first");
}

/// The RAM circuit again, on plain numbers: two words and the output register.
fn store_states() -> (BTreeSet<[u8; 3]>, u64) {
    let mut seen = BTreeSet::from([[0, 0, 2]]);
    let mut layer = seen.clone();
    let mut depth = 0;
    loop {
        let mut new = BTreeSet::new();
        for &[low, high, out] in &layer {
            for (write, read, address, data) in
                (0..32u8).map(|i| (i & 1, i >> 1 & 1, i >> 2 & 1, i >> 3))
            {
                let mut words = [low, high];
                let out = if read == 1 {
                    words[usize::from(address)]
                } else {
                    out
                };
                if write == 1 && data != 3 {
                    words[usize::from(address)] = data;
                }
                new.insert([words[0], words[1], out]);
            }
        }
        layer = new.difference(&seen).copied().collect();
        if layer.is_empty() {
            return (seen, depth);
        }
        seen.extend(&layer);
        depth += 1;
    }
}

#[test]
fn the_words_of_a_ram_are_part_of_the_state() {
    let (states, depth) = store_states();
    let expected = proof(states.len() as u64, 32 * states.len() as u64, depth);
    assert_eq!(space(&Store), expected);
    // Three values in three places.
    assert_eq!(expected.states, 27);
}

#[test]
#[ignore = "takes long"]
fn bitmap_and_hash_set_see_the_same() {
    let none = Invariants::new();
    let hashed = reach(&Store, &none).bitmap_bits(0).run().unwrap();
    assert_eq!(hashed.proof(), Some(space(&Store)));

    // Every state but zero is on the one cycle.
    let length = (1 << 20) - 1;
    let expected = Some(proof(length, 2 * length, length - 1));
    let none = Invariants::new();
    for bits in [0, 19, 20, 32] {
        let outcome = reach(&Noise, &none).bitmap_bits(bits).run().unwrap();
        assert_eq!(outcome.proof(), expected, "bitmap up to {bits} bits");
    }
}

/// The state after so many ticks.
fn state_after(table: &Table, ticks: u64, way: impl Fn(u64) -> bool) -> u64 {
    let mut simulator = Simulator::new(table).unwrap();
    let way = |tick, _: &State<'_, Table>| Choice { way: way(tick) };
    simulator.run(ticks, way, ()).unwrap();
    simulator.registers().q.state
}

/// The length of the shortest input sequence after which `state` is `bad`, by trying all of them.
fn by_brute_force(table: &Table, bad: u64, longest: usize) -> Option<usize> {
    (0..=longest).find(|&length| {
        (0..1u64 << length).any(|choices| {
            let way = |tick| choices >> tick & 1 == 1;
            state_after(table, length as u64, way) == bad
        })
    })
}

#[test]
#[ignore = "takes long"]
fn no_counterexample_is_longer_than_need_be() {
    let mut random = Random::new(11);
    let mut lengths = HashSet::new();
    for _ in 0..40 {
        let words: Vec<_> = (0..32).map(|_| random.word().cut(4)).collect();
        let table = Table(Image::of(5, 4, words));
        let mut reachable = 0;
        for bad in 0..16 {
            let good = Invariants::new().always("good", |now: &Sample<'_, Table>| {
                require(now.q.state != bad, ["state"], || "bad".into())
            });
            let found = reach(&table, &good).run().unwrap();
            let expected = by_brute_force(&table, bad, 10);
            let length = found.counterexample().map(|found| {
                let way = |tick| found.inputs[tick as usize].way;
                assert_eq!(state_after(&table, found.tick, way), bad, "it replays");
                found.tick as usize
            });
            if length.is_none_or(|length| length <= 10) {
                assert_eq!(length, expected);
            } else {
                assert_eq!(expected, None);
            }
            reachable += u64::from(length.is_some());
            lengths.extend(length);
        }
        assert_eq!(space(&table).states, reachable);
    }
    assert!(lengths.len() > 5, "the tables are too easy: {lengths:?}");
}
