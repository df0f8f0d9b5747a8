mod dump;

use super::layout::{CLK, Layout, Scope, companion};
use super::{Clock, LayoutError, Options};
use crate::kernel::{Circuit, Observer, Role, RunError, Sample};
use dump::{Dump, Id, Signal};
use std::io::{self, Write};
use std::marker::PhantomData;
use std::ops::{ControlFlow, Range};
use vcd::{ReferenceIndex, VarType};

/// Bytes that are gathered before they are written.
const BUFFER: usize = 256 * 1024;

/// Writes every signal of a run, and `clk`, as a value change dump (IEEE 1364).
///
/// At tick n everything is sampled at time n·P with `clk` high; `clk` falls at n·P + P/2. A
/// register therefore shows at n + 1 what was decided at n. Registers are `reg`, everything else
/// `wire`; a signal with named states has beside it a string `<signal>_name`. The words of a
/// memory stand in a scope of the memory's name. The dump holds no date: the same run gives the
/// same bytes.
///
/// It gathers its own large blocks, so the writer needs no buffer. Call
/// [`finish`](Vcd::finish) after the run; without it the end of the dump is missing.
#[derive(Debug)]
#[must_use]
pub struct Vcd<C, W> {
    out: W,
    ticks: Range<u64>,
    clock: Clock,
    last: Option<u64>,
    dump: Dump,
    circuit: PhantomData<fn(&C)>,
}

impl<C: Circuit, W: Write> Vcd<C, W> {
    /// Prepares a dump of `circuit` to `out`.
    ///
    /// # Errors
    /// A name that is used twice in a scope or cannot be written, a selected path that does not
    /// exist. Nothing is written to `out` before the run.
    pub fn new(out: W, circuit: &C, clock: Clock, options: &Options) -> Result<Self, LayoutError> {
        let layout = Layout::of(circuit, options.only.as_deref())?;
        let clk = Id::new(0);
        let mut signals = Vec::with_capacity(layout.leaves.len());
        let mut next = 1;
        for (leaf, &selected) in layout.leaves.iter().zip(&layout.selected) {
            signals.push(Signal::new(leaf, selected, &mut next));
        }
        let mut buffer = Vec::with_capacity(BUFFER + BUFFER / 8);
        // Writing to memory does not fail.
        let _ = header(&mut buffer, &layout, &signals, clock, clk);
        Ok(Vcd {
            out,
            ticks: options.ticks.clone(),
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
            circuit: PhantomData,
        })
    }

    /// Gives the last tick its full length and hands everything to the writer, which it returns.
    ///
    /// # Errors
    /// The writer failed.
    pub fn finish(mut self) -> io::Result<W> {
        if let Some(last) = self.last {
            let end = self.clock.rise(last + 1).ok_or_else(too_late)?;
            self.dump.time(end);
        }
        self.out.write_all(&self.dump.buffer)?;
        self.out.flush()?;
        Ok(self.out)
    }

    fn tick(&mut self, now: &Sample<'_, C>) -> io::Result<()> {
        let dump = &mut self.dump;
        if self.last.is_some_and(|last| last >= now.tick) {
            return Err(io::Error::new(
                io::ErrorKind::InvalidInput,
                format!("tick {} comes twice", now.tick),
            ));
        }
        // What a memory says it changed is what its last edge changed; after a gap all is looked at.
        dump.first = self.last.is_none();
        dump.every_word = self.last.is_none_or(|last| last + 1 != now.tick);
        self.last = Some(now.tick);

        dump.time(self.clock.rise(now.tick).ok_or_else(too_late)?);
        if dump.first {
            dump.buffer.extend_from_slice(b"$dumpvars\n");
        }
        dump.scalar(b'1', dump.clk);
        dump.cursor = 0;
        now.visit(dump);
        if dump.first {
            dump.buffer.extend_from_slice(b"$end\n");
        }
        dump.time(self.clock.fall(now.tick).ok_or_else(too_late)?);
        dump.scalar(b'0', dump.clk);

        if dump.buffer.len() >= BUFFER {
            self.out.write_all(&dump.buffer)?;
            dump.buffer.clear();
        }
        Ok(())
    }
}

impl<C: Circuit, W: Write> Observer<C> for Vcd<C, W> {
    #[inline]
    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        if self.ticks.contains(&now.tick) {
            self.tick(now)?;
        }
        Ok(ControlFlow::Continue(()))
    }
}

fn too_late() -> io::Error {
    io::Error::new(
        io::ErrorKind::InvalidInput,
        "the time of this tick does not fit into 64 bits",
    )
}

fn header(
    out: &mut Vec<u8>,
    layout: &Layout,
    signals: &[Signal],
    clock: Clock,
    clk: Id,
) -> io::Result<()> {
    let mut out = vcd::Writer::new(out);
    out.version(concat!("motion-rtl ", env!("CARGO_PKG_VERSION")))?;
    out.comment(&clock.to_string())?;
    let (factor, unit) = clock.timescale();
    out.timescale(factor, unit)?;
    out.add_module(&layout.top.name)?;
    out.var_def(VarType::Wire, 1, clk.code(), CLK, None)?;
    variables(&mut out, &layout.top, layout, signals)?;
    out.upscope()?;
    out.enddefinitions()
}

fn variables(
    out: &mut vcd::Writer<&mut Vec<u8>>,
    scope: &Scope,
    layout: &Layout,
    signals: &[Signal],
) -> io::Result<()> {
    for &index in &scope.leaves {
        let (leaf, signal) = (&layout.leaves[index], &signals[index]);
        let kind = match leaf.role {
            Role::Register => VarType::Reg,
            Role::Input | Role::Net => VarType::Wire,
        };
        let width = leaf.shape.width;
        let range = (width > 1).then(|| ReferenceIndex::Range(width as i32 - 1, 0));
        out.var_def(kind, width as u32, signal.id.code(), &leaf.name, range)?;
        if let (Some((id, _)), Some(name)) = (signal.states, companion(leaf)) {
            out.var_def(VarType::String, 1, id.code(), &name, None)?;
        }
    }
    for inner in &scope.scopes {
        out.add_module(&inner.name)?;
        variables(out, inner, layout, signals)?;
        out.upscope()?;
    }
    Ok(())
}
