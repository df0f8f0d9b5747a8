//! Dumps in the format of `fstapi.c`, which comes with GTKWave.
//!
//! The crate `fst-writer` knows no strings of varying length and takes every value as text.

mod encoder;
mod header;
mod sorted;
mod varint;

use super::behind::Behind;
use super::dump::Dump;
use super::layout::Layout;
use super::{Clock, Options};
use crate::kernel::{Circuit, Observer, RunError, Sample};
use std::io::{self, Seek, Write};
use std::marker::PhantomData;
use std::ops::ControlFlow;

pub(super) use encoder::Encoder;

/// Writes every signal of a run, and `clk`, in the format FST of GTKWave: the same signals, names
/// and values at the same times as [`Vcd`](super::Vcd) in a fraction of the bytes.
///
/// What changes is gathered in sections; a thread compresses and writes them. It holds three
/// sections of about 3 MB, however long the run is. Call [`finish`](Fst::finish) after the run;
/// without it the file cannot be read. The file holds no date: the same run gives the same bytes.
#[derive(Debug)]
#[must_use]
pub struct Fst<C, W> {
    dump: Dump<Behind<Encoder<W>>>,
    circuit: PhantomData<fn(&C)>,
}

impl<C: Circuit, W: Write + Seek + Send + 'static> Fst<C, W> {
    /// Begins a dump of `circuit` to `out` and writes what stands at its head.
    ///
    /// # Errors
    /// A name that is used twice in a scope or cannot be written or a selected path that does not
    /// exist, as a [`LayoutError`](super::LayoutError) within; the writer failed.
    pub fn new(out: W, _: &C, clock: Clock, options: &Options) -> io::Result<Self> {
        let layout = Layout::of::<C>(options.only.as_deref())?;
        let file = Behind::new(Encoder::new(out, &layout, clock)?)?;
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
    fn next_look(&self, tick: u64) -> u64 {
        self.dump.next_look(tick)
    }

    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        self.dump.sample(now)
    }
}
