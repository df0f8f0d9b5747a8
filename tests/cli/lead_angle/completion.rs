//! When positionings are over: by standstill, by a fixed time, or by the control computer.

use super::*;

/// The greatest speed at which a system's body still turned when a positioning was complete, and of how
/// many it did.
fn turning(summary: &Value, name: &str) -> (f64, usize) {
    let number = system(summary, name);
    let mut largest = 0.0_f64;
    let mut turning = 0;
    for row in list(summary, "positionings") {
        let speed = row["end_speed_counts_per_s"][number]
            .as_f64()
            .unwrap()
            .abs();
        let timed_out = row["timed_out"][number].as_bool().unwrap();
        assert_eq!(timed_out, speed > 0.0, "{row}");
        turning += usize::from(timed_out);
        largest = largest.max(speed);
    }
    (largest, turning)
}

#[test]
#[ignore = "takes long"]
fn a_positioning_that_ends_by_its_time_is_no_stop_and_is_said_to_be_none() {
    let run = ["run", "waves/turntable.toml", "--no-vcd"];
    let sets = ["time_out_ms=40", "positionings=16", "load_change_after=16"];
    let sets = sets.iter().flat_map(|set| ["--set", set]);
    let arguments: Vec<&str> = run.into_iter().chain(sets).collect();
    let summary = Bench::new().json(&arguments);
    let own = &summary["systems"][system(&summary, "learning")];
    assert_eq!(whole(own, "/timed_out"), 12);
    let (speed, turns) = turning(&summary, "learning");
    assert_eq!(turns, 12);
    assert!(speed > 40_000.0, "{speed}");
    // Nothing of such a step is settled, however small the errors look.
    for step in list(&list(&summary, "phases")[0], "steps") {
        let settled = step["settled_after"] != Value::Null;
        assert_eq!(settled, step["step"] == 0, "{step}");
    }
    let warning = summary["warnings"][0].as_str().unwrap();
    assert!(
        warning.starts_with("12 of 16 positionings ended by their time-out"),
        "{warning}"
    );

    let bench = Bench::new();
    let text = bench.succeed(&arguments);
    assert!(
        text.contains("learning                   760     232.3       0         12  in the waves")
    );
    assert!(text.contains("  -7*  "), "{text}");
    assert!(text.contains("* its time was over"), "{text}");
    assert!(
        bench
            .read("waves/turntable.svg")
            .contains("its time was over")
    );
}

#[test]
#[ignore = "takes long"]
fn a_fixed_time_completes_every_positioning_and_learning_at_standstill_stands_beside_it() {
    let run = |time_out: &str| {
        let run = [
            "run",
            "waves/turntable.toml",
            "--no-vcd",
            "--set",
            "completion=fixed_time",
        ];
        let sets = [time_out, "positionings=24", "load_change_after=24"];
        let sets: Vec<_> = sets.iter().flat_map(|set| ["--set", set]).collect();
        Bench::new().json(&[&run[..], &sets].concat())
    };
    // Long enough: the same is learned as at standstill.
    let summary = run("time_out_ms=200");
    assert_eq!(turning(&summary, "learning").1, 0);
    assert_eq!(summary["warnings"], json!([]));
    let [fixed, stopped] = ["learning", "at standstill"].map(|name| system(&summary, name));
    for row in list(&summary, "positionings") {
        assert_eq!(row["error_counts"][fixed], row["error_counts"][stopped]);
    }
    // Too short: it learns to be at the target in passing.
    let summary = run("time_out_ms=40");
    assert_eq!(turning(&summary, "learning").1, 18);
    assert_eq!(turning(&summary, "at standstill").1, 0);
    let phase = &list(&summary, "phases")[0];
    let fastest = &list(phase, "steps")[2];
    assert_eq!(fastest["lead_ms"], 33.4);
    assert!(
        fastest["last_error_counts"][fixed].as_i64().unwrap().abs() < 20,
        "{fastest}"
    );
}

#[test]
#[ignore = "takes long"]
fn what_is_missed_is_stopped_by_hand_and_said() {
    // Only a prediction that is the target is a signal: at 9 counts a CK most targets are missed.
    let sets = ["--set", "comparing=equal", "--set", "positionings=8"];
    let run = [
        "run",
        "waves/turntable.toml",
        "--no-vcd",
        "--set",
        "load_change_after=8",
    ];
    let summary = Bench::new().json(&[&run[..], &sets].concat());
    let own = &summary["systems"][system(&summary, "learning")];
    let missed = whole(own, "/missed");
    assert!(missed > 0, "{own}");
    let warning = format!(
        "{missed} of 8 positionings missed their target, and the control computer stopped the body"
    );
    assert_eq!(summary["warnings"][0], warning);
    assert_eq!(summary["complaints"], json!([]));
}
