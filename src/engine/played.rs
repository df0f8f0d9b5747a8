//! Recorded inputs of a run, for replay.

use super::input::InputError;
use super::run::Engine;

/// Changes of a run's input ports.
#[derive(Debug, Clone, Default)]
pub struct Inputs {
    /// Ticks, ports and words, in order.
    changes: Vec<(u64, u32, u64)>,
    words: Vec<u64>,
    ticks: u64,
}

impl Inputs {
    /// Records the input ports of a settled tick.
    pub fn note(&mut self, tick: u64, engine: &Engine) {
        self.words.resize(engine.flat().inputs.len(), 0);
        for (port, word) in self.words.iter_mut().enumerate() {
            let now = engine.port(port).unwrap_or(0);
            if *word != now {
                *word = now;
                self.changes.push((tick, port as u32, now));
            }
        }
        self.ticks = tick + 1;
    }

    /// Returns the number of ticks.
    pub fn ticks(&self) -> u64 {
        self.ticks
    }

    /// Replays the inputs on an engine in the power-on state.
    ///
    /// # Errors
    /// Returns an error if the engine has other input ports.
    pub fn play(&self, engine: &mut Engine) -> Result<(), InputError> {
        let mut changes = self.changes.iter().peekable();
        for tick in 0..self.ticks {
            while let Some((_, port, word)) = changes.next_if(|(at, ..)| *at == tick) {
                engine.input(*port as usize, *word)?;
            }
            engine.settle();
            engine.edge();
        }
        Ok(())
    }
}
