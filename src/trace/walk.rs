//! The walk over all signals that finds out which have changed.

use super::Clock;
use super::layout::Layout;
use super::rest::Rest;
use crate::kernel::{
    Changed, Circuit, Field, Inside, Probe, Role, Running, Sample, Shape, Signals, Words,
};
use crate::logic::Sim;
use std::hint::cold_path;
use std::io;
use std::mem;

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
/// A circuit within whose ports in and registers are as in the tick before rests: its nets are
/// not looked at, and where the walk is compiled with the circuit they are not even computed.
#[derive(Debug)]
pub(super) struct Walk {
    clock: Clock,
    last: Option<u64>,
    /// The values of the tick before, in the order of the walk.
    before: Vec<u64>,
    /// Which circuits within have registers that have changed.
    awake: Vec<bool>,
    /// How often every memory had changed in the tick before, at the place of its first word.
    marks: Vec<u64>,
    notes: Notes,
}

#[derive(Debug)]
struct Notes {
    rest: Rest,
    selected: Vec<bool>,
    changes: Vec<Change>,
}

impl Walk {
    pub fn new(layout: &Layout, clock: Clock) -> Self {
        let leaves = layout.leaves.len();
        Walk {
            clock,
            last: None,
            before: vec![UNKNOWN; leaves],
            awake: vec![true; layout.instances.len()],
            marks: vec![UNKNOWN; leaves],
            notes: Notes {
                rest: Rest::new(&layout.leaves, &layout.instances),
                selected: layout.selected.clone(),
                changes: Vec::new(),
            },
        }
    }

    /// Looks at a tick. Returns when `clk` rises and when it falls.
    #[inline(always)]
    pub fn sample<C: Circuit>(&mut self, now: &Sample<'_, C>) -> io::Result<(u64, u64)> {
        let times = self.begin(now.tick)?;
        let extent = const {
            C::In::<Sim>::EXTENT
                .and(C::Reg::<Sim>::EXTENT)
                .and(C::Net::<Sim>::EXTENT)
        };
        let mut look = self.look(true);
        // After this the compiler knows that every leaf has its place, which stands in the code as
        // a constant.
        if look.before.len() != extent.leaves
            || look.marks.len() != extent.leaves
            || look.awake.len() != extent.instances
        {
            return Err(wrong_extent(C::NAME));
        }
        now.visit(&mut look);
        self.seen(now.tick);
        Ok(times)
    }

    /// The same of a circuit whose type is forgotten; it looks at everything.
    pub fn tick(&mut self, tick: u64, running: &dyn Running) -> io::Result<(u64, u64)> {
        let times = self.begin(tick)?;
        let mut look = self.look(false);
        running.show(&mut look);
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
        self.notes.rest.begin(&mut self.awake);
        let times = (self.clock.rise(tick), self.clock.fall(tick));
        times.0.zip(times.1).ok_or_else(too_late)
    }

    #[inline(always)]
    fn look(&mut self, passes_over: bool) -> Look<'_> {
        Look {
            before: &mut self.before,
            awake: &mut self.awake,
            marks: &mut self.marks,
            notes: &mut self.notes,
            passes_over,
            cursor: 0,
            instance: 0,
            differ: false,
        }
    }

    /// A tick was looked at. At the first one the words that do not differ from [`UNKNOWN`] are new
    /// too.
    #[inline(always)]
    fn seen(&mut self, tick: u64) {
        if self.last.replace(tick).is_none() {
            self.note_unknown();
        }
    }

    #[cold]
    #[inline(never)]
    fn note_unknown(&mut self) {
        for leaf in 0..self.before.len() {
            if self.before[leaf] == UNKNOWN {
                self.notes.change(leaf, UNKNOWN, &mut self.awake);
            }
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

/// A walk under way.
struct Look<'a> {
    before: &'a mut [u64],
    awake: &'a mut [bool],
    marks: &'a mut [u64],
    notes: &'a mut Notes,
    /// Whether circuits within that rest are passed over.
    passes_over: bool,
    /// The leaf that comes next.
    cursor: usize,
    /// The circuit within that comes next.
    instance: usize,
    /// Whether a leaf has changed since the ports in of a circuit within began.
    differ: bool,
}

impl Probe for Look<'_> {
    #[inline(always)]
    fn enter(&mut self, field: &'static Field) {
        if field.role == Some(Role::Input) {
            self.differ = false;
        }
    }

    #[inline(always)]
    fn leaf(&mut self, _: &'static Field, _: Shape, bits: u64) {
        let leaf = self.cursor;
        self.cursor += 1;
        if bits != self.before[leaf] {
            cold_path();
            self.before[leaf] = bits;
            self.differ = true;
            self.notes.change(leaf, bits, self.awake);
        }
    }

    #[inline(always)]
    fn rests(&mut self, inside: Inside) -> bool {
        let awake = mem::take(&mut self.awake[self.instance]);
        self.instance += 1;
        let rests = self.passes_over && !awake && !self.differ;
        if rests {
            self.cursor += inside.nets.leaves;
            self.instance += inside.nets.instances;
        }
        rests
    }

    #[inline(always)]
    fn memory_rests(&mut self, words: usize, mark: u64) -> bool {
        let rests = words == 0 || self.marks[self.cursor] == mark;
        if rests {
            self.cursor += words;
        }
        rests
    }

    #[inline(always)]
    fn memory(&mut self, _: &'static Field, words: &dyn Words) {
        let start = self.cursor;
        self.cursor += words.len();
        if let Some(mark) = self.marks[start..self.cursor].first_mut() {
            let first = *mark == UNKNOWN;
            let changed = words.changed(mark);
            let changed = if first { Changed::All } else { changed };
            note_words(words, changed, self.before, self.awake, self.notes, start);
        }
    }
}

// Functions, not methods: a reference to the whole walk would keep it in memory.

#[inline(never)]
fn note_words(
    words: &dyn Words,
    changed: Changed,
    before: &mut [u64],
    awake: &mut [bool],
    notes: &mut Notes,
    start: usize,
) {
    let indices = match changed {
        Changed::None => 0..0,
        Changed::One(index) => index..index + 1,
        Changed::All => 0..words.len(),
    };
    for index in indices {
        let (leaf, bits) = (start + index, words.word(index));
        if bits != before[leaf] {
            before[leaf] = bits;
            notes.change(leaf, bits, awake);
        }
    }
}

impl Notes {
    /// A leaf has changed. It calls others only where it ends, so it has no registers to save.
    #[inline(never)]
    fn change(&mut self, leaf: usize, bits: u64, awake: &mut [bool]) {
        if self.selected[leaf] {
            if self.changes.len() == self.changes.capacity() {
                return self.grow(leaf, bits, awake);
            }
            let leaf = leaf as u32;
            self.changes.push(Change { leaf, bits });
        }
        if let Some(instance) = self.rest.of(leaf)
            && !awake[instance]
        {
            self.rest.wake(instance, awake);
        }
    }

    #[cold]
    #[inline(never)]
    fn grow(&mut self, leaf: usize, bits: u64, awake: &mut [bool]) {
        self.changes.reserve(1);
        self.change(leaf, bits, awake);
    }
}

#[cold]
fn wrong_extent(circuit: &str) -> io::Error {
    io::Error::new(
        io::ErrorKind::InvalidInput,
        format!("{circuit}: a walk shows more or less than the `EXTENT` of its signals says"),
    )
}

fn too_late() -> io::Error {
    io::Error::new(
        io::ErrorKind::InvalidInput,
        "the time of this tick does not fit into 64 bits",
    )
}
