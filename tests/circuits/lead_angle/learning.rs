//! The correction against plain arithmetic, and what learning comes to.

use motion_rtl::circuits::lead_angle::codes;
use motion_rtl::circuits::lead_angle::correction::In;
use motion_rtl::circuits::lead_angle::{Correction, Division, Function, Sign};
use motion_rtl::sim::Simulator;
use motion_rtl::trace::LastTicks;

/// Result of a correction.
#[derive(Debug, Clone, Copy)]
struct Seen {
    /// Ticks from `complete` to `corrected`.
    ticks: u64,
    /// Δt2, where one is learned.
    learned: Option<u64>,
    /// Δt2 before it was put on the grid.
    raw: u64,
}

/// One positioning from a reset: control signal at −`overrun`, standstill at 0, target at −`error`.
fn correct(
    simulator: &mut Simulator<Correction>,
    [time, seed]: [u64; 2],
    [overrun, error]: [i64; 2],
) -> Seen {
    let input = |fire: bool, complete: bool, position: i64| In {
        fire,
        complete,
        position,
        target: -error,
        lead_time: time,
        learn: true,
        missed: false,
        seed,
    };
    let longest = 2 * simulator.circuit().latency(2);
    simulator.reset();
    simulator
        .step_with(&input(true, false, -overrun), |_| ())
        .unwrap();
    simulator.step_with(&input(false, true, 0), |_| ()).unwrap();
    for ticks in 1..=longest {
        let (corrected, learned, time, raw) = simulator
            .step_with(&input(false, false, 0), |now| {
                let (w, raw) = (now.w, now.p.arithmetic.q.raw);
                (w.corrected, w.learned, w.learned_time, raw)
            })
            .unwrap();
        assert!(corrected || !learned);
        if corrected {
            let learned = learned.then_some(time);
            return Seen {
                ticks,
                learned,
                raw,
            };
        }
    }
    panic!("never corrected");
}

/// The code that a time is put on.
fn snapped(stages: u64, time: u64) -> u64 {
    let grid = codes::grid(stages);
    let above = grid.iter().find(|code| code.time >= time);
    let below = grid.iter().rev().find(|code| code.time <= time);
    match (below, above) {
        (Some(below), Some(above)) if below.ratio == above.ratio => {
            match 2 * time < below.time + above.time {
                true => below.time,
                false => above.time,
            }
        }
        (Some(below), _) => below.time,
        (None, above) => above.map_or(0, |code| code.time),
    }
}

/// Returns true if a function divides twice.
fn twice(function: Function, overrun: i64, error: i64) -> bool {
    function == Function::SecondOrder && error.abs() < overrun.abs()
}

/// Δt1 + Δt·d2/d to the nearest, an error by `sign`, within the codes. d is d1, or by the exact
/// relation d1 − d2 where that has the sign of d1. Δt is Δt1, or to second order the sum with Δt1.
fn expected(
    stages: u64,
    time: u64,
    [overrun, error]: [i64; 2],
    sign: i64,
    function: Function,
) -> u64 {
    let twice = twice(function, overrun, error);
    let (time, overrun, error) = (
        i128::from(time),
        i128::from(overrun),
        i128::from(error * sign),
    );
    let distance = overrun - error;
    let divisor = match function == Function::Exact && distance * overrun > 0 {
        true => distance,
        false => overrun,
    };
    let change = |of: i128| {
        let amount = (2 * of * error.abs() + divisor.abs()) / (2 * divisor.abs());
        amount * error.signum() * divisor.signum()
    };
    let first = time + change(time);
    let sum = if twice { time + change(first) } else { first };
    let sum = sum.clamp(1, 10 * i128::from(stages));
    snapped(stages, sum as u64)
}

/// The correction with so many stages and positions of so many bits.
fn correction(stages: usize, position: usize, sign: Sign, function: Function) -> Correction {
    Correction {
        stages,
        position,
        sign,
        function,
        division: Division::Logic,
    }
}

fn every_correction(stages: u64, position: usize) {
    let half = 1i64 << (position - 1);
    let codes = codes::grid(stages);
    let on_grid = |time: u64| codes.iter().any(|code| code.time == time);
    for (sign, function) in [
        (Sign::Converging, Function::FirstOrder),
        (Sign::Literal, Function::FirstOrder),
        (Sign::Converging, Function::SecondOrder),
        (Sign::Converging, Function::Exact),
        (Sign::Literal, Function::Exact),
    ] {
        let circuit = correction(stages as usize, position, sign, function);
        let mut simulator = Simulator::new(&circuit).unwrap();
        simulator.compile();
        let factor = if sign == Sign::Converging { 1 } else { -1 };
        for time in std::iter::once(0).chain(codes.iter().map(|code| code.time)) {
            for overrun in -half..half {
                for error in -half..half {
                    // The greatest amount has no opposite.
                    if -overrun == half || -error == half {
                        continue;
                    }
                    let (times, ways) = ([time, 2], [overrun, error]);
                    let seen = correct(&mut simulator, times, ways);
                    let (learned, ticks) = match (time, overrun) {
                        (0, _) => ((error != 0).then_some(2), 1),
                        (_, 0) => (None, 1),
                        _ => {
                            let time = expected(stages, time, [overrun, error], factor, function);
                            let divisions = 1 + u64::from(twice(function, overrun, error));
                            (Some(time), circuit.latency(divisions))
                        }
                    };
                    let (seen, due) = ((seen.ticks, seen.learned), (ticks, learned));
                    let _waves = (seen != due).then(|| {
                        let mut again = LastTicks::simulator(&circuit).unwrap();
                        correct(&mut again, times, ways);
                        again
                    });
                    assert_eq!(
                        seen, due,
                        "{time}, {overrun}, {error}, {sign:?}, {function:?}"
                    );
                    assert!(learned.is_none_or(on_grid));
                }
            }
        }
    }
}

#[test]
fn every_correction_of_four_bits_is_right_and_on_the_grid() {
    every_correction(3, 4);
}

#[test]
fn every_correction_of_six_bits_is_right_and_on_the_grid() {
    every_correction(7, 6);
}

/// The correction at full width.
fn full(sign: Sign, function: Function) -> Simulator<Correction> {
    LastTicks::simulator(&correction(199, 24, sign, function)).unwrap()
}

/// Both signs to first order.
fn both_signs() -> (Simulator<Correction>, Simulator<Correction>) {
    let signs = [Sign::Converging, Sign::Literal];
    signs.map(|sign| full(sign, Function::FirstOrder)).into()
}

/// The next time of a body that stops `true_time` CKs after the control signal, at `speed` counts
/// per CK, where the control signal is right but for the lead time.
fn next(simulator: &mut Simulator<Correction>, time: u64, true_time: u64, speed: i64) -> u64 {
    let (overrun, lead) = (speed * true_time as i64, speed * time as i64);
    let seen = correct(simulator, [time, 1], [overrun, overrun - lead]);
    seen.learned.expect("a time")
}

/// Distance between two codes at a time, in CKs.
fn pitch(time: u64) -> f64 {
    codes::grid(199)
        .iter()
        .find(|code| code.time >= time)
        .map_or(10.0, |code| code.ratio as f64)
}

#[test]
fn the_error_is_squared_to_second_order_cubed_by_the_exact_relation_gone_and_literally_it_grows() {
    let (mut right, mut literal) = both_signs();
    let mut second = full(Sign::Converging, Function::SecondOrder);
    let mut exact = full(Sign::Converging, Function::Exact);
    for true_time in [30u64, 150, 350, 900] {
        for share in [0.3, 0.6, 0.9, 1.1, 1.5, 1.9, 2.1, 5.0] {
            for speed in [-40, 3, 1000] {
                let time = snapped(199, (true_time as f64 * share) as u64);
                let r = time as f64 / true_time as f64;
                let near = |time: u64, wanted: f64| {
                    let wanted = (wanted * true_time as f64).clamp(1.0, 1990.0);
                    let off = (time as f64 - wanted).abs();
                    assert!(
                        off <= pitch(time),
                        "{time} where {wanted} is wanted, r = {r}"
                    );
                };
                near(
                    next(&mut right, time, true_time, speed),
                    1.0 - (1.0 - r) * (1.0 - r),
                );
                near(next(&mut literal, time, true_time, speed), r * r);
                let by_second = match r < 2.0 {
                    true => 1.0 - (1.0 - r).powi(3),
                    false => 1.0 - (1.0 - r) * (1.0 - r),
                };
                near(next(&mut second, time, true_time, speed), by_second);
                near(next(&mut exact, time, true_time, speed), 1.0);
            }
        }
    }
}

/// First stops of the shipped turntable by each function: the time, and its code.
/// `tests/jobs/lead_job` has where these overruns and errors come from, and where learning ends.
#[test]
fn the_first_stops_of_the_turntable_by_each_function() {
    let stops = [[366, -134], [1209, 86], [3795, 1549], [-2477, -731]];
    let of = |function| {
        let mut simulator = full(Sign::Converging, function);
        let seen = stops.map(|stop| correct(&mut simulator, [250, 1], stop));
        (
            seen.map(|seen| seen.raw),
            seen.map(|seen| seen.learned.unwrap()),
        )
    };
    let first = ([158, 268, 352, 324], [158, 268, 352, 324]);
    assert_eq!(of(Function::FirstOrder), first);
    let second = ([192, 269, 394, 346], [192, 270, 394, 346]);
    assert_eq!(of(Function::SecondOrder), second);
    let exact = ([183, 269, 422, 355], [183, 270, 420, 356]);
    assert_eq!(of(Function::Exact), exact);
}

/// A target that was not ahead of the body teaches the first order: no way belongs to the lead.
#[test]
fn the_exact_relation_has_ends() {
    let mut simulator = full(Sign::Converging, Function::Exact);
    for (time, ways, learned) in [
        // d1 − d2 of 1: 250·1000 CKs are no code, the last one is.
        (250, [1000, 999], 1990),
        (250, [-1000, -999], 1990),
        // d1 − d2 of 0, and against d1: 250 + 250·1000/1000, 250 + 250·1500/1000 on the grid.
        (250, [1000, 1000], 500),
        (250, [1000, 1500], 625),
        (250, [-1000, -1500], 625),
        // A thousandth of 250 CKs is below a CK.
        (250, [1, -999], 1),
        (250, [-1, 999], 1),
        // The greatest ways, whose difference is a bit wider.
        (250, [8_388_607, -8_388_607], 125),
        (250, [-8_388_607, 8_388_607], 125),
    ] {
        let seen = correct(&mut simulator, [time, 1], ways);
        assert_eq!(seen.learned, Some(learned), "{ways:?}");
    }
}

/// From a third of the true time to nearly twice of it, within six positionings.
#[test]
fn six_positionings_are_enough_and_the_literal_sign_runs_away() {
    let (mut right, mut literal) = both_signs();
    for true_time in [20u64, 57, 150, 333, 700, 1500] {
        for start in [true_time / 3, true_time / 2, true_time * 9 / 5] {
            let (mut time, mut lost) = (snapped(199, start), snapped(199, start));
            for _ in 0..6 {
                time = next(&mut right, time, true_time, 25);
                lost = next(&mut literal, lost, true_time, 25);
            }
            let off = time.abs_diff(true_time) as f64;
            assert!(off <= pitch(true_time), "{start}: {time} for {true_time}");
            // Towards nothing, or to the end of the codes.
            let most = 1990.0f64.min(true_time as f64 * 8.0);
            let away = lost <= true_time / 20 + 1 || lost as f64 >= most;
            assert!(away, "{start}: {lost} for {true_time}");
        }
    }
}

/// A body that comes by, and its brake: counts and CKs.
#[derive(Debug, Clone, Copy)]
struct Body {
    /// Speed at CK 0.
    speed: f64,
    /// Acceleration up to the control signal.
    acceleration: f64,
    /// Deceleration of the brake.
    deceleration: f64,
    /// Where it is at CK 0.
    start: f64,
}

/// CKs until the brake bites.
const DEAD_TIME: f64 = 120.0;

/// Number of stops per step.
const STOPS: usize = 10;

impl Body {
    fn position(&self, ck: u64) -> i64 {
        let ck = ck as f64;
        let way = self.speed * ck + self.acceleration * ck * ck / 2.0;
        (self.start + way).floor() as i64
    }

    /// Overrun and error of a stop with the code `time` at target 0, and what one code is worth.
    fn stop(&self, time: u64) -> ([i64; 2], f64) {
        let code = codes::code(199, time).expect("a code");
        let predicted = |ck: u64| {
            let (present, old) = (self.position(ck), self.position(ck - code.tap));
            present + code.ratio as i64 * (present - old)
        };
        let fired = (code.tap..)
            .find(|ck| predicted(*ck) >= 0)
            .expect("it comes by");
        let speed = self.speed + self.acceleration * fired as f64;
        let way = speed * DEAD_TIME + speed * speed / (2.0 * self.deceleration);
        let at = self.speed * fired as f64 + self.acceleration * (fired as f64).powi(2) / 2.0;
        let stopped = (self.start + at + way).floor() as i64;
        let overrun = stopped - self.position(fired);
        ([overrun, stopped], speed * code.ratio as f64)
    }

    /// After how many stops it stays within a code's travel; `STOPS` where it never does.
    fn settles(&self, simulator: &mut Simulator<Correction>, mut time: u64) -> usize {
        let mut after = 0;
        for stop in 0..STOPS {
            let (ways, travel) = self.stop(time);
            if ways[1].unsigned_abs() as f64 > travel + 1e-6 {
                after = stop + 1;
            }
            time = correct(simulator, [time, 200], ways)
                .learned
                .unwrap_or(time);
        }
        after
    }
}

/// Compares each function after the first order with the one before it, over bodies and initial
/// leads: in how many cases it settles earlier, at the same stop and later. Then the stops of all
/// cases by each function.
fn compared(bodies: &[Body], times: &[u64]) -> ([[usize; 3]; 2], [usize; 3]) {
    let functions = [Function::FirstOrder, Function::SecondOrder, Function::Exact];
    let mut simulators = functions.map(|function| full(Sign::Converging, function));
    let (mut cases, mut stops) = ([[0; 3]; 2], [0; 3]);
    for body in bodies {
        for time in times {
            let settled = [0, 1, 2].map(|function| body.settles(&mut simulators[function], *time));
            for (cases, pair) in cases.iter_mut().zip(settled.windows(2)) {
                cases[1 + usize::from(pair[1] > pair[0]) - usize::from(pair[1] < pair[0])] += 1;
            }
            for (sum, settled) in stops.iter_mut().zip(settled) {
                *sum += settled;
            }
        }
    }
    (cases, stops)
}

const DECELERATIONS: [f64; 3] = [0.0073, 0.0143, 0.031];

/// At constant speeds of 2 to 20 counts per CK, with leads from 1/300 of the right one to eight times it.
#[test]
fn each_function_settles_earlier_than_the_one_before_at_constant_speed() {
    let body = |speed: f64, deceleration: f64| Body {
        speed,
        acceleration: 0.0,
        deceleration,
        start: -speed * 5000.0,
    };
    let bodies: Vec<Body> = [2.0, 4.5, 9.0, 20.0]
        .iter()
        .flat_map(|speed| DECELERATIONS.map(|deceleration| body(*speed, deceleration)))
        .collect();
    let (cases, stops) = compared(&bodies, &[5, 50, 250, 800, 1600]);
    assert_eq!((cases, stops), ([[54, 6, 0], [54, 6, 0]], [397, 287, 63]));
}

/// At less than a count per CK a code's travel is below a count: some cases never settle.
#[test]
fn at_a_creep_each_settles_earlier_in_most_cases() {
    let bodies = DECELERATIONS.map(|deceleration| Body {
        speed: 0.37,
        acceleration: 0.0,
        deceleration,
        start: -2000.0,
    });
    let (cases, stops) = compared(&bodies, &[5, 50, 250, 800, 1600]);
    assert_eq!((cases, stops), ([[10, 5, 0], [8, 6, 1]], [134, 104, 73]));
}

/// Where the control signal comes while the body accelerates, another lead meets another speed; where the
/// right time lies at a change of N, it goes to and fro by each function.
#[test]
fn in_acceleration_each_settles_earlier_in_most_cases() {
    let ways = [1500.0, 3000.0, 5000.0];
    let body = |acceleration: f64, way: f64, deceleration: f64| Body {
        speed: 0.0,
        acceleration,
        deceleration,
        start: -way,
    };
    let mut bodies = Vec::new();
    for acceleration in [0.003, 0.006] {
        for way in ways {
            bodies.extend(DECELERATIONS.map(|deceleration| body(acceleration, way, deceleration)));
        }
    }
    let (cases, stops) = compared(&bodies, &[5, 50, 250, 800]);
    assert_eq!(
        (cases, stops),
        ([[59, 13, 0], [49, 19, 4]], [473, 356, 196])
    );
}
