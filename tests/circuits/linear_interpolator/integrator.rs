//! The integrator at 5 bits: every Δx, Δy, and every sequence of increments that stays on the
//! segment, monotone or not and of any length. A sequence leads from one state at rest to the next,
//! so every state is tried with every increment.

use motion_rtl::kernel::{Circuit, Simulator};
use motion_rtl::linear_interpolator::integrator::{In, Reg};
use motion_rtl::linear_interpolator::{Integrator, Rule};
use motion_rtl::logic::Sim;
use std::collections::HashSet;

const P: usize = 5;
type Small = Integrator<P, { 2 * P }>;
const WORDS: std::ops::Range<i64> = -(1 << (P - 1))..1 << (P - 1);

/// An integrator in the middle of a cycle.
struct Cycle<'a> {
    circuit: &'a Small,
    q: Reg<Sim, P, { 2 * P }>,
    master: i64,
    slave: i64,
}

impl<'a> Cycle<'a> {
    fn begin(circuit: &'a Small, master: i64, slave: i64) -> Self {
        let mut cycle = Cycle {
            circuit,
            q: circuit.power_on(),
            master,
            slave,
        };
        cycle.tick(true, None);
        cycle
    }

    /// One tick; tells whether `valid` stood in it.
    fn tick(&mut self, clear: bool, increment: Option<i64>) -> bool {
        let i = In {
            clear: clear.into(),
            master: self.master.into(),
            slave: self.slave.into(),
            start: increment.is_some().into(),
            increment: increment.unwrap_or(0).into(),
        };
        let w = self.circuit.comb(&self.q, &i);
        self.q = self.circuit.next(self.q.clone(), &w, &i);
        w.valid.get()
    }

    /// Takes an increment; `valid` stands in the tick that it should, and in no other.
    fn scan(&mut self, increment: i64) {
        assert!(!self.tick(false, Some(increment)));
        for tick in 1..=Small::LATENCY {
            let valid = self.tick(false, None);
            assert_eq!(valid, tick == Small::LATENCY, "tick {tick}");
        }
    }

    /// I and B.
    fn words(&self) -> (i64, i64) {
        let q = &self.q.accumulator;
        (q.integral.get(), q.remainder.get())
    }
}

/// Every state of a cycle, with the sum of the increments that lead there, under `rule`.
fn explore(circuit: &Small, master: i64, slave: i64, mut look: impl FnMut(i64, i64, [i64; 4])) {
    let mut seen = HashSet::new();
    let first = Cycle::begin(circuit, master, slave);
    let (_, first_remainder) = first.words();
    let mut open = vec![(0, first.q)];
    while let Some((sum, q)) = open.pop() {
        let (integral, remainder) = {
            let words = &q.accumulator;
            (words.integral.get(), words.remainder.get())
        };
        if !seen.insert((sum, integral, remainder)) {
            continue;
        }
        let ends = [0.min(master), 0.max(master)];
        for to in ends[0]..=ends[1] {
            let increment = to - sum;
            if !WORDS.contains(&increment) {
                continue;
            }
            let mut cycle = Cycle {
                circuit,
                q: q.clone(),
                master,
                slave,
            };
            cycle.scan(increment);
            let (after, left) = cycle.words();
            look(
                increment,
                after - integral,
                [to, after, left, first_remainder],
            );
            open.push((to, cycle.q));
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
        let circuit = Small::new(rule);
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
        let circuit = Small::new(rule);
        let mut wrong = 0;
        for master in 1..WORDS.end {
            for slave in WORDS.start + 1..WORDS.end {
                let walk = |from: i64, way: i64| -> Vec<i64> {
                    let mut cycle = Cycle::begin(&circuit, way * master, way * slave);
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
    let circuit = Small::new(Rule::Centred);
    for dx in 1..WORDS.end {
        for dy in 0..=dx {
            let mut cycle = Cycle::begin(&circuit, dx, dy);
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

/// What the text is silent of: B that is left by a cycle that was broken off.
#[test]
fn a_stale_remainder_ends_in_the_wrong_place() {
    let circuit = Small::new(Rule::Floor);
    let (mut wrong, mut all) = (0, 0);
    for master in 1..10 {
        for slave in 0..=master {
            for broken_off in 1..master {
                for cleared in [true, false] {
                    let mut cycle = Cycle::begin(&circuit, master, slave);
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
    let circuit = Small::new(Rule::Floor);
    for tick in 0..=Small::LATENCY {
        let mut cycle = Cycle::begin(&circuit, 7, 3);
        cycle.tick(false, Some(5));
        let mut valid = 0;
        for at in 1..=Small::LATENCY {
            let early = (at == tick).then_some(1);
            // A start is taken again in the tick in which the result shows.
            valid += u32::from(cycle.tick(false, early.filter(|_| at < Small::LATENCY)));
        }
        assert_eq!((valid, cycle.words()), (1, (2, 1)), "start at {tick}");

        let mut cycle = Cycle::begin(&circuit, 7, 3);
        cycle.tick(false, Some(5));
        for _ in 1..tick {
            cycle.tick(false, None);
        }
        (cycle.master, cycle.slave) = (9, 4);
        cycle.tick(true, None);
        for _ in 0..Small::LATENCY {
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
    let circuit = Small::new(Rule::Floor);
    let mut simulator = Simulator::new(&circuit).unwrap();
    for tick in 0..3 * Small::LATENCY {
        let i = In {
            clear: (tick == 0).into(),
            master: 0.into(),
            slave: 5.into(),
            start: true.into(),
            increment: 3.into(),
        };
        let (next, valid) = simulator.step(i, |now| now.w.valid.get() || now.w.busy.get());
        assert!(!valid);
        simulator = next;
    }
}
