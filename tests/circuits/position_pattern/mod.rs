//! The position pattern generator against a model of it, written as a program, tick by tick, and
//! what its positions must be whatever the model says.

mod bench;
mod program;

use bench::Bench;
use motion_rtl::circuits::linear_interpolator::PatternGenerator;
use program::{Plan, Ports};
use proptest::prelude::*;

/// A cycle that begins.
fn cycle(from: i64, distance: i64, speed: u64, times: [u64; 2]) -> Ports {
    Ports {
        start: true,
        from,
        distance,
        speed,
        times,
        ..Ports::default()
    }
}

fn fits(value: i64, bits: u32) -> bool {
    value >= -1 << (bits - 1) && value < 1 << (bits - 1)
}

/// Checks the positions of a cycle, the one at the start included; `whole` where it was not
/// aborted. `bits` are the widths of positions and times.
fn check(ports: &Ports, bits: [u32; 2], positions: &[i64], whole: bool) {
    let plan = Plan::new(ports, bits);
    let [p, t] = bits;
    let counted = plan.steady < (1 << (p - 1)) - 1;
    let (end, sign) = (ports.from + ports.distance, ports.distance.signum());
    let steps: Vec<i64> = positions.windows(2).map(|pair| pair[1] - pair[0]).collect();
    for (position, step) in positions[1..].iter().zip(&steps) {
        assert!(step * sign >= 0, "not monotone: {ports:?} {positions:?}");
        let greatest = ports.speed.max(1).div_ceil(1 << t) as i64;
        let slow = step.abs() <= greatest || !counted;
        assert!(slow, "too fast: {ports:?} {positions:?}");
        let between = (end - position) * sign >= 0;
        assert!(between, "too far: {ports:?} {positions:?}");
    }
    if !whole {
        return;
    }
    assert_eq!(positions.last(), Some(&end), "{ports:?}");
    assert_eq!(steps.len() as i128, plan.scans(), "{ports:?}");
    // The ideal: a trapezoid of these times and of area Δ, by its speed in the middle of a scan.
    let [up, down] = ports.times.map(|time| time.max(1) as f64);
    let (steady, scans) = (plan.steady as f64, steps.len() as f64);
    let peak = ports.distance as f64 / (steady + (up + down) / 2.0);
    let speed = |t: f64| peak * (t / up).min((scans - t) / down).min(1.0);
    for (n, step) in steps.iter().enumerate() {
        let off = *step as f64 - speed(n as f64 + 0.5);
        assert!(off.abs() < 1.0, "{ports:?} {positions:?}: scan {n}");
    }
    for (n, pair) in steps.windows(2).enumerate() {
        let ideal = speed(n as f64 + 1.5) - speed(n as f64 + 0.5);
        let off = (pair[1] - pair[0]) as f64 - ideal;
        assert!(off.abs() < 2.0, "{ports:?} {positions:?}: scan {n}");
    }
}

/// Every distance, speed and times of so many bits, a number each.
fn all(p: u32, t: u32) -> impl Iterator<Item = (i64, u64, [u64; 2], u64)> {
    let least = -1 << (p - 1);
    (0..1u64 << (2 * p + 2 * t)).map(move |n| {
        let distance = (n & ((1 << p) - 1)) as i64 + least;
        let rest = n >> p;
        let speed = rest & ((1 << p) - 1);
        let times = rest >> p;
        (distance, speed, [times & ((1 << t) - 1), times >> t], n)
    })
}

/// A start from which the target is inside the word.
fn start_inside(distance: i64, bits: u32, n: u64) -> i64 {
    let room = (1i64 << bits) - distance.abs();
    let lowest = (-1i64 << (bits - 1)) - distance.min(0);
    lowest + (n as i64).rem_euclid(room)
}

#[test]
fn every_cycle_of_4_bits() {
    let mut bench = Bench::new([4, 3]);
    for (distance, speed, times, n) in all(4, 3) {
        let ports = cycle(start_inside(distance, 4, n), distance, speed, times);
        let positions = bench.cycle(&ports, None, n % 3);
        if distance == 0 {
            assert_eq!(positions, [ports.from]);
        } else {
            check(&ports, [4, 3], &positions, true);
        }
    }
}

/// The longest ramps and the largest W that fit, and the longest steady stretches.
#[test]
fn every_cycle_of_6_bits_that_is_slow_or_fast() {
    let mut bench = Bench::new([6, 2]);
    for (distance, speed, times, n) in all(6, 2) {
        if distance != 0 && !(3..=61).contains(&speed) {
            let ports = cycle(start_inside(distance, 6, n), distance, speed, times);
            let positions = bench.cycle(&ports, None, 0);
            check(&ports, [6, 2], &positions, true);
        }
    }
}

#[test]
fn positions_wrap_at_the_ends_of_the_word() {
    let mut bench = Bench::new([4, 2]);
    let mut wrapped = 0;
    for from in -8..8 {
        for distance in (-8..8).filter(|&distance| distance != 0) {
            for (speed, times) in [(1, [1, 1]), (2, [1, 3]), (15, [2, 1]), (7, [3, 3])] {
                let ports = cycle(from, distance, speed, times);
                let positions = bench.cycle(&ports, None, 0);
                let mut straight = vec![from];
                for pair in positions.windows(2) {
                    let step = (pair[1] - pair[0]) << 60 >> 60;
                    straight.extend(straight.last().map(|x| x + step));
                }
                wrapped += u32::from(!fits(from + distance, 4));
                check(&ports, [4, 2], &straight, true);
                let end = (from + distance) << 60 >> 60;
                assert_eq!(positions.last(), Some(&end), "{ports:?}");
            }
        }
    }
    assert!(wrapped > 100);
}

/// Aborts a cycle in every scan, and between any two, and starts another.
fn abort_everywhere(bench: &mut Bench, bits: [u32; 2], ports: &Ports, n: u64) {
    let plan = Plan::new(ports, bits);
    let latency = bench.scan_latency;
    for scan in 0..plan.scans() as u64 {
        // With its advance, in the scan, with its end.
        for within in [0, 1, 1 + n % latency, latency] {
            let positions = bench.cycle(ports, Some((scan, within)), n % 2);
            check(ports, bits, &positions, false);
            let made = positions.len() as i128 - 1;
            let before = i128::from(scan) + i128::from(within > 0);
            let [up, down] = ports.times.map(|time| i128::from(time.max(1)));
            let rest = if before <= up {
                (before * down + up - 1) / up
            } else {
                down.min(plan.scans() - before)
            };
            assert_eq!(made, before + rest, "{ports:?} in scan {scan} at {within}");
            assert!(rest <= down);
            let mut stop = vec![plan.weight((before - 1).max(0))];
            stop.extend(plan.stop(before));
            let gentle = stop.windows(2).all(|pair| pair[0] - pair[1] <= 2 * up);
            assert!(gentle, "{ports:?} in scan {scan}: {stop:?}");
        }
    }
    let positions = bench.cycle(ports, None, 0);
    check(ports, bits, &positions, true);
}

#[test]
fn an_abort_in_any_scan_ramps_down_on_the_way() {
    let bits = [3, 2];
    let mut bench = Bench::new(bits);
    for (distance, speed, times, n) in all(3, 2) {
        // 0 counts as 1.
        if distance != 0 && speed > 0 && !times.contains(&0) && (n + n / 8) % 2 == 0 {
            let ports = cycle(start_inside(distance, 3, n), distance, speed, times);
            abort_everywhere(&mut bench, bits, &ports, n);
        }
    }
    let bits = [4, 3];
    let mut bench = Bench::new(bits);
    for (distance, speed, times, n) in all(4, 3).step_by(251) {
        if distance != 0 {
            let ports = cycle(start_inside(distance, 4, n), distance, speed, times);
            abort_everywhere(&mut bench, bits, &ports, n);
        }
    }
}

/// In any tick at all, and the next cycle begins in any tick after it.
#[test]
fn an_abort_in_any_tick_leaves_nothing_behind() {
    let mut bench = Bench::new([4, 2]);
    let ports = cycle(-3, 6, 12, [2, 3]);
    let other = cycle(5, -7, 8, [1, 2]);
    let mut latest = 0;
    let (prepare, scan) = (bench.prepare, bench.scan_latency);
    for abort in 0..prepare + 5 * scan - 1 {
        for wait in 0..20 {
            bench.step(&ports);
            let advance = Ports {
                advance: true,
                ..other
            };
            // A start while it is active is not taken.
            for _ in 0..abort {
                bench.step(&advance);
            }
            bench.step(&Ports {
                halt: true,
                ..Ports::default()
            });
            while bench.outputs().active {
                bench.step(&Ports {
                    advance: true,
                    ..Ports::default()
                });
            }
            for _ in 0..wait {
                bench.step(&Ports::default());
            }
            let started = bench.ticks;
            bench.step(&other);
            while !bench.outputs().ready {
                bench.step(&Ports::default());
            }
            let late = bench.ticks - started - prepare;
            latest = late.max(latest);
            assert!(late == 0 || abort < prepare, "late after a scan");
            let positions = bench.scans(5, None, 0);
            check(&other, [4, 2], &positions, true);
        }
    }
    let circuit = PatternGenerator {
        position: 4,
        time: 2,
    };
    assert_eq!(latest, circuit.prepare_delay());
}

#[test]
fn an_abort_with_the_start_leaves_the_position_only() {
    let mut bench = Bench::new([4, 2]);
    for abort in [false, true] {
        for distance in -8..8 {
            let ports = Ports {
                halt: abort,
                ..cycle(distance / 2, distance, 12, [1, 1])
            };
            bench.step(&ports);
            let outputs = bench.outputs();
            assert_eq!(outputs.active, distance != 0 && !abort);
            assert_eq!(outputs.position, distance / 2);
            if outputs.active {
                bench.step(&Ports {
                    halt: true,
                    ..Ports::default()
                });
            }
            assert!(!bench.outputs().active);
        }
    }
}

/// Bits of positions and times.
const FULL: [u32; 2] = [32, 12];

/// Largest number of scans of a cycle; then it is aborted.
const SCANS: u64 = 300;

fn at_full_width(ports: &Ports, most: u64) {
    let mut bench = Bench::new(FULL);
    let scans = Plan::new(ports, FULL).scans();
    let abort = (scans > i128::from(most)).then_some((most, 0));
    let positions = bench.cycle(ports, abort, 0);
    check(ports, FULL, &positions, abort.is_none());
}

#[test]
#[ignore = "takes long"]
fn the_extremes_at_full_width() {
    let (least, most) = (i64::from(i32::MIN), i64::from(i32::MAX));
    for (from, distance) in [
        (0, least),
        (0, most),
        (least, most),
        (most, least),
        (-1, 1),
        (7, -1),
    ] {
        for speed in [1, 3, 5000, (1 << 20) - 1, u64::from(u32::MAX)] {
            for times in [[1, 1], [4095, 1], [1, 4095], [2, 3]] {
                at_full_width(&cycle(from, distance, speed, times), 40);
            }
        }
    }
    // The longest ramps with the greatest distance, from end to end.
    at_full_width(&cycle(0, least, u64::from(u32::MAX), [4095, 4095]), 9000);
    at_full_width(&cycle(-1, most, 600_000 << 12, [4095, 2]), 9000);
    // The greatest W.
    at_full_width(&cycle(0, least, 1, [4095, 4095]), 500);
}

/// Numbers of every order of magnitude.
fn magnitude(bits: u32) -> impl Strategy<Value = u64> {
    (0..=bits, any::<u64>()).prop_map(|(bits, word)| word & ((1 << bits) - 1))
}

fn any_cycle(time_bits: u32) -> impl Strategy<Value = Ports> {
    let distance = (magnitude(31), any::<bool>(), any::<i32>());
    let distance = distance.prop_map(|(length, down, from)| {
        let (length, from) = (length as i64, i64::from(from));
        let distance = if down { -length } else { length };
        // Inside the word.
        let inside = fits(from + distance, 32);
        (if inside { from } else { 0 }, distance)
    });
    let times = [magnitude(time_bits), magnitude(time_bits)];
    (distance, magnitude(32), times)
        .prop_map(|((from, distance), speed, times)| cycle(from, distance, speed, times))
}

/// Ports that wiggle: cycles, rare and frequent advances and aborts.
fn wiggle() -> impl Strategy<Value = (Vec<(Ports, u32)>, [u32; 3])> {
    let ports = (any_cycle(3), 0..400u32);
    let rates = [1..200u32, 1..150u32, 1..2000u32];
    (proptest::collection::vec(ports, 1..12), rates)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(120))]

    #[test]
    #[ignore = "takes long"]
    fn cycles_at_full_width(ports in any_cycle(8)) {
        prop_assume!(ports.distance != 0);
        at_full_width(&ports, SCANS);
    }

    #[test]
    fn any_ports_at_any_time((stretches, rates) in wiggle(), seed in 0..u32::MAX) {
        let mut bench = Bench::new(FULL);
        let mut random = seed;
        let mut strobe = |rate: u32| {
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (random >> 8) % rate == 0
        };
        for (ports, ticks) in stretches {
            for _ in 0..ticks * 4 {
                bench.step(&Ports {
                    start: strobe(rates[0]),
                    advance: strobe(rates[1]),
                    halt: strobe(rates[2]),
                    ..ports
                });
            }
        }
    }
}
