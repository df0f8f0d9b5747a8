use super::Sim;
use crate::kernel::{Field, Make, Signals, Visit};
use crate::logic::{Bit, Select, Signed, Unsigned};
use std::fmt;
use std::ops::{Add, BitAnd, BitOr, BitXor, Neg, Not, Sub};

/// One wire: low or high.
///
/// Kept as a word, 0 or 1: where registers stand in memory they are moved in words, and a word of
/// which a byte was just written has to wait for it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Wire(u64);

/// An unsigned word of `N` bits, kept masked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct UInt<const N: usize>(u64);

/// A two's complement word of `N` bits, kept sign-extended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Int<const N: usize>(i64);

impl Wire {
    /// The value.
    #[inline(always)]
    pub fn get(self) -> bool {
        self.0 != 0
    }
}

impl fmt::Debug for Wire {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Wire").field(&self.get()).finish()
    }
}

impl<const N: usize> UInt<N> {
    /// The greatest value.
    pub const MAX: u64 = {
        assert!(N >= 1 && N <= 64, "a word has 1 to 64 bits");
        u64::MAX >> (64 - N)
    };

    /// The value.
    #[inline(always)]
    pub fn get(self) -> u64 {
        self.0
    }
}

impl<const N: usize> Int<N> {
    const SPARE: u32 = {
        assert!(N >= 1 && N <= 64, "a word has 1 to 64 bits");
        64 - N as u32
    };

    /// The value.
    #[inline(always)]
    pub fn get(self) -> i64 {
        self.0
    }
}

impl From<bool> for Wire {
    #[inline(always)]
    fn from(value: bool) -> Self {
        Wire(value.into())
    }
}

impl<const N: usize> From<u64> for UInt<N> {
    #[inline(always)]
    fn from(value: u64) -> Self {
        UInt(value & Self::MAX)
    }
}

impl<const N: usize> From<i64> for Int<N> {
    #[inline(always)]
    fn from(value: i64) -> Self {
        Int(value << Self::SPARE >> Self::SPARE)
    }
}

/// One operator for a word with another word, or with a constant.
macro_rules! operator {
    ($word:ident, $number:ty, $trait:ident, $method:ident, $apply:expr) => {
        impl<const N: usize> $trait for $word<N> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                let apply: fn($number, $number) -> $number = $apply;
                apply(self.0, other.0).into()
            }
        }
    };
    ($word:ident, $number:ty, $trait:ident, $method:ident, $apply:expr, constant) => {
        operator!($word, $number, $trait, $method, $apply);
        impl<const N: usize> $trait<$number> for $word<N> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: $number) -> Self {
                let apply: fn($number, $number) -> $number = $apply;
                apply(self.0, other).into()
            }
        }
    };
}

operator!(UInt, u64, Add, add, u64::wrapping_add, constant);
operator!(UInt, u64, Sub, sub, u64::wrapping_sub, constant);
operator!(UInt, u64, BitAnd, bitand, |a, b| a & b);
operator!(UInt, u64, BitOr, bitor, |a, b| a | b);
operator!(UInt, u64, BitXor, bitxor, |a, b| a ^ b);
operator!(Int, i64, Add, add, i64::wrapping_add, constant);
operator!(Int, i64, Sub, sub, i64::wrapping_sub, constant);

impl<const N: usize> Not for UInt<N> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        (!self.0).into()
    }
}

impl<const N: usize> Neg for Int<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.0.wrapping_neg().into()
    }
}

impl Not for Wire {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Wire(self.0 ^ 1)
    }
}

impl BitAnd for Wire {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Wire(self.0 & other.0)
    }
}

impl BitOr for Wire {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Wire(self.0 | other.0)
    }
}

impl BitXor for Wire {
    type Output = Self;
    #[inline(always)]
    fn bitxor(self, other: Self) -> Self {
        Wire(self.0 ^ other.0)
    }
}

macro_rules! select {
    ($word:ty $(, $n:ident)?) => {
        impl$(<const $n: usize>)? Select<Sim> for $word {
            #[inline(always)]
            fn select(choose: Wire, then: Self, other: Self) -> Self {
                if choose.get() { then } else { other }
            }
        }
    };
}

select!(Wire);
select!(UInt<N>, N);
select!(Int<N>, N);

impl Signals<Sim> for Wire {
    #[inline(always)]
    fn visit<V: Visit<Sim>>(&self, field: &'static Field, visitor: &mut V) {
        visitor.bit(field, *self);
    }
    #[inline(always)]
    fn make<M: Make<Sim>>(field: &'static Field, maker: &mut M) -> Self {
        maker.bit(field)
    }
}

impl<const N: usize> Signals<Sim> for UInt<N> {
    #[inline(always)]
    fn visit<V: Visit<Sim>>(&self, field: &'static Field, visitor: &mut V) {
        visitor.unsigned(field, *self);
    }
    #[inline(always)]
    fn make<M: Make<Sim>>(field: &'static Field, maker: &mut M) -> Self {
        maker.unsigned(field)
    }
}

impl<const N: usize> Signals<Sim> for Int<N> {
    #[inline(always)]
    fn visit<V: Visit<Sim>>(&self, field: &'static Field, visitor: &mut V) {
        visitor.signed(field, *self);
    }
    #[inline(always)]
    fn make<M: Make<Sim>>(field: &'static Field, maker: &mut M) -> Self {
        maker.signed(field)
    }
}

impl Bit<Sim> for Wire {
    #[inline(always)]
    fn mux<T: Select<Sim>>(self, then: T, other: T) -> T {
        T::select(self, then, other)
    }
    #[inline(always)]
    fn word(self) -> UInt<1> {
        UInt(self.0)
    }
}

impl<const N: usize> Unsigned<Sim, N> for UInt<N> {
    #[inline(always)]
    fn equals(self, other: Self) -> Wire {
        (self.0 == other.0).into()
    }
    #[inline(always)]
    fn below(self, other: Self) -> Wire {
        (self.0 < other.0).into()
    }
    #[inline(always)]
    fn bit(self, index: usize) -> Wire {
        (index < N && self.0 >> index & 1 == 1).into()
    }
    #[inline(always)]
    fn resize<const M: usize>(self) -> UInt<M> {
        self.0.into()
    }
    #[inline(always)]
    fn times<const M: usize, const P: usize>(self, other: UInt<M>) -> UInt<P> {
        self.0.wrapping_mul(other.0).into()
    }
    #[inline(always)]
    fn shift_left(self, bits: usize) -> Self {
        if bits < N {
            (self.0 << bits).into()
        } else {
            UInt(0)
        }
    }
    #[inline(always)]
    fn shift_right(self, bits: usize) -> Self {
        if bits < N {
            UInt(self.0 >> bits)
        } else {
            UInt(0)
        }
    }
    #[inline(always)]
    fn join<const M: usize, const P: usize>(self, low: UInt<M>) -> UInt<P> {
        let high = if M < 64 { self.0 << M } else { 0 };
        (high | low.0).into()
    }
    #[inline(always)]
    fn signed(self) -> Int<N> {
        (self.0 as i64).into()
    }
}

impl<const N: usize> Signed<Sim, N> for Int<N> {
    #[inline(always)]
    fn equals(self, other: Self) -> Wire {
        (self.0 == other.0).into()
    }
    #[inline(always)]
    fn below(self, other: Self) -> Wire {
        (self.0 < other.0).into()
    }
    #[inline(always)]
    fn is_negative(self) -> Wire {
        (self.0 < 0).into()
    }
    #[inline(always)]
    fn resize<const M: usize>(self) -> Int<M> {
        self.0.into()
    }
    #[inline(always)]
    fn times<const M: usize, const P: usize>(self, other: Int<M>) -> Int<P> {
        self.0.wrapping_mul(other.0).into()
    }
    #[inline(always)]
    fn shift_left(self, bits: usize) -> Self {
        if bits < N {
            (self.0 << bits).into()
        } else {
            Int(0)
        }
    }
    #[inline(always)]
    fn shift_right(self, bits: usize) -> Self {
        Int(self.0 >> bits.min(63))
    }
    #[inline(always)]
    fn magnitude(self) -> UInt<N> {
        self.0.unsigned_abs().into()
    }
    #[inline(always)]
    fn unsigned(self) -> UInt<N> {
        (self.0 as u64).into()
    }
}
