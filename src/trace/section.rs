//! A run in pieces.

use super::walk::Change;

/// A piece of a run.
#[derive(Debug, Default)]
pub(super) struct Section {
    pub ticks: Vec<Tick>,
    pub changes: Vec<Change>,
    /// When the run is over, in the last one.
    pub end: Option<u64>,
}

/// A tick in it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tick {
    /// When `clk` rises and everything changes.
    pub rise: u64,
    /// When `clk` falls.
    pub fall: u64,
    /// How many changes there have been after it.
    pub changes: usize,
}

impl Section {
    /// The ticks, each with its changes.
    pub fn ticks(&self) -> impl Iterator<Item = (&Tick, &[Change])> {
        let mut from = 0;
        self.ticks.iter().map(move |tick| {
            let changes = &self.changes[from..tick.changes];
            from = tick.changes;
            (tick, changes)
        })
    }

    pub fn clear(&mut self) {
        self.ticks.clear();
        self.changes.clear();
        self.end = None;
    }
}
