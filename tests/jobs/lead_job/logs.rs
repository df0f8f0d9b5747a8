//! Position logs on the compensator.

use super::*;

/// A log of positions, a sample every 5 ms.
fn log(position: impl Fn(f64) -> i64, samples: u32) -> PositionLog {
    let mut text = "time, counts\n".to_owned();
    for sample in 0..samples {
        let seconds = f64::from(sample) * 5e-3;
        let _ = writeln!(text, "{}, {}", 1000 + sample * 5, position(seconds));
    }
    read("log.csv", text.as_bytes(), &Columns::default()).expect("a log")
}

/// A log at constant speed, and settings with N of 2, 10 and 1.
pub(super) fn steady() -> (PositionLog, Settings) {
    let log = log(|seconds| 500 + (8000.0 * seconds) as i64, 400);
    let step = |target, lead_ms| Step {
        target,
        speed_counts_per_s: 10_000,
        lead_ms,
        ..Step::default()
    };
    let settings = Settings {
        steps: vec![step(3000, 30.0), step(9000, 120.0), step(15_000, 5.0)],
        time_out_ms: 200.0,
        ..Settings::default()
    };
    let settings = settings_for(&log, &settings);
    (log, settings)
}

/// At constant speed every prediction is within its bound, and each signal comes when the body is
/// its lead away from the target.
#[test]
fn a_log_at_constant_speed_is_predicted_within_the_bound() {
    let (log, settings) = steady();
    let replayed = replay(&positioner(&settings), &settings, &log, &mut ()).unwrap();
    let signals = &replayed.signals;
    assert_eq!(signals.len(), 3, "{signals:?}");
    for (signal, ratio) in signals.iter().zip([2.0, 10.0, 1.0]) {
        let after = signal.position_after.expect("the log goes on");
        // The prediction's bound, and the way of a CK.
        let bound = ratio + 1.0 + 0.8 + 2.0;
        let error = (after - signal.target as f64).abs();
        assert!(error <= bound, "{signal:?}");
    }
    let predictions = replayed.predictions;
    assert!(predictions.count > 10_000);
    assert!(predictions.largest < 12.0, "{predictions:?}");
    assert!(
        predictions.rms_without > 30.0 * predictions.rms,
        "{predictions:?}"
    );
    assert!(!replayed.lost);
}

/// One target a turn, from the log's first sample on, and a lead by the speed.
#[test]
fn a_log_that_turns_on_gives_a_signal_a_turn() {
    let log = log(|seconds| 500 + (20_000.0 * seconds) as i64, 200);
    let mut settings = one_step(4000, 20_000, 1);
    settings.lead = LeadBy::Speed;
    settings.speed_lead_ms = 10.0;
    let settings = settings_for(&log, &settings);
    let replayed = replay(&positioner(&settings), &settings, &log, &mut ()).unwrap();
    let targets: Vec<_> = replayed
        .signals
        .iter()
        .map(|signal| signal.target)
        .collect();
    assert_eq!(targets, [4500, 8500, 12_500, 16_500, 20_500]);
    for signal in &replayed.signals {
        assert_eq!(signal.lead_ms, 10.0);
        let away = signal.target - signal.position;
        assert!((away - 200).abs() <= 4, "{signal:?}");
        // The log is over before the last target.
        let after = signal.position_after;
        assert_eq!(after.is_none(), signal.target == 20_500);
        assert!(after.is_none_or(|after| (after - signal.target as f64).abs() <= 4.0));
    }
}

/// A log that begins elsewhere than at 0, and goes down.
#[test]
fn a_log_is_taken_from_its_first_sample_on() {
    let log = log(|seconds| -7000 - (20_000.0 * seconds) as i64, 200);
    let step = |target| Step {
        target,
        speed_counts_per_s: 10_000,
        lead_ms: 10.0,
        ..Step::default()
    };
    let settings = Settings {
        steps: vec![step(-10_000), step(-20_000)],
        history: History::Ram,
        time_out_ms: 50.0,
        ..Settings::default()
    };
    let settings = settings_for(&log, &settings);
    let replayed = replay(&positioner(&settings), &settings, &log, &mut ()).unwrap();
    let targets: Vec<_> = replayed
        .signals
        .iter()
        .map(|signal| signal.target)
        .collect();
    assert_eq!(targets, [-10_000, -20_000]);
    for signal in &replayed.signals {
        let away = signal.position - signal.target;
        assert!((away - 200).abs() <= 5, "{signal:?}");
    }
}

/// A log goes on in any case, so operations are learned from on it.
#[test]
fn operations_on_a_log_are_learned() {
    let log = log(|seconds| 500 + (20_000.0 * seconds) as i64, 400);
    let mut settings = one_step(4000, 20_000, 1);
    settings.action = Action::Operate;
    settings.operation_delay_s = 0.03;
    let settings = settings_for(&log, &settings);
    let replayed = replay(&positioner(&settings), &settings, &log, &mut ()).unwrap();
    let errors: Vec<f64> = replayed
        .signals
        .iter()
        .filter_map(|signal| signal.effect_error_counts)
        .collect();
    assert_eq!(errors.len(), 9, "{:?}", replayed.signals);
    assert!((errors[0] - 200.0).abs() <= 6.0, "{errors:?}");
    assert!(
        errors[4..].iter().all(|error| error.abs() <= 4.0),
        "{errors:?}"
    );
}
