//! States of a search, packed.

/// List of states, each in as many bytes as its bits need.
pub(super) struct States {
    bytes: Vec<u8>,
    /// Bytes of a state.
    each: usize,
    count: usize,
}

/// Bytes behind the last state, so that each can be read as a whole word.
const SPARE: usize = 8;

impl States {
    /// Creates an empty list of states of `bits` bits, at most 64.
    pub fn new(bits: usize) -> Self {
        States {
            bytes: vec![0; SPARE],
            each: bits.div_ceil(8).max(1),
            count: 0,
        }
    }

    pub fn len(&self) -> usize {
        self.count
    }

    /// Adds a state.
    pub fn push(&mut self, state: u64) {
        let end = self.count * self.each;
        self.bytes.resize(end + self.each + SPARE, 0);
        self.bytes[end..end + SPARE].copy_from_slice(&state.to_le_bytes());
        self.count += 1;
    }

    /// Returns the state with this index.
    #[inline]
    pub fn get(&self, index: usize) -> Option<u64> {
        if index >= self.count {
            return None;
        }
        let begin = index * self.each;
        let mut word = [0; SPARE];
        word.copy_from_slice(&self.bytes[begin..begin + SPARE]);
        Some(u64::from_le_bytes(word) & u64::MAX >> (64 - 8 * self.each))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn states_come_back(bits in 1usize..=64, words in prop::collection::vec(any::<u64>(), 0..40)) {
            let mut states = States::new(bits);
            let words: Vec<u64> = words.iter().map(|word| word >> (64 - bits)).collect();
            for &word in &words {
                states.push(word);
            }
            let back: Vec<_> = (0..states.len()).map(|index| states.get(index)).collect();
            prop_assert_eq!(back, words.iter().copied().map(Some).collect::<Vec<_>>());
            prop_assert_eq!(states.get(words.len()), None);
            prop_assert_eq!(states.bytes.len(), bits.div_ceil(8) * words.len() + SPARE);
        }
    }
}
