//! The walk over all signals that finds out which have changed.

use super::Clock;
use super::layout::Layout;
use crate::kernel::{Changed, Circuit, Field, Probe, Running, Sample, Shape, Words};
use std::io;

/// A new value.
#[derive(Debug, Clone, Copy)]
pub(super) struct Change {
    /// The leaf, by its place in the walk.
    pub leaf: u32,
    /// Its bits from now on.
    pub bits: u64,
}

/// Finds out which of the selected signals are not as in the tick before.
#[derive(Debug)]
pub(super) struct Walk {
    clock: Clock,
    /// The values of the tick before, in the order of the walk.
    previous: Vec<u64>,
    /// Where every memory stood in the tick before.
    marks: Vec<u64>,
    last: Option<u64>,
    notes: Notes,
    /// At the first tick everything is noted, changed or not.
    first: bool,
}

#[derive(Debug)]
struct Notes {
    selected: Vec<bool>,
    changes: Vec<Change>,
}

impl Walk {
    pub fn new(layout: &Layout, clock: Clock) -> Self {
        Walk {
            clock,
            previous: vec![0; layout.leaves.len()],
            marks: Vec::new(),
            last: None,
            notes: Notes {
                selected: layout.selected.clone(),
                changes: Vec::new(),
            },
            first: true,
        }
    }

    /// Looks at a tick. Returns when `clk` rises and when it falls.
    pub fn sample<C: Circuit>(&mut self, now: &Sample<'_, C>) -> io::Result<(u64, u64)> {
        let times = self.begin(now.tick)?;
        look(now, self.probe());
        Ok(times)
    }

    /// The same of a circuit whose type is forgotten.
    pub fn tick(&mut self, tick: u64, running: &dyn Running) -> io::Result<(u64, u64)> {
        let times = self.begin(tick)?;
        running.show(&mut self.probe());
        Ok(times)
    }

    fn begin(&mut self, tick: u64) -> io::Result<(u64, u64)> {
        if self.last.is_some_and(|last| last >= tick) {
            return Err(io::Error::new(
                io::ErrorKind::InvalidInput,
                format!("tick {tick} comes twice"),
            ));
        }
        self.first = self.last.is_none();
        self.last = Some(tick);
        let times = (self.clock.rise(tick), self.clock.fall(tick));
        times.0.zip(times.1).ok_or_else(too_late)
    }

    fn probe(&mut self) -> Look<'_> {
        Look {
            previous: &mut self.previous,
            cursor: 0,
            marks: &mut self.marks,
            memory: 0,
            first: self.first,
            notes: &mut self.notes,
        }
    }

    /// What has changed since it was last taken away.
    pub fn changes(&mut self) -> &mut Vec<Change> {
        &mut self.notes.changes
    }

    /// When the last tick is over, if there was one.
    pub fn end(&self) -> io::Result<Option<u64>> {
        let end = |last: u64| self.clock.rise(last + 1).ok_or_else(too_late);
        self.last.map(end).transpose()
    }
}

/// Compiled once for all formats.
#[inline(never)]
fn look<C: Circuit>(now: &Sample<'_, C>, mut probe: Look<'_>) {
    now.visit(&mut probe);
}

/// A walk under way.
struct Look<'a> {
    previous: &'a mut [u64],
    /// The leaf that comes next.
    cursor: usize,
    marks: &'a mut Vec<u64>,
    /// The memory that comes next.
    memory: usize,
    first: bool,
    notes: &'a mut Notes,
}

impl Look<'_> {
    #[inline]
    fn look(&mut self, leaf: usize, bits: u64) {
        if self.previous[leaf] != bits || self.first {
            self.previous[leaf] = bits;
            self.notes.note(leaf, bits);
        }
    }

    fn look_at_all(&mut self, start: usize, words: &dyn Words) {
        for index in 0..words.len() {
            self.look(start + index, words.word(index));
        }
    }
}

impl Notes {
    #[inline(never)]
    fn note(&mut self, leaf: usize, bits: u64) {
        if self.selected[leaf] {
            let leaf = leaf as u32;
            self.changes.push(Change { leaf, bits });
        }
    }
}

impl Probe for Look<'_> {
    #[inline]
    fn leaf(&mut self, _: &'static Field, _: Shape, bits: u64) {
        let leaf = self.cursor;
        self.cursor += 1;
        self.look(leaf, bits);
    }

    fn memory(&mut self, _: &'static Field, words: &dyn Words) {
        let start = self.cursor;
        self.cursor += words.len();
        if self.first {
            self.marks.push(0);
        }
        let changed = words.changed(&mut self.marks[self.memory]);
        self.memory += 1;
        match changed {
            _ if self.first => self.look_at_all(start, words),
            Changed::None => {}
            Changed::One(index) => self.look(start + index, words.word(index)),
            Changed::All => self.look_at_all(start, words),
        }
    }
}

fn too_late() -> io::Error {
    io::Error::new(
        io::ErrorKind::InvalidInput,
        "the time of this tick does not fit into 64 bits",
    )
}
