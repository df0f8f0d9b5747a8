//! Dumps in the format of `fstapi.c`, which comes with GTKWave.
//!
//! The crate `fst-writer` knows no strings of varying length and takes every value as text.

mod encoder;
mod header;
mod sorted;
mod varint;

use super::behind::Behind;
use super::dump::{Dump, observes};
use super::layout::Layout;
use super::{Clock, Options};
use crate::hdl::Described;
use std::io::{self, Seek, Write};

pub(super) use encoder::Encoder;

/// Writes every signal of a run, and `clk`, in the format FST of GTKWave: the same signals, names
/// and values at the same times as [`Vcd`](super::Vcd) in a fraction of the bytes. Ports in and the
/// ports out of the outermost circuit have their directions.
///
/// What changes is gathered in sections; a thread compresses and writes them. It holds three
/// sections of about 3 MB, however long the run is. Call [`finish`](Fst::finish) after the run;
/// without it the file cannot be read. The file holds no date: the same run gives the same bytes.
#[derive(Debug)]
#[must_use]
pub struct Fst<W> {
    dump: Dump<Behind<Encoder<W>>>,
}

impl<W: Write + Seek + Send + 'static> Fst<W> {
    /// Begins a dump of `circuit` to `out` and writes what stands at its head.
    ///
    /// # Errors
    /// A name that is used twice in a scope or cannot be written or a selected path that does not
    /// exist, as a [`LayoutError`](super::LayoutError) within; the writer failed.
    pub fn new(
        out: W,
        circuit: &impl Described,
        clock: Clock,
        options: &Options,
    ) -> io::Result<Self> {
        let layout = Layout::of(circuit, options.only.as_deref())?;
        let file = Behind::new(Encoder::new(out, &layout, clock)?)?;
        Ok(Fst {
            dump: Dump::new(&layout, clock, options, file),
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

observes!([W: Write + Seek + Send + 'static] Fst<W>);
