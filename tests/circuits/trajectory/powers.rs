//! Square and cube of every length of up to seven bits, against whole numbers.

use motion_rtl::circuits::trajectory_controller::length_powers::In;
use motion_rtl::circuits::trajectory_controller::widths::PointWidths;
use motion_rtl::circuits::trajectory_controller::{LengthPowers, Widths};
use motion_rtl::sim::Simulator;

#[test]
fn every_length_is_raised_and_rounded_down_once_a_power() {
    let widths = PointWidths {
        point: 8,
        radius: 11,
        ..Widths::FULL.point()
    };
    let idle = Simulator::new(&LengthPowers { widths }).unwrap();
    for shift in 1..8u64 {
        for offset in 0..1u64 << shift {
            let mut powers = idle.clone();
            let latency = 2 * shift + 1;
            for tick in 1..=latency {
                // A start that comes in between is not taken.
                let start = tick == 1 || tick == latency / 2 + 1;
                let i = In {
                    start,
                    offset,
                    shift,
                };
                powers.step_with(&i, |_| ()).unwrap();
                let done = powers.see(|s| s.q.done);
                assert_eq!(
                    done,
                    tick == latency,
                    "{offset} of {shift} bits, tick {tick}"
                );
            }
            let square = ((offset * offset) << 3) >> shift;
            let cube = (square * offset) >> shift;
            let seen = [powers.see(|s| s.q.factor), powers.see(|s| s.q.product)];
            assert_eq!(seen, [square, cube], "{offset} of {shift} bits");
        }
    }
    let longest = LengthPowers { widths }.latency();
    assert_eq!(longest, 2 * 7 + 1);
}
