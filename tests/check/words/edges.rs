//! Words of 63 and 64 bits: random values and the ends of the range.

use super::{wrap, wrap_signed};
use motion_rtl::logic::sim::{Int, UInt};
use motion_rtl::logic::{Signed, Unsigned};
use proptest::prelude::*;

/// Any number, the ends of the ranges more often.
fn number() -> impl Strategy<Value = u64> {
    let ends = [0u64, 1, 2, 1 << 31, 1 << 32, 1 << 62, 1 << 63];
    let near = (prop::sample::select(ends.to_vec()), 0..3u64);
    prop_oneof![
        any::<u64>(),
        near.prop_map(|(end, off)| end.wrapping_sub(off))
    ]
}

fn unsigned<const N: usize>(a: u64, b: u64, bits: usize) {
    let (x, y) = (UInt::<N>::from(a), UInt::<N>::from(b));
    let (a, b) = (i128::from(a) % (1 << N), i128::from(b) % (1 << N));
    assert_eq!(i128::from(x.get()), a);
    assert_eq!((x + y).get(), wrap(a + b, N));
    assert_eq!((x - y).get(), wrap(a - b, N));
    assert_eq!((x + b as u64).get(), wrap(a + b, N));
    assert_eq!((x - b as u64).get(), wrap(a - b, N));
    assert_eq!((!x).get(), wrap(-1 - a, N));
    assert_eq!(
        ((x & y).get(), (x | y).get()),
        (wrap(a & b, N), wrap(a | b, N))
    );
    assert_eq!((x ^ y).get(), wrap(a ^ b, N));
    assert_eq!((x.below(y).get(), x.equals(y).get()), (a < b, a == b));
    assert_eq!(x.signed().get(), wrap_signed(a, N));
    assert_eq!(x.bit(bits).get(), a >> bits & 1 == 1);
    assert_eq!(x.shift_right(bits).get(), wrap(a >> bits, N));
    // Bits that leave the word at the top would leave the oracle's too.
    let low = if bits < N { a % (1 << (N - bits)) } else { 0 };
    assert_eq!(x.shift_left(bits).get(), wrap(low << bits, N));
    let product = a as u128 * b as u128;
    assert_eq!(x.times::<N, N>(y).get(), (product % (1 << N)) as u64);
    assert_eq!(x.times::<N, 7>(y).get(), (product % (1 << 7)) as u64);
    assert_eq!(x.resize::<1>().get(), wrap(a, 1));
    assert_eq!(x.join::<N, N>(y), y, "nothing is left of the upper word");
    let one = UInt::<1>::from(b as u64);
    assert_eq!(
        one.join::<63, 64>(x.resize()).get(),
        wrap(((b & 1) << 63) | (a % (1 << 63)), 64)
    );
    assert_eq!(
        x.resize::<63>().join::<1, 64>(one).get(),
        wrap(((a % (1 << 63)) << 1) | (b & 1), 64)
    );
}

fn signed<const N: usize>(a: u64, b: u64, bits: usize) {
    let (x, y) = (Int::<N>::from(a as i64), Int::<N>::from(b as i64));
    let (a, b) = (wrap_signed(a.into(), N), wrap_signed(b.into(), N));
    assert_eq!((x.get(), y.get()), (a, b));
    let (a, b) = (i128::from(a), i128::from(b));
    assert_eq!((x + y).get(), wrap_signed(a + b, N));
    assert_eq!((x - y).get(), wrap_signed(a - b, N));
    assert_eq!((x + b as i64).get(), wrap_signed(a + b, N));
    assert_eq!((x - b as i64).get(), wrap_signed(a - b, N));
    assert_eq!((-x).get(), wrap_signed(-a, N));
    assert_eq!((x.below(y).get(), x.equals(y).get()), (a < b, a == b));
    assert_eq!(x.is_negative().get(), a < 0);
    assert_eq!(i128::from(x.magnitude().get()), a.abs());
    assert_eq!(x.unsigned().get(), wrap(a, N));
    assert_eq!(
        i128::from(x.shift_right(bits).get()),
        a.div_euclid(1 << bits)
    );
    let low = if bits < N {
        a.rem_euclid(1 << (N - bits))
    } else {
        0
    };
    assert_eq!(x.shift_left(bits).get(), wrap_signed(low << bits, N));
    // The product of two words of 64 bits fits the oracle.
    assert_eq!(x.times::<N, N>(y).get(), wrap_signed(a * b, N));
    assert_eq!(x.times::<N, 7>(y).get(), wrap_signed(a * b, 7));
    assert_eq!(x.resize::<1>().get(), wrap_signed(a, 1));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn wide_words(a in number(), b in number(), bits in 0usize..70) {
        unsigned::<63>(a, b, bits);
        unsigned::<64>(a, b, bits);
        signed::<1>(a, b, bits);
        signed::<63>(a, b, bits);
        signed::<64>(a, b, bits);
    }
}

#[test]
fn the_ends_of_the_range() {
    let ends = [
        0,
        1,
        u64::MAX,
        1 << 62,
        1 << 63,
        (1 << 63) - 1,
        (1 << 62) - 1,
    ];
    for a in ends {
        for b in ends {
            for bits in [0, 1, 31, 62, 63, 64, 65] {
                unsigned::<63>(a, b, bits);
                unsigned::<64>(a, b, bits);
                signed::<63>(a, b, bits);
                signed::<64>(a, b, bits);
            }
        }
    }
    assert_eq!(Int::<64>::from(i64::MIN).magnitude().get(), 1 << 63);
    assert_eq!((-Int::<64>::from(i64::MIN)).get(), i64::MIN);
    assert_eq!(UInt::<64>::MAX, u64::MAX);
}
