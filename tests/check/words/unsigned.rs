//! `UInt` at small widths, every value with every other.

use super::{small_widths, wrap, wrap_signed};
use motion_rtl::logic::sim::{UInt, Wire};
use motion_rtl::logic::{Bit, Signed, Unsigned};

/// Every word of `N` bits as a number, made from a number with `beyond` in the bits above.
fn words<const N: usize>(beyond: u64) -> impl Iterator<Item = (i128, UInt<N>)> {
    (0..1u64 << N).map(move |value| (value.into(), UInt::from(value | beyond << N)))
}

fn one_operand<const N: usize>() {
    assert_eq!(UInt::<N>::MAX, (1 << N) - 1);
    assert_eq!(UInt::<N>::default().get(), 0);
    for (a, x) in words::<N>(0b1011) {
        assert_eq!(i128::from(x.get()), a);
        assert_eq!((!x).get(), wrap(-1 - a, N));
        assert_eq!(x.is_zero().get(), a == 0);
        assert_eq!(x.signed().get(), wrap_signed(a, N));
        assert_eq!(x.signed().unsigned(), x);
        assert_eq!(x.resize::<3>().get(), wrap(a, 3));
        assert_eq!(x.resize::<64>().get(), wrap(a, 64));
        for bits in 0..2 * N + 1 {
            assert_eq!(x.bit(bits).get(), a >> bits & 1 == 1);
            assert_eq!(x.shift_left(bits).get(), wrap(a << bits, N));
            assert_eq!(x.shift_right(bits).get(), wrap(a >> bits, N));
        }
        for far in [63, 64, 65, 127, 128, usize::MAX] {
            assert!(!x.bit(far).get());
            assert_eq!(x.shift_left(far).get(), 0);
            assert_eq!(x.shift_right(far).get(), 0);
        }
    }
}

fn two_operands<const N: usize>() {
    for (a, x) in words::<N>(0) {
        for (b, y) in words::<N>(1) {
            assert_eq!((x + y).get(), wrap(a + b, N));
            assert_eq!((x - y).get(), wrap(a - b, N));
            assert_eq!((x & y).get(), wrap(a & b, N));
            assert_eq!((x | y).get(), wrap(a | b, N));
            assert_eq!((x ^ y).get(), wrap(a ^ b, N));
            assert_eq!(x.equals(y).get(), a == b);
            assert_eq!(x.below(y).get(), a < b);
            assert_eq!(Wire::from(true).mux(x, y), x);
            assert_eq!(Wire::from(false).mux(x, y), y);
        }
        for constant in 0..1u64 << (N + 1) {
            assert_eq!((x + constant).get(), wrap(a + i128::from(constant), N));
            assert_eq!((x - constant).get(), wrap(a - i128::from(constant), N));
        }
        for constant in [u64::MAX, 1 << 63] {
            assert_eq!((x + constant).get(), wrap(a + i128::from(constant), N));
            assert_eq!((x - constant).get(), wrap(a - i128::from(constant), N));
        }
    }
}

fn two_widths<const N: usize, const M: usize>() {
    for (a, x) in words::<N>(0) {
        for (b, y) in words::<M>(0) {
            assert_eq!(x.times::<M, 12>(y).get(), wrap(a * b, 12));
            assert_eq!(x.times::<M, 3>(y).get(), wrap(a * b, 3));
            assert_eq!(x.join::<M, 12>(y).get(), wrap(a << M | b, 12));
            assert_eq!(x.join::<M, 4>(y).get(), wrap(a << M | b, 4));
        }
    }
}

#[test]
fn one() {
    small_widths!(one_operand);
}

#[test]
fn two() {
    small_widths!(two_operands);
}

#[test]
fn of_different_widths() {
    two_widths::<1, 1>();
    two_widths::<1, 6>();
    two_widths::<3, 2>();
    two_widths::<5, 5>();
    two_widths::<6, 3>();
}
