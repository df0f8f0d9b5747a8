//! States and copies of a model.

use super::{Model, ModelError};
use crate::engine::Saved;
use std::fmt;

/// State of a [`Model`] in a tick: input ports, registers and memories.
#[derive(Clone)]
pub struct Snapshot {
    saved: Saved,
    tick: u64,
}

impl Snapshot {
    /// Returns the number of the tick.
    pub fn tick(&self) -> u64 {
        self.tick
    }
}

impl fmt::Debug for Snapshot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Snapshot")
            .field("tick", &self.tick)
            .finish_non_exhaustive()
    }
}

/// Creates an independent copy, without the waves: both continue from the same tick.
impl Clone for Model {
    fn clone(&self) -> Self {
        let engine = match &self.narrow {
            Some(narrow) => {
                let mut engine = (**narrow).clone();
                engine.resume(&self.engine.saved());
                engine
            }
            None => self.engine.clone(),
        };
        Model {
            engine,
            tick: self.tick,
            settled: self.settled && self.narrow.is_none(),
            circuit: self.circuit.clone(),
            watched: self.watched.clone(),
            costly: self.costly,
            tap: None,
            narrow: None,
        }
    }
}

impl Model {
    /// Returns the state of this tick.
    ///
    /// ```
    /// use motion_rtl::Model;
    ///
    /// let mut counter = Model::new("enable_counter", &[])?;
    /// counter.set("period", 100)?;
    /// counter.run(60);
    /// let then = counter.snapshot();
    /// counter.run(10);
    /// counter.restore(&then)?;
    /// assert_eq!((counter.tick(), counter.get("count")?), (60, 60));
    /// # Ok::<(), motion_rtl::sim::ModelError>(())
    /// ```
    pub fn snapshot(&self) -> Snapshot {
        Snapshot {
            saved: self.engine.saved(),
            tick: self.tick,
        }
    }

    /// Continues from a snapshot of this model or of another model of an equal circuit.
    ///
    /// # Errors
    /// Returns an error if the snapshot is of another circuit, or waves are being written. Nothing
    /// changes then.
    pub fn restore(&mut self, snapshot: &Snapshot) -> Result<(), ModelError> {
        if self.is_tapped() {
            return Err(ModelError::WavesOn {
                refused: "a snapshot cannot be restored",
            });
        }
        if !self.engine.resume(&snapshot.saved) {
            return Err(self.of_another("snapshot"));
        }
        self.tick = snapshot.tick;
        self.settled = false;
        Ok(())
    }
}
