//! Dumps in the format of `fstapi.c`, which comes with GTKWave.
//!
//! The crate `fst-writer` knows no strings of varying length and takes every value as text.

mod encoder;
mod header;
mod section;
mod varint;

use super::behind::Behind;
use super::dump::{Dump, Format};
use super::layout::Layout;
use super::walk::Change;
use super::{Clock, Options};
use crate::kernel::{Circuit, Machine, Observer, RunError, Sample};
use encoder::Encoder;
use section::{Section, Tick};
use std::io::{self, Seek, Write};
use std::marker::PhantomData;
use std::ops::ControlFlow;

/// Changes and ticks from which on a section is full.
const CHANGES: usize = 128 * 1024;
const TICKS: usize = 32 * 1024;

/// Writes every signal of a run, and `clk`, in the format FST of GTKWave: the same signals, names
/// and values at the same times as [`Vcd`](super::Vcd) in a fraction of the bytes.
///
/// What changes is gathered in sections; a thread compresses and writes them. It holds three
/// sections of about 3 MB, however long the run is. Call [`finish`](Fst::finish) after the run;
/// without it the file cannot be read. The file holds no date: the same run gives the same bytes.
#[derive(Debug)]
#[must_use]
pub struct Fst<C, W> {
    dump: Dump<FstFile<W>>,
    circuit: PhantomData<fn(&C)>,
}

impl<C: Circuit, W: Write + Seek + Send + 'static> Fst<C, W> {
    /// Begins a dump of `circuit` to `out` and writes what stands at its head.
    ///
    /// # Errors
    /// A name that is used twice in a scope or cannot be written or a selected path that does not
    /// exist, as a [`LayoutError`](super::LayoutError) within; the writer failed.
    pub fn new(out: W, circuit: &C, clock: Clock, options: &Options) -> io::Result<Self> {
        let layout = Layout::of(&Machine::new(circuit), options.only.as_deref())?;
        let file = FstFile::new(out, &layout, clock)?;
        Ok(Fst {
            dump: Dump::new(&layout, clock, options, file),
            circuit: PhantomData,
        })
    }

    /// Gives the last tick its full length, waits until everything is written and returns the
    /// writer.
    ///
    /// # Errors
    /// The writer failed.
    pub fn finish(self) -> io::Result<W> {
        self.dump.finish()
    }
}

impl<C: Circuit, W: Write + Seek + Send + 'static> Observer<C> for Fst<C, W> {
    #[inline(always)]
    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        self.dump.sample(now)
    }
}

/// A file in the format FST as it is written.
#[derive(Debug)]
pub(super) struct FstFile<W> {
    section: Section,
    encoder: Behind<Section, Encoder<W>>,
}

impl<W: Write + Seek + Send + 'static> FstFile<W> {
    pub fn new(out: W, layout: &Layout, clock: Clock) -> io::Result<Self> {
        let encoder = Encoder::new(out, layout, clock)?;
        Ok(FstFile {
            section: Section::default(),
            encoder: Behind::new(encoder, Encoder::write)?,
        })
    }

    fn hand_over(&mut self, changes: &mut Vec<Change>) -> io::Result<()> {
        std::mem::swap(changes, &mut self.section.changes);
        self.encoder.hand_over(&mut self.section)?;
        std::mem::swap(changes, &mut self.section.changes);
        Ok(())
    }
}

impl<W: Write + Seek + Send + 'static> Format for FstFile<W> {
    type Out = W;

    #[inline(never)]
    fn tick(&mut self, rise: u64, fall: u64, changes: &mut Vec<Change>) -> io::Result<()> {
        self.section.ticks.push(Tick {
            rise,
            fall,
            changes: changes.len(),
        });
        if changes.len() >= CHANGES || self.section.ticks.len() >= TICKS {
            self.hand_over(changes)?;
        }
        Ok(())
    }

    fn finish(mut self, end: Option<u64>, changes: &mut Vec<Change>) -> io::Result<W> {
        self.section.end = end;
        self.hand_over(changes)?;
        self.encoder.finish()?.finish()
    }
}
