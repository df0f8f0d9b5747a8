//! Clock gates, right and wrong.

use motion_rtl::check::{Drive, Invariants, drive, reach};
use motion_rtl::kernel::{Circuit, Instance, RunError, Sample, Simulator, StopWhen};
use motion_rtl::logic::{Bit, Logic, Sim, Unsigned};
use motion_rtl::signals;
use motion_rtl::trace::Clock;
use std::io::sink;

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
}

signals! { struct In<L> { start: L::Bit } }
signals! { struct Reg<L> { count: L::U<3> = 0, busy: L::Bit = 0 } }
signals! { struct Net<L> { last: L::Bit } }

/// Counts eight ticks after `start`.
#[derive(Debug, Clone)]
struct Timer(Flaw);

impl Circuit for Timer {
    const NAME: &'static str = "timer";
    const ABOUT: &'static str = "counts eight ticks";
    type In<L: Logic> = In<L>;
    type Reg<L: Logic> = Reg<L>;
    type Net<L: Logic> = Net<L>;

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

/// What a proof and a random run say of a timer.
fn faults(flaw: Flaw) -> [Option<String>; 2] {
    let none = Invariants::new();
    let proof = reach(&Timer(flaw), &none).run().expect("narrow enough");
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
    let driven = match drive(&Timer(flaw), &run, sink(), sink()) {
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
}

/// The counts of some ticks after a start in tick 1.
fn counts<C: Circuit<In<Sim> = In<Sim>>>(circuit: &C, count: fn(&C::Reg<Sim>) -> u64) -> Vec<u64> {
    let mut counts = Vec::new();
    let look = StopWhen(|now: &Sample<'_, C>| {
        counts.push(count(now.q));
        false
    });
    let stimulus = |tick, _: &C::Reg<Sim>| In {
        start: (tick == 1).into(),
    };
    Simulator::new(circuit)
        .run(12, stimulus, look)
        .expect("nobody objects");
    counts
}

/// Seen by what comes of wrong ones.
#[test]
fn the_simulator_goes_by_the_gates_outermost_and_within() {
    let timer = |flaw| {
        let counts = counts(&Timer(flaw), |q| q.count.get());
        let within = Outer(Timer(flaw));
        assert_eq!(
            counts,
            self::counts(&within, |q| q.timer.count.get()),
            "{flaw:?}"
        );
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
