//! The walk over all signals that finds out which have changed.

use super::Clock;
use super::layout::Layout;
use crate::kernel::{Changed, Circuit, Field, Probe, Running, Sample, Shape, Words};
use std::io;

/// What stands for the tick before the first: all but words of 64 bits differ from it.
const UNKNOWN: u64 = u64::MAX;

/// A new value.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Change {
    /// The leaf, by its place in the walk.
    pub leaf: u32,
    /// Its bits from now on.
    pub bits: u64,
}

/// Finds out which of the selected signals are not as in the tick before.
///
/// Of a memory only what was written since the tick before is looked at.
#[derive(Debug)]
pub(super) struct Walk {
    clock: Clock,
    last: Option<u64>,
    /// The values of the tick before, in the order of the walk.
    before: Vec<u64>,
    /// How often every memory had changed in the tick before, at the place of its first word.
    marks: Vec<u64>,
    /// Which leaves are wanted, unless all are.
    selected: Option<Vec<bool>>,
    /// What has changed in the tick.
    changes: Vec<Change>,
    /// The leaf that comes next.
    cursor: usize,
}

impl Walk {
    pub fn new(layout: &Layout, clock: Clock) -> Self {
        let leaves = layout.leaves.len();
        Walk {
            clock,
            last: None,
            before: vec![UNKNOWN; leaves],
            marks: vec![UNKNOWN; leaves],
            selected: layout
                .selected
                .contains(&false)
                .then(|| layout.selected.clone()),
            changes: Vec::new(),
            cursor: 0,
        }
    }

    /// Looks at a tick. Returns when `clk` rises and when it falls.
    pub fn sample<C: Circuit>(&mut self, now: &Sample<'_, C>) -> io::Result<(u64, u64)> {
        let times = self.begin(now.tick)?;
        now.visit(self);
        self.seen(now.tick);
        Ok(times)
    }

    /// The same of a circuit whose type is forgotten.
    pub fn tick(&mut self, tick: u64, running: &dyn Running) -> io::Result<(u64, u64)> {
        let times = self.begin(tick)?;
        running.show(self);
        self.seen(tick);
        Ok(times)
    }

    fn begin(&mut self, tick: u64) -> io::Result<(u64, u64)> {
        if self.last.is_some_and(|last| last >= tick) {
            return Err(io::Error::new(
                io::ErrorKind::InvalidInput,
                format!("tick {tick} comes twice"),
            ));
        }
        self.changes.clear();
        self.cursor = 0;
        let times = (self.clock.rise(tick), self.clock.fall(tick));
        times.0.zip(times.1).ok_or_else(too_late)
    }

    /// A tick was looked at. At the first one the words that do not differ from [`UNKNOWN`] are new
    /// too.
    fn seen(&mut self, tick: u64) {
        if self.last.replace(tick).is_none() {
            let unknown = self.before.iter().zip(0..);
            let unknown = unknown.filter(|(bits, _)| **bits == UNKNOWN);
            let new = unknown.map(|(&bits, leaf)| Change { leaf, bits });
            self.changes.extend(new);
        }
        if let Some(selected) = &self.selected {
            self.changes.retain(|change| selected[change.leaf as usize]);
        }
    }

    /// What has changed in the tick.
    pub fn changes(&self) -> &[Change] {
        &self.changes
    }

    /// When the last tick is over, if there was one.
    pub fn end(&self) -> io::Result<Option<u64>> {
        let end = |last: u64| self.clock.rise(last + 1).ok_or_else(too_late);
        self.last.map(end).transpose()
    }
}

impl Walk {
    fn look(&mut self, leaf: usize, bits: u64) {
        if bits != self.before[leaf] {
            self.before[leaf] = bits;
            let leaf = leaf as u32;
            self.changes.push(Change { leaf, bits });
        }
    }
}

impl Probe for Walk {
    fn leaf(&mut self, _: &'static Field, _: Shape, bits: u64) {
        self.look(self.cursor, bits);
        self.cursor += 1;
    }

    fn memory(&mut self, _: &'static Field, words: &dyn Words) {
        let start = self.cursor;
        self.cursor += words.len();
        let Some(mark) = self.marks[start..self.cursor].first_mut() else {
            return;
        };
        let first = *mark == UNKNOWN;
        let changed = words.changed(mark);
        let indices = match if first { Changed::All } else { changed } {
            Changed::None => 0..0,
            Changed::One(index) => index..index + 1,
            Changed::All => 0..words.len(),
        };
        for index in indices {
            self.look(start + index, words.word(index));
        }
    }
}

fn too_late() -> io::Error {
    io::Error::new(
        io::ErrorKind::InvalidInput,
        "the time of this tick does not fit into 64 bits",
    )
}
