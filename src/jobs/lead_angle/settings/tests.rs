//! Settings that are accepted or refused, and the messages.

use super::*;

#[test]
fn the_default_is_valid() {
    let settings = Settings::default();
    assert_eq!(settings.validate(), Ok(()));
    assert_eq!(settings.ck_ms(), 0.1);
    assert_eq!(settings.cks(settings.rest_ms), 200);
    assert_eq!(settings.fastest_counts_per_s(), 655_350);
}

#[test]
fn lead_times_are_codes() {
    let mut settings = Settings::default();
    for (ms, code) in [
        (0.0, Some(0)),
        (0.1, Some(1)),
        (0.3, Some(3)),
        (19.9, Some(199)),
        (20.2, Some(202)),
        (39.9, None),
        (40.5, Some(405)),
        (99.6, None),
        (199.0, Some(1990)),
        (199.1, None),
        (200.0, None),
        (12.34, None),
        (-0.1, None),
        (f64::NAN, None),
        (1e30, None),
    ] {
        assert_eq!(settings.code(ms), code, "{ms}");
    }
    // Another CK, the same codes.
    settings.ck_ticks = 200;
    assert_eq!(settings.code(0.3), None);
    assert_eq!(settings.code(40.4), Some(202));
}

#[test]
fn what_is_out_of_range_is_named_with_what_is_allowed() {
    type Break = fn(&mut Settings);
    let cases: [(Break, &str); 36] = [
        (
            |s| s.clock_hz = 0,
            "clock_hz: is 0; allowed: 1 to 10000000000",
        ),
        (|s| s.ck_ticks = 3, "ck_ticks: is 3; allowed: 4 to 16777215"),
        (
            |s| s.steps.truncate(1),
            "step: 1 table is given; allowed: 2 to 16 tables [[step]], or targets = \"relative\", or positionings = 1",
        ),
        (
            |s| s.steps = s.steps.repeat(9),
            "step: 18 tables are given; allowed: 1 to 16 tables [[step]]",
        ),
        (
            |s| s.steps.clear(),
            "step: 0 tables are given; allowed: 1 to 16 tables [[step]]",
        ),
        (
            |s| s.targets = Targets::Relative,
            "step 1: target: is 0; allowed: a way other than 0",
        ),
        (
            |s| (s.steps[1].target, s.switch_counts) = (-5, Some(15_000)),
            "switch_counts: is 15000; allowed: 0 to 14999",
        ),
        (
            |s| s.steps[1].target = 2_097_153,
            "step 1: target: is 2097153; allowed: -2097152 to 2097152",
        ),
        (
            |s| s.steps[1].target = 15_000,
            "step 0: target: is 15000; allowed: another target than that of step 1",
        ),
        (
            |s| s.steps[0].target = 0,
            "step 0: target: is 0; allowed: another target than that of the start",
        ),
        (
            |s| s.steps.insert(1, s.steps[0]),
            "step 1: target: is 15000; allowed: another target than that of step 0",
        ),
        (
            |s| s.steps[0].speed_counts_per_s = 0,
            "step 0: speed_counts_per_s: is 0; allowed: 10 to 655350, a multiple of 10",
        ),
        (
            |s| s.steps[1].speed_counts_per_s = 20_005,
            "step 1: speed_counts_per_s: is 20005; allowed: 10 to 655350, a multiple of 10",
        ),
        (
            |s| s.clock_hz = 39_990,
            "step 0: speed_counts_per_s: is 40000; allowed: 10 to 39990, a multiple of 10",
        ),
        (
            |s| s.steps[1].lead_ms = 39.9,
            "step 1: lead_ms: is 39.9; allowed: 39.8 or 40",
        ),
        (
            |s| s.steps[0].lead_ms = 12.34,
            "step 0: lead_ms: is 12.34; allowed: 12.3 or 12.4",
        ),
        (
            |s| s.steps[0].lead_ms = 200.0,
            "step 0: lead_ms: is 200; allowed: at most 199",
        ),
        (
            |s| s.steps[0].lead_ms = -1.0,
            "step 0: lead_ms: is -1; allowed: 0 for none, 0.1 to 199",
        ),
        (
            |s| s.steps[0].lead_ms = f64::NAN,
            "step 0: lead_ms: is NaN; allowed: 0 for none, 0.1 to 199",
        ),
        (
            |s| (s.common_time, s.steps[1].lead_ms) = (true, 2.0),
            "step 1: lead_ms: is 2; allowed: 0: with common_time all steps take that of step 0",
        ),
        (
            |s| s.seed_ms = 99.7,
            "seed_ms: is 99.7; allowed: 99.5 or 100",
        ),
        (
            |s| s.standstill_ms = 0.0,
            "standstill_ms: is 0; allowed: 0.1 to 6553.5",
        ),
        (
            |s| s.time_out_ms = 6554.0,
            "time_out_ms: is 6554; allowed: 0.1 to 6553.5",
        ),
        (
            |s| s.rest_ms = f64::NAN,
            "rest_ms: is NaN; allowed: 0.1 to 6553.5",
        ),
        (
            |s| s.speed_gate_ms = 0.0,
            "speed_gate_ms: is 0; allowed: 0.1 to 6553.5",
        ),
        (
            |s| s.speed_lead_ms = -1.0,
            "speed_lead_ms: is -1; allowed: 0 to 199",
        ),
        (
            |s| (s.action, s.completion) = (Action::Operate, Completion::FixedTime),
            "completion: is fixed_time; allowed: standstill with action = \"operate\": its effect is \
             what it waits for",
        ),
        (
            |s| s.operation_delay_s = -0.1,
            "operation_delay_s: is -0.1; allowed: 0 to 10",
        ),
        (
            |s| s.load_delay_factor = 0.0,
            "load_delay_factor: is 0; allowed: 0.001 to 1000",
        ),
        (
            |s| s.positionings = 0,
            "positionings: is 0; allowed: 1 to 10000",
        ),
        (
            |s| s.positionings = 10_001,
            "positionings: is 10001; allowed: 1 to 10000",
        ),
        (
            |s| s.load_change_after = Some(0),
            "load_change_after: is 0; allowed: 1 to 24",
        ),
        (
            |s| s.load_change_after = Some(25),
            "load_change_after: is 25; allowed: 1 to 24",
        ),
        (
            |s| s.load.load_inertia_factor = 0.0,
            "load_inertia_factor: is 0; allowed: 0.001 to 1000",
        ),
        (
            |s| s.body.brake_dead_time_s = -1.0,
            "brake_dead_time_s: is -1; allowed: 0 to 10",
        ),
        (
            |s| s.body.brake_fade = 0.6,
            "brake_fade: is 0.6; allowed: 0 to 0.5",
        ),
    ];
    for (spoil, message) in cases {
        let mut settings = Settings::default();
        spoil(&mut settings);
        let error = settings.validate().expect_err(message);
        assert_eq!(error.to_string(), message);
    }
}

/// One step is a job where it has somewhere to go.
#[test]
fn a_single_step_is_a_job_where_it_has_a_way() {
    let mut settings = Settings::default();
    settings.steps.truncate(1);
    settings.targets = Targets::Relative;
    assert_eq!(settings.validate(), Ok(()));
    settings.targets = Targets::Absolute;
    settings.positionings = 1;
    assert_eq!(settings.validate(), Ok(()));
}

#[test]
fn targets_count_from_the_start_or_from_the_one_before() {
    let mut settings = Settings::default();
    for (step, target) in [(0, 300), (1, -50)] {
        settings.steps[step].target = target;
    }
    let all = |settings: &Settings, what: fn(&Settings, usize) -> i64| -> [i64; 5] {
        std::array::from_fn(|number| what(settings, number))
    };
    assert_eq!(all(&settings, Settings::target), [300, -50, 300, -50, 300]);
    assert_eq!(all(&settings, Settings::way), [300, -350, 350, -350, 350]);
    settings.switches_counts = vec![20, 7];
    assert_eq!(all(&settings, Settings::switch), [280, -43, 280, -43, 280]);
    let farthest = |settings: &Settings| [0, 1].map(|step| settings.farthest_switch(step));
    assert_eq!(farthest(&settings), [299, 349]);
    settings.targets = Targets::Relative;
    assert_eq!(all(&settings, Settings::target), [300, 250, 550, 500, 800]);
    assert_eq!(all(&settings, Settings::way), [300, -50, 300, -50, 300]);
    assert_eq!(all(&settings, Settings::switch), [280, 257, 530, 507, 780]);
    assert_eq!(farthest(&settings), [299, 49]);
}
