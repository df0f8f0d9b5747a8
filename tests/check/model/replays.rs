//! Replays of random inputs, against the same ticks one by one.

use motion_rtl::Model;
use motion_rtl::check::Stimulus;
use motion_rtl::circuits::blocks::EnableCounter;
use motion_rtl::engine::Watch;
use motion_rtl::registry::CATALOGUE;
use motion_rtl::sim::{Elaborated, Handle, InputChange, ReplayTick, Simulator};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

/// Shown signals of a tick, by their index.
type Row = (u64, BTreeMap<usize, u64>);

/// Random changes up to a tick. Inputs are held for up to 16 ticks, and change in the first and
/// the last tick.
fn changes(circuit: &Elaborated, ticks: u64) -> Vec<InputChange> {
    let (mut random, mut engine) = (Stimulus::new(5), circuit.engine(Watch::Leaves(&[])));
    let (mut changes, mut tick) = (Vec::new(), 0);
    let mut words = vec![0; engine.ports()];
    while tick < ticks {
        random.apply(&mut engine);
        for (port, old) in words.iter_mut().enumerate() {
            let word = engine.port(port).unwrap();
            if std::mem::replace(old, word) != word {
                changes.push(InputChange { tick, port, word });
            }
        }
        let next = tick + 1 + words.iter().fold(0, |all, word| all ^ word) % 16;
        tick = if tick + 1 == ticks {
            ticks
        } else {
            next.min(ticks - 1)
        };
    }
    changes
}

fn stepped(model: &mut Model, ticks: u64, changes: &[InputChange], shown: &[Handle]) -> Vec<Row> {
    let mut words = vec![None; shown.len()];
    let mut rows = Vec::new();
    for _ in 0..ticks {
        let tick = model.tick();
        for change in changes.iter().filter(|change| change.tick == tick) {
            let port = model.at(change.port).unwrap();
            model.set_bits(port, change.word).unwrap();
        }
        let mut row = BTreeMap::new();
        for (index, &handle) in shown.iter().enumerate() {
            let word = model.get(handle).unwrap();
            if words[index].replace(word) != Some(word) {
                row.insert(index, word);
            }
        }
        if !row.is_empty() {
            rows.push((tick, row));
        }
        model.step();
    }
    rows
}

fn replayed(model: &mut Model, ticks: u64, changes: &[InputChange], shown: &[Handle]) -> Vec<Row> {
    let mut rows = Vec::new();
    let take = |now: ReplayTick<'_>| {
        rows.push((now.tick, now.changes().collect()));
    };
    model.replay(ticks, changes, shown, take).unwrap();
    rows
}

/// Registers and words of memories.
fn state(model: &mut Model) -> Vec<u64> {
    let signals = model.signals();
    let words = signals.iter().map(|signal| model.get(signal.handle));
    words.collect::<Result<_, _>>().unwrap()
}

/// Three replays of one table: before a reset, after it, and again from a snapshot. In the second
/// one, compiled code runs if there is a compiler.
#[test]
fn every_circuit_is_replayed_as_it_is_stepped() {
    CATALOGUE.par_iter().for_each(|entry| {
        let circuit = entry.small().model().unwrap();
        let changes = changes(&circuit, 400);
        let model = Model::of(&circuit).unwrap();
        let signals = model.signals();
        let ports: Vec<Handle> = circuit
            .ports_out()
            .into_iter()
            .map(|leaf| signals[leaf].handle)
            .collect();
        let all: Vec<Handle> = signals.iter().map(|signal| signal.handle).collect();
        let marked: Vec<Handle> = signals
            .iter()
            .filter(|signal| !signal.path.ends_with(']'))
            .map(|signal| signal.handle)
            .collect();
        for shown in [ports, marked, all] {
            let name = format!("{}, {} signals", entry.name, shown.len());
            let mut one = Model::of(&circuit).unwrap();
            one.watch(&shown).unwrap();
            let mut other = one.clone();
            let first = stepped(&mut one, 150, &changes, &shown);
            let rows = replayed(&mut other, 150, &changes, &shown);
            assert!(rows == first, "{name}: first part");
            one.reset();
            other.reset();
            let then = other.snapshot();
            let second = stepped(&mut one, 249, &changes, &shown);
            let rows = replayed(&mut other, 249, &changes, &shown);
            assert!(rows == second, "{name}: second part");
            assert_eq!((one.tick(), other.tick()), (400, 400), "{name}");
            assert!(state(&mut one) == state(&mut other), "{name}: state");
            other.restore(&then).unwrap();
            // Long enough that it pays to compile; then from the snapshot on.
            other.run(20_000);
            other.restore(&then).unwrap();
            let rows = replayed(&mut other, 249, &changes, &shown);
            assert!(rows == second, "{name}: from the snapshot");
            assert!(state(&mut one) == state(&mut other), "{name}: state");
        }
    });
}

/// Idle ticks, with all output ports and with a counter that moves in them.
#[test]
fn a_fast_replay_shows_every_change_of_ports() {
    let key = ["width=20".parse().unwrap()];
    let mut model = Model::new("enable_counter", &key).unwrap();
    let [period, enable, count] =
        ["period", "enable", "count"].map(|name| model.find(name).unwrap());
    let change = |tick, word| InputChange {
        tick,
        port: period.index(),
        word,
    };
    let changes = [
        change(0, 1000),
        change(4500, 3),
        change(5000, 90_000),
        change(199_999, 1),
    ];
    let mut other = model.clone();
    let all = replayed(&mut other, 200_000, &changes, &[enable]);
    let mut rows: Vec<Row> = Vec::new();
    let mut counts = Vec::new();
    model
        .fast_replay(200_000, &changes, &[enable, count], |now| {
            let mut row: BTreeMap<usize, u64> = now.changes().collect();
            counts.extend(row.remove(&1));
            if !row.is_empty() {
                rows.push((now.tick, row));
            }
        })
        .unwrap();
    assert!(all == rows);
    assert!((2..20_000).contains(&counts.len()), "{}", counts.len());
    assert!(state(&mut model) == state(&mut other));
}

/// A function that receives each tick receives those of a replay, with what is shown in them.
#[test]
fn each_tick_of_a_replay_is_received() {
    let circuit = EnableCounter { width: 8 };
    let mut counter = Simulator::new(&circuit).unwrap();
    let (seen, enable) = (Arc::new(Mutex::new(Vec::new())), counter.signals().w.enable);
    let to = seen.clone();
    counter.each_tick(move |now| {
        to.lock()
            .unwrap()
            .push((now.tick, u64::from(now.get(enable))))
    });
    let change = InputChange {
        tick: 2,
        port: 0,
        word: 3,
    };
    let mut shown = Vec::new();
    let see = |now: ReplayTick<'_>| {
        shown.extend(now.changes().map(|(_, word)| (now.tick, word)));
    };
    counter
        .fast_replay(7, &[change], &[enable.leaf()], see)
        .unwrap();
    let received = seen.lock().unwrap().clone();
    assert_eq!(received.len(), 7);
    let mut last = None;
    let differ = |(_, word): &(u64, u64)| last.replace(*word) != Some(*word);
    let changed: Vec<_> = received.into_iter().filter(differ).collect();
    assert_eq!(shown, changed);
    assert_eq!(counter.tick(), 7);
}
