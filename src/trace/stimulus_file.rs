use crate::engine::Engine;
use crate::kernel::{
    Circuit, Field, Observer, Probe, RunError, Sample, Shape, Signals, width, widths,
};
use crate::logic::Sim;
use std::io::{self, Write};
use std::marker::PhantomData;
use std::ops::ControlFlow;

/// Bytes that are gathered before they are written.
const BUFFER: usize = 64 * 1024;

/// Writes what goes into a circuit as text, a line a tick, for a Verilog testbench that reads it
/// by `$fscanf(file, "%h", word)`.
///
/// A line is one hexadecimal word: the ports in side by side, the first in the lowest bits as
/// [`pack`](crate::kernel::pack) has them, and above them one bit for a synchronous reset in this
/// tick, which every word has. The word has as many digits as that takes.
///
/// As an observer it writes the inputs of a run tick by tick, which has no reset; a runner that resets calls
/// [`line`](StimulusFile::line) instead. It gathers its own blocks, so the writer needs no buffer.
/// Call [`finish`](StimulusFile::finish) after the run; without it the end is missing.
#[derive(Debug)]
#[must_use]
pub struct StimulusFile<C, W> {
    out: W,
    lines: Lines,
    /// The tick seen last.
    last: Option<u64>,
    circuit: PhantomData<fn(&C)>,
}

impl<C: Circuit, W: Write> StimulusFile<C, W> {
    /// Begins the stimulus of a circuit.
    pub fn new(out: W) -> Self {
        StimulusFile {
            out,
            lines: Lines::new(widths::<C::In<Sim>>()),
            last: None,
            circuit: PhantomData,
        }
    }

    /// The bits of a word: those of the ports in and that of the reset.
    pub fn bits() -> usize {
        width::<C::In<Sim>>() + 1
    }

    /// Writes the tick that comes next.
    ///
    /// # Errors
    /// The writer failed.
    pub fn line(&mut self, i: &C::In<Sim>, rst: bool) -> io::Result<()> {
        i.visit(const { &Field::named("") }, self.lines.begin());
        self.lines.end(rst, &mut self.out)
    }

    /// Hands everything to the writer, which it returns.
    ///
    /// # Errors
    /// The writer failed.
    pub fn finish(mut self) -> io::Result<W> {
        self.lines.finish(&mut self.out)?;
        Ok(self.out)
    }
}

impl<C: Circuit, W: Write> Observer<C> for StimulusFile<C, W> {
    fn needs_all(&self) -> bool {
        false
    }

    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        if let Some(last) = self.last.replace(now.tick)
            && last.checked_add(1) != Some(now.tick)
        {
            let problem = format!("tick {} does not follow tick {last}", now.tick);
            return Err(io::Error::new(io::ErrorKind::InvalidInput, problem).into());
        }
        self.lines.tick(now.engine(), false, &mut self.out)?;
        Ok(ControlFlow::Continue(()))
    }
}

/// The lines of a circuit whose type is forgotten: all of [`StimulusFile`] but the walk.
#[derive(Debug)]
pub(crate) struct Lines {
    word: Word,
    /// The ports that are written: those beside the circuit are not.
    widths: Vec<usize>,
    digits: usize,
    buffer: Vec<u8>,
}

impl Lines {
    /// None yet, of ports of these widths.
    pub(crate) fn new(widths: Vec<usize>) -> Self {
        let bits = widths.iter().sum::<usize>() + 1;
        Lines {
            word: Word::default(),
            widths,
            digits: bits.div_ceil(4),
            buffer: Vec::with_capacity(BUFFER + BUFFER / 8),
        }
    }

    /// Begins a line; the word is to see the ports in.
    fn begin(&mut self) -> &mut Word {
        self.word.clear();
        &mut self.word
    }

    /// Ends it.
    fn end(&mut self, rst: bool, out: &mut dyn Write) -> io::Result<()> {
        self.word.push(rst.into(), 1);
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
            self.word.push(engine.port(port), width);
        }
        self.end(rst, out)
    }

    /// Hands everything to the writer.
    pub(crate) fn finish(&self, out: &mut dyn Write) -> io::Result<()> {
        out.write_all(&self.buffer)?;
        out.flush()
    }
}

/// Leaves side by side, in storage that is used again.
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

    /// Puts `bits`, which has zeros above `width`, on top.
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

    /// The hexadecimal digit at `place`, 0 the lowest.
    fn digit(&self, place: usize) -> u8 {
        let part = self.parts.get(place / 16).copied().unwrap_or(0);
        b"0123456789abcdef"[(part >> (place % 16 * 4) & 15) as usize]
    }
}

impl Probe for Word {
    fn leaf(&mut self, _: &'static Field, shape: Shape, bits: u64) {
        self.push(bits, shape.width);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::Random;
    use crate::kernel::pack;
    use crate::logic::sim::{Int, UInt};

    #[test]
    fn a_word_is_packed_as_pack_does_it() {
        type Bundle = [[UInt<13>; 3]; 4];
        let mut random = Random::new(3);
        for _ in 0..100 {
            let (unsigned, signed): (Bundle, [Int<64>; 3]) = (random.signals(), random.signals());
            let mut word = Word::default();
            unsigned.visit(const { &Field::named("") }, &mut word);
            assert_eq!(
                (word.filled, &word.parts),
                (156, &pack(&unsigned).into_vec())
            );
            word.clear();
            signed.visit(const { &Field::named("") }, &mut word);
            assert_eq!((word.filled, &word.parts), (192, &pack(&signed).into_vec()));
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
