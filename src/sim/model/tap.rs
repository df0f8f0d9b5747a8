//! Receivers of all ticks of a model.

use crate::engine::Engine;
use std::io;
use std::path::PathBuf;

/// Receiver of every tick of a [`Model`](super::Model), settled, before its edge.
pub(crate) trait Tap: Send {
    /// Receives a tick.
    fn tick(&mut self, tick: u64, engine: &Engine);

    /// Ends the ticks; returns the files that were written.
    ///
    /// # Errors
    /// Returns the first error of a tick, or that of the end.
    fn finish(self: Box<Self>) -> io::Result<Vec<PathBuf>>;
}
