//! A circuit made of circuits.

use crate::circuits::*;
use motion_rtl::check::{Invariants, Lockstep, LockstepError, Pair, SamePorts, reach, require};
use motion_rtl::kernel::{Circuit, Declarations, Instance, Role, Sample, Simulator, zero};
use motion_rtl::logic::{Logic, Sim};
use motion_rtl::signals;

signals! { pub struct ClockReg<L> { digits: [UpReg<L>; 3] as Elements(&["seconds", "minutes"]) } }
signals! {
    pub struct ClockNet<L> {
        pub digits: [Instance<Up, L>; 3] as Elements(&["seconds", "minutes"]),
        spare: Instance<Up, L>,
        pub midnight: L::Bit,
    }
}

/// Three counters, each of them enabled by the carries below.
#[derive(Debug)]
struct Clock([Up; 3]);

impl Circuit for Clock {
    const NAME: &'static str = "clock";
    const ABOUT: &'static str = "counts in three digits";
    type In<L: Logic> = Enable<L>;
    type Reg<L: Logic> = ClockReg<L>;
    type Net<L: Logic> = ClockNet<L>;

    fn comb<L: Logic>(&self, q: &ClockReg<L>, i: &Enable<L>) -> ClockNet<L> {
        let [a, b, c] = &self.0;
        let enabled = |enable| Enable { enable };
        let first = Instance::settle(a, &q.digits[0], enabled(i.enable));
        let carry = i.enable & first.w.last;
        let second = Instance::settle(b, &q.digits[1], enabled(carry));
        let carry = carry & second.w.last;
        let third = Instance::settle(c, &q.digits[2], enabled(carry));
        ClockNet {
            midnight: carry & third.w.last,
            spare: third.clone(),
            digits: [first, second, third],
        }
    }

    fn next<L: Logic>(&self, q: ClockReg<L>, w: &ClockNet<L>, _: &Enable<L>) -> ClockReg<L> {
        let [a, b, c] = &self.0;
        let [x, y, z] = q.digits;
        ClockReg {
            digits: [
                w.digits[0].next(a, x),
                w.digits[1].next(b, y),
                w.digits[2].next(c, z),
            ],
        }
    }
}

impl SamePorts<Clock> for Toggle {
    fn ports<L: Logic>(i: &Enable<L>) -> &Enable<L> {
        i
    }
}

const fn clock() -> Clock {
    Clock([Up { n: 3 }, Up { n: 4 }, Up { n: 2 }])
}

#[test]
fn every_signal_of_every_instance_is_declared() {
    let leaves = Declarations::of(&clock()).leaves;
    let expected = [
        ("clock.enable", Role::Input),
        ("clock.seconds.count", Role::Register),
        ("clock.minutes.count", Role::Register),
        ("clock.digits2.count", Role::Register),
        ("clock.seconds.enable", Role::Input),
        ("clock.seconds.last", Role::Net),
        ("clock.seconds.carry", Role::Net),
        ("clock.minutes.enable", Role::Input),
        ("clock.minutes.last", Role::Net),
        ("clock.minutes.carry", Role::Net),
        ("clock.digits2.enable", Role::Input),
        ("clock.digits2.last", Role::Net),
        ("clock.digits2.carry", Role::Net),
        ("clock.spare.enable", Role::Input),
        ("clock.spare.last", Role::Net),
        ("clock.spare.carry", Role::Net),
        ("clock.midnight", Role::Net),
    ];
    let found: Vec<_> = leaves.iter().map(|leaf| (leaf.path(), leaf.role)).collect();
    assert_eq!(found, expected.map(|(path, role)| (path.to_owned(), role)));
}

#[test]
fn it_counts_through_all_digits() {
    let none = Invariants::new();
    let outcome = reach(&clock(), &none).run().unwrap();
    let proof = outcome.proof().unwrap();
    let states = 3 * 4 * 2;
    assert_eq!(
        (proof.states, proof.transitions, proof.depth),
        (states, 2 * states, states - 1)
    );

    let never = Invariants::new().always("never midnight", |now: &Sample<Clock>| {
        require(!now.w.midnight.get(), ["midnight"], || "ding".into())
    });
    let found = reach(&clock(), &never).run().unwrap().counterexample();
    assert_eq!(found.unwrap().tick, states - 1);
}

#[test]
fn ports_out_are_public_all_the_way_and_no_ports_in() {
    let pair = Pair {
        left: clock(),
        right: Toggle,
    };
    let names = [
        "clock.seconds.last",
        "clock.minutes.last",
        "clock.digits2.last",
        "clock.midnight",
        "toggle.parity",
    ];
    let lockstep = Lockstep::of(&pair, &[("spare.carry", "last")]).unwrap();
    assert_eq!(lockstep.unpaired(), [&names[..], &[]].concat());

    let pair = Pair {
        left: clock(),
        right: clock(),
    };
    let lockstep = Lockstep::by_name(&pair).unwrap();
    assert_eq!(lockstep.to_string().split(", ").count(), 4);
    let agree = Invariants::new().always("agree", |now| lockstep.compare(now));
    assert!(reach(&pair, &agree).run().unwrap().proof().is_some());
    let twice = Lockstep::of(&pair, &[("seconds", "seconds")]);
    assert!(matches!(twice, Err(LockstepError::NoSuchSignal { .. })));
}

#[test]
fn an_instance_prints_its_ports_and_nets() {
    let up = Up { n: 3 };
    let simulator = Simulator::new(&up).unwrap();
    let (_, instance) = simulator.step(zero(), |now| Instance::<Up, Sim> {
        i: (**now.i).clone(),
        w: (**now.w).clone(),
    });
    let text = format!("{instance:?}");
    assert!(
        text.starts_with("modulo {") && text.contains("carry"),
        "{text}"
    );
}
