//! Settings: what is refused, and what gains make of a target.

use super::config;
use motion_rtl::circuits::trajectory_controller::Rounding;
use motion_rtl::circuits::trajectory_controller::Widths;
use motion_rtl::jobs::trajectory_controller::each_axis::EachAxis;
use motion_rtl::jobs::trajectory_controller::settings::{Correction, Settings};
use proptest::prelude::*;

const WIDTHS: Widths = Widths::FULL;

fn refused(change: impl FnOnce(&mut Settings)) -> String {
    let mut settings = Settings::default();
    change(&mut settings);
    settings.validate(&WIDTHS).unwrap_err().to_string()
}

#[test]
fn what_is_not_allowed_is_refused_with_what_is() {
    assert_eq!(Settings::default().validate(&WIDTHS), Ok(()));
    let gains = Settings::default().gains(&WIDTHS, 1).unwrap()[0];
    // 0.05 and 0.2 a period.
    assert_eq!([gains.k1, gains.k2], [1638, 6554]);
    let field = |text: String| text.split(':').next().unwrap_or_default().to_owned();
    type Change = fn(&mut Settings);
    let changes: [(&str, Change); 14] = [
        ("clock_hz", |s| s.clock_hz = 0),
        ("period_ms", |s| s.period_ms = 0.0),
        ("period_ms", |s| s.period_ms = f64::NAN),
        ("counts_per_mm", |s| s.counts_per_mm = 0.0),
        ("feed_mm_per_min", |s| s.feed_mm_per_min = Some(0.0)),
        ("rapid_mm_per_min", |s| s.rapid_mm_per_min = f64::INFINITY),
        ("acceleration_mm_per_s2", |s| {
            s.acceleration_mm_per_s2 = Some(0.0)
        }),
        ("normal_acceleration_mm_per_s2", |s| {
            s.normal_acceleration_mm_per_s2 = -1.0
        }),
        ("jerk_time_ms", |s| s.jerk_time_ms = -1.0),
        ("jerk_time_ms", |s| s.jerk_time_ms = f64::NAN),
        ("corner_mm_per_min", |s| s.corner_mm_per_min = -60.0),
        ("k1_per_s", |s| s.k1_per_s = f64::NAN.into()),
        ("k1_per_s", |s| s.k1_per_s = EachAxis::All(-50.0)),
        ("k2_per_s", |s| s.k2_per_s = f64::NAN.into()),
    ];
    for (name, change) in changes {
        assert_eq!(field(refused(change)), name);
    }
    assert_eq!(
        refused(|s| s.period_ms = 0.3),
        "period_ms: is 0.3; allowed: 0.4 to 16777.215 ms: 400 to 16777215 ticks"
    );
    assert_eq!(
        refused(|s| s.period_ms = 1.0005),
        "period_ms: is 1.0005: 1000.5 ticks; allowed: whole ticks: 1 or 1.001"
    );
    assert_eq!(
        refused(|s| s.k2_per_s = 100.0.into()),
        "k2_per_s: is 100: 0.100006103515625 a period; \
         allowed: 199.951171875 to 1999.969482421875: 0.199951171875 to 1.999969482421875 a \
         period; 4 times k1_per_s or more, or 2 times with allow_overshoot"
    );
    assert_eq!(
        refused(|s| s.k1_per_s = 600.0.into()),
        "k1_per_s: is 600: 0.600006103515625 a period; \
         allowed: 0.030517578125 to 499.969482421875: 0.000030517578125 to 0.499969482421875 a \
         period; there is a k2_per_s for it"
    );
    // Beyond the monotone region, on demand.
    let beyond = Settings {
        k1_per_s: 600.0.into(),
        k2_per_s: 1201.0.into(),
        allow_overshoot: true,
        ..Settings::default()
    };
    assert_eq!(beyond.validate(&WIDTHS), Ok(()));
    assert_eq!(
        field(refused(
            |s| (s.k1_per_s, s.allow_overshoot) = (1000.0.into(), true)
        )),
        "k1_per_s"
    );
    let damped = field(refused(|s| {
        (s.k2_per_s, s.allow_overshoot) = (99.0.into(), true)
    }));
    assert_eq!(damped, "k2_per_s");
    assert_eq!(field(refused(|s| s.k2_per_s = 2000.0.into())), "k2_per_s");
}

#[test]
fn a_time_is_that_to_each_feed() {
    let settings = |feed: Option<f64>, acceleration_time_ms| Settings {
        feed_mm_per_min: feed.map(|feed| 60.0 * feed),
        acceleration_time_ms: Some(acceleration_time_ms),
        ..Settings::default()
    };
    let motion = settings(Some(80.0), 50.0).motion(&WIDTHS).unwrap();
    assert_eq!(motion.slope.time_constant, 0.05);
    // To the rapid speed, 200 mm/s.
    let acceleration = motion.slope.acceleration / motion.units_per_mm;
    assert!(
        (acceleration / 4000.0 - 1.0).abs() < 1e-12,
        "{acceleration}"
    );
    assert_eq!(settings(None, 50.0).motion(&WIDTHS), Ok(motion));
    let text = |settings: Settings| settings.validate(&WIDTHS).unwrap_err().to_string();
    assert_eq!(
        text(Settings {
            acceleration_mm_per_s2: Some(2000.0),
            ..settings(Some(80.0), 50.0)
        }),
        "acceleration_time_ms: is 50 beside acceleration_mm_per_s2; allowed: one of both"
    );
    for bad in [0.0, -1.0, f64::NAN, 1.1e6] {
        assert_eq!(
            text(settings(Some(80.0), bad)),
            format!("acceleration_time_ms: is {bad}; allowed: 0.000001 to 1000000")
        );
    }
    let steep = text(settings(Some(1e5), 1e-5));
    assert!(
        steep.ends_with(" mm/s² to 100000 mm/s; allowed: 0.1 or more"),
        "{steep}"
    );
    let of_axes = |told| Settings {
        axis_acceleration_mm_per_s2: Some(told),
        ..Settings::default()
    };
    assert_eq!(
        text(of_axes(EachAxis::Each(vec![1000.0, 0.0]))),
        "axis_acceleration_mm_per_s2: is 0 for y; allowed: 0.001 to 1000000000"
    );
    assert_eq!(
        text(of_axes(EachAxis::All(f64::NAN))),
        "axis_acceleration_mm_per_s2: is NaN; allowed: 0.001 to 1000000000"
    );
}

#[test]
fn gains_by_axis_are_checked_one_by_one() {
    let settings = |k1: &[f64], k2: &[f64]| Settings {
        k1_per_s: EachAxis::Each(k1.to_vec()),
        k2_per_s: EachAxis::Each(k2.to_vec()),
        ..Settings::default()
    };
    let both = settings(&[50.0, 40.0], &[200.0, 250.0]);
    assert_eq!(both.validate(&WIDTHS), Ok(()));
    let gains = both.gains(&WIDTHS, 2).unwrap();
    let words = gains.iter().map(|gains| [gains.k1, gains.k2]);
    assert_eq!(words.collect::<Vec<_>>(), [[1638, 6554], [1311, 8192]]);
    assert_eq!(
        both.gains(&WIDTHS, 3).unwrap_err().to_string(),
        "k1_per_s: is a list of 2; allowed: a number for all axes, or a list of 3"
    );
    let text = |settings: &Settings| settings.gains(&WIDTHS, 2).unwrap_err().to_string();
    let slow = text(&settings(&[50.0, 60.0], &[200.0, 200.0]));
    assert!(
        slow.starts_with("k2_per_s: is 200: 0.20001220703125 a period for y; allowed: "),
        "{slow}"
    );
    let none = text(&settings(&[0.0, 60.0], &[200.0, 200.0]));
    assert!(
        none.starts_with("k1_per_s: is 0: 0 a period for x; "),
        "{none}"
    );
    // A number beside a list is that of all.
    let mixed = Settings {
        k2_per_s: 300.0.into(),
        ..both
    };
    assert_eq!(mixed.gains(&WIDTHS, 2).unwrap()[1].k2, 9830);
}

#[test]
fn the_word_holds_the_product_of_both_gains() {
    // 2^-9 and 2^-7 of a period: 16 bits, all there are.
    let gains = |k1: f64, k2: f64, rounding| Settings {
        k1_per_s: (k1 * 1e3).into(),
        k2_per_s: (k2 * 1e3).into(),
        rounding,
        ..Settings::default()
    };
    let two_to = |exponent: i32| f64::from(exponent).exp2();
    for (rounding, bits) in [(Rounding::Nearest, 16), (Rounding::Floor, 15)] {
        let (k1, k2) = (two_to(-9), two_to(9 - bits));
        assert_eq!(gains(k1, k2, rounding).validate(&WIDTHS), Ok(()));
        let less = gains(k1, k2 - two_to(-15), rounding);
        assert_eq!(less.validate(&WIDTHS).unwrap_err().field, "k2_per_s");
    }
}

/// 50/s and 200/s in a tenth of a millisecond are 163.84 and 655.36: 164 and 655 would overshoot.
#[test]
fn rounding_alone_does_not_make_the_model_overshoot() {
    let settings = Settings {
        clock_hz: 10_000_000,
        period_ms: 0.1,
        ..Settings::default()
    };
    let gains = settings.gains(&WIDTHS, 1).unwrap()[0];
    assert_eq!([gains.k1, gains.k2], [163, 655]);
    let less = Settings {
        k2_per_s: 199.9.into(),
        ..settings
    };
    assert_eq!(less.gains(&WIDTHS, 1).unwrap_err().field, "k2_per_s");
}

#[test]
fn units_are_those_of_the_words() {
    let settings = Settings {
        jerk_time_ms: 20.0,
        ..Settings::default()
    };
    let motion = settings.motion(&WIDTHS).unwrap();
    assert_eq!(motion.units_per_mm, 65_536_000.0);
    assert_eq!(motion.period, 1e-3);
    assert_eq!(motion.slope.acceleration, 2000.0 * 65_536_000.0);
    assert_eq!(motion.slope.jerk_time, 0.02);
    let names = [Correction::Vector, Correction::None, Correction::Steady].map(Correction::name);
    assert_eq!(names, ["vector", "none", "steady"]);
}

/// Positions in units of 2^-16 count from rest at 0 on, by the model's equations.
fn response(target: i128, [k1, k2]: [i128; 2], rounding: Rounding) -> Vec<i128> {
    let (mut p, mut v) = (0i128, 0i128);
    let mut positions = vec![0];
    for _ in 0..1_000_000 {
        let twice = k2 * (k1 * (target - p) - (v << 15));
        let amount = match rounding {
            Rounding::Nearest => (twice.abs() + (1 << 29)) >> 30,
            Rounding::Floor => twice.abs() >> 30,
        };
        let before = (p, v);
        (p, v) = (p + v, v + amount * twice.signum());
        positions.push(p);
        if before == (p, v) {
            break;
        }
    }
    positions
}

proptest! {
    #![proptest_config(config(1000))]

    #[test]
    fn allowed_gains_come_to_the_count_without_going_beyond_it(
        k1 in -15.0..0.0f64,
        k2 in -15.0..1.0f64,
        counts in 1..1i64 << 20,
        floor in any::<bool>(),
    ) {
        let settings = Settings {
            k1_per_s: (1e3 * k1.exp2()).into(),
            k2_per_s: (1e3 * k2.exp2()).into(),
            rounding: if floor { Rounding::Floor } else { Rounding::Nearest },
            ..Settings::default()
        };
        let Ok(gains) = settings.gains(&WIDTHS, 1) else {
            // Refused: nothing is said of them.
            return Ok(());
        };
        let target = i128::from(counts) << 16;
        let gains = [gains[0].k1, gains[0].k2].map(i128::from);
        let positions = response(target, gains, settings.rounding);
        let nearest = |position: i128| (position + (1 << 15)) >> 16;
        prop_assert_eq!(nearest(positions[positions.len() - 1]), i128::from(counts));
        prop_assert!(positions.iter().all(|&p| nearest(p) <= i128::from(counts)));
    }
}
