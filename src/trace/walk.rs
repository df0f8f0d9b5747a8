//! The walk over all signals that finds out which have changed.

use super::Clock;
use super::layout::Layout;
use super::rest::Rest;
use crate::kernel::{
    Changed, Circuit, Field, Inside, Probe, Role, Running, Sample, Shape, Signals, Words,
};
use crate::logic::Sim;
use std::io;
use std::mem;
use std::ops::Range;

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
    /// The values of this tick, as far as they were looked at, in the order of the walk.
    now: Vec<u64>,
    /// Those of the tick before.
    before: Vec<u64>,
    /// Which circuits within have registers that have changed.
    awake: Vec<bool>,
    /// Where every memory stood in the tick before.
    marks: Vec<u64>,
    notes: Notes,
}

#[derive(Debug)]
struct Notes {
    rest: Rest,
    selected: Vec<bool>,
    changes: Vec<Change>,
    /// At the first tick everything is noted, changed or not.
    first: bool,
}

impl Walk {
    pub fn new(layout: &Layout, clock: Clock) -> Self {
        let leaves = layout.leaves.len();
        Walk {
            clock,
            last: None,
            now: vec![0; leaves],
            before: vec![0; leaves],
            awake: vec![true; layout.instances.len()],
            marks: Vec::new(),
            notes: Notes {
                rest: Rest::new(&layout.leaves, &layout.instances),
                selected: layout.selected.clone(),
                changes: Vec::new(),
                first: true,
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
        if look.now.len() != extent.leaves
            || look.before.len() != extent.leaves
            || look.awake.len() != extent.instances
        {
            return Err(wrong_extent(C::NAME));
        }
        now.visit(&mut look);
        look.note();
        Ok(times)
    }

    /// The same of a circuit whose type is forgotten; it looks at everything.
    pub fn tick(&mut self, tick: u64, running: &dyn Running) -> io::Result<(u64, u64)> {
        let times = self.begin(tick)?;
        let mut look = self.look(false);
        running.show(&mut look);
        look.note();
        Ok(times)
    }

    fn begin(&mut self, tick: u64) -> io::Result<(u64, u64)> {
        if self.last.is_some_and(|last| last >= tick) {
            return Err(io::Error::new(
                io::ErrorKind::InvalidInput,
                format!("tick {tick} comes twice"),
            ));
        }
        self.notes.first = self.last.is_none();
        self.notes.rest.begin(&mut self.awake);
        self.last = Some(tick);
        let times = (self.clock.rise(tick), self.clock.fall(tick));
        times.0.zip(times.1).ok_or_else(too_late)
    }

    #[inline(always)]
    fn look(&mut self, passes_over: bool) -> Look<'_> {
        let first = self.notes.first.into();
        Look {
            now: &mut self.now,
            before: &mut self.before,
            awake: &mut self.awake,
            marks: &mut self.marks,
            notes: &mut self.notes,
            passes_over,
            cursor: 0,
            from: 0,
            instance: 0,
            memory: 0,
            ports: false,
            first,
            differ: first,
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
    now: &'a mut [u64],
    before: &'a mut [u64],
    awake: &'a mut [bool],
    marks: &'a mut Vec<u64>,
    notes: &'a mut Notes,
    /// Whether circuits within that rest are passed over.
    passes_over: bool,
    /// The leaf that comes next.
    cursor: usize,
    /// The first leaf that nothing is noted of yet.
    from: usize,
    /// The circuit within that comes next.
    instance: usize,
    /// The memory that comes next.
    memory: usize,
    /// Whether ports in are shown.
    ports: bool,
    /// What `differ` begins with: not 0 at the first tick.
    first: u64,
    /// Not 0 where one of the leaves that nothing is noted of yet has changed.
    differ: u64,
}

impl Look<'_> {
    /// Notes what has changed of what was shown.
    #[inline(always)]
    fn note(&mut self) {
        if self.from < self.cursor && self.differ != 0 {
            let leaves = self.from..self.cursor;
            note(self.now, self.before, self.awake, self.notes, leaves);
        }
        self.go_on();
    }

    #[inline(always)]
    fn go_on(&mut self) {
        self.from = self.cursor;
        self.differ = self.first;
    }
}

impl Probe for Look<'_> {
    #[inline(always)]
    fn enter(&mut self, field: &'static Field) {
        let within_ports = self.ports && field.role.is_none();
        self.ports = within_ports || field.role == Some(Role::Input);
        // Ports in are compared as a whole.
        if !within_ports {
            self.note();
        }
    }

    #[inline(always)]
    fn leaf(&mut self, _: &'static Field, _: Shape, bits: u64) {
        self.now[self.cursor] = bits;
        self.differ |= bits ^ self.before[self.cursor];
        self.cursor += 1;
    }

    #[inline(always)]
    fn rests(&mut self, inside: Inside) -> bool {
        let awake = mem::take(&mut self.awake[self.instance]);
        self.instance += 1;
        let rests = self.passes_over && !awake && self.differ == 0;
        if rests {
            self.cursor += inside.nets.leaves;
            self.instance += inside.nets.instances;
            self.go_on();
        }
        rests
    }

    #[inline(always)]
    fn memory(&mut self, _: &'static Field, words: &dyn Words) {
        self.note();
        let start = self.cursor;
        self.cursor += words.len();
        self.go_on();
        if self.notes.first {
            self.marks.push(0);
        }
        let changed = words.changed(&mut self.marks[self.memory]);
        self.memory += 1;
        if changed != Changed::None || self.notes.first {
            note_words(words, changed, self.before, self.awake, self.notes, start);
        }
    }
}

// Functions, not methods: a reference to the whole walk would keep it in memory.

#[inline(never)]
fn note(
    now: &[u64],
    before: &mut [u64],
    awake: &mut [bool],
    notes: &mut Notes,
    leaves: Range<usize>,
) {
    let start = leaves.start;
    let (now, before) = (&now[leaves.clone()], &mut before[leaves]);
    for (place, (&bits, before)) in now.iter().zip(before).enumerate() {
        if bits != *before || notes.first {
            *before = bits;
            notes.change(start + place, bits, awake);
        }
    }
}

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
        Changed::One(index) if !notes.first => index..index + 1,
        _ => 0..words.len(),
    };
    for index in indices {
        let (leaf, bits) = (start + index, words.word(index));
        if bits != before[leaf] || notes.first {
            before[leaf] = bits;
            notes.change(leaf, bits, awake);
        }
    }
}

impl Notes {
    #[inline(never)]
    fn change(&mut self, leaf: usize, bits: u64, awake: &mut [bool]) {
        self.rest.wake(leaf, awake);
        if self.selected[leaf] {
            let leaf = leaf as u32;
            self.changes.push(Change { leaf, bits });
        }
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
