//! A circuit made of circuits.

use crate::circuits::*;
use motion_rtl::check::{Lockstep, LockstepError, Pair};
use motion_rtl::hdl::Declarations;
use motion_rtl::netlist::Role;
use motion_rtl::prelude::*;
use motion_rtl::sim::Sample;

/// Three counters, each of them enabled by the carries below.
#[derive(Debug, Clone)]
struct Clock([u64; 3]);

signals! { for Clock as c;
    pub struct ClockIn { pub enable: Bit }
    pub struct ClockParts {
        pub digits: [Part<Up>(Up { n: c.0[k] }); k in 3] as Elements(&["seconds", "minutes"]),
        /// Counts as the last digit does.
        spare: Part<Up>(Up { n: c.0[2] }),
    }
    pub struct ClockNet { pub midnight: Bit }
}

impl Circuit for Clock {
    const NAME: &'static str = "clock";
    const ABOUT: &'static str = "counts in three digits";
    records!(ClockIn, Nothing, ClockNet, ClockParts);

    fn tick(&self, i: ClockIn, _: Nothing, p: ClockParts) -> (ClockNet, Nothing) {
        let (mut enable, mut before) = (i.enable, i.enable);
        for digit in p.digits {
            before = enable;
            enable = enable & digit.settle(Enable { enable }).w.last;
        }
        p.spare.settle(Enable { enable: before });
        (ClockNet { midnight: enable }, Nothing)
    }
}

fn clock() -> Clock {
    Clock([3, 4, 2])
}

#[test]
fn every_signal_of_every_part_is_declared() {
    let leaves = Declarations::of(&clock()).leaves;
    let expected = [
        ("clock.enable", Role::Input),
        ("clock.seconds.count", Role::Register),
        ("clock.minutes.count", Role::Register),
        ("clock.digits2.count", Role::Register),
        ("clock.spare.count", Role::Register),
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

    let never = Invariants::new().always("never midnight", |now: &Sample<'_, Clock>| {
        require(!now.w.midnight, ["midnight"], || "ding".into())
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
        "clock.seconds.count",
        "clock.minutes.count",
        "clock.digits2.count",
        "clock.seconds.last",
        "clock.minutes.last",
        "clock.digits2.last",
        "clock.midnight",
        "toggle.parity",
    ];
    let lockstep = Lockstep::of(&pair, &[("spare.carry", "last")]).unwrap();
    assert_eq!(lockstep.unpaired(), names);

    let pair = Pair {
        left: clock(),
        right: clock(),
    };
    let lockstep = Lockstep::by_name(&pair).unwrap();
    assert_eq!(lockstep.to_string().split(", ").count(), 7);
    let agree = Invariants::new().always("agree", |now| lockstep.compare(now));
    assert!(reach(&pair, &agree).run().unwrap().proof().is_some());
    let twice = Lockstep::of(&pair, &[("seconds", "seconds")]);
    assert!(matches!(twice, Err(LockstepError::NoSuchSignal { .. })));
}

#[test]
fn a_part_is_shown_with_its_ports_registers_and_nets() {
    let mut simulator = Simulator::new(&clock()).unwrap();
    simulator.step();
    let text = simulator.now(|now| {
        let seconds = &now.p.digits[0];
        format!(
            "{seconds:?} {:?} {:?} {:?}",
            seconds.i, seconds.q, seconds.w
        )
    });
    let expected = "modulo { .. } Enable { enable: false } UpReg { count: 0 } \
                    UpNet { last: false, carry: false }";
    assert_eq!(text, expected);
}
