//! Drawings and settings that are refused.

use super::{circle, compiled, lines};
use motion_rtl::input::Drawing;
use motion_rtl::jobs::linear_interpolator::settings::Settings;
use motion_rtl::jobs::linear_interpolator::targets::{TargetError, compile};

#[test]
fn what_cannot_be_played_is_refused() {
    let refusal = |drawing: &Drawing, change: &dyn Fn(&mut Settings)| {
        let mut settings = Settings::default();
        change(&mut settings);
        compile(drawing, &settings).unwrap_err()
    };
    let mut d = lines(&[[1.0, 0.0], [2.0, 0.0]]);
    super::change(&mut d, 1, |step| step.feed_mm_per_min = Some(18_000.5));
    let feed = TargetError::Feed {
        line: 2,
        value: 18_000.5,
        most: 18_000.0,
    };
    assert_eq!(refusal(&d, &|_| ()), feed);
    super::change(&mut d, 1, |step| step.feed_mm_per_min = Some(300_000.0));
    let fastest = |settings: &mut Settings| settings.full_speed_mm_per_min = Some(300_000.0);
    let made = compiled(&d, fastest);
    assert_eq!(made.targets[1].profiles[0].counts_per_scan(), 1000.0);

    let far = lines(&[[1e6, 0.0], [0.0, -1e6]]);
    let wide = |settings: &mut Settings| settings.counts_per_mm = [100.0, 1074.0];
    let position = TargetError::Position {
        line: 2,
        axis: "y",
        counts: -1_074_000_000.0,
    };
    assert_eq!(refusal(&far, &wide), position);
    // 2^30 itself is in reach.
    let just = lines(&[[1_073_741.824, 0.0]]);
    assert!(
        compile(&just, &Settings::default()).is_err(),
        "out of the reader's reach"
    );
    let just = lines(&[[107_374.182_4, 0.0]]);
    let made = compiled(&just, |settings| {
        settings.counts_per_mm = [1e4, 1.0];
        settings.rapid_mm_per_min = 6000.0;
    });
    assert_eq!(made.targets[0].x, 1 << 30);

    let mut many = circle(3e5, [0.0, 0.0], false);
    super::change(&mut many, 0, |step| step.line = 7);
    let fine = |settings: &mut Settings| {
        settings.chord_tolerance_mm = 1e-6;
        settings.counts_per_mm = [1000.0; 2];
    };
    assert_eq!(refusal(&many, &fine), TargetError::TooMany { line: 7 });

    let nan = lines(&[[f64::NAN, 0.0]]);
    assert!(matches!(refusal(&nan, &|_| ()), TargetError::Drawing(_)));
}

type Change<'a> = &'a dyn Fn(&mut Settings);

#[test]
fn every_setting_is_refused_by_name_value_and_range() {
    assert_eq!(Settings::default().validate(), Ok(()));
    let cases: [(Change, &str); 27] = [
        (
            &|s| s.full_speed_mm_per_min = Some(300_001.0),
            "full_speed_mm_per_min: is 300001; allowed: 0.001 to 300000",
        ),
        (
            &|s| s.full_speed_mm_per_min = Some(17_999.0),
            "rapid_mm_per_min: is 18000; allowed: 0.001 to 17999",
        ),
        (
            &|s| s.clock_hz = 0,
            "clock_hz: is 0; allowed: 1 to 10000000000",
        ),
        (
            &|s| s.scan_ticks = 185,
            "scan_ticks: is 185; allowed: 186 to 16777215",
        ),
        (
            &|s| s.scan_ticks = 1 << 24,
            "scan_ticks: is 16777216; allowed: 186 to 16777215",
        ),
        (
            &|s| s.counts_per_mm[1] = 0.0,
            "counts_per_mm: is 0 for y; allowed: 0.000001 to 1000000000",
        ),
        (
            &|s| s.counts_per_mm[0] = -80.0,
            "counts_per_mm: is -80 for x; ",
        ),
        (
            &|s| s.counts_per_mm[0] = f64::NAN,
            "counts_per_mm: is NaN for x; ",
        ),
        (
            &|s| s.feed_mm_per_min = 0.0,
            "feed_mm_per_min: is 0; allowed: 0.001 to 300000",
        ),
        (
            &|s| s.feed_mm_per_min = 300_001.0,
            "feed_mm_per_min: is 300001; allowed: 0.001 to 300000",
        ),
        (
            &|s| s.rapid_mm_per_min = f64::INFINITY,
            "rapid_mm_per_min: is inf; allowed: 0.001 to 300000",
        ),
        (
            &|s| s.counts_per_mm[1] = 4e3,
            "rapid_mm_per_min: is 18000; allowed: 0.001 to 15000",
        ),
        (
            &|s| s.acceleration_ms = -1.0,
            "acceleration_ms: is -1; allowed: 0 to 4095",
        ),
        (
            &|s| s.acceleration_ms = 4095.1,
            "acceleration_ms: is 4095.1; allowed: 0 to 4095",
        ),
        (
            &|s| s.deceleration_ms = f64::NAN,
            "deceleration_ms: is NaN; allowed: 0 to 4095",
        ),
        (
            &|s| s.chord_tolerance_mm = 0.0,
            "chord_tolerance_mm: is 0; allowed: 0.000001 to 1000",
        ),
        (
            &|s| s.in_position_counts = 0,
            "in_position_counts: is 0; allowed: 1 to 1000000",
        ),
        (
            &|s| s.position_gain_per_s[0] = 1001.0,
            "position_gain_per_s: is 1001 for x; allowed: 0.001 to 1000",
        ),
        (
            &|s| s.position_gain_per_s[1] = 0.0,
            "position_gain_per_s: is 0 for y; ",
        ),
        (
            &|s| s.counts_per_rev[0] = 3,
            "counts_per_rev: is 3 for x; allowed: 4 to 100000000",
        ),
        (
            &|s| s.rated_speed_rev_per_min[1] = 15_001.0,
            "rated_speed_rev_per_min: is 15001 for y; allowed: 0.001 to 15000",
        ),
        (
            &|s| s.rated_speed_rev_per_min[1] = 0.0,
            "rated_speed_rev_per_min: is 0 for y; ",
        ),
        (
            &|s| s.velocity_loop_ms[0] = 0.0,
            "velocity_loop_ms: is 0 for x; allowed: 0.001 to 10000",
        ),
        (
            &|s| s.inertia_kg_m2[0] = 0.0,
            "inertia_kg_m2: is 0 for x; allowed: 0.000000001 to 1000",
        ),
        (
            &|s| s.max_torque_nm[1] = -1.0,
            "max_torque_nm: is -1 for y; allowed: 0.000001 to 1000000",
        ),
        (
            &|s| s.friction_nm[1] = 0.9,
            "friction_nm: is 0.9 for y; allowed: 0 to below max_torque_nm, 0.9",
        ),
        (&|s| s.friction_nm[0] = -0.1, "friction_nm: is -0.1 for x; "),
    ];
    for (change, expected) in cases {
        let mut settings = Settings::default();
        change(&mut settings);
        let message = settings.validate().unwrap_err().to_string();
        assert!(message.starts_with(expected), "{message}");
    }
}
