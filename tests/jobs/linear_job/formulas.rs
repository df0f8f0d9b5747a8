//! The formulas of pattern and integrator, as closed forms and step by step.

use super::*;
use proptest::prelude::*;

const ONE: i128 = SPEED_ONE as i128;

/// A pattern as the circuit makes it: the weight of each scan, accumulated with its remainder. An
/// abort comes after so many scans. The speed has its fraction.
fn positions(distance: i64, speed: i128, times: [i128; 2], abort: Option<usize>) -> Vec<i64> {
    let [ta, td] = times;
    let way = i128::from(distance.abs());
    // Tc by its definition: the fewest steady scans in which the speed suffices.
    let tc = (0..)
        .find(|tc| speed * (ta + td) + 2 * tc * speed >= 2 * way * ONE)
        .unwrap();
    let whole = ta * td * (ta + 2 * tc + td);
    let (mut level, mut remainder, mut at) = (0, 0, 0);
    let mut made = Vec::new();
    let (mut rise, mut steady) = (ta, tc);
    if distance == 0 {
        return made;
    }
    loop {
        if abort == Some(made.len()) {
            (rise, steady) = (0, 0);
        }
        let weight;
        if rise > 0 {
            (weight, level, rise) = (level + td, level + 2 * td, rise - 1);
        } else if steady > 0 {
            (weight, steady) = (level, steady - 1);
        } else if level >= 2 * ta {
            (weight, level) = (level - ta, level - 2 * ta);
        } else if level > 0 {
            (weight, level) = (level / 2, 0);
        } else {
            return made;
        }
        let sum = way * weight + remainder;
        (at, remainder) = (at + sum / whole, sum % whole);
        made.push(distance.signum() * at as i64);
    }
}

fn reference(distance: i64, speed: u64, times: [u64; 2], abort: Option<usize>) -> Vec<i64> {
    let profile = profile(speed, times);
    let mut pattern = Pattern::new(0, distance, &profile);
    let mut made = Vec::new();
    loop {
        if abort == Some(made.len()) {
            pattern.abort();
        }
        match pattern.advance() {
            Some(position) => made.push(position),
            None => return made,
        }
    }
}

#[test]
fn small_patterns_are_those_of_the_weights() {
    // 0.4, 1, 1.5, 2 and 3 counts a scan.
    let speeds = [1638, 4096, 6144, 8192, 12_288];
    for (ta, td, speed) in
        (1..5).flat_map(|a| (1..5).flat_map(move |d| speeds.map(move |v| (a, d, v))))
    {
        for distance in -12..=12 {
            for abort in (0..12).map(Some).chain([None]) {
                let expected = positions(distance, speed, [ta, td], abort);
                let made = reference(distance, speed as u64, [ta as u64, td as u64], abort);
                assert_eq!(made, expected, "{distance} {speed} {ta} {td} {abort:?}");
            }
        }
    }
}

#[test]
fn a_pattern_written_out() {
    // Δ = 20, V = 5, Ta = 2, Td = 2: Tc = (40 − 20)/10 = 2, W = 4·8 = 32, weights 2 6 8 8 6 2.
    let five = 5 * SPEED_ONE;
    assert_eq!(reference(20, five, [2, 2], None), [1, 5, 10, 15, 18, 20]);
    // Aborted after the second scan the speed of 8 goes down by 4 in each scan: weights 6 2.
    assert_eq!(reference(20, five, [2, 2], Some(2)), [1, 5, 8, 10]);
    assert_eq!(reference(20, five, [2, 2], Some(0)), [0; 0]);
    assert_eq!(reference(0, five, [2, 2], None), [0; 0]);
    // Half a count a scan, ramps of one: Tc = (10 - 1)/1 = 9, W = 20, weights 1, 2 nine times, 1.
    let made = reference(5, SPEED_ONE / 2, [1, 1], None);
    assert_eq!(made, [0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5]);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    #[test]
    fn patterns_end_exactly_and_keep_speed_and_acceleration(
        distance in prop_oneof![-3000..3000i64, -(1i64 << 31)..(1i64 << 31)],
        slowness in 1..3000u64,
        times in [1..1500u64, 1..1500],
    ) {
        let speed = (distance.unsigned_abs() * SPEED_ONE / slowness).max(100);
        let greatest = speed.div_ceil(SPEED_ONE);
        let made = reference(distance, speed, times, None);
        prop_assert_eq!(made.last().copied().unwrap_or(0), distance);
        let mut at = 0;
        let steps: Vec<i64> = made.iter().map(|p| { let step = (p - at) * distance.signum(); at = *p; step }).collect();
        prop_assert!(steps.iter().all(|step| (0..=greatest as i64).contains(step)));
        // The mean speed of a scan changes by V/Ta or V/Td at most; rounding adds a count twice.
        let most = (greatest as f64 / times[0].min(times[1]) as f64) + 2.0;
        let jerky = steps.windows(2).all(|pair| ((pair[1] - pair[0]) as f64).abs() <= most);
        prop_assert!(jerky);
    }

    #[test]
    fn wide_patterns_are_those_of_the_weights(
        distance in -(1i64 << 31)..(1i64 << 31),
        slowness in 1..200u64,
        times in [1..300u64, 1..300],
        abort in prop::option::of(0..500usize),
    ) {
        let speed = (distance.unsigned_abs() * SPEED_ONE / slowness).max(100);
        let expected = positions(distance, speed.into(), times.map(i128::from), abort);
        prop_assert_eq!(reference(distance, speed, times, abort), expected);
    }
}

/// I of eq. (1) with its remainder B, step by step.
fn increments(rule: Rule, master: i128, slave: i128, ways: &[i64]) -> Vec<i64> {
    let mut remainder = if rule == Rule::Centred { master / 2 } else { 0 };
    let step = |way: &i64| {
        let sum = slave * i128::from(*way) + remainder;
        let increment = match rule {
            Rule::Truncating => sum / master,
            // Towards minus infinity: the remainder has the divisor's sign.
            _ => sum.div_euclid(master) - i128::from(master < 0 && sum.rem_euclid(master) != 0),
        };
        remainder = sum - increment * master;
        increment as i64
    };
    ways.iter().map(step).collect()
}

/// Splits |master| into steps of its sign, each up to `most`.
fn ways(master: i64, most: i64) -> Vec<i64> {
    let mut left = master.abs();
    let mut ways = Vec::new();
    for size in (0..=most).cycle() {
        if left == 0 {
            return ways;
        }
        let step = size.min(left);
        ways.push(step * master.signum());
        left -= step;
    }
    unreachable!("the cycle has no end")
}

#[test]
fn the_integrator_is_eq_1_and_ends_on_the_target() {
    for rule in RULES {
        for master in (-12..=12i64).filter(|master| *master != 0) {
            for slave in -master.abs()..=master.abs() {
                for most in 1..4 {
                    let ways = ways(master, most);
                    let mut integrator = Integrator::new(rule, master, slave);
                    let made: Vec<_> = ways.iter().map(|way| integrator.advance(*way)).collect();
                    let expected = increments(rule, master.into(), slave.into(), &ways);
                    assert_eq!(made, expected, "{rule:?} {master} {slave}");
                    assert_eq!(made.iter().sum::<i64>(), slave);
                }
            }
        }
    }
}

#[test]
fn by_floor_a_return_stroke_meets_the_points_of_the_stroke() {
    let points = |rule, from: [i64; 2], to: [i64; 2]| {
        let mut integrator = Integrator::new(rule, to[0] - from[0], to[1] - from[1]);
        let mut at = from;
        let mut points = vec![at];
        for way in ways(to[0] - from[0], 1).into_iter().filter(|way| *way != 0) {
            at = [at[0] + way, at[1] + integrator.advance(way)];
            points.push(at);
        }
        points
    };
    let there = points(Rule::Floor, [0, 0], [17, 7]);
    let mut back = points(Rule::Floor, [17, 7], [0, 0]);
    back.reverse();
    assert_eq!(there, back);
    let mut back = points(Rule::Truncating, [17, 7], [0, 0]);
    back.reverse();
    assert_ne!(points(Rule::Truncating, [0, 0], [17, 7]), back);
}
