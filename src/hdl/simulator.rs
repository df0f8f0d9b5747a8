//! Runs a circuit tick by tick.

mod run;

use super::pack;
use super::place::{At, Number, Signals};
use super::record::Walk;
use super::sample::Known;
use super::view::{Place, Shapes, Value};
use super::{Beside, Circuit, RunError, Sample, State};
use crate::engine::{Engine, EngineError, Watch};
use crate::hdl::Model;
use std::cell::RefCell;
use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

/// A circuit that is clocked tick by tick.
///
/// At tick n inputs are applied, nets settle, everything is sampled; then the edge makes the
/// registers of tick n + 1. So a register shows at n + 1 what was decided at n.
///
/// ```
/// use motion_rtl::circuits::blocks::EnableCounter;
/// use motion_rtl::hdl::Simulator;
///
/// let mut counter = Simulator::new(&EnableCounter { width: 8 })?;
/// counter.set(|i| i.period, 4)?;
/// for tick in 0..12 {
///     assert_eq!(counter.see(|s| s.w.enable), tick % 4 == 3);
///     counter.step();
/// }
/// # Ok::<(), motion_rtl::hdl::RunError>(())
/// ```
pub struct Simulator<C: Circuit> {
    engine: Engine,
    tick: u64,
    settled: bool,
    known: Arc<Known<C>>,
    /// Room for ports in that are applied.
    words: Vec<u64>,
}

/// Two runs that go on from the same tick, each with inputs of its own.
// Written out because a derive would ask the circuit itself to be `Clone`.
impl<C: Circuit> Clone for Simulator<C> {
    fn clone(&self) -> Self {
        Simulator {
            engine: self.engine.clone(),
            tick: self.tick,
            settled: self.settled,
            known: self.known.clone(),
            words: Vec::new(),
        }
    }
}

impl<C: Circuit> fmt::Debug for Simulator<C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct(C::NAME)
            .field("tick", &self.tick)
            .finish_non_exhaustive()
    }
}

/// Chooses what is watched; see [`Simulator::watching`].
pub struct Watcher<'a, C: Circuit> {
    signals: &'a Signals<C>,
    model: &'a Model,
    watched: RefCell<Vec<usize>>,
}

impl<C: Circuit> Watcher<'_, C> {
    /// What is at a place is watched.
    pub fn at<T>(&self, at: At<T>) -> At<T> {
        self.watched.borrow_mut().push(at.leaf());
        at
    }

    /// What is at several places is watched.
    pub fn each<T>(&self, places: &[At<T>]) -> Vec<At<T>> {
        places.iter().map(|at| self.at(*at)).collect()
    }

    /// Watches every port out and returns their leaves in the order of the Verilog's ports.
    pub fn ports_out(&self) -> Vec<usize> {
        let ports = self.model.ports_out();
        self.watched.borrow_mut().extend(&ports);
        ports
    }
}

impl<C: Circuit> Deref for Watcher<'_, C> {
    type Target = Signals<C>;

    fn deref(&self) -> &Signals<C> {
        self.signals
    }
}

impl<C: Circuit> fmt::Debug for Watcher<'_, C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct(C::NAME).finish_non_exhaustive()
    }
}

impl<C: Circuit> Simulator<C> {
    /// The circuit at power-on, before tick 0, all ports in low.
    ///
    /// # Errors
    /// All that is wrong with the circuit.
    pub fn new(circuit: &C) -> Result<Self, EngineError> {
        let (simulator, ()) = Self::watching(circuit, true, |_| ())?;
        Ok(simulator)
    }

    /// The circuit at power-on, of which nothing is looked at but what `choose` chooses, or `all`.
    ///
    /// Only nets that are looked at, or that registers need, are computed.
    ///
    /// # Errors
    /// All that is wrong with the circuit.
    pub fn watching<T>(
        circuit: &C,
        all: bool,
        choose: impl FnOnce(&Watcher<'_, C>) -> T,
    ) -> Result<(Self, T), EngineError> {
        let model = super::model(circuit)?;
        Ok(Self::of_model(circuit, &model, 0, all, choose))
    }

    /// The same with signals that stand in the waves beside it; [`show`](Self::show) says what they
    /// are.
    ///
    /// # Errors
    /// All that is wrong with the circuit.
    pub fn watching_beside<B: Beside, T>(
        circuit: &C,
        beside: &B,
        all: bool,
        choose: impl FnOnce(&Watcher<'_, C>) -> T,
    ) -> Result<(Self, T), EngineError> {
        let model = super::model_beside(circuit, beside)?;
        let ports = pack::widths::<B, B::Signals<Shapes>>(beside).len();
        Ok(Self::of_model(circuit, &model, ports, all, choose))
    }

    fn of_model<T>(
        circuit: &C,
        model: &Model,
        beside: usize,
        all: bool,
        choose: impl FnOnce(&Watcher<'_, C>) -> T,
    ) -> (Self, T) {
        let known = Known::of(circuit, model, beside);
        let signals = known.signals();
        let watcher = Watcher {
            signals,
            model,
            watched: RefCell::default(),
        };
        let chosen = choose(&watcher);
        let watched = watcher.watched.into_inner();
        let watch = match all {
            true => Watch::All,
            false => Watch::Leaves(&watched),
        };
        let engine = Engine::new(model.program_with(watch, &watched));
        let simulator = Simulator {
            engine,
            tick: 0,
            settled: false,
            known: Arc::new(known),
            words: Vec::new(),
        };
        (simulator, chosen)
    }

    /// It compiled now, instead of when that pays; without the feature `jit`, and where there is no
    /// compiler for the machine, as it was.
    pub fn compile(&mut self) {
        self.engine.compile();
    }

    /// It on the interpreter, however long it runs.
    pub fn interpret(&mut self) {
        self.engine.interpret();
    }

    /// The circuit.
    pub fn circuit(&self) -> &C {
        &self.known.circuit
    }

    /// The tick to come.
    pub fn tick(&self) -> u64 {
        self.tick
    }

    /// What runs.
    pub fn engine(&self) -> &Engine {
        &self.engine
    }

    /// The places of all signals.
    pub fn signals(&self) -> &Signals<C> {
        self.known.signals()
    }

    /// Sets a port in, from this tick on.
    ///
    /// # Errors
    /// The value does not fit the port, or the place is not a port in.
    #[inline]
    pub fn set<T: Number>(
        &mut self,
        port: impl FnOnce(&C::In<Place>) -> At<T>,
        value: T,
    ) -> Result<(), RunError> {
        let port = port(&self.known.signals().i);
        self.put(port.leaf(), value.word())
    }

    /// Sets a port in by its number, counted from 0 in the order of declaration, to the bits of
    /// `word`, from this tick on: for recorded inputs.
    ///
    /// # Errors
    /// The word is wider than the port, or there is no such port.
    pub fn set_port(&mut self, port: usize, word: u64) -> Result<(), RunError> {
        let checked = self.known.ports.check_word(port, word);
        checked.map_err(RunError::at(self.tick))?;
        self.drive(port, word);
        Ok(())
    }

    /// Sets a port in to a number of 64 bits.
    #[inline]
    fn put(&mut self, port: usize, number: u64) -> Result<(), RunError> {
        let bits = self.known.ports.bits(port, number);
        let bits = bits.map_err(RunError::at(self.tick))?;
        self.drive(port, bits);
        Ok(())
    }

    #[inline]
    fn drive(&mut self, port: usize, bits: u64) {
        self.engine.drive(port, bits);
        self.settled = false;
    }

    /// Sets all ports in, from this tick on.
    ///
    /// # Errors
    /// A value does not fit its port, or an array has another length; nothing is set then.
    #[inline]
    pub fn apply(&mut self, i: &C::In<Value>) -> Result<(), RunError> {
        self.words.clear();
        i.words(&mut self.words);
        let own = self.known.own_ports();
        let bits = self.known.ports.all_bits(own, &mut self.words);
        bits.map_err(RunError::at(self.tick))?;
        self.engine.drive_all(&self.words);
        self.settled = false;
        Ok(())
    }

    /// Says what stands beside it, from this tick on.
    ///
    /// # Errors
    /// A value does not fit its signal.
    pub fn show<B: Beside>(&mut self, beside: &B::Signals<Value>) -> Result<(), RunError> {
        let ports = self.known.own_ports();
        let mut numbers = (ports..).zip(pack::tokens(beside));
        numbers.try_for_each(|(port, number)| self.put(port, number))
    }

    #[inline]
    fn settle(&mut self) {
        if !self.settled {
            self.engine.settle();
            self.settled = true;
        }
    }

    /// What stands at a place in this tick, settled.
    #[inline]
    pub fn get<T: Number>(&mut self, at: At<T>) -> T {
        self.settle();
        at.of(&self.engine)
    }

    /// What one of the [signals](Signals) is in this tick, settled.
    #[inline]
    pub fn see<T: Number>(&mut self, signal: impl FnOnce(&Signals<C>) -> At<T>) -> T {
        let at = signal(self.known.signals());
        self.get(at)
    }

    /// Shows this tick, settled.
    #[inline]
    pub fn now<T>(&mut self, show: impl FnOnce(&Sample<'_, C>) -> T) -> T {
        self.settle();
        Sample::show(self.tick, &self.known, &self.engine, show)
    }

    /// Shows the registers of this tick.
    #[inline]
    pub fn state<T>(&self, show: impl FnOnce(&State<'_, C>) -> T) -> T {
        State::show(&self.known, &self.engine, show)
    }

    /// The registers of this tick.
    pub fn registers(&self) -> super::Registers<C> {
        super::sample::all_registers(&self.known.circuit, &self.engine)
    }

    /// Goes on to the next tick.
    #[inline]
    pub fn step(&mut self) {
        self.settle();
        self.edge();
    }

    /// Goes on to the next tick by a synchronous reset.
    ///
    /// After such an edge every flip-flop has its power-on value. Memories and shift registers have
    /// no reset, as block RAM has none: they take the edge as always, and what is written in the
    /// tick of reset is written.
    pub fn reset(&mut self) {
        self.settle();
        self.engine.reset();
        self.tick += 1;
        self.settled = false;
    }

    #[inline]
    fn edge(&mut self) {
        self.engine.edge();
        self.tick += 1;
        self.settled = false;
    }

    /// What is seen of tick after tick, with ports in as they are: an iterator that steps.
    ///
    /// ```
    /// use motion_rtl::circuits::blocks::EnableCounter;
    /// use motion_rtl::hdl::Simulator;
    ///
    /// let mut counter = Simulator::new(&EnableCounter { width: 8 })?;
    /// counter.set(|i| i.period, 10)?;
    /// let enable = counter.signals().w.enable;
    /// let pulses = counter.samples(|now| now.get(enable)).take(1000).filter(|seen| *seen);
    /// assert_eq!(pulses.count(), 100);
    /// # Ok::<(), motion_rtl::hdl::RunError>(())
    /// ```
    pub fn samples<T>(
        &mut self,
        mut see: impl FnMut(&Sample<'_, C>) -> T,
    ) -> impl Iterator<Item = T> {
        std::iter::from_fn(move || {
            let seen = self.now(&mut see);
            self.step();
            Some(seen)
        })
    }

    /// Runs one tick with these inputs and shows its sample.
    ///
    /// # Errors
    /// A value does not fit its port, as in [`apply`](Self::apply); the tick does not happen then.
    #[inline]
    pub fn step_with<T>(
        &mut self,
        i: &C::In<Value>,
        show: impl FnOnce(&Sample<'_, C>) -> T,
    ) -> Result<T, RunError> {
        self.step_with_reset(false, i, show)
    }

    /// The same; with `rst` high its edge is that of a [reset](Self::reset).
    ///
    /// # Errors
    /// A value does not fit its port, as in [`apply`](Self::apply); the tick does not happen then.
    #[inline]
    pub fn step_with_reset<T>(
        &mut self,
        rst: bool,
        i: &C::In<Value>,
        show: impl FnOnce(&Sample<'_, C>) -> T,
    ) -> Result<T, RunError> {
        self.apply(i)?;
        let shown = self.now(show);
        match rst {
            true => self.reset(),
            false => self.step(),
        }
        Ok(shown)
    }
}
