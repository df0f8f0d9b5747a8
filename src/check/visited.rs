use super::enumerate::scramble;
use std::collections::HashSet;
use std::hash::{BuildHasherDefault, Hasher};

/// Greatest width of a state for a bitmap, in bits: 8 GiB.
const WIDEST_BITMAP: usize = 36;

/// Packed states that were visited.
pub(crate) enum Visited {
    /// One bit for every possible state.
    Bitmap(Vec<u64>),
    /// Set of visited states.
    Set(HashSet<u64, BuildHasherDefault<WordHasher>>),
}

impl Visited {
    /// Creates an empty set for states of `bits` bits; a bitmap if they have at most
    /// `bitmap_bits`.
    pub(crate) fn new(bits: usize, bitmap_bits: usize) -> Self {
        if bits <= bitmap_bits.min(WIDEST_BITMAP) {
            // Pages without a visited state never become resident.
            Visited::Bitmap(vec![0; (1usize << bits).div_ceil(64)])
        } else {
            Visited::Set(HashSet::default())
        }
    }

    /// Adds a state; returns true if it is new.
    #[inline]
    pub(crate) fn insert(&mut self, state: u64) -> bool {
        match self {
            Visited::Bitmap(words) => {
                let (word, bit) = (&mut words[(state / 64) as usize], 1 << (state % 64));
                let is_new = *word & bit == 0;
                *word |= bit;
                is_new
            }
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
