use std::fmt::Debug;
use std::ops::{BitAnd, BitOr, BitXor, Not};

/// The integer that holds a word of one lane: `u8`, `u16`, `u32` or `u64`.
///
/// Signed words are held in it sign-extended. A comparison gives all ones or zero, so that what
/// chooses by it needs no other width.
pub trait Element:
    Copy
    + Debug
    + PartialEq
    + Send
    + Sync
    + Not<Output = Self>
    + BitAnd<Output = Self>
    + BitOr<Output = Self>
    + BitXor<Output = Self>
    + sealed::Sealed
    + 'static
{
    /// The widest word.
    const BITS: usize;
    /// The low bits of a number.
    fn low(number: u64) -> Self;
    /// As a number, zeros above.
    fn number(self) -> u64;
    /// The sum, wrapping.
    fn plus(self, other: Self) -> Self;
    /// The difference, wrapping.
    fn minus(self, other: Self) -> Self;
    /// The product, wrapping.
    fn times(self, other: Self) -> Self;
    /// Moved up; `bits` is below [`BITS`](Element::BITS).
    fn up(self, bits: usize) -> Self;
    /// Moved down, zeros from above.
    fn down(self, bits: usize) -> Self;
    /// Moved down, the sign from above.
    fn down_signed(self, bits: usize) -> Self;
    /// All ones where both are the same.
    fn same(self, other: Self) -> Self;
    /// All ones where it is less than `other`.
    fn less(self, other: Self) -> Self;
    /// The same as two's complement.
    fn less_signed(self, other: Self) -> Self;
}

mod sealed {
    pub trait Sealed {}
}

macro_rules! element {
    ($unsigned:ty, $signed:ty) => {
        impl sealed::Sealed for $unsigned {}

        impl Element for $unsigned {
            const BITS: usize = <$unsigned>::BITS as usize;
            #[inline(always)]
            fn low(number: u64) -> Self {
                number as $unsigned
            }
            #[inline(always)]
            fn number(self) -> u64 {
                self.into()
            }
            #[inline(always)]
            fn plus(self, other: Self) -> Self {
                self.wrapping_add(other)
            }
            #[inline(always)]
            fn minus(self, other: Self) -> Self {
                self.wrapping_sub(other)
            }
            #[inline(always)]
            fn times(self, other: Self) -> Self {
                self.wrapping_mul(other)
            }
            #[inline(always)]
            fn up(self, bits: usize) -> Self {
                self << bits
            }
            #[inline(always)]
            fn down(self, bits: usize) -> Self {
                self >> bits
            }
            #[inline(always)]
            fn down_signed(self, bits: usize) -> Self {
                (self as $signed >> bits) as $unsigned
            }
            #[inline(always)]
            fn same(self, other: Self) -> Self {
                if self == other { !0 } else { 0 }
            }
            #[inline(always)]
            fn less(self, other: Self) -> Self {
                if self < other { !0 } else { 0 }
            }
            #[inline(always)]
            fn less_signed(self, other: Self) -> Self {
                if (self as $signed) < (other as $signed) {
                    !0
                } else {
                    0
                }
            }
        }
    };
}

element!(u8, i8);
element!(u16, i16);
element!(u32, i32);
element!(u64, i64);
