//! Ticks just before this one: the words of their ports, and states to go back to.

use crate::sim::Snapshot;

/// Ticks between two states that are kept; waves begin so many ticks before a difference.
pub(super) const SPAN: u64 = 100;

/// Last ticks, [`SPAN`] of them at least if there were so many.
#[derive(Debug)]
pub(super) struct Recent {
    older: Block,
    newer: Block,
    /// Words of a tick.
    words: usize,
}

/// Ticks in a row.
#[derive(Debug, Default)]
struct Block {
    /// State before the first tick.
    state: Option<Snapshot>,
    first: u64,
    /// The reset of each tick and its words.
    records: Vec<u64>,
}

/// Tick that has passed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Past<'r> {
    pub tick: u64,
    pub rst: bool,
    pub words: &'r [u64],
}

impl Recent {
    pub fn new(words: usize) -> Self {
        Recent {
            older: Block::default(),
            newer: Block::default(),
            words,
        }
    }

    /// True if a state is to be kept before this tick is recorded.
    #[inline]
    pub fn wants_state(&self, tick: u64) -> bool {
        self.newer.records.is_empty() || tick - self.newer.first >= SPAN
    }

    /// Keeps the state of this tick, if there is one.
    pub fn keep(&mut self, tick: u64, state: Option<Snapshot>) {
        std::mem::swap(&mut self.older, &mut self.newer);
        self.newer.state = state;
        self.newer.first = tick;
        self.newer.records.clear();
    }

    /// Records a tick, which follows the last one.
    #[inline]
    pub fn push(&mut self, rst: bool, words: &[u64]) {
        self.newer.records.push(rst.into());
        self.newer.records.extend_from_slice(words);
    }

    /// Returns the earliest state.
    pub fn state(&self) -> Option<&Snapshot> {
        let older = self.older.state.as_ref();
        older.or(self.newer.state.as_ref())
    }

    /// Returns the ticks from the earliest state on, or all without states.
    pub fn ticks(&self) -> impl Iterator<Item = Past<'_>> {
        [&self.older, &self.newer].into_iter().flat_map(|block| {
            let records = block.records.chunks_exact(self.words + 1);
            (block.first..).zip(records).map(|(tick, record)| Past {
                tick,
                rst: record[0] != 0,
                words: &record[1..],
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_ticks_are_kept_in_order() {
        let mut recent = Recent::new(2);
        for tick in 7..457 {
            if recent.wants_state(tick) {
                recent.keep(tick, None);
            }
            recent.push(tick % 3 == 0, &[tick, 2 * tick]);
        }
        let first = recent.ticks().next().unwrap().tick;
        assert_eq!((first, recent.ticks().count()), (307, 150));
        for (past, tick) in recent.ticks().zip(307..) {
            assert_eq!((past.tick, past.rst), (tick, tick % 3 == 0));
            assert_eq!(past.words, [tick, 2 * tick]);
        }
    }
}
