//! The buffer of targets against a queue.

use motion_rtl::kernel::Simulator;
use motion_rtl::linear_interpolator::TargetData;
use motion_rtl::linear_interpolator::target_data::In;
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
        let mut simulator = Simulator::new(&TargetData::<2, 32, 12>).unwrap();
        let mut shown = ([0, 0], 0, [0, 0]);
        for (push, [x, y], speed, times, pop, flush) in ticks {
            let flush = flush == 0;
            let [up, down] = times.map(|time| u64::from(time) % 4096);
            let i = In {
                push: push.into(),
                x: i64::from(x).into(),
                y: i64::from(y).into(),
                speed: [u64::from(speed).into()],
                acceleration_time: [up.into()],
                deceleration_time: [down.into()],
                pop: pop.into(),
                flush: flush.into(),
            };
            let (next, seen) = simulator.step(i, |now| {
                let q = now.q;
                let place = [q.target_x.get(), q.target_y.get()];
                let times = [q.target_acceleration[0].get(), q.target_deceleration[0].get()];
                let outputs = (place, q.target_speed[0].get(), times);
                (now.w.ready.get(), now.w.available.get(), outputs)
            });
            simulator = next;
            prop_assert_eq!(seen, (queue.len() < 3, !queue.is_empty(), shown));
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
