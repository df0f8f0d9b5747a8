//! Words of 63 and 64 bits: random values and the ends of the range.

use super::{In, Operations};
use motion_rtl::check::Random;

/// The ends of the ranges, and others.
const ENDS: [u64; 11] = [
    0,
    1,
    2,
    u64::MAX,
    1 << 31,
    1 << 32,
    1 << 62,
    1 << 63,
    (1 << 62) - 1,
    (1 << 62) + 1,
    (1 << 63) - 1,
];

/// Any number, those near the ends more often.
fn number(random: &mut Random) -> u64 {
    let word = random.word();
    match word & 1 {
        0 => random.word(),
        _ => ENDS[(word >> 8) as usize % ENDS.len()].wrapping_sub(word >> 32 & 3),
    }
}

#[test]
fn wide_words() {
    let mut random = Random::new(63);
    for (n, m) in [
        (63, 63),
        (64, 64),
        (63, 64),
        (64, 63),
        (1, 64),
        (64, 1),
        (1, 63),
        (63, 1),
        (32, 32),
    ] {
        let cut = |word: u64, width: usize| word & u64::MAX >> (64 - width);
        let case = |a, b, choose| In {
            a: cut(a, n),
            b: cut(b, m),
            choose,
        };
        let pairs = ENDS.iter().flat_map(|a| ENDS.iter().map(|b| (*a, *b)));
        let ends = pairs.map(|(a, b)| case(a, b, a < b));
        let any = (0..1000).map(|_| {
            let (a, b) = (number(&mut random), number(&mut random));
            case(a, b, random.word() & 1 == 1)
        });
        Operations::new(n, m).hold(ends.chain(any));
    }
}
