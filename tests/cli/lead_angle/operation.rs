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
    assert_eq!(summary["settings"]["action"], "operate");
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

/// Targets nearer than the body goes in an operation and a rest, however the steps come in.
#[test]
fn operations_that_are_too_near_are_refused_with_the_least_distance() {
    let head = "circuit = \"lead_angle\"\naction = \"operate\"\nlearn = false\nclock_hz = 200_000\n\
                ck_ticks = 20\nrest_ms = 10\n";
    let steps = |second: &str| {
        format!(
            "{head}[[step]]\ntarget = 30_000\nspeed_counts_per_s = 50_000\nlead_ms = 20\n\
             [[step]]\ntarget = {second}\nspeed_counts_per_s = 50_000\nlead_ms = 20\n"
        )
    };
    let bench = Bench::with("s.toml", steps("30_500"));
    bench.refuse_with(&["run", "s.toml", "--no-vcd"], |said| {
        let start = "error: s.toml:12: step 1: target: is 30500: 500 counts from the target of step 0, \
                     which the body passes at 50000 counts/s; allowed: at least ";
        assert!(said.starts_with(start), "{said}");
    });
    // 20 ms of delay and 10 of rest, 5 CKs and some ticks.
    let least = 1556;
    bench.write("s.toml", steps(&(30_000 + least).to_string()));
    let summary = bench.json(&["run", "s.toml", "--no-vcd"]);
    assert_eq!(summary["warnings"], json!([]));
    bench.write("s.toml", steps(&(30_000 + least - 1).to_string()));
    let text = format!(
        "at least {least} counts with action = \"operate\", as target = {}, or a lower speed, \
         operation_delay_s or rest_ms",
        30_000 + least
    );
    bench.refuse_with(&["run", "s.toml", "--no-vcd"], |said| {
        assert!(said.contains(&text), "{said}");
    });
    // Turn after turn, given on the command line.
    let run = |target: i64| {
        let set = format!("step=[{{target={target},speed_counts_per_s=50000,lead_ms=20}}]");
        let sets = ["targets=relative", &set, "counts_per_rev=10000"];
        let sets = sets
            .map(|set| ["--set".to_owned(), set.to_owned()])
            .concat();
        let mut run = vec!["run".to_owned(), "s.toml".to_owned(), "--no-vcd".to_owned()];
        run.extend(sets);
        run
    };
    let refused = run(-1500);
    let refused: Vec<&str> = refused.iter().map(String::as_str).collect();
    bench.refuse_with(&refused, |said| {
        let start =
            "error: --set: step 0: target: is -1500: 1500 counts from the target of step 0, ";
        assert!(said.starts_with(start), "{said}");
    });
    let fast = run(-5000);
    let fast: Vec<&str> = fast.iter().map(String::as_str).collect();
    assert_eq!(bench.json(&fast)["warnings"], json!([]));
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
