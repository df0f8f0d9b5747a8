//! Memory of the interpolator: one word per axis and unit time.

use super::error::TableError;
use super::packed::{PackedWords, UnitWords};

/// Greatest number of unit times in a table: 100 MB of words for three axes, or several times that
/// if more than 256 differ.
pub const MAX_UNITS: usize = 1 << 25;

/// Memory word: bit 31 is the direction (1 = negative), the rest the half-period in ticks (0 = no
/// pulse).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Word(u32);

impl Word {
    const NEGATIVE: u32 = 1 << 31;

    /// Creates a word of `half_period` ticks, of which only the low 31 bits are used.
    #[must_use]
    pub const fn new(half_period: u32, negative: bool) -> Self {
        let direction = if negative { Self::NEGATIVE } else { 0 };
        Self(half_period & !Self::NEGATIVE | direction)
    }

    /// Returns the half-period in ticks; 0 = no pulse.
    #[must_use]
    pub const fn half_period(self) -> u32 {
        self.0 & !Self::NEGATIVE
    }

    /// True if the direction is negative.
    #[must_use]
    pub const fn negative(self) -> bool {
        self.0 & Self::NEGATIVE != 0
    }

    /// Returns the word as stored.
    #[must_use]
    pub const fn bits(self) -> u32 {
        self.0
    }
}

/// Run of unit times of one length (paragraph 0014: T1 for arcs, T2 for lines).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pattern {
    /// Unit time T in ticks.
    pub period: u32,
    /// First unit, from 0.
    pub first_unit: usize,
    /// Number of units.
    pub length: usize,
}

/// Contents of the memory: one [`Word`] per axis for every unit time, and the patterns that give
/// the length of the unit times.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    pub(super) clock_hz: u64,
    pub(super) axes: usize,
    pub(super) half_period_bits: u32,
    pub(super) words: PackedWords,
    pub(super) patterns: Vec<Pattern>,
}

impl Table {
    pub(super) fn new(clock_hz: u64, axes: usize, half_period_bits: u32) -> Self {
        Self {
            clock_hz,
            axes,
            half_period_bits,
            words: PackedWords::default(),
            patterns: Vec::new(),
        }
    }

    /// Opens a unit of `period` ticks; its words follow by [`Table::push`].
    pub(super) fn open_unit(&mut self, period: u32) -> Result<(), TableError> {
        let unit = self.units();
        if unit >= MAX_UNITS {
            return Err(TableError::TooLong {
                units: unit as f64 + 1.0,
                most: MAX_UNITS,
            });
        }
        match self.patterns.last_mut() {
            Some(pattern) if pattern.period == period => pattern.length += 1,
            _ => self.patterns.push(Pattern {
                period,
                first_unit: unit,
                length: 1,
            }),
        }
        Ok(())
    }

    /// Returns an empty table for the same axes.
    pub(in crate::jobs::pulse_interpolator) fn empty(&self) -> Self {
        Self::new(self.clock_hz, self.axes, self.half_period_bits)
    }

    /// Returns the same words with a unit time of `period` ticks; patterns stay separate.
    pub(in crate::jobs::pulse_interpolator) fn at_period(&self, period: u32) -> Self {
        let patterns = self.patterns.iter();
        Self {
            patterns: patterns.map(|part| Pattern { period, ..*part }).collect(),
            ..self.clone()
        }
    }

    /// Returns the same words with the given T of each unit.
    pub(in crate::jobs::pulse_interpolator) fn with_periods(
        &self,
        periods: &[u32],
    ) -> Result<Self, TableError> {
        let mut table = self.empty();
        for ((_, words), period) in self.iter().zip(periods) {
            table.open_unit(*period)?;
            words.iter().for_each(|word| table.push(*word));
        }
        Ok(table)
    }

    /// Appends the units of another table.
    pub(in crate::jobs::pulse_interpolator) fn append(
        &mut self,
        other: &Self,
    ) -> Result<(), TableError> {
        for (period, words) in other.iter() {
            self.open_unit(period)?;
            words.iter().for_each(|word| self.push(*word));
        }
        Ok(())
    }

    pub(super) fn push(&mut self, word: Word) {
        self.words.push(word);
    }

    /// Returns the reference clock in Hz.
    #[must_use]
    pub fn clock_hz(&self) -> u64 {
        self.clock_hz
    }

    /// Returns the number of axes.
    #[must_use]
    pub fn axes(&self) -> usize {
        self.axes
    }

    /// Returns the width of the half-period in bits.
    #[must_use]
    pub fn half_period_bits(&self) -> u32 {
        self.half_period_bits
    }

    /// Returns the number of unit times.
    #[must_use]
    pub fn units(&self) -> usize {
        self.words.len() / self.axes
    }

    /// Returns all words: those of unit 0 (X first), those of unit 1, and so on.
    pub fn words(&self) -> impl Iterator<Item = Word> {
        (0..self.words.len()).map(|place| self.words.at(place))
    }

    /// Returns the word of an axis in an existing unit.
    pub(in crate::jobs::pulse_interpolator) fn word(&self, unit: usize, axis: usize) -> Word {
        self.words.at(unit * self.axes + axis)
    }

    /// Returns the words of one unit, X first; `None` beyond the end.
    #[must_use]
    pub fn unit(&self, unit: usize) -> Option<UnitWords> {
        (unit < self.units()).then(|| UnitWords::of(&self.words, unit, self.axes))
    }

    /// Returns the patterns in order; neighbours differ in their unit time.
    #[must_use]
    pub fn patterns(&self) -> &[Pattern] {
        &self.patterns
    }

    /// Returns every unit in order: its unit time in ticks and its words.
    pub fn iter(&self) -> impl Iterator<Item = (u32, UnitWords)> {
        let periods = self
            .patterns
            .iter()
            .flat_map(|p| std::iter::repeat_n(p.period, p.length));
        let unit = |unit| UnitWords::of(&self.words, unit, self.axes);
        periods.zip((0..self.units()).map(unit))
    }

    /// Returns the length of the whole table in ticks.
    #[must_use]
    pub fn total_ticks(&self) -> u64 {
        self.patterns
            .iter()
            .map(|p| u64::from(p.period) * p.length as u64)
            .sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn word_packs_direction_and_half_period() {
        for (n, negative) in [
            (0, false),
            (0, true),
            (1, true),
            (Word::NEGATIVE - 1, false),
        ] {
            let word = Word::new(n, negative);
            assert_eq!((word.half_period(), word.negative()), (n, negative));
        }
        assert_eq!(Word::new(5, true).bits(), 0x8000_0005);
    }

    #[test]
    fn units_of_one_period_share_a_pattern() {
        let mut table = Table::new(1000, 2, 16);
        for period in [10, 10, 7, 10] {
            table.open_unit(period).unwrap();
            table.push(Word::new(period, false));
            table.push(Word::new(0, true));
        }
        let patterns: Vec<_> = table
            .patterns()
            .iter()
            .map(|p| (p.period, p.first_unit, p.length))
            .collect();
        assert_eq!(patterns, [(10, 0, 2), (7, 2, 1), (10, 3, 1)]);
        assert_eq!((table.units(), table.total_ticks()), (4, 37));
        assert_eq!(
            table.unit(2).as_deref(),
            Some(&[Word::new(7, false), Word::new(0, true)][..])
        );
        assert!(table.unit(4).is_none());
        assert!(
            table
                .iter()
                .all(|(period, words)| words[0].half_period() == period)
        );
    }
}
