//! The segment search against a look at every segment.

use motion_rtl::check::Random;
use motion_rtl::circuits::trajectory_controller::segment_search::In;
use motion_rtl::circuits::trajectory_controller::widths::PointWidths;
use motion_rtl::circuits::trajectory_controller::{SegmentSearch, Widths};
use motion_rtl::hdl::Value;
use motion_rtl::trace::LastTicks;

const A: usize = 4;

fn idle(last: u64) -> In<Value> {
    In {
        start: false,
        length: 0,
        last,
        write: false,
        write_segment: 0,
        write_begin: 0,
    }
}

/// Paths of every number of segments, and every length on them and behind them: each search finds
/// the segment that holds the length, in its latency, whatever was looked for before.
#[test]
fn every_length_is_found() {
    let widths = PointWidths {
        segment: A,
        point: 8,
        ..Widths::FULL.point()
    };
    let circuit = SegmentSearch { widths };
    let mut random = Random::new(5);
    for last in 0..1u64 << A {
        let mut begins: Vec<u64> = (0..last).map(|_| 1 + random.word() % 200).collect();
        begins.push(0);
        begins.sort_unstable();
        begins.dedup();
        let last = begins.len() as u64 - 1;
        let mut simulator = LastTicks::simulator(&circuit).unwrap();
        for segment in 0..1u64 << A {
            // Behind the last stands what is left of another path.
            let begin = begins.get(segment as usize).copied();
            let i = In {
                write: true,
                write_segment: segment,
                write_begin: begin.unwrap_or_else(|| random.word() % 256),
                ..idle(last)
            };
            simulator.step_with(&i, |_| ()).unwrap();
        }
        // In an order that jumps about.
        for length in (0..256u64).map(|step| step * 97 % 256) {
            let latency = circuit.latency();
            for ticks in 1..=latency {
                let i = In {
                    start: ticks == 1 || ticks == 4,
                    length: if ticks == 1 { length } else { 255 - length },
                    ..idle(last)
                };
                simulator.step_with(&i, |_| ()).unwrap();
                let done = simulator.see(|s| s.q.done);
                assert_eq!(done, ticks == latency, "after {ticks} ticks");
            }
            let q = simulator.registers().q;
            let segment = begins.iter().rposition(|&begin| begin <= length);
            let segment = segment.expect("the first begins at 0");
            let expected = (segment as u64, length - begins[segment]);
            assert_eq!((q.segment, q.offset), expected, "{length} in {begins:?}");
        }
    }
}
