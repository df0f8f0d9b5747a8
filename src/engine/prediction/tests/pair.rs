//! Operations on lines, compared with the same operations on the words of each tick.

use super::super::pair::Line;
use crate::engine::flat::{Node, Op, mask};
use crate::engine::value;
use proptest::prelude::*;

fn width() -> impl Strategy<Value = u8> {
    prop_oneof![3 => 1..=6u8, 1 => 7..=64u8, 1 => 62..=64u8]
}

/// Words that are often small, of either sign.
fn word() -> impl Strategy<Value = u64> {
    prop_oneof![
        0..4u64,
        any::<u64>(),
        (1..6u64).prop_map(u64::wrapping_neg),
        Just(1 << 63)
    ]
}

/// Words that move or are constant.
fn line() -> impl Strategy<Value = (u64, u64)> {
    (word(), prop_oneof![Just(0), word()])
}

fn at(line: Line, tick: u64, width: u8) -> u64 {
    line.value.wrapping_add(line.slope.wrapping_mul(tick)) & mask(width)
}

/// Ticks that are checked of a line.
const TICKS: u64 = 300;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn operations_are_lines_for_as_long_as_they_say(
        kind in 0..17u8,
        (from, wide, by) in (width(), width(), 0..70u8),
        (one, other) in (line(), line()),
    ) {
        let make = |(value, slope): (u64, u64), width| Line { value, slope }.low(width);
        let until = &mut TICKS.clone();
        let a = make(one, from);
        let b = make(other, from);
        let (op, width, line, low) = match kind {
            0 => (Op::Not(0), from, a.not(from), from),
            1 => (Op::Negate(0), from, a.negate(from), from),
            2 => (Op::Add(0, 1), from, a.add(b, from), from),
            3 => (Op::Subtract(0, 1), from, a.subtract(b, from), from),
            4 => (Op::Multiply(0, 1), from, a.multiply(b, from, until), from),
            5 => (Op::And(0, 1), from, a.and(b, from, until), from),
            6 => (Op::Or(0, 1), from, a.or(b, from, until), from),
            7 => (Op::Xor(0, 1), from, a.xor(b, from, until), from),
            8 => (Op::Equal(0, 1), 1, a.equal(b, from, until), from),
            9 => (Op::Below(0, 1), 1, a.below(b, from, until), from),
            10 => (Op::BelowSigned(0, 1), 1, a.below_signed(b, from, until), from),
            11 => (Op::ShiftLeft(0, by), from, a.shift_left(by, from), from),
            12 => (Op::ShiftRight(0, by), from, a.slice(by, from, from, until), from),
            13 => {
                let line = a.shift_right_signed(by, from, from, until);
                (Op::ShiftRightSigned(0, by), from, line, from)
            }
            14 => {
                let low = by % from;
                let width = 1 + wide % (from - low);
                (Op::Slice(0, low), width, a.slice(low, from, width, until), from)
            }
            15 => (Op::ExtendSigned(0), wide, a.extend_signed(from, wide, until), from),
            _ => {
                let (high, low) = (1 + from % 32, 1 + by % 32);
                let (a, b) = (a.low(high), make(other, low));
                let width = high + low;
                (Op::Join(0, 1), width, a.join(b, low, width, until), low)
            }
        };
        let first = match kind {
            0..16 => from,
            _ => width - low,
        };
        let (a, b) = (a.low(first), make(other, low));
        prop_assert!(*until > 0);
        for tick in 0..*until {
            let words = [(at(a, tick, first), first), (at(b, tick, low), low)];
            let node = Node { op, width, instance: 0 };
            let is = value::of(node, |id| words[id as usize]);
            prop_assert_eq!(at(line, tick, width), is, "tick {} of {}", tick, until);
        }
        // Equality ends exactly at a change; so does order if no word wraps.
        if matches!(kind, 8..=10) && *until < TICKS {
            let words = [(at(a, *until, from), from), (at(b, *until, from), from)];
            let is = value::of(Node { op, width, instance: 0 }, |id| words[id as usize]);
            let past = |line: Line| {
                let before = at(line, *until - 1, from);
                let (before, after) = match kind {
                    10 => (value::signed(before, from), value::signed(at(line, *until, from), from)),
                    _ => (before as i64, at(line, *until, from) as i64),
                };
                let slope = value::signed(line.slope, from);
                kind != 8 && i128::from(before) + i128::from(slope) != i128::from(after)
            };
            let wide = from == 64 && kind == 9;
            prop_assert!(wide || is != line.value || past(a) || past(b));
        }
    }
}
