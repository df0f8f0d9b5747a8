use super::enumerate::scramble;
use bitvec::prelude::*;
use std::collections::HashSet;
use std::hash::{BuildHasherDefault, Hasher};

/// The widest state for which a bitmap can be asked for: 8 GiB of it.
const WIDEST_BITMAP: usize = 36;

/// The packed states that were seen.
pub(crate) enum Visited {
    /// A bit for every state there could be.
    Bitmap(BitVec<u64, Lsb0>),
    /// The states that there are.
    Set(HashSet<u64, BuildHasherDefault<WordHasher>>),
}

impl Visited {
    /// An empty set for states of `bits` bits, as a bitmap where they have at most `bitmap_bits`.
    pub(crate) fn new(bits: usize, bitmap_bits: usize) -> Self {
        if bits <= bitmap_bits.min(WIDEST_BITMAP) {
            // From zeroed words and not by `repeat`: the pages that no state falls on then never
            // become resident.
            Visited::Bitmap(BitVec::from_vec(vec![0; (1usize << bits).div_ceil(64)]))
        } else {
            Visited::Set(HashSet::default())
        }
    }

    /// Adds a state; whether it is new.
    #[inline]
    pub(crate) fn insert(&mut self, state: u64) -> bool {
        match self {
            Visited::Bitmap(bits) => !bits.replace(state as usize, true),
            Visited::Set(states) => states.insert(state),
        }
    }
}

/// Hashes one `u64`; the keyed default hash would cost more than the circuit.
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
