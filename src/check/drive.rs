use super::{Coverage, Stimulus};
use crate::kernel::{Circuit, Observer, RunError, Simulator};
use crate::trace::{Clock, Options, StimulusFile, Vcd};
use std::io::{self, Write};

/// How long a circuit is driven, and by what.
#[derive(Debug, Clone, Copy)]
pub struct Drive {
    /// The seed of the [`Stimulus`].
    pub seed: u64,
    /// The number of ticks.
    pub ticks: u64,
    /// Now and then a tick has a synchronous reset.
    pub resets: bool,
    /// The clock of the waves.
    pub clock: Clock,
}

/// What came of a [`drive`].
#[derive(Debug)]
pub struct Driven {
    /// The ticks with reset.
    pub resets: u64,
    /// Which bits the run has seen at both levels.
    pub coverage: Coverage,
}

/// Drives a circuit from power-on with random inputs, and writes all of its signals as waves and
/// what went into it as a [`StimulusFile`]: with both, another form of the circuit can be held
/// against this one, tick by tick. The same [`Drive`] gives the same bytes.
///
/// # Errors
/// A writer failed; a name that is used twice in a scope or that waves cannot carry.
pub fn drive<C: Circuit>(
    circuit: &C,
    drive: &Drive,
    waves: impl Write,
    stimulus: impl Write,
) -> Result<Driven, RunError> {
    let vcd = Vcd::new(waves, circuit, drive.clock, &Options::default());
    let mut vcd = vcd.map_err(io::Error::from)?;
    let mut file = StimulusFile::<C, _>::new(stimulus);
    let mut coverage = Coverage::new(circuit);
    let mut random = Stimulus::new(drive.seed);
    let mut resets = 0;
    let mut simulator = Simulator::new(circuit);
    for _ in 0..drive.ticks {
        let rst = drive.resets && random.reset();
        resets += u64::from(rst);
        let (next, seen) =
            simulator.step_with_reset(rst, random.inputs(), |now| -> Result<(), RunError> {
                file.line(now.i, rst)?;
                // Neither of them ends a run.
                (&mut vcd, &mut coverage).sample(now).map(drop)
            });
        seen?;
        simulator = next;
    }
    vcd.finish()?;
    file.finish()?;
    Ok(Driven { resets, coverage })
}
