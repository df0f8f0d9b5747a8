//! Known cases.

use super::judge::{arc, drawing, line, play, run};
use motion_rtl::input::Drawing;
use motion_rtl::jobs::pulse_interpolator::{
    Ratio, Settings, StepTiming, Table, TableError, compile,
};
use motion_rtl::plan::MotionLimits;

/// Unit times of 1000 ticks at 1 MHz, no timing limits.
fn plain() -> Settings {
    Settings {
        clock_hz: 1_000_000,
        steps_per_mm: vec![100.0, 100.0],
        timing: StepTiming {
            step_high_ticks: 1,
            step_low_ticks: 1,
            dir_setup_ticks: 0,
            dir_hold_ticks: 0,
        },
        ..Settings::default().with_period(1000)
    }
}

#[test]
fn no_motion_needs_no_units() {
    for moves in [vec![], vec![line(5.0, 5.0), line(5.0, 5.0)]] {
        let (table, report) = run(&drawing([5.0, 5.0, 0.0], moves), &plain());
        assert_eq!(
            (table.units(), report.total_ticks, report.appended_units),
            (0, 0, 0)
        );
        assert!(table.patterns().is_empty());
    }
}

#[test]
fn less_than_half_a_step_gives_no_pulse_and_half_a_step_one() {
    let (table, report) = run(&drawing([0.0; 3], vec![line(0.0049, 0.0)]), &plain());
    assert!(table.units() > 0 && report.axes[0].pulses_emitted() == 0);
    assert!((report.axes[0].following_error.steps - 0.49).abs() < 1e-4);
    let (_, report) = run(&drawing([0.0; 3], vec![line(0.005, -0.005)]), &plain());
    assert_eq!(
        (
            report.axes[0].pulses_forward,
            report.axes[1].pulses_backward
        ),
        (1, 1)
    );
}

#[test]
fn single_step_is_one_pulse_in_the_last_units() {
    let (table, report) = run(&drawing([0.0; 3], vec![line(0.01, 0.0)]), &plain());
    assert_eq!(
        (report.axes[0].pulses_forward, report.appended_units),
        (1, 0)
    );
    let with_pulse: Vec<_> = table
        .iter()
        .filter(|(_, w)| w[0].half_period() > 0)
        .collect();
    assert_eq!(with_pulse.len(), 1);
    assert_eq!(
        with_pulse[0].1[0].half_period(),
        500,
        "one pulse: half of T"
    );
}

#[test]
fn negative_steps_per_mm_reverse_the_axis() {
    let settings = Settings {
        steps_per_mm: vec![-100.0],
        ..plain()
    };
    let (table, report) = run(&drawing([0.0; 3], vec![line(2.0, 7.0)]), &settings);
    assert_eq!((table.axes(), report.axes[0].end_position), (1, -200));
    assert_eq!(report.undriven, ["Y"]);
}

#[test]
fn attainable_path_follows_within_half_a_step() {
    let moves = vec![
        line(20.0, 7.0),
        arc(30.0, 17.0, [20.0, 17.0], false),
        line(-3.0, 2.5),
    ];
    let (_, report) = run(&drawing([1.0, -1.0, 0.0], moves), &plain());
    assert_eq!(
        (
            report.unattainable_units,
            report.appended_units,
            report.remedy
        ),
        (0, 0, None)
    );
    for axis in report.axes {
        let error = axis.following_error;
        assert!(error.steps > 0.4 && error.steps <= 1.0 + 1e-4, "{error:?}");
        let begin = error.unit as f64 * 1e-3;
        assert!((begin..=begin + 1e-3 + 1e-9).contains(&error.time_s));
        assert!((1..=3).contains(&error.line));
    }
}

/// A feed of 60 steps per unit time, where from 27 on few counts exist.
fn fast() -> (Drawing, Settings) {
    let motion = MotionLimits {
        feed_mm_per_min: 36_000.0,
        ..MotionLimits::default()
    };
    let moves = vec![line(3000.0, 1000.0), line(3000.0, 1000.5)];
    (drawing([0.0; 3], moves), Settings { motion, ..plain() })
}

#[test]
fn unattainable_demand_is_carried_reported_and_remedied() {
    let (path, settings) = fast();
    let (_, report) = run(&path, &settings);
    assert!(report.unattainable_units > 1000);
    assert!(report.axes[0].unattainable_units >= report.axes[1].unattainable_units);
    // The counts about 57 are 55 and 62: the error is bounded by half the gap and the rounding.
    let worst = report.axes[0].following_error.steps;
    assert!(worst > 1.0 && worst <= 5.0, "{worst}");
    let remedy = report.remedy.unwrap();
    assert!(remedy.largest && remedy.period < 1000);
    let (_, remedied) = run(&path, &settings.with_period(remedy.period));
    assert_eq!((remedied.unattainable_units, remedied.remedy), (0, None));
    assert!(
        remedied
            .axes
            .iter()
            .all(|a| a.following_error.steps <= 1.5 + 1e-4)
    );
    for period in (remedy.period + 1..1000).take(12) {
        let (_, report) = compile(&path, &settings.with_period(period)).unwrap();
        assert!(
            report.unattainable_units > 0,
            "T = {period} would do as well"
        );
    }
}

#[test]
fn demand_beyond_every_unit_time_has_no_remedy_and_still_ends() {
    let (path, mut settings) = fast();
    // 60 steps in 1000 ticks, of which no two may be closer than 40.
    settings.timing = StepTiming {
        step_high_ticks: 20,
        step_low_ticks: 20,
        dir_setup_ticks: 0,
        dir_hold_ticks: 0,
    };
    let (_, report) = run(&path, &settings);
    assert!(report.appended_units > 1000 && report.unattainable_units > 0);
    assert_eq!(report.remedy, None);
}

#[test]
fn lines_and_arcs_have_their_own_unit_times() {
    let moves = vec![
        line(10.0, 0.0),
        arc(20.0, 10.0, [10.0, 10.0], false),
        arc(10.0, 20.0, [10.0, 10.0], false),
        line(0.0, 20.0),
    ];
    let settings = Settings {
        line_unit_ticks: 1000,
        arc_unit_ticks: 400,
        ..plain()
    };
    let (table, _) = run(&drawing([0.0; 3], moves), &settings);
    let periods: Vec<_> = table.patterns().iter().map(|p| p.period).collect();
    assert_eq!(periods, [1000, 400, 1000]);
    let mut next = 0;
    for pattern in table.patterns() {
        assert_eq!(pattern.first_unit, next);
        next += pattern.length;
    }
    assert_eq!(next, table.units());
}

/// Reversals at full speed, some in the middle of a unit and some in every unit, with timing that
/// the recipe's pulses do not keep.
#[test]
fn direction_timing_is_kept_at_every_reversal() {
    let motion = MotionLimits {
        corner_mm_per_min: 1e6,
        acceleration_mm_per_s2: 1e6,
        feed_mm_per_min: 6000.0,
        ..MotionLimits::default()
    };
    let free = Settings { motion, ..plain() };
    for width in [0.9, 0.07, 0.1, 0.15] {
        let zigzag = |k: u32| {
            line(
                if k.is_multiple_of(2) { 0.0 } else { width },
                f64::from(k) * 0.05,
            )
        };
        let path = drawing([0.0; 3], (1..200).map(zigzag).collect());
        let (table, _) = run(&path, &free);
        let played = play(&table, 0);
        assert!(
            played.min_setup < Some(200) && played.min_hold < Some(200),
            "{played:?}"
        );
        for (dir_setup, dir_hold) in [(0, 300), (300, 0), (300, 300), (300, 650), (999, 1000)] {
            let timing = StepTiming {
                dir_setup_ticks: dir_setup,
                dir_hold_ticks: dir_hold,
                ..free.timing
            };
            run(
                &path,
                &Settings {
                    timing,
                    ..free.clone()
                },
            );
        }
    }
}

#[test]
fn a_unit_never_steps_against_the_motion_of_its_axis() {
    let (path, settings) = fast();
    let (table, report) = compile(&path, &settings).unwrap();
    let on_path = table.units() - report.appended_units;
    assert!(
        table
            .iter()
            .take(on_path)
            .all(|(_, w)| w.iter().all(|w| !w.negative()))
    );
}

/// Where the nearest count would run ahead of the last position 32 bits hold.
#[test]
fn positions_stay_within_32_bits() {
    let (_, fast) = fast();
    for feed in 30..60 {
        let motion = MotionLimits {
            feed_mm_per_min: f64::from(feed),
            acceleration_mm_per_s2: 1e6,
            ..MotionLimits::default()
        };
        let settings = Settings {
            motion,
            steps_per_mm: vec![1e5],
            ..fast.clone()
        };
        let last = f64::from(i32::MAX) / 1e5;
        let path = drawing([last - 0.1, 0.0, 0.0], vec![line(last, 0.0)]);
        let (_, report) = run(&path, &settings);
        assert_eq!(report.axes[0].end_position, i32::MAX);
    }
}

#[test]
fn faults_of_settings_and_input_are_errors() {
    let path = drawing([0.0; 3], vec![line(1.0, 1.0)]);
    let bad = Settings {
        clock_hz: 0,
        ..plain()
    };
    assert!(matches!(
        compile(&path, &bad),
        Err(TableError::Setting(error)) if error.field == "clock_hz"
    ));
    let bad = Settings {
        steps_per_mm: vec![1e9, 1.0],
        ..plain()
    };
    let far = drawing([0.0; 3], vec![line(0.0, 1.0), line(3.0, 1.0)]);
    let error = compile(&far, &bad).unwrap_err();
    assert!(
        matches!(
            error,
            TableError::Position {
                axis: "X",
                line: 2,
                ..
            }
        ),
        "{error}"
    );
    let nowhere = drawing([0.0; 3], vec![line(f64::NAN, 1.0)]);
    assert!(matches!(
        compile(&nowhere, &plain()),
        Err(TableError::Plan(_))
    ));
    let motion = MotionLimits {
        feed_mm_per_min: 0.001,
        ..MotionLimits::default()
    };
    let error = compile(&path, &Settings { motion, ..plain() }).unwrap_err();
    assert!(matches!(error, TableError::TooLong { .. }), "{error}");
}

#[test]
#[ignore = "takes long"]
fn a_million_points() {
    let moves = (1..=1_000_000_u32).map(|k| {
        let angle = f64::from(k) * 1e-3;
        line(angle, 30.0 * angle.sin())
    });
    let path = drawing([0.0; 3], moves.collect());
    let (table, report) = run(
        &path,
        &Settings {
            clock_hz: 500_000,
            ..plain()
        },
    );
    assert_eq!(report.axes[0].pulses_forward, 100_000);
    assert!(table.units() > 100_000 && report.unattainable_units == 0);
}

#[test]
fn scaled_table_reports_what_it_emits() {
    let moves = vec![
        line(20.0, 7.0),
        arc(30.0, 17.0, [20.0, 17.0], false),
        line(-3.0, 2.5),
    ];
    let (table, _) = run(&drawing([0.0; 3], moves), &plain());
    for (num, den) in [(1, 1), (2, 1), (3, 1), (1, 2), (3, 7)] {
        let scaled = table.scaled(Ratio { num, den }).unwrap();
        assert_eq!(scaled.table.patterns(), table.patterns());
        let r = f64::from(num) / f64::from(den);
        for (k, axis) in scaled.axes.iter().enumerate() {
            let net = |t: &Table| play(t, k).forward as f64 - play(t, k).backward as f64;
            let drift = net(&scaled.table) - net(&table) / r;
            assert!((axis.drift - drift).abs() < 1e-6, "{axis:?}");
            if den == 1 {
                assert!(axis.largest_deviation <= 1.0 && axis.rounded_units == 0);
            }
        }
    }
    let same = table.scaled(Ratio { num: 5, den: 5 }).unwrap();
    assert_eq!(same.table, table);
    assert!(table.scaled(Ratio { num: 0, den: 1 }).is_err());
}

/// Corners taken at speed: the path turns within unit times, whose ends know nothing of it.
#[test]
fn a_turn_within_a_unit_is_part_of_the_following_error() {
    let motion = MotionLimits {
        feed_mm_per_min: 6000.0,
        corner_mm_per_min: 12_000.0,
        ..MotionLimits::default()
    };
    let settings = Settings { motion, ..plain() };
    let to = [10.0137, 2.0071, 9.0219, 1.0033, 8.0151, 0.0];
    let path = drawing([0.0; 3], to.map(|x| line(x, 0.0)).to_vec());
    let (_, report) = run(&path, &settings);
    let error = report.axes[0].following_error;
    // Ten steps a unit time, there and back: half of them missed where it turns in the middle.
    assert!(error.steps > 3.0 && error.steps < 6.0, "{error:?}");
    // An arc turns without a joint.
    let path = drawing([0.0; 3], vec![arc(0.0, 0.0, [3.0, 0.0], false)]);
    run(&path, &settings);
}
