//! Numeric view of a tick.

use super::Elaborated;
use crate::engine::{Engine, Spot};
use crate::hdl::record::Places;
use crate::hdl::{
    At, Cells, Circuit, Contents, Kept, MemoryShape, Number, Pass, Registers, Signals, Source,
    Value,
};
use crate::netlist::{Field, Role, Shape};
use std::cell::OnceCell;
use std::fmt;
use std::ops::Deref;
use std::sync::{Arc, OnceLock};

/// All signals of a circuit at one tick, settled: the values that the waves show while `clk` is
/// high.
///
/// Records are made on first access; [`get`](Self::get) makes none.
pub struct Sample<'a, C: Circuit> {
    /// Number of the tick, from 0.
    pub tick: u64,
    /// Input ports.
    pub i: &'a Lazy<'a, C::In<Value>>,
    /// Registers.
    pub q: &'a Lazy<'a, C::Reg<Value>>,
    /// Nets.
    pub w: &'a Lazy<'a, C::Net<Value>>,
    /// Circuits inside.
    pub p: &'a Lazy<'a, C::Parts<Value>>,
    /// Registers of the circuit and of those inside it, without nets. A search makes this record
    /// once per state, and [`p`](Self::p) once per transition.
    pub registers: &'a Lazy<'a, Registers<C>>,
    /// Places of all signals.
    known: &'a Known<C>,
    engine: &'a Engine,
    /// True if the signals beside the circuit are left out.
    alone: bool,
}

/// Registers of a circuit between two ticks.
pub struct State<'a, C: Circuit> {
    /// Registers of the circuit itself.
    pub q: &'a Lazy<'a, C::Reg<Value>>,
    /// Registers of the circuits inside.
    pub p: &'a Lazy<'a, C::Parts<Kept>>,
    engine: &'a Engine,
}

/// Input ports and registers that are already records.
pub(crate) type Given<'g, C> = (
    Option<&'g <C as Circuit>::In<Value>>,
    Option<&'g Registers<C>>,
);

/// Circuit and the places of its signals.
pub(crate) struct Known<C: Circuit> {
    pub circuit: C,
    /// Number of input ports beside the circuit.
    pub beside: usize,
    /// Number of the circuit's own input ports, which come first.
    pub own_ports: usize,
    /// Number of the circuit's own nets.
    nets: usize,
    signals: OnceLock<Signals<C>>,
}

impl<C: Circuit> Known<C> {
    pub fn of(circuit: &C, model: &Elaborated, beside: usize) -> Self {
        Known {
            circuit: circuit.clone(),
            beside,
            own_ports: model.leaves(Role::Input).len() - beside,
            nets: model.own_nets(),
            signals: OnceLock::new(),
        }
    }

    /// Returns the places of all signals.
    pub fn signals(&self) -> &Signals<C> {
        let signals = || Signals::of(&self.circuit, self.beside);
        self.signals.get_or_init(signals)
    }
}

/// Leaves of an engine without the signals beside the circuit, which come last among its input
/// ports.
#[derive(Debug, Clone, Copy)]
pub(crate) struct View<'a> {
    pub engine: &'a Engine,
    first: usize,
    count: usize,
}

impl<'a> View<'a> {
    /// Returns a view of all leaves.
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

    /// Returns the word of a leaf of the circuit.
    #[inline]
    pub fn leaf(self, leaf: usize) -> u64 {
        match leaf < self.first {
            true => self.engine.word(leaf),
            false => self.engine.word(leaf + self.count),
        }
    }

    /// Converts a leaf of the engine to a leaf of the circuit.
    #[inline]
    pub fn shown(self, leaf: u32) -> Option<u32> {
        match (leaf as usize).checked_sub(self.first) {
            None => Some(leaf),
            Some(behind) if behind < self.count => None,
            Some(_) => Some(leaf - self.count as u32),
        }
    }
}

/// Record that is made on first access.
pub struct Lazy<'a, S> {
    /// Record that exists already.
    given: Option<&'a S>,
    made: OnceCell<S>,
    make: &'a dyn Fn() -> S,
}

impl<'a, S> Lazy<'a, S> {
    #[inline]
    fn new(given: Option<&'a S>, make: &'a dyn Fn() -> S) -> Self {
        Lazy {
            given,
            made: OnceCell::new(),
            make,
        }
    }
}

impl<S> Deref for Lazy<'_, S> {
    type Target = S;

    #[inline]
    fn deref(&self) -> &S {
        match self.given {
            Some(given) => given,
            None => self.made.get_or_init(self.make),
        }
    }
}

impl<S: fmt::Debug> fmt::Debug for Lazy<'_, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        (**self).fmt(f)
    }
}

impl<C: Circuit> Sample<'_, C> {
    #[inline]
    pub(crate) fn show<T>(
        tick: u64,
        known: &Known<C>,
        engine: &Engine,
        show: impl FnOnce(&Sample<'_, C>) -> T,
    ) -> T {
        Self::show_given(tick, known, engine, (None, None), show)
    }

    /// Shows a tick whose input ports and registers are already records.
    #[inline]
    pub(crate) fn show_given<T>(
        tick: u64,
        known: &Known<C>,
        engine: &Engine,
        given: Given<'_, C>,
        show: impl FnOnce(&Sample<'_, C>) -> T,
    ) -> T {
        let circuit = &known.circuit;
        let (i, registers) = given;
        show(&Sample {
            tick,
            i: &Lazy::new(i, &|| {
                let mut leaves = Leaves::of(engine, Role::Input);
                circuit.make_inputs(&mut leaves)
            }),
            q: &Lazy::new(registers.map(|all| &all.q), &|| {
                own_registers(circuit, engine)
            }),
            w: &Lazy::new(None, &|| {
                let mut leaves = Leaves::of(engine, Role::Net);
                // The circuit's own nets come last.
                leaves.places.next[Role::Net as usize] = engine.leaves() - known.nets;
                circuit.make_nets(&mut leaves)
            }),
            p: &Lazy::new(None, &|| {
                circuit.make_parts(&mut Leaves::of(engine, Role::Register))
            }),
            registers: &Lazy::new(registers, &|| all_registers(circuit, engine)),
            known,
            engine,
            alone: false,
        })
    }

    /// Returns the leaves of the circuit.
    pub(crate) fn view(&self) -> View<'_> {
        match self.alone {
            false => View::of(self.engine),
            true => View::without(self.engine, self.known.own_ports),
        }
    }

    /// Returns the same tick without the signals beside the circuit.
    pub(crate) fn alone(&self) -> Sample<'_, C> {
        Sample {
            alone: true,
            ..*self
        }
    }

    /// Returns the value at a place.
    #[inline]
    pub fn get<T: Number>(&self, at: At<T>) -> T {
        read(self.engine, at)
    }

    /// Returns the value of one of the [signals](Signals): `now.see(|s| s.w.enable)`.
    #[inline]
    pub fn see<T: Number>(&self, signal: impl FnOnce(&Signals<C>) -> At<T>) -> T {
        self.get(signal(self.known.signals()))
    }

    /// Returns the engine that runs the circuit.
    pub fn engine(&self) -> &Engine {
        self.engine
    }

    /// Returns the registers of the next tick, if there is no reset.
    pub fn next(&self) -> Registers<C> {
        let mut engine = self.engine.clone();
        engine.edge();
        all_registers(&self.known.circuit, &engine)
    }
}

impl<C: Circuit> State<'_, C> {
    #[inline]
    pub(crate) fn show<T>(
        known: &Known<C>,
        engine: &Engine,
        show: impl FnOnce(&State<'_, C>) -> T,
    ) -> T {
        let circuit = &known.circuit;
        show(&State {
            q: &Lazy::new(None, &|| own_registers(circuit, engine)),
            p: &Lazy::new(None, &|| all_registers(circuit, engine).p),
            engine,
        })
    }

    /// Returns the value of a register by its place.
    #[inline]
    pub fn get<T: Number>(&self, at: At<T>) -> T {
        read(self.engine, at)
    }
}

fn own_registers<C: Circuit>(circuit: &C, engine: &Engine) -> C::Reg<Value> {
    circuit.make_registers(&mut Leaves::of(engine, Role::Register))
}

/// Returns the registers of a circuit and of those inside it.
pub(crate) fn all_registers<C: Circuit>(circuit: &C, engine: &Engine) -> Registers<C> {
    circuit.make_kept(&mut Leaves::of(engine, Role::Register))
}

/// Returns the value at a place.
#[inline]
pub(super) fn read<T: Number>(engine: &Engine, at: At<T>) -> T {
    at.number(engine.word(at.leaf()))
}

/// Source of an engine's words, in the order of a walk.
struct Leaves<'a> {
    engine: &'a Engine,
    spots: &'a [Spot],
    slab: &'a [u64],
    places: Places,
}

impl<'a> Leaves<'a> {
    #[inline]
    fn of(engine: &'a Engine, role: Role) -> Self {
        let first = |role| engine.flat().part(role).start;
        Leaves {
            engine,
            spots: &engine.program().plan().layout.leaves,
            slab: engine.slab(),
            places: Places {
                next: [first(Role::Input), first(Role::Register), first(Role::Net)],
                role,
            },
        }
    }
}

impl Source for Leaves<'_> {
    fn pass(&mut self, pass: Pass) {
        self.places.pass(pass);
    }
    fn passing(&self) -> Pass {
        self.places.passing()
    }
    fn word(&mut self, _: &'static Field, _: Shape, _: i128) -> u64 {
        let leaf = self.places.take(1);
        match self.spots.get(leaf) {
            Some(Spot::Slot(slot)) => self.slab[*slot as usize],
            _ => self.engine.word(leaf),
        }
    }
    fn memory(
        &mut self,
        _: &'static Field,
        _: &'static Field,
        shape: MemoryShape,
        _: &dyn Fn() -> Contents,
    ) -> Cells {
        let first = self.places.take(shape.words);
        let contents = self.engine.memory_at(first);
        Cells {
            contents: contents.unwrap_or(Arc::new([])),
            ..Cells::at(first, shape)
        }
    }
}

impl<C: Circuit> fmt::Debug for Sample<'_, C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct(C::NAME)
            .field("tick", &self.tick)
            .finish_non_exhaustive()
    }
}

impl<C: Circuit> fmt::Debug for State<'_, C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct(C::NAME).finish_non_exhaustive()
    }
}
