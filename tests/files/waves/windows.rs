//! Windows of the ticks in waves. Outside of them a run watches fewer signals: it exchanges the
//! engine, and nothing else changes.

use super::zoo::{In, Zoo, inputs};
use super::{SEED, clock, options};
use motion_rtl::hdl::Value;
use motion_rtl::sim::{Observer, Sample, Simulator};
use motion_rtl::trace::Vcd;
use proptest::prelude::*;
use std::ops::Range;

const TICKS: u64 = 25_000;

/// Least number of ticks before a window for which fewer signals are watched.
const FAR: u64 = 4096;

/// Inputs, each with the tick up to which it is held: some for a tick, some for hundreds.
fn held() -> Vec<(u64, In<Value>)> {
    let mut until = 0;
    let held = inputs(SEED).map(|i| {
        until += match i.address {
            0..8 => 1,
            address => 50 * (address - 7),
        };
        (until, i)
    });
    let mut all = Vec::from_iter(held.take(2000));
    all.last_mut().expect("inputs").0 = u64::MAX;
    all
}

/// Edges with a reset.
fn is_reset(tick: u64) -> bool {
    tick % 3001 == 3000
}

/// Values of the watched signal, and of a net and a register that are not watched.
type Seen = (bool, u64, u64);

/// Returns the waves of a run tick by tick, which always watches everything, and what is seen.
fn golden(windows: &[Range<u64>; 2]) -> ([Vec<u8>; 2], Vec<Seen>) {
    let mut vcds = windows.clone().map(begin);
    let mut simulator = Simulator::new(&Zoo).unwrap();
    let signals = simulator.signals();
    let (busy, read, count) = (signals.w.busy, signals.w.read, signals.q.count);
    let mut held = held().into_iter().peekable();
    let mut seen = Vec::new();
    for tick in 0..TICKS {
        let (until, i) = held.peek().unwrap();
        simulator.apply(i).unwrap();
        if *until == tick + 1 {
            held.next();
        }
        simulator.now(|now| {
            for vcd in &mut vcds {
                assert!(vcd.sample(now).unwrap().is_continue());
            }
            seen.push((now.get(busy), now.get(read), now.get(count)));
        });
        match is_reset(tick) {
            true => simulator.reset(),
            false => simulator.step(),
        }
    }
    (vcds.map(|vcd| vcd.finish().unwrap()), seen)
}

fn begin(ticks: Range<u64>) -> Vcd<Vec<u8>> {
    Vcd::new(Vec::new(), &Zoo, clock(), &options(ticks, &[])).unwrap()
}

/// Returns the waves of a run that jumps and watches few signals outside of the windows; compares
/// the ticks that it shows. It goes on as a copy of itself from tick `cloned` on.
fn exchanged(windows: &[Range<u64>; 2], cloned: u64, seen: &[Seen]) -> [Vec<u8>; 2] {
    let [mut first, mut second] = windows.clone().map(begin);
    let needs = Observer::<Zoo>::needs(&first);
    let watched = Simulator::watching(&Zoo, needs, |watch| watch.at(watch.w.busy));
    let (mut simulator, busy) = watched.unwrap();
    let (read, count) = (simulator.signals().w.read, simulator.signals().q.count);
    let mut held = held().into_iter().peekable();
    let mut last = 0;
    while simulator.tick() < TICKS {
        let tick = simulator.tick();
        while held.next_if(|(until, _)| *until <= tick).is_some() {}
        let (until, i) = held.peek().unwrap();
        let mut observer = (&mut first, &mut second);
        simulator.watch_for(&observer);
        if (cloned..cloned + 100).contains(&tick) {
            simulator = simulator.clone();
        }
        let ahead = |window: &Range<u64>| window.start > tick || window.end <= tick;
        let far = |window: &Range<u64>| window.start >= tick + FAR || window.end <= tick;
        match simulator.watches_all() {
            true => assert!(
                !windows.iter().all(far),
                "tick {tick} is far from {windows:?}"
            ),
            false => assert!(windows.iter().all(ahead), "tick {tick} is in {windows:?}"),
        }
        let show = |now: &Sample<'_, Zoo>| (now.get(busy), now.get(read), now.get(count));
        let (shown, flow) = simulator.look(i, &mut observer, show).unwrap();
        assert!(flow.is_continue());
        assert_eq!(shown, seen[tick as usize], "tick {tick}");
        for skipped in last..tick {
            let before = seen[last as usize].0;
            assert_eq!(seen[skipped as usize].0, before, "tick {skipped} is shown");
        }
        last = tick;
        let to_reset = 3000 - tick % 3001;
        match to_reset {
            0 => simulator.reset(),
            _ => {
                let most = simulator.unseen(&observer).min(until - tick);
                simulator.go_on(most.min(to_reset).min(TICKS - tick));
            }
        }
    }
    [first, second].map(|vcd| vcd.finish().unwrap())
}

/// Ticks near the beginning, near the distance from which engines are exchanged, and anywhere.
fn distance() -> impl Strategy<Value = u64> {
    prop_oneof![0..3_u64, FAR - 2..FAR + 3, 0..TICKS + 1000]
}

fn window() -> impl Strategy<Value = Range<u64>> {
    let length = prop_oneof![1..4_u64, FAR - 2..FAR + 3, 1..2000_u64];
    (distance(), length).prop_map(|(start, length)| start..start + length)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_window_is_as_in_a_run_that_watches_everything(
        first in window(),
        apart in distance(),
        length in 1..1000_u64,
        cloned in 0..2 * TICKS,
    ) {
        let second = first.end + apart..first.end + apart + length;
        let windows = [first, second];
        let (vcds, seen) = golden(&windows);
        prop_assert!(exchanged(&windows, cloned, &seen) == vcds, "{:?}", windows);
    }
}

#[test]
fn windows_at_both_ends_and_past_the_end() {
    for windows in [
        [0..1, TICKS - 1..TICKS],
        [0..TICKS, TICKS..TICKS + 1],
        [TICKS - FAR..TICKS + 10, 0..u64::MAX],
        [5000..5010, 5010 + FAR - 1..5020 + FAR],
        [5000..5010, 5010 + FAR..5020 + FAR],
    ] {
        let (vcds, seen) = golden(&windows);
        assert!(exchanged(&windows, u64::MAX, &seen) == vcds, "{windows:?}");
    }
}

/// A dump that goes on over an exchange compares everything in the tick after it.
#[test]
fn a_dump_goes_on_over_an_exchange() {
    let all = 0..u64::MAX;
    let window = 12_000..12_010;
    let mut whole = begin(all.clone());
    let mut vcd = begin(window.clone());
    let needs = Observer::<Zoo>::needs(&vcd);
    let (mut simulator, ()) = Simulator::watching(&Zoo, needs, |_| ()).unwrap();
    let mut inputs = inputs(SEED);
    for _ in 0..TICKS {
        // The whole dump is not asked what it reads.
        simulator.watch_for(&vcd);
        let i = inputs.next().unwrap();
        let looked = simulator.look(&i, (&mut whole, &mut vcd), |_| ());
        assert!(looked.unwrap().1.is_continue());
        simulator.step();
    }
    let mut golden = [all, window].map(begin);
    let mut inputs = super::inputs(SEED);
    let [first, second] = &mut golden;
    let run =
        Simulator::new(&Zoo)
            .unwrap()
            .run(TICKS, |_, _| inputs.next().unwrap(), (first, second));
    run.unwrap();
    let golden = golden.map(|vcd| vcd.finish().unwrap());
    assert!([whole, vcd].map(|vcd| vcd.finish().unwrap()) == golden);
}
