//! Input ports of a circuit and their ranges.

use super::elaborated::Declare;
use crate::engine::{InputChange, InputError};
use crate::netlist::{Design, Kind, Shape};
use std::fmt;

/// Input ports of an elaborated circuit; those beside it come last.
#[derive(Clone)]
pub(crate) struct Ports {
    ranges: Vec<Range>,
    /// Makes the names, for an error message.
    declare: Declare,
}

/// Range of one input port.
#[derive(Debug, Clone, Copy)]
struct Range {
    shape: Shape,
    /// Mask of the word's bits.
    mask: u64,
    /// Distance of the least value below 0.
    below: u64,
}

impl Range {
    fn of(shape: Shape) -> Self {
        Range {
            shape,
            mask: u64::MAX >> (64 - shape.width),
            below: match shape.kind {
                Kind::Signed => 1 << (shape.width - 1),
                Kind::Bit | Kind::Unsigned => 0,
            },
        }
    }

    /// True if 64 bits hold a number.
    #[inline]
    fn is_whole(self, number: i128) -> bool {
        self.shape.number(number as u64) == number
    }

    /// True if a 64-bit number is in the range; it is two's complement if the port is signed.
    #[inline]
    fn has(self, number: u64) -> bool {
        number.wrapping_add(self.below) & !self.mask == 0
    }
}

impl fmt::Debug for Ports {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(&self.ranges).finish()
    }
}

impl Ports {
    pub fn of(design: &Design, declare: &Declare) -> Self {
        let whole = design.modules.last();
        let ports = whole.into_iter().flat_map(|module| module.inputs());
        Ports {
            ranges: ports.map(|port| Range::of(port.shape)).collect(),
            declare: declare.clone(),
        }
    }

    /// Returns the number of input ports.
    pub fn count(&self) -> usize {
        self.ranges.len()
    }

    /// Converts a number to the bits of a port.
    #[inline]
    pub fn bits(&self, port: usize, number: u64) -> Result<u64, InputError> {
        match self.ranges.get(port) {
            Some(range) if range.has(number) => Ok(number & range.mask),
            _ => Err(self.refused_bits(port, number)),
        }
    }

    /// Converts a number of any size to the bits of a port.
    #[inline]
    pub fn bits_of(&self, port: usize, number: i128) -> Result<u64, InputError> {
        match self.ranges.get(port) {
            Some(range) if range.has(number as u64) && range.is_whole(number) => {
                Ok(number as u64 & range.mask)
            }
            _ => Err(self.refused(port, number)),
        }
    }

    /// Returns a mask of the bits of a port.
    pub fn mask(&self, port: usize) -> u64 {
        self.ranges.get(port).map_or(0, |range| range.mask)
    }

    /// Converts one number for each of the first `count` ports to bits.
    #[inline]
    pub fn all_bits(&self, count: usize, numbers: &mut [u64]) -> Result<(), InputError> {
        if numbers.len() != count {
            return Err(Ports::other_count(numbers.len(), count));
        }
        for (port, (number, range)) in numbers.iter_mut().zip(&self.ranges).enumerate() {
            if !range.has(*number) {
                return Err(self.refused_bits(port, *number));
            }
            *number &= range.mask;
        }
        Ok(())
    }

    /// Returns an error if a word has bits beyond the width of its port.
    pub fn check_word(&self, port: usize, word: u64) -> Result<(), InputError> {
        match self.ranges.get(port) {
            Some(range) if word & !range.mask == 0 => Ok(()),
            Some(range) => Err(InputError::bits(self.name(port), word, range.shape.width)),
            None => Err(self.refused_bits(port, word)),
        }
    }

    /// Checks one word for each port.
    pub fn check_words(&self, words: &[u64]) -> Result<(), InputError> {
        if words.len() != self.count() {
            return Err(Ports::other_count(words.len(), self.count()));
        }
        let mut words = words.iter().enumerate();
        words.try_for_each(|(port, word)| self.check_word(port, *word))
    }

    /// Checks a table of changes; returns the tick of the first one that is refused.
    pub fn check_changes(&self, changes: &[InputChange]) -> Result<(), (u64, InputError)> {
        let mut last: Vec<Option<u64>> = vec![None; self.count()];
        let mut before = 0;
        for &InputChange { tick, port, word } in changes {
            if tick < before {
                return Err((tick, InputError::Order { before }));
            }
            before = tick;
            self.check_word(port, word).map_err(|error| (tick, error))?;
            if last[port].replace(tick) == Some(tick) {
                let port = self.name(port);
                return Err((tick, InputError::Twice { port }));
            }
        }
        Ok(())
    }

    #[cold]
    fn other_count(words: usize, ports: usize) -> InputError {
        InputError::Count { words, ports }
    }

    #[cold]
    #[inline(never)]
    fn refused_bits(&self, port: usize, number: u64) -> InputError {
        let range = self.ranges.get(port);
        let number = range.map_or(number.into(), |range| range.shape.number(number));
        self.refused(port, number)
    }

    #[cold]
    #[inline(never)]
    fn refused(&self, port: usize, value: i128) -> InputError {
        let Some(range) = self.ranges.get(port) else {
            let ports = self.count();
            return InputError::Port { port, ports };
        };
        let (least, greatest) = range.shape.range();
        InputError::Range {
            port: self.name(port),
            value,
            least,
            greatest,
        }
    }

    /// Returns the name of a port below its circuit.
    fn name(&self, port: usize) -> String {
        let declared = (self.declare)();
        let names = declared.leaves.get(port).map(|leaf| leaf.names().skip(1));
        let names = names.map(|names| names.collect::<Vec<_>>().join("."));
        names.unwrap_or_else(|| port.to_string())
    }
}
