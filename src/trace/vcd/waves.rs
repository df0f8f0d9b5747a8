use super::header::header;
use super::text::{Id, Signal, Text};
use crate::kernel::{Circuit, Running, Sample};
use crate::trace::Clock;
use crate::trace::layout::Layout;
use crate::trace::walk::Walk;
use std::io::{self, Write};

/// Bytes that are gathered before they are written.
const GATHERED: usize = 256 * 1024;

/// A dump of a circuit whose type is forgotten: all of [`Vcd`](super::Vcd) but the walk.
#[derive(Debug)]
pub(crate) struct Waves {
    walk: Walk,
    signals: Vec<Signal>,
    clk: Id,
    text: Text,
    begun: bool,
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
        let mut head = Vec::new();
        // Writing to memory does not fail.
        let _ = header(&mut head, layout, &signals, clock, clk);
        Waves {
            walk: Walk::new(layout, clock),
            signals,
            clk,
            text: Text::new(head),
            begun: false,
        }
    }

    /// Writes a tick.
    pub(super) fn sample<C: Circuit>(
        &mut self,
        now: &Sample<'_, C>,
        out: &mut dyn Write,
    ) -> io::Result<()> {
        let times = self.walk.sample(now)?;
        self.lines(times, out)
    }

    /// Writes a tick.
    pub(crate) fn tick(
        &mut self,
        tick: u64,
        running: &dyn Running,
        out: &mut dyn Write,
    ) -> io::Result<()> {
        let times = self.walk.tick(tick, running)?;
        self.lines(times, out)
    }

    fn lines(&mut self, (rise, fall): (u64, u64), out: &mut dyn Write) -> io::Result<()> {
        let Waves { text, signals, .. } = self;
        text.time(rise);
        if !self.begun {
            text.raw(b"$dumpvars\n");
        }
        text.scalar(1, &self.clk);
        for change in self.walk.changes().drain(..) {
            text.change(&signals[change.leaf as usize], change.bits);
        }
        if !self.begun {
            text.raw(b"$end\n");
            self.begun = true;
        }
        text.time(fall);
        text.scalar(0, &self.clk);

        if text.bytes().len() >= GATHERED {
            out.write_all(text.bytes())?;
            text.clear();
        }
        Ok(())
    }

    /// Gives the last tick its full length and hands everything to the writer.
    pub(crate) fn finish(mut self, out: &mut dyn Write) -> io::Result<()> {
        if let Some(end) = self.walk.end()? {
            self.text.time(end);
        }
        out.write_all(self.text.bytes())?;
        out.flush()
    }
}
