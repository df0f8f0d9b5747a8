use super::Lines;
use crate::engine::EngineError;
use crate::hdl::Circuit;
use crate::sim::{Described, Elaborated, LeafView as View, Observer, RunError, Sample};
use std::io::{self, Write};
use std::ops::ControlFlow;

/// Writes the ports out of a circuit as text, a line a tick, for a Verilog testbench that holds its
/// own against them.
///
/// A line is one hexadecimal word: the ports out side by side, the first in the lowest bits. As an
/// observer it writes every tick of a run. Call [`finish`](OutputFile::finish) after the run; without
/// it the end is missing.
#[derive(Debug)]
#[must_use]
pub struct OutputFile<W> {
    out: W,
    /// Leaf of each port.
    leaves: Vec<usize>,
    lines: Lines,
}

impl<W: Write> OutputFile<W> {
    /// Begins the file of a circuit.
    ///
    /// # Errors
    /// All that is wrong with the circuit.
    pub fn new(out: W, circuit: &impl Described) -> Result<Self, EngineError> {
        Ok(Self::of(out, &circuit.described()?))
    }

    /// Begins the file of an elaborated circuit.
    pub(crate) fn of(out: W, model: &Elaborated) -> Self {
        let leaves = model.ports_out();
        let all = &model.declarations().leaves;
        let widths = leaves.iter().map(|&leaf| all[leaf].shape.width);
        let lines = Lines::without_reset(widths.collect());
        OutputFile { out, leaves, lines }
    }

    /// Writes a tick.
    pub(crate) fn tick(&mut self, view: View<'_>) -> io::Result<()> {
        let words = self.leaves.iter().map(|&leaf| view.leaf(leaf));
        self.lines.line(words, &mut self.out)
    }

    /// Hands everything to the writer and returns it.
    ///
    /// # Errors
    /// The writer failed.
    pub fn finish(mut self) -> io::Result<W> {
        self.lines.finish(&mut self.out)?;
        Ok(self.out)
    }
}

impl<C: Circuit, W: Write> Observer<C> for OutputFile<W> {
    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        let tick = self.tick(now.view());
        tick.map_err(RunError::of_file("list of outputs"))?;
        Ok(ControlFlow::Continue(()))
    }
}
