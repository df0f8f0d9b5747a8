//! The buffer of targets against a queue.

use motion_rtl::circuits::linear_interpolator::target_data::{In, Settings};
use motion_rtl::circuits::linear_interpolator::{TargetData, Widths};
use motion_rtl::trace::LastTicks;
use proptest::prelude::*;
use std::collections::VecDeque;

proptest! {
    #[test]
    fn targets_come_out_as_they_went_in(
        ticks in proptest::collection::vec(
            (any::<bool>(), any::<[i32; 2]>(), any::<u32>(), any::<[u16; 2]>(), any::<bool>(), 0u8..20),
            1..200,
        ),
    ) {
        let mut queue = VecDeque::new();
        let widths = Widths { address: 2, ..Widths::FULL };
        let mut simulator = LastTicks::simulator(&TargetData { widths, settings: 1 }).unwrap();
        let mut shown = ([0, 0], 0, [0, 0]);
        for (push, [x, y], speed, times, pop, flush) in ticks {
            let flush = flush == 0;
            let [up, down] = times.map(|time| u64::from(time) % 4096);
            let i = In {
                push,
                x: x.into(),
                y: y.into(),
                settings: Settings {
                    speed: vec![speed.into()],
                    acceleration_time: vec![up],
                    deceleration_time: vec![down],
                },
                pop,
                flush,
            };
            let seen = simulator.step_with(&i, |now| {
                let q = now.q;
                let times = [q.target_acceleration[0], q.target_deceleration[0]];
                let outputs = ([q.target_x, q.target_y], q.target_speed[0], times);
                (now.w.ready, now.w.available, outputs)
            }).unwrap();
            assert_eq!(seen, (queue.len() < 3, !queue.is_empty(), shown));
            let full = queue.len() == 3;
            if flush {
                queue.clear();
            } else if pop && let Some(first) = queue.pop_front() {
                shown = first;
            }
            if push && (flush || !full) {
                queue.push_back(([i64::from(x), i64::from(y)], u64::from(speed), [up, down]));
            }
        }
    }
}
