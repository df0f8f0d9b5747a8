//! Compact storage of many words, few of which differ.

use super::words::Word;
use crate::circuits::pulse_interpolator::AXES_MAX;
use rustc_hash::FxHashMap;
use std::ops::Deref;

/// Indices of words, as wide as the greatest needs.
#[derive(Debug, Clone)]
enum Numbers {
    Bytes(Vec<u8>),
    Halves(Vec<u16>),
    Whole(Vec<u32>),
}

/// Words in order, each an index into the list of distinct words: one byte while there are at most
/// 256 of these.
#[derive(Debug, Clone)]
pub(super) struct PackedWords {
    numbers: Numbers,
    /// Distinct words.
    differing: Vec<Word>,
    number_of: FxHashMap<u32, u32>,
}

impl Default for PackedWords {
    fn default() -> Self {
        PackedWords {
            numbers: Numbers::Bytes(Vec::new()),
            differing: Vec::new(),
            number_of: FxHashMap::default(),
        }
    }
}

impl PackedWords {
    pub(super) fn len(&self) -> usize {
        match &self.numbers {
            Numbers::Bytes(all) => all.len(),
            Numbers::Halves(all) => all.len(),
            Numbers::Whole(all) => all.len(),
        }
    }

    /// Returns the word at an existing position.
    pub(super) fn at(&self, place: usize) -> Word {
        let number = match &self.numbers {
            Numbers::Bytes(all) => usize::from(all[place]),
            Numbers::Halves(all) => usize::from(all[place]),
            Numbers::Whole(all) => all[place] as usize,
        };
        self.differing[number]
    }

    pub(super) fn push(&mut self, word: Word) {
        let number = self.number(word);
        match &mut self.numbers {
            Numbers::Bytes(all) => all.push(number as u8),
            Numbers::Halves(all) => all.push(number as u16),
            Numbers::Whole(all) => all.push(number),
        }
    }

    /// Replaces the word at a position.
    pub(super) fn set(&mut self, place: usize, word: Word) {
        let number = self.number(word);
        match &mut self.numbers {
            Numbers::Bytes(all) => all[place] = number as u8,
            Numbers::Halves(all) => all[place] = number as u16,
            Numbers::Whole(all) => all[place] = number,
        }
    }

    /// Returns the index of a word, and widens the indices if necessary.
    fn number(&mut self, word: Word) -> u32 {
        let next = self.differing.len() as u32;
        let number = *self.number_of.entry(word.bits()).or_insert(next);
        if number == next {
            self.differing.push(word);
            self.widen(number);
        }
        number
    }

    fn widen(&mut self, number: u32) {
        match &self.numbers {
            Numbers::Bytes(all) if number > u32::from(u8::MAX) => {
                let all = all.iter().map(|number| u16::from(*number));
                self.numbers = Numbers::Halves(all.collect());
            }
            Numbers::Halves(all) if number > u32::from(u16::MAX) => {
                let all = all.iter().map(|number| u32::from(*number));
                self.numbers = Numbers::Whole(all.collect());
            }
            _ => (),
        }
    }
}

impl PartialEq for PackedWords {
    fn eq(&self, other: &Self) -> bool {
        let all = 0..self.len();
        self.len() == other.len() && all.into_iter().all(|k| self.at(k) == other.at(k))
    }
}

impl Eq for PackedWords {}

/// Words of a unit time, X first.
#[derive(Debug, Clone, Copy)]
pub struct UnitWords {
    words: [Word; AXES_MAX],
    axes: usize,
}

impl UnitWords {
    pub(super) fn of(packed: &PackedWords, unit: usize, axes: usize) -> Self {
        let mut words = [Word::new(0, false); AXES_MAX];
        for (axis, word) in words.iter_mut().enumerate().take(axes) {
            *word = packed.at(unit * axes + axis);
        }
        UnitWords { words, axes }
    }
}

impl Deref for UnitWords {
    type Target = [Word];

    fn deref(&self) -> &[Word] {
        &self.words[..self.axes]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_stay_what_they_are_however_many_differ() {
        let word = |k: u32| Word::new(k.wrapping_mul(2_654_435_761) >> 1, k.is_multiple_of(3));
        for many in [1, 256, 257, 65_536, 65_537, 70_000] {
            let mut packed = PackedWords::default();
            // An existing word gets no new index.
            (0..many).for_each(|k| packed.push(word(k)));
            (0..many).for_each(|k| packed.push(word(k / 2)));
            assert_eq!(packed.len(), 2 * many as usize);
            for k in 0..many {
                assert_eq!(packed.at(k as usize), word(k));
                assert_eq!(packed.at((many + k) as usize), word(k / 2));
            }
            let width = match packed.numbers {
                Numbers::Bytes(_) => 256,
                Numbers::Halves(_) => 65_536,
                Numbers::Whole(_) => u32::MAX,
            };
            assert!(many <= width, "{many}");
            let mut other = packed.clone();
            other.set(0, Word::new(5, true));
            assert_eq!(other.at(0), Word::new(5, true));
            assert!(other != packed);
            other.set(0, word(0));
            // Equal words are equal, whatever their indices are.
            assert!(other == packed);
        }
    }
}
