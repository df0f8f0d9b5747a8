use super::{Element, Lanes};
use crate::kernel::{Field, Make, Signals, Visit};
use crate::logic::{Bit, Select, Signed, Unsigned};
use std::array::from_fn;
use std::ops::{Add, BitAnd, BitOr, BitXor, Neg, Not, Sub};

/// A wire in every lane: all ones or zero.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(16))]
pub struct LaneBit<const K: usize, E>([E; K]);

/// An unsigned word of `N` bits in every lane, kept masked.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(16))]
pub struct LaneUInt<const K: usize, E, const N: usize>([E; K]);

/// A two's complement word of `N` bits in every lane, kept sign-extended.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(16))]
pub struct LaneInt<const K: usize, E, const N: usize>([E; K]);

#[inline(always)]
fn one<const K: usize, E: Element>(a: [E; K], apply: impl Fn(E) -> E) -> [E; K] {
    from_fn(|k| apply(a[k]))
}

#[inline(always)]
fn two<const K: usize, E: Element>(a: [E; K], b: [E; K], apply: impl Fn(E, E) -> E) -> [E; K] {
    from_fn(|k| apply(a[k], b[k]))
}

impl<const K: usize, E: Element> LaneBit<K, E> {
    /// The value in lane `k`.
    #[inline(always)]
    pub fn get(self, k: usize) -> bool {
        self.0[k] != E::low(0)
    }

    /// A wire from the value in each lane.
    #[inline(always)]
    pub fn each(value: impl Fn(usize) -> bool) -> Self {
        LaneBit(from_fn(|k| E::low(if value(k) { u64::MAX } else { 0 })))
    }
}

impl<const K: usize, E: Element, const N: usize> LaneUInt<K, E, N> {
    const WIDTH: usize = {
        assert!(
            N >= 1 && N <= E::BITS,
            "a word has 1 bit to those of its element"
        );
        N
    };

    /// The value in lane `k`.
    #[inline(always)]
    pub fn get(self, k: usize) -> u64 {
        self.0[k].number()
    }

    /// A word from the value in each lane, modulo 2^`N`.
    #[inline(always)]
    pub fn each(value: impl Fn(usize) -> u64) -> Self {
        Self::cut(from_fn(|k| E::low(value(k))))
    }

    /// Takes over what `other` has in lane `k`.
    #[inline(always)]
    pub(super) fn set(&mut self, k: usize, other: Self) {
        self.0[k] = other.0[k];
    }

    #[inline(always)]
    fn cut(words: [E; K]) -> Self {
        let mask = E::low(u64::MAX >> (64 - Self::WIDTH));
        LaneUInt(one(words, |word| word & mask))
    }
}

impl<const K: usize, E: Element, const N: usize> LaneInt<K, E, N> {
    const SPARE: usize = {
        assert!(
            N >= 1 && N <= E::BITS,
            "a word has 1 bit to those of its element"
        );
        E::BITS - N
    };

    /// The value in lane `k`.
    #[inline(always)]
    pub fn get(self, k: usize) -> i64 {
        let spare = 64 - E::BITS;
        (self.0[k].number() << spare) as i64 >> spare
    }

    /// A word from the value in each lane, modulo 2^`N`.
    #[inline(always)]
    pub fn each(value: impl Fn(usize) -> i64) -> Self {
        Self::cut(from_fn(|k| E::low(value(k) as u64)))
    }

    #[inline(always)]
    fn cut(words: [E; K]) -> Self {
        LaneInt(one(words, |word| {
            word.up(Self::SPARE).down_signed(Self::SPARE)
        }))
    }
}

impl<const K: usize, E: Element> From<bool> for LaneBit<K, E> {
    #[inline(always)]
    fn from(value: bool) -> Self {
        LaneBit::each(|_| value)
    }
}

impl<const K: usize, E: Element, const N: usize> From<u64> for LaneUInt<K, E, N> {
    #[inline(always)]
    fn from(value: u64) -> Self {
        Self::each(|_| value)
    }
}

impl<const K: usize, E: Element, const N: usize> From<i64> for LaneInt<K, E, N> {
    #[inline(always)]
    fn from(value: i64) -> Self {
        Self::each(|_| value)
    }
}

/// What every word can do, and one wire too.
macro_rules! word {
    ($word:ident $(, $n:ident)?; $walk:ident) => {
        impl<const K: usize, E: Element $(, const $n: usize)?> Signals<Lanes<K, E>>
            for $word<K, E $(, $n)?>
        {
            #[inline(always)]
            fn visit<V: Visit<Lanes<K, E>>>(&self, field: &'static Field, visitor: &mut V) {
                visitor.$walk(field, *self);
            }
            #[inline(always)]
            fn make<M: Make<Lanes<K, E>>>(field: &'static Field, maker: &mut M) -> Self {
                maker.$walk(field)
            }
        }

        impl<const K: usize, E: Element $(, const $n: usize)?> Select<Lanes<K, E>>
            for $word<K, E $(, $n)?>
        {
            #[inline(always)]
            fn select(choose: LaneBit<K, E>, then: Self, other: Self) -> Self {
                let (c, a, b) = (choose.0, then.0, other.0);
                $word(from_fn(|k| b[k] ^ (c[k] & (a[k] ^ b[k]))))
            }
        }
    };
}

word!(LaneBit; bit);
word!(LaneUInt, N; unsigned);
word!(LaneInt, N; signed);

/// An operator of two words.
macro_rules! operator {
    ($word:ident $(, $n:ident)?; $trait:ident, $method:ident, $apply:expr, $cut:expr) => {
        impl<const K: usize, E: Element $(, const $n: usize)?> $trait for $word<K, E $(, $n)?> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                $cut(two(self.0, other.0, $apply))
            }
        }
    };
}

operator!(LaneBit; BitAnd, bitand, |a, b| a & b, LaneBit);
operator!(LaneBit; BitOr, bitor, |a, b| a | b, LaneBit);
operator!(LaneBit; BitXor, bitxor, |a, b| a ^ b, LaneBit);
operator!(LaneUInt, N; BitAnd, bitand, |a, b| a & b, LaneUInt);
operator!(LaneUInt, N; BitOr, bitor, |a, b| a | b, LaneUInt);
operator!(LaneUInt, N; BitXor, bitxor, |a, b| a ^ b, LaneUInt);
operator!(LaneUInt, N; Add, add, E::plus, Self::cut);
operator!(LaneUInt, N; Sub, sub, E::minus, Self::cut);
operator!(LaneInt, N; Add, add, E::plus, Self::cut);
operator!(LaneInt, N; Sub, sub, E::minus, Self::cut);

/// An operator of a word and a constant.
macro_rules! constant {
    ($word:ident, $number:ty; $trait:ident, $method:ident) => {
        impl<const K: usize, E: Element, const N: usize> $trait<$number> for $word<K, E, N> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: $number) -> Self {
                self.$method(Self::from(other))
            }
        }
    };
}

constant!(LaneUInt, u64; Add, add);
constant!(LaneUInt, u64; Sub, sub);
constant!(LaneInt, i64; Add, add);
constant!(LaneInt, i64; Sub, sub);

impl<const K: usize, E: Element> Not for LaneBit<K, E> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        LaneBit(one(self.0, |a| !a))
    }
}

impl<const K: usize, E: Element, const N: usize> Not for LaneUInt<K, E, N> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self::cut(one(self.0, |a| !a))
    }
}

impl<const K: usize, E: Element, const N: usize> Neg for LaneInt<K, E, N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::cut(one(self.0, |a| E::low(0).minus(a)))
    }
}

impl<const K: usize, E: Element> Bit<Lanes<K, E>> for LaneBit<K, E> {
    #[inline(always)]
    fn mux<T: Select<Lanes<K, E>>>(self, then: T, other: T) -> T {
        T::select(self, then, other)
    }
    #[inline(always)]
    fn word(self) -> LaneUInt<K, E, 1> {
        LaneUInt::cut(self.0)
    }
}

impl<const K: usize, E: Element, const N: usize> Unsigned<Lanes<K, E>, N> for LaneUInt<K, E, N> {
    #[inline(always)]
    fn equals(self, other: Self) -> LaneBit<K, E> {
        LaneBit(two(self.0, other.0, E::same))
    }
    #[inline(always)]
    fn below(self, other: Self) -> LaneBit<K, E> {
        LaneBit(two(self.0, other.0, E::less))
    }
    #[inline(always)]
    fn bit(self, index: usize) -> LaneBit<K, E> {
        if index >= N {
            return false.into();
        }
        // To the sign, and from there into every bit.
        let above = E::BITS - 1 - index;
        LaneBit(one(self.0, |a| a.up(above).down_signed(E::BITS - 1)))
    }
    #[inline(always)]
    fn resize<const M: usize>(self) -> LaneUInt<K, E, M> {
        LaneUInt::cut(self.0)
    }
    #[inline(always)]
    fn times<const M: usize, const P: usize>(self, other: LaneUInt<K, E, M>) -> LaneUInt<K, E, P> {
        LaneUInt::cut(two(self.0, other.0, E::times))
    }
    #[inline(always)]
    fn shift_left(self, bits: usize) -> Self {
        match bits < N {
            true => Self::cut(one(self.0, |a| a.up(bits))),
            false => 0.into(),
        }
    }
    #[inline(always)]
    fn shift_right(self, bits: usize) -> Self {
        match bits < N {
            true => LaneUInt(one(self.0, |a| a.down(bits))),
            false => 0.into(),
        }
    }
    #[inline(always)]
    fn join<const M: usize, const P: usize>(self, low: LaneUInt<K, E, M>) -> LaneUInt<K, E, P> {
        match M < E::BITS {
            true => LaneUInt::cut(two(self.0, low.0, |high, low| high.up(M) | low)),
            false => LaneUInt::cut(low.0),
        }
    }
    #[inline(always)]
    fn signed(self) -> LaneInt<K, E, N> {
        LaneInt::cut(self.0)
    }
}

impl<const K: usize, E: Element, const N: usize> Signed<Lanes<K, E>, N> for LaneInt<K, E, N> {
    #[inline(always)]
    fn equals(self, other: Self) -> LaneBit<K, E> {
        LaneBit(two(self.0, other.0, E::same))
    }
    #[inline(always)]
    fn below(self, other: Self) -> LaneBit<K, E> {
        LaneBit(two(self.0, other.0, E::less_signed))
    }
    #[inline(always)]
    fn is_negative(self) -> LaneBit<K, E> {
        LaneBit(one(self.0, |a| a.down_signed(E::BITS - 1)))
    }
    #[inline(always)]
    fn resize<const M: usize>(self) -> LaneInt<K, E, M> {
        LaneInt::cut(self.0)
    }
    #[inline(always)]
    fn times<const M: usize, const P: usize>(self, other: LaneInt<K, E, M>) -> LaneInt<K, E, P> {
        LaneInt::cut(two(self.0, other.0, E::times))
    }
    #[inline(always)]
    fn shift_left(self, bits: usize) -> Self {
        match bits < N {
            true => Self::cut(one(self.0, |a| a.up(bits))),
            false => 0.into(),
        }
    }
    #[inline(always)]
    fn shift_right(self, bits: usize) -> Self {
        let bits = bits.min(E::BITS - 1);
        LaneInt(one(self.0, |a| a.down_signed(bits)))
    }
    #[inline(always)]
    fn magnitude(self) -> LaneUInt<K, E, N> {
        LaneUInt::cut(one(self.0, |a| {
            let sign = a.down_signed(E::BITS - 1);
            (a ^ sign).minus(sign)
        }))
    }
    #[inline(always)]
    fn unsigned(self) -> LaneUInt<K, E, N> {
        LaneUInt::cut(self.0)
    }
}
