//! Waves of a circuit that runs with signals beside it, without these.

use motion_rtl::kernel::{Beside, Simulator, With, WithIn, Without};
use motion_rtl::logic::{Logic, Sim};
use motion_rtl::pulse_interpolator::{UnitTimeCounter, unit_time_counter::In};
use motion_rtl::signals;
use motion_rtl::trace::{Clock, Options, Vcd};

signals! { pub struct Side<L> { pub speed: L::U<5>, pub stopped: L::Bit } }

struct Motor;

impl Beside for Motor {
    const SCOPE: &'static str = "motor";
    type Signals<L: Logic> = Side<L>;
}

const TICKS: u64 = 60;

fn i(tick: u64) -> In<Sim, 4> {
    In {
        period: (3 + tick / 20).into(),
    }
}

#[test]
fn they_are_those_of_the_circuit_alone() {
    let (alone, with) = (UnitTimeCounter::<4>, With::new(UnitTimeCounter::<4>));
    let with: With<UnitTimeCounter<4>, Motor> = with;
    for ticks in [0..u64::MAX, 7..31] {
        let options = Options { ticks, only: None };
        let begin = || Vcd::new(Vec::new(), &alone, Clock::default(), &options).unwrap();
        let (mut expected, mut vcd) = (begin(), begin());
        let run = Simulator::new(&alone).unwrap();
        run.run(TICKS, |tick, _| i(tick), &mut expected).unwrap();
        let run = Simulator::new(&with).unwrap();
        let beside = |tick: u64| Side {
            speed: (tick * 7).into(),
            stopped: tick.is_multiple_of(3).into(),
        };
        run.run(
            TICKS,
            |tick, _| WithIn {
                i: i(tick),
                beside: beside(tick),
            },
            Without(&mut vcd),
        )
        .unwrap();
        let [expected, vcd] = [expected, vcd].map(|vcd| vcd.finish().unwrap());
        assert!(expected == vcd, "{}", String::from_utf8(vcd).unwrap());
    }
}
