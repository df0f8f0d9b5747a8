//! Inputs of a run, recorded once and played again.

use super::{Observer, RunError, Sample, Simulator};
use crate::engine::InputChange;
use crate::hdl::{Circuit, Declarations};
use std::ops::ControlFlow;

/// Changes of all input ports during a run; at power-on they are low.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct RecordedInputs {
    /// Changes in the order of their ticks.
    pub changes: Vec<InputChange>,
    /// Length of the run in ticks.
    pub ticks: u64,
}

impl RecordedInputs {
    /// Plays the inputs from tick 0.
    pub fn playback(&self) -> Playback<'_> {
        Playback {
            changes: &self.changes,
        }
    }
}

/// Observer that records the inputs of a run and ends it after a number of ticks.
#[derive(Debug)]
pub struct InputRecorder {
    recorded: RecordedInputs,
    /// Values of the circuit's own input ports.
    words: Vec<u64>,
    most: u64,
}

impl InputRecorder {
    /// Creates a recorder for a run of at most `most` ticks, at least one.
    pub fn new<C: Circuit>(circuit: &C, most: u64) -> Self {
        InputRecorder {
            recorded: RecordedInputs::default(),
            words: vec![0; Declarations::of(circuit).inputs()],
            most,
        }
    }

    /// Returns what was recorded.
    pub fn finish(self) -> RecordedInputs {
        self.recorded
    }
}

impl<C: Circuit> Observer<C> for InputRecorder {
    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        let tick = self.recorded.ticks;
        for (port, word) in self.words.iter_mut().enumerate() {
            let new = now.engine().port(port).unwrap_or_default();
            if *word != new {
                *word = new;
                let change = InputChange {
                    tick,
                    port,
                    word: new,
                };
                self.recorded.changes.push(change);
            }
        }
        self.recorded.ticks += 1;
        Ok(match self.recorded.ticks < self.most {
            true => ControlFlow::Continue(()),
            false => ControlFlow::Break(()),
        })
    }
}

/// Recorded inputs that are still to be played.
#[derive(Debug, Clone)]
pub struct Playback<'a> {
    changes: &'a [InputChange],
}

impl Playback<'_> {
    /// Sets the inputs that change in the next tick of a simulator. Returns the number of ticks for
    /// which all inputs are held, as [`Simulator::run_changes`] and [`Simulator::fast_forward`]
    /// take it.
    ///
    /// # Errors
    /// Returns an error if a change does not fit its port.
    pub fn held<C: Circuit>(&mut self, to: &mut Simulator<C>) -> Result<u64, RunError> {
        while let Some((change, rest)) = self.changes.split_first() {
            let to_come = change.tick.saturating_sub(to.tick());
            if to_come > 0 {
                return Ok(to_come);
            }
            to.set_port(change.port, change.word)?;
            self.changes = rest;
        }
        Ok(u64::MAX)
    }

    /// Sets the inputs that change in the next tick; returns 1, so that each tick is shown.
    ///
    /// # Errors
    /// Returns an error if a change does not fit its port.
    pub fn tick<C: Circuit>(&mut self, to: &mut Simulator<C>) -> Result<u64, RunError> {
        Ok(self.held(to)?.min(1))
    }
}
