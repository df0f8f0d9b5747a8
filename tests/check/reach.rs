//! Proofs and shortest counterexamples.

use crate::circuits::*;
use motion_rtl::check::{Invariants, Proof, Random, all, reach, require};
use motion_rtl::kernel::{Circuit, Moment, Property, Sample, Simulator};
use motion_rtl::logic::sim::UInt;
use motion_rtl::logic::{Bit, Image, Logic, Unsigned};
use motion_rtl::signals;
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

/// What a search finds as gates and as a simulation.
fn both<C: Circuit>(circuit: &C, invariants: &Invariants<'_, C>, limit: u32) -> String {
    let search = || reach(circuit, invariants).limit(limit);
    let gates = search().run().unwrap().to_string();
    let simulated = search().run_simulated().unwrap().to_string();
    assert_eq!(gates, simulated);
    gates
}

/// Counts up to a number and stays there; one of its properties is wrong about the number.
#[derive(Debug)]
struct Climb(u64);

signals! { struct ClimbReg<L> { count: L::U<4> } }
signals! { struct ClimbNet<L> { top: L::Bit } }

impl Circuit for Climb {
    const NAME: &'static str = "climb";
    const ABOUT: &'static str = "counts up to 9 and stays there";
    type In<L: Logic> = Enable<L>;
    type Reg<L: Logic> = ClimbReg<L>;
    type Net<L: Logic> = ClimbNet<L>;
    fn comb<L: Logic>(&self, q: &ClimbReg<L>, _: &Enable<L>) -> ClimbNet<L> {
        let top = q.count.equals(9.into());
        ClimbNet { top }
    }
    fn next<L: Logic>(&self, q: ClimbReg<L>, w: &ClimbNet<L>, i: &Enable<L>) -> ClimbReg<L> {
        let count = (i.enable & !w.top).mux(q.count + 1, q.count);
        ClimbReg { count }
    }
    fn properties<L: Logic>(
        &self,
        now: &Moment<'_, Self, L>,
        next: &ClimbReg<L>,
    ) -> Vec<Property<L>> {
        let most = next.count.below(self.0.into());
        vec![
            Property::always("it is a digit", &["count"], now.q.count.below(10.into())),
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
        both(&Climb(16), &Invariants::of(&Climb(16)), limit);
    }
    for code in [[0, 3, 0], [1, 1, 1]] {
        let circuit = Lock { code };
        let shut = Invariants::new()
            .always("shut", |now: &Sample<Lock>| {
                require(now.q.right.get() != 3, ["right"], || "open".into())
            })
            .step("never from two to open", |now, next| {
                let opens = now.q.right.get() == 2 && next.right.get() == 3;
                require(!opens, ["right"], || "opens".into())
            });
        assert!(both(&circuit, &shut, 100).contains("never from two to open"));
    }
}

#[test]
fn a_counter_has_as_many_states_as_it_counts() {
    for n in 1..=16 {
        let below = Invariants::new().always("below n", |now: &Sample<Up>| {
            require(now.q.count.get() < n, ["count"], || "too far".into())
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
        let below = Invariants::new().always("below the bound", |now: &Sample<Up>| {
            require(now.q.count.get() < bound, ["count", "last"], || {
                format!("{} ticks", now.tick)
            })
        });
        let outcome = reach(&circuit, &below).run().unwrap();
        assert!(outcome.proof().is_none());
        let found = outcome.counterexample().unwrap();
        assert_eq!(found.tick, bound);
        assert_eq!(found.inputs.len() as u64, bound + 1);
        let steps = &found.inputs[..bound as usize];
        assert!(steps.iter().all(|i| i.enable.get()));
        assert_eq!(found.invariant, "below the bound");
        assert_eq!(found.signals, ["count", "last"]);
        assert_eq!(found.message, format!("{bound} ticks"));
    }
}

#[test]
fn the_lock_is_opened_by_its_code() {
    for code in all::<[UInt<2>; 3]>().unwrap() {
        let code = code.map(|digit| digit.get());
        let circuit = Lock { code };
        let shut = Invariants::new().always("shut", |now: &Sample<Lock>| {
            require(now.q.right.get() < 3, ["right"], || "open".into())
        });
        let found = reach(&circuit, &shut).run().unwrap();
        let found = found.counterexample().unwrap();
        let tried: Vec<_> = found.inputs.iter().map(|i| i.digit.get()).collect();
        assert_eq!(tried[..3], code);
        assert_eq!(tried.len(), 4);
        // States 0 to 3, four digits in each.
        assert_eq!(space(&circuit), proof(4, 16, 3));
    }
}

#[test]
fn the_arbiter_never_grants_twice() {
    let exclusive = Invariants::new().always("exclusive", |now: &Sample<Arbiter>| {
        let [a, b] = now.w.grant;
        require(!(a & b).get(), ["grant0", "grant1"], || "both".into())
    });
    let served = exclusive.step("served", |now: &Sample<Arbiter>, next| {
        let alone = now.w.grant[1].get() != now.w.grant[0].get();
        let right = next.served.get() == now.w.grant[1].get();
        require(!alone || right, ["served"], || "another".into())
    });

    let circuit = Arbiter { flawed: false };
    let outcome = reach(&circuit, &served).run().unwrap();
    assert_eq!(outcome.proof(), Some(proof(2, 8, 1)));

    let flawed = Arbiter { flawed: true };
    let found = reach(&flawed, &served).run().unwrap();
    let found = found.counterexample().unwrap();
    assert_eq!((found.tick, found.invariant.as_str()), (1, "exclusive"));
    let requests: Vec<_> = found
        .inputs
        .iter()
        .map(|i| i.request.map(|r| r.get()))
        .collect();
    // The second is served first: alone, for the flaw shows when both ask a tick later.
    assert_eq!(requests[1], [true, true]);
    assert!(requests[0][1]);
}

#[test]
fn a_step_property_sees_the_registers_after_the_edge() {
    let circuit = Up { n: 5 };
    let held = Invariants::new()
        .step("counts", |now: &Sample<Up>, next| {
            let sum = (now.q.count.get() + u64::from(now.i.enable.get())) % 5;
            require(next.count.get() == sum, ["count"], || "miscounted".into())
        })
        .step("never one", |_, next| {
            require(next.count.get() != 1, ["count"], || "one".into())
        });
    let found = reach(&circuit, &held).run().unwrap();
    let found = found.counterexample().unwrap();
    assert_eq!((found.tick, found.invariant.as_str()), (0, "never one"));
    assert!(found.inputs[0].enable.get());
}

#[test]
fn of_two_violations_the_one_added_first_is_named() {
    let no = |_: &Sample<Up>| require(false, [], || "no".into());
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

/// The length of the shortest input sequence after which `state` is `bad`, by trying all of them.
fn by_brute_force(table: &Table, bad: u64, longest: usize) -> Option<usize> {
    (0..=longest).find(|&length| {
        (0..1u64 << length).any(|choices| {
            let way = |tick: u64, _: &motion_rtl::kernel::Part<'_, _>| Choice {
                way: (choices >> tick & 1 == 1).into(),
            };
            let end = Simulator::new(table)
                .unwrap()
                .run(length as u64, way, ())
                .unwrap();
            end.registers().state.get() == bad
        })
    })
}

#[test]
fn no_counterexample_is_longer_than_need_be() {
    let mut random = Random::new(11);
    let mut lengths = HashSet::new();
    for _ in 0..40 {
        let words: Vec<_> = (0..32).map(|_| random.word()).collect();
        let table = Table(Image::new(words));
        let mut reachable = 0;
        for bad in 0..16 {
            let good = Invariants::new().always("good", |now: &Sample<Table>| {
                require(now.q.state.get() != bad, ["state"], || "bad".into())
            });
            let found = reach(&table, &good).run().unwrap();
            let expected = by_brute_force(&table, bad, 10);
            let length = found.counterexample().map(|found| {
                let inputs = &found.inputs[..found.tick as usize];
                let way =
                    |tick: u64, _: &motion_rtl::kernel::Part<'_, _>| inputs[tick as usize].clone();
                let end = Simulator::new(&table)
                    .unwrap()
                    .run(found.tick, way, ())
                    .unwrap();
                assert_eq!(end.registers().state.get(), bad, "it replays");
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
