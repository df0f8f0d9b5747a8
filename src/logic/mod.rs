//! The words a circuit is written in, and what they may mean.
//!
//! A circuit is generic over [`Logic`]: it says *which* words it adds, compares and stores, and
//! whoever runs it says what a word *is*. [`Sim`] makes it a number, [`Netlist`] a node of a
//! netlist. A circuit therefore never looks at a value: there is no `if` on a
//! [`Logic::Bit`], only [`Bit::mux`].
//!
//! Words wrap, as registers do. An operation whose result has another width than its operands
//! takes that width as a const parameter ([`Unsigned::resize`], [`Unsigned::times`], …).

mod memory;
pub mod netlist;
pub mod sim;

pub use memory::{Image, Ram, ShiftRegister};
pub use netlist::Netlist;
pub use sim::Sim;

use crate::kernel::{Circuit, Signals};
use std::fmt::Debug;
use std::ops::{Add, BitAnd, BitOr, BitXor, Neg, Not, Sub};

/// A meaning of the words.
pub trait Logic: Sized + Copy + Debug + 'static {
    /// One wire.
    type Bit: Bit<Self>;
    /// An unsigned word of `N` bits, 1 to 64; arithmetic is modulo 2^N.
    type U<const N: usize>: Unsigned<Self, N>;
    /// A two's complement word of `N` bits, 1 to 64; arithmetic is modulo 2^N.
    type I<const N: usize>: Signed<Self, N>;
    /// A memory of 2^`A` words of `D` bits with a write port.
    type Ram<const A: usize, const D: usize>: Ram<Self, A, D>;
    /// `K` words of `D` bits in a row, shifted by a strobe.
    type ShiftRegister<const K: usize, const D: usize>: ShiftRegister<Self, K, D>;

    /// Combinational read of a memory whose contents are fixed at elaboration.
    fn rom<const A: usize, const D: usize>(image: &Image<A, D>, address: Self::U<A>) -> Self::U<D>;

    /// A value that is fixed at elaboration and may differ between circuits of one kind, modulo
    /// 2^N: a parameter of their HDL module, called `name` there.
    fn parameter<const N: usize>(name: &'static str, value: u64) -> Self::U<N> {
        let _ = name;
        value.into()
    }

    /// The nets of a circuit inside another; see [`Instance`](crate::kernel::Instance).
    fn settle<C: Circuit>(circuit: &C, q: &C::Reg<Self>, i: &C::In<Self>) -> C::Net<Self> {
        circuit.comb(q, i)
    }

    /// The next registers of a circuit inside another.
    fn clock<C: Circuit>(
        circuit: &C,
        q: C::Reg<Self>,
        w: &C::Net<Self>,
        i: &C::In<Self>,
    ) -> C::Reg<Self> {
        circuit.next(q, w, i)
    }
}

/// What a multiplexer can choose between.
pub trait Select<L: Logic>: Sized {
    /// `then` where `choose` is high, `other` where it is low.
    fn select(choose: L::Bit, then: Self, other: Self) -> Self;
}

/// One wire.
pub trait Bit<L: Logic>:
    Copy
    + Debug
    + Signals<L>
    + Select<L>
    + From<bool>
    + Not<Output = Self>
    + BitAnd<Output = Self>
    + BitOr<Output = Self>
    + BitXor<Output = Self>
{
    /// `then` where this bit is high, `other` where it is low.
    fn mux<T: Select<L>>(self, then: T, other: T) -> T;
    /// The bit as a word of one bit.
    fn word(self) -> L::U<1>;
}

/// An unsigned word of `N` bits. A constant (`3.into()`, `count + 1`) is taken modulo 2^N.
pub trait Unsigned<L: Logic, const N: usize>:
    Copy
    + Debug
    + Signals<L>
    + Select<L>
    + From<u64>
    + Add<Output = Self>
    + Add<u64, Output = Self>
    + Sub<Output = Self>
    + Sub<u64, Output = Self>
    + Not<Output = Self>
    + BitAnd<Output = Self>
    + BitOr<Output = Self>
    + BitXor<Output = Self>
{
    /// High where both are the same.
    fn equals(self, other: Self) -> L::Bit;
    /// High where this word is less than `other`.
    fn below(self, other: Self) -> L::Bit;
    /// High where every bit is low.
    fn is_zero(self) -> L::Bit {
        self.equals(0.into())
    }
    /// Bit `index`, 0 the least significant; an index from `N` up reads low.
    fn bit(self, index: usize) -> L::Bit;
    /// Zero-extended or cut to `M` bits.
    fn resize<const M: usize>(self) -> L::U<M>;
    /// The product, cut to `P` bits; `P = N + M` loses nothing.
    fn times<const M: usize, const P: usize>(self, other: L::U<M>) -> L::U<P>;
    /// Moved up by a fixed number of bits, zeros from below.
    fn shift_left(self, bits: usize) -> Self;
    /// Moved down by a fixed number of bits, zeros from above.
    fn shift_right(self, bits: usize) -> Self;
    /// This word above `low`, cut to `P` bits; `P = N + M` loses nothing.
    fn join<const M: usize, const P: usize>(self, low: L::U<M>) -> L::U<P>;
    /// The same bits read as two's complement.
    fn signed(self) -> L::I<N>;
}

/// A two's complement word of `N` bits. A constant is taken modulo 2^N.
pub trait Signed<L: Logic, const N: usize>:
    Copy
    + Debug
    + Signals<L>
    + Select<L>
    + From<i64>
    + Add<Output = Self>
    + Add<i64, Output = Self>
    + Sub<Output = Self>
    + Sub<i64, Output = Self>
    + Neg<Output = Self>
{
    /// High where both are the same.
    fn equals(self, other: Self) -> L::Bit;
    /// High where this word is less than `other`.
    fn below(self, other: Self) -> L::Bit;
    /// High where every bit is low.
    fn is_zero(self) -> L::Bit {
        self.equals(0.into())
    }
    /// The sign bit.
    fn is_negative(self) -> L::Bit;
    /// Sign-extended or cut to `M` bits.
    fn resize<const M: usize>(self) -> L::I<M>;
    /// The product, cut to `P` bits; `P = N + M` loses nothing.
    fn times<const M: usize, const P: usize>(self, other: L::I<M>) -> L::I<P>;
    /// Moved up by a fixed number of bits, zeros from below.
    fn shift_left(self, bits: usize) -> Self;
    /// Moved down by a fixed number of bits, the sign from above: a division by 2^`bits` rounded
    /// towards minus infinity.
    fn shift_right(self, bits: usize) -> Self;
    /// The absolute value as an unsigned word; exact for the most negative word too.
    fn magnitude(self) -> L::U<N>;
    /// The same bits read as unsigned.
    fn unsigned(self) -> L::U<N>;
}
