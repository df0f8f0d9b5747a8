//! Waves of the model around the first difference.

use super::recent::{Past, Recent, SPAN};
use crate::sim::{Model, ModelError};
use std::path::PathBuf;

/// Waves from [`SPAN`] ticks before a difference to [`SPAN`] ticks after it.
#[derive(Debug)]
pub(super) struct Waves {
    path: PathBuf,
    first: u64,
    /// Tick after the last.
    end: u64,
}

impl Waves {
    pub fn new(path: PathBuf) -> Self {
        let (first, end) = (0, 0);
        Waves { path, first, end }
    }

    /// Goes back to a state before this tick and returns to this tick with waves; `drive` sets the
    /// input ports to the words of a tick. The input ports of this tick are to be set anew then.
    ///
    /// # Errors
    /// Returns an error if the waves cannot be begun; the model is in this tick then too.
    pub fn begin(
        &mut self,
        model: &mut Model,
        recent: &Recent,
        drive: impl Fn(&mut Model, &[u64]),
    ) -> Result<(), ModelError> {
        let now = model.snapshot();
        self.first = now.tick();
        self.end = now.tick().saturating_add(SPAN);
        let replayed = self.replay(model, recent, drive);
        if replayed.is_err() {
            model.restore(&now)?;
        }
        replayed
    }

    fn replay(
        &mut self,
        model: &mut Model,
        recent: &Recent,
        drive: impl Fn(&mut Model, &[u64]),
    ) -> Result<(), ModelError> {
        let mut begun = false;
        if let Some(state) = recent.state() {
            let first = self.first.saturating_sub(SPAN);
            model.restore(state)?;
            for Past { tick, rst, words } in recent.ticks() {
                if tick >= first && !begun {
                    model.waves_to(&self.path)?;
                    (begun, self.first) = (true, tick);
                }
                drive(model, words);
                match rst {
                    true => model.reset(),
                    false => model.step(),
                }
            }
        }
        match begun {
            true => Ok(()),
            false => model.waves_to(&self.path),
        }
    }

    /// True if all ticks of the waves have passed.
    pub fn is_over(&self, model: &Model) -> bool {
        model.tick() >= self.end
    }

    /// Writes the files; returns what there is to say.
    pub fn end(&self, model: &mut Model) -> String {
        let last = model.tick().saturating_sub(1);
        match model.finish_waves() {
            Ok(_) => format!(
                "waves of the model, ticks {} to {last}: {}\n",
                self.first,
                self.path.display()
            ),
            Err(error) => self.failed(&error),
        }
    }

    pub fn failed(&self, error: &ModelError) -> String {
        let (path, error) = (self.path.display().to_string(), error.to_string());
        match error.contains(&path) {
            true => format!("{error}\n"),
            false => format!("{path}: {error}\n"),
        }
    }
}
