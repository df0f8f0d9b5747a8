//! The quadrature counter against an encoder that turns: by pairs of states, by random walks, at
//! every start.

use super::{In, QuadratureCounter};
use crate::prelude::*;
use crate::trace::LastTicks;
use proptest::prelude::*;

/// Ticks from a level at the pin to the position.
const LATENCY: usize = 3;

/// Returns the channels of an encoder at that quarter of its period.
fn channels(quarter: i64) -> (bool, bool) {
    [(false, false), (true, false), (true, true), (false, true)][quarter.rem_euclid(4) as usize]
}

fn levels((a, b): (bool, bool), clear: bool) -> In<Value> {
    In { a, b, clear }
}

/// Output ports in a tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Out {
    position: i64,
    lost: bool,
    illegal: bool,
}

/// Returns the output ports in every tick.
fn run(width: usize, inputs: impl IntoIterator<Item = In<Value>>) -> Vec<Out> {
    let mut simulator = LastTicks::simulator(&QuadratureCounter { width }).unwrap();
    let mut step = |i| {
        simulator
            .step_with(&i, |now| Out {
                position: now.q.position,
                lost: now.q.lost,
                illegal: now.w.illegal,
            })
            .unwrap()
    };
    inputs.into_iter().map(&mut step).collect()
}

#[test]
fn it_is_proved() {
    let circuit = QuadratureCounter { width: 3 };
    let all = circuit.invariants();
    let outcome = reach(&circuit, &all).run().expect("narrow enough");
    assert!(matches!(outcome, Outcome::Proof(_)), "{outcome}");
}

#[test]
fn every_pair_of_states_counts_what_it_turns() {
    // Previous A and B, present A and B, count, illegal.
    const PAIRS: [(u8, u8, u8, u8, i64, bool); 16] = [
        (0, 0, 0, 0, 0, false),
        (0, 0, 1, 0, 1, false),
        (0, 0, 0, 1, -1, false),
        (0, 0, 1, 1, 0, true),
        (1, 0, 1, 0, 0, false),
        (1, 0, 1, 1, 1, false),
        (1, 0, 0, 0, -1, false),
        (1, 0, 0, 1, 0, true),
        (1, 1, 1, 1, 0, false),
        (1, 1, 0, 1, 1, false),
        (1, 1, 1, 0, -1, false),
        (1, 1, 0, 0, 0, true),
        (0, 1, 0, 1, 0, false),
        (0, 1, 0, 0, 1, false),
        (0, 1, 1, 1, -1, false),
        (0, 1, 1, 0, 0, true),
    ];
    for (a, b, to_a, to_b, count, illegal) in PAIRS {
        let before = levels((a == 1, b == 1), false);
        let after = levels((to_a == 1, to_b == 1), false);
        let at = |tick| if tick < 6 { &before } else { &after };
        let out = run(8, (0..12).map(|tick| at(tick).clone()));
        for (tick, out) in out.iter().enumerate() {
            let counted = tick >= 6 + LATENCY;
            let expected = Out {
                position: if counted { count } else { 0 },
                lost: illegal && counted,
                illegal: illegal && tick == 6 + LATENCY - 1,
            };
            assert_eq!(*out, expected, "{a}{b} to {to_a}{to_b}, tick {tick}");
        }
    }
}

/// From the first sample on every edge counts, and no level does.
#[test]
fn the_first_sample_is_where_it_starts() {
    for start in 0..4 {
        for (first, turn) in (1..6).flat_map(|first| [-1, 1].map(|turn| (first, turn))) {
            let at = |tick| start + if tick < first { 0 } else { turn };
            let out = run(4, (0..12).map(|tick| levels(channels(at(tick)), false)));
            for (tick, out) in (0i64..).zip(&out) {
                let position = if tick < first + 3 { 0 } else { turn };
                assert_eq!(out.position, position, "start {start}, tick {tick}");
                assert!(!out.lost && !out.illegal);
            }
        }
    }
}

#[test]
fn a_reset_begins_anew_whatever_the_level() {
    let counter = QuadratureCounter { width: 8 };
    for start in 0..4 {
        let mut simulator = LastTicks::simulator(&counter).unwrap();
        for tick in 0..20 {
            let i = levels(channels(start + tick.min(7)), false);
            let rst = (10..13).contains(&tick);
            let (position, lost) = simulator
                .step_with_reset(rst, &i, |now| (now.q.position, now.q.lost))
                .unwrap();
            assert!(!lost);
            if tick > 10 {
                assert_eq!(position, 0, "start {start}, tick {tick}");
            }
        }
    }
}

#[test]
fn clear_wins_over_a_count_and_over_an_illegal_step() {
    for (step, tick) in [1, -1, 2]
        .into_iter()
        .flat_map(|step| [(step, 7), (step, 8), (step, 9)])
    {
        // The step is at the pin from tick 6 on, and is decoded in tick 8.
        let at = |now| if now < 6 { 0 } else { step };
        let out = run(8, (0..14).map(|now| levels(channels(at(now)), now == tick)));
        let counted = tick < 8;
        let last = out[13];
        assert_eq!(
            last.position,
            if counted { step % 2 } else { 0 },
            "{step} {tick}"
        );
        assert_eq!(last.lost, counted && step == 2, "{step}, {tick}");
        assert!(!out[tick as usize + 1].lost, "{step}, {tick}");
        assert_eq!(out[tick as usize + 1].position, 0, "{step}, {tick}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// An encoder that turns, dwells and turns back, with jumps and clears now and then.
    #[test]
    fn a_walk_is_counted(
        start in 0..4i64,
        stretches in prop::collection::vec((-1..=1i64, 1..60usize), 1..60),
        jumps in prop::collection::vec(0..2000usize, 0..4),
        clears in prop::collection::vec(0..2000usize, 0..4),
    ) {
        let turns = stretches.iter().flat_map(|&(turn, ticks)| std::iter::repeat_n(turn, ticks));
        let mut at = start;
        let mut walk = vec![start];
        for (tick, turn) in turns.enumerate() {
            at += if jumps.contains(&tick) { 2 } else { turn };
            walk.push(at);
        }
        let inputs = walk
            .iter()
            .enumerate()
            .map(|(tick, &at)| levels(channels(at), clears.contains(&tick)));
        let out = run(6, inputs);
        let (mut position, mut lost) = (0i64, false);
        for (tick, out) in out.iter().enumerate() {
            // Decided in the tick before, from levels two and three ticks before that.
            if let Some(before) = tick.checked_sub(1) {
                let moved = match before.checked_sub(LATENCY) {
                    Some(from) => walk[from + 1] - walk[from],
                    None => 0,
                };
                lost |= moved == 2;
                position += if moved == 2 { 0 } else { moved };
                if clears.contains(&before) {
                    (position, lost) = (0, false);
                }
            }
            let wrapped = (position + 32).rem_euclid(64) - 32;
            prop_assert_eq!((out.position, out.lost), (wrapped, lost), "tick {}", tick);
        }
    }
}
