mod file;
mod header;
mod text;
mod time;

use super::behind::Behind;
use super::dump::{Dump, observes};
use super::layout::Layout;
use super::{Clock, LayoutError, Options};
use crate::sim::Described;
use std::io::{self, Write};

pub(crate) use file::VcdFile;
pub(super) use text::eight_digits;

/// Writes every signal of a run, and `clk`, as a value change dump (IEEE 1364).
///
/// Tick n is sampled at time n·P with `clk` high; `clk` falls at n·P + P/2. A register therefore
/// shows at n + 1 what was decided at n. Registers are `reg`, everything else is `wire`. A signal
/// with named states has a string `<signal>_name` beside it. The words of a memory are in a scope
/// of the memory's name. A comment names the output ports. The dump contains no date: the same run
/// gives the same bytes.
///
/// Output is buffered in large blocks, so the writer needs no buffer. Call [`finish`](Vcd::finish)
/// after the run; without it the end of the dump is missing. If a second core is free,
/// [`VcdBehind`] is faster.
#[derive(Debug)]
#[must_use]
pub struct Vcd<W> {
    dump: Dump<VcdFile<W>>,
}

impl<W: Write> Vcd<W> {
    /// Prepares a dump of `circuit` to `out`.
    ///
    /// # Errors
    /// Returns an error if a name is duplicate in a scope or cannot be written, or a selected path
    /// does not exist. Nothing is written to `out` before the run.
    pub fn new(
        out: W,
        circuit: &impl Described,
        clock: Clock,
        options: &Options,
    ) -> Result<Self, LayoutError> {
        let layout = Layout::of(circuit, options.only.as_deref())?;
        let file = VcdFile::new(out, &layout, clock);
        Ok(Vcd {
            dump: Dump::new(&layout, clock, options, file),
        })
    }

    /// Gives the last tick its full length, writes everything and returns the writer.
    ///
    /// # Errors
    /// Returns an error if the writer failed.
    pub fn finish(self) -> io::Result<W> {
        self.dump.finish()
    }
}

observes!([W: Write] Vcd<W>);

/// [`Vcd`] on two threads: the run finds the changes, another thread formats and writes them. The
/// bytes are the same.
///
/// Changes are collected in three sections of about 0.3 MB, more if a tick changes more than
/// 16,384 signals; the run waits if the thread is slower. Call [`finish`](VcdBehind::finish) after
/// the run; without it the end of the dump is missing.
#[derive(Debug)]
#[must_use]
pub struct VcdBehind<W> {
    dump: Dump<Behind<VcdFile<W>>>,
}

impl<W: Write + Send + 'static> VcdBehind<W> {
    /// Prepares a dump of `circuit` to `out` and starts the thread.
    ///
    /// # Errors
    /// Returns a [`LayoutError`] inside if a name is duplicate in a scope or cannot be written, or
    /// a selected path does not exist. Returns an error if no thread can be started. Nothing is
    /// written to `out` before the run.
    pub fn new(
        out: W,
        circuit: &impl Described,
        clock: Clock,
        options: &Options,
    ) -> io::Result<Self> {
        let layout = Layout::of(circuit, options.only.as_deref())?;
        let file = Behind::new(VcdFile::new(out, &layout, clock))?;
        Ok(VcdBehind {
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

observes!([W: Write + Send + 'static] VcdBehind<W>);
