//! Operations in passing: the body goes on.

use super::*;

/// An operation in passing, by all systems: its delay grows by half when the load changes.
#[test]
#[ignore = "takes long"]
fn an_operation_in_passing_has_its_effect_at_the_target() {
    let run = [
        "run",
        "waves/turntable.toml",
        "--no-vcd",
        "--set",
        "action=operate",
    ];
    let sets = [
        "load_delay_factor=1.5",
        "positionings=32",
        "load_change_after=16",
    ];
    let sets: Vec<_> = sets.iter().flat_map(|set| ["--set", set]).collect();
    let run = [&run[..], &sets].concat();
    let fewer = ["--set", "positionings=8", "--set", "load_change_after=4"];
    let bench = Bench::new();
    let summary = bench.json(&run);
    assert_eq!(summary["action"], "operate");
    assert_eq!(summary["warnings"], json!([]));
    assert_eq!(summary["complaints"], json!([]));
    let [none, tuned, learning] =
        ["no lead", "tuned", "learning"].map(|name| system(&summary, name));
    for (phase, delay_ms) in list(&summary, "phases").iter().zip([20.0, 30.0]) {
        for step in list(phase, "steps") {
            let error = |system: usize| step["last_error_counts"][system].as_f64().unwrap();
            let way = number(step, "/speed_counts_per_s") * delay_ms / 1e3;
            assert!((error(none) - way).abs() <= 12.0, "{step}");
            let late = number(step, "/speed_counts_per_s") * (delay_ms - 20.0) / 1e3;
            assert!((error(tuned) - late).abs() <= 20.0, "{step}");
            assert!(error(learning).abs() <= number(step, "/code_travel_counts") + 1e-6);
            assert!(
                step["settled_after"]
                    .as_u64()
                    .is_some_and(|after| after <= 3),
                "{step}"
            );
        }
    }
    let text = bench.succeed(&[&run[..], &fewer].concat());
    for part in [
        "complete by effect, learning to first order, sign converging\n",
        "effect error, counts   largest       rms  missed  timed out\n",
        "positionings 0 to 3: effect error of the last of each step; lead of learning\n",
    ] {
        assert!(text.contains(part), "{text}");
    }
    assert!(
        bench
            .read("waves/turntable.svg")
            .contains("effect error of learning")
    );
    let late = bench.json(&[&run[..], &fewer, &["--set", "time_out_ms=10"]].concat());
    let warning = late["warnings"][0].as_str().unwrap();
    assert!(
        warning.starts_with("8 of 8 operations had no effect"),
        "{warning}"
    );
}

/// On a log too, with a column for where it took effect.
#[test]
fn an_operation_on_a_log_is_learned_from() {
    let bench = log();
    let run = [
        "run",
        "--beside",
        "s.toml",
        "--no-vcd",
        "--set",
        "action=operate",
    ];
    let summary = bench.json(&run);
    for (signal, lead_ms) in list(&summary, "signals").iter().zip([10.0, 40.0]) {
        let late = 10.0 * (20.0 - lead_ms);
        let error = number(signal, "/effect_error_counts");
        assert!((error - late).abs() <= 2.0, "{signal}");
    }
    let text = bench.succeed(&run);
    assert!(text.contains("     error  at effect\n"), "{text}");
}
