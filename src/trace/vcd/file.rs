use super::header::header;
use super::text::{Id, Signal, Text};
use crate::trace::Clock;
use crate::trace::dump::Format;
use crate::trace::layout::Layout;
use crate::trace::walk::Change;
use std::io::{self, Write};

/// Bytes that are gathered before they are written.
const GATHERED: usize = 256 * 1024;

/// A value change dump as it is written.
#[derive(Debug)]
pub(crate) struct VcdFile<W> {
    out: W,
    signals: Vec<Signal>,
    clk: Id,
    text: Text,
    begun: bool,
}

impl<W: Write> VcdFile<W> {
    /// Prepares a dump; nothing is written before the run.
    pub fn new(out: W, layout: &Layout, clock: Clock) -> Self {
        let clk = Id::new(0);
        let mut signals = Vec::with_capacity(layout.leaves.len());
        let mut next = 1;
        for (leaf, &selected) in layout.leaves.iter().zip(&layout.selected) {
            signals.push(Signal::new(leaf, selected, &mut next));
        }
        let mut head = Vec::new();
        // Writing to memory does not fail.
        let _ = header(&mut head, layout, &signals, clock, clk);
        VcdFile {
            out,
            signals,
            clk,
            text: Text::new(head),
            begun: false,
        }
    }
}

impl<W: Write> Format for VcdFile<W> {
    type Out = W;

    #[inline(never)]
    fn tick(&mut self, rise: u64, fall: u64, changes: &mut Vec<Change>) -> io::Result<()> {
        let VcdFile { text, signals, .. } = self;
        text.time(rise);
        if !self.begun {
            text.raw(b"$dumpvars\n");
        }
        text.scalar(1, &self.clk);
        text.changes(signals, changes);
        changes.clear();
        if !self.begun {
            text.raw(b"$end\n");
            self.begun = true;
        }
        text.time(fall);
        text.scalar(0, &self.clk);

        if text.bytes().len() >= GATHERED {
            self.out.write_all(text.bytes())?;
            text.clear();
        }
        Ok(())
    }

    fn finish(mut self, end: Option<u64>, _: &mut Vec<Change>) -> io::Result<W> {
        if let Some(end) = end {
            self.text.time(end);
        }
        self.out.write_all(self.text.bytes())?;
        self.out.flush()?;
        Ok(self.out)
    }
}
