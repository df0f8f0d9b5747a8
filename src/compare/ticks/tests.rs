use super::*;

const L: Option<bool> = Some(false);
const H: Option<bool> = Some(true);

fn bit(level: bool) -> Value {
    match level {
        true => Value::HIGH,
        false => Value::HIGH.inverted(1),
    }
}

/// Returns the ticks, with each time equal to its index.
fn by(levels: &[(u32, Option<bool>)], gaps: &[Gap]) -> Result<Ticks, Unusable> {
    Ticks::by(levels, &(0..100).collect::<Vec<_>>(), gaps)
}

fn ticks(levels: &[(u32, Option<bool>)]) -> Ticks {
    by(levels, &[]).unwrap()
}

/// Returns the level in each tick from these changes.
fn sampled(levels: &[(u32, Option<bool>)], changes: &[(u32, bool)]) -> Vec<(u64, bool)> {
    let changes: Vec<_> = changes
        .iter()
        .map(|&(at, level)| (at, bit(level)))
        .collect();
    let samples = ticks(levels).sample(&changes);
    samples
        .iter()
        .map(|&(tick, value)| (tick, value == Value::HIGH))
        .collect()
}

#[test]
fn every_tick_of_our_own_dumps_is_one() {
    // High at the start, which is no edge; a fall in every tick and a time after the last.
    assert_eq!(ticks(&[(0, H), (1, L)]).count, 1);
    assert_eq!(
        ticks(&[(0, H), (1, L), (2, H), (3, L), (4, H), (5, L)]).count,
        3
    );
}

#[test]
fn a_tick_that_is_not_over_is_none() {
    assert_eq!(ticks(&[(0, L), (1, H)]).count, 1);
    assert_eq!(ticks(&[(0, L), (1, H), (2, L)]).count, 2);
    assert_eq!(ticks(&[(0, H), (1, L), (2, H)]).count, 1);
}

#[test]
fn within_a_time_the_last_level_counts() {
    // An x that is gone within its time, and a pulse without width.
    assert_eq!(
        ticks(&[(0, None), (0, L), (1, H), (2, L), (3, H), (3, L)]).count,
        2
    );
}

#[test]
fn a_clock_that_is_unknown_or_constant_is_none() {
    for unknown in [[(0, L), (1, H), (2, None)], [(0, None), (1, L), (2, None)]] {
        assert_eq!(by(&unknown, &[]), Err(Unusable::Unknown(2)));
    }
    for constant in [
        &[][..],
        &[(0, H)],
        &[(0, L), (4, L)],
        &[(0, None), (1, L)],
        &[(0, None)],
    ] {
        assert_eq!(by(constant, &[]), Err(Unusable::Constant));
    }
}

#[test]
fn an_edge_may_come_from_what_was_not_yet_set() {
    assert_eq!(ticks(&[(0, None), (2, L), (5, H), (7, L)]).count, 2);
    // A simulator samples at an edge from x to 1.
    let clock = [(0, None), (2, H), (3, L), (4, H), (5, L)];
    assert_eq!(ticks(&clock).count, 3);
    assert_eq!(
        sampled(&clock, &[(0, false), (2, true), (4, false)]),
        [(0, false), (1, true), (2, false)]
    );
    assert_eq!(ticks(&[(0, None), (0, H), (3, L), (4, H)]).count, 1);
}

/// Returns ticks with edges at 2, 4, 6 and so on, switched off in a part.
fn gapped(off: u64, on: Option<u64>, end: u64) -> Result<Ticks, Unusable> {
    let gap = Gap { from: off, to: on };
    let mut levels = Vec::new();
    for at in 0..end {
        let level = (at % 2 == 0 && at > 0).then_some(true).or(L);
        if !gap.contains(at) {
            levels.push((at as u32, level));
        } else if at == off {
            levels.push((at as u32, None));
        }
    }
    by(&levels, &[gap])
}

#[test]
fn ticks_without_a_dump_are_counted_by_the_period() {
    for off in 5..=14 {
        for on in off + 1..=16 {
            let ticks = gapped(off, Some(on), 20).unwrap();
            assert_eq!(ticks.count, 10, "{off} to {on}");
            // Tick n ends at 2n + 2: it is unknown if that is in the gap.
            let unknown = (0..10).filter(|tick| (off..on).contains(&(2 * tick + 2)));
            // When the dump is switched on, the level is a first one, and no edge.
            let unknown = unknown.chain((on % 2 == 0).then(|| on / 2 - 1));
            let unknown: Vec<u64> = unknown.collect();
            let known: Vec<u64> = ticks.off.iter().cloned().flatten().collect();
            assert_eq!(known, unknown, "{off} to {on}");
        }
    }
}

#[test]
fn a_dump_that_stays_off_ends_with_the_last_edge_before() {
    for off in 5..=14 {
        let ticks = gapped(off, None, 20).unwrap();
        assert_eq!((ticks.count, ticks.off.len()), ((off - 1) / 2, 0), "{off}");
    }
    // On again after the last edge.
    assert_eq!(gapped(15, Some(19), 20).unwrap().count, 7);
    // Off from the start: the first tick is the first in the dump.
    let ticks = gapped(0, Some(9), 20).unwrap();
    assert_eq!((ticks.count, ticks.off.len()), (6, 0));
}

#[test]
fn edges_that_nothing_tells_of_are_an_error() {
    let gap = [Gap {
        from: 5,
        to: Some(9),
    }];
    // A period of 2 before, and 7 between: no whole number of periods.
    let clock = [(0, L), (2, H), (3, L), (4, H), (5, None), (9, L), (11, H)];
    assert_eq!(by(&clock, &gap), Err(Unusable::Uncounted(4, 11)));
    // One edge on each side.
    let clock = [(0, L), (4, H), (5, None), (9, L), (12, H)];
    assert_eq!(by(&clock, &gap), Err(Unusable::Uncounted(4, 12)));
    // The period after the gap suffices.
    let clock = [(0, L), (4, H), (5, None), (9, L), (12, H), (13, L), (16, H)];
    assert_eq!(by(&clock, &gap).unwrap().count, 4);
}

#[test]
fn what_changes_with_the_edge_belongs_to_the_tick_that_begins() {
    let clock = [(0, L), (2, H), (3, L), (4, H), (5, L)];
    assert_eq!(
        sampled(&clock, &[(0, false), (2, true), (4, false)]),
        [(0, false), (1, true), (2, false)]
    );
}

#[test]
fn inputs_at_the_falling_edge_belong_to_the_tick_that_the_next_rise_ends() {
    let clock = [(0, H), (1, L), (2, H), (3, L), (4, H), (5, L)];
    // The value at the fall replaces the one since the rise.
    assert_eq!(
        sampled(&clock, &[(0, false), (1, true), (3, false)]),
        [(0, true), (1, false)]
    );
    let low = [(0, L), (1, H), (2, L), (3, H)];
    assert_eq!(
        sampled(&low, &[(0, false), (2, true)]),
        [(0, false), (1, true)]
    );
}

#[test]
fn what_changes_in_a_tick_that_is_not_over_is_left_out() {
    let clock = [(0, L), (1, H), (2, L), (3, H)];
    assert_eq!(sampled(&clock, &[(0, true), (3, false)]), [(0, true)]);
}
