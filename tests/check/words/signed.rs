//! `Int` at small widths, every value with every other.

use super::{small_widths, wrap, wrap_signed};
use motion_rtl::logic::sim::{Int, Wire};
use motion_rtl::logic::{Bit, Signed, Unsigned};

/// Every word of `N` bits as a number, made from a number that is `beyond` ranges away.
fn words<const N: usize>(beyond: i64) -> impl Iterator<Item = (i128, Int<N>)> {
    let half = 1i64 << (N - 1);
    (-half..half).map(move |value| (value.into(), Int::from(value + (beyond << N))))
}

fn one_operand<const N: usize>() {
    assert_eq!(Int::<N>::default().get(), 0);
    for (a, x) in words::<N>(3).chain(words::<N>(-2)) {
        assert_eq!(i128::from(x.get()), a);
        assert_eq!((-x).get(), wrap_signed(-a, N));
        assert_eq!(x.is_zero().get(), a == 0);
        assert_eq!(x.is_negative().get(), a < 0);
        assert_eq!(i128::from(x.magnitude().get()), a.abs());
        assert_eq!(x.unsigned().get(), wrap(a, N));
        assert_eq!(x.unsigned().signed(), x);
        assert_eq!(x.resize::<3>().get(), wrap_signed(a, 3));
        assert_eq!(x.resize::<64>().get(), wrap_signed(a, 64));
        for bits in 0..2 * N + 1 {
            assert_eq!(x.shift_left(bits).get(), wrap_signed(a << bits, N));
            assert_eq!(
                i128::from(x.shift_right(bits).get()),
                a.div_euclid(1 << bits)
            );
        }
        for far in [63, 64, 65, 127, 128, usize::MAX] {
            assert_eq!(x.shift_left(far).get(), 0);
            assert_eq!(x.shift_right(far).get(), if a < 0 { -1 } else { 0 });
        }
    }
}

fn two_operands<const N: usize>() {
    for (a, x) in words::<N>(0) {
        for (b, y) in words::<N>(0) {
            assert_eq!((x + y).get(), wrap_signed(a + b, N));
            assert_eq!((x - y).get(), wrap_signed(a - b, N));
            assert_eq!(x.equals(y).get(), a == b);
            assert_eq!(x.below(y).get(), a < b);
            assert_eq!(Wire::from(true).mux(x, y), x);
            assert_eq!(Wire::from(false).mux(x, y), y);
        }
        for constant in (-1i64 << N..1i64 << N).chain([i64::MIN, i64::MAX]) {
            assert_eq!(
                (x + constant).get(),
                wrap_signed(a + i128::from(constant), N)
            );
            assert_eq!(
                (x - constant).get(),
                wrap_signed(a - i128::from(constant), N)
            );
        }
    }
}

fn two_widths<const N: usize, const M: usize>() {
    for (a, x) in words::<N>(0) {
        for (b, y) in words::<M>(0) {
            assert_eq!(x.times::<M, 12>(y).get(), wrap_signed(a * b, 12));
            assert_eq!(x.times::<M, 3>(y).get(), wrap_signed(a * b, 3));
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
