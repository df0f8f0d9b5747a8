use super::*;

const L: Option<bool> = Some(false);
const H: Option<bool> = Some(true);

fn bit(level: bool) -> Value {
    match level {
        true => Value::HIGH,
        false => Value::HIGH.inverted(1),
    }
}

fn ticks(levels: &[(u32, Option<bool>)]) -> Ticks {
    Ticks::by(levels).unwrap()
}

/// The level of each tick from these changes.
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
    // High at the start, which is no edge; a fall in every tick and a time behind the last.
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
    // An x that is gone at its time, and a pulse without width.
    assert_eq!(
        ticks(&[(0, None), (0, L), (1, H), (2, L), (3, H), (3, L)]).count,
        2
    );
}

#[test]
fn a_clock_that_is_unknown_or_constant_is_none() {
    assert_eq!(
        Ticks::by(&[(0, None), (1, H), (2, L)]),
        Err(Unusable::Unknown(0))
    );
    assert_eq!(
        Ticks::by(&[(0, L), (1, H), (2, None)]),
        Err(Unusable::Unknown(2))
    );
    for constant in [&[][..], &[(0, H)], &[(0, L), (4, L)]] {
        assert_eq!(Ticks::by(constant), Err(Unusable::Constant));
    }
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
    // The value at the fall replaces the one that stood since the rise.
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
