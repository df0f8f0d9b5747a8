use crate::hdl::Declarations;
use crate::netlist::Role;
use crate::sim::{Described, LeafView as View, RunError};
use std::fmt;
use std::ops::{ControlFlow, Range};

/// Bits that a run has seen both low and high, which tells how much evidence the run is.
///
/// A memory counts as one word: a bit of it is covered if one of its words had it high and one had
/// it low.
#[derive(Debug)]
pub struct Coverage {
    signals: Vec<Signal>,
    seen: Vec<Seen>,
    /// Signal of each leaf.
    of_leaf: Vec<usize>,
    /// Tick seen last.
    last: Option<u64>,
}

/// Bits of a signal that a run has seen at one level only.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Untoggled {
    /// Signal or memory: scopes and name joined by dots.
    pub path: String,
    /// Input port, register or net.
    pub role: Role,
    /// Width in bits.
    pub width: usize,
    /// Bits that were always low or always high.
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
    /// Creates a coverage of a circuit with nothing seen.
    pub fn new(circuit: &impl Described) -> Self {
        Self::of(&circuit.outlined().1)
    }

    /// Creates a coverage of declared signals.
    pub(super) fn of(declarations: &Declarations) -> Self {
        let mut memories = declarations.memories.iter().peekable();
        let mut signals = Vec::new();
        let mut leaf = 0;
        while let Some(declared) = declarations.leaves.get(leaf) {
            let memory = memories.next_if(|memory| memory.first == leaf);
            let (path, width, words) = match memory {
                Some(memory) => {
                    let name = [memory.name.clone()];
                    let path = memory
                        .scopes
                        .iter()
                        .chain(&name)
                        .cloned()
                        .collect::<Vec<_>>();
                    (path.join("."), memory.width, memory.words)
                }
                None => (declared.path(), declared.shape.width, 1),
            };
            signals.push(Signal {
                path,
                role: declared.role,
                width,
                leaves: leaf..leaf + words,
            });
            leaf += words;
        }
        let places = signals.iter().enumerate();
        let of_leaf = places.flat_map(|(place, signal)| signal.leaves.clone().map(move |_| place));
        Coverage {
            seen: vec![Seen::default(); signals.len()],
            of_leaf: of_leaf.collect(),
            signals,
            last: None,
        }
    }

    /// Records a settled tick.
    pub(super) fn tick(&mut self, tick: u64, view: View<'_>) {
        let follows = self.last.replace(tick).is_some_and(|last| last + 1 == tick);
        let engine = view.engine;
        if !(follows && engine.program().watches_all()) {
            for (signal, seen) in self.signals.iter().zip(&mut self.seen) {
                for leaf in signal.leaves.clone() {
                    seen.see(view.leaf(leaf));
                }
            }
            return;
        }
        // Unchanged words were recorded before.
        let plan = engine.program().plan();
        engine.changed(|place| {
            let watched = &plan.layout.watched[place];
            let leaves = plan.layout.shown(watched);
            let mut see = |leaf: u32| {
                if let Some(shown) = view.shown(leaf) {
                    let signal = self.of_leaf[shown as usize];
                    self.seen[signal].see(engine.word(leaf as usize));
                }
            };
            match watched.memory.map(|memory| memory as usize) {
                // A shifted stage was recorded where it came in.
                Some(memory) => match plan.memories[memory].head {
                    Some(_) => leaves.first().copied().into_iter().for_each(see),
                    None => {
                        let (_, word) = engine.written(memory);
                        see(leaves[word as usize]);
                    }
                },
                None => leaves.iter().copied().for_each(see),
            }
        });
    }

    /// Returns the number of bits seen at both levels, and the number of all bits.
    pub fn bits(&self) -> (u64, u64) {
        let all: usize = self.signals.iter().map(|signal| signal.width).sum();
        let untoggled: u32 = self.untoggled().map(|left| left.bits.count_ones()).sum();
        (all as u64 - u64::from(untoggled), all as u64)
    }

    /// Returns the number of signals; a memory counts as one.
    pub fn signals(&self) -> usize {
        self.signals.len()
    }

    /// Returns the signals that never changed, in the order of the walk.
    pub fn still(&self) -> impl Iterator<Item = Untoggled> {
        let all = |signal: &Untoggled| u64::MAX >> (64 - signal.width);
        self.untoggled()
            .filter(move |signal| signal.bits == all(signal))
    }

    /// Returns the signals with bits that were always low or always high, in the order of the
    /// walk.
    pub fn untoggled(&self) -> impl Iterator<Item = Untoggled> {
        let seen = self.signals.iter().zip(&self.seen);
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

impl<C: crate::hdl::Circuit> crate::sim::Observer<C> for Coverage {
    fn sample(&mut self, now: &crate::sim::Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        self.tick(now.tick, now.view());
        Ok(ControlFlow::Continue(()))
    }
}

#[derive(Debug)]
struct Signal {
    path: String,
    role: Role,
    width: usize,
    leaves: Range<usize>,
}

/// Bits that were low once, and bits that were high once.
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
