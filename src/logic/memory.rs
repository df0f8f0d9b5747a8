use super::Logic;
use crate::kernel::Signals;
use bitvec::prelude::*;
use std::fmt::Debug;

/// A memory of 2^`A` words of `D` bits with one write port.
///
/// A handle: [`Circuit::next`](crate::kernel::Circuit::next) takes it by value and returns it, so
/// after the edge the old contents cannot be read. A read in the tick of a write to the same
/// address sees the old word (read-first).
pub trait Ram<L: Logic, const A: usize, const D: usize>: Debug + Clone + Signals<L> {
    /// The word at `address`, combinationally.
    fn read(&self, address: L::U<A>) -> L::U<D>;
    /// The next value of an output register: the word at `address` where `enable` is high,
    /// `held` where it is low. This is the form that block RAM has.
    fn read_when(&self, enable: L::Bit, address: L::U<A>, held: L::U<D>) -> L::U<D>;
    /// The memory after the edge: `data` at `address` where `enable` is high.
    fn write(self, enable: L::Bit, address: L::U<A>, data: L::U<D>) -> Self;
}

/// `K` words of `D` bits in a row: stage 0 takes the input, stage k what stage k − 1 held.
///
/// A handle like [`Ram`].
pub trait ShiftRegister<L: Logic, const K: usize, const D: usize>:
    Debug + Clone + Signals<L>
{
    /// Stage `index` counted from the input, 0 to K − 1; an index from `K` up reads zero.
    fn stage(&self, index: usize) -> L::U<D>;
    /// The stage that `tap` names; a tap from `K` up reads zero.
    fn tap<const T: usize>(&self, tap: L::U<T>) -> L::U<D>;
    /// The register after the edge: shifted by one stage where `enable` is high.
    fn shift(self, enable: L::Bit, input: L::U<D>) -> Self;
}

/// The contents of a memory of 2^`A` words of `D` bits, known at elaboration: a ROM, or what a
/// RAM holds at power-on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Image<const A: usize, const D: usize> {
    bits: BitBox<u64, Lsb0>,
}

impl<const A: usize, const D: usize> Image<A, D> {
    /// The number of words.
    pub const WORDS: usize = {
        assert!(A >= 1 && A <= 24, "an address has 1 to 24 bits");
        assert!(D >= 1 && D <= 64, "a word has 1 to 64 bits");
        1 << A
    };

    /// All words zero.
    pub fn zeroed() -> Self {
        Image {
            bits: bitbox![u64, Lsb0; 0; Self::WORDS * D],
        }
    }

    /// The given words from address 0 up, each cut to `D` bits, zeros behind them; words past
    /// the last address are left out.
    pub fn new(words: impl IntoIterator<Item = u64>) -> Self {
        let mut image = Self::zeroed();
        for (address, word) in words.into_iter().take(Self::WORDS).enumerate() {
            image.set(address, word);
        }
        image
    }

    /// The word at `address`, which wraps at the number of words.
    #[inline]
    pub fn get(&self, address: usize) -> u64 {
        let (place, shift) = Self::place(address);
        let raw = self.bits.as_raw_slice();
        let low = raw.get(place).copied().unwrap_or(0) >> shift;
        let high = raw.get(place + 1).copied().unwrap_or(0);
        (low | high << 1 << (63 - shift)) & Self::MASK
    }

    /// Replaces the word at `address`, which wraps at the number of words, by the low `D` bits
    /// of `word`.
    #[inline]
    pub fn set(&mut self, address: usize, word: u64) {
        let (place, shift) = Self::place(address);
        let word = word & Self::MASK;
        let raw = self.bits.as_raw_mut_slice();
        if let Some(low) = raw.get_mut(place) {
            *low = *low & !(Self::MASK << shift) | word << shift;
        }
        if let Some(high) = raw.get_mut(place + 1) {
            let mask = Self::MASK >> 1 >> (63 - shift);
            *high = *high & !mask | word >> 1 >> (63 - shift);
        }
    }

    const MASK: u64 = u64::MAX >> (64 - D);

    /// The storage element that a word begins in, and the bit.
    #[inline]
    fn place(address: usize) -> (usize, usize) {
        let bit = address % Self::WORDS * D;
        (bit / 64, bit % 64)
    }

    /// Combinational read as a ROM.
    pub fn read<L: Logic>(&self, address: L::U<A>) -> L::U<D> {
        L::rom(self, address)
    }
}
