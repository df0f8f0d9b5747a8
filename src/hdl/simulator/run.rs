//! Runs of many ticks.

use super::Simulator;
use crate::hdl::{Circuit, Observer, RunError, Sample, State, Value};
use std::ops::ControlFlow;

impl<C: Circuit> Simulator<C> {
    /// Runs `ticks` ticks, or until an observer stops.
    ///
    /// `stimulus` gives the inputs of a tick from its number and its registers.
    ///
    /// # Errors
    /// An input that does not fit its port, or the first error of an observer; the run is over
    /// then.
    pub fn run(
        &mut self,
        ticks: u64,
        mut stimulus: impl FnMut(u64, &State<'_, C>) -> C::In<Value>,
        mut observer: impl Observer<C>,
    ) -> Result<(), RunError> {
        let end = self.tick.saturating_add(ticks);
        while self.tick < end {
            let i = self.state(|q| stimulus(self.tick, q));
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
    /// changed: in those between, everything that is watched is as in the tick shown last.
    ///
    /// `drive` is asked at the tick to come, before it is settled: it [sets](Self::set) ports in
    /// that change, and says for how many ticks, this one included, they are held.
    ///
    /// # Errors
    /// The first error of `drive` or of an observer; the run is over then.
    pub fn run_changes(
        &mut self,
        ticks: u64,
        drive: impl FnMut(&mut Self) -> Result<u64, RunError>,
        observer: impl Observer<C>,
    ) -> Result<(), RunError> {
        self.run_held(ticks, drive, observer, false)
    }

    /// Runs like [`run_changes`](Simulator::run_changes), but goes over idle ticks in one.
    ///
    /// `observer` sees every tick in which a port out may have changed. It does not see every value
    /// of a counter: waves, stimulus files and monitors are for [`run`](Simulator::run).
    ///
    /// Idle are ticks in which registers do nothing but count: everything is on straight lines, and
    /// no decision comes out otherwise than before. No circuit needs to know of it.
    ///
    /// # Errors
    /// The first error of `drive` or of an observer; the run is over then.
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
        let end = self.tick.saturating_add(ticks);
        while self.tick < end {
            let held = drive(self)?;
            // Until then ports in are as they are.
            let until = self.tick.saturating_add(held.max(1)).min(end);
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

    /// Goes on to a tick in which something watched has changed; whether there is one before
    /// `until`, at which the registers are there and nothing is settled.
    fn go_to_change(&mut self, until: u64, jumps: bool) -> bool {
        self.settle();
        loop {
            let left = until - self.tick;
            if jumps {
                let gone = self.engine.forward(left);
                self.tick += gone;
                if gone > 0 {
                    self.settled = false;
                    if gone == left {
                        return false;
                    }
                    self.settle();
                    return true;
                }
            }
            if left == 1 {
                self.edge();
                return false;
            }
            let most = if jumps { self.engine.pause() } else { u64::MAX };
            // Ends settled.
            self.tick += self.engine.advance(most.min(left - 1));
            if self.engine.has_changed() {
                return true;
            }
        }
    }

    /// Shows the sample of the tick to come, which `observer` sees too if it
    /// [looks](Observer::looks) at it; [`go_on`](Self::go_on) goes on from there. Also gives whether
    /// the observer goes on.
    ///
    /// # Errors
    /// A value does not fit its port, or `observer` objects.
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

    /// [Looks](Self::look) with the ports in as they are [set](Self::set).
    ///
    /// # Errors
    /// What `observer` objects to.
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

    /// [Looks](Self::look) at the tick to come and goes on by it.
    ///
    /// # Errors
    /// Errors of [`look`](Self::look).
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
}
