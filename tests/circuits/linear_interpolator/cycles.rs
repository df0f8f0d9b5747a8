//! Whole positioning cycles through the interpolator at 5 bits, with scans as short as they may
//! be.

use motion_rtl::circuits::linear_interpolator::command_source::Orders;
use motion_rtl::circuits::linear_interpolator::interpolator::In;
use motion_rtl::circuits::linear_interpolator::target_data::Settings;
use motion_rtl::circuits::linear_interpolator::{LinearInterpolator, MasterAxis, Rule, Widths};
use motion_rtl::hdl::Value;
use motion_rtl::sim::Simulator;
use motion_rtl::trace::LastTicks;

const WORDS: std::ops::Range<i64> = -16..16;
const SCAN: u64 = small(Rule::Floor, MasterAxis::Longer).latency();

const fn small(rule: Rule, master: MasterAxis) -> LinearInterpolator {
    LinearInterpolator {
        widths: Widths {
            address: 2,
            position: 5,
            time: 2,
        },
        rule,
        master,
    }
}

fn at_power_on(rule: Rule) -> Simulator<LinearInterpolator> {
    led(rule, MasterAxis::Longer)
}

fn led(rule: Rule, master: MasterAxis) -> Simulator<LinearInterpolator> {
    let mut simulator = LastTicks::simulator(&small(rule, master)).unwrap();
    simulator.compile();
    simulator
}

/// Where to, how fast in quarters of a count a scan, and with which times.
#[derive(Debug, Clone, Copy, Default)]
struct Target {
    x: i64,
    y: i64,
    speed: u64,
    times: [u64; 2],
}

/// Ports in, with a target if there is one.
fn ports(scan: bool, push: Option<Target>, halt: bool) -> In<Value> {
    let Target { x, y, speed, times } = push.unwrap_or_default();
    In {
        scan,
        hold: false,
        orders: Orders {
            push: push.is_some(),
            target_x: x,
            target_y: y,
            settings: Settings {
                speed: vec![speed],
                acceleration_time: vec![times[0]],
                deceleration_time: vec![times[1]],
            },
            halt,
        },
        clear: false,
    }
}

/// The commands that stand.
fn command(simulator: &Simulator<LinearInterpolator>) -> [i64; 2] {
    let q = &simulator.signals().p.switch.q;
    simulator.state(|now| [q.x, q.y].map(|at| now.get(at)))
}

/// Outputs of a tick.
struct Seen {
    start: bool,
    load: bool,
    busy: bool,
    late: bool,
    refused: bool,
}

/// The interpolator with its scan.
struct Run {
    simulator: Simulator<LinearInterpolator>,
    scan: u64,
    /// Every command with the tick in which it began to stand.
    points: Vec<(u64, [i64; 2])>,
    late: bool,
    refused: bool,
}

impl Run {
    fn new(at_power_on: &Simulator<LinearInterpolator>, scan: u64) -> Self {
        Run {
            simulator: at_power_on.clone(),
            scan,
            points: Vec::new(),
            late: false,
            refused: false,
        }
    }

    fn command(&self) -> [i64; 2] {
        command(&self.simulator)
    }

    fn tick(&mut self, push: Option<Target>, abort: bool) -> Seen {
        let scan = self.simulator.tick() % self.scan == self.scan - 1;
        let before = self.command();
        let i = ports(scan, push, abort);
        // By places, as whole records take longer than the tick itself.
        let seen = self
            .simulator
            .step_with(&i, |now| Seen {
                start: now.see(|s| s.w.start),
                load: now.see(|s| s.w.load),
                busy: now.see(|s| s.w.busy),
                late: now.see(|s| s.w.late),
                refused: now.see(|s| s.w.refused),
            })
            .unwrap();
        self.late |= seen.late;
        self.refused |= seen.refused;
        assert!(seen.load || self.command() == before, "moved by itself");
        if seen.load {
            // The commands of a scan stand exactly as long after it as is said.
            let tick = self.simulator.tick();
            let since = tick - SCAN + 1;
            assert_eq!(since % self.scan, 0, "tick {tick}");
            self.points.push((tick, self.command()));
        }
        seen
    }

    /// Until the cycle is over.
    fn finish(&mut self) {
        for _ in 0..5_000 {
            if !self.tick(None, false).busy {
                return;
            }
        }
        panic!("it does not end");
    }

    /// A whole cycle; the points that it commands.
    fn go(&mut self, target: Target) -> Vec<[i64; 2]> {
        let from = self.points.len();
        self.tick(Some(target), false);
        self.finish();
        self.points[from..]
            .iter()
            .map(|(_, point)| *point)
            .collect()
    }
}

fn shapes() -> impl Iterator<Item = (u64, [u64; 2])> {
    let times = [[1, 1], [2, 3], [3, 1]];
    [3, 4, 12, 31]
        .into_iter()
        .flat_map(move |speed| times.map(|times| (speed, times)))
}

/// Returns true if a point is where the rule puts the slave on the line from `from` by `delta`.
fn on_the_line(rule: Rule, from: [i64; 2], delta: [i64; 2], point: [i64; 2]) -> bool {
    let master = usize::from(delta[0].abs() < delta[1].abs());
    on_the_line_of(master, rule, (from, delta), point)
}

/// Returns true if the point is right with this master.
fn on_the_line_of(
    master: usize,
    rule: Rule,
    (from, delta): ([i64; 2], [i64; 2]),
    point: [i64; 2],
) -> bool {
    let slave = 1 - master;
    let (moved, ideal) = (point[master] - from[master], |moved: i64| {
        delta[slave] as f64 * moved as f64 / delta[master] as f64
    });
    let (at, ideal) = ((point[slave] - from[slave]) as f64, ideal(moved));
    match rule {
        Rule::Floor => at == ideal.floor(),
        Rule::Centred => (at - ideal).abs() <= 0.5,
        Rule::Truncating => (at - ideal).abs() < 1.0,
    }
}

#[test]
#[ignore = "takes long"]
fn every_cycle_runs_on_its_line_and_ends_exactly() {
    for rule in [Rule::Floor, Rule::Truncating, Rule::Centred] {
        let circuit = at_power_on(rule);
        let mut cycles = 0;
        for (speed, times) in shapes() {
            for x in WORDS {
                for y in WORDS {
                    let mut run = Run::new(&circuit, SCAN);
                    let target = Target { x, y, speed, times };
                    let points = run.go(target);
                    let case = format!("{rule:?} {target:?}: {points:?}");
                    assert!(!run.late && !run.refused, "{case}");
                    assert_eq!(run.command(), [x, y], "{case}");
                    let mut last = [0, 0];
                    for point in points {
                        assert!(on_the_line(rule, [0, 0], [x, y], point), "{case}");
                        let moved = [0, 1].map(|axis| point[axis] - last[axis]);
                        // Towards the target, within the speed, the slave no faster.
                        let longest = x.abs().max(y.abs());
                        for (moved, delta) in moved.into_iter().zip([x, y]) {
                            assert!(moved.signum() * delta.signum() >= 0, "{case}");
                            assert!(moved.unsigned_abs() <= speed.div_ceil(4), "{case}");
                        }
                        let master = usize::from(x.abs() < y.abs());
                        assert!(moved[1 - master].abs() <= moved[master].abs(), "{case}");
                        assert!(longest > 0, "{case}");
                        last = point;
                    }
                    cycles += 1;
                }
            }
        }
        assert_eq!(cycles, 12 * 1024);
    }
}

/// Claim 1: one axis leads, however short its way is; where it stands, the other one does.
#[test]
#[ignore = "takes long"]
fn with_a_fixed_master_every_cycle_runs_on_its_line_and_ends_exactly() {
    for (rule, fixed, axis) in [
        (Rule::Floor, MasterAxis::X, 0),
        (Rule::Centred, MasterAxis::X, 0),
        (Rule::Floor, MasterAxis::Y, 1),
        (Rule::Truncating, MasterAxis::Y, 1),
    ] {
        let circuit = led(rule, fixed);
        let mut faster = 0;
        for (speed, times) in shapes() {
            for x in WORDS {
                for y in WORDS {
                    let delta = [x, y];
                    let master = if delta[axis] == 0 { 1 - axis } else { axis };
                    let mut run = Run::new(&circuit, SCAN);
                    let points = run.go(Target { x, y, speed, times });
                    let case =
                        format!("{rule:?} {fixed:?} {x}, {y}, {speed}, {times:?}: {points:?}");
                    assert!(!run.late && !run.refused, "{case}");
                    assert_eq!(run.command(), delta, "{case}");
                    let mut last = [0, 0];
                    for point in points {
                        let line = ([0, 0], delta);
                        assert!(on_the_line_of(master, rule, line, point), "{case}");
                        let moved = [0, 1].map(|axis| point[axis] - last[axis]);
                        for (moved, delta) in moved.into_iter().zip(delta) {
                            assert!(moved.signum() * delta.signum() >= 0, "{case}");
                        }
                        // The speed is that of the master; nothing bounds the slave.
                        assert!(moved[master].unsigned_abs() <= speed.div_ceil(4), "{case}");
                        faster += u32::from(moved[1 - master].abs() > moved[master].abs());
                        last = point;
                    }
                }
            }
        }
        assert!(faster > 10_000, "{faster}");
    }
}

#[test]
fn x_and_y_exchanged_give_the_path_exchanged() {
    for rule in [Rule::Floor, Rule::Truncating, Rule::Centred] {
        let circuit = at_power_on(rule);
        let (speed, times) = (12, [2, 3]);
        for x in WORDS {
            for y in WORDS {
                let go = |x, y| Run::new(&circuit, SCAN).go(Target { x, y, speed, times });
                let exchanged: Vec<_> = go(y, x).into_iter().map(|[x, y]| [y, x]).collect();
                // Where both distances are alike X is the master in either: the same points still.
                assert_eq!(go(x, y), exchanged, "{rule:?} {x}, {y}");
            }
        }
    }
}

#[test]
#[ignore = "takes long"]
fn the_way_back_goes_over_points_of_the_same_line() {
    let circuit = at_power_on(Rule::Floor);
    for (speed, times) in shapes() {
        for x in WORDS.start + 1..WORDS.end {
            for y in WORDS.start + 1..WORDS.end {
                let mut run = Run::new(&circuit, SCAN);
                run.go(Target { x, y, speed, times });
                for point in run.go(Target {
                    x: 0,
                    y: 0,
                    speed,
                    times,
                }) {
                    let case = format!("{x}, {y}: {point:?}");
                    assert!(on_the_line(Rule::Floor, [0, 0], [x, y], point), "{case}");
                }
                assert_eq!(run.command(), [0, 0]);
            }
        }
    }
}

/// An abort after every scan of many cycles, and at every tick of a few, with a new target in the
/// same tick or later: it stops on the line, and the new cycle ends exactly.
#[test]
fn an_abort_stops_on_the_line_and_leaves_nothing_behind() {
    // Within reach of every place where a cycle may stop.
    let next = Target {
        x: -1,
        y: -1,
        speed: 16,
        times: [2, 2],
    };
    let circuit = at_power_on(Rule::Floor);
    let mut aborted = 0;
    let mut check = |x: i64, y: i64, speed, times, at: u64, with: bool| {
        let mut run = Run::new(&circuit, SCAN);
        run.tick(Some(Target { x, y, speed, times }), false);
        for _ in 0..at {
            if !run.tick(None, false).busy {
                return false;
            }
        }
        run.tick(with.then_some(next), true);
        let case = format!("{x}, {y} at {speed}, {times:?}, abort at {at}, {with}");
        let stopped = if with {
            // The next cycle begins where this one stops: the last point before its start.
            loop {
                let before = run.command();
                if run.tick(None, false).start {
                    break before;
                }
            }
        } else {
            run.finish();
            run.command()
        };
        assert!(
            on_the_line(Rule::Floor, [0, 0], [x, y], stopped) || stopped == [0, 0],
            "{case}"
        );
        assert!(
            stopped[0].abs() <= x.abs() && stopped[1].abs() <= y.abs(),
            "{case}"
        );
        aborted += u32::from(stopped != [x, y]);
        let from = run.points.len();
        if with {
            run.finish();
        } else {
            run.go(next);
        }
        assert_eq!(run.command(), [next.x, next.y], "{case}");
        assert!(!run.late && !run.refused, "{case}");
        let delta = [next.x - stopped[0], next.y - stopped[1]];
        for (_, point) in &run.points[from..] {
            assert!(
                on_the_line(Rule::Floor, stopped, delta, *point),
                "{case}: {point:?}"
            );
        }
        true
    };
    for (speed, times) in [(12, [2, 3]), (31, [3, 1])] {
        for x in (WORDS.start..WORDS.end).step_by(3) {
            for y in (WORDS.start..WORDS.end).step_by(2) {
                for scan in 1.. {
                    if !check(x, y, speed, times, scan * SCAN, scan % 2 == 0) {
                        break;
                    }
                }
            }
        }
    }
    for at in 0.. {
        if !check(13, -6, 20, [2, 1], at, at % 2 == 1) {
            break;
        }
    }
    println!("{aborted} stopped on the way");
    assert!(aborted > 1_000);
}

#[test]
fn a_scan_that_is_a_tick_too_short_is_late_and_the_line_still_holds() {
    let circuit = at_power_on(Rule::Floor);
    for scan in [SCAN - 1, SCAN / 2, 1] {
        let mut run = Run::new(&circuit, scan);
        run.tick(
            Some(Target {
                x: 13,
                y: 5,
                speed: 16,
                times: [2, 2],
            }),
            false,
        );
        let mut late = false;
        for _ in 0..3_000 {
            late |= run.tick(None, false).late;
        }
        assert!(late, "{scan}");
        assert_eq!(run.command(), [13, 5], "{scan}");
    }
}

/// With a target waiting: from the last load of a cycle on.
#[test]
fn the_next_cycle_takes_a_scan_after_the_turnaround_and_not_before() {
    let target = |x| Target {
        x,
        y: 2,
        speed: 12,
        times: [1, 1],
    };
    let mut simulator = at_power_on(Rule::Floor);
    for x in [9, -5] {
        simulator
            .step_with(&ports(false, Some(target(x)), false), |_| ())
            .unwrap();
    }
    // The run after the last load before the second cycle begins.
    let (mut loaded, mut starts) = (simulator.clone(), 0);
    while starts < 2 {
        let scan = simulator.tick().is_multiple_of(SCAN);
        let i = ports(scan, None, false);
        let (load, start) = simulator
            .step_with(&i, |now| (now.w.load, now.w.start))
            .unwrap();
        starts += u32::from(start);
        if load {
            loaded = simulator.clone();
        }
    }
    assert_eq!(command(&loaded)[0], 9);
    let is_taken = |ticks: u64| {
        let mut run = loaded.clone();
        for tick in 1..=ticks {
            run.step_with(&ports(tick == ticks, None, false), |_| ())
                .unwrap();
        }
        run.see(|s| s.p.sequencer.q.advance)
    };
    let first = (1..1_000).find(|ticks| is_taken(*ticks));
    let turnaround = small(Rule::Floor, MasterAxis::Longer).turnaround();
    assert_eq!(first, Some(turnaround));
    assert!(is_taken(turnaround + 7));
}

#[test]
fn a_target_out_of_reach_is_refused_and_the_next_one_taken() {
    let circuit = at_power_on(Rule::Floor);
    for (x, y) in [(-16, 0), (0, -16), (-2, 3), (-3, 3)] {
        let mut run = Run::new(&circuit, SCAN);
        run.go(Target {
            x: 14,
            y: 14,
            speed: 31,
            times: [1, 1],
        });
        let points = run.go(Target {
            x,
            y,
            speed: 31,
            times: [1, 1],
        });
        let far = 14 - x > 16 || 14 - y > 16;
        assert_eq!((run.refused, points.is_empty()), (far, far), "{x}, {y}");
        run.go(Target {
            x: 3,
            y: 4,
            speed: 31,
            times: [1, 1],
        });
        assert_eq!(run.command(), [3, 4]);
    }
}

/// One cycle at full width, tick for tick as the default circuit is built.
#[test]
fn a_long_line_at_full_width() {
    let circuit = LinearInterpolator::default();
    let (x, y) = (1_999_999_999i64, -1_234_567_891);
    let target = Target {
        x,
        y,
        // A million counts.
        speed: 1_000_000 << 12,
        times: [20, 35],
    };
    let mut simulator = LastTicks::simulator(&circuit).unwrap();
    let mut points = Vec::new();
    for tick in 0..2100 * circuit.latency() {
        let mut i = ports(tick % circuit.latency() == 0, Some(target), false);
        i.orders.push = tick == 0;
        let (loaded, late) = simulator
            .step_with(&i, |now| (now.w.load, now.w.late))
            .unwrap();
        assert!(!late);
        if loaded {
            points.push(command(&simulator));
        }
    }
    // Tc = ceil((2·1,999,999,999 − 1,000,000·55) / 2,000,000) = 1973.
    assert_eq!(points.len(), 20 + 1973 + 35);
    assert_eq!(points.last(), Some(&[x, y]));
    for [at_x, at_y] in points {
        let exact = i128::from(y) * i128::from(at_x);
        assert_eq!(i128::from(at_y), exact.div_euclid(i128::from(x)));
    }
}
