use super::enumerate::scramble;
use bitvec::prelude::*;
use std::collections::HashSet;
use std::hash::{BuildHasherDefault, Hasher};

/// Greatest width of a state for a bitmap, in bits: 8 GiB.
const WIDEST_BITMAP: usize = 36;

/// Packed states that were visited.
pub(crate) enum Visited {
    /// One bit for every possible state.
    Bitmap(BitVec<usize, Lsb0>),
    /// Set of visited states.
    Set(HashSet<u64, BuildHasherDefault<WordHasher>>),
}

impl Visited {
    /// Creates an empty set for states of `bits` bits; a bitmap if they have at most
    /// `bitmap_bits`.
    pub(crate) fn new(bits: usize, bitmap_bits: usize) -> Self {
        if bits <= bitmap_bits.min(WIDEST_BITMAP) {
            // Made from zeroed words and not by `repeat`: pages without a visited state then never
            // become resident.
            Visited::Bitmap(BitVec::from_vec(vec![
                0;
                (1usize << bits)
                    .div_ceil(usize::BITS as usize)
            ]))
        } else {
            Visited::Set(HashSet::default())
        }
    }

    /// Adds a state; returns true if it is new.
    #[inline]
    pub(crate) fn insert(&mut self, state: u64) -> bool {
        match self {
            Visited::Bitmap(bits) => !bits.replace(state as usize, true),
            Visited::Set(states) => states.insert(state),
        }
    }
}

/// Hasher of one `u64`; the keyed default hash would cost more than the circuit.
#[derive(Default)]
pub(crate) struct WordHasher(u64);

impl Hasher for WordHasher {
    fn finish(&self) -> u64 {
        self.0
    }
    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.write_u64(byte.into());
        }
    }
    #[inline]
    fn write_u64(&mut self, word: u64) {
        self.0 = scramble(self.0 ^ word);
    }
}
