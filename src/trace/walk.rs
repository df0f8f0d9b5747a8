//! Detection of changed signals.

use super::Clock;
use super::layout::Layout;
use crate::engine::Watched;
use crate::sim::LeafView as View;
use std::io;

/// Value before the first tick: all but words of 64 bits differ from it.
const UNKNOWN: u64 = u64::MAX;

/// New value of a leaf.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Change {
    /// Leaf, by its index in the walk.
    pub leaf: u32,
    /// Bits from now on.
    pub bits: u64,
}

/// Finds the selected signals that differ from the tick before.
///
/// If it saw the tick before, it checks only changes reported by the engine.
#[derive(Debug)]
pub(super) struct Walk {
    clock: Clock,
    last: Option<u64>,
    /// Values of the tick before, in the order of the walk.
    before: Vec<u64>,
    /// Write count of each memory in the tick before.
    marks: Vec<u64>,
    /// Leaves that differ from the tick before.
    touched: Touched,
    /// Selected leaves, unless all are.
    selected: Option<Vec<bool>>,
    /// Changes of the tick.
    changes: Vec<Change>,
}

impl Walk {
    pub fn new(layout: &Layout, clock: Clock) -> Self {
        let leaves = layout.leaves.len();
        Walk {
            clock,
            last: None,
            before: vec![UNKNOWN; leaves],
            marks: Vec::new(),
            touched: Touched::new(leaves),
            selected: layout
                .selected
                .contains(&false)
                .then(|| layout.selected.clone()),
            changes: Vec::new(),
        }
    }

    /// Compares a settled tick. Returns the times at which `clk` rises and falls.
    pub fn tick(&mut self, tick: u64, view: View<'_>) -> io::Result<(u64, u64)> {
        if self.last.is_some_and(|last| last >= tick) {
            return Err(io::Error::new(
                io::ErrorKind::InvalidInput,
                format!("tick {tick} comes twice"),
            ));
        }
        let times = (self.clock.rise(tick), self.clock.fall(tick));
        let times = times.0.zip(times.1).ok_or_else(too_late)?;
        self.changes.clear();
        let follows = self.last.is_some_and(|last| last + 1 == tick);
        match follows && view.engine.program().watches_all() {
            true => self.look_at_changes(view),
            false => self.look_at_all(view),
        }
        self.last = Some(tick);
        if let Some(selected) = &self.selected {
            self.changes.retain(|change| selected[change.leaf as usize]);
        }
        Ok(times)
    }

    fn look_at_all(&mut self, view: View<'_>) {
        let engine = view.engine;
        let memories = engine.program().plan().memories.len();
        self.marks = (0..memories)
            .map(|memory| engine.written(memory).0)
            .collect();
        let first = self.last.is_none();
        for (leaf, before) in self.before.iter_mut().enumerate() {
            let bits = view.leaf(leaf);
            if bits != *before || (first && bits == UNKNOWN) {
                *before = bits;
                let leaf = leaf as u32;
                self.changes.push(Change { leaf, bits });
            }
        }
    }

    fn look_at_changes(&mut self, view: View<'_>) {
        let engine = view.engine;
        let layout = &engine.program().plan().layout;
        let slab = engine.slab();
        engine.changed(|place| {
            let watched = &layout.watched[place];
            if let Some(memory) = watched.memory {
                return self.look_at_memory(memory as usize, watched, view);
            }
            let bits = slab[watched.slot as usize];
            for &leaf in layout.shown(watched) {
                self.look_at(leaf, bits, view);
            }
        });
        // In the order in which all are looked at: the same run gives the same bytes.
        let (before, changes) = (&self.before, &mut self.changes);
        self.touched.take(|leaf| {
            changes.push(Change {
                leaf: leaf as u32,
                bits: before[leaf],
            });
        });
    }

    /// Looks at the words of a memory that was written.
    #[inline(never)]
    fn look_at_memory(&mut self, memory: usize, watched: &Watched, view: View<'_>) {
        let engine = view.engine;
        let plan = engine.program().plan();
        let (mark, word) = engine.written(memory);
        let writes = mark.wrapping_sub(std::mem::replace(&mut self.marks[memory], mark));
        let shifts = plan.memories[memory].head.is_some();
        let mut leaves = plan.layout.shown(watched);
        if let Some(leaf) = leaves.get(word as usize)
            && writes == 1
            && !shifts
        {
            leaves = std::slice::from_ref(leaf);
        }
        for &leaf in leaves {
            self.look_at(leaf, engine.word(leaf as usize), view);
        }
    }

    /// Marks a leaf of the engine as changed if its bits differ from those of the tick before.
    #[inline(always)]
    fn look_at(&mut self, leaf: u32, bits: u64, view: View<'_>) {
        if let Some(leaf) = view.shown(leaf) {
            let before = &mut self.before[leaf as usize];
            if *before != bits {
                *before = bits;
                self.touched.touch(leaf);
            }
        }
    }

    /// Returns the changes of the tick.
    pub fn changes(&self) -> &[Change] {
        &self.changes
    }

    /// Returns the end of the last tick, if there was one.
    pub fn end(&self) -> io::Result<Option<u64>> {
        let end = |last: u64| self.clock.rise(last + 1).ok_or_else(too_late);
        self.last.map(end).transpose()
    }
}

/// Set of leaves. The words of memories are leaves too, so there can be many, of which few are in
/// the set.
#[derive(Debug)]
struct Touched {
    /// One bit per leaf.
    leaves: Vec<u64>,
    /// One bit per word of `leaves` that is not 0.
    words: Vec<u64>,
}

impl Touched {
    /// Creates an empty set for `leaves` leaves.
    fn new(leaves: usize) -> Self {
        let words = leaves.div_ceil(64);
        Touched {
            leaves: vec![0; words],
            words: vec![0; words.div_ceil(64)],
        }
    }

    #[inline]
    fn touch(&mut self, leaf: u32) {
        let word = leaf as usize / 64;
        self.leaves[word] |= 1 << (leaf % 64);
        self.words[word / 64] |= 1 << (word % 64);
    }

    /// Empties the set, in the order of the walk.
    #[inline]
    fn take(&mut self, mut see: impl FnMut(usize)) {
        for (place, words) in self.words.iter_mut().enumerate() {
            for word in ones(std::mem::take(words)) {
                let word = place * 64 + word;
                for leaf in ones(std::mem::take(&mut self.leaves[word])) {
                    see(word * 64 + leaf);
                }
            }
        }
    }
}

/// Returns the positions of the set bits, from the lowest on.
fn ones(mut bits: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let place = bits.trailing_zeros();
        bits &= bits.wrapping_sub(1);
        (place < 64).then_some(place as usize)
    })
}

fn too_late() -> io::Error {
    io::Error::new(
        io::ErrorKind::InvalidInput,
        "the time of this tick does not fit into 64 bits",
    )
}
