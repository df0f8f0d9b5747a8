use super::super::flat::{Flat, Instance, Node, Op, Place};
use super::super::random::{Case, Plain, cases};
use super::super::{Engine, Program, Watch};
use super::{InputChange, Replay, Shown};
use proptest::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Shown leaves of a tick, by their index.
type Row = (u64, BTreeMap<usize, u64>);

/// Way to replay.
#[derive(Debug, Clone)]
struct Way {
    /// Ticks before the replay.
    before: u64,
    compiled: bool,
    jumps: bool,
    /// Number of words for rows, at least.
    rows: usize,
    /// Distances between ticks in which the replay stops settled.
    stops: Vec<u64>,
}

fn ways() -> impl Strategy<Value = Way> {
    let stops = prop::collection::vec(prop_oneof![0..4u64, Just(1000)], 1..6);
    (0..4u64, any::<bool>(), any::<bool>(), 0..60usize, stops).prop_map(
        |(before, compiled, jumps, rows, stops)| Way {
            before,
            compiled,
            jumps,
            rows,
            stops,
        },
    )
}

/// Returns the changes of a stimulus that begins in a tick, and the tick after it. The last of
/// several changes of a port in a tick counts.
fn table(case: &Case, first: u64) -> (Vec<InputChange>, u64) {
    let (mut changes, mut tick) = (Vec::<InputChange>::new(), first);
    for hold in &case.stimulus {
        for &(port, word) in &hold.changes {
            changes.retain(|change| (change.tick, change.port) != (tick, port));
            changes.push(InputChange { tick, port, word });
        }
        tick += hold.ticks + 1;
    }
    (changes, tick)
}

/// Compares a replay with every node in every tick: rows, and the state after it.
fn replayed(case: &Case, way: &Way) -> Result<(), TestCaseError> {
    let flat = Arc::new(case.flat.clone());
    let wanted = (0..flat.leaves.len()).filter(|&leaf| case.wanted[leaf]);
    let shown: Vec<usize> = wanted
        .filter(|&leaf| !matches!(flat.leaves[leaf], Place::Word(..)))
        .collect();
    let program = Arc::new(Program::planned(&flat, Watch::Leaves(&shown), &shown));
    let (mut engine, mut plain) = (Engine::new(program), Plain::new(&case.flat));
    for _ in 0..way.before {
        engine.settle();
        engine.edge();
        plain.settle();
        plain.edge();
    }
    if way.compiled {
        prop_assert_eq!(engine.compile(), cfg!(feature = "jit"));
    }

    let (changes, end) = table(case, way.before);
    let mut expected: Vec<Row> = Vec::new();
    let mut words = vec![None; shown.len()];
    for tick in way.before..end {
        for change in changes.iter().filter(|change| change.tick == tick) {
            plain.inputs[change.port] = change.word;
        }
        plain.settle();
        let new = shown.iter().map(|&leaf| plain.leaf(leaf)).enumerate();
        let differ = new.filter(|&(index, word)| words[index].replace(word) != Some(word));
        let row: BTreeMap<usize, u64> = differ.collect();
        if !row.is_empty() && tick > way.before {
            expected.push((tick, row));
        }
        plain.edge();
    }

    let ticks = way.before..end;
    let replay = Replay::with_rows(&engine, &changes, ticks, &shown, way.rows);
    let mut replay = replay.expect("all are watched");
    let mut rows: Vec<Row> = Vec::new();
    let mut stops = way.stops.iter().cycle();
    while !replay.is_over() {
        if replay.settled && way.jumps {
            engine.replay_forward(&mut replay);
        }
        let (from, was_settled) = (replay.tick, replay.settled);
        let stop = from + stops.next().unwrap_or(&0);
        engine.replay(&mut replay, stop, |now| {
            rows.push((now.tick, now.changes().collect()));
        });
        let stop = stop.max(from + u64::from(was_settled));
        let reached = (replay.tick, replay.settled);
        prop_assert_eq!(
            reached,
            if stop < end {
                (stop, true)
            } else {
                (end, false)
            }
        );
    }
    rows.retain(|(tick, _)| *tick > way.before);
    prop_assert_eq!(rows, expected);

    for resets in [false, true, false] {
        engine.settle();
        plain.settle();
        for leaf in 0..flat.leaves.len() {
            prop_assert_eq!(engine.leaf(leaf), Some(plain.leaf(leaf)), "leaf {}", leaf);
        }
        match resets {
            true => {
                engine.reset();
                plain.reset();
            }
            false => {
                engine.edge();
                plain.edge();
            }
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1024))]

    #[test]
    fn a_replay_shows_what_the_nodes_say(case in cases(true), way in ways()) {
        replayed(&case, &way)?;
    }

    #[test]
    fn a_replay_shows_what_the_nodes_say_where_little_is_wanted(
        case in cases(false),
        way in ways(),
    ) {
        replayed(&case, &way)?;
    }

    /// A word of a memory has no mark of its own.
    #[test]
    fn leaves_without_marks_are_found(case in cases(false)) {
        let flat = Arc::new(case.flat.clone());
        let wanted: Vec<usize> = (0..flat.leaves.len()).filter(|&leaf| case.wanted[leaf]).collect();
        let program = Program::planned(&flat, Watch::Leaves(&wanted), &[]);
        for (leaf, place) in flat.leaves.iter().enumerate() {
            let shown = Shown::of(&program.plan().layout, &[leaf]);
            let is_word = matches!(place, Place::Word(..));
            if case.wanted[leaf] || is_word {
                prop_assert_eq!(shown.is_some(), !is_word, "leaf {}", leaf);
            }
        }
    }
}

/// Input port of 8 bits, which two leaves show, and a constant.
fn wire() -> Arc<Program> {
    let node = |op| Node {
        op,
        width: 8,
        instance: 0,
    };
    let flat = Arc::new(Flat {
        inputs: vec![8],
        instances: vec![Instance {
            path: Vec::new(),
            circuit: "wire".to_owned(),
        }],
        nodes: vec![node(Op::Input(0)), node(Op::Constant(7))],
        leaves: vec![Place::Input(0), Place::Node(0), Place::Node(1)],
        ..Flat::default()
    });
    Arc::new(Program::planned(&flat, Watch::Leaves(&[0, 1, 2]), &[]))
}

/// Interpreted and, if there is a compiler, compiled.
fn engines(program: &Arc<Program>) -> [Engine; 2] {
    let mut compiled = Engine::new(program.clone());
    compiled.compile();
    [Engine::new(program.clone()), compiled]
}

fn change(tick: u64, port: usize, word: u64) -> InputChange {
    InputChange { tick, port, word }
}

/// The table of rows is full after each row. The change of tick 5 changes nothing, and ports that
/// do not exist are left out.
#[test]
fn leaves_of_one_word_are_shown_each_by_its_index() {
    let shown = [1, 2, 0, 1, 99];
    let changes = [
        change(1, 0, 3),
        change(2, 0, 4),
        change(5, 0, 4),
        change(6, 1, 5),
        change(7, 1 << 32, 6),
        change(9, 0, 0),
    ];
    for mut engine in engines(&wire()) {
        let replay = Replay::with_rows(&engine, &changes, 0..10, &shown, 0);
        let mut replay = replay.expect("all are watched");
        assert_eq!(replay.rows.len(), 2 + 2 * 3);
        let mut rows = Vec::new();
        engine.replay(&mut replay, u64::MAX, |now| {
            let mut words: Vec<_> = now.changes().collect();
            words.sort_unstable();
            rows.push((now.tick, words));
        });
        let row = |tick, word| (tick, vec![(0, word), (2, word), (3, word)]);
        assert_eq!(rows, [row(1, 3), row(2, 4), row(9, 0)]);
        assert_eq!((replay.tick(), replay.is_settled()), (10, false));
    }
}

#[test]
fn the_last_of_all_ticks_is_replayed() {
    let changes = [change(u64::MAX - 2, 0, 3), change(u64::MAX - 1, 0, 4)];
    for mut engine in engines(&wire()) {
        let replay = Replay::new(&engine, &changes, u64::MAX - 9..u64::MAX, &[0]);
        let mut replay = replay.expect("all are watched");
        let mut rows = Vec::new();
        engine.replay(&mut replay, u64::MAX - 1, |now| rows.push(now.tick));
        assert_eq!(rows, [u64::MAX - 2, u64::MAX - 1]);
        assert!(replay.is_settled());
        engine.replay(&mut replay, u64::MAX, |_| panic!("nothing changes"));
        assert_eq!((replay.tick(), replay.is_settled()), (u64::MAX, false));
    }
}
