use crate::engine::{Engine, InputError};
use crate::hdl::Circuit;
use crate::netlist::Role;
use crate::sim::{Described, Needs, Observer, RunError, Sample};
use std::io::{self, Write};
use std::ops::ControlFlow;

/// Bytes that are collected before they are written.
const BUFFER: usize = 64 * 1024;

/// Writes the inputs of a circuit as text, one line per tick, for a Verilog testbench that reads
/// them by `$fscanf(file, "%h", word)`.
///
/// A line is one hexadecimal word: the input ports side by side, the first in the lowest bits, and
/// above them one bit for a synchronous reset in this tick. Every word has that bit and the same
/// number of digits.
///
/// When used as an observer, it writes the inputs of a run tick by tick, without resets. A runner
/// that resets calls [`line`](StimulusFile::line) instead. Output is buffered, so the writer needs no
/// buffer. Call [`finish`](StimulusFile::finish) after the run; without it the end is missing.
#[derive(Debug)]
#[must_use]
pub struct StimulusFile<W> {
    out: W,
    lines: Lines,
    /// Tick seen last.
    last: Option<u64>,
}

/// Kind of the file in errors.
const STIMULUS: &str = "stimulus";

impl<W: Write> StimulusFile<W> {
    /// Begins the stimulus of a circuit.
    pub fn new(out: W, circuit: &impl Described) -> Self {
        let (_, declarations) = circuit.outlined();
        let ports = declarations.leaves.iter();
        let ports = ports.take_while(|leaf| leaf.role == Role::Input);
        StimulusFile {
            out,
            lines: Lines::new(ports.map(|port| port.shape.width).collect()),
            last: None,
        }
    }

    /// Returns the number of bits of a word: input ports and reset.
    pub fn bits(&self) -> usize {
        self.lines.widths.iter().sum::<usize>() + 1
    }

    /// Writes the next tick: the words of its input ports.
    ///
    /// # Errors
    /// Returns an error if the writer failed, there is not one word per input port, or a word is
    /// wider than its port.
    pub fn line(&mut self, i: &[u64], rst: bool) -> io::Result<()> {
        let refused = |error| io::Error::new(io::ErrorKind::InvalidInput, error);
        self.lines.check(i).map_err(refused)?;
        self.lines.word.clear();
        for (word, &width) in i.iter().zip(&self.lines.widths) {
            self.lines.word.push(*word, width);
        }
        self.lines.end(rst, &mut self.out)
    }

    /// Writes everything that is buffered and returns the writer.
    ///
    /// # Errors
    /// Returns an error if the writer failed.
    pub fn finish(mut self) -> io::Result<W> {
        self.lines.finish(&mut self.out)?;
        Ok(self.out)
    }
}

impl<W: Write> StimulusFile<W> {
    fn note(&mut self, tick: u64, engine: &Engine) -> Result<ControlFlow<()>, RunError> {
        if let Some(last) = self.last.replace(tick)
            && last.checked_add(1) != Some(tick)
        {
            let problem = format!("tick {tick} does not follow tick {last}");
            let error = io::Error::new(io::ErrorKind::InvalidInput, problem);
            return Err(RunError::of_file(STIMULUS)(error));
        }
        let tick = self.lines.tick(engine, false, &mut self.out);
        tick.map_err(RunError::of_file(STIMULUS))?;
        Ok(ControlFlow::Continue(()))
    }
}

impl<C: Circuit, W: Write> Observer<C> for StimulusFile<W> {
    fn needs(&self) -> Needs {
        Needs::NONE
    }

    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        self.note(now.tick, now.engine())
    }
}

/// Lines of a stimulus: everything in [`StimulusFile`] that does not depend on the circuit's type.
#[derive(Debug)]
pub(crate) struct Lines {
    word: Word,
    /// Widths of the ports written; signals beside the circuit are not written.
    widths: Vec<usize>,
    digits: usize,
    buffer: Vec<u8>,
}

impl Lines {
    /// Begins a stimulus of ports with these widths.
    pub(crate) fn new(widths: Vec<usize>) -> Self {
        let bits = widths.iter().sum::<usize>() + 1;
        Lines {
            word: Word::default(),
            widths,
            digits: bits.div_ceil(4),
            buffer: Vec::with_capacity(BUFFER + BUFFER / 8),
        }
    }

    /// Begins lines of ports of these widths, without the bit of a reset.
    pub(crate) fn without_reset(widths: Vec<usize>) -> Self {
        let bits = widths.iter().sum::<usize>();
        Lines {
            digits: bits.div_ceil(4),
            ..Lines::new(widths)
        }
    }

    /// Checks the words of a tick.
    fn check(&self, words: &[u64]) -> Result<(), InputError> {
        let (words_given, ports) = (words.len(), self.widths.len());
        if words_given != ports {
            let words = words_given;
            return Err(InputError::Count { words, ports });
        }
        let mut words = words.iter().zip(&self.widths).enumerate();
        words.try_for_each(|(port, (&word, &width))| match word >> (width - 1) >> 1 {
            0 => Ok(()),
            _ => Err(InputError::bits(port.to_string(), word, width)),
        })
    }

    /// Ends the line.
    fn end(&mut self, rst: bool, out: &mut dyn Write) -> io::Result<()> {
        self.word.push(rst.into(), 1);
        self.print(out)
    }

    /// Writes a line without a reset.
    pub(crate) fn line(
        &mut self,
        words: impl Iterator<Item = u64>,
        out: &mut dyn Write,
    ) -> io::Result<()> {
        self.word.clear();
        for (word, &width) in words.zip(&self.widths) {
            self.word.push(word, width);
        }
        self.print(out)
    }

    fn print(&mut self, out: &mut dyn Write) -> io::Result<()> {
        let digits = (0..self.digits).rev().map(|place| self.word.digit(place));
        self.buffer.extend(digits);
        self.buffer.push(b'\n');
        if self.buffer.len() >= BUFFER {
            out.write_all(&self.buffer)?;
            self.buffer.clear();
        }
        Ok(())
    }

    /// Writes a tick.
    pub(crate) fn tick(
        &mut self,
        engine: &Engine,
        rst: bool,
        out: &mut dyn Write,
    ) -> io::Result<()> {
        self.word.clear();
        for (port, &width) in self.widths.iter().enumerate() {
            self.word.push(engine.port(port).unwrap_or(0), width);
        }
        self.end(rst, out)
    }

    /// Writes everything that is buffered.
    pub(crate) fn finish(&self, out: &mut dyn Write) -> io::Result<()> {
        out.write_all(&self.buffer)?;
        out.flush()
    }
}

/// Leaves side by side, in reused storage.
#[derive(Debug, Default)]
struct Word {
    parts: Vec<u64>,
    filled: usize,
}

impl Word {
    fn clear(&mut self) {
        self.parts.clear();
        self.filled = 0;
    }

    /// Appends `bits`, which has zeros above `width`, at the top.
    fn push(&mut self, bits: u64, width: usize) {
        let shift = self.filled % 64;
        match self.parts.last_mut() {
            Some(last) if shift > 0 => {
                *last |= bits << shift;
                if shift + width > 64 {
                    self.parts.push(bits >> (64 - shift));
                }
            }
            _ => self.parts.push(bits),
        }
        self.filled += width;
    }

    /// Returns the hexadecimal digit at `place`; 0 is the lowest.
    fn digit(&self, place: usize) -> u8 {
        let part = self.parts.get(place / 16).copied().unwrap_or(0);
        b"0123456789abcdef"[(part >> (place % 16 * 4) & 15) as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bitvec::prelude::*;

    #[test]
    fn words_stand_side_by_side() {
        for case in 0..100 {
            // Golden-ratio steps: all bits vary.
            let mixed = |index: u64| (12 * case + index + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
            let words: Vec<u64> = (0..12).map(|index| mixed(index) >> 51).collect();
            let mut word = Word::default();
            let mut bits = BitVec::<usize, Lsb0>::new();
            for part in &words {
                word.push(*part, 13);
                bits.extend_from_bitslice(&part.view_bits::<Lsb0>()[..13]);
            }
            assert_eq!(
                (word.filled, &word.parts),
                (156, &bits.chunks(64).map(|word| word.load_le()).collect())
            );
        }
    }

    #[test]
    fn digits_come_from_the_parts() {
        let mut word = Word::default();
        word.push(0x0123_4567_89ab_cdef, 64);
        word.push(0xa, 4);
        let digits: Vec<_> = (0..18).rev().map(|place| word.digit(place)).collect();
        assert_eq!(digits, b"0a0123456789abcdef");
    }
}
