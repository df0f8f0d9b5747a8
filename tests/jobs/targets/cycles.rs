//! Positions, speeds and times of cycles; arcs as chords.

use super::{circle, compiled, lines};
use motion_rtl::input::read_text;
use motion_rtl::jobs::linear_interpolator::profile::{Profile, SPEED_ONE};
use motion_rtl::jobs::linear_interpolator::settings::{Settings, ShortMoves};
use motion_rtl::jobs::linear_interpolator::targets::{Target, TargetError, compile};
use proptest::prelude::*;

/// The one cycle from the origin to a point in millimetres.
fn cycle(x: f64, y: f64, change: impl FnOnce(&mut Settings)) -> Target {
    let all = compiled(&lines(&[[x, y]]), change);
    assert_eq!(all.targets.len(), 1);
    all.targets[0]
}

/// Times of acceleration and deceleration.
fn scans(target: &Target) -> [u64; 2] {
    let [profile] = target.profiles;
    [profile.acceleration_scans, profile.deceleration_scans]
}

/// Speed in counts a scan.
fn speed(target: &Target) -> f64 {
    target.profiles[0].counts_per_scan()
}

#[test]
fn a_line_along_an_axis_has_the_feed_itself() {
    // 6000 mm/min are 100 mm/s, 20,000 counts/s, 20 counts in a scan of 1 ms; it is a third of the
    // speed that takes 100 ms.
    let expected = Target {
        x: 2000,
        y: 0,
        profiles: [Profile {
            speed: 20 * SPEED_ONE,
            acceleration_scans: 34,
            deceleration_scans: 34,
        }],
        feed_mm_per_min: 6000.0,
        line: 1,
        rapid: false,
    };
    assert_eq!(cycle(10.0, 0.0, |_| ()), expected);
    let y = cycle(0.0, -10.0, |_| ());
    assert_eq!((y.x, y.y, speed(&y)), (0, -2000, 20.0));
}

#[test]
fn whole_speeds_do_not_lose_anything_to_rounding() {
    for whole in 1..=300 {
        for scan_ticks in [400, 1000, 1500] {
            let target = cycle(1000.0, 0.0, |settings| {
                settings.scan_ticks = scan_ticks;
                let per_minute = 60.0 * 1e6 / f64::from(scan_ticks);
                settings.feed_mm_per_min = f64::from(whole) * per_minute / 200.0;
            });
            assert_eq!(speed(&target), f64::from(whole), "{scan_ticks} ticks");
        }
    }
}

#[test]
fn on_a_slope_the_master_axis_has_its_share_of_the_feed() {
    // 3, 4, 5: Y goes 80 mm/s of the 100 mm/s.
    assert_eq!(speed(&cycle(30.0, 40.0, |_| ())), 16.0);
    assert_eq!(speed(&cycle(-40.0, 30.0, |_| ())), 16.0);
    // 45 degrees: 14.142 counts a scan, rounded down to the fraction.
    let exact = 20.0 / 2f64.sqrt();
    let found = speed(&cycle(10.0, 10.0, |_| ()));
    assert!(found <= exact && found > exact - 1.0 / 4096.0, "{found}");
}

/// A hundred steps of the fraction are the slowest that a cycle goes, so that rounding costs at most
/// 1 %; and no cycle has more steady scans than the circuit counts.
#[test]
fn a_feed_that_the_fraction_is_too_coarse_for_is_refused() {
    let slow = |to: [f64; 2], feed: f64| {
        let settings = Settings {
            feed_mm_per_min: feed,
            ..Settings::default()
        };
        compile(&lines(&[to]), &settings)
    };
    let least = |to: [f64; 2]| match slow(to, 0.002) {
        Err(TargetError::Slow {
            line: 1,
            value: 0.002,
            least,
        }) => least,
        other => panic!("{other:?}"),
    };
    // 200 counts/mm, scans of 1 ms.
    assert_eq!(least([10.0, 0.0]), 7.32422);
    assert_eq!(least([30.0, 40.0]), 9.15528);
    assert_eq!(least([10.0, 10.0]), 10.3581);
    for to in [[10.0, 0.0], [30.0, -40.0], [10.0, 10.0], [7.0, 3.0]] {
        let made = slow(to, least(to)).unwrap();
        assert_eq!(made.targets[0].profiles[0].speed, 100);
        slow(to, least(to) * 0.9999).unwrap_err();
    }
    // 2^30 counts in 2^31 - 1 scans.
    let to = [1e6, 0.0];
    let far = least(to);
    assert_eq!(far, 27.9397);
    slow(to, far).unwrap();
    slow(to, far * 0.9999).unwrap_err();
}

/// Feeds that whole counts a scan would have halved.
#[test]
fn slow_feeds_are_met_within_one_percent() {
    for feed in [11.0, 290.0, 300.0, 590.0, 600.0, 899.0] {
        for to in [[20.0, 0.0], [20.0, 11.547], [0.0, -20.0], [14.0, 14.0]] {
            let target = cycle(to[0], to[1], |settings| settings.feed_mm_per_min = feed);
            let way = [target.x, target.y].map(|counts| counts as f64);
            let longer = way[0].abs().max(way[1].abs());
            let along = speed(&target) * way[0].hypot(way[1]) / longer;
            let reached = along * 1000.0 * 60.0 / 200.0;
            assert!(
                (0.99 * feed..=feed * (1.0 + 1e-9)).contains(&reached),
                "{feed}: {reached}"
            );
        }
    }
}

#[test]
fn counts_that_differ_between_the_axes_choose_the_master_but_not_the_feed() {
    // X has ten times the counts: 30 mm are 3000 counts, 40 mm in Y are 400. The path of 50 mm
    // takes 500 scans at 100 mm/s, so X goes 6 counts a scan.
    let change = |settings: &mut Settings| settings.counts_per_mm = [100.0, 10.0];
    let target = cycle(30.0, 40.0, change);
    assert_eq!((target.x, target.y, speed(&target)), (3000, 400, 6.0));
}

#[test]
fn feeds_come_from_the_move_and_rapid_ones_from_the_settings() {
    let mut d = lines(&[[50.0, 0.0], [100.0, 0.0], [150.0, 0.0]]);
    super::change(&mut d, 1, |step| step.feed_mm_per_min = Some(1500.0));
    super::change(&mut d, 2, |step| step.rapid = true);
    super::change(&mut d, 2, |step| step.feed_mm_per_min = Some(1.0));
    let made = compiled(&d, |settings| settings.rapid_mm_per_min = 12_000.0);
    let speeds = made
        .targets
        .iter()
        .map(|target| (speed(target), target.rapid));
    let expected = [(20.0, false), (5.0, false), (40.0, true)];
    assert_eq!(speeds.collect::<Vec<_>>(), expected);
}

#[test]
fn times_are_whole_scans_and_at_least_one() {
    let times = |acceleration, deceleration| {
        let target = cycle(1000.0, 0.0, |settings| {
            settings.feed_mm_per_min = settings.rapid_mm_per_min;
            settings.acceleration_ms = acceleration;
            settings.deceleration_ms = deceleration;
        });
        scans(&target)
    };
    assert_eq!(times(100.0, 37.0), [100, 37]);
    assert_eq!(times(0.0, 1.4), [1, 1]);
    assert_eq!(times(4095.0, 1.6), [4095, 2]);
}

/// The slope is that to 100 % speed: on every axis, and whatever part of it the speed is.
#[test]
fn times_are_in_proportion_to_the_speed() {
    let times = |to: [f64; 2], feed, full: f64| {
        let target = cycle(to[0], to[1], |settings| {
            (settings.feed_mm_per_min, settings.full_speed_mm_per_min) = (feed, Some(full));
            settings.deceleration_ms = 200.0;
        });
        scans(&target)
    };
    assert_eq!(times([1000.0, 0.0], 18_000.0, 18_000.0), [100, 200]);
    assert_eq!(times([1000.0, 0.0], 9000.0, 18_000.0), [50, 100]);
    assert_eq!(times([1000.0, 0.0], 9000.0, 36_000.0), [25, 50]);
    assert_eq!(times([1000.0, 0.0], 180.0, 18_000.0), [1, 2]);
    assert_eq!(times([1000.0, 0.0], 181.0, 18_000.0), [2, 3]);
    // 3, 4, 5: the master axis has four fifths of the feed.
    assert_eq!(times([-300.0, 400.0], 9000.0, 18_000.0), [40, 80]);
}

#[test]
fn a_short_move_keeps_its_acceleration_or_its_times() {
    // The ramps of 100 and 300 scans at 20 counts take 4000 counts. A quarter of the way has half
    // the times.
    let short = |counts: f64, short_moves| {
        let target = cycle(counts / 200.0, 0.0, |settings| {
            // A third of 100 % speed.
            settings.acceleration_ms = 300.0;
            settings.deceleration_ms = 900.0;
            settings.short_moves = short_moves;
        });
        assert_eq!(speed(&target), 20.0);
        scans(&target)
    };
    use ShortMoves::{ConstantAcceleration as Acceleration, ConstantTime as Time};
    assert_eq!(short(4000.0, Acceleration), [100, 300]);
    assert_eq!(short(1000.0, Acceleration), [50, 150]);
    // A little less than a quarter: rounded up.
    assert_eq!(short(999.0, Acceleration), [50, 150]);
    assert_eq!(short(1001.0, Acceleration), [51, 151]);
    assert_eq!(short(1.0, Acceleration), [2, 5]);
    for counts in [4000.0, 1000.0, 1.0] {
        assert_eq!(short(counts, Time), [100, 300]);
    }
}

#[test]
fn points_that_do_not_move_an_axis_are_counted_and_left_out() {
    // Half a count is 0.0025 mm.
    let steps = [[0.002, 0.0], [0.002, 0.0024], [0.003, 0.0], [0.001, 0.0]];
    let made = compiled(&lines(&steps), |_| ());
    let to = made.targets.iter().map(|target| [target.x, target.y]);
    assert_eq!(to.collect::<Vec<_>>(), [[1, 0], [0, 0]]);
    assert_eq!(made.dropped, 2);
}

#[test]
fn a_start_away_from_the_origin_is_gone_to_with_the_pen_up() {
    let mut d = lines(&[[1.0, 2.0]]);
    d.start = [1.0, 1.0, 0.0];
    let made = compiled(&d, |_| ());
    let ends: Vec<_> = made
        .targets
        .iter()
        .map(|t| (t.x, t.y, t.line, t.rapid))
        .collect();
    assert_eq!(ends, [(200, 200, 0, true), (200, 400, 1, false)]);
}

#[test]
fn z_is_left_out_and_said_so() {
    let mut d = lines(&[[1.0, 0.0], [1.0, 0.0], [2.0, 0.0]]);
    super::change(&mut d, 1, |step| step.to[2] = 5.0);
    super::change(&mut d, 2, |step| step.to[2] = 5.0);
    let made = compiled(&d, |_| ());
    assert_eq!(
        (made.targets.len(), made.dropped, made.moves_in_z),
        (2, 1, true)
    );
    assert!(!compiled(&lines(&[[1.0, 0.0]]), |_| ()).moves_in_z);
}

#[test]
fn an_arc_has_as_few_chords_as_its_tolerance_allows() {
    // A full circle of 50 mm: chords over φ are 50·(1 − cos(φ/2)) off, and 0.1 mm is φ = 7.2484°.
    let coarse = |settings: &mut Settings| settings.chord_tolerance_mm = 0.1;
    assert_eq!(
        compiled(&circle(50.0, [0.0, 0.0], false), coarse)
            .targets
            .len(),
        50
    );
    assert_eq!(
        compiled(&circle(50.0, [100.0, 0.0], true), coarse)
            .targets
            .len(),
        25
    );
    // However coarse, a circle is no point.
    let blind = |settings: &mut Settings| settings.chord_tolerance_mm = 1000.0;
    assert_eq!(
        compiled(&circle(5.0, [0.0, 0.0], false), blind)
            .targets
            .len(),
        3
    );
}

#[test]
fn an_arc_bends_the_way_it_is_told_to_and_ends_where_it_is_told_to() {
    // From the left end of the circle: clockwise goes up.
    for (clockwise, sign) in [(true, 1), (false, -1)] {
        let made = compiled(&circle(10.0, [20.0, 0.0], clockwise), |_| ());
        let (last, before) = made.targets.split_last().unwrap();
        assert_eq!((last.x, last.y), (4000, 0));
        assert!(before.iter().all(|target| target.y.signum() == sign));
    }
}

/// Distance of a point from the segment between two others.
fn distance(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let d = [b[0] - a[0], b[1] - a[1]];
    let v = [p[0] - a[0], p[1] - a[1]];
    let t = ((v[0] * d[0] + v[1] * d[1]) / (d[0] * d[0] + d[1] * d[1])).clamp(0.0, 1.0);
    (v[0] - t * d[0]).hypot(v[1] - t * d[1])
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    /// However long the drawing: no error adds up, and nothing is lost but what is counted.
    #[test]
    fn every_target_is_within_half_a_count_of_its_point(
        points in prop::collection::vec([-300.0..300.0f64, -300.0..300.0], 1..60),
        small in any::<bool>(),
        counts_per_mm in [1.0..500.0f64, 1.0..500.0],
    ) {
        let shrink = if small { 1e-3 } else { 1.0 };
        let points: Vec<_> = points.iter().map(|p| p.map(|mm| mm * shrink)).collect();
        let made = compiled(&lines(&points), |settings| {
            settings.counts_per_mm = counts_per_mm;
            // More than a count per scan in every direction.
            (settings.feed_mm_per_min, settings.scan_ticks) = (120_000.0, 2000);
        });
        prop_assert_eq!(made.targets.len() + made.dropped, points.len());
        let mut at = [0, 0];
        let mut targets = made.targets.iter().peekable();
        for (k, point) in points.iter().enumerate() {
            if let Some(target) = targets.next_if(|target| target.line == k + 1) {
                prop_assert_ne!([target.x, target.y], at, "a cycle without a way");
                at = [target.x, target.y];
            }
            for axis in 0..2 {
                let off = at[axis] as f64 - point[axis] * counts_per_mm[axis];
                prop_assert!(off.abs() <= 0.5 + 1e-9, "{} counts off", off);
            }
        }
        prop_assert!(targets.next().is_none());
    }

    /// The path goes no faster than the feed, and slower by less than the last bit of the fraction of
    /// the master axis's speed.
    #[test]
    fn the_feed_is_kept(
        to in [-300.0..300.0f64, -300.0..300.0],
        counts_per_mm in [5.0..500.0f64, 5.0..500.0],
        feed in 20_000.0..100_000.0f64,
    ) {
        prop_assume!(to[0].abs() + to[1].abs() > 1.0);
        let target = cycle(to[0], to[1], |settings| {
            settings.counts_per_mm = counts_per_mm;
            settings.feed_mm_per_min = feed;
        });
        let way = [target.x as f64 / counts_per_mm[0], target.y as f64 / counts_per_mm[1]];
        let longer = target.x.abs().max(target.y.abs()) as f64;
        let per_scan = |speed: u64| speed as f64 / 4096.0 / longer * way[0].hypot(way[1]);
        let wanted = feed / 60.0 / 1000.0;
        prop_assert!(per_scan(target.profiles[0].speed) <= wanted * (1.0 + 1e-9));
        prop_assert!(per_scan(target.profiles[0].speed + 1) > wanted);
    }

    /// With shortened times a move needs no more than its own acceleration and speed, and one scan
    /// less would need more.
    #[test]
    fn short_moves_keep_their_acceleration(
        counts in 1..20_000u64,
        whole in 1..200u64,
        times in [1..4095u64, 1..4095],
    ) {
        let target = cycle(counts as f64 / 200.0, 0.0, |settings| {
            settings.feed_mm_per_min = whole as f64 * 300.0;
            settings.rapid_mm_per_min = settings.feed_mm_per_min;
            settings.acceleration_ms = times[0] as f64;
            settings.deceleration_ms = times[1] as f64;
        });
        prop_assert_eq!(speed(&target), whole as f64);
        let made = scans(&target);
        if 2 * counts >= whole * (times[0] + times[1]) {
            prop_assert_eq!(made, times);
        } else {
            let k = (2.0 * counts as f64 / (whole * (times[0] + times[1])) as f64).sqrt();
            for (made, time) in made.into_iter().zip(times) {
                let exact = k * time as f64;
                prop_assert!(made >= 1 && made <= time);
                prop_assert!(made as f64 >= exact * (1.0 - 1e-12), "{} for {}", made, exact);
                prop_assert!((made as f64) < exact * (1.0 + 1e-12) + 1.0, "{} for {}", made, exact);
            }
        }
    }

    /// Chords stay within the tolerance, spirals as G-code allows them included.
    #[test]
    fn chords_stay_within_the_tolerance(
        radius in 0.05..500.0f64,
        end in 0.0..std::f64::consts::TAU,
        slack in -0.0009..0.0009f64,
        clockwise in any::<bool>(),
        tolerance in 1e-3..0.5f64,
    ) {
        let r = radius * (1.0 + slack);
        // From (0, 0), the left end, about (radius, 0).
        let to = [radius - r * end.cos(), -r * end.sin()];
        let counts = 1e5;
        let made = compiled(&circle(radius, to, clockwise), |settings| {
            settings.counts_per_mm = [counts; 2];
            settings.feed_mm_per_min = 60.0;
            settings.rapid_mm_per_min = 60.0;
            settings.chord_tolerance_mm = tolerance;
        });
        let mut corners = vec![[0.0, 0.0]];
        corners.extend(made.targets.iter().map(|t| [t.x as f64 / counts, t.y as f64 / counts]));
        // The arc itself: the angle goes from 0 to `end` one way or the other.
        let sweep = if clockwise { end - std::f64::consts::TAU } else { end };
        prop_assume!(end > 1e-3 && end < std::f64::consts::TAU - 1e-3);
        for k in 0..=500 {
            let share = f64::from(k) / 500.0;
            let (angle, rho) = (sweep * share, radius + (r - radius) * share);
            let on = [radius - rho * angle.cos(), -rho * angle.sin()];
            let near = corners.windows(2).map(|pair| distance(on, pair[0], pair[1]));
            let near = near.fold(f64::INFINITY, f64::min);
            prop_assert!(near <= tolerance * 1.001 + 2.0 / counts, "{} mm at {}", near, share);
        }
    }
}

#[test]
fn whole_drawings_are_taken() {
    for (name, text, ends) in [
        (
            "rosette.hpgl",
            include_bytes!("../../../waves/rosette.hpgl").as_slice(),
            [0, 0],
        ),
        (
            "bracket.ngc",
            include_bytes!("../../../waves/bracket.ngc"),
            [0, 0],
        ),
        (
            "plotter.hpgl",
            include_bytes!("../../../waves/plotter.hpgl"),
            [0, 0],
        ),
    ] {
        let drawing = read_text(name, text).unwrap();
        let made = compiled(&drawing, |_| ());
        let last = made.targets.last().unwrap();
        assert_eq!([last.x, last.y], ends, "{name}");
        assert!(
            made.targets.len() >= drawing.moves.len() - made.dropped,
            "{name}"
        );
        let lines: Vec<_> = made.targets.iter().map(|target| target.line).collect();
        assert!(lines.is_sorted(), "{name}");
    }
}
