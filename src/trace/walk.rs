//! The walk over all signals that finds out which have changed.

use super::Clock;
use super::glance::Glance;
use super::layout::Layout;
use super::rest::Rest;
use crate::kernel::{
    Changed, Circuit, Field, Inside, Probe, Role, Running, Sample, Shape, Signals, Words,
};
use crate::logic::Sim;
use std::hint::cold_path;
use std::io;
use std::iter;
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
///
/// Where the whole circuit coasts, only what [runs free](Circuit::FREE_RUNNING) is looked at.
#[derive(Debug)]
pub(super) struct Walk {
    clock: Clock,
    last: Option<u64>,
    /// The values of the tick before, in the order of the walk.
    before: Vec<u64>,
    /// Which circuits within have registers that have changed, and the one that holds them.
    awake: Vec<bool>,
    /// How often every memory had changed in the tick before, at the place of its first word.
    marks: Vec<u64>,
    rest: Rest,
    /// How many leaves before each, and before the end, can change while the circuit coasts.
    free: Vec<u32>,
    /// Which leaves are wanted, unless all are.
    selected: Option<Vec<bool>>,
    /// What has changed in the tick, with room for every leaf.
    changes: Vec<Change>,
    /// How many of these there are.
    changed: usize,
}

impl Walk {
    pub fn new(layout: &Layout, clock: Clock) -> Self {
        let leaves = layout.leaves.len();
        let rest = Rest::new(&layout.leaves, &layout.instances);
        Walk {
            clock,
            last: None,
            before: vec![UNKNOWN; leaves],
            awake: rest.awake(),
            marks: vec![UNKNOWN; leaves],
            rest,
            free: counted(&layout.free),
            selected: layout
                .selected
                .contains(&false)
                .then(|| layout.selected.clone()),
            changes: vec![Change { leaf: 0, bits: 0 }; leaves],
            changed: 0,
        }
    }

    /// Looks at a tick. Returns when `clk` rises and when it falls.
    pub fn sample<C: Circuit>(&mut self, now: &Sample<'_, C>) -> io::Result<(u64, u64)> {
        if now.coasting && !self.follows(now.tick) {
            return Err(unseen(now.tick));
        }
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
            || look.changes.len() != extent.leaves
            || look.awake.len() != extent.instances + 1
            || look.free.len() != extent.leaves + 1
        {
            return Err(wrong_extent(C::NAME));
        }
        let changed = match now.coasting {
            true => look.glance().look(now),
            false => {
                now.visit(&mut look);
                look.changed
            }
        };
        self.seen(now.tick, changed);
        Ok(times)
    }

    /// The same of a circuit whose type is forgotten; it looks at everything.
    pub fn tick(&mut self, tick: u64, running: &dyn Running) -> io::Result<(u64, u64)> {
        let times = self.begin(tick)?;
        let mut look = self.look(false);
        running.show(&mut look);
        let changed = look.changed;
        self.seen(tick, changed);
        Ok(times)
    }

    fn begin(&mut self, tick: u64) -> io::Result<(u64, u64)> {
        if self.last.is_some_and(|last| last >= tick) {
            return Err(io::Error::new(
                io::ErrorKind::InvalidInput,
                format!("tick {tick} comes twice"),
            ));
        }
        self.rest.begin(&mut self.awake);
        let times = (self.clock.rise(tick), self.clock.fall(tick));
        times.0.zip(times.1).ok_or_else(too_late)
    }

    fn look(&mut self, passes_over: bool) -> Look<'_> {
        Look {
            before: &mut self.before,
            awake: &mut self.awake,
            marks: &mut self.marks,
            rest: &self.rest,
            free: &self.free,
            changes: &mut self.changes,
            changed: 0,
            passes_over,
            cursor: 0,
            instance: 0,
            differ: false,
            registers: true,
        }
    }

    /// A tick was looked at, and so many leaves have changed. At the first one the words that do not
    /// differ from [`UNKNOWN`] are new too.
    fn seen(&mut self, tick: u64, changed: usize) {
        self.changed = changed;
        if self.last.replace(tick).is_none() {
            self.note_unknown();
        }
        if let Some(selected) = &self.selected {
            self.changed = select(selected, &mut self.changes[..self.changed]);
        }
    }

    #[cold]
    fn note_unknown(&mut self) {
        for leaf in 0..self.before.len() {
            if self.before[leaf] == UNKNOWN {
                self.changed = note(&mut self.changes, self.changed, leaf, UNKNOWN);
            }
        }
    }

    /// What has changed in the tick.
    pub fn changes(&self) -> &[Change] {
        &self.changes[..self.changed]
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
    rest: &'a Rest,
    free: &'a [u32],
    changes: &'a mut [Change],
    /// How many of these there are.
    changed: usize,
    /// Whether circuits within that rest are passed over.
    passes_over: bool,
    /// The leaf that comes next.
    cursor: usize,
    /// The circuit within that comes next.
    instance: usize,
    /// Whether a leaf has changed since the ports in of a circuit within began.
    differ: bool,
    /// Registers are still to come, or have just been seen.
    registers: bool,
}

impl<'a> Look<'a> {
    /// Looks at less.
    fn glance(self) -> Glance<'a> {
        Glance {
            before: self.before,
            marks: self.marks,
            awake: self.awake,
            rest: self.rest,
            free: self.free,
            changes: self.changes,
            changed: 0,
            cursor: 0,
            instance: 0,
            registers: true,
            looks: 1,
        }
    }
}

impl Probe for Look<'_> {
    fn enter(&mut self, field: &'static Field) {
        match field.role {
            Some(Role::Input) => self.differ = false,
            Some(Role::Net) if mem::take(&mut self.registers) => {
                self.rest.wake(&self.changes[..self.changed], self.awake);
            }
            _ => {}
        }
    }

    fn leaf(&mut self, _: &'static Field, _: Shape, bits: u64) {
        let leaf = self.cursor;
        self.cursor += 1;
        if bits != self.before[leaf] {
            cold_path();
            self.before[leaf] = bits;
            self.differ = true;
            self.changed = note(self.changes, self.changed, leaf, bits);
        }
    }

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

    fn memory_rests(&mut self, words: usize, mark: u64) -> bool {
        let rests = words == 0 || self.marks[self.cursor] == mark;
        if rests {
            self.cursor += words;
        }
        rests
    }

    fn memory(&mut self, _: &'static Field, words: &dyn Words) {
        let start = self.cursor;
        self.cursor += words.len();
        let (before, marks) = (&mut *self.before, &mut *self.marks);
        self.changed = note_memory(words, start, before, marks, self.changes, self.changed);
    }
}

// Functions, not methods: a reference to the whole walk would keep it in memory.

/// Adds a change; returns how many there are now. There is room, since a leaf changes once a tick.
pub(super) fn note(changes: &mut [Change], changed: usize, leaf: usize, bits: u64) -> usize {
    if let Some(place) = changes.get_mut(changed) {
        let leaf = leaf as u32;
        *place = Change { leaf, bits };
    }
    changed + 1
}

/// Looks at the memory whose first word is the leaf `start`.
pub(super) fn note_memory(
    words: &dyn Words,
    start: usize,
    before: &mut [u64],
    marks: &mut [u64],
    changes: &mut [Change],
    mut noted: usize,
) -> usize {
    let Some(mark) = marks[start..start + words.len()].first_mut() else {
        return noted;
    };
    let first = *mark == UNKNOWN;
    let changed = words.changed(mark);
    let indices = match if first { Changed::All } else { changed } {
        Changed::None => 0..0,
        Changed::One(index) => index..index + 1,
        Changed::All => 0..words.len(),
    };
    for index in indices {
        let (leaf, bits) = (start + index, words.word(index));
        if bits != before[leaf] {
            before[leaf] = bits;
            noted = note(changes, noted, leaf, bits);
        }
    }
    noted
}

/// How many of the flags before each, and before the end, are set.
fn counted(flags: &[bool]) -> Vec<u32> {
    let mut count = 0;
    let after = flags.iter().map(|&flag| {
        count += u32::from(flag);
        count
    });
    iter::once(0).chain(after).collect()
}

/// Drops the changes of leaves that are not wanted; returns how many are left.
fn select(selected: &[bool], changes: &mut [Change]) -> usize {
    let mut kept = 0;
    for index in 0..changes.len() {
        let change = changes[index];
        changes[kept] = change;
        kept += usize::from(selected[change.leaf as usize]);
    }
    kept
}

#[cold]
fn wrong_extent(circuit: &str) -> io::Error {
    io::Error::new(
        io::ErrorKind::InvalidInput,
        format!("{circuit}: a walk shows more or less than the `EXTENT` of its signals says"),
    )
}

#[cold]
fn unseen(tick: u64) -> io::Error {
    io::Error::new(
        io::ErrorKind::InvalidInput,
        format!(
            "tick {tick} comes as one in which the circuit coasts, but the one before was not seen"
        ),
    )
}

fn too_late() -> io::Error {
    io::Error::new(
        io::ErrorKind::InvalidInput,
        "the time of this tick does not fit into 64 bits",
    )
}
