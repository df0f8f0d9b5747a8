//! Sections of a run.

use super::walk::Change;

/// Section of a run.
#[derive(Debug, Default)]
pub(super) struct Section {
    pub ticks: Vec<Tick>,
    pub changes: Vec<Change>,
    /// End of the run, in the last section.
    pub end: Option<u64>,
}

/// Tick of a section.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tick {
    /// Time at which `clk` rises and everything changes.
    pub rise: u64,
    /// Time at which `clk` falls.
    pub fall: u64,
    /// Number of changes up to and including this tick.
    pub changes: usize,
}

impl Section {
    /// Returns the ticks, each with its changes.
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
