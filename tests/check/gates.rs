//! Clock gates, right and wrong.

use motion_rtl::check::{Drive, Invariants, drive, reach};
use motion_rtl::kernel::{
    Beside, Circuit, FreeRunning, Instance, Moment, Observer, Property, RunError, Sample,
    Simulator, With, WithIn,
};
use motion_rtl::logic::{Bit, Logic, Sim, Unsigned};
use motion_rtl::signals;
use motion_rtl::trace::Clock;
use std::io::sink;
use std::ops::ControlFlow;

/// What is wrong with a timer's gates.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Flaw {
    None,
    /// The clock is gated where it starts, too.
    GatedAtStart,
    /// It coasts in its last tick, too.
    CoastsToEnd,
    /// It coasts by two.
    CoastsByTwo,
    /// It says that it coasts for a tick more than it does.
    SaysOneMore,
    /// It does not coast for ever where it rests, as it says.
    CountsAtRest,
    /// Over more than two ticks it coasts by as many less one.
    ShortOfOne,
}

signals! { struct In<L> { start: L::Bit } }
signals! { struct Reg<L> { count: L::U<3> = 0, busy: L::Bit = 0 } }
signals! { struct Net<L> { last: L::Bit } }

/// Counts eight ticks after `start`. It says that something goes on in it, or that nothing does.
#[derive(Debug, Clone)]
struct Timer<const GOES_ON: bool = true>(Flaw);

impl<const GOES_ON: bool> Circuit for Timer<GOES_ON> {
    const NAME: &'static str = "timer";
    const ABOUT: &'static str = "counts eight ticks";
    type In<L: Logic> = In<L>;
    type Reg<L: Logic> = Reg<L>;
    type Net<L: Logic> = Net<L>;
    const FREE_RUNNING: FreeRunning = match GOES_ON {
        true => FreeRunning::All,
        false => FreeRunning::Nothing,
    };

    fn comb<L: Logic>(&self, q: &Reg<L>, _: &In<L>) -> Net<L> {
        Net {
            last: q.busy & q.count.equals(7.into()),
        }
    }

    fn next<L: Logic>(&self, q: Reg<L>, w: &Net<L>, i: &In<L>) -> Reg<L> {
        Reg {
            count: q.busy.mux(q.count + 1, q.count),
            busy: q.busy.mux(!w.last, i.start),
        }
    }

    fn gated<L: Logic>(&self, q: &Reg<L>, _: &Net<L>, i: &In<L>) -> Option<L::Bit> {
        Some(match self.0 {
            Flaw::GatedAtStart => !q.busy,
            _ => !(q.busy | i.start),
        })
    }

    fn coasting<L: Logic>(&self, q: &Reg<L>, w: &Net<L>, _: &In<L>) -> Option<L::Bit> {
        Some(match self.0 {
            Flaw::CoastsToEnd => q.busy,
            _ => q.busy & !w.last,
        })
    }

    fn coast<L: Logic>(&self, q: Reg<L>) -> Reg<L> {
        let step = match self.0 {
            Flaw::CoastsByTwo => 2,
            _ => 1,
        };
        Reg {
            count: q.count + step,
            ..q
        }
    }

    fn coasts_for(&self, q: &Reg<Sim>, _: &Net<Sim>, i: &In<Sim>) -> u64 {
        match (self.0, q.busy.get()) {
            (Flaw::SaysOneMore, true) => 8 - q.count.get(),
            (_, true) => 7 - q.count.get(),
            (_, false) if i.start.get() => 0,
            (_, false) => u64::MAX,
        }
    }

    fn coasted(&self, q: Reg<Sim>, ticks: u64) -> Reg<Sim> {
        let counts = q.busy.get() || self.0 == Flaw::CountsAtRest;
        let steps = match self.0 {
            _ if !counts => 0,
            Flaw::ShortOfOne if ticks > 2 => ticks - 1,
            _ => ticks,
        };
        Reg {
            count: q.count + steps,
            ..q
        }
    }

    fn properties<L: Logic>(&self, now: &Moment<'_, Self, L>, _: &Reg<L>) -> Vec<Property<L>> {
        let seven = now.q.count.equals(7.into());
        vec![
            Property::always(
                "rests at zero",
                &["count", "busy"],
                now.q.busy | now.q.count.is_zero(),
            ),
            Property::always("never comes to seven", &["count"], !seven),
        ]
    }
}

signals! { struct OuterReg<L> { timer: Reg<L> } }
signals! { struct OuterNet<L> { timer: Instance<Timer, L> } }

/// A timer inside another circuit.
#[derive(Debug)]
struct Outer(Timer);

impl Circuit for Outer {
    const NAME: &'static str = "outer";
    const ABOUT: &'static str = "a timer";
    type In<L: Logic> = In<L>;
    type Reg<L: Logic> = OuterReg<L>;
    type Net<L: Logic> = OuterNet<L>;

    fn comb<L: Logic>(&self, q: &OuterReg<L>, i: &In<L>) -> OuterNet<L> {
        OuterNet {
            timer: Instance::settle(&self.0, &q.timer, i.clone()),
        }
    }

    fn next<L: Logic>(&self, q: OuterReg<L>, w: &OuterNet<L>, _: &In<L>) -> OuterReg<L> {
        OuterReg {
            timer: w.timer.next(&self.0, q.timer),
        }
    }
}

signals! { struct AroundReg<L> { timer: Reg<L> } }
signals! { struct AroundNet<L> { even: L::Bit, timer: Instance<Timer, L> } }

/// A timer inside a circuit that coasts with it; it says that nothing else goes on in it, and looks
/// at the timer's count.
#[derive(Debug)]
struct Around {
    looks: bool,
}

const TIMER: Timer = Timer(Flaw::None);

impl Circuit for Around {
    const NAME: &'static str = "timer";
    const ABOUT: &'static str = "a timer, and whether its count is even";
    type In<L: Logic> = In<L>;
    type Reg<L: Logic> = AroundReg<L>;
    type Net<L: Logic> = AroundNet<L>;
    const FREE_RUNNING: FreeRunning = FreeRunning::Parts;

    fn comb<L: Logic>(&self, q: &AroundReg<L>, i: &In<L>) -> AroundNet<L> {
        let looks: L::Bit = self.looks.into();
        AroundNet {
            even: looks & !q.timer.count.bit(0),
            timer: Instance::settle(&TIMER, &q.timer, i.clone()),
        }
    }

    fn next<L: Logic>(&self, q: AroundReg<L>, w: &AroundNet<L>, _: &In<L>) -> AroundReg<L> {
        AroundReg {
            timer: w.timer.next(&TIMER, q.timer),
        }
    }

    fn coasts_for(&self, q: &AroundReg<Sim>, w: &AroundNet<Sim>, _: &In<Sim>) -> u64 {
        w.timer.coasts_for(&TIMER, &q.timer)
    }

    fn coasted(&self, q: AroundReg<Sim>, ticks: u64) -> AroundReg<Sim> {
        AroundReg {
            timer: TIMER.coasted(q.timer, ticks),
        }
    }
}

signals! { struct Lamp<L> { lit: L::Bit } }

/// A lamp that nothing drives.
struct LampBeside;

impl Beside for LampBeside {
    const SCOPE: &'static str = "lamp";
    type Signals<L: Logic> = Lamp<L>;
}

/// What a proof and a random run say of a timer.
fn faults<C: Circuit>(timer: &C) -> [Option<String>; 2] {
    let none = Invariants::new();
    let proof = reach(timer, &none).run().expect("narrow enough");
    let found = proof.counterexample().map(|found| {
        assert_eq!(found.invariant, "the clock gate");
        assert_eq!(found.signals, ["timer"]);
        found.message.clone()
    });
    let run = Drive {
        ticks: 1000,
        seed: 1,
        resets: true,
        clock: Clock::default(),
    };
    let driven = match drive(timer, &run, sink(), sink()) {
        Ok(_) => None,
        Err(RunError::Violation {
            signals, message, ..
        }) => {
            assert_eq!(signals, ["timer"]);
            Some(message)
        }
        Err(other) => panic!("{other}"),
    };
    [found, driven]
}

#[test]
fn proofs_and_random_runs_find_wrong_gates() {
    let faults = |flaw| {
        let found = faults(&Timer::<true>(flaw));
        let beside = With::<_, LampBeside>::new(Timer::<true>(flaw));
        assert_eq!(
            found,
            self::faults(&beside),
            "{flaw:?}, with a lamp beside it"
        );
        found
    };
    assert_eq!(faults(Flaw::None), [None, None]);
    let gated = "a register changes where the clock is gated";
    assert_eq!(
        faults(Flaw::GatedAtStart),
        [gated, gated].map(|message| Some(message.into()))
    );
    let coasts = "the registers are not as `coast` makes them where it coasts";
    for flaw in [Flaw::CoastsToEnd, Flaw::CoastsByTwo] {
        assert_eq!(
            faults(flaw),
            [coasts, coasts].map(|message| Some(message.into()))
        );
    }
    let long = "it does not coast for as long as it says, or otherwise";
    for flaw in [Flaw::SaysOneMore, Flaw::CountsAtRest, Flaw::ShortOfOne] {
        assert_eq!(
            faults(flaw),
            [long, long].map(|message| Some(message.into())),
            "{flaw:?}"
        );
    }
}

#[test]
fn proofs_and_random_runs_find_what_goes_on_unsaid() {
    let unsaid = "what is not said to run free changes while it coasts";
    let unsaid = [unsaid, unsaid].map(|message| Some(message.into()));
    assert_eq!(faults(&Timer::<false>(Flaw::None)), unsaid);
    assert_eq!(faults(&Around { looks: true }), unsaid);
    assert_eq!(faults(&Around { looks: false }), [None, None]);
}

#[test]
fn a_circuit_has_its_properties_whatever_stands_beside_it() {
    let beside = With::<_, LampBeside>::new(Timer::<true>(Flaw::None));
    let properties = Invariants::of(&beside);
    let found = reach(&beside, &properties).run().expect("narrow enough");
    let found = found.counterexample().expect("it comes to seven");
    assert_eq!(found.invariant, "never comes to seven");
    assert_eq!((found.signals, found.tick), (vec!["count".to_owned()], 8));
}

/// Looks at ticks that come one by one, as the gates have it, and not as ones that coast.
struct Alone<F>(F);

impl<C: Circuit, F: FnMut(&Sample<'_, C>)> Observer<C> for Alone<F> {
    fn follows(&self, _: u64) -> bool {
        false
    }

    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        (self.0)(now);
        Ok(ControlFlow::Continue(()))
    }
}

/// The counts of some ticks after a start in tick 1.
fn counts<C: Circuit>(
    circuit: &C,
    ports: fn(In<Sim>) -> C::In<Sim>,
    count: fn(&C::Reg<Sim>) -> u64,
) -> Vec<u64> {
    let mut counts = Vec::new();
    let look = Alone(|now: &Sample<'_, C>| counts.push(count(now.q)));
    let stimulus = |tick, _: &C::Reg<Sim>| {
        ports(In {
            start: (tick == 1).into(),
        })
    };
    Simulator::new(circuit)
        .run(12, stimulus, look)
        .expect("nobody objects");
    counts
}

/// Seen by what comes of wrong ones.
#[test]
fn the_simulator_goes_by_the_gates_outermost_and_within_and_beside() {
    let timer = |flaw| {
        let counts = counts(&Timer::<true>(flaw), |i| i, |q| q.count.get());
        let within = self::counts(&Outer(Timer(flaw)), |i| i, |q| q.timer.count.get());
        assert_eq!(counts, within, "{flaw:?}");
        let beside = With::<_, LampBeside>::new(Timer::<true>(flaw));
        let lit = |i| WithIn {
            i,
            beside: Lamp { lit: true.into() },
        };
        let beside = self::counts(&beside, lit, |q| q.count.get());
        assert_eq!(counts, beside, "{flaw:?}, with a lamp beside it");
        counts
    };
    assert_eq!(timer(Flaw::None), [0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 0, 0]);
    assert_eq!(timer(Flaw::GatedAtStart), [0; 12]);
    assert_eq!(
        timer(Flaw::CoastsToEnd),
        [0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 0, 1]
    );
    assert_eq!(
        timer(Flaw::CoastsByTwo),
        [0, 0, 0, 2, 4, 6, 0, 2, 4, 6, 0, 2]
    );
}
