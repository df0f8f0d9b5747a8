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
    /// observer nothing but the circuit is executed. Where the circuit
    /// [coasts](Circuit::coasts_for) it is stepped by [`coasted`](Circuit::coasted), unless the
    /// observer does not [follow](Observer::follows).
    ///
    /// # Errors
    /// The first error of an observer; the run is over then.
    pub fn run(
        self,
        ticks: u64,
        stimulus: impl FnMut(u64, &C::Reg<Sim>) -> C::In<Sim>,
        observer: impl Observer<C>,
    ) -> Result<Self, RunError> {
        match Self::run_on(self.circuit, self.q, self.tick, ticks, stimulus, observer) {
            (simulator, None) => Ok(simulator),
            (_, Some(error)) => Err(error),
        }
    }

    /// A function of its own: where registers are dropped they stand in memory all the time. What is
    /// behind a reference among its arguments nobody else writes, so what `circuit` holds is read
    /// before the first tick.
    ///
    /// Ticks in which the circuit coasts have a loop and nets of their own: it computes the counters
    /// and what is looked at, and nothing else.
    fn run_on(
        circuit: &'c C,
        q: C::Reg<Sim>,
        start: u64,
        ticks: u64,
        mut stimulus: impl FnMut(u64, &C::Reg<Sim>) -> C::In<Sim>,
        mut observer: impl Observer<C>,
    ) -> (Self, Option<RunError>) {
        let mut tick = start;
        let end = start.saturating_add(ticks);
        if tick >= end {
            return (Simulator { circuit, q, tick }, None);
        }
        // So they are where a panic unwinds.
        let mut q = ManuallyDrop::new(q);
        let mut failed = None;
        let mut ports = Ports::new::<C>();
        let mut pause = Pause::default();
        let mut i = stimulus(tick, &q);
        'run: loop {
            // For how many ticks behind this one it coasts, under these ports in. This one is
            // sampled as all are: what differs in it from the tick before is not known.
            let mut still = 0;
            if tick >= pause.end {
                let coasts = circuit.coasts_for(&q, &circuit.comb(&q, &i), &i);
                still = coasts.saturating_sub(1);
                match still {
                    0 => pause.at_work(tick),
                    _ => ports.keep(&i),
                }
            }
            loop {
                let w = circuit.comb(&q, &i);
                let flow = observer.sample(&Sample {
                    tick,
                    i: &i,
                    q: &q,
                    w: &w,
                });
                q = ManuallyDrop::new(Sim::clock(circuit, ManuallyDrop::into_inner(q), &w, &i));
                tick += 1;
                if ends(flow, &mut failed) || tick >= end {
                    break 'run;
                }
                i = stimulus(tick, &q);
                if tick >= pause.end {
                    break;
                }
            }
            if still == 0 {
                continue;
            }
            let began = tick;
            while still > 0 && ports.are(&i) && observer.follows(tick) {
                still -= 1;
                let w = circuit.comb(&q, &i);
                let flow = observer.sample(&Sample {
                    tick,
                    coasting: true,
                    i: &i,
                    q: &q,
                    w: &w,
                });
                q = ManuallyDrop::new(circuit.coasted(ManuallyDrop::into_inner(q), 1));
                tick += 1;
                if ends(flow, &mut failed) || tick >= end {
                    break 'run;
                }
                i = stimulus(tick, &q);
            }
            match tick == began {
                true => pause.at_work(tick),
                false => pause = Pause::default(),
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
    /// counter: waves, stimulus files and monitors are for [`run`](Simulator::run).
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
        let mut tick = start;
        let end = start.saturating_add(ticks);
        if tick >= end {
            return (Simulator { circuit, q, tick }, None);
        }
        let mut q = ManuallyDrop::new(q);
        let mut failed = None;
        let mut pause = Pause::default();
        let (mut i, mut held) = stimulus(tick, &q);
        'run: loop {
            let w = circuit.comb(&q, &i);
            let idle = circuit.coasts_for(&q, &w, &i).min(held).min(end - tick);
            if idle > 1 {
                pause = Pause::default();
                let flow = observer.sample(&Sample {
                    tick,
                    i: &i,
                    q: &q,
                    w: &w,
                });
                let over = ends(flow, &mut failed);
                let ticks = if over { 1 } else { idle };
                q = ManuallyDrop::new(circuit.coasted(ManuallyDrop::into_inner(q), ticks));
                tick += ticks;
                if over || tick >= end {
                    break;
                }
                (i, held) = stimulus(tick, &q);
                continue;
            }
            pause.at_work(tick);
            while tick < pause.end {
                let w = circuit.comb(&q, &i);
                let flow = observer.sample(&Sample {
                    tick,
                    i: &i,
                    q: &q,
                    w: &w,
                });
                q = ManuallyDrop::new(Sim::clock(circuit, ManuallyDrop::into_inner(q), &w, &i));
                tick += 1;
                if ends(flow, &mut failed) || tick >= end {
                    break 'run;
                }
                (i, held) = stimulus(tick, &q);
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
            i: &i,
            q: &q,
            w: &w,
        });
        let q = circuit.next(ManuallyDrop::into_inner(q), &w, &i);
        (q, shown)
    }
}

/// When a circuit is asked again for how long it coasts. Where it is at work it mostly will be in
/// the next tick: each time that it is, it is asked after twice as many ticks, so that being asked
/// costs little and no more ticks are missed than it was at work for.
#[derive(Default)]
struct Pause {
    ticks: u64,
    end: u64,
}

impl Pause {
    const LONGEST: u64 = 64;

    fn at_work(&mut self, tick: u64) {
        self.ticks = (2 * self.ticks).clamp(1, Self::LONGEST);
        self.end = tick.saturating_add(self.ticks);
    }
}

/// Whether an observer ends the run, and with which error.
fn ends(flow: Result<ControlFlow<()>, RunError>, failed: &mut Option<RunError>) -> bool {
    match flow {
        Ok(flow) => flow.is_break(),
        Err(error) => {
            *failed = Some(error);
            true
        }
    }
}
