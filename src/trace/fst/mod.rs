//! Dumps in the FST format of GTKWave's `fstapi.c`.
//!
//! The crates `fst-writer` and `wavefst` take every value as text, which costs more time than all of
//! this encoder. `fst-writer` has no strings of variable length and no tables of states; `wavefst`
//! needs a C compiler.

mod encoder;
mod header;
mod sorted;
mod varint;

use super::behind::Behind;
use super::dump::{Dump, observes};
use super::layout::Layout;
use super::{Clock, Options};
use crate::sim::Described;
use std::io::{self, Seek, Write};

pub(super) use encoder::Encoder;

/// Writes every signal of a run, and `clk`, in GTKWave's FST format: the same signals, names,
/// values and times as [`Vcd`](super::Vcd) in a fraction of the bytes. Input ports, and output
/// ports of the outermost circuit, have directions.
///
/// Changes are collected in sections; a thread compresses and writes them. Three sections of about
/// 3 MB, or of 128 bytes per signal if that is more, are kept in memory, however long the run is.
/// Each word of a memory is a signal. Call [`finish`](Fst::finish) after the run; without it the
/// file cannot be read. The file contains no date: the same run gives the same bytes.
#[derive(Debug)]
#[must_use]
pub struct Fst<W> {
    dump: Dump<Behind<Encoder<W>>>,
}

impl<W: Write + Seek + Send + 'static> Fst<W> {
    /// Begins a dump of `circuit` to `out` and writes the header.
    ///
    /// # Errors
    /// Returns a [`LayoutError`](super::LayoutError) inside if a name is duplicate in a scope or
    /// cannot be written, or a selected path does not exist. Returns an error if the writer
    /// failed.
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
    /// Returns an error if the writer failed.
    pub fn finish(self) -> io::Result<W> {
        self.dump.finish()
    }
}

observes!([W: Write + Seek + Send + 'static] Fst<W>);
