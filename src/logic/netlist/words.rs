use super::Netlist;
use super::build::{constant, node, shape};
use super::node::{BIT, Id, Node, Operator, signed, unsigned};
use crate::kernel::{Field, Make, Shape, Signals, Visit};
use crate::logic::{Bit, Select, Signed, Unsigned};
use std::ops::{Add, BitAnd, BitOr, BitXor, Neg, Not, Sub};

/// One wire of a netlist.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NetBit(pub(super) Id);

/// An unsigned word of a netlist.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NetUInt<const N: usize>(pub(super) Id);

/// A two's complement word of a netlist.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NetInt<const N: usize>(pub(super) Id);

impl NetBit {
    /// The node, or the leaf of a record of places.
    pub(crate) fn id(self) -> Id {
        self.0
    }
}

impl<const N: usize> NetUInt<N> {
    /// The node, or the leaf of a record of places.
    pub(crate) fn id(self) -> Id {
        self.0
    }
}

impl<const N: usize> NetInt<N> {
    /// The node, or the leaf of a record of places.
    pub(crate) fn id(self) -> Id {
        self.0
    }
}

// A circuit's code is little else than calls of these: they are not copied into it.

#[inline(never)]
fn binary(operator: Operator, a: Id, b: Id, shape: Shape) -> Id {
    node(Node::Binary(operator, a, b), shape)
}

#[inline(never)]
fn mux(choose: Id, then: Id, other: Id, shape: Shape) -> Id {
    node(Node::Mux(choose, then, other), shape)
}

#[inline(never)]
fn not(of: Id, shape: Shape) -> Id {
    node(Node::Not(of), shape)
}

/// The same bits as another kind of word.
#[inline(never)]
fn cast(of: Id, shape: Shape) -> Id {
    node(Node::Cast(of), shape)
}

/// Bits `low` to `low + width - 1` of a word, as another kind of word.
#[inline(never)]
fn slice(of: Id, low: usize, shape: Shape) -> Id {
    node(Node::Slice(of, low), shape)
}

/// Extended or cut to another width.
#[inline(never)]
fn resize(of: Id, to: Shape) -> Id {
    match self::shape(of).width {
        width if width < to.width => node(Node::Extend(of), to),
        width if width > to.width => slice(of, 0, to),
        _ => cast(of, to),
    }
}

impl From<bool> for NetBit {
    fn from(value: bool) -> Self {
        NetBit(constant(value.into(), BIT))
    }
}

impl<const N: usize> From<u64> for NetUInt<N> {
    fn from(value: u64) -> Self {
        NetUInt(constant(value, unsigned(N)))
    }
}

impl<const N: usize> From<i64> for NetInt<N> {
    fn from(value: i64) -> Self {
        NetInt(constant(value as u64, signed(N)))
    }
}

/// One operator for a word with another word, and where there is one with a constant.
macro_rules! operator {
    ($word:ident, $shape:ident, $trait:ident, $method:ident, $operator:ident) => {
        impl<const N: usize> $trait for $word<N> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                $word(binary(Operator::$operator, self.0, other.0, $shape(N)))
            }
        }
    };
    ($word:ident, $shape:ident, $trait:ident, $method:ident, $operator:ident, $number:ty) => {
        operator!($word, $shape, $trait, $method, $operator);
        impl<const N: usize> $trait<$number> for $word<N> {
            type Output = Self;
            fn $method(self, other: $number) -> Self {
                $trait::$method(self, $word::<N>::from(other))
            }
        }
    };
}

operator!(NetUInt, unsigned, Add, add, Add, u64);
operator!(NetUInt, unsigned, Sub, sub, Subtract, u64);
operator!(NetUInt, unsigned, BitAnd, bitand, And);
operator!(NetUInt, unsigned, BitOr, bitor, Or);
operator!(NetUInt, unsigned, BitXor, bitxor, Xor);
operator!(NetInt, signed, Add, add, Add, i64);
operator!(NetInt, signed, Sub, sub, Subtract, i64);

macro_rules! bit_operator {
    ($trait:ident, $method:ident, $operator:ident) => {
        impl $trait for NetBit {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                NetBit(binary(Operator::$operator, self.0, other.0, BIT))
            }
        }
    };
}

bit_operator!(BitAnd, bitand, And);
bit_operator!(BitOr, bitor, Or);
bit_operator!(BitXor, bitxor, Xor);

impl Not for NetBit {
    type Output = Self;
    fn not(self) -> Self {
        NetBit(not(self.0, BIT))
    }
}

impl<const N: usize> Not for NetUInt<N> {
    type Output = Self;
    fn not(self) -> Self {
        NetUInt(not(self.0, unsigned(N)))
    }
}

impl<const N: usize> Neg for NetInt<N> {
    type Output = Self;
    fn neg(self) -> Self {
        NetInt(node(Node::Negate(self.0), signed(N)))
    }
}

macro_rules! leaf {
    ($word:ty, $shape:expr, $walk:ident $(, $n:ident)?) => {
        impl$(<const $n: usize>)? Select<Netlist> for $word {
            fn select(choose: NetBit, then: Self, other: Self) -> Self {
                Self(mux(choose.0, then.0, other.0, $shape))
            }
        }

        impl$(<const $n: usize>)? Signals<Netlist> for $word {
            fn visit<V: Visit<Netlist>>(&self, field: &'static Field, visitor: &mut V) {
                visitor.$walk(field, *self);
            }
            fn make<M: Make<Netlist>>(field: &'static Field, maker: &mut M) -> Self {
                maker.$walk(field)
            }
        }
    };
}

leaf!(NetBit, BIT, bit);
leaf!(NetUInt<N>, unsigned(N), unsigned, N);
leaf!(NetInt<N>, signed(N), signed, N);

impl Bit<Netlist> for NetBit {
    fn mux<T: Select<Netlist>>(self, then: T, other: T) -> T {
        T::select(self, then, other)
    }
    fn word(self) -> NetUInt<1> {
        NetUInt(cast(self.0, unsigned(1)))
    }
}

impl<const N: usize> Unsigned<Netlist, N> for NetUInt<N> {
    fn equals(self, other: Self) -> NetBit {
        NetBit(binary(Operator::Equal, self.0, other.0, BIT))
    }
    fn below(self, other: Self) -> NetBit {
        NetBit(binary(Operator::Below, self.0, other.0, BIT))
    }
    fn bit(self, index: usize) -> NetBit {
        match index < N {
            true => NetBit(slice(self.0, index, BIT)),
            false => false.into(),
        }
    }
    fn resize<const M: usize>(self) -> NetUInt<M> {
        NetUInt(resize(self.0, unsigned(M)))
    }
    fn times<const M: usize, const P: usize>(self, other: NetUInt<M>) -> NetUInt<P> {
        let [a, b] = [self.0, other.0].map(|word| resize(word, unsigned(P)));
        NetUInt(binary(Operator::Multiply, a, b, unsigned(P)))
    }
    fn shift_left(self, bits: usize) -> Self {
        match bits < N {
            true => NetUInt(node(Node::ShiftLeft(self.0, bits), unsigned(N))),
            false => 0.into(),
        }
    }
    fn shift_right(self, bits: usize) -> Self {
        match bits < N {
            true => NetUInt(node(Node::ShiftRight(self.0, bits), unsigned(N))),
            false => 0.into(),
        }
    }
    fn join<const M: usize, const P: usize>(self, low: NetUInt<M>) -> NetUInt<P> {
        // At most 64 bits of the joined word exist: what is above them is cut before.
        let high = N.min(P.saturating_sub(M));
        let joined = match high {
            0 => low.0,
            _ => {
                let high = resize(self.0, unsigned(high));
                let width = unsigned(shape(high).width + M);
                node(Node::Join(high, low.0), width)
            }
        };
        NetUInt(resize(joined, unsigned(P)))
    }
    fn signed(self) -> NetInt<N> {
        NetInt(cast(self.0, signed(N)))
    }
}

impl<const N: usize> Signed<Netlist, N> for NetInt<N> {
    fn equals(self, other: Self) -> NetBit {
        NetBit(binary(Operator::Equal, self.0, other.0, BIT))
    }
    fn below(self, other: Self) -> NetBit {
        NetBit(binary(Operator::Below, self.0, other.0, BIT))
    }
    fn is_negative(self) -> NetBit {
        NetBit(slice(self.0, N - 1, BIT))
    }
    fn resize<const M: usize>(self) -> NetInt<M> {
        NetInt(resize(self.0, signed(M)))
    }
    fn times<const M: usize, const P: usize>(self, other: NetInt<M>) -> NetInt<P> {
        let [a, b] = [self.0, other.0].map(|word| resize(word, signed(P)));
        NetInt(binary(Operator::Multiply, a, b, signed(P)))
    }
    fn shift_left(self, bits: usize) -> Self {
        match bits < N {
            true => NetInt(node(Node::ShiftLeft(self.0, bits), signed(N))),
            false => 0.into(),
        }
    }
    fn shift_right(self, bits: usize) -> Self {
        NetInt(node(Node::ShiftRight(self.0, bits.min(N - 1)), signed(N)))
    }
    fn magnitude(self) -> NetUInt<N> {
        self.is_negative().mux((-self).unsigned(), self.unsigned())
    }
    fn unsigned(self) -> NetUInt<N> {
        NetUInt(cast(self.0, unsigned(N)))
    }
}
