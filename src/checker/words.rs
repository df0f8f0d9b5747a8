//! Ports of a tick side by side in words of 64 bits.

use crate::netlist::Shape;
use crate::sim::PortDirection;

/// Place of a port in the words of a tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Place {
    /// Index of the word.
    pub word: usize,
    /// Lowest bit of the port in the word.
    pub low: usize,
    /// Width of the port in bits.
    pub width: usize,
}

impl Place {
    /// Returns a mask of the port's bits in its word.
    pub fn mask(self) -> u64 {
        (u64::MAX >> (64 - self.width)) << self.low
    }

    /// Returns the port's bits from its word.
    #[inline]
    pub fn bits(self, word: u64) -> u64 {
        word >> self.low & (u64::MAX >> (64 - self.width))
    }
}

/// Words that carry all ports of a tick: the input ports first, then, from a new word on, the
/// output ports. A port lies within one word; each lies above the port before it if there is room.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PortWords {
    /// Places of the input ports.
    pub inputs: Vec<Place>,
    /// Places of the output ports.
    pub outputs: Vec<Place>,
    /// Number of words with input ports.
    pub input_words: usize,
    /// Number of words.
    pub words: usize,
}

impl PortWords {
    /// Places ports of these widths, 1 to 64 each.
    ///
    /// ```
    /// use motion_rtl::checker::PortWords;
    ///
    /// let words = PortWords::of([1, 32, 32, 31], [1]);
    /// let lows = words.inputs.iter().map(|place| (place.word, place.low));
    /// assert_eq!(lows.collect::<Vec<_>>(), [(0, 0), (0, 1), (1, 0), (1, 32)]);
    /// assert_eq!((words.outputs[0].word, words.words), (2, 3));
    /// ```
    pub fn of(
        inputs: impl IntoIterator<Item = usize>,
        outputs: impl IntoIterator<Item = usize>,
    ) -> Self {
        let (inputs, input_words) = placed(inputs, 0);
        let (outputs, words) = placed(outputs, input_words);
        PortWords {
            inputs,
            outputs,
            input_words,
            words,
        }
    }

    /// Places ports with their directions.
    pub(crate) fn of_ports(ports: impl Iterator<Item = (PortDirection, Shape)> + Clone) -> Self {
        let of = |direction| {
            let ports = ports.clone().filter(move |(own, _)| *own == direction);
            ports.map(|(_, shape)| shape.width)
        };
        PortWords::of(of(PortDirection::In), of(PortDirection::Out))
    }
}

/// Places ports from a word on; returns the index of the word after them too.
fn placed(widths: impl IntoIterator<Item = usize>, first: usize) -> (Vec<Place>, usize) {
    let (mut word, mut low) = (first, 64);
    let place = |width: usize| {
        if low + width > 64 {
            (word, low) = (word + 1, 0);
        }
        low += width;
        Place {
            word: word - 1,
            low: low - width,
            width,
        }
    };
    let places: Vec<Place> = widths.into_iter().map(place).collect();
    let end = places.last().map_or(first, |last| last.word + 1);
    (places, end)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ports_fill_words_and_never_cross_them() {
        let words = PortWords::of([64, 1, 63, 1], [40, 24, 25]);
        let places = |places: &[Place]| -> Vec<(usize, usize)> {
            places.iter().map(|place| (place.word, place.low)).collect()
        };
        assert_eq!(places(&words.inputs), [(0, 0), (1, 0), (1, 1), (2, 0)]);
        assert_eq!(places(&words.outputs), [(3, 0), (3, 40), (4, 0)]);
        assert_eq!((words.input_words, words.words), (3, 5));
        assert_eq!(words.inputs[0].mask(), u64::MAX);
        assert_eq!(words.inputs[2].mask(), u64::MAX << 1);
        assert_eq!(words.outputs[1].bits(0xabcd_ef12_3456_789a), 0xab_cdef);
    }

    #[test]
    fn without_ports_there_are_no_words() {
        let none = PortWords::of([], []);
        assert_eq!((none.input_words, none.words), (0, 0));
        assert_eq!(PortWords::of([], [3]).outputs[0].word, 0);
    }
}
