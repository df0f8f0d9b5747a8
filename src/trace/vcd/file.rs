use super::header::header;
use super::text::{Signals, Text};
use crate::netlist::Format as Shown;
use crate::trace::Clock;
use crate::trace::behind::Sink;
use crate::trace::dump::Format;
use crate::trace::layout::Layout;
use crate::trace::section::Section;
use crate::trace::walk::Change;
use std::io::{self, Write};
use vcd::IdCode;

/// Bytes that are collected before they are written.
const GATHERED: usize = 256 * 1024;

/// Code of `clk`: variable 0.
pub const CLK_CODE: IdCode = IdCode::FIRST;
/// Line end after a time, and the line of `clk` high.
const CLK_HIGH: &[u8; 4] = b"\n1!\n";
const CLK_LOW: &[u8; 4] = b"\n0!\n";
/// Lines of the first rising edge.
const CLK_FIRST: &[u8; 14] = b"\n$dumpvars\n1!\n";

/// Value change dump being written.
#[derive(Debug)]
pub(crate) struct VcdFile<W> {
    out: W,
    signals: Signals,
    text: Text,
    begun: bool,
}

impl<W: Write> VcdFile<W> {
    /// Prepares a dump; nothing is written before the run.
    pub fn new(out: W, layout: &Layout, clock: Clock) -> Self {
        let mut signals = Signals::new();
        let mut variables = Vec::with_capacity(layout.leaves.len());
        let mut next = 1;
        for (leaf, &selected) in layout.leaves.iter().zip(&layout.selected) {
            let names = match leaf.field.format {
                Shown::States(names) => Some(names),
                _ => None,
            };
            signals.push(next, leaf.shape.width, names);
            variables.push(next);
            if selected {
                next += 1 + u32::from(names.is_some());
            }
        }
        let mut head = Vec::new();
        // Writing to memory cannot fail.
        let _ = header(&mut head, layout, &variables, clock);
        VcdFile {
            out,
            signals,
            text: Text::new(head),
            begun: false,
        }
    }

    fn lines(&mut self, rise: u64, fall: u64, changes: &[Change]) -> io::Result<()> {
        let VcdFile { text, signals, .. } = self;
        if self.begun {
            text.time(rise, CLK_HIGH);
            text.changes(signals, changes);
        } else {
            text.time(rise, CLK_FIRST);
            text.changes(signals, changes);
            text.raw(b"$end\n");
            self.begun = true;
        }
        text.time(fall, CLK_LOW);

        if text.bytes().len() >= GATHERED {
            self.out.write_all(text.bytes())?;
            text.clear();
        }
        Ok(())
    }

    fn close(mut self) -> io::Result<W> {
        self.out.write_all(self.text.bytes())?;
        self.out.flush()?;
        Ok(self.out)
    }
}

/// Writes tick by tick.
impl<W: Write> Format for VcdFile<W> {
    type Out = W;

    #[inline(never)]
    fn tick(&mut self, rise: u64, fall: u64, changes: &[Change]) -> io::Result<()> {
        self.lines(rise, fall, changes)
    }

    fn finish(mut self, end: Option<u64>) -> io::Result<W> {
        if let Some(end) = end {
            self.text.time(end, b"\n");
        }
        self.close()
    }
}

/// Writes in a separate thread.
impl<W: Write + Send + 'static> Sink for VcdFile<W> {
    type Out = W;

    fn full(&self) -> (usize, usize) {
        // Small enough to stay in the caches between the threads.
        (16 * 1024, 8 * 1024)
    }

    fn write(&mut self, section: &Section) -> io::Result<()> {
        for (tick, changes) in section.ticks() {
            self.lines(tick.rise, tick.fall, changes)?;
        }
        if let Some(end) = section.end {
            self.text.time(end, b"\n");
        }
        Ok(())
    }

    fn finish(self) -> io::Result<W> {
        self.close()
    }
}
