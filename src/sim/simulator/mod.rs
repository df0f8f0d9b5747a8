//! Tick-by-tick simulation of a circuit.

mod run;

use super::sample::{Known, all_registers, read};
use super::{Beside, Elaborated, Model, Needs, RunError, Sample, State};
use crate::engine::{Engine, EngineError, Watch};
use crate::hdl::{At, Circuit, Number, Place, Registers, Shapes, Signals, Value, Walk, pack};
use std::cell::RefCell;
use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

/// A circuit that is clocked tick by tick.
///
/// In tick n inputs are applied, nets settle, and everything is sampled. Then the edge makes the
/// registers of tick n + 1, so a register shows at n + 1 what was decided at n.
///
/// ```
/// use motion_rtl::circuits::blocks::EnableCounter;
/// use motion_rtl::sim::Simulator;
///
/// let mut counter = Simulator::new(&EnableCounter { width: 8 })?;
/// counter.set(|i| i.period, 4)?;
/// for tick in 0..12 {
///     assert_eq!(counter.see(|s| s.w.enable), tick % 4 == 3);
///     counter.step();
/// }
/// # Ok::<(), motion_rtl::sim::RunError>(())
/// ```
pub struct Simulator<C: Circuit> {
    model: Model,
    known: Arc<Known<C>>,
    /// Buffer for input ports.
    words: Vec<u64>,
    /// Numbers of the last [`apply`](Self::apply), if no port has been set in another way since.
    applied: Vec<u64>,
    each: Option<EachTick<C>>,
    /// Leaves that are watched in every tick, if an observer needs all in some of them.
    always: Option<Vec<usize>>,
    /// Engine for the other ticks; see [`watch_for`](Self::watch_for).
    other: Option<Box<Engine>>,
}

/// Function that receives every tick.
type EachTick<C> = Box<dyn FnMut(&Sample<'_, C>) + Send + Sync>;

/// Creates an independent copy: both continue from the same tick, each with its own inputs. The
/// copy has no [`each_tick`](Simulator::each_tick).
// Written by hand: a derive would require `C: Clone`.
impl<C: Circuit> Clone for Simulator<C> {
    fn clone(&self) -> Self {
        Simulator {
            model: self.model.clone(),
            known: self.known.clone(),
            words: Vec::new(),
            applied: Vec::new(),
            each: None,
            always: self.always.clone(),
            other: self.other.clone(),
        }
    }
}

/// A tick in which a panic drops the simulator is received too.
impl<C: Circuit> Drop for Simulator<C> {
    fn drop(&mut self) {
        if std::thread::panicking() && self.each.is_some() {
            self.model.settle();
            self.pass_on();
        }
    }
}

impl<C: Circuit> fmt::Debug for Simulator<C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct(C::NAME)
            .field("tick", &self.tick())
            .finish_non_exhaustive()
    }
}

/// Chooses the watched signals; see [`Simulator::watching`].
pub struct Watcher<'a, C: Circuit> {
    signals: &'a Signals<C>,
    model: &'a Elaborated,
    watched: RefCell<Vec<usize>>,
}

impl<C: Circuit> Watcher<'_, C> {
    /// Watches the signal at a place.
    pub fn at<T>(&self, at: At<T>) -> At<T> {
        self.watched.borrow_mut().push(at.leaf());
        at
    }

    /// Watches the signals at several places.
    pub fn each<T>(&self, places: &[At<T>]) -> Vec<At<T>> {
        places.iter().map(|at| self.at(*at)).collect()
    }

    /// Watches all output ports; returns their leaves in the port order of the Verilog module.
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
    /// Creates the circuit in the power-on state, before tick 0, with all input ports low.
    ///
    /// # Errors
    /// Returns all mistakes of the circuit.
    pub fn new(circuit: &C) -> Result<Self, EngineError> {
        let (simulator, ()) = Self::watching(circuit, true, |_| ())?;
        Ok(simulator)
    }

    /// Creates the circuit in the power-on state; watches only the signals that `choose` picks and
    /// those of `needs`, such as an observer's; `true` stands for all. Other signals can still be
    /// read, at the cost of computing all nets.
    ///
    /// Computes only nets that are watched or that registers need.
    ///
    /// # Errors
    /// Returns all mistakes of the circuit.
    pub fn watching<T>(
        circuit: &C,
        needs: impl Into<Needs>,
        choose: impl FnOnce(&Watcher<'_, C>) -> T,
    ) -> Result<(Self, T), EngineError> {
        let model = Elaborated::new(circuit)?;
        Ok(Self::of_model(circuit, &model, 0, needs.into(), choose))
    }

    /// Creates the circuit as [`watching`](Self::watching) does, with signals beside it in the
    /// waves; [`show`](Self::show) sets their values.
    ///
    /// # Errors
    /// Returns all mistakes of the circuit.
    pub fn watching_beside<B: Beside, T>(
        circuit: &C,
        beside: &B,
        needs: impl Into<Needs>,
        choose: impl FnOnce(&Watcher<'_, C>) -> T,
    ) -> Result<(Self, T), EngineError> {
        let model = Elaborated::with_beside(circuit, beside)?;
        let ports = pack::widths::<B, B::Signals<Shapes>>(beside).len();
        Ok(Self::of_model(circuit, &model, ports, needs.into(), choose))
    }

    fn of_model<T>(
        circuit: &C,
        model: &Elaborated,
        beside: usize,
        needs: Needs,
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
        let mut watched = watcher.watched.into_inner();
        watched.extend(needs.leaves);
        let watch = match needs.all {
            true => Watch::All,
            false => Watch::Leaves(&watched),
        };
        let simulator = Simulator {
            model: Model::watching(model, watch, &watched),
            known: Arc::new(known),
            words: Vec::new(),
            applied: Vec::new(),
            each: None,
            always: needs.all.then_some(watched),
            other: None,
        };
        (simulator, chosen)
    }

    /// Compiles the circuit at once, rather than when it pays. Does nothing without the feature
    /// `jit`, or if there is no compiler for the machine.
    pub fn compile(&mut self) {
        self.model.engine_mut().compile();
    }

    /// Keeps the circuit on the interpreter, however long it runs.
    pub fn interpret(&mut self) {
        self.model.engine_mut().interpret();
    }

    /// Returns the circuit.
    pub fn circuit(&self) -> &C {
        &self.known.circuit
    }

    /// Returns the number of the next tick.
    pub fn tick(&self) -> u64 {
        self.model.tick()
    }

    /// Returns the engine that runs the circuit.
    pub fn engine(&self) -> &Engine {
        self.model.engine()
    }

    /// Returns the places of all signals.
    pub fn signals(&self) -> &Signals<C> {
        self.known.signals()
    }

    /// Sets an input port, from this tick on.
    ///
    /// # Errors
    /// Returns an error if the value does not fit the port, or the place is not an input port.
    #[inline]
    pub fn set<T: Number>(
        &mut self,
        port: impl FnOnce(&C::In<Place>) -> At<T>,
        value: T,
    ) -> Result<(), RunError> {
        let port = port(&self.known.signals().i);
        self.applied.clear();
        self.model.put(port.leaf(), value.word())
    }

    /// Sets an input port to the bits of `word`, from this tick on, by its number from 0 in
    /// declaration order. Useful for recorded inputs.
    ///
    /// # Errors
    /// Returns an error if the word is wider than the port, or there is no such port.
    pub fn set_port(&mut self, port: usize, word: u64) -> Result<(), RunError> {
        let checked = self.model.ports().check_word(port, word);
        checked.map_err(RunError::at(self.tick()))?;
        self.applied.clear();
        self.model.drive(port, word);
        Ok(())
    }

    /// Sets all input ports, from this tick on.
    ///
    /// # Errors
    /// Returns an error if a value does not fit its port, or an array has another length; nothing
    /// is set then.
    #[inline]
    pub fn apply(&mut self, i: &C::In<Value>) -> Result<(), RunError> {
        self.words.clear();
        i.words(&mut self.words);
        // In most ticks of a run, no port changes.
        if !self.words.is_empty() && self.words == self.applied {
            return Ok(());
        }
        self.applied.clone_from(&self.words);
        let own = self.known.own_ports;
        let bits = self.model.ports().all_bits(own, &mut self.words);
        if let Err(error) = bits {
            self.applied.clear();
            return Err(RunError::at(self.tick())(error));
        }
        self.model.drive_all(&self.words);
        Ok(())
    }

    /// Sets the signals beside the circuit, from this tick on.
    ///
    /// # Errors
    /// Returns an error if a value does not fit its signal.
    pub fn show<B: Beside>(&mut self, beside: &B::Signals<Value>) -> Result<(), RunError> {
        let ports = self.known.own_ports;
        let mut numbers = (ports..).zip(pack::tokens(beside));
        numbers.try_for_each(|(port, number)| self.model.put(port, number))
    }

    /// Returns the value at a place in this tick, settled.
    #[inline]
    pub fn get<T: Number>(&mut self, at: At<T>) -> T {
        self.model.settle();
        read(self.engine(), at)
    }

    /// Returns the value of one of the [signals](Signals) in this tick, settled.
    #[inline]
    pub fn see<T: Number>(&mut self, signal: impl FnOnce(&Signals<C>) -> At<T>) -> T {
        let at = signal(self.known.signals());
        self.get(at)
    }

    /// Shows this tick, settled.
    #[inline]
    pub fn now<T>(&mut self, show: impl FnOnce(&Sample<'_, C>) -> T) -> T {
        self.model.settle();
        Sample::show(self.tick(), &self.known, self.engine(), show)
    }

    /// Shows the registers of this tick.
    #[inline]
    pub fn state<T>(&self, show: impl FnOnce(&State<'_, C>) -> T) -> T {
        State::show(&self.known, self.engine(), show)
    }

    /// Returns the registers of this tick.
    pub fn registers(&self) -> Registers<C> {
        all_registers(&self.known.circuit, self.engine())
    }

    /// Advances to the next tick.
    #[inline]
    pub fn step(&mut self) {
        self.model.settle();
        self.edge();
    }

    /// Advances to the next tick by a synchronous reset.
    ///
    /// After that edge every flip-flop has its power-on value. Memories and shift registers have
    /// no reset, like block RAM: they take the edge as usual, and a write in the tick of the reset
    /// takes effect.
    pub fn reset(&mut self) {
        self.model.settle();
        self.receive();
        self.model.reset_edge();
    }

    #[inline]
    fn edge(&mut self) {
        self.receive();
        self.model.edge();
    }

    /// Calls a function with every tick from this one on, settled, before its edge; also with the
    /// tick in which a panic drops the simulator. It takes the place of an earlier function.
    ///
    /// Unlike an [`Observer`](super::Observer) it sees the ticks of all ways to advance, one by
    /// one: runs do not jump over idle ticks. `trace::LastTicks` uses it.
    pub fn each_tick(&mut self, receive: impl FnMut(&Sample<'_, C>) + Send + Sync + 'static) {
        self.each = Some(Box::new(receive));
    }

    /// Passes this settled tick to the function that receives every tick.
    #[inline]
    fn receive(&mut self) {
        if self.each.is_some() {
            self.pass_on();
        }
    }

    #[cold]
    #[inline(never)]
    fn pass_on(&mut self) {
        if let Some(each) = &mut self.each {
            let (tick, engine) = (self.model.tick(), self.model.engine());
            Sample::show(tick, &self.known, engine, |now| each(now));
        }
    }

    /// Returns an iterator that steps and yields the result of `see` for each tick; input ports
    /// keep their values.
    ///
    /// ```
    /// use motion_rtl::circuits::blocks::EnableCounter;
    /// use motion_rtl::sim::Simulator;
    ///
    /// let mut counter = Simulator::new(&EnableCounter { width: 8 })?;
    /// counter.set(|i| i.period, 10)?;
    /// let enable = counter.signals().w.enable;
    /// let pulses = counter.samples(|now| now.get(enable)).take(1000).filter(|seen| *seen);
    /// assert_eq!(pulses.count(), 100);
    /// # Ok::<(), motion_rtl::sim::RunError>(())
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
    /// Returns an error if a value does not fit its port, as in [`apply`](Self::apply); the tick
    /// does not happen then.
    #[inline]
    pub fn step_with<T>(
        &mut self,
        i: &C::In<Value>,
        show: impl FnOnce(&Sample<'_, C>) -> T,
    ) -> Result<T, RunError> {
        self.step_with_reset(false, i, show)
    }

    /// Runs one tick with these inputs and shows its sample; if `rst` is high its edge is a
    /// [reset](Self::reset).
    ///
    /// # Errors
    /// Returns an error if a value does not fit its port, as in [`apply`](Self::apply); the tick
    /// does not happen then.
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
