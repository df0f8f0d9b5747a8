use super::dump::{Dump, Id, Signal};
use super::header::header;
use crate::kernel::Running;
use crate::trace::Clock;
use crate::trace::layout::Layout;
use std::io::{self, Write};

/// Bytes that are gathered before they are written.
const BUFFER: usize = 256 * 1024;

/// A dump of a circuit whose type is forgotten: all of [`Vcd`](super::Vcd) but the walk.
#[derive(Debug)]
pub(crate) struct Waves {
    clock: Clock,
    last: Option<u64>,
    dump: Dump,
}

impl Waves {
    /// Prepares a dump; nothing is written before the run.
    pub(crate) fn new(layout: &Layout, clock: Clock) -> Self {
        let clk = Id::new(0);
        let mut signals = Vec::with_capacity(layout.leaves.len());
        let mut next = 1;
        for (leaf, &selected) in layout.leaves.iter().zip(&layout.selected) {
            signals.push(Signal::new(leaf, selected, &mut next));
        }
        let mut buffer = Vec::with_capacity(BUFFER + BUFFER / 8);
        // Writing to memory does not fail.
        let _ = header(&mut buffer, layout, &signals, clock, clk);
        Waves {
            clock,
            last: None,
            dump: Dump {
                previous: vec![0; signals.len()],
                signals,
                clk,
                cursor: 0,
                first: true,
                every_word: true,
                buffer,
            },
        }
    }

    /// Begins a tick; the probe is to see all of its signals.
    pub(super) fn begin(&mut self, tick: u64) -> io::Result<&mut Dump> {
        let dump = &mut self.dump;
        if self.last.is_some_and(|last| last >= tick) {
            return Err(io::Error::new(
                io::ErrorKind::InvalidInput,
                format!("tick {tick} comes twice"),
            ));
        }
        // What a memory says it changed is what its last edge changed; after a gap all is looked at.
        dump.first = self.last.is_none();
        dump.every_word = self.last.is_none_or(|last| last + 1 != tick);
        self.last = Some(tick);

        dump.time(self.clock.rise(tick).ok_or_else(too_late)?);
        if dump.first {
            dump.buffer.extend_from_slice(b"$dumpvars\n");
        }
        dump.scalar(b'1', dump.clk);
        dump.cursor = 0;
        Ok(dump)
    }

    /// Ends the tick.
    pub(super) fn end(&mut self, tick: u64, out: &mut dyn Write) -> io::Result<()> {
        let dump = &mut self.dump;
        if dump.first {
            dump.buffer.extend_from_slice(b"$end\n");
        }
        dump.time(self.clock.fall(tick).ok_or_else(too_late)?);
        dump.scalar(b'0', dump.clk);

        if dump.buffer.len() >= BUFFER {
            out.write_all(&dump.buffer)?;
            dump.buffer.clear();
        }
        Ok(())
    }

    /// Writes a tick.
    pub(crate) fn tick(
        &mut self,
        tick: u64,
        running: &dyn Running,
        out: &mut dyn Write,
    ) -> io::Result<()> {
        running.show(self.begin(tick)?);
        self.end(tick, out)
    }

    /// Gives the last tick its full length and hands everything to the writer.
    pub(crate) fn finish(mut self, out: &mut dyn Write) -> io::Result<()> {
        if let Some(last) = self.last {
            let end = self.clock.rise(last + 1).ok_or_else(too_late)?;
            self.dump.time(end);
        }
        out.write_all(&self.dump.buffer)?;
        out.flush()
    }
}

fn too_late() -> io::Error {
    io::Error::new(
        io::ErrorKind::InvalidInput,
        "the time of this tick does not fit into 64 bits",
    )
}
