//! Whole positioning cycles through the interpolator at 5 bits, with scans as short as they may
//! be.

use motion_rtl::kernel::{Circuit, Simulator};
use motion_rtl::linear_interpolator::interpolator::{In, Net, Reg};
use motion_rtl::linear_interpolator::{LinearInterpolator, Rule};
use motion_rtl::logic::Sim;

type Small = LinearInterpolator<2, 5, 2, 5, 11, 10>;
type SmallReg = Reg<Sim, 2, 5, 2, 5, 11, 10>;
type SmallNet = Net<Sim, 2, 5, 2, 5, 11, 10>;
const WORDS: std::ops::Range<i64> = -16..16;
const SCAN: u64 = Small::LATENCY;

/// Where to, how fast in quarters of a count a scan, and with which times.
#[derive(Debug, Clone, Copy)]
struct Target {
    x: i64,
    y: i64,
    speed: u64,
    times: [u64; 2],
}

/// The interpolator with its scan.
struct Run<'a> {
    circuit: &'a Small,
    q: SmallReg,
    tick: u64,
    scan: u64,
    /// Every command with the tick in which it began to stand.
    points: Vec<(u64, [i64; 2])>,
    late: bool,
    refused: bool,
}

impl<'a> Run<'a> {
    fn new(circuit: &'a Small, scan: u64) -> Self {
        Run {
            circuit,
            q: circuit.power_on(),
            tick: 0,
            scan,
            points: Vec::new(),
            late: false,
            refused: false,
        }
    }

    fn command(&self) -> [i64; 2] {
        [self.q.switch.x.get(), self.q.switch.y.get()]
    }

    fn tick(&mut self, push: Option<Target>, abort: bool) -> SmallNet {
        let target = push.unwrap_or(Target {
            x: 0,
            y: 0,
            speed: 0,
            times: [0, 0],
        });
        let i = In {
            scan: (self.tick % self.scan == self.scan - 1).into(),
            hold: false.into(),
            push: push.is_some().into(),
            target_x: target.x.into(),
            target_y: target.y.into(),
            speed: target.speed.into(),
            acceleration_time: target.times[0].into(),
            deceleration_time: target.times[1].into(),
            halt: abort.into(),
            clear: false.into(),
        };
        let before = self.command();
        let w = self.circuit.comb(&self.q, &i);
        self.q = self.circuit.next(self.q.clone(), &w, &i);
        self.tick += 1;
        self.late |= w.late.get();
        self.refused |= w.refused.get();
        let loaded = w.load.get();
        assert!(loaded || self.command() == before, "moved by itself");
        if loaded {
            // The commands of a scan stand exactly as long after it as is said.
            let since = self.tick - Small::LATENCY + 1;
            assert_eq!(since % self.scan, 0, "tick {}", self.tick);
            self.points.push((self.tick, self.command()));
        }
        w
    }

    /// Until the cycle is over.
    fn finish(&mut self) {
        for _ in 0..5_000 {
            if !self.tick(None, false).busy.get() {
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

/// Whether a point is where the rule puts the slave on the line from `from` by `delta`.
fn on_the_line(rule: Rule, from: [i64; 2], delta: [i64; 2], point: [i64; 2]) -> bool {
    let master = usize::from(delta[0].abs() < delta[1].abs());
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
fn every_cycle_runs_on_its_line_and_ends_exactly() {
    for rule in [Rule::Floor, Rule::Truncating, Rule::Centred] {
        let circuit = Small::new(rule);
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

#[test]
fn x_and_y_exchanged_give_the_path_exchanged() {
    for rule in [Rule::Floor, Rule::Truncating, Rule::Centred] {
        let circuit = Small::new(rule);
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
fn the_way_back_goes_over_points_of_the_same_line() {
    let circuit = Small::new(Rule::Floor);
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
    let circuit = Small::new(Rule::Floor);
    let mut aborted = 0;
    let mut check = |x: i64, y: i64, speed, times, at: u64, with: bool| {
        let mut run = Run::new(&circuit, SCAN);
        run.tick(Some(Target { x, y, speed, times }), false);
        for _ in 0..at {
            if !run.tick(None, false).busy.get() {
                return false;
            }
        }
        run.tick(with.then_some(next), true);
        let case = format!("{x}, {y} at {speed}, {times:?}, abort at {at}, {with}");
        let stopped = if with {
            // The next cycle begins where this one stops: the last point before its start.
            loop {
                let before = run.command();
                if run.tick(None, false).start.get() {
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
    let circuit = Small::new(Rule::Floor);
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
            late |= run.tick(None, false).late.get();
        }
        assert!(late, "{scan}");
        assert_eq!(run.command(), [13, 5], "{scan}");
    }
}

/// With a target waiting: from the last load of a cycle on.
#[test]
fn the_next_cycle_takes_a_scan_after_the_turnaround_and_not_before() {
    let circuit = Small::new(Rule::Floor);
    let inputs = |scan: bool, x: Option<i64>| In {
        scan: scan.into(),
        hold: false.into(),
        push: x.is_some().into(),
        target_x: x.unwrap_or(0).into(),
        target_y: 2.into(),
        speed: 12.into(),
        acceleration_time: 1.into(),
        deceleration_time: 1.into(),
        halt: false.into(),
        clear: false.into(),
    };
    let mut simulator = Simulator::new(&circuit).unwrap();
    for x in [9, -5] {
        simulator = simulator.step(inputs(false, Some(x)), |_| ()).0;
    }
    // The run after the last load before the second cycle begins.
    let (mut loaded, mut starts) = (simulator.clone(), 0);
    while starts < 2 {
        let scan = simulator.tick().is_multiple_of(SCAN);
        let (next, (load, start)) = simulator.step(inputs(scan, None), |now| {
            (now.w.load.get(), now.w.start.get())
        });
        simulator = next;
        starts += u32::from(start);
        if load {
            loaded = simulator.clone();
        }
    }
    assert_eq!(loaded.registers().switch.x.get(), 9);
    let is_taken = |ticks: u64| {
        let mut run = loaded.clone();
        for tick in 1..=ticks {
            run = run.step(inputs(tick == ticks, None), |_| ()).0;
        }
        run.registers().sequencer.advance.get()
    };
    let first = (1..1_000).find(|ticks| is_taken(*ticks));
    assert_eq!(first, Some(Small::TURNAROUND));
    assert!(is_taken(Small::TURNAROUND + 7));
}

#[test]
fn a_target_out_of_reach_is_refused_and_the_next_one_taken() {
    let circuit = Small::new(Rule::Floor);
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
    type Full = LinearInterpolator;
    let circuit = Full::new(Rule::Floor);
    let (x, y) = (1_999_999_999i64, -1_234_567_891);
    let mut simulator = Simulator::new(&circuit).unwrap();
    let mut points = Vec::new();
    for tick in 0..2100 * Full::LATENCY {
        let push = tick == 0;
        let i = In {
            scan: (tick % Full::LATENCY == 0).into(),
            hold: false.into(),
            push: push.into(),
            target_x: x.into(),
            target_y: y.into(),
            // A million counts.
            speed: (1_000_000 << 12).into(),
            acceleration_time: 20.into(),
            deceleration_time: 35.into(),
            halt: false.into(),
            clear: false.into(),
        };
        let (next, (loaded, late)) = simulator.step(i, |now| (now.w.load.get(), now.w.late.get()));
        simulator = next;
        assert!(!late);
        if loaded {
            let q = &simulator.registers().switch;
            points.push([q.x.get(), q.y.get()]);
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
