//! Absolute encoders, phase-shift transducers and resolvers as the position detector.

use super::*;
use std::f64::consts::TAU;

/// An absolute encoder, whose clock is CK, beside a counter: both learn to within a code, and over the
/// seams of the turn as elsewhere.
#[test]
#[ignore = "takes long"]
fn an_absolute_encoder_is_as_good_as_a_counter() {
    let absolute = Settings {
        detector: Detector::Absolute,
        ..turntable()
    };
    let [absolute_played, counted] = [&absolute, &turntable()].map(with_lead);
    for step in 0..absolute.steps.len() {
        let [before, after] = phases(&absolute, &absolute_played, step);
        for one in [before[5], after[5]] {
            assert!(off(one) <= code_travel(&absolute, one), "{one:?}");
        }
    }
    // The first stops are those of the same lead times.
    let pairs = absolute_played
        .positionings
        .iter()
        .zip(&counted.positionings);
    for (one, other) in pairs.take(4) {
        let per_ck = other.speed_counts_per_s.abs() * absolute.ck_ms() / 1e3;
        assert!(
            ((one.error - other.error) as f64).abs() <= 3.0 * per_ck,
            "{one:?} {other:?}"
        );
    }
    // Half a turn a step, on and on: 20 seams.
    let mut turning = one_step(45_000, 90_000, 40);
    turning.detector = Detector::Absolute;
    let played = with_lead(&turning);
    assert_eq!(played.positionings[39].target, 40 * 45_000);
    for one in &played.positionings[6..] {
        assert!(off(one) <= code_travel(&turning, one), "{one:?}");
    }
}

/// A clock that is off is off in all lead times: what is kept is wrong by as much, what is learned is
/// not.
#[test]
fn a_sampling_clock_that_is_off_is_learned() {
    let fixed = |ppm: f64| {
        let mut settings = one_step(45_000, 90_000, 2);
        settings.steps[0].lead_ms = 40.0;
        settings.learn = false;
        settings.detector = Detector::Absolute;
        settings.sampling_clock_ppm = ppm;
        with_lead(&settings).positionings[1].error
    };
    // 1 % of 40 ms at 90,000 counts/s.
    let off_by = fixed(10_000.0) - fixed(0.0);
    assert!((off_by - 36).abs() <= 12, "{off_by}");
    let mut learned = one_step(45_000, 90_000, 8);
    learned.detector = Detector::Absolute;
    learned.sampling_clock_ppm = -10_000.0;
    let played = with_lead(&learned);
    assert!(off(&played.positionings[7]) <= code_travel(&learned, &played.positionings[7]));
}

/// The turntable with 1,200 pitches of 75 counts to a turn, and a carrier of 10 kHz.
fn phase_shift() -> Settings {
    Settings {
        detector: Detector::PhaseShift,
        clock_hz: 750_000,
        ck_ticks: 75,
        ..turntable()
    }
}

/// A phase-shift detector, whose carrier is CK: its place is up to a CK old, which is learned as any
/// other delay. What the place in the pitch makes of it is a CK's way to either side, N-fold.
#[test]
#[ignore = "takes long"]
fn a_phase_shift_detector_is_learned_to_a_codes_travel_and_its_own_unevenness() {
    let settings = Settings {
        positionings: 24,
        load_change_after: None,
        ..phase_shift()
    };
    let played = with_lead(&settings);
    let counted = with_lead(&Settings {
        detector: Detector::Incremental,
        ..settings.clone()
    });
    for (one, other) in played
        .positionings
        .iter()
        .zip(&counted.positionings)
        .skip(20)
    {
        let travel = code_travel(&settings, one);
        assert!(off(other) <= travel, "{other:?}");
        assert!(off(one) <= 2.0 * travel, "{one:?} {travel}");
        // Half a CK is no more than a step of its grid.
        assert!(one.code.abs_diff(other.code) <= 6, "{one:?} {other:?}");
    }
    // Pitch after pitch, turn after turn.
    let turning = Settings {
        targets: Targets::Relative,
        steps: one_step(45_000, 90_000, 10).steps,
        positionings: 10,
        ..settings
    };
    let played = with_lead(&turning);
    assert_eq!(played.positionings[9].target, 450_000);
    for one in &played.positionings[6..] {
        assert!(off(one) <= 2.0 * code_travel(&turning, one), "{one:?}");
    }
}

/// At the fastest speed that is accepted nothing is lost, in either direction.
#[test]
fn the_fastest_speed_of_a_phase_shift_detector_is_followed() {
    for way in [45_000, -45_000] {
        let mut settings = phase_shift();
        settings.body.acceleration_counts_per_s2 = 3e6;
        let fastest = settings.fastest_counts_per_s() / 10 * 10;
        assert_eq!(fastest, 100_660);
        settings.targets = Targets::Relative;
        settings.steps = one_step(way, fastest, 2).steps;
        (settings.positionings, settings.load_change_after) = (2, None);
        with_lead(&settings);
        settings.steps[0].speed_counts_per_s += 10;
        let refused = settings.validate().expect_err("too fast");
        assert!(refused.to_string().contains("10 to 100661"), "{refused}");
    }
}

/// A resolver is learned as a counter is. What is wrong with its windings is in the position where the
/// body stops, and the same at each stop of a step: learning has its code nevertheless.
#[test]
fn a_resolver_is_as_good_as_a_counter_but_for_its_windings() {
    let mut settings = Settings {
        detector: Detector::Resolver,
        positionings: 24,
        load_change_after: None,
        ..turntable()
    };
    let counted = with_lead(&Settings {
        detector: Detector::Incremental,
        ..settings.clone()
    });
    for (offset, mismatch) in [(0.0, 0.0), (0.01, 0.0), (0.0, -0.02)] {
        (
            settings.resolver.sine_offset,
            settings.resolver.gain_mismatch,
        ) = (offset, mismatch);
        let played = with_lead(&settings);
        let pairs = played.positionings.iter().zip(&counted.positionings);
        for (one, other) in pairs.skip(20) {
            let travel = code_travel(&settings, one);
            assert!(off(one) <= travel + 2.0, "{one:?} {travel}");
            assert!(one.code.abs_diff(other.code) <= 4, "{one:?} {other:?}");
        }
        let per_rad = 22_500.0 / TAU;
        for one in &played.positionings {
            let angle = one.stopped as f64 / per_rad;
            let wrong = offset * angle.cos() + mismatch / 2.0 * (2.0 * angle).sin();
            let left = one.position_error_counts - wrong * per_rad;
            assert!((-3.0..=2.0).contains(&left), "{offset} {mismatch} {one:?}");
        }
    }
}

/// At the fastest speed that is accepted nothing is lost, in either direction, with small
/// pitches.
#[test]
fn the_fastest_speed_of_a_resolver_is_followed() {
    for way in [45_000, -45_000] {
        let mut settings = Settings {
            detector: Detector::Resolver,
            targets: Targets::Relative,
            ..turntable()
        };
        // 50 of the 400 counts of a pitch in 0.1 ms.
        settings.resolver.pole_pairs = 64;
        settings.body.counts_per_rev = 25_600.0;
        settings.body.acceleration_counts_per_s2 = 6e6;
        let fastest = settings.fastest_counts_per_s();
        assert_eq!(fastest, 500_000);
        settings.steps = one_step(way, fastest, 2).steps;
        (settings.positionings, settings.load_change_after) = (2, None);
        with_lead(&settings);
    }
}
