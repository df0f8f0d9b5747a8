//! Words while a circuit is elaborated: handles to nodes of its netlist.

use super::build::{self, Id, bits, called, constant, here, mistake, node, resize};
use super::describe::describe;
use crate::netlist::{BIT, Node, Operator, Shape, signed, unsigned};
use std::ops::{Add, BitAnd, BitOr, BitXor, Neg, Not, Sub};

/// One wire.
///
/// Wires have no value while a circuit is elaborated, so Rust cannot ask for one. `==`, `<` and `if`
/// do not compile; [`equals`](U::equals), [`below`](U::below) and [`mux`](Bit::mux) are the gates.
///
/// ```
/// # use motion_rtl::prelude::*;
/// # #[derive(Debug, Clone)] struct C;
/// # signals! { for C as _c; pub struct In { limit: U(6), go: Bit } pub struct Reg { pub count: U(6) } }
/// # impl Circuit for C {
/// # const NAME: &'static str = "c"; const ABOUT: &'static str = "c"; records!(In, Reg, Nothing);
/// fn tick(&self, i: In, q: Reg, _: Nothing) -> (Nothing, Reg<Edge>) {
///     let full = q.count.equals(i.limit) | i.limit.below(q.count);
///     let count = i.go.mux((!full).mux(q.count + 1, 0), q.count);
///     (Nothing, Reg { count })
/// }
/// # }
/// ```
///
/// ```compile_fail,E0369
/// # use motion_rtl::prelude::*;
/// # #[derive(Debug, Clone)] struct C;
/// # signals! { for C as _c; pub struct In { limit: U(6), go: Bit } pub struct Reg { pub count: U(6) } }
/// # impl Circuit for C {
/// # const NAME: &'static str = "c"; const ABOUT: &'static str = "c"; records!(In, Reg, Nothing);
/// fn tick(&self, i: In, q: Reg, _: Nothing) -> (Nothing, Reg<Edge>) {
///     let count = if q.count == i.limit { q.count } else { q.count + 1 };
///     (Nothing, Reg { count })
/// }
/// # }
/// ```
///
/// ```compile_fail,E0369
/// # use motion_rtl::prelude::*;
/// # #[derive(Debug, Clone)] struct C;
/// # signals! { for C as _c; pub struct In { limit: U(6), go: Bit } pub struct Reg { pub count: U(6) } }
/// # impl Circuit for C {
/// # const NAME: &'static str = "c"; const ABOUT: &'static str = "c"; records!(In, Reg, Nothing);
/// fn tick(&self, i: In, q: Reg, _: Nothing) -> (Nothing, Reg<Edge>) {
///     let count = if q.count < i.limit { q.count + 1 } else { q.count };
///     (Nothing, Reg { count })
/// }
/// # }
/// ```
///
/// ```compile_fail,E0308
/// # use motion_rtl::prelude::*;
/// # #[derive(Debug, Clone)] struct C;
/// # signals! { for C as _c; pub struct In { limit: U(6), go: Bit } pub struct Reg { pub count: U(6) } }
/// # impl Circuit for C {
/// # const NAME: &'static str = "c"; const ABOUT: &'static str = "c"; records!(In, Reg, Nothing);
/// fn tick(&self, i: In, q: Reg, _: Nothing) -> (Nothing, Reg<Edge>) {
///     let count = if i.go { q.count + 1 } else { q.count };
///     (Nothing, Reg { count })
/// }
/// # }
/// ```
///
/// Two constants have no width:
///
/// ```compile_fail,E0277
/// # use motion_rtl::prelude::*;
/// # #[derive(Debug, Clone)] struct C;
/// # signals! { for C as _c; pub struct In { limit: U(6), go: Bit } pub struct Reg { pub count: U(6) } }
/// # impl Circuit for C {
/// # const NAME: &'static str = "c"; const ABOUT: &'static str = "c"; records!(In, Reg, Nothing);
/// fn tick(&self, i: In, q: Reg, _: Nothing) -> (Nothing, Reg<Edge>) {
///     let count = q.count + i.go.mux(0, 1);
///     (Nothing, Reg { count })
/// }
/// # }
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Bit(pub(super) Id);

/// An unsigned word; arithmetic is modulo 2^width.
#[derive(Debug, Clone, Copy)]
pub struct U(pub(super) Id);

/// A two's complement word; arithmetic is modulo 2^width.
#[derive(Debug, Clone, Copy)]
pub struct I(pub(super) Id);

/// A wire or word.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no wire",
    note = "wires are `Bit`, `U` and `I`; a constant is one with a width, `U::new(5, width)`"
)]
pub trait Word: Copy {
    #[doc(hidden)]
    fn id(self) -> Id;
    #[doc(hidden)]
    fn of(id: Id) -> Self;
}

/// Operand beside a word: another word, or a constant, which takes the width of the word.
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot stand beside a word `{W}`",
    label = "neither a `{W}` nor a constant for one",
    note = "beside a `Bit` stands a `Bit` or a `bool`, beside a `U` a `U` or a `u64`, beside an `I` \
            an `I` or an `i64`",
    note = "the same bits read otherwise: `word.signed()`, `word.unsigned()`, `bit.word()`; another \
            width: `word.resize(width)`"
)]
pub trait Operand<W: Word> {
    #[doc(hidden)]
    fn beside(self, word: W) -> Id;
}

impl<W: Word> Operand<W> for W {
    fn beside(self, _: W) -> Id {
        self.id()
    }
}

impl Operand<Bit> for bool {
    #[track_caller]
    fn beside(self, _: Bit) -> Id {
        constant(self.into(), BIT)
    }
}

impl Operand<U> for u64 {
    #[track_caller]
    fn beside(self, word: U) -> Id {
        build::number_beside(self.into(), word.0)
    }
}

impl Operand<I> for i64 {
    #[track_caller]
    fn beside(self, word: I) -> Id {
        build::number_beside(self.into(), word.0)
    }
}

/// Pair that a [multiplexer](Bit::mux) can choose between: words of one kind, or such a word and a
/// constant.
#[diagnostic::on_unimplemented(
    message = "`mux` cannot choose between `{Self}` and `{Other}`",
    label = "a word and a constant, or two words of one kind, are wanted",
    note = "two constants have no width: write `U::new(0, width)`, `I::new(-1, width)` or \
            `Bit::low()` for one of them",
    note = "two words are of the same kind: `Bit`, `U` or `I`"
)]
pub trait Choice<Other> {
    /// Type of the result.
    type Word;
    #[doc(hidden)]
    fn choose(self, choose: Bit, other: Other) -> Self::Word;
}

#[inline(never)]
#[track_caller]
fn mux(choose: Bit, then: Id, other: Id) -> Id {
    let shape = build::shape(then);
    let other = same(then, other, "choice");
    node(Node::Mux(choose.0, then, other), shape)
}

#[inline(never)]
#[track_caller]
fn binary(operator: Operator, a: Id, b: Id, what: &str) -> Id {
    let b = same(a, b, what);
    node(Node::Binary(operator, a, b), build::shape(a))
}

/// Returns the second of two operands if both have the same width. Otherwise records a mistake.
#[track_caller]
fn same(a: Id, b: Id, what: &str) -> Id {
    let (left, right) = (build::shape(a), build::shape(b));
    if left.width == right.width {
        return b;
    }
    let (first, second) = (describe(a), describe(b));
    let (left_bits, right_bits) = (bits(left.width), bits(right.width));
    mistake(
        here(),
        format!("{what} of {first} ({left_bits}) and {second} ({right_bits})"),
    );
    resize(b, left)
}

/// Records a mistake: access to bits beyond a word's width.
#[cold]
#[track_caller]
fn not_there(what: String, word: Id) {
    let (name, width) = (describe(word), build::shape(word).width);
    mistake(
        here(),
        format!("{what} of {name}, which has {}", bits(width)),
    );
}

macro_rules! word {
    ($word:ident, $number:ty) => {
        impl Word for $word {
            fn id(self) -> Id {
                self.0
            }
            fn of(id: Id) -> Self {
                $word(id)
            }
        }

        impl Choice<$word> for $word {
            type Word = $word;
            #[track_caller]
            fn choose(self, choose: Bit, other: $word) -> $word {
                $word(mux(choose, self.0, other.0))
            }
        }

        impl Choice<$number> for $word {
            type Word = $word;
            #[track_caller]
            fn choose(self, choose: Bit, other: $number) -> $word {
                $word(mux(choose, self.0, other.beside(self)))
            }
        }

        impl Choice<$word> for $number {
            type Word = $word;
            #[track_caller]
            fn choose(self, choose: Bit, other: $word) -> $word {
                $word(mux(choose, self.beside(other), other.0))
            }
        }
    };
}

word!(Bit, bool);
word!(U, u64);
word!(I, i64);

/// Implements an operator on two words of the same width, or on a word and a constant.
macro_rules! operator {
    ($word:ident, $trait:ident, $method:ident, $operator:ident, $what:literal, $number:ty) => {
        impl $trait for $word {
            type Output = Self;
            #[track_caller]
            fn $method(self, other: Self) -> Self {
                $word(binary(Operator::$operator, self.0, other.0, $what))
            }
        }

        impl $trait<$number> for $word {
            type Output = Self;
            #[track_caller]
            fn $method(self, other: $number) -> Self {
                $word(binary(
                    Operator::$operator,
                    self.0,
                    other.beside(self),
                    $what,
                ))
            }
        }
    };
}

operator!(Bit, BitAnd, bitand, And, "conjunction", bool);
operator!(Bit, BitOr, bitor, Or, "disjunction", bool);
operator!(Bit, BitXor, bitxor, Xor, "exclusive or", bool);
operator!(U, BitAnd, bitand, And, "conjunction", u64);
operator!(U, BitOr, bitor, Or, "disjunction", u64);
operator!(U, BitXor, bitxor, Xor, "exclusive or", u64);
operator!(U, Add, add, Add, "sum", u64);
operator!(U, Sub, sub, Subtract, "difference", u64);
operator!(I, Add, add, Add, "sum", i64);
operator!(I, Sub, sub, Subtract, "difference", i64);

#[track_caller]
fn compare<W: Word>(operator: Operator, a: W, b: impl Operand<W>) -> Bit {
    let b = same(a.id(), b.beside(a), "comparison");
    Bit(node(Node::Binary(operator, a.id(), b), BIT))
}

impl From<bool> for Bit {
    #[track_caller]
    fn from(value: bool) -> Self {
        Bit(constant(value.into(), BIT))
    }
}

impl Not for Bit {
    type Output = Self;
    #[track_caller]
    fn not(self) -> Self {
        Bit(node(Node::Not(self.0), BIT))
    }
}

impl Not for U {
    type Output = Self;
    #[track_caller]
    fn not(self) -> Self {
        U(node(Node::Not(self.0), build::shape(self.0)))
    }
}

impl Neg for I {
    type Output = Self;
    #[track_caller]
    fn neg(self) -> Self {
        I(node(Node::Negate(self.0), build::shape(self.0)))
    }
}

impl Bit {
    /// Returns a low wire.
    #[track_caller]
    pub fn low() -> Self {
        false.into()
    }

    /// Returns a high wire.
    #[track_caller]
    pub fn high() -> Self {
        true.into()
    }

    /// Returns `then` if this bit is high, else `other`. One of them may be a constant.
    #[track_caller]
    pub fn mux<T: Choice<O>, O>(self, then: T, other: O) -> T::Word {
        then.choose(self, other)
    }

    /// High if both bits are the same.
    #[track_caller]
    pub fn equals(self, other: Bit) -> Bit {
        !(self ^ other)
    }

    /// High unless this bit is high and `then` is low.
    #[track_caller]
    pub fn implies(self, then: Bit) -> Bit {
        !self | then
    }

    /// High if all bits are.
    #[track_caller]
    pub fn all(bits: impl IntoIterator<Item = Bit>) -> Bit {
        let mut bits: Vec<Bit> = bits.into_iter().collect();
        // Pair by pair, which makes no deep network of many bits.
        while bits.len() > 1 {
            let pairs = bits.chunks(2);
            bits = pairs
                .map(|pair| pair.iter().copied().reduce(|a, b| a & b).unwrap_or(pair[0]))
                .collect();
        }
        bits.first().copied().unwrap_or_else(Bit::high)
    }

    /// Returns the bit as a word of one bit.
    #[track_caller]
    pub fn word(self) -> U {
        U(node(Node::Cast(self.0), unsigned(1)))
    }
}

/// Returns the product of two words in `shape`.
#[track_caller]
fn product(a: Id, b: Id, shape: Shape) -> Id {
    let shape = build::word(shape, "a product");
    let (a, b) = (resize(a, shape), resize(b, shape));
    node(Node::Binary(Operator::Multiply, a, b), shape)
}

/// Implements the common methods of unsigned and two's complement words.
macro_rules! arithmetic {
    ($word:ident, $shape:ident) => {
        impl $word {
            /// Returns the width in bits.
            pub fn width(self) -> usize {
                build::shape(self.0).width
            }

            /// Returns high if both words are equal.
            #[track_caller]
            pub fn equals(self, other: impl Operand<$word>) -> Bit {
                compare(Operator::Equal, self, other)
            }

            /// Returns high if this word is less than `other`.
            #[track_caller]
            pub fn below(self, other: impl Operand<$word>) -> Bit {
                compare(Operator::Below, self, other)
            }

            /// Returns high if this word is less than `other`; the widths may differ.
            #[track_caller]
            pub fn below_any(self, other: $word) -> Bit {
                let width = self.width().max(other.width());
                self.resize(width).below(other.resize(width))
            }

            /// Returns high if both words are the same number; the widths may differ.
            #[track_caller]
            pub fn equals_any(self, other: $word) -> Bit {
                let width = self.width().max(other.width());
                self.resize(width).equals(other.resize(width))
            }

            /// Returns high if all bits are low.
            #[track_caller]
            pub fn is_zero(self) -> Bit {
                self.equals(0)
            }

            /// Returns the product cut to `width` bits; the sum of both widths is exact.
            #[track_caller]
            pub fn times(self, other: $word, width: usize) -> Self {
                $word(product(self.0, other.0, $shape(width)))
            }

            /// Returns the exact sum, one bit wider than the wider word; the widths may differ.
            #[track_caller]
            pub fn plus(self, other: $word) -> Self {
                let width = self.width().max(other.width()) + 1;
                self.resize(width) + other.resize(width)
            }

            /// Shifts left by a fixed number of bits, filled with zeros.
            #[track_caller]
            pub fn shift_left(self, by: usize) -> Self {
                let shape = build::shape(self.0);
                match by < shape.width {
                    true => $word(node(Node::ShiftLeft(self.0, by), shape)),
                    false => $word(constant(0, shape)),
                }
            }
        }
    };
}

arithmetic!(U, unsigned);
arithmetic!(I, signed);

impl U {
    /// Returns a constant, 0 to 2^`width` − 1.
    #[track_caller]
    pub fn new(value: u64, width: usize) -> Self {
        U(build::number(value.into(), unsigned(width)))
    }

    /// Returns a value that is fixed at elaboration and may differ between circuits of one kind: a
    /// parameter of their Verilog module, named `name`.
    #[track_caller]
    pub fn parameter(name: &'static str, value: u64, width: usize) -> Self {
        U(build::parameter(name, value, unsigned(width)))
    }

    /// Returns bit `index`; 0 is the least significant.
    #[track_caller]
    pub fn bit(self, index: usize) -> Bit {
        if index >= self.width() {
            not_there(format!("bit {index}"), self.0);
            return Bit::low();
        }
        Bit(node(Node::Slice(self.0, index), BIT))
    }

    /// Zero-extends or cuts to `width` bits.
    #[track_caller]
    pub fn resize(self, width: usize) -> Self {
        U(resize(self.0, build::word(unsigned(width), "a word")))
    }

    /// Returns `width` bits from bit `low` up.
    #[track_caller]
    pub fn slice(self, low: usize, width: usize) -> Self {
        let shape = build::word(unsigned(width), "a slice");
        let last = low.saturating_add(shape.width - 1);
        if last >= self.width() {
            not_there(format!("bits {last} down to {low}"), self.0);
            return U(constant(0, shape));
        }
        U(node(Node::Slice(self.0, low), shape))
    }

    /// Shifts right by a fixed number of bits, filled with zeros.
    #[track_caller]
    pub fn shift_right(self, by: usize) -> Self {
        let shape = build::shape(self.0);
        match by < shape.width {
            true => U(node(Node::ShiftRight(self.0, by), shape)),
            false => U(constant(0, shape)),
        }
    }

    /// Concatenates this word above `low`.
    #[track_caller]
    pub fn join(self, low: U) -> Self {
        let width = self.width() + low.width();
        let shape = build::word(unsigned(width), "a joined word");
        let high = self.resize(shape.width.saturating_sub(low.width()).max(1));
        U(node(Node::Join(high.0, low.0), shape))
    }

    /// Returns the same bits read as two's complement.
    #[track_caller]
    pub fn signed(self) -> I {
        I(node(Node::Cast(self.0), signed(self.width())))
    }
}

impl I {
    /// Returns a constant, −2^(`width` − 1) to 2^(`width` − 1) − 1.
    #[track_caller]
    pub fn new(value: i64, width: usize) -> Self {
        I(build::number(value.into(), signed(width)))
    }

    /// Returns the sign bit.
    #[track_caller]
    pub fn is_negative(self) -> Bit {
        Bit(node(Node::Slice(self.0, self.width() - 1), BIT))
    }

    /// Sign-extends or cuts to `width` bits.
    #[track_caller]
    pub fn resize(self, width: usize) -> Self {
        I(resize(self.0, build::word(signed(width), "a word")))
    }

    /// Returns the exact difference, one bit wider than the wider word; the widths may differ.
    #[track_caller]
    pub fn minus(self, other: I) -> Self {
        let width = self.width().max(other.width()) + 1;
        self.resize(width) - other.resize(width)
    }

    /// Shifts right by a fixed number of bits, filled with the sign: a division by 2^`by` rounded
    /// towards minus infinity.
    #[track_caller]
    pub fn shift_right(self, by: usize) -> Self {
        let shape = build::shape(self.0);
        I(node(
            Node::ShiftRight(self.0, by.min(shape.width - 1)),
            shape,
        ))
    }

    /// Returns the negated word if `negative` is high, else the word itself.
    #[track_caller]
    pub fn negated_by(self, negative: Bit) -> Self {
        let chosen = negative.mux(-self, self);
        I(called(chosen.0, "the conditional negative", self.0))
    }

    /// Returns the absolute value as an unsigned word; exact for the most negative word too.
    #[track_caller]
    pub fn magnitude(self) -> U {
        let chosen = self.is_negative().mux((-self).unsigned(), self.unsigned());
        U(called(chosen.0, "the magnitude", self.0))
    }

    /// Returns the same bits read as unsigned.
    #[track_caller]
    pub fn unsigned(self) -> U {
        U(node(Node::Cast(self.0), unsigned(self.width())))
    }
}

/// Cuts a number to a width on purpose: `(x + 1).cut(8)` fits a word of 8 bits for any `x`.
pub trait Cut {
    /// Returns the number that the low `width` bits mean.
    fn cut(self, width: usize) -> Self;
}

impl Cut for u64 {
    fn cut(self, width: usize) -> u64 {
        match width {
            0 => 0,
            1..64 => self & u64::MAX >> (64 - width),
            _ => self,
        }
    }
}

impl Cut for i64 {
    fn cut(self, width: usize) -> i64 {
        match width {
            0 => 0,
            1..64 => self << (64 - width) >> (64 - width),
            _ => self,
        }
    }
}

/// Returns the number of bits that number `things` things, at least 1.
pub const fn log2(things: usize) -> usize {
    match things {
        0..=2 => 1,
        things => (usize::BITS - (things - 1).leading_zeros()) as usize,
    }
}
