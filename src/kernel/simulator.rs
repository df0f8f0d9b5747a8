use super::probe::Probe;
use super::sample::{At, Part, Place, Word};
use super::{Circuit, Field, Model, Observer, Role, RunError, Sample, Shape, Signals, part};
use crate::engine::{Engine, EngineError, Ports, Watch};
use crate::logic::Sim;
use crate::logic::netlist::{Netlist, places};
use std::cell::RefCell;
use std::marker::PhantomData;
use std::ops::ControlFlow;

/// The registers of a circuit between two ticks.
pub type Registers<'a, C> = Part<'a, <C as Circuit>::Reg<Sim>>;

/// A circuit that is clocked tick by tick.
///
/// At tick n inputs are applied, nets settle, everything is sampled; then the edge makes the
/// registers of tick n + 1. So a register shows at n + 1 what was decided at n.
#[derive(Debug)]
pub struct Simulator<C: Circuit> {
    engine: Engine,
    tick: u64,
    circuit: PhantomData<fn(&C)>,
}

/// Two runs that go on from the same tick, each with inputs of its own.
// Written out because a derive would ask the circuit itself to be `Clone`.
impl<C: Circuit> Clone for Simulator<C> {
    fn clone(&self) -> Self {
        Simulator::of(self.engine.clone(), self.tick)
    }
}

/// Chooses what is watched; see [`Simulator::watching`].
pub struct Watcher<C: Circuit> {
    /// The ports in.
    pub i: C::In<Netlist>,
    /// The registers.
    pub q: C::Reg<Netlist>,
    /// The nets.
    pub w: C::Net<Netlist>,
    watched: RefCell<Vec<usize>>,
}

impl<C: Circuit> Watcher<C> {
    /// A wire or word of the records is watched.
    pub fn at<P: Place>(&self, place: P) -> At<P::Word> {
        let leaf = place.leaf();
        self.watched.borrow_mut().push(leaf);
        At::new(leaf, P::WIDTH)
    }
}

impl<C: Circuit> Simulator<C> {
    /// The circuit at power-on, before tick 0.
    ///
    /// # Errors
    /// The circuit is no netlist.
    pub fn new(circuit: &C) -> Result<Self, EngineError> {
        let model = Model::of(circuit)?;
        Ok(Simulator::of(model.engine(Watch::All), 0))
    }

    /// The same where only some signals are looked at, which takes less time: what `choose` gives
    /// of the places that it watches comes with it. With `all` every signal is watched besides. What
    /// is not watched can be seen all the same, at the cost of all nets.
    ///
    /// ```
    /// use motion_rtl::kernel::Simulator;
    /// use motion_rtl::pulse_interpolator::{UnitTimeCounter, unit_time_counter::In};
    ///
    /// let circuit = UnitTimeCounter::<8>;
    /// let watched = Simulator::watching(&circuit, false, |watch| watch.at(watch.w.unit_rst));
    /// let (mut simulator, unit_rst) = watched?;
    /// let mut pulses = 0;
    /// for _ in 0..100 {
    ///     let (next, pulse) = simulator.step(In { period: 4.into() }, |now| now.get(unit_rst));
    ///     simulator = next;
    ///     pulses += u32::from(pulse);
    /// }
    /// assert_eq!(pulses, 25);
    /// # Ok::<(), motion_rtl::engine::EngineError>(())
    /// ```
    ///
    /// # Errors
    /// The circuit is no netlist.
    pub fn watching<T>(
        circuit: &C,
        all: bool,
        choose: impl FnOnce(&Watcher<C>) -> T,
    ) -> Result<(Self, T), EngineError> {
        let (i, q, w) = places::<C>();
        let watcher = Watcher {
            i,
            q,
            w,
            watched: RefCell::default(),
        };
        let chosen = choose(&watcher);
        let model = Model::of(circuit)?;
        let watched = watcher.watched.into_inner();
        let watch = match all {
            true => Watch::All,
            false => Watch::Leaves(&watched),
        };
        let engine = Engine::new(model.program_with(watch, &watched));
        Ok((Simulator::of(engine, 0), chosen))
    }

    fn of(engine: Engine, tick: u64) -> Self {
        Simulator {
            engine,
            tick,
            circuit: PhantomData,
        }
    }

    /// It compiled now, instead of when that pays; without the feature `jit`, and where there is no
    /// compiler for the machine, as it was.
    #[must_use]
    pub fn compiled(mut self) -> Self {
        self.engine.compile();
        self
    }

    /// It on the interpreter, however long it runs.
    #[must_use]
    pub fn interpreted(mut self) -> Self {
        self.engine.interpret();
        self
    }

    /// The registers of the tick to come.
    pub fn registers(&self) -> Registers<'_, C> {
        Part::new(Role::Register, &self.engine)
    }

    /// A register of the tick to come.
    #[inline]
    pub fn get<T: Word>(&self, at: At<T>) -> T {
        at.of(&self.engine)
    }

    /// The tick to come.
    pub fn tick(&self) -> u64 {
        self.tick
    }

    /// What runs.
    pub fn engine(&self) -> &Engine {
        &self.engine
    }

    fn apply(&mut self, i: &C::In<Sim>) {
        i.visit(part(Role::Input), &mut Apply(self.engine.ports()));
    }

    /// Runs `ticks` ticks, or until an observer stops.
    ///
    /// `stimulus` gives the inputs of a tick from its number and its registers.
    ///
    /// # Errors
    /// The first error of an observer; the run is over then.
    pub fn run(
        mut self,
        ticks: u64,
        mut stimulus: impl FnMut(u64, &Registers<'_, C>) -> C::In<Sim>,
        mut observer: impl Observer<C>,
    ) -> Result<Self, RunError> {
        let end = self.tick.saturating_add(ticks);
        while self.tick < end {
            let i = stimulus(self.tick, &self.registers());
            self.apply(&i);
            self.engine.settle();
            let flow = Sample::show(self.tick, &self.engine, |now| observer.sample(now));
            self.edge();
            if flow?.is_break() {
                break;
            }
        }
        Ok(self)
    }

    fn edge(&mut self) {
        self.engine.edge();
        self.tick += 1;
    }

    /// Runs like [`run`](Simulator::run), but shows only ticks in which something watched may have
    /// changed: in those between, everything that is watched is as in the tick shown last.
    ///
    /// `stimulus` gives the inputs of a tick, and for how many ticks, this one included, it gives
    /// the same.
    ///
    /// # Errors
    /// The first error of an observer; the run is over then.
    pub fn run_changes(
        self,
        ticks: u64,
        stimulus: impl FnMut(u64, &Registers<'_, C>) -> (C::In<Sim>, u64),
        observer: impl Observer<C>,
    ) -> Result<Self, RunError> {
        self.run_held(ticks, stimulus, observer, false)
    }

    /// Runs like [`run`](Simulator::run), but goes over idle ticks in one.
    ///
    /// `stimulus` gives the inputs of a tick, and for how many ticks, this one included, it gives
    /// the same. `observer` sees every tick in which a port out may have changed. It does not see
    /// every value of a counter: waves, stimulus files and monitors are for
    /// [`run`](Simulator::run).
    ///
    /// Idle are ticks in which registers do nothing but count: everything is on straight lines, and
    /// no decision comes out otherwise than before. No circuit needs to know of it.
    ///
    /// ```
    /// use motion_rtl::kernel::{RunError, Sample, Simulator, StopWhen, zero};
    /// use motion_rtl::pulse_interpolator::{Group, Pattern, Variant};
    ///
    /// # fn main() -> Result<(), RunError> {
    /// // A second at 10 MHz: a pulse a millisecond, unit times of a tenth of a second.
    /// let pattern = Pattern { base: 0, last: 0, cyclic: true, period: 1_000_000 };
    /// let mut group = Group::<1>::free_running(Variant::Safe, pattern);
    /// group.axes[0].memory.half_periods.set(0, 5_000);
    ///
    /// let (mut ticks, mut pulses, mut before) = (0, 0, false);
    /// let count = StopWhen(|now: &Sample<'_, Group<1>>| {
    ///     ticks += 1;
    ///     pulses += u32::from(now.w.step[0].get() && !before);
    ///     before = now.w.step[0].get();
    ///     false
    /// });
    /// Simulator::new(&group)?.fast_forward(10_000_000, |_, _| (zero(), u64::MAX), count)?;
    /// assert_eq!(pulses, 900);
    /// assert!(ticks < 20_000);
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// The first error of an observer; the run is over then.
    pub fn fast_forward(
        self,
        ticks: u64,
        stimulus: impl FnMut(u64, &Registers<'_, C>) -> (C::In<Sim>, u64),
        observer: impl Observer<C>,
    ) -> Result<Self, RunError> {
        self.run_held(ticks, stimulus, observer, true)
    }

    fn run_held(
        mut self,
        ticks: u64,
        mut stimulus: impl FnMut(u64, &Registers<'_, C>) -> (C::In<Sim>, u64),
        mut observer: impl Observer<C>,
        jumps: bool,
    ) -> Result<Self, RunError> {
        let end = self.tick.saturating_add(ticks);
        while self.tick < end {
            let (i, held) = stimulus(self.tick, &self.registers());
            self.apply(&i);
            self.engine.settle();
            // Until then ports in are as they are.
            let until = self.tick.saturating_add(held.max(1)).min(end);
            loop {
                let flow = Sample::show(self.tick, &self.engine, |now| observer.sample(now));
                if flow?.is_break() {
                    self.edge();
                    return Ok(self);
                }
                if !self.go_to_change(until, jumps) {
                    break;
                }
            }
        }
        Ok(self)
    }

    /// Goes on to a tick in which something watched has changed; whether there is one before
    /// `until`, at which the registers are there and nothing is settled.
    fn go_to_change(&mut self, until: u64, jumps: bool) -> bool {
        loop {
            let left = until - self.tick;
            if jumps {
                let gone = self.engine.forward(left);
                self.tick += gone;
                if gone > 0 {
                    if gone == left {
                        return false;
                    }
                    self.engine.settle();
                    return true;
                }
            }
            if left == 1 {
                self.edge();
                return false;
            }
            let most = if jumps { self.engine.pause() } else { u64::MAX };
            self.tick += self.engine.advance(most.min(left - 1));
            if self.engine.has_changed() {
                return true;
            }
        }
    }

    /// Runs one tick and shows its sample.
    pub fn step<T>(self, i: C::In<Sim>, show: impl FnOnce(&Sample<'_, C>) -> T) -> (Self, T) {
        self.step_with_reset(false, i, show)
    }

    /// Shows the sample of the tick to come, which `observer` sees too if it
    /// [looks](Observer::looks) at it; [`go_on`](Self::go_on) goes on from there. Also gives whether
    /// the observer goes on.
    ///
    /// Nothing is moved: where ports in are many and few of them change, this takes less time than
    /// [`step`](Self::step).
    ///
    /// # Errors
    /// What `observer` objects to.
    pub fn look<T>(
        &mut self,
        i: &C::In<Sim>,
        mut observer: impl Observer<C>,
        show: impl FnOnce(&Sample<'_, C>) -> T,
    ) -> Result<(T, ControlFlow<()>), RunError> {
        self.apply(i);
        self.engine.settle();
        let (shown, flow) = Sample::show(self.tick, &self.engine, |now| {
            let shown = show(now);
            let flow = match observer.looks(now.tick) {
                true => observer.sample(now),
                false => Ok(ControlFlow::Continue(())),
            };
            (shown, flow)
        });
        Ok((shown, flow?))
    }

    /// [Looks](Self::look) at the tick to come and goes on by it.
    ///
    /// # Errors
    /// What `observer` objects to.
    pub fn step_watched<T>(
        &mut self,
        i: &C::In<Sim>,
        observer: impl Observer<C>,
        show: impl FnOnce(&Sample<'_, C>) -> T,
    ) -> Result<(T, ControlFlow<()>), RunError> {
        let looked = self.look(i, observer, show)?;
        self.go_on(1);
        Ok(looked)
    }

    /// How many ticks there are up to the next at which an observer looks, the one that was
    /// [looked](Self::look) at among them.
    pub fn unseen(&self, observer: &impl Observer<C>) -> u64 {
        observer.next_look(self.tick + 1) - self.tick
    }

    /// Goes on from a tick that was [looked](Self::look) at, by up to so many ticks and at least one,
    /// ports in as they are: to the first in which a port out or what is
    /// [watched](Self::watching) may have changed. Returns how many it has gone.
    pub fn go_on(&mut self, ticks: u64) -> u64 {
        let start = self.tick;
        self.go_to_change(start.saturating_add(ticks.max(1)), true);
        self.tick - start
    }

    /// Runs one tick and shows its sample; with `rst` high its edge is that of a synchronous
    /// reset.
    ///
    /// After such an edge every flip-flop has its power-on value. Memories and shift registers
    /// have no reset, as block RAM has none: they take the edge as always, and what is written in
    /// the tick of reset is written.
    pub fn step_with_reset<T>(
        mut self,
        rst: bool,
        i: C::In<Sim>,
        show: impl FnOnce(&Sample<'_, C>) -> T,
    ) -> (Self, T) {
        self.apply(&i);
        self.engine.settle();
        let shown = Sample::show(self.tick, &self.engine, show);
        match rst {
            true => self.engine.reset(),
            false => self.engine.edge(),
        }
        self.tick += 1;
        (self, shown)
    }
}

/// Applies ports in, one after the other.
struct Apply<'a>(Ports<'a>);

impl Probe for Apply<'_> {
    #[inline(always)]
    fn leaf(&mut self, _: &'static Field, _: Shape, bits: u64) {
        self.0.give(bits);
    }
}
