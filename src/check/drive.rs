use super::records::Records;
use super::{Coverage, Stimulus};
use crate::engine::{Engine, Watch};
use crate::input::stimulus::PortInputs;
use crate::sim::{Described, Elaborated, LeafView as View, RunError};
use crate::trace::{Clock, Dump, Layout, Lines, Options, OutputFile, VcdFile};
use std::io::{self, Write};

/// Length and inputs of a random run.
#[derive(Debug, Clone, Copy)]
pub struct Drive {
    /// Seed of the [`Stimulus`].
    pub seed: u64,
    /// Number of ticks.
    pub ticks: u64,
    /// True if some ticks have a synchronous reset.
    pub resets: bool,
    /// True if the words of each input port stay within a random number of binary digits in the
    /// whole run, and signed words have both signs. Counters then end early: without bounds, one
    /// long period keeps a circuit waiting for the rest of the run.
    pub bounded: bool,
    /// Clock of the waves.
    pub clock: Clock,
}

/// Result of a [`drive`].
#[derive(Debug)]
pub struct Driven {
    /// Number of ticks with reset.
    pub resets: u64,
    /// Bits that the run has seen at both levels.
    pub coverage: Coverage,
}

/// Drives a circuit from power-on with random inputs. Writes all its signals as waves, its inputs
/// as a [`StimulusFile`](crate::trace::StimulusFile), and its ports out as an
/// [`OutputFile`](crate::trace::OutputFile). With these, another implementation of the circuit can
/// be compared with this one, tick by tick. The same [`Drive`] gives the same bytes.
///
/// Records, targets and steps are written whole and started, alternating with ticks in which every
/// port of a [`Stimulus`] is random. [`Coverage::still`] names the signals that never changed.
///
/// # Errors
/// Returns an error if a writer failed, or a name is duplicate in a scope or cannot be written to
/// waves.
pub fn drive(
    circuit: &impl Described,
    drive: &Drive,
    mut waves: impl Write,
    mut stimulus: impl Write,
    mut expected: impl Write,
) -> Result<Driven, RunError> {
    let model = circuit.described()?;
    drive.run(&model, &mut waves, &mut stimulus, &mut expected)
}

/// Plays inputs on a circuit from power-on, and writes what [`drive`] writes.
///
/// # Errors
/// Returns the errors of [`drive`].
pub fn play(
    circuit: &impl Described,
    inputs: &PortInputs,
    clock: Clock,
    mut waves: impl Write,
    mut stimulus: impl Write,
    mut expected: impl Write,
) -> Result<Driven, RunError> {
    let mut outputs = Outputs {
        clock,
        waves: &mut waves,
        stimulus: &mut stimulus,
        expected: &mut expected,
    };
    let ticks = inputs.ticks() as u64;
    outputs.of(&circuit.described()?, ticks, |tick, engine| {
        let (words, rst) = inputs.tick(tick as usize).unwrap_or_default();
        engine.drive_all(words);
        rst
    })
}

impl Drive {
    /// Drives an elaborated circuit as [`drive`] does.
    ///
    /// # Errors
    /// Returns the errors of [`drive`].
    pub fn run(
        &self,
        model: &Elaborated,
        waves: &mut dyn Write,
        stimulus: &mut dyn Write,
        expected: &mut dyn Write,
    ) -> Result<Driven, RunError> {
        let leaves = &model.declarations().leaves;
        let ports = leaves.iter().take(model.flat().inputs.len());
        let mut random = match self.bounded {
            true => Stimulus::bounded(self.seed, ports.map(|leaf| leaf.shape)),
            false => Stimulus::new(self.seed),
        };
        let mut records = Records::of(model.declarations(), model.flat().inputs.len(), self.seed);
        let mut outputs = Outputs {
            clock: self.clock,
            waves,
            stimulus,
            expected,
        };
        outputs.of(model, self.ticks, |_, engine| {
            let rst = self.resets && random.reset();
            random.apply(engine);
            if let Some(records) = &mut records {
                records.apply(engine);
                if rst {
                    records.restart();
                }
            }
            rst
        })
    }
}

/// Files of a run.
struct Outputs<'w> {
    clock: Clock,
    waves: &'w mut dyn Write,
    stimulus: &'w mut dyn Write,
    expected: &'w mut dyn Write,
}

impl Outputs<'_> {
    /// Runs a circuit from power-on; `apply` sets the input ports of a tick and returns true if
    /// the tick ends with a reset.
    fn of(
        &mut self,
        model: &Elaborated,
        ticks: u64,
        mut apply: impl FnMut(u64, &mut Engine) -> bool,
    ) -> Result<Driven, RunError> {
        let leaves = model.declarations().leaves.clone();
        let layout = Layout::new(model.name(), leaves, None).map_err(io::Error::from)?;
        let file = VcdFile::new(&mut self.waves, &layout, self.clock);
        let mut dump = Dump::new(&layout, self.clock, &Options::default(), file);
        let widths = model.flat().inputs.iter().map(|&width| width.into());
        let mut lines = Lines::new(widths.collect());
        let mut outputs = OutputFile::of(&mut self.expected, model);
        let mut coverage = Coverage::of(model.declarations());
        let mut engine = model.engine(Watch::All);
        let mut resets = 0;
        for tick in 0..ticks {
            let rst = apply(tick, &mut engine);
            resets += u64::from(rst);
            engine.settle();
            lines.tick(&engine, rst, &mut self.stimulus)?;
            outputs.tick(View::of(&engine))?;
            dump.tick(tick, View::of(&engine))?;
            coverage.tick(tick, View::of(&engine));
            match rst {
                true => engine.reset(),
                false => engine.edge(),
            }
        }
        dump.finish()?;
        lines.finish(&mut self.stimulus)?;
        outputs.finish()?;
        Ok(Driven { resets, coverage })
    }
}
