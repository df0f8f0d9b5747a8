//! The integrator at 5 bits: every Δx, Δy, and every sequence of increments that stays on the
//! segment, monotone or not and of any length. A sequence leads from one state at rest to the next,
//! so every state is tried with every increment.

use motion_rtl::circuits::linear_interpolator::integrator::In;
use motion_rtl::circuits::linear_interpolator::{Integrator, Rule};
use motion_rtl::sim::{Simulator, State};
use motion_rtl::trace::LastTicks;
use std::collections::HashSet;

const P: usize = 5;
const LATENCY: u64 = small(Rule::Floor).latency();
const WORDS: std::ops::Range<i64> = -(1 << (P - 1))..1 << (P - 1);

const fn small(rule: Rule) -> Integrator {
    Integrator { position: P, rule }
}

/// A simulator that leaves its waves if the test fails.
fn recorded(rule: Rule) -> Simulator<Integrator> {
    LastTicks::simulator(&small(rule)).unwrap()
}

/// A simulator to be copied.
fn at_power_on(rule: Rule) -> Simulator<Integrator> {
    let mut simulator = Simulator::new(&small(rule)).unwrap();
    simulator.compile();
    simulator
}

/// An integrator in the middle of a cycle.
#[derive(Clone)]
struct Cycle {
    simulator: Simulator<Integrator>,
    master: i64,
    slave: i64,
}

impl Cycle {
    fn begin(simulator: Simulator<Integrator>, master: i64, slave: i64) -> Self {
        let mut cycle = Cycle {
            simulator,
            master,
            slave,
        };
        cycle.tick(true, None);
        cycle
    }

    /// One tick; tells whether `valid` stood in it.
    fn tick(&mut self, clear: bool, increment: Option<i64>) -> bool {
        let i = In {
            clear,
            master: self.master,
            slave: self.slave,
            start: increment.is_some(),
            increment: increment.unwrap_or(0),
        };
        self.simulator
            .step_with(&i, |now| now.see(|s| s.w.valid))
            .unwrap()
    }

    /// Takes an increment; `valid` stands in the tick that it should, and in no other.
    fn scan(&mut self, increment: i64) {
        assert!(!self.tick(false, Some(increment)));
        for tick in 1..=LATENCY {
            let valid = self.tick(false, None);
            assert_eq!(valid, tick == LATENCY, "tick {tick}");
        }
    }

    /// I and B.
    fn words(&self) -> (i64, i64) {
        let q = &self.simulator.signals().p.accumulator.q;
        let words = |now: &State<'_, _>| (now.get(q.integral), now.get(q.remainder));
        self.simulator.state(words)
    }
}

/// A cycle that is repeated for its waves if an assertion fails meanwhile: a copy of a simulator
/// has none.
struct Waves<'a> {
    rule: Rule,
    /// Δx and Δy.
    distances: [i64; 2],
    increments: &'a [i64],
}

impl Drop for Waves<'_> {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            return;
        }
        let [master, slave] = self.distances;
        let mut cycle = Cycle::begin(recorded(self.rule), master, slave);
        for &increment in self.increments {
            cycle.tick(false, Some(increment));
            for _ in 0..LATENCY {
                cycle.tick(false, None);
            }
        }
    }
}

/// Every state of a cycle, with the sum of the increments that lead there.
fn explore(
    at_power_on: &Simulator<Integrator>,
    master: i64,
    slave: i64,
    mut look: impl FnMut(i64, i64, [i64; 4]),
) {
    let mut seen = HashSet::new();
    let first = Cycle::begin(at_power_on.clone(), master, slave);
    let (_, first_remainder) = first.words();
    let mut open = vec![(first, vec![])];
    while let Some((at, path)) = open.pop() {
        let sum: i64 = path.iter().sum();
        let (integral, remainder) = at.words();
        if !seen.insert((sum, integral, remainder)) {
            continue;
        }
        let ends = [0.min(master), 0.max(master)];
        for to in ends[0]..=ends[1] {
            let increment = to - sum;
            if !WORDS.contains(&increment) {
                continue;
            }
            let increments = [&path[..], &[increment]].concat();
            let _waves = Waves {
                rule: at_power_on.circuit().rule,
                distances: [master, slave],
                increments: &increments,
            };
            let mut cycle = at.clone();
            cycle.scan(increment);
            let (after, left) = cycle.words();
            look(
                increment,
                after - integral,
                [to, after, left, first_remainder],
            );
            open.push((cycle, increments.clone()));
        }
    }
}

/// `a / b`, rounded towards minus infinity.
fn floor(a: i64, b: i64) -> i64 {
    (a as f64 / b as f64).floor() as i64
}

#[test]
fn the_slave_is_on_the_line_after_every_sequence_of_increments() {
    for rule in [Rule::Floor, Rule::Truncating, Rule::Centred] {
        let circuit = at_power_on(rule);
        let mut scans = 0u64;
        for master in WORDS.filter(|&master| master != 0) {
            for slave in WORDS {
                explore(
                    &circuit,
                    master,
                    slave,
                    |increment, step, [sum, integral, remainder, first]| {
                        scans += 1;
                        let case = format!("{rule:?}: {master}, {slave} at {sum} by {increment}");
                        assert_eq!(master * integral + remainder, slave * sum + first, "{case}");
                        assert!(remainder.abs() < master.abs(), "{case}: B = {remainder}");
                        if slave.abs() <= master.abs() {
                            assert!(step.abs() <= increment.abs(), "{case}: δy = {step}");
                        }
                        if sum == master {
                            assert_eq!((integral, remainder), (slave, first), "{case}");
                        }
                        match rule {
                            // A function of the position alone, whatever led there.
                            Rule::Floor => {
                                assert_eq!(integral, floor(slave * sum, master), "{case}")
                            }
                            Rule::Centred => {
                                assert_eq!(first, master / 2, "{case}");
                                assert_eq!(integral, floor(slave * sum + first, master), "{case}");
                            }
                            Rule::Truncating => assert_eq!(first, 0, "{case}"),
                        }
                    },
                );
            }
        }
        println!("{rule:?}: {scans} scans");
        assert!(scans > 100_000);
    }
}

/// The way from a point and back, by any increments: the points that the slave goes over.
#[test]
fn the_way_back_goes_over_the_same_points_with_the_floor_and_not_with_truncation() {
    let differs = |rule| {
        let circuit = at_power_on(rule);
        let mut wrong = 0;
        for master in 1..WORDS.end {
            for slave in WORDS.start + 1..WORDS.end {
                let walk = |from: i64, way: i64| -> Vec<i64> {
                    let mut cycle = Cycle::begin(circuit.clone(), way * master, way * slave);
                    let mut points = vec![from];
                    for _ in 0..master {
                        cycle.scan(way);
                        points.push(from + cycle.words().0);
                    }
                    points
                };
                let forth = walk(0, 1);
                let mut back = walk(slave, -1);
                back.reverse();
                wrong += u32::from(forth != back);
            }
        }
        wrong
    };
    assert_eq!(differs(Rule::Floor), 0);
    assert!(differs(Rule::Truncating) > 100);
}

/// Bresenham's line in its first octant, from its paper's decision variable.
fn bresenham(dx: i64, dy: i64) -> Vec<i64> {
    let (mut decision, mut y) = (2 * dy - dx, 0);
    let mut ys = Vec::new();
    for _ in 0..dx {
        if decision >= 0 {
            y += 1;
            decision -= 2 * dx;
        }
        decision += 2 * dy;
        ys.push(y);
    }
    ys
}

#[test]
fn unit_increments_draw_bresenhams_line() {
    for dx in 1..WORDS.end {
        for dy in 0..=dx {
            let mut cycle = Cycle::begin(recorded(Rule::Centred), dx, dy);
            let ys: Vec<i64> = (0..dx)
                .map(|_| {
                    cycle.scan(1);
                    cycle.words().0
                })
                .collect();
            assert_eq!(ys, bresenham(dx, dy), "{dx}, {dy}");
        }
    }
}

/// The text does not mention the B left by an aborted cycle.
#[test]
fn a_stale_remainder_ends_in_the_wrong_place() {
    let (mut wrong, mut all) = (0, 0);
    for master in 1..10 {
        for slave in 0..=master {
            for broken_off in 1..master {
                for cleared in [true, false] {
                    let mut cycle = Cycle::begin(recorded(Rule::Floor), master, slave);
                    cycle.scan(broken_off);
                    let (before, _) = cycle.words();
                    (cycle.master, cycle.slave) = (7, 5);
                    if cleared {
                        cycle.tick(true, None);
                    }
                    cycle.scan(4);
                    cycle.scan(3);
                    let moved = cycle.words().0 - if cleared { 0 } else { before };
                    if cleared {
                        assert_eq!(moved, 5);
                    } else {
                        all += 1;
                        wrong += u32::from(moved != 5);
                    }
                }
            }
        }
    }
    println!("{wrong} of {all}");
    assert!(wrong > all / 20);
}

#[test]
fn a_start_that_comes_too_early_and_a_clear_in_mid_division_leave_nothing_behind() {
    for tick in 0..=LATENCY {
        let mut cycle = Cycle::begin(recorded(Rule::Floor), 7, 3);
        cycle.tick(false, Some(5));
        let mut valid = 0;
        for at in 1..=LATENCY {
            let early = (at == tick).then_some(1);
            // A start is taken again in the tick in which the result shows.
            valid += u32::from(cycle.tick(false, early.filter(|_| at < LATENCY)));
        }
        assert_eq!((valid, cycle.words()), (1, (2, 1)), "start at {tick}");

        let mut cycle = Cycle::begin(recorded(Rule::Floor), 7, 3);
        cycle.tick(false, Some(5));
        for _ in 1..tick {
            cycle.tick(false, None);
        }
        (cycle.master, cycle.slave) = (9, 4);
        cycle.tick(true, None);
        for _ in 0..LATENCY {
            let valid = cycle.tick(false, None);
            assert!(!valid, "cleared at {tick}");
        }
        assert_eq!(cycle.words(), (0, 0), "cleared at {tick}");
        cycle.scan(9);
        assert_eq!(cycle.words(), (4, 0), "cleared at {tick}");
    }
}

#[test]
fn a_master_that_does_not_move_divides_nothing() {
    let mut simulator = recorded(Rule::Floor);
    for tick in 0..3 * LATENCY {
        let i = In {
            clear: tick == 0,
            master: 0,
            slave: 5,
            start: true,
            increment: 3,
        };
        assert!(
            !simulator
                .step_with(&i, |now| now.w.valid || now.w.busy)
                .unwrap()
        );
    }
}
