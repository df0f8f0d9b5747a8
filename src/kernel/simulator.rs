use super::reset::reset;
use super::{Circuit, Observer, RunError, Sample};
use crate::logic::Sim;
use std::ops::ControlFlow;

/// A circuit in the meaning [`Sim`], clocked tick by tick.
///
/// At tick n inputs are applied, nets settle, everything is sampled; then the edge makes the
/// registers of tick n + 1. So a register shows at n + 1 what was decided at n.
#[derive(Debug)]
pub struct Simulator<'c, C: Circuit> {
    circuit: &'c C,
    q: C::Reg<Sim>,
    tick: u64,
}

/// Two runs that go on from the same tick, each with inputs of its own.
// Written out because a derive would ask the circuit itself to be `Clone`.
impl<C: Circuit> Clone for Simulator<'_, C> {
    fn clone(&self) -> Self {
        Simulator {
            circuit: self.circuit,
            q: self.q.clone(),
            tick: self.tick,
        }
    }
}

impl<'c, C: Circuit> Simulator<'c, C> {
    /// The circuit at power-on, before tick 0.
    pub fn new(circuit: &'c C) -> Self {
        Simulator {
            q: circuit.power_on(),
            circuit,
            tick: 0,
        }
    }

    /// The registers of the tick to come.
    pub fn registers(&self) -> &C::Reg<Sim> {
        &self.q
    }

    /// The tick to come.
    pub fn tick(&self) -> u64 {
        self.tick
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
        mut stimulus: impl FnMut(u64, &C::Reg<Sim>) -> C::In<Sim>,
        mut observer: impl Observer<C>,
    ) -> Result<Self, RunError> {
        let end = self.tick.saturating_add(ticks);
        while self.tick < end {
            let i = stimulus(self.tick, &self.q);
            let (next, flow) = self.step(i, |now| observer.sample(now));
            self = next;
            if flow?.is_break() {
                break;
            }
        }
        Ok(self)
    }

    /// Runs like [`run`](Simulator::run), but goes over idle ticks.
    ///
    /// `stimulus` gives the inputs of a tick, and for how many ticks, this one included, it would
    /// give the same if they were idle. `observer` sees every tick that is not idle and the one
    /// after it, so every change of a port out in its tick. It does not see every value of a
    /// counter: waves, stimulus files and monitors are for [`run`](Simulator::run).
    ///
    /// ```
    /// use motion_rtl::kernel::{RunError, Sample, Simulator, StopWhen, zero};
    /// use motion_rtl::pulse_interpolator::{Group, Pattern, Variant};
    ///
    /// # fn main() -> Result<(), RunError> {
    /// // A tenth of a second at 10 MHz: a pulse a millisecond, unit times of 10 ms.
    /// let pattern = Pattern { base: 0, last: 0, cyclic: true, period: 100_000 };
    /// let mut group = Group::<1>::free_running(Variant::Safe, pattern);
    /// group.axes[0].memory.half_periods.set(0, 5_000);
    ///
    /// let (mut pulses, mut before) = (0, false);
    /// let count = StopWhen(|now: &Sample<'_, Group<1>>| {
    ///     pulses += u32::from(now.w.step[0].get() && !before);
    ///     before = now.w.step[0].get();
    ///     false
    /// });
    /// let quiet = |_, _: &_| (zero(), u64::MAX);
    /// Simulator::new(&group).fast_forward(1_000_000, quiet, count)?;
    /// assert_eq!(pulses, 90);
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// The first error of an observer; the run is over then.
    pub fn fast_forward(
        self,
        ticks: u64,
        mut stimulus: impl FnMut(u64, &C::Reg<Sim>) -> (C::In<Sim>, u64),
        observer: impl Observer<C>,
    ) -> Result<Self, RunError> {
        self.run(ticks, |tick, q| stimulus(tick, q).0, observer)
    }

    /// Runs one tick and shows its sample.
    pub fn step<T>(self, i: C::In<Sim>, show: impl FnOnce(&Sample<'_, C>) -> T) -> (Self, T) {
        self.step_with_reset(false, i, show)
    }

    /// Runs one tick and shows its sample, which `observer` sees too if it
    /// [looks](Observer::looks) at the tick. Also gives whether the observer goes on.
    ///
    /// # Errors
    /// What `observer` objects to.
    pub fn step_watched<T>(
        self,
        i: C::In<Sim>,
        mut observer: impl Observer<C>,
        show: impl FnOnce(&Sample<'_, C>) -> T,
    ) -> Result<(Self, T, ControlFlow<()>), RunError> {
        let (next, (shown, flow)) = self.step(i, |now| {
            let shown = show(now);
            let flow = match observer.looks(now.tick) {
                true => observer.sample(now),
                false => Ok(ControlFlow::Continue(())),
            };
            (shown, flow)
        });
        Ok((next, shown, flow?))
    }

    /// Runs one tick and shows its sample; with `rst` high its edge is that of a synchronous
    /// reset.
    ///
    /// After such an edge every flip-flop has its power-on value. Memories and shift registers
    /// have no reset, as block RAM has none: they take the edge as always, and what is written in
    /// the tick of reset is written.
    pub fn step_with_reset<T>(
        self,
        rst: bool,
        i: C::In<Sim>,
        show: impl FnOnce(&Sample<'_, C>) -> T,
    ) -> (Self, T) {
        let Simulator { circuit, q, tick } = self;
        let w = circuit.comb(&q, &i);
        let shown = show(&Sample {
            tick,
            i: &i,
            q: &q,
            w: &w,
        });
        let mut q = circuit.next(q, &w, &i);
        if rst {
            q = reset(circuit, &q);
        }
        let tick = tick + 1;
        (Simulator { circuit, q, tick }, shown)
    }
}
