//! Settings: every field's limits, with their texts.

use motion_rtl::circuits::arc_generator::Widths;
use motion_rtl::jobs::arc_generator::settings::Settings;
use motion_rtl::settings::SettingError;

const FULL: Widths = Widths::FULL;

fn refusal(change: impl Fn(&mut Settings)) -> SettingError {
    let mut settings = Settings::default();
    change(&mut settings);
    settings.validate(&FULL).unwrap_err()
}

#[test]
fn the_default_is_allowed_and_in_samples() {
    let settings = Settings::default();
    let timing = settings.timing(&FULL).unwrap();
    assert_eq!(settings.sample_ticks(&FULL), Ok(1000));
    assert_eq!((timing.sample_s, timing.blend_samples), (1e-3, 64));
    assert_eq!(timing.half_blend_s(), 0.032);
    assert!((timing.corner - 20f64.to_radians()).abs() < 1e-15);
    assert_eq!(timing.most_samples, (1 << 20) - 1);
}

#[test]
fn every_field_has_its_limits() {
    let shown = |change: fn(&mut Settings)| refusal(change).to_string();
    assert_eq!(
        shown(|s| s.clock_hz = 0),
        "clock_hz: is 0; allowed: 1 to 10000000000"
    );
    assert_eq!(
        shown(|s| s.sample_period_ms = 0.08),
        "sample_period_ms: is 0.08; allowed: 0.082 to 16777.215 ms: 82 to 16777215 ticks"
    );
    assert_eq!(
        shown(|s| s.sample_period_ms = f64::NAN),
        "sample_period_ms: is NaN; allowed: 0.082 to 16777.215 ms: 82 to 16777215 ticks"
    );
    assert_eq!(
        shown(|s| s.sample_period_ms = 0.5005),
        "sample_period_ms: is 0.5005: 500.5 ticks; allowed: whole ticks: 0.5 or 0.501"
    );
    assert_eq!(
        shown(|s| s.acceleration_ms = 65.0),
        "acceleration_ms: is 65: 65 samples; allowed: an even number of samples: 64 or 66"
    );
    assert_eq!(
        shown(|s| s.acceleration_ms = 63.5),
        "acceleration_ms: is 63.5: 63.5 samples; allowed: an even number of samples: 62 or 64"
    );
    assert_eq!(
        shown(|s| s.acceleration_ms = 1.5),
        "acceleration_ms: is 1.5: 1.5 samples; allowed: an even number of samples: 2"
    );
    assert_eq!(
        shown(|s| s.acceleration_ms = 1025.0),
        "acceleration_ms: is 1025: 1025 samples; allowed: an even number of samples: 1024"
    );
    assert_eq!(
        shown(|s| s.acceleration_ms = 1026.0),
        "acceleration_ms: is 1026; allowed: 2 to 1024 ms: 2 to 1024 samples"
    );
    assert_eq!(
        shown(|s| s.acceleration_ms = 0.0),
        "acceleration_ms: is 0; allowed: 2 to 1024 ms: 2 to 1024 samples"
    );
    assert_eq!(
        shown(|s| s.counts_per_mm = 0.0),
        "counts_per_mm: is 0; allowed: 0.000001 to 1000000000"
    );
    assert_eq!(
        shown(|s| s.feed_mm_per_min = Some(0.0)),
        "feed_mm_per_min: is 0; allowed: 0.00006 to 60000000000"
    );
    assert_eq!(
        shown(|s| s.rapid_mm_per_min = f64::INFINITY),
        "rapid_mm_per_min: is inf; allowed: 0.00006 to 60000000000"
    );
    assert_eq!(
        shown(|s| s.corner_deg = 180.5),
        "corner_deg: is 180.5; allowed: 0 to 180"
    );
    assert_eq!(refusal(|s| s.corner_deg = -1.0).field, "corner_deg");
}

#[test]
fn decimal_fractions_are_whole_samples() {
    for (period, acceleration, ticks, samples) in [
        (0.1, 0.6, 100, 6),
        (0.3, 64.2, 300, 214),
        (0.7, 1.4, 700, 2),
        (1.1, 1126.4, 1100, 1024),
    ] {
        let settings = Settings {
            sample_period_ms: period,
            acceleration_ms: acceleration,
            ..Settings::default()
        };
        assert_eq!(settings.sample_ticks(&FULL), Ok(ticks));
        assert_eq!(settings.timing(&FULL).unwrap().blend_samples, samples);
    }
}

#[test]
fn the_longest_blend_is_that_of_the_modulus() {
    assert_eq!(FULL.most_blend_samples(), 1024);
    assert_eq!(Widths::narrow(8).most_blend_samples(), 16);
    assert_eq!(Widths::narrow(4).most_blend_samples(), 4);
    assert_eq!((FULL.guard(), FULL.coefficient_fraction()), (16, 40));
    assert_eq!(FULL.reach(), 8_388_607);
    assert!(FULL.holds(8_388_607.4) && !FULL.holds(8_388_607.5));
    assert!(FULL.holds(-8_388_607.4) && !FULL.holds(f64::NAN));
    assert_eq!(Widths::needed(8_388_607.5), 25);
}
