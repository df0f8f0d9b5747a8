use super::ports::Ports;
use super::reset::reset;
use super::{Circuit, FastForward, Observer, RunError, Sample};
use crate::logic::{Logic, Sim};
use std::mem::ManuallyDrop;
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
    /// `stimulus` gives the inputs of a tick from its number and its registers. The state moves
    /// through the call so that the compiler can hold it in machine registers; with `()` as
    /// observer nothing but the circuit is executed.
    ///
    /// # Errors
    /// The first error of an observer; the run is over then.
    pub fn run(
        self,
        ticks: u64,
        stimulus: impl FnMut(u64, &C::Reg<Sim>) -> C::In<Sim>,
        observer: impl Observer<C>,
    ) -> Result<Self, RunError> {
        let Simulator { circuit, q, tick } = self;
        let ran = match observer.coasts() {
            true => Self::watch_on(circuit, q, tick, ticks, stimulus, observer),
            false => Self::run_on(circuit, q, tick, ticks, stimulus, observer),
        };
        match ran {
            (simulator, None) => Ok(simulator),
            (_, Some(error)) => Err(error),
        }
    }

    /// A function of its own: where registers are dropped they stand in memory all the time. What is
    /// behind a reference among its arguments nobody else writes, so what `circuit` holds is read
    /// before the first tick.
    #[inline(never)]
    fn run_on(
        circuit: &'c C,
        q: C::Reg<Sim>,
        start: u64,
        ticks: u64,
        mut stimulus: impl FnMut(u64, &C::Reg<Sim>) -> C::In<Sim>,
        mut observer: impl Observer<C>,
    ) -> (Self, Option<RunError>) {
        // So they are where a panic unwinds.
        let mut q = ManuallyDrop::new(q);
        let mut tick = start;
        let end = start.saturating_add(ticks);
        let mut failed = None;
        while tick < end {
            let i = stimulus(tick, &q);
            let w = circuit.comb(&q, &i);
            let flow = observer.sample(&Sample {
                tick,
                coasting: false,
                i: &i,
                q: &q,
                w: &w,
            });
            let flow = match flow {
                Ok(flow) => flow,
                Err(error) => {
                    failed = Some(error);
                    break;
                }
            };
            q = ManuallyDrop::new(Sim::clock(circuit, ManuallyDrop::into_inner(q), &w, &i));
            tick += 1;
            if let ControlFlow::Break(()) = flow {
                break;
            }
        }
        let q = ManuallyDrop::into_inner(q);
        (Simulator { circuit, q, tick }, failed)
    }

    /// As [`run_on`](Self::run_on), for an observer that looks at less where the circuit coasts. It
    /// has nets of its own there: those that nobody looks at are not computed.
    #[inline(never)]
    fn watch_on(
        circuit: &'c C,
        q: C::Reg<Sim>,
        start: u64,
        ticks: u64,
        mut stimulus: impl FnMut(u64, &C::Reg<Sim>) -> C::In<Sim>,
        mut observer: impl Observer<C>,
    ) -> (Self, Option<RunError>) {
        let mut q = ManuallyDrop::new(q);
        let mut tick = start;
        let end = start.saturating_add(ticks);
        let mut failed = None;
        // For how many ticks from this one on it coasts, and did with the edge before, under which
        // ports in.
        let mut still = 0;
        let mut ports = Ports::new::<C>();
        while tick < end {
            let i = stimulus(tick, &q);
            let coasting = still > 0 && ports.are(&i) && observer.follows(tick);
            let flow = if coasting {
                still -= 1;
                let w = circuit.comb(&q, &i);
                let flow = observer.sample(&Sample {
                    tick,
                    coasting,
                    i: &i,
                    q: &q,
                    w: &w,
                });
                q = ManuallyDrop::new(circuit.coasted(ManuallyDrop::into_inner(q), 1));
                flow
            } else {
                let w = circuit.comb(&q, &i);
                let flow = observer.sample(&Sample {
                    tick,
                    coasting,
                    i: &i,
                    q: &q,
                    w: &w,
                });
                still = circuit.coasts_for(&q, &w, &i).saturating_sub(1);
                if still > 0 {
                    ports.keep(&i);
                }
                q = ManuallyDrop::new(Sim::clock(circuit, ManuallyDrop::into_inner(q), &w, &i));
                flow
            };
            tick += 1;
            match flow {
                Ok(ControlFlow::Continue(())) => {}
                Ok(ControlFlow::Break(())) => break,
                Err(error) => {
                    failed = Some(error);
                    break;
                }
            }
        }
        let q = ManuallyDrop::into_inner(q);
        (Simulator { circuit, q, tick }, failed)
    }

    /// Runs like [`run`](Simulator::run), but goes over idle ticks in one.
    ///
    /// `stimulus` gives the inputs of a tick, and for how many ticks, this one included, it would
    /// give the same if they were idle. `observer` sees every tick that is not idle and the one
    /// after it, so every change of a port out in its tick. It does not see every value of a
    /// counter.
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
    /// let quiet = |_, _: &_| (zero(), u64::MAX);
    /// Simulator::new(&group).fast_forward(10_000_000, quiet, count)?;
    /// assert_eq!(pulses, 900);
    /// assert!(ticks < 5000);
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// The first error of an observer; the run is over then.
    pub fn fast_forward(
        self,
        ticks: u64,
        stimulus: impl FnMut(u64, &C::Reg<Sim>) -> (C::In<Sim>, u64),
        observer: impl Observer<C>,
    ) -> Result<Self, RunError>
    where
        C: FastForward,
    {
        match Self::forward_on(self.circuit, self.q, self.tick, ticks, stimulus, observer) {
            (simulator, None) => Ok(simulator),
            (_, Some(error)) => Err(error),
        }
    }

    /// A function of its own, with registers that are not dropped, as [`run_on`](Self::run_on).
    #[inline(never)]
    fn forward_on(
        circuit: &'c C,
        q: C::Reg<Sim>,
        start: u64,
        ticks: u64,
        mut stimulus: impl FnMut(u64, &C::Reg<Sim>) -> (C::In<Sim>, u64),
        mut observer: impl Observer<C>,
    ) -> (Self, Option<RunError>)
    where
        C: FastForward,
    {
        let mut q = ManuallyDrop::new(q);
        let mut tick = start;
        let end = start.saturating_add(ticks);
        let mut failed = None;
        while tick < end {
            let (i, held) = stimulus(tick, &q);
            let w = circuit.comb(&q, &i);
            let flow = observer.sample(&Sample {
                tick,
                coasting: false,
                i: &i,
                q: &q,
                w: &w,
            });
            let flow = match flow {
                Ok(flow) => flow,
                Err(error) => {
                    failed = Some(error);
                    break;
                }
            };
            let idle = circuit.coasts_for(&q, &w, &i).min(held).min(end - tick);
            if idle == 0 || flow.is_break() {
                q = ManuallyDrop::new(circuit.next(ManuallyDrop::into_inner(q), &w, &i));
                tick += 1;
            } else {
                q = ManuallyDrop::new(circuit.coasted(ManuallyDrop::into_inner(q), idle));
                tick += idle;
            }
            if flow.is_break() {
                break;
            }
        }
        let q = ManuallyDrop::into_inner(q);
        (Simulator { circuit, q, tick }, failed)
    }

    /// Runs one tick and shows its sample.
    pub fn step<T>(self, i: C::In<Sim>, show: impl FnOnce(&Sample<'_, C>) -> T) -> (Self, T) {
        self.tick_once(i, show, |_, q| q)
    }

    /// Runs one tick and shows its sample, which `observer` sees too if it
    /// [looks](Observer::looks) at the tick. Also gives whether the observer goes on.
    ///
    /// Ticks that are looked at and others are compiled apart: where it does not look, no net is
    /// computed for it.
    ///
    /// # Errors
    /// What `observer` objects to.
    pub fn step_watched<T>(
        self,
        i: C::In<Sim>,
        mut observer: impl Observer<C>,
        show: impl FnOnce(&Sample<'_, C>) -> T,
    ) -> Result<(Self, T, ControlFlow<()>), RunError> {
        let Simulator { circuit, q, tick } = self;
        let (q, shown, flow) = match observer.looks(tick) {
            false => {
                let (q, shown) = Self::tick_on(circuit, q, tick, i, show);
                (q, shown, ControlFlow::Continue(()))
            }
            true => {
                let both = |now: &Sample<'_, C>| (show(now), observer.sample(now));
                let (q, (shown, flow)) = Self::tick_on(circuit, q, tick, i, both);
                (q, shown, flow?)
            }
        };
        let tick = tick + 1;
        Ok((Simulator { circuit, q, tick }, shown, flow))
    }

    /// A function of its own, with the circuit among its arguments, as [`run_on`](Self::run_on).
    #[inline(never)]
    fn tick_on<T>(
        circuit: &C,
        q: C::Reg<Sim>,
        tick: u64,
        i: C::In<Sim>,
        show: impl FnOnce(&Sample<'_, C>) -> T,
    ) -> (C::Reg<Sim>, T) {
        Self::to_edge(circuit, q, tick, i, show)
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
        self.tick_once(i, show, |circuit, q| match rst {
            true => reset(circuit, &q),
            false => q,
        })
    }

    #[inline(always)]
    fn tick_once<T>(
        self,
        i: C::In<Sim>,
        show: impl FnOnce(&Sample<'_, C>) -> T,
        after: impl FnOnce(&C, C::Reg<Sim>) -> C::Reg<Sim>,
    ) -> (Self, T) {
        let Simulator { circuit, q, tick } = self;
        let (q, shown) = Self::to_edge(circuit, q, tick, i, show);
        let q = after(circuit, q);
        (
            Simulator {
                circuit,
                q,
                tick: tick + 1,
            },
            shown,
        )
    }

    #[inline(always)]
    fn to_edge<T>(
        circuit: &C,
        q: C::Reg<Sim>,
        tick: u64,
        i: C::In<Sim>,
        show: impl FnOnce(&Sample<'_, C>) -> T,
    ) -> (C::Reg<Sim>, T) {
        // As in `run`.
        let q = ManuallyDrop::new(q);
        let w = circuit.comb(&q, &i);
        let shown = show(&Sample {
            tick,
            coasting: false,
            i: &i,
            q: &q,
            w: &w,
        });
        let q = circuit.next(ManuallyDrop::into_inner(q), &w, &i);
        (q, shown)
    }
}
