//! Whole jobs, of the circuits and of the formulas.

use super::*;

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
    settings.rated_speed_rev_per_min = [2700.0; 2];
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
#[ignore = "takes long"]
fn the_circuits_command_what_the_formulas_say_in_every_scan_of_a_job() {
    let text = include_bytes!("../../../waves/plotter.hpgl");
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
        let ours = play(&plotter(&settings), &targets, &settings, &mut ()).unwrap();
        as_the_formulas_say(&ours, &targets, &settings);
        // ¶0014: a slave with the shorter way accelerates no more than its master, but for the
        // count that rounding makes. A fixed master has slaves with longer ways.
        let largest = |of: fn(&Segment) -> u64| {
            let segments = ours.segments(settings.counts_per_mm);
            segments.iter().map(of).max().unwrap()
        };
        let leads = largest(|segment| segment.master_acceleration);
        let follows = largest(|segment| segment.slave_acceleration);
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
            let played = play(&conventional(), &targets, &settings, &mut ()).unwrap();
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
    settings.position_gain_per_s[0] = 50.0;
    settings.position_gain_per_s[1] = 40.0;
    for (x, y, feed) in [
        (60_000, 80_000, 30.0),
        (80_000, 60_000, 40.0),
        (-50_000, 50_000, 35.0),
    ] {
        // Counts of the master axis a scan of 1 ms.
        let targets = [target(x, y, feed as u64, [100, 100])];
        let played = play(&plotter(&settings), &targets, &settings, &mut ()).unwrap();
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
    settings.position_gain_per_s[0] = 50.0;
    settings.position_gain_per_s[1] = 40.0;
    settings.velocity_loop_ms = [1e-3; 2];
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
    settings.rated_speed_rev_per_min[1] = 3.0;
    let targets = [target(1000, 1000, 1, [10, 10])];
    let played = reference::play(&targets, &settings, &mut |_| ());
    assert_eq!(played.saturated_scans[0], 0);
    assert!(played.saturated_scans[1] > 1000);
}

#[test]
fn a_setting_that_is_no_number_is_refused() {
    let mut settings = short_scans();
    settings.position_gain_per_s[1] = f64::NAN;
    let error = play::<1>(&plotter(&settings), &[], &settings, &mut ()).expect_err("not a number");
    assert!(
        error.to_string().starts_with("position_gain_per_s: "),
        "{error}"
    );
}

/// A fold over the scans as they come measures what the records do.
#[test]
fn a_run_is_measured_while_it_goes_on() {
    let targets = [
        target(300, 120, 20, [5, 5]),
        target(250, -40, 30, [3, 8]),
        target(250, 500, 20, [5, 5]),
        target(0, 0, 20, [50, 50]),
    ];
    for exact_stop in [false, true] {
        let settings = Settings {
            exact_stop,
            ..short_scans()
        };
        let circuit = plotter(&settings);
        let played = play(&circuit, &targets, &settings, &mut ()).unwrap();
        let scale = [200.0, 150.0];
        let (mut measuring, mut cycles) = (Measuring::new(scale), Vec::new());
        let each = &mut |seen: &Seen<'_>| cycles.extend(measuring.take(seen));
        let other = play_each(&circuit, &targets, &settings, &mut (), each).unwrap();
        assert_eq!(other.cycles, played.cycles);
        assert!(other.records.is_empty());
        assert_eq!(measuring.finish(&other.cycles), played.segments(scale));
        let counts = (0..targets.len()).map(|cycle| played.records_of(cycle).len());
        let seen = (0..targets.len()).map(|cycle| cycles.iter().filter(|of| **of == cycle).count());
        assert!(counts.eq(seen));
    }
}
