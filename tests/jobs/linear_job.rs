//! The reference of the linear interpolator, and the measures that runs are judged by.

use motion_rtl::circuits::linear_interpolator::{MasterAxis, Rule};
use motion_rtl::input::read_text;
use motion_rtl::jobs::linear_interpolator::job::{conventional, play, plotter};
use motion_rtl::jobs::linear_interpolator::measure::{
    Cycle, Deviation, Played, ScanRecord, Segment,
};
use motion_rtl::jobs::linear_interpolator::profile::{Profile, SPEED_ONE};
use motion_rtl::jobs::linear_interpolator::reference::{self, Integrator, Pattern};
use motion_rtl::jobs::linear_interpolator::settings::Settings;
use motion_rtl::jobs::linear_interpolator::targets::{LATENCY_TICKS, Target, compile};
use motion_rtl::jobs::linear_interpolator::ways::Way;
use proptest::prelude::*;

const RULES: [Rule; 3] = [Rule::Floor, Rule::Truncating, Rule::Centred];

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

fn profile(speed: u64, times: [u64; 2]) -> Profile {
    Profile {
        speed,
        acceleration_scans: times[0],
        deceleration_scans: times[1],
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

fn record(tick: u64, command: [i64; 2], motor: [f64; 2]) -> ScanRecord {
    ScanRecord {
        tick,
        command,
        motor,
    }
}

/// A stroke from (10, 20) by (40, 30) and then one straight down, with known errors.
fn two_strokes() -> Played {
    Played {
        ticks: 700,
        records: vec![
            // Before the first cycle: belongs to none.
            record(100, [10, 20], [99.0, -99.0]),
            // 1 to the left along Y: |40·(21 − 20) − 30·0| = 40 of 40.
            record(200, [10, 21], [10.0, 20.0]),
            // (30, 35) is on the line; the motor is 5 to the right: (+3, −4).
            record(300, [30, 35], [33.0, 31.0]),
            record(400, [50, 50], [46.0, 47.0]),
            // The wait belongs to the first stroke: 10 to the left, (−6, +8).
            record(500, [50, 50], [44.0, 58.0]),
            record(600, [50, 10], [52.5, 40.0]),
            record(700, [51, 0], [49.0, 0.0]),
        ],
        cycles: vec![
            Cycle {
                from: [10, 20],
                to: [50, 50],
                master: 0,
                scans: 1..4,
                end: [50, 50],
            },
            Cycle {
                from: [50, 50],
                to: [50, 0],
                master: 1,
                scans: 5..7,
                end: [51, 0],
            },
        ],
        ..Played::default()
    }
}

#[test]
fn the_measures_of_known_records() {
    let mut segments = two_strokes().segments([100.0, 100.0]);
    for segment in &mut segments {
        // Lengths are roots: no digits beyond these.
        let round = |value: f64| (value * 1e9).round() / 1e9;
        segment.contour_counts = round(segment.contour_counts);
        segment.contour_um = round(segment.contour_um);
    }
    let first = Segment {
        delta: [40, 30],
        master: 0,
        scans: 3,
        end_error: [0, 0],
        // Speeds of 0, 20, 20, 0 and 1, 14, 15, 0.
        acceleration: [20, 15],
        deviation: Deviation {
            numerator: 40,
            denominator: 40,
        },
        perpendicular_counts: 0.8,
        contour_counts: 10.0,
        contour_um: 100.0,
    };
    let second = Segment {
        delta: [0, -50],
        master: 1,
        scans: 2,
        end_error: [1, 0],
        // 0, 1, 0 and −40, −10, 0.
        acceleration: [1, 40],
        deviation: Deviation {
            numerator: 50,
            denominator: 50,
        },
        perpendicular_counts: 1.0,
        contour_counts: 2.5,
        contour_um: 25.0,
    };
    assert_eq!(segments, [first, second]);
    assert_eq!(first.deviation.lsb(), 1.0);
}

#[test]
fn the_contour_error_is_measured_in_true_lengths() {
    // A count is 0.1 mm in X and 0.2 mm in Y: (40, 15) counts are (4, 3) mm.
    let cycle = Cycle {
        from: [0, 0],
        to: [40, 15],
        master: 0,
        scans: 0..1,
        end: [40, 15],
    };
    let scale = [10.0, 5.0];
    // 1 mm to the left of the middle: (2, 1.5) + (−0.6, 0.8) mm.
    let left = [14.0, 11.5];
    assert!((cycle.contour_error(left, scale) - 1.0).abs() < 1e-12);
    let (foot, error) = cycle.foot([26.0, 3.5], scale);
    assert!((error + 1.0).abs() < 1e-12, "to the right is negative");
    assert!((foot[0] - 2.0).abs() < 1e-12 && (foot[1] - 1.5).abs() < 1e-12);
    let played = Played {
        records: vec![record(1, [40, 15], left)],
        cycles: vec![cycle],
        ..Played::default()
    };
    assert!((played.segments(scale)[0].contour_um - 1000.0).abs() < 1e-9);
}

#[test]
fn deviations_are_held_against_their_rule_exactly() {
    let within = |numerator, rule| {
        Deviation {
            numerator,
            denominator: 7,
        }
        .is_within(rule)
    };
    for rule in [Rule::Floor, Rule::Truncating] {
        assert!(within(0, rule) && within(6, rule) && !within(7, rule) && !within(8, rule));
    }
    assert!(within(3, Rule::Centred) && !within(4, Rule::Centred));
    let half = Deviation {
        numerator: 4,
        denominator: 8,
    };
    assert!(half.is_within(Rule::Centred));
    // Where floating point sees no difference any more.
    let denominator = 1u128 << 60;
    let below = Deviation {
        numerator: denominator - 1,
        denominator,
    };
    assert!(below.is_within(Rule::Floor) && below.lsb() == 1.0);
}

#[test]
fn broken_records_are_measured_without_panic() {
    let mut played = two_strokes();
    played.cycles[1].scans = 9..12;
    played.cycles.push(Cycle {
        from: [3, 3],
        to: [3, 3],
        master: 0,
        scans: 40..50,
        end: [3, 3],
    });
    let segments = played.segments([1.0; 2]);
    assert_eq!(segments[1].scans, 0);
    assert_eq!(segments[2].deviation.lsb(), 0.0);
    assert!(played.records_of(17).is_empty());
}

fn target(x: i64, y: i64, speed: u64, times: [u64; 2]) -> Target {
    Target {
        x,
        y,
        profiles: [profile(speed * SPEED_ONE, times)],
        feed_mm_per_min: 1.0,
        line: 1,
        rapid: false,
    }
}

/// Scans of 1 ms that are as short, in ticks, as the dividers allow.
fn short_scans() -> Settings {
    let mut settings = Settings {
        clock_hz: 186_000,
        scan_ticks: LATENCY_TICKS,
        ..Settings::default()
    };
    for axis in &mut settings.axes {
        axis.rated_speed_rev_per_min = 2700.0;
    }
    settings
}

/// The commands of a cycle.
fn commands(played: &Played, cycle: &Cycle) -> Vec<[i64; 2]> {
    let records = &played.records[cycle.scans.clone()];
    records.iter().map(|record| record.command).collect()
}

/// The commands of a run against the formulas, scan by scan.
fn as_the_formulas_say<const N: usize>(
    played: &Played,
    targets: &[Target<N>],
    settings: &Settings,
) {
    assert!(!played.late && !played.unsettled && played.refused == 0);
    assert_eq!(played.lost, [false; 2]);
    assert_eq!(played.cycles.len(), targets.len());
    let ideal = reference::play(targets, settings, &mut |_| ());
    for (cycle, expected) in played.cycles.iter().zip(&ideal.cycles) {
        let ends = |cycle: &Cycle| (cycle.from, cycle.to, cycle.end, cycle.master);
        assert_eq!(ends(cycle), ends(expected));
        let (found, wanted) = (commands(played, cycle), commands(&ideal, expected));
        assert!(found == wanted, "{N} {cycle:?}: {found:?}, not {wanted:?}");
    }
}

/// 0 to 100 % speed, 300 counts a scan, in 15 and 20 scans; a master that goes 40 counts a scan.
#[test]
fn the_conventional_ways_are_given_what_the_text_says() {
    let settings = Settings {
        scan_ticks: 2000,
        rapid_mm_per_min: 45_000.0,
        acceleration_ms: 30.0,
        deceleration_ms: 40.0,
        ..Settings::default()
    };
    let of = |way: Way, x, y| {
        let targets = [target(x, y, 40, [2, 3])];
        let [made] = &way.targets(&targets, &settings)[..] else {
            panic!("one cycle")
        };
        made.profiles.map(|profile| {
            let times = [profile.acceleration_scans, profile.deceleration_scans];
            (profile.counts_per_scan(), times)
        })
    };
    // Both get speed and slope; one that is too short has a triangle of that slope: 60 counts in
    // 2·60/(40·5) of the square.
    let same = Way::SameSettings;
    assert_eq!(of(same, 4000, -1000), [(40.0, [2, 3]); 2]);
    assert_eq!(of(same, 50, 4000), [(40.0, [2, 3]), (40.0, [2, 3])]);
    assert_eq!(of(same, 4000, 20), [(40.0, [2, 3]), (40.0, [1, 2])]);
    assert_eq!(of(same, 0, 4000)[1], (40.0, [2, 3]));
    // A third of the speed, three times the times: 45 and 60 scans to 100 %, of which 40/900.
    let inverse = Way::InProportion;
    let [x, y] = of(inverse, -4200, 1400);
    assert_eq!(x, (40.0, [2, 3]));
    assert_eq!(y.1, [2, 3]);
    assert!((y.0 - 40.0 / 3.0).abs() < 1.0 / 4096.0);
    // Five sevenths: 21 and 28 scans to 100 %, exactly.
    assert_eq!(of(inverse, 2000, 2800)[0].1, [2, 3]);
    // Axes with other counts get the same in millimetres.
    let fine = Settings {
        counts_per_mm: [200.0, 400.0],
        ..settings.clone()
    };
    let [made] = &same.targets(&[target(1000, 4000, 40, [2, 3])], &fine)[..] else {
        panic!("one cycle")
    };
    assert_eq!(made.profiles[0].counts_per_scan(), 20.0);
    assert_eq!(made.profiles[1].counts_per_scan(), 40.0);
}

#[test]
fn the_circuits_command_what_the_formulas_say_in_every_scan_of_a_job() {
    let text = include_bytes!("../../waves/plotter.hpgl");
    let drawing = read_text("plotter.hpgl", text).unwrap();
    for (rule, exact_stop, master) in [
        (Rule::Floor, true, MasterAxis::Longer),
        (Rule::Truncating, false, MasterAxis::X),
        (Rule::Centred, false, MasterAxis::Y),
    ] {
        let settings = Settings {
            rule,
            exact_stop,
            master,
            ..short_scans()
        };
        let targets = compile(&drawing, &settings).unwrap().targets;
        let ours = play(&plotter(&settings), &targets, &settings, ()).unwrap();
        as_the_formulas_say(&ours, &targets, &settings);
        // ¶0014: a slave with the shorter way accelerates no more than its master, but for the
        // count that rounding makes. A fixed master has slaves with longer ways.
        let largest = |of: fn(&Segment) -> usize| {
            let segments = ours.segments(settings.counts_per_mm);
            let largest = segments
                .iter()
                .map(|segment| segment.acceleration[of(segment)]);
            largest.max().unwrap()
        };
        let (leads, follows) = (largest(|s| s.master), largest(|s| 1 - s.master));
        match master {
            MasterAxis::Longer => assert!(follows <= leads + 1, "{leads}, {follows}"),
            _ => assert!(follows > 5 * leads, "{leads}, {follows}"),
        }
        let longer = Settings {
            master: MasterAxis::Longer,
            ..settings.clone()
        };
        let targets = compile(&drawing, &longer).unwrap().targets;
        let mut bent = Vec::new();
        for way in Way::ALL {
            let targets = way.targets(&targets, &settings);
            let played = play(&conventional(), &targets, &settings, ()).unwrap();
            as_the_formulas_say(&played, &targets, &settings);
            let segments = played.segments(settings.counts_per_mm);
            let sloped = segments
                .iter()
                .filter(|s| s.delta[0].abs() != s.delta[1].abs() && !s.delta.contains(&0));
            let off: Vec<f64> = sloped.map(|s| s.deviation.lsb()).collect();
            bent.push(off);
        }
        let [same, inverse] = &bent[..] else {
            panic!("two ways")
        };
        // Ends of acceleration that differ bend every slope; what is left of times that are rounded
        // is little, most ramps being as many scans on both axes.
        assert!(same.iter().all(|lsb| *lsb >= 5.0), "{same:?}");
        assert!(same.iter().any(|lsb| *lsb > 400.0), "{same:?}");
        assert!(inverse.iter().all(|lsb| *lsb < 50.0), "{inverse:?}");
        // Where the motors are in the scan that begins a cycle: at its start, if it waits for them.
        let astray = |cycle: &Cycle| {
            let record = &ours.records[cycle.scans.start - 1];
            let off = |axis: usize| (record.motor[axis] - cycle.from[axis] as f64).abs();
            off(0).max(off(1)) > f64::from(settings.in_position_counts) + 1.0
        };
        let early = ours.cycles.iter().filter(|cycle| astray(cycle)).count();
        assert_eq!(early == 0, exact_stop, "{early} cycles");
        let segments = ours.segments(settings.counts_per_mm);
        let off = |segment: &&Segment| !segment.deviation.is_within(rule);
        assert_eq!(segments.iter().find(off), None, "{rule:?}");
        // At the end both motors are where they should be, to the count.
        let last = ours.records.last().unwrap();
        // The feedback is that of three ticks ago.
        let most = f64::from(settings.in_position_counts) + 1.0;
        for axis in 0..2 {
            let off = last.command[axis] as f64 - last.motor[axis];
            assert!(off.abs() <= most, "{off} counts");
        }
    }
}

/// The contour error of the whole machine on a long line, circuit and motors, against
/// F·sin α·cos α·(1/Kp1 − 1/Kp2), in the middle of the line.
#[test]
fn the_contour_error_of_the_circuit_is_that_of_theory() {
    let mut settings = short_scans();
    settings.rule = Rule::Centred;
    settings.axes[0].position_gain_per_s = 50.0;
    settings.axes[1].position_gain_per_s = 40.0;
    for (x, y, feed) in [
        (60_000, 80_000, 30.0),
        (80_000, 60_000, 40.0),
        (-50_000, 50_000, 35.0),
    ] {
        // Counts of the master axis a scan of 1 ms.
        let targets = [target(x, y, feed as u64, [100, 100])];
        let played = play(&plotter(&settings), &targets, &settings, ()).unwrap();
        let cycle = &played.cycles[0];
        let scans = cycle.scans.clone();
        let middle = scans.start + 800..scans.end - 200;
        let errors: Vec<f64> = played.records[middle]
            .iter()
            .map(|record| cycle.contour_error(record.motor, [1.0; 2]).abs())
            .collect();
        let measured = errors.iter().sum::<f64>() / errors.len() as f64;
        let (dx, dy) = (x as f64, y as f64);
        let along = feed * 1e3 * dx.hypot(dy) / dx.abs().max(dy.abs());
        let (sin, cos) = (dy.abs() / dx.hypot(dy), dx.abs() / dx.hypot(dy));
        let theory = along * sin * cos * (1.0 / 40.0 - 1.0 / 50.0);
        assert!(
            (measured - theory).abs() < 0.01 * theory,
            "{measured}, {theory} counts"
        );
    }
}

/// F·sin α·cos α·(1/Kp1 − 1/Kp2), the velocity loops being as fast as they may be.
#[test]
fn the_contour_error_of_unequal_gains_is_that_of_theory() {
    let mut settings = Settings::default();
    settings.axes[0].position_gain_per_s = 50.0;
    settings.axes[1].position_gain_per_s = 40.0;
    for axis in &mut settings.axes {
        axis.velocity_loop_ms = 1e-3;
    }
    // 30 counts a scan in X are 150 mm/s, 40 in Y are 200: F = 250 mm/s.
    let played = reference::play(
        &[target(60_000, 80_000, 40, [100, 100])],
        &settings,
        &mut |_| (),
    );
    let error = played.segments(settings.counts_per_mm)[0].contour_um;
    let theory: f64 = 250.0 * 0.6 * 0.8 * (1.0 / 40.0 - 1.0 / 50.0) * 1e3;
    assert!(
        (error - theory).abs() < 0.02 * theory,
        "{error} um, {theory} um"
    );
}

#[test]
fn without_an_exact_stop_cycles_follow_each_other_at_once() {
    let targets = [target(1000, 500, 10, [5, 5]), target(0, 0, 10, [5, 5])];
    for exact_stop in [true, false] {
        let settings = Settings {
            exact_stop,
            ..Settings::default()
        };
        let played = reference::play(&targets, &settings, &mut |_| ());
        let [first, second] = &played.cycles[..] else {
            panic!("two cycles")
        };
        assert_eq!(first.scans.end == second.scans.start, !exact_stop);
        assert_eq!(played.records.len() as u64 * 1000, played.ticks);
        let waits = played.records.len() - second.scans.end;
        assert!(waits > 0, "the run ends in position");
    }
}

#[test]
fn a_motor_that_is_too_slow_is_counted_as_saturated() {
    let mut settings = Settings::default();
    // 200 counts/s are less than the 1000 asked for.
    settings.axes[1].rated_speed_rev_per_min = 3.0;
    let targets = [target(1000, 1000, 1, [10, 10])];
    let played = reference::play(&targets, &settings, &mut |_| ());
    assert_eq!(played.saturated_scans[0], 0);
    assert!(played.saturated_scans[1] > 1000);
}

#[test]
fn a_setting_that_is_no_number_is_refused() {
    let mut settings = short_scans();
    settings.axes[1].position_gain_per_s = f64::NAN;
    let error = play::<1>(&plotter(&settings), &[], &settings, ()).expect_err("not a number");
    assert!(
        error.to_string().starts_with("position_gain_per_s: "),
        "{error}"
    );
}
