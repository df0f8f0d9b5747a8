//! What went into a circuit during a run, to be played once more.

use super::input::InputError;
use super::run::Engine;

/// The changes of the ports in of a run.
#[derive(Debug, Clone, Default)]
pub struct Inputs {
    /// Ticks, ports and words, in order.
    changes: Vec<(u64, u32, u64)>,
    words: Vec<u64>,
    ticks: u64,
}

impl Inputs {
    /// Notes what stands at the ports in of a settled tick.
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

    /// How many ticks it took.
    pub fn ticks(&self) -> u64 {
        self.ticks
    }

    /// Plays them on an engine at power-on.
    ///
    /// # Errors
    /// The engine has other ports in.
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
