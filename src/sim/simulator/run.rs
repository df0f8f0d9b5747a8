//! Runs of many ticks.

use super::Simulator;
use crate::engine::{Engine, InputChange, ReplayTick, Watch};
use crate::hdl::{Circuit, Value};
use crate::sim::{Observer, RunError, Sample, State};
use std::ops::ControlFlow;

/// Least number of ticks for which exchanging the engine pays.
const FAR: u64 = 4096;

impl<C: Circuit> Simulator<C> {
    /// Runs `ticks` ticks, or until an observer stops.
    ///
    /// `stimulus` returns the inputs of a tick, given its number and its registers.
    ///
    /// # Errors
    /// Returns an error if an input does not fit its port, or the first error of an observer; the
    /// run is over then.
    pub fn run(
        &mut self,
        ticks: u64,
        mut stimulus: impl FnMut(u64, &State<'_, C>) -> C::In<Value>,
        mut observer: impl Observer<C>,
    ) -> Result<(), RunError> {
        let end = self.tick().saturating_add(ticks);
        while self.tick() < end {
            let i = self.state(|q| stimulus(self.tick(), q));
            self.apply(&i)?;
            let flow = self.now(|now| observer.sample(now));
            self.edge();
            if flow?.is_break() {
                break;
            }
        }
        Ok(())
    }

    /// Runs like [`run`](Simulator::run), but shows only ticks in which something watched may have
    /// changed. In the ticks between, every watched signal is as in the tick shown last.
    ///
    /// `drive` is called before the next tick is settled. It [sets](Self::set) the input ports
    /// that change, and returns the number of ticks, this one included, for which all are held.
    ///
    /// # Errors
    /// Returns the first error of `drive` or of an observer; the run is over then.
    pub fn run_changes(
        &mut self,
        ticks: u64,
        drive: impl FnMut(&mut Self) -> Result<u64, RunError>,
        observer: impl Observer<C>,
    ) -> Result<(), RunError> {
        self.run_held(ticks, drive, observer, false)
    }

    /// Runs like [`run_changes`](Simulator::run_changes), but jumps over idle ticks.
    ///
    /// `observer` sees every tick in which an output port may have changed. It does not see every
    /// value of a counter: waves, stimulus files and monitors need [`run`](Simulator::run).
    ///
    /// A tick is idle if registers do nothing but count: each changes linearly, and no decision
    /// changes. Circuits need no support for this.
    ///
    /// # Errors
    /// Returns the first error of `drive` or of an observer; the run is over then.
    pub fn fast_forward(
        &mut self,
        ticks: u64,
        drive: impl FnMut(&mut Self) -> Result<u64, RunError>,
        observer: impl Observer<C>,
    ) -> Result<(), RunError> {
        self.run_held(ticks, drive, observer, true)
    }

    fn run_held(
        &mut self,
        ticks: u64,
        mut drive: impl FnMut(&mut Self) -> Result<u64, RunError>,
        mut observer: impl Observer<C>,
        jumps: bool,
    ) -> Result<(), RunError> {
        let end = self.tick().saturating_add(ticks);
        while self.tick() < end {
            let held = drive(self)?;
            // Input ports are constant until then.
            let until = self.tick().saturating_add(held.max(1)).min(end);
            loop {
                if self.now(|now| observer.sample(now))?.is_break() {
                    self.edge();
                    return Ok(());
                }
                if !self.go_to_change(until, jumps) {
                    break;
                }
            }
        }
        Ok(())
    }

    /// Replays `ticks` ticks with recorded changes of input ports, and shows the ticks in which one
    /// of the leaves in `shown` has changed. Compiled code reads the changes and finds these ticks,
    /// without a call in each tick. `now.changes()` returns each leaf by its index in `shown`.
    ///
    /// The first tick is shown with all leaves. After that, leaves hold their values from one
    /// shown tick to the next. A leaf that the circuit does not have is never shown. If a leaf is
    /// not [watched](Self::watching) or is a word of a memory, or if a function
    /// [receives each tick](Self::each_tick), the replay is slower: it goes tick by tick and
    /// compares all leaves.
    ///
    /// Changes are sorted by tick, and change a port at most once in a tick. Their ticks are those
    /// of the simulator. Changes before its current tick are left out, so that a replay can be cut
    /// into pieces with the same table.
    ///
    /// ```
    /// use motion_rtl::circuits::blocks::EnableCounter;
    /// use motion_rtl::sim::{InputChange, Simulator};
    ///
    /// let circuit = EnableCounter { width: 8 };
    /// let (mut counter, shown) = Simulator::watching(&circuit, false, |watch| watch.ports_out())?;
    /// let change = |tick, word| InputChange { tick, port: 0, word };
    /// let mut rises = Vec::new();
    /// counter.replay(100, &[change(0, 10), change(50, 25)], &shown, |now| {
    ///     rises.extend(now.changes().filter(|(_, word)| *word == 1).map(|_| now.tick));
    /// })?;
    /// assert_eq!(rises, [9, 19, 29, 39, 49, 74, 99]);
    /// # Ok::<(), motion_rtl::sim::RunError>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if a change is not in order, has no port, does not fit it, or is the second
    /// of its port in a tick. No tick happens then.
    pub fn replay(
        &mut self,
        ticks: u64,
        changes: &[InputChange],
        shown: &[usize],
        see: impl FnMut(ReplayTick<'_>),
    ) -> Result<(), RunError> {
        self.replay_of(ticks, changes, shown, false, see)
    }

    /// Replays like [`replay`](Self::replay), but jumps over idle ticks, as
    /// [`fast_forward`](Self::fast_forward) does. Every change of an output port and of a leaf that
    /// was [watched](super::Watcher::at) by its place is shown. Of other leaves, values within idle
    /// ticks are left out.
    ///
    /// ```
    /// use motion_rtl::circuits::blocks::EnableCounter;
    /// use motion_rtl::sim::{InputChange, Simulator};
    ///
    /// let circuit = EnableCounter { width: 48 };
    /// let (mut counter, shown) = Simulator::watching(&circuit, false, |watch| watch.ports_out())?;
    /// let change = InputChange { tick: 0, port: 0, word: 1 << 40 };
    /// let mut ticks = Vec::new();
    /// counter.fast_replay(1 << 41, &[change], &shown, |now| ticks.push(now.tick))?;
    /// assert_eq!(ticks, [0, (1 << 40) - 1, 1 << 40, (1 << 41) - 1]);
    /// # Ok::<(), motion_rtl::sim::RunError>(())
    /// ```
    ///
    /// # Errors
    /// Returns the errors of [`replay`](Self::replay).
    pub fn fast_replay(
        &mut self,
        ticks: u64,
        changes: &[InputChange],
        shown: &[usize],
        see: impl FnMut(ReplayTick<'_>),
    ) -> Result<(), RunError> {
        self.replay_of(ticks, changes, shown, true, see)
    }

    fn replay_of(
        &mut self,
        ticks: u64,
        changes: &[InputChange],
        shown: &[usize],
        jumps: bool,
        see: impl FnMut(ReplayTick<'_>),
    ) -> Result<(), RunError> {
        let Simulator {
            model,
            known,
            each,
            applied,
            ..
        } = self;
        let checked = model.ports().check_changes(changes);
        checked.map_err(|(tick, error)| RunError::at(tick)(error))?;
        applied.clear();
        match each {
            None => model.replay_leaves(ticks, changes, shown, jumps, None, see),
            Some(each) => {
                let mut receive = |tick: u64, engine: &Engine| {
                    Sample::show(tick, known, engine, |now| each(now));
                };
                model.replay_leaves(ticks, changes, shown, jumps, Some(&mut receive), see);
            }
        }
        Ok(())
    }

    /// Advances to the next tick in which something watched has changed; see
    /// [`Model::go_to_change`](crate::sim::Model::go_to_change).
    fn go_to_change(&mut self, until: u64, jumps: bool) -> bool {
        let Simulator {
            model, known, each, ..
        } = self;
        match each {
            None => model.go_to_change(until, jumps, None),
            Some(each) => {
                let mut receive = |tick: u64, engine: &Engine| {
                    Sample::show(tick, known, engine, |now| each(now));
                };
                model.go_to_change(until, jumps, Some(&mut receive))
            }
        }
    }

    /// Shows the sample of the next tick; `observer` sees it too if it [needs](Observer::looks)
    /// it. [`go_on`](Self::go_on) continues from there. Also returns the observer's decision to
    /// continue or stop.
    ///
    /// # Errors
    /// Returns an error if a value does not fit its port, or the error of `observer`.
    #[inline]
    pub fn look<T>(
        &mut self,
        i: &C::In<Value>,
        observer: impl Observer<C>,
        show: impl FnOnce(&Sample<'_, C>) -> T,
    ) -> Result<(T, ControlFlow<()>), RunError> {
        self.apply(i)?;
        self.look_as_set(observer, show)
    }

    /// [Looks](Self::look) at the next tick with the input ports as [set](Self::set).
    ///
    /// # Errors
    /// Returns the error of `observer`.
    #[inline]
    pub fn look_as_set<T>(
        &mut self,
        mut observer: impl Observer<C>,
        show: impl FnOnce(&Sample<'_, C>) -> T,
    ) -> Result<(T, ControlFlow<()>), RunError> {
        let (shown, flow) = self.now(|now| {
            let shown = show(now);
            let flow = match observer.looks(now.tick) {
                true => observer.sample(now),
                false => Ok(ControlFlow::Continue(())),
            };
            (shown, flow)
        });
        Ok((shown, flow?))
    }

    /// [Looks](Self::look) at the next tick and advances by it.
    ///
    /// # Errors
    /// Returns the errors of [`look`](Self::look).
    pub fn step_watched<T>(
        &mut self,
        i: &C::In<Value>,
        observer: impl Observer<C>,
        show: impl FnOnce(&Sample<'_, C>) -> T,
    ) -> Result<(T, ControlFlow<()>), RunError> {
        let looked = self.look(i, observer, show)?;
        self.go_on(1);
        Ok(looked)
    }

    /// Returns the number of ticks up to the next that an observer needs, including the one
    /// [looked](Self::look) at.
    pub fn unseen(&self, observer: &impl Observer<C>) -> u64 {
        observer.next_look(self.tick() + 1) - self.tick()
    }

    /// Watches what `observer` reads from this tick on: all signals if it reads
    /// [all of this tick](Observer::next_whole), and only those that it needs in every tick if it
    /// reads all much later or never. The circuit then runs faster. Has no effect if the simulator
    /// was not made to watch all signals.
    ///
    /// Call it before each [look](Self::look), with the observer of the run:
    ///
    /// ```
    /// use motion_rtl::circuits::blocks::EnableCounter;
    /// use motion_rtl::sim::{Observer, Simulator};
    /// use motion_rtl::trace::{Clock, Options, Vcd};
    ///
    /// let circuit = EnableCounter { width: 16 };
    /// let options = Options { ticks: 20_000..20_100, only: None };
    /// let mut vcd = Vcd::new(Vec::new(), &circuit, Clock::default(), &options)?;
    /// let needs = Observer::<EnableCounter>::needs(&vcd);
    /// let (mut counter, ()) = Simulator::watching(&circuit, needs, |_| ())?;
    /// counter.set(|i| i.period, 500)?;
    /// while counter.tick() < 30_000 {
    ///     counter.watch_for(&vcd);
    ///     let in_window = (20_000..20_100).contains(&counter.tick());
    ///     assert_eq!(counter.watches_all(), in_window);
    ///     let _ = counter.look_as_set(&mut vcd, |_| ())?;
    ///     counter.go_on(counter.unseen(&vcd).min(30_000 - counter.tick()));
    /// }
    /// # vcd.finish()?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline]
    pub fn watch_for(&mut self, observer: &impl Observer<C>) {
        if self.always.is_some() {
            let tick = self.tick();
            let until = observer.next_whole(tick).saturating_sub(tick);
            match self.watches_all() {
                true if until >= FAR => self.exchange(),
                false if until == 0 => self.exchange(),
                _ => {}
            }
        }
    }

    /// True if all signals are watched in this tick.
    pub fn watches_all(&self) -> bool {
        self.engine().program().watches_all()
    }

    /// Exchanges the engine that watches all signals for the one that watches few, or back.
    #[cold]
    fn exchange(&mut self) {
        let Some(always) = &self.always else {
            return;
        };
        let watch = match self.watches_all() {
            true => Watch::Leaves(always),
            false => Watch::All,
        };
        let program = || self.model.elaborated().program_with(watch, always);
        let other = self.other.take();
        let mut other = other.unwrap_or_else(|| Box::new(Engine::new(program())));
        if self.engine().is_interpreted() {
            other.interpret();
        }
        self.other = Some(Box::new(self.model.exchange(*other)));
    }

    /// Advances from a tick that was [looked](Self::look) at, by 1 to `ticks` ticks with constant
    /// input ports: to the first in which an output port or a [watched](Self::watching) signal may
    /// have changed. Returns the number of ticks.
    pub fn go_on(&mut self, ticks: u64) -> u64 {
        let start = self.tick();
        self.go_to_change(start.saturating_add(ticks.max(1)), true);
        self.tick() - start
    }
}
