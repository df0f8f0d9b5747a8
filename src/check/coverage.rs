use crate::kernel::{
    Changed, Circuit, Field, Machine, Observer, Path, Probe, Role, RunError, Running, Sample,
    Shape, Words,
};
use std::fmt;
use std::ops::ControlFlow;

/// Which bits a run has seen both low and high: what the run is worth as evidence.
///
/// A memory counts as one word: a bit of it is covered when one of its words had it high and one
/// had it low.
#[derive(Debug)]
pub struct Coverage {
    signals: Vec<Signal>,
    walk: Walk,
}

/// Bits of a signal that a run has seen at one level only.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Untoggled {
    /// The signal or memory: scopes and name joined by dots.
    pub path: String,
    /// Port in, register or net.
    pub role: Role,
    /// Its width in bits.
    pub width: usize,
    /// The bits that were always low or always high.
    pub bits: u64,
}

impl fmt::Display for Untoggled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Untoggled {
            path, width, bits, ..
        } = self;
        write!(f, "{path}[{width}]: {bits:#x}")
    }
}

impl Coverage {
    /// Nothing seen yet of this circuit.
    pub fn new<C: Circuit>(circuit: &C) -> Self {
        Self::of(&Machine::new(circuit))
    }

    /// The same of a circuit whose type is forgotten.
    pub(super) fn of(running: &dyn Running) -> Self {
        let mut names = Names::default();
        running.show(&mut names);
        let signals = names.signals.len();
        Coverage {
            signals: names.signals,
            walk: Walk {
                seen: vec![Seen::default(); signals],
                marks: vec![0; signals],
                cursor: 0,
                first: true,
            },
        }
    }

    /// Begins a tick; the probe is to see all of its signals.
    pub(super) fn tick(&mut self) -> &mut dyn Probe {
        self.walk.first = self.walk.first && self.walk.cursor == 0;
        self.walk.cursor = 0;
        &mut self.walk
    }

    /// The bits seen at both levels, and all bits there are.
    pub fn bits(&self) -> (u64, u64) {
        let all: usize = self.signals.iter().map(|signal| signal.width).sum();
        let untoggled: u32 = self.untoggled().map(|left| left.bits.count_ones()).sum();
        (all as u64 - u64::from(untoggled), all as u64)
    }

    /// The signals with bits that were always low or always high, in the order of the walk.
    pub fn untoggled(&self) -> impl Iterator<Item = Untoggled> {
        let seen = self.signals.iter().zip(&self.walk.seen);
        seen.filter_map(|(signal, seen)| {
            let bits = u64::MAX >> (64 - signal.width) & !(seen.low & seen.high);
            (bits != 0).then(|| Untoggled {
                path: signal.path.clone(),
                role: signal.role,
                width: signal.width,
                bits,
            })
        })
    }
}

impl<C: Circuit> Observer<C> for Coverage {
    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        now.show(self.tick());
        Ok(ControlFlow::Continue(()))
    }
}

#[derive(Debug)]
struct Signal {
    path: String,
    role: Role,
    width: usize,
}

/// The walk that lists the signals.
#[derive(Default)]
struct Names {
    path: Path,
    signals: Vec<Signal>,
}

impl Names {
    fn add(&mut self, field: &'static Field, width: usize) {
        let name = self.path.name(field);
        let scopes = self.path.scopes().iter().map(String::as_str);
        self.signals.push(Signal {
            path: scopes.chain([&*name]).collect::<Vec<_>>().join("."),
            role: self.path.role(),
            width,
        });
    }
}

impl Probe for Names {
    fn enter(&mut self, field: &'static Field) {
        self.path.enter(field);
    }
    fn leave(&mut self) {
        self.path.leave();
    }
    fn element(&mut self, index: usize) {
        self.path.element(index);
    }
    fn leaf(&mut self, field: &'static Field, shape: Shape, _: u64) {
        self.add(field, shape.width);
    }
    fn memory(&mut self, field: &'static Field, words: &dyn Words) {
        self.add(field, words.width());
    }
}

/// The bits that were low once, and those that were high once.
#[derive(Debug, Clone, Copy, Default)]
struct Seen {
    low: u64,
    high: u64,
}

impl Seen {
    fn see(&mut self, bits: u64) {
        self.low |= !bits;
        self.high |= bits;
    }
}

/// The walk that looks.
#[derive(Debug)]
struct Walk {
    seen: Vec<Seen>,
    /// Where a memory stood in the tick before.
    marks: Vec<u64>,
    cursor: usize,
    first: bool,
}

impl Walk {
    fn next(&mut self) -> Option<&mut Seen> {
        self.cursor += 1;
        self.seen.get_mut(self.cursor - 1)
    }
}

impl Probe for Walk {
    fn leaf(&mut self, _: &'static Field, _: Shape, bits: u64) {
        if let Some(seen) = self.next() {
            seen.see(bits);
        }
    }

    fn memory(&mut self, _: &'static Field, words: &dyn Words) {
        let first = self.first;
        let Some(mark) = self.marks.get_mut(self.cursor) else {
            return;
        };
        let changed = words.changed(mark);
        let Some(seen) = self.next() else { return };
        match changed {
            _ if first => (0..words.len()).for_each(|index| seen.see(words.word(index))),
            Changed::None => {}
            Changed::One(index) => seen.see(words.word(index)),
            Changed::All => (0..words.len()).for_each(|index| seen.see(words.word(index))),
        }
    }
}
