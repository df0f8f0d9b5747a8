//! Replay of recorded inputs: a backend takes changes of input ports from a table, and writes
//! changes of shown leaves to another one, so that it runs many ticks at a time.

use super::input::InputChange;
use super::interpreter;
use super::layout::{Layout, Spot};
use super::run::Engine;
use rustc_hash::FxHashMap;
use std::ops::Range;

/// Number of words of the rows that a backend writes before it returns, at least.
const ROWS: usize = 1024;

/// Tick of a replay in which shown signals have changed.
#[derive(Debug, Clone, Copy)]
pub struct ReplayTick<'r> {
    /// Number of the tick.
    pub tick: u64,
    /// Pairs of an index and a word.
    pairs: &'r [u64],
}

impl<'r> ReplayTick<'r> {
    /// Creates a tick from pairs of an index and a word.
    pub(crate) fn new(tick: u64, pairs: &'r [u64]) -> Self {
        ReplayTick { tick, pairs }
    }

    /// Returns the signals that have changed, in no particular order: the index of each in the
    /// list of shown signals, and its bits in this tick.
    #[inline]
    pub fn changes(&self) -> impl Iterator<Item = (usize, u64)> + use<'r> {
        let pairs = self.pairs.chunks_exact(2);
        pairs.map(|pair| (pair[0] as usize, pair[1]))
    }
}

/// Shown leaves of a plan.
#[derive(Debug, Clone)]
pub(super) struct Shown {
    /// By change mark: the place of its first entry in this table. The entries follow: a slot, the
    /// index of a leaf that shows it, and the place of the mark's next entry. Place 0 is none.
    table: Vec<u64>,
    /// Number of change marks, with the unused ones of their last word.
    marks: usize,
    /// Number of words of a slab.
    #[cfg(feature = "jit")]
    words: usize,
}

impl Shown {
    /// Number of words of an entry.
    const ENTRY: usize = 3;

    /// Returns the table of some leaves. Returns `None` if one of them has no change mark of its
    /// own: a word of a memory, or a leaf that is not watched.
    fn of(layout: &Layout, leaves: &[usize]) -> Option<Self> {
        let mut bits: FxHashMap<usize, usize> = FxHashMap::default();
        for (bit, watched) in layout.watched.iter().enumerate() {
            if watched.memory.is_none() {
                let leaves = layout.shown(watched).iter();
                bits.extend(leaves.map(|&leaf| (leaf as usize, bit)));
            }
        }
        let marks = layout.marks();
        let mut shown = Shown {
            table: vec![0; marks],
            marks,
            #[cfg(feature = "jit")]
            words: layout.words as usize,
        };
        for (number, leaf) in leaves.iter().enumerate() {
            match (layout.leaves.get(*leaf), bits.get(leaf)) {
                (None | Some(Spot::Constant(_)), _) => {}
                (Some(&Spot::Slot(slot)), Some(&bit)) if slot < layout.words => {
                    let place = shown.table.len() as u64;
                    let next = std::mem::replace(&mut shown.table[bit], place);
                    shown.table.extend([slot.into(), number as u64, next]);
                }
                _ => return None,
            }
        }
        Some(shown)
    }

    /// Returns the table if it was made for slabs of `words` words with `marks` change marks. Every
    /// mark has a place in it, all places are within it, and all slots are within the slab.
    #[cfg(feature = "jit")]
    pub fn table(&self, words: usize, marks: usize) -> Option<&[u64]> {
        ((words, marks) == (self.words, self.marks)).then_some(&self.table)
    }

    /// Returns the number of words of a row with all leaves.
    fn row(&self) -> usize {
        2 + 2 * (self.table.len() - self.marks) / Shown::ENTRY
    }
}

/// State of a replay: current tick, remaining changes, and rows.
#[derive(Debug)]
pub(crate) struct Replay<'r> {
    /// Remaining changes, in the order of their ticks.
    pub(super) changes: &'r [InputChange],
    pub(super) shown: Shown,
    /// Current tick.
    pub(super) tick: u64,
    /// True if the nets of this tick are settled and its row is written.
    pub(super) settled: bool,
    /// Tick after the last one.
    pub(super) end: u64,
    /// Tick in which a backend returns as soon as the tick is settled.
    pub(super) stop: u64,
    /// Rows: tick, number of words that follow, pairs of an index and a word.
    pub(super) rows: Vec<u64>,
    /// Number of words of the rows that are written.
    pub(super) used: usize,
    /// Number of words of a row with all leaves.
    pub(super) row: usize,
}

impl<'r> Replay<'r> {
    /// Creates a replay of `ticks`, which begin with the current tick of the engine. Returns `None` if
    /// a leaf has no change mark of its own: a word of a memory, or a leaf that is not watched.
    pub fn new(
        engine: &Engine,
        changes: &'r [InputChange],
        ticks: Range<u64>,
        leaves: &[usize],
    ) -> Option<Self> {
        Replay::with_rows(engine, changes, ticks, leaves, ROWS)
    }

    fn with_rows(
        engine: &Engine,
        changes: &'r [InputChange],
        ticks: Range<u64>,
        leaves: &[usize],
        words: usize,
    ) -> Option<Self> {
        let layout = &engine.program.plan.layout;
        let shown = Shown::of(layout, leaves)?;
        let row = shown.row();
        Some(Replay {
            changes,
            shown,
            tick: ticks.start,
            settled: false,
            end: ticks.end,
            stop: ticks.start,
            rows: vec![0; words.max(row)],
            used: 0,
            row,
        })
    }

    /// Returns the current tick.
    pub fn tick(&self) -> u64 {
        self.tick
    }

    /// True if the nets of the current tick are settled.
    pub fn is_settled(&self) -> bool {
        self.settled
    }

    /// True if no tick is left.
    pub fn is_over(&self) -> bool {
        self.tick >= self.end
    }

    /// True if this is the tick in which a backend returns.
    pub(super) fn is_at_stop(&self) -> bool {
        self.is_over() || self.settled && self.tick >= self.stop
    }

    /// True if there is no room for another row.
    pub(super) fn is_full(&self) -> bool {
        self.used + self.row > self.rows.len()
    }

    /// Returns the first tick after this one in which inputs change, or the end.
    pub(super) fn held_until(&self) -> u64 {
        let next = self.changes.first();
        next.map_or(self.end, |change| change.tick.min(self.end))
    }

    /// Returns the number of ticks that follow this one with the same inputs, up to the stop.
    pub(super) fn steady(&self) -> u64 {
        let ticks = self.held_until().saturating_sub(self.tick + 1);
        ticks.min(self.stop.saturating_sub(self.tick))
    }

    /// Passes all rows to `see`, and removes them.
    #[inline]
    fn take_rows(&mut self, mut see: impl FnMut(ReplayTick<'_>)) {
        let mut rows = &self.rows[..self.used];
        while let [tick, words, rest @ ..] = rows {
            let (pairs, others) = rest.split_at(*words as usize);
            see(ReplayTick::new(*tick, pairs));
            rows = others;
        }
        self.used = 0;
    }

    /// Makes the changes of this tick.
    pub(super) fn drive(&mut self, layout: &Layout, slab: &mut [u64]) {
        while let Some((change, rest)) = self.changes.split_first()
            && change.tick <= self.tick
        {
            if let Some(&slot) = layout.inputs.get(change.port) {
                interpreter::put(layout, slab, slot, change.word);
            }
            self.changes = rest;
        }
    }

    /// Writes the row of this settled tick, if a shown leaf has changed, and clears the change
    /// marks.
    pub(super) fn show(&mut self, layout: &Layout, slab: &mut [u64]) {
        if std::mem::take(&mut slab[layout.event as usize]) == 0 {
            return;
        }
        let first = self.used + 2;
        let mut end = first;
        for word in 0..layout.changed_words {
            let mut bits = std::mem::take(&mut slab[(layout.changed + word) as usize]);
            while bits != 0 {
                let bit = word * 64 + bits.trailing_zeros();
                bits &= bits - 1;
                let mut place = self.shown.table[bit as usize] as usize;
                while place != 0 {
                    let entry = &self.shown.table[place..][..Shown::ENTRY];
                    self.rows[end] = entry[1];
                    self.rows[end + 1] = slab[entry[0] as usize];
                    place = entry[2] as usize;
                    end += 2;
                }
            }
        }
        if end > first {
            self.rows[self.used] = self.tick;
            self.rows[self.used + 1] = (end - first) as u64;
            self.used = end;
        }
    }
}

impl Engine {
    /// Continues a replay until `stop` is settled, or to the end. A settled tick is always left.
    /// All rows are passed to `see`.
    pub(crate) fn replay(
        &mut self,
        replay: &mut Replay<'_>,
        stop: u64,
        mut see: impl FnMut(ReplayTick<'_>),
    ) {
        replay.stop = stop.max(replay.tick + u64::from(replay.settled));
        while !replay.is_at_stop() {
            self.run(replay);
            replay.take_rows(&mut see);
        }
    }

    /// Jumps over idle ticks, this settled one included, if a search for them is due.
    pub(crate) fn replay_forward(&mut self, replay: &mut Replay<'_>) {
        let gone = self.forward(replay.held_until() - replay.tick);
        if gone > 0 {
            replay.tick += gone;
            replay.settled = false;
        }
    }
}

#[cfg(test)]
mod tests;
