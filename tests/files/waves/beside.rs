//! Waves of a circuit that runs with signals beside it, without these.

use super::reader;
use motion_rtl::circuits::blocks::{EnableCounter, enable_counter::In};
use motion_rtl::prelude::*;
use motion_rtl::sim::{Beside, Elaborated, Without};
use motion_rtl::trace::{Clock, Options, Vcd};

#[derive(Clone)]
struct Motor;

signals! { for Motor as _c;
    pub struct Side { pub speed: U(5), pub stopped: Bit }
}

impl Beside for Motor {
    const SCOPE: &'static str = "motor";
    type Signals<V: View> = Side<V>;
}

const TICKS: u64 = 60;
const COUNTER: EnableCounter = EnableCounter { width: 4 };

fn i(tick: u64) -> In<Value> {
    In {
        period: 3 + tick / 20,
    }
}

#[test]
fn they_are_those_of_the_circuit_alone() {
    for ticks in [0..u64::MAX, 7..31] {
        let options = Options { ticks, only: None };
        let begin = || Vcd::new(Vec::new(), &COUNTER, Clock::default(), &options).unwrap();
        let (mut expected, mut vcd) = (begin(), begin());
        let mut simulator = Simulator::new(&COUNTER).unwrap();
        simulator
            .run(TICKS, |tick, _| i(tick), &mut expected)
            .unwrap();

        let model = Elaborated::with_beside(&COUNTER, &Motor).unwrap();
        let mut both = Vcd::new(Vec::new(), &model, Clock::default(), &options).unwrap();
        let simulator = Simulator::watching_beside(&COUNTER, &Motor, true, |_| ());
        let (mut simulator, ()) = simulator.unwrap();
        for tick in 0..TICKS {
            simulator
                .show::<Motor>(&Side {
                    speed: (tick * 7).cut(5),
                    stopped: tick.is_multiple_of(3),
                })
                .unwrap();
            let observers = (Without(&mut vcd), &mut both);
            let stepped = simulator.step_watched(&i(tick), observers, |_| ());
            assert!(stepped.unwrap().1.is_continue());
        }
        let [expected, vcd, both] = [expected, vcd, both].map(|vcd| vcd.finish().unwrap());
        assert!(expected == vcd, "{}", String::from_utf8(vcd).unwrap());
        // In the waves of both the motor stands behind the ports in.
        let dump = reader::read(&both).variables;
        let alone = reader::read(&expected).variables;
        assert_eq!(dump.len(), alone.len() + 2);
        for (path, variable) in &alone {
            assert!(dump[path].changes == variable.changes, "{path}");
        }
        for tick in options.ticks.start..options.ticks.end.min(TICKS) {
            let speed = dump["enable_counter.motor.speed"].number_at(10 * tick);
            assert_eq!(speed, Some(tick * 7 % 32));
        }
    }
}
