use super::probe::Source;
use super::{Circuit, Field, Role, Shape, Signals, part, widths};
use crate::engine::{Engine, Spot};
use crate::logic::Sim;
use crate::logic::netlist::{NetBit, NetInt, NetUInt};
use std::cell::OnceCell;
use std::fmt;
use std::marker::PhantomData;
use std::ops::Deref;
use std::sync::Arc;

/// All signals of a circuit at one tick, settled: what stands in the waves while `clk` is high.
pub struct Sample<'a, C: Circuit> {
    /// The tick, from 0.
    pub tick: u64,
    /// Ports in.
    pub i: &'a Part<'a, C::In<Sim>>,
    /// Registers.
    pub q: &'a Part<'a, C::Reg<Sim>>,
    /// Nets.
    pub w: &'a Part<'a, C::Net<Sim>>,
    view: View<'a>,
}

impl<C: Circuit> Sample<'_, C> {
    /// Shows a settled tick.
    pub(crate) fn show<T>(tick: u64, engine: &Engine, show: impl FnOnce(&Sample<'_, C>) -> T) -> T {
        Self::show_as(tick, View::of(engine), show)
    }

    /// The same of a circuit with signals beside it, without these.
    pub(crate) fn show_without<T>(
        tick: u64,
        engine: &Engine,
        show: impl FnOnce(&Sample<'_, C>) -> T,
    ) -> T {
        let ports = widths::<C::In<Sim>>().len();
        Self::show_as(tick, View::without(engine, ports), show)
    }

    fn show_as<T>(tick: u64, view: View<'_>, show: impl FnOnce(&Sample<'_, C>) -> T) -> T {
        let engine = view.engine;
        show(&Sample {
            tick,
            i: &Part::new(Role::Input, engine),
            q: &Part::new(Role::Register, engine),
            w: &Part::new(Role::Net, engine),
            view,
        })
    }

    /// What is watched at a place.
    #[inline]
    pub fn get<T: Word>(&self, at: At<T>) -> T {
        at.of(self.view.engine)
    }

    /// Shows a settled tick of which ports in and registers are at hand.
    pub(crate) fn show_given<T>(
        tick: u64,
        engine: &Engine,
        (i, q): (&C::In<Sim>, &C::Reg<Sim>),
        show: impl FnOnce(&Sample<'_, C>) -> T,
    ) -> T {
        show(&Sample {
            tick,
            i: &Part::given(i, Role::Input, engine),
            q: &Part::given(q, Role::Register, engine),
            w: &Part::new(Role::Net, engine),
            view: View::of(engine),
        })
    }

    /// What runs.
    pub fn engine(&self) -> &Engine {
        self.view.engine
    }

    /// The leaves of the circuit.
    pub(crate) fn view(&self) -> View<'_> {
        self.view
    }

    /// The registers of the next tick, if no reset comes.
    pub fn next(&self) -> C::Reg<Sim> {
        let mut engine = self.view.engine.clone();
        engine.edge();
        record(Role::Register, &engine)
    }
}

impl<C: Circuit> fmt::Debug for Sample<'_, C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Sample")
            .field("tick", &self.tick)
            .field("i", self.i)
            .field("q", self.q)
            .field("w", self.w)
            .finish()
    }
}

/// The leaves of an engine, without those of signals that stand beside the circuit: these come last
/// among its ports in.
#[derive(Debug, Clone, Copy)]
pub(crate) struct View<'a> {
    pub engine: &'a Engine,
    first: usize,
    count: usize,
}

impl<'a> View<'a> {
    /// All of them.
    pub fn of(engine: &'a Engine) -> Self {
        View {
            engine,
            first: usize::MAX,
            count: 0,
        }
    }

    fn without(engine: &'a Engine, ports: usize) -> Self {
        View {
            engine,
            first: ports,
            count: engine.flat().inputs.len() - ports,
        }
    }

    /// What a leaf of the circuit is.
    pub fn leaf(self, leaf: usize) -> u64 {
        match leaf < self.first {
            true => self.engine.leaf(leaf),
            false => self.engine.leaf(leaf + self.count),
        }
    }

    /// The leaf of the circuit that one of the engine is.
    pub fn shown(self, leaf: u32) -> Option<u32> {
        match (leaf as usize).checked_sub(self.first) {
            None => Some(leaf),
            Some(behind) if behind < self.count => None,
            Some(_) => Some(leaf - self.count as u32),
        }
    }
}

/// Ports in, registers or nets of a circuit as a record of numbers, which is made when it is first
/// looked at.
pub struct Part<'a, S> {
    given: Option<&'a S>,
    made: OnceCell<S>,
    role: Role,
    engine: &'a Engine,
}

impl<'a, S> Part<'a, S> {
    pub(super) fn new(role: Role, engine: &'a Engine) -> Self {
        Part {
            given: None,
            made: OnceCell::new(),
            role,
            engine,
        }
    }

    /// The same where the record is at hand.
    fn given(record: &'a S, role: Role, engine: &'a Engine) -> Self {
        Part {
            given: Some(record),
            ..Part::new(role, engine)
        }
    }

    /// What is watched at a place, whatever part it is of. A net needs a settled tick.
    #[inline]
    pub fn get<T: Word>(&self, at: At<T>) -> T {
        at.of(self.engine)
    }
}

impl<S: Signals<Sim>> Deref for Part<'_, S> {
    type Target = S;

    fn deref(&self) -> &S {
        match self.given {
            Some(record) => record,
            None => self.made.get_or_init(|| record(self.role, self.engine)),
        }
    }
}

impl<S: Signals<Sim>> fmt::Debug for Part<'_, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        (**self).fmt(f)
    }
}

/// A part of a circuit as a record.
pub(crate) fn record<S: Signals<Sim>>(role: Role, engine: &Engine) -> S {
    let first = engine.flat().part(role).start;
    let mut leaves = Leaves {
        engine,
        spots: &engine.program().plan().layout.leaves,
        slab: engine.slab(),
        leaf: first,
    };
    S::make(part(role), &mut leaves)
}

struct Leaves<'a> {
    engine: &'a Engine,
    spots: &'a [Spot],
    slab: &'a [u64],
    leaf: usize,
}

impl Source for Leaves<'_> {
    #[inline]
    fn leaf(&mut self, _: &'static Field, _: Shape) -> u64 {
        let leaf = self.leaf;
        self.leaf += 1;
        match self.spots.get(leaf) {
            Some(Spot::Slot(slot)) => self.slab[*slot as usize],
            _ => self.engine.leaf(leaf),
        }
    }

    fn memory(&mut self, words: usize) -> Option<Arc<[u64]>> {
        let memory = self.engine.memory_at(self.leaf)?;
        self.leaf += words;
        Some(memory)
    }
}

/// Where a signal is that is watched; see [`Simulator::watching`](super::Simulator::watching).
pub struct At<T> {
    leaf: usize,
    /// Bits of 64 that are above it.
    spare: u32,
    word: PhantomData<fn() -> T>,
}

impl<T: Word> At<T> {
    pub(super) fn new(leaf: usize, width: usize) -> Self {
        At {
            leaf,
            spare: 64 - width as u32,
            word: PhantomData,
        }
    }

    /// The leaf of the walk.
    pub fn leaf(self) -> usize {
        self.leaf
    }

    #[inline]
    pub(super) fn of(self, engine: &Engine) -> T {
        T::of(engine.leaf(self.leaf), self.spare)
    }
}

// Written out because a derive would ask the word itself to be `Copy`.
impl<T> Clone for At<T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for At<T> {}

impl<T> fmt::Debug for At<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "At({})", self.leaf)
    }
}

/// What is seen at a place.
pub trait Word {
    /// From the word that stands there, and the number of bits above it.
    fn of(word: u64, spare: u32) -> Self;
}

impl Word for bool {
    #[inline]
    fn of(word: u64, _: u32) -> bool {
        word != 0
    }
}

impl Word for u64 {
    #[inline]
    fn of(word: u64, _: u32) -> u64 {
        word
    }
}

impl Word for i64 {
    #[inline]
    fn of(word: u64, spare: u32) -> i64 {
        (word << spare) as i64 >> spare
    }
}

/// A wire or word of the records of places.
pub trait Place: Copy {
    /// What is seen there.
    type Word: Word;
    /// Its width in bits.
    const WIDTH: usize;
    /// The leaf that it is.
    fn leaf(self) -> usize;
}

impl Place for NetBit {
    type Word = bool;
    const WIDTH: usize = 1;
    fn leaf(self) -> usize {
        self.id()
    }
}

impl<const N: usize> Place for NetUInt<N> {
    type Word = u64;
    const WIDTH: usize = N;
    fn leaf(self) -> usize {
        self.id()
    }
}

impl<const N: usize> Place for NetInt<N> {
    type Word = i64;
    const WIDTH: usize = N;
    fn leaf(self) -> usize {
        self.id()
    }
}
