//! The segment search against a look at every segment.

use motion_rtl::check::Random;
use motion_rtl::kernel::Simulator;
use motion_rtl::logic::Sim;
use motion_rtl::trajectory_controller::SegmentSearch;
use motion_rtl::trajectory_controller::segment_search::In;

const A: usize = 4;
const Q: usize = 8;

fn idle(last: u64) -> In<Sim, A, Q> {
    In {
        start: false.into(),
        length: 0.into(),
        last: last.into(),
        write: false.into(),
        write_segment: 0.into(),
        write_begin: 0.into(),
    }
}

/// Paths of every number of segments, and every length on them and behind them: each search finds
/// the segment that holds the length, in its latency, whatever was looked for before.
#[test]
fn every_length_is_found() {
    let mut random = Random::new(5);
    for last in 0..1u64 << A {
        let mut begins: Vec<u64> = (0..last).map(|_| 1 + random.word() % 200).collect();
        begins.push(0);
        begins.sort_unstable();
        begins.dedup();
        let last = begins.len() as u64 - 1;
        let circuit = SegmentSearch::<A, Q>;
        let mut simulator = Simulator::new(&circuit).unwrap();
        for segment in 0..1u64 << A {
            // Behind the last stands what is left of another path.
            let begin = begins.get(segment as usize).copied();
            let i = In {
                write: true.into(),
                write_segment: segment.into(),
                write_begin: begin.unwrap_or_else(|| random.word() % 256).into(),
                ..idle(last)
            };
            simulator = simulator.step(i, |_| ()).0;
        }
        // In an order that jumps about.
        for length in (0..256u64).map(|step| step * 97 % 256) {
            let latency = SegmentSearch::<A, Q>::LATENCY;
            for ticks in 1..=latency {
                let i = In {
                    start: (ticks == 1 || ticks == 4).into(),
                    length: if ticks == 1 { length } else { 255 - length }.into(),
                    ..idle(last)
                };
                simulator = simulator.step(i, |_| ()).0;
                let done = simulator.registers().done.get();
                assert_eq!(done, ticks == latency, "after {ticks} ticks");
            }
            let q = simulator.registers();
            let segment = begins.iter().rposition(|&begin| begin <= length);
            let segment = segment.expect("the first begins at 0");
            let expected = (segment as u64, length - begins[segment]);
            assert_eq!(
                (q.segment.get(), q.offset.get()),
                expected,
                "{length} in {begins:?}"
            );
        }
    }
}
