mod file;
mod header;
mod text;
mod time;

use super::behind::Behind;
use super::dump::{Dump, observes};
use super::layout::Layout;
use super::{Clock, LayoutError, Options};
use crate::hdl::Described;
use std::io::{self, Write};

pub(crate) use file::VcdFile;
pub(super) use text::eight_digits;

/// Writes every signal of a run, and `clk`, as a value change dump (IEEE 1364).
///
/// At tick n everything is sampled at time n·P with `clk` high; `clk` falls at n·P + P/2. A
/// register therefore shows at n + 1 what was decided at n. Registers are `reg`, everything else
/// `wire`; a signal with named states has beside it a string `<signal>_name`. The words of a
/// memory stand in a scope of the memory's name. A comment names the ports out. The dump holds no
/// date: the same run gives the same bytes.
///
/// It gathers its own large blocks, so the writer needs no buffer. Call
/// [`finish`](Vcd::finish) after the run; without it the end of the dump is missing. With a second
/// core to be had, [`VcdBehind`] takes less time.
#[derive(Debug)]
#[must_use]
pub struct Vcd<W> {
    dump: Dump<VcdFile<W>>,
}

impl<W: Write> Vcd<W> {
    /// Prepares a dump of `circuit` to `out`.
    ///
    /// # Errors
    /// A name that is used twice in a scope or cannot be written, a selected path that does not
    /// exist. Nothing is written to `out` before the run.
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

    /// Gives the last tick its full length and hands everything to the writer, which it returns.
    ///
    /// # Errors
    /// The writer failed.
    pub fn finish(self) -> io::Result<W> {
        self.dump.finish()
    }
}

observes!([W: Write] Vcd<W>);

/// [`Vcd`] on two threads: the run finds out what changes, a thread of its own makes text of that
/// and writes it. The bytes are the same.
///
/// What changes is gathered in three sections of about 0.3 MB, more where a tick changes more than
/// 16,384 signals; the run waits where the thread is slower. Call [`finish`](VcdBehind::finish)
/// after the run; without it the end of the dump is missing.
#[derive(Debug)]
#[must_use]
pub struct VcdBehind<W> {
    dump: Dump<Behind<VcdFile<W>>>,
}

impl<W: Write + Send + 'static> VcdBehind<W> {
    /// Prepares a dump of `circuit` to `out` and starts the thread.
    ///
    /// # Errors
    /// A name that is used twice in a scope or cannot be written or a selected path that does not
    /// exist, as a [`LayoutError`] within; there is no thread to be had. Nothing is written to
    /// `out` before the run.
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
    /// The writer failed.
    pub fn finish(self) -> io::Result<W> {
        self.dump.finish()
    }
}

observes!([W: Write + Send + 'static] VcdBehind<W>);
