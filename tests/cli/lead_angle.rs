//! `run` of the lead-angle compensator: summary, files, logs, settings, refusals.

use super::support::{Bench, DRAWINGS, keys, list, number, whole};
use expect_test::expect;
use serde_json::{Value, json};

const STEPS: &str = "[[step]]\ntarget = 9000\nspeed_counts_per_s = 20000\n\
                     [[step]]\ntarget = 0\nspeed_counts_per_s = 40000\nlead_ms = 39.9\n";

/// A short job: six positionings to and fro, whose load changes after four.
const SMALL: &str = "\
circuit = \"lead_angle\"
clock_hz = 200_000
ck_ticks = 20
positionings = 6
load_change_after = 4
load_inertia_factor = 2
[[step]]
target = 3000
speed_counts_per_s = 20000
lead_ms = 15
[[step]]
target = 0
speed_counts_per_s = 40000
lead_ms = 15
";

/// Two steps that a log of 10 counts a millisecond comes by.
const LOG: &str = "\
circuit = \"lead_angle\"
input = \"log.csv\"
log_column = \"right\"
[[step]]
target = 1000
speed_counts_per_s = 10
lead_ms = 10
[[step]]
target = 3000
speed_counts_per_s = 10
lead_ms = 40
";

/// A bench with the short job in it.
fn small() -> Bench {
    Bench::with("s.toml", SMALL)
}

/// A bench with a scenario of a log, and the log: half a second at 10 counts a millisecond.
fn log() -> Bench {
    let bench = Bench::with("s.toml", LOG);
    let rows = (0..=500).map(|ms| format!("{},0,{}\n", 7000 + ms, 10 * ms));
    bench.write(
        "log.csv",
        "time, left, right\n".to_owned() + &rows.collect::<String>(),
    );
    bench
}

/// Where a system is in the lists of errors.
fn system(summary: &Value, name: &str) -> usize {
    let place = list(summary, "systems")
        .iter()
        .position(|system| system["name"] == name);
    place.unwrap_or_else(|| panic!("no {name}"))
}

#[test]
fn the_turntable_shows_what_the_circuit_is_for() {
    let run = ["run", "waves/turntable.toml", "--no-vcd"];
    let summary = Bench::new().json(&run);
    assert_eq!(summary["complaints"], json!([]));
    assert_eq!(summary["warnings"], json!([]));
    assert_eq!(list(&summary, "positionings").len(), 48);
    let learning = system(&summary, "learning");
    let phases = list(&summary, "phases");
    assert_eq!(phases.len(), 2);
    let mut orders = Vec::new();
    for (phase, loaded) in phases.iter().zip([false, true]) {
        assert_eq!(phase["loaded"], loaded);
        assert_eq!(list(phase, "steps").len(), 4);
        for step in list(phase, "steps") {
            let rows = list(&summary, "positionings").iter();
            let rows = rows.filter(|row| row["loaded"] == loaded && row["step"] == step["step"]);
            let within = |row: &Value| {
                let error = row["error_counts"][learning].as_f64().unwrap();
                error.abs() <= number(row, "/code_travel_counts") + 1e-6
            };
            let within: Vec<bool> = rows.map(within).collect();
            assert_eq!(within.len(), 6);
            let after = (0..6).find(|&from| within[from..].iter().all(|&one| one));
            assert_eq!(step["settled_after"], json!(after), "{within:?}");
            assert!(after.is_some_and(|after| after > 0), "{step}");
            let by_order = &step["settled_by_order"];
            assert_eq!(by_order["first"], step["settled_after"]);
            orders.push(json!([by_order["first"], by_order["second"]]));
        }
    }
    // To first and to second order, step by step, with either load.
    assert_eq!(
        json!(orders),
        json!([
            [3, 2],
            [1, 1],
            [3, 2],
            [3, 2],
            [2, 1],
            [2, 2],
            [3, 2],
            [3, 2]
        ])
    );
    // The last of each step, by a limit that does not come from the summary: a code at 90000
    // counts/s is 5 CKs of 0.1 ms, 45 counts.
    for row in &list(&summary, "positionings")[44..] {
        let error = |system: usize| row["error_counts"][system].as_i64().unwrap().abs();
        assert!(error(learning) <= 45, "{row}");
    }
    let rms = |name: &str| {
        number(
            &summary["systems"][system(&summary, name)],
            "/error_rms_counts",
        )
    };
    for other in ["no lead", "by speed", "fixed lead", "literal sign"] {
        assert!(rms(other) > 2.5 * rms("learning"), "{other}");
    }
    for name in ["no lead", "literal sign"] {
        let largest = &summary["systems"][system(&summary, name)]["error_max_counts"];
        assert!(largest.as_u64().unwrap() > 5000, "{name}");
    }
    assert_eq!(summary["systems"][learning]["own"], true);
    assert_eq!(summary["lead_times_of"], "learning");
}

#[test]
fn the_literal_sign_drives_the_lead_times_to_their_ends() {
    let run = [
        "run",
        "waves/turntable.toml",
        "--no-vcd",
        "--set",
        "sign=literal",
    ];
    let summary = Bench::new().json(&run);
    assert_eq!(summary["lead_times_of"], "literal sign");
    assert_eq!(
        summary["systems"][system(&summary, "literal sign")]["own"],
        true
    );
    let last = &list(&summary, "positionings")[44..];
    let leads: Vec<f64> = last.iter().map(|row| number(row, "/lead_ms")).collect();
    // The shortest code, and the longest where the first lead was too long.
    assert_eq!(leads, [199.0, 0.1, 0.1, 0.1]);
    for phase in list(&summary, "phases") {
        for step in list(phase, "steps") {
            assert_eq!(step["settled_after"], Value::Null);
        }
    }
}

#[test]
fn the_second_order_is_a_system_beside_the_first_and_can_be_the_own_one() {
    let bench = small();
    let first = bench.json(&["run", "s.toml", "--no-vcd"]);
    let second = bench.json(&[
        "run",
        "s.toml",
        "--no-vcd",
        "--set",
        "function=second_order",
    ]);
    for (summary, function, own) in [
        (&first, "first_order", "learning"),
        (&second, "second_order", "second order"),
    ] {
        assert_eq!(summary["function"], function);
        assert_eq!(summary["lead_times_of"], own);
        let systems = list(summary, "systems");
        let of = |name: &str| &systems[system(summary, name)]["own"];
        assert_eq!((of(own) == true, systems.len()), (true, 7));
        let owns = systems.iter().filter(|system| system["own"] == true);
        assert_eq!(owns.count(), 1);
    }
    // What the systems come to does not depend on which of them is in the waves; the last, with the
    // literal sign, is of the scenario's order.
    let errors = |summary: &Value| {
        let rows = list(summary, "positionings").iter();
        let errors = rows.map(|row| list(row, "error_counts")[..6].to_vec());
        errors.collect::<Vec<_>>()
    };
    assert_eq!(errors(&first), errors(&second));
    let leads = |summary: &Value| {
        let rows = list(summary, "positionings").iter();
        rows.map(|row| number(row, "/lead_ms")).collect::<Vec<_>>()
    };
    // The third positioning is the first that can have learned.
    assert_eq!(leads(&first)[..2], leads(&second)[..2]);
    assert!(leads(&first)[2] < leads(&second)[2]);
}

#[test]
fn the_summary_has_these_keys() {
    let summary = small().json(&["run", "s.toml", "--no-vcd"]);
    let expected = [
        "circuit",
        "ck_ticks",
        "clock_hz",
        "comparing",
        "complaints",
        "completion",
        "files",
        "function",
        "history",
        "input",
        "lead_times_of",
        "learn",
        "phases",
        "placement",
        "positionings",
        "seconds",
        "sign",
        "systems",
        "ticks",
        "vcd_window",
        "warnings",
    ];
    assert_eq!(keys(&summary), expected);
    assert_eq!(summary["input"], "s");
    assert_eq!(summary["vcd_window"], Value::Null);
    assert_eq!(summary["files"], json!(["waves/s.svg"]));
    let row = [
        "code_travel_counts",
        "end_speed_counts_per_s",
        "error_counts",
        "lead_ms",
        "loaded",
        "positioning",
        "step",
        "timed_out",
    ];
    let rows = list(&summary, "positionings");
    assert_eq!(keys(&rows[0]), row);
    let of = |key: &str| rows.iter().map(|row| row[key].clone()).collect::<Vec<_>>();
    assert_eq!(json!(of("step")), json!([0, 1, 0, 1, 0, 1]));
    let loaded = json!([false, false, false, false, true, true]);
    assert_eq!(json!(of("loaded")), loaded);
    // The first two lead times are the scenario's; at 20000 counts/s one of 150 CKs has a code
    // of 1 CK up to 199: 2 counts.
    assert_eq!(number(&rows[0], "/lead_ms"), 15.0);
    assert!((number(&rows[0], "/code_travel_counts") - 2.0).abs() < 0.01);
}

#[test]
fn people_see_the_last_of_each_step_or_every_positioning() {
    let text = small().succeed(&["run", "s.toml", "--no-vcd", "--segments"]);
    expect![[r#"
        s on lead_angle: 6 positionings, 225442 ticks, 1.127 s at 200000 Hz, CK of 20 ticks
        history shift_register, lead on position, comparing crossing, complete by standstill, learning to first order, sign converging

        stop error in counts   largest       rms  missed  timed out
        no lead                   1555     910.3       0          0
        displaced switch           549     231.1       0          0
        by speed                   555     239.5       0          0
        tuned                      549     231.1       0          0
        fixed lead                 955     464.6       0          0
        learning                   569     299.4       0          0  in the waves
        second order               545     285.7       0          0
        literal sign              1429     678.8       0          0

        positionings 0 to 3: stop error of the last of each step; lead of learning
        step    target   speed   no lead  by speed     tuned  fixed lead  learning  second order  literal sign      lead  one code  settled after  1st, 2nd order
           0      3000   20000       366      -134         0          66        12             2           120   17.7 ms       2.0          never        never, 1
           1         0   40000      1010        10         0         410       160            66           652   21.2 ms       8.0          never    never, never

        positionings 4 to 5, with the other load: stop error of the last of each step; lead of learning
        step    target   speed   no lead  by speed     tuned  fixed lead  learning  second order  literal sign      lead  one code  settled after  1st, 2nd order
           0      3000   20000       504         4       138         204       138           138           338   18.3 ms       2.0          never    never, never
           1         0   40000      1555       555       549         955       569           545          1429   24.6 ms       8.0          never    never, never

        positioning  step   no lead  by speed     tuned  fixed lead  learning  second order  literal sign      lead  one code
                  0     0       366      -134         0          66        66            66            66   15.0 ms       2.0
                  1     1      1006         6         0         406       406           406           406   15.0 ms       4.0
                  2     0       366      -134         0          66        12             2           120   17.7 ms       2.0
                  3     1      1010        10         0         410       160            66           652   21.2 ms       8.0
                  4     0       504         4       138         204       138           138           338   18.3 ms       2.0
                  5     1      1555       555       549         955       569           545          1429   24.6 ms       8.0

        wrote waves/s.svg
    "#]].assert_eq(&text);
    let short = small().succeed(&["run", "s.toml", "--no-vcd"]);
    let (start, end) = text.split_at(text.find("positioning  step").unwrap());
    let files = &end[end.find("wrote").unwrap()..];
    assert_eq!(short, start.to_owned() + files);
}

/// The simplest conventional system: as good as its distances are, up to the load change.
#[test]
fn displaced_switches_stand_as_far_off_as_the_first_stops_went() {
    let run = ["run", "waves/turntable.toml", "--no-vcd"];
    let summary = Bench::new().json(&run);
    let [none, switch] = ["no lead", "displaced switch"].map(|name| system(&summary, name));
    let phases = list(&summary, "phases");
    let error = |step: &Value, system: usize| step["last_error_counts"][system].as_i64().unwrap();
    for (before, after) in list(&phases[0], "steps")
        .iter()
        .zip(list(&phases[1], "steps"))
    {
        assert!(error(before, switch).abs() <= 30, "{before}");
        let more = error(after, none) - error(before, none);
        let off = error(after, switch) - error(before, switch);
        assert!(more > 80 && (more - off).abs() <= 10, "{after}: {more}");
    }
    // One distance for all is right for one speed.
    let summary = Bench::new().json(&[&run[..], &["--set", "switch_counts=1200"]].concat());
    for row in list(&summary, "positionings") {
        let [none, switch] = [none, switch].map(|system| row["error_counts"][system].as_i64());
        let moved = none.unwrap() - switch.unwrap();
        assert!((moved - 1200).abs() <= 20, "{row}");
    }
}

/// Fig. 7 in the waves, with what it measures on top.
#[test]
fn the_conventional_system_can_be_in_the_waves() {
    let bench = small();
    let run = ["run", "s.toml", "--to", "3000", "--set", "lead=speed"];
    let summary = bench.json(&run);
    assert_eq!(summary["lead"], "speed");
    let own = &summary["systems"][system(&summary, "by speed")];
    assert_eq!(own["own"], true);
    assert_eq!(system(&summary, "by speed"), 2);
    let other = small().json(&["run", "s.toml", "--no-vcd"]);
    assert_eq!(summary["positionings"], other["positionings"]);
    let save = bench.read("waves/s.gtkw");
    let overview = save.split("-overview\n").nth(1).unwrap();
    let overview = overview.split("-ports in\n").next().unwrap();
    assert!(
        overview.contains("conventional_compensator.lead_source.speed["),
        "{overview}"
    );
    assert_eq!(overview.matches("conventional_compensator.").count(), 11);
    let text = bench.succeed(&run);
    assert!(
        text.contains("complete by standstill, lead by speed\n"),
        "{text}"
    );
}

#[test]
fn a_ram_gives_the_same() {
    let summary = |history: &str| {
        let set = format!("history={history}");
        let mut summary = small().json(&["run", "s.toml", "--no-vcd", "--set", &set]);
        assert_eq!(summary["history"], history);
        summary["history"] = Value::Null;
        summary
    };
    assert_eq!(summary("ram"), summary("shift_register"));
}

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

    let text = Bench::new().succeed(&arguments);
    assert!(
        text.contains("learning                   760     232.3       0         12  in the waves")
    );
    assert!(text.contains("  -7*  "), "{text}");
    assert!(text.contains("* its time was over"), "{text}");
    let bench = Bench::new();
    bench.succeed(&arguments);
    assert!(
        bench
            .read("waves/turntable.svg")
            .contains("its time was over")
    );
}

#[test]
fn a_fixed_time_completes_every_positioning_and_learning_at_standstill_stands_beside_it() {
    let run = |time_out: &str| {
        let run = [
            "run",
            "waves/turntable.toml",
            "--no-vcd",
            "--set",
            "completion=fixed_time",
        ];
        let sets = ["--set", time_out, "--set", "load_change_after=48"];
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
    assert_eq!(turning(&summary, "learning").1, 36);
    assert_eq!(turning(&summary, "at standstill").1, 0);
    let phase = &list(&summary, "phases")[0];
    let fastest = &list(phase, "steps")[2];
    assert_eq!(fastest["lead_ms"], 33.6);
    assert!(
        fastest["last_error_counts"][fixed].as_i64().unwrap().abs() < 20,
        "{fastest}"
    );
}

#[test]
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
    let warning =
        format!("{missed} of 8 positionings missed their target and were stopped by hand");
    assert_eq!(summary["warnings"][0], warning);
    assert_eq!(summary["complaints"], json!([]));
}

#[test]
fn the_files_are_those_that_are_said_and_the_same_twice() {
    let once = || {
        let bench = small();
        let text = bench.succeed(&["run", "s.toml", "--to", "3000", "--out", "a"]);
        assert_eq!(
            bench.names(),
            ["a/", "a/s.gtkw", "a/s.svg", "a/s.vcd", "s.toml"]
        );
        assert!(
            text.ends_with("wrote a/s.vcd\nwrote a/s.gtkw\nwrote a/s.svg\n"),
            "{text}"
        );
        ["a/s.svg", "a/s.vcd", "a/s.gtkw"].map(|name| bench.read(name))
    };
    let [svg, vcd, save] = once();
    assert!([svg.clone(), vcd, save.clone()] == once());
    for text in [
        "s: lead-angle compensator",
        "stop error of learning, held at ±6",
        "lead time, learning",
        "lead time, literal sign",
        "load change",
    ] {
        assert!(svg.contains(text), "{text}");
    }
    // Position and prediction are curves; the history is a group with its stages in one.
    let after = |text: &str| &save[save.find(text).unwrap_or_else(|| panic!("no {text}"))..];
    assert!(after("@8420\ncompensator.position[").contains("@20000"));
    assert!(save.contains("@8420\ncompensator.predicted["));
    let history = after("-history\n");
    let end = history[1..].find("-history\n").unwrap();
    assert!(history[..end].contains("-stages\n"));
    let stages = history[..end].matches(".stages.").count();
    assert_eq!(stages, 199);
}

#[test]
fn waves_have_the_window_and_the_scopes_that_are_asked_for() {
    let bench = small();
    let only = "compensator.lead_source.history";
    let run = ["run", "s.toml", "--from", "500", "--to", "3000", "--only"];
    let summary = bench.json(&[&run[..], &[only]].concat());
    assert_eq!(summary["vcd_window"], json!([500, 3000]));
    let save = bench.read("waves/s.gtkw");
    assert!(save.contains(&format!("{only}.")) && !save.contains("compensator.comparator."));
    let done = bench.run(&[&run[..], &["compensator.pen"]].concat());
    let start = "error: --only: there is no compensator.pen; allowed: a signal, or a scope: ";
    assert!(done.stderr.starts_with(start), "{}", done.stderr);
    let ticks = whole(&summary, "/ticks");
    let most = format!("{ticks}");
    bench.refuse(
        &["run", "s.toml", "--from", &most, "--out", "new/deep"],
        &format!(
            "--from: is {ticks}; allowed: 0 to {}, the last tick of the run",
            ticks - 1
        ),
    );
}

#[test]
fn files_that_cannot_be_written_leave_nothing() {
    const WRITABLE: &str = "allowed: a directory that can be written";
    for bench in [small(), log()] {
        let out = |out| ["run", "s.toml", "--to", "3000", "--out", out];
        let text = format!("--out: s.toml: File exists (os error 17); {WRITABLE}");
        bench.refuse(&out("s.toml"), &text);
        bench.write("o/s.svg/inside", "");
        let text = format!("--out: o/s.svg: is a directory; {WRITABLE}");
        bench.refuse(&out("o"), &text);
    }
}

#[test]
fn a_log_is_predicted_and_signals_come_a_lead_before_their_targets() {
    let summary = log().json(&["run", "s.toml", "--no-vcd"]);
    assert_eq!(summary["input"], "log.csv");
    assert_eq!(whole(&summary, "/samples"), 501);
    assert_eq!(whole(&summary, "/ticks"), 500_001);
    assert_eq!(number(&summary, "/seconds"), 0.500_001);
    assert_eq!(summary["complaints"], json!([]));
    // 5000 CKs, less what is not yet in the history and what lies after the end.
    let predictions = whole(&summary, "/predictions");
    assert!((4000..4900).contains(&predictions), "{predictions}");
    // At a count a CK all samples are cut off alike: nothing is left but the cut.
    assert!(number(&summary, "/error_max_counts") <= 1.0);
    assert!((100.0..410.0).contains(&number(&summary, "/without_lead_rms_counts")));
    let signals = list(&summary, "signals");
    assert_eq!(signals.len(), 2);
    for (signal, (step, target, lead)) in signals.iter().zip([(0, 1000, 10), (1, 3000, 40)]) {
        assert_eq!(whole(signal, "/step"), step);
        assert_eq!(whole(signal, "/target"), target);
        assert_eq!(number(signal, "/lead_ms"), lead as f64);
        assert!((whole(signal, "/position") - (target - 10 * lead)).abs() <= 1);
        assert!(number(signal, "/error_counts").abs() <= 1.0, "{signal}");
        let seconds = (target - 10 * lead) as f64 / 1e4;
        assert!((number(signal, "/seconds") - seconds).abs() < 1e-3);
    }
}

#[test]
fn the_text_of_a_log_has_its_signals() {
    let text = log().succeed(&["run", "s.toml", "--no-vcd"]);
    expect![[r#"
        log.csv on lead_angle: 501 samples, 500001 ticks, 0.500 s at 1000000 Hz, CK of 100 ticks
        times from time, counts from right

        prediction error in counts   largest       rms
        with the lead                    0.0       0.0
        without                        400.0     251.2
        in 4800 CKs

        signal of step    target       time      lead  position  a lead later     error
                     0      1000    0.090 s   10.0 ms       900        1000.0       0.0
                     1      3000    0.260 s   40.0 ms      2600        3000.0       0.0
        times are from the first sample of the log on

        wrote waves/s.svg
    "#]]
    .assert_eq(&text);
    let ram = log().succeed(&["run", "s.toml", "--no-vcd", "--set", "history=ram"]);
    assert_eq!(ram, text);
}

#[test]
fn a_log_runs_without_a_scenario() {
    let bench = log();
    let column = ["--set", "log_column=right"];
    let run = ["run", "log.csv", "--no-vcd"];
    let summary = bench.json(&[&run[..], &column].concat());
    assert_eq!(list(&summary, "signals").len(), 1);
    assert_eq!(list(&summary, "signals")[0]["target"], 1000);
    let steps = "step=[{target=2000,speed_counts_per_s=10,lead_ms=5},\
                 {target=4000,speed_counts_per_s=10}]";
    let summary = bench.json(&[&run[..], &column, &["--set", steps]].concat());
    let targets = list(&summary, "signals")
        .iter()
        .map(|signal| &signal["target"]);
    assert_eq!(targets.collect::<Vec<_>>(), [2000, 4000]);
    // Its first other column stands still.
    let text = bench.succeed(&run);
    let none = "no signal: the log does not reach the target of step 0; a scenario, or --set \
                step=[...], has others\n";
    assert!(text.contains(none), "{text}");
    bench.refuse(
        &["table", "log.csv"],
        &format!(
            "log.csv: file: is for the lead-angle compensator, which has no table; allowed: \
             {DRAWINGS}; or the command run"
        ),
    );
}

/// The first line of the standard error of a run that must be refused.
fn refusal(bench: &Bench, arguments: &[&str]) -> String {
    let before = bench.names();
    let done = bench.run(&[&["run"], arguments].concat());
    assert_eq!((done.code, done.stdout.as_str()), (2, ""));
    assert_eq!(bench.names(), before);
    done.stderr.split_inclusive('\n').take(1).collect()
}

/// The same of a scenario with these keys before its steps.
fn refused(keys: &str) -> String {
    let good = STEPS.replace("39.9", "40");
    let bench = Bench::with("s.toml", format!("circuit = \"lead_angle\"\n{keys}{good}"));
    bench.write("slow.csv", "ms, a, b\n0, 0, 0\n5, 100, 1\n");
    bench.write("fast.csv", "0,0\n0.001,2\n");
    bench.write("word.csv", "time,counts\n0,0\n\n5,many\n");
    bench.write("back.csv", "0,0\n5,1\n4,2\n");
    bench.write("short.csv", "time,counts\n0,0\n5\n");
    bench.write("high.csv", "0,-5000000\n5,-5000001\n");
    bench.write("long.csv", "0,0\n9000,2097152\n18000,2097153\n");
    refusal(&bench, &["s.toml"])
}

#[test]
fn settings_are_checked_and_named_with_their_line() {
    let bench = Bench::with("s.toml", format!("circuit = \"lead_angle\"\n{STEPS}"));
    assert_eq!(
        refusal(&bench, &["s.toml"]),
        "error: s.toml:8: step 1: lead_ms: is 39.9; allowed: 39.8 or 40\n"
    );
    assert_eq!(
        refused("rest_ms = 0\n"),
        "error: s.toml:2: rest_ms: is 0; allowed: 0.1 to 6553.5\n"
    );
    assert_eq!(
        refused("vcd_ticks = 0\n"),
        "error: s.toml:2: vcd_ticks: is 0; allowed: 1 to 9223372036854775807; --no-vcd for none\n"
    );
    assert_eq!(
        refused("brake_torque_nm = -1\n"),
        "error: s.toml:2: brake_torque_nm: is -1; allowed: 0.000000001 to 1000000000\n"
    );
    assert_eq!(
        refused("load_change_after = 25\n"),
        "error: s.toml:2: load_change_after: is 25; allowed: 1 to 24\n"
    );
    assert_eq!(
        refused("sign = \"both\"\n"),
        "error: s.toml:2: sign: unknown variant `both`; allowed: `converging` or `literal`\n"
    );
    assert_eq!(
        refused("lead = \"way\"\n"),
        "error: s.toml:2: lead: unknown variant `way`; allowed: `time` or `speed`\n"
    );
    assert_eq!(
        refused("targets = \"turn\"\n"),
        "error: s.toml:2: targets: unknown variant `turn`; allowed: `absolute` or `relative`\n"
    );
    assert_eq!(
        refused("targets = \"relative\"\n"),
        "error: s.toml:7: step 1: target: is 0; allowed: a way other than 0\n"
    );
    assert_eq!(
        refused("switch_counts = 9000\n"),
        "error: s.toml:2: switch_counts: is 9000; allowed: 0 to 8999\n"
    );
    assert_eq!(
        refused("function = \"quadratic\"\n"),
        "error: s.toml:2: function: unknown variant `quadratic`; allowed: `first_order` or \
         `second_order`\n"
    );
    let bench = small();
    let one = "step=[{target=9000,speed_counts_per_s=20000}]";
    assert_eq!(
        refusal(&bench, &["s.toml", "--set", one]),
        "error: --set: step: is 1 step; allowed: 2 to 16, or targets = \"relative\", or \
         positionings = 1\n"
    );
    let set = ["s.toml", "--set", "common_time=true"];
    assert_eq!(
        refusal(&bench, &set),
        "error: s.toml:14: step 1: lead_ms: is 15; allowed: 0: with common_time all steps take \
         that of step 0\n"
    );
}

#[test]
fn a_log_is_read_and_checked() {
    assert_eq!(
        refused("log_column = \"a\"\n"),
        "error: s.toml:2: log_column: is a; allowed: it with an input, a position log in CSV, \
         only\n"
    );
    let of = |file: &str| refused(&format!("input = \"{file}.csv\"\n"));
    assert_eq!(
        refused("input = \"slow.csv\"\nlog_time_unit_ms = 0\n"),
        "error: s.toml:3: log_time_unit_ms: is 0; allowed: 0.000000001 to 10000000\n"
    );
    assert_eq!(
        refused("input = \"slow.csv\"\nlog_column = \"c\"\n"),
        "error: slow.csv:1: c: no such column; allowed: ms, a, b\n"
    );
    assert_eq!(
        of("fast"),
        "error: fast.csv:2: counts (column 2): 2000000 counts/s since the sample before; allowed: up to \
         1000000, one count per tick\n"
    );
    assert_eq!(
        of("none"),
        "error: none.csv: file: cannot be read: No such file or directory (os error 2); allowed: \
         a readable file\n"
    );
    assert_eq!(
        of("word"),
        "error: word.csv:4: counts: is 'many'; allowed: a whole number, -2147483648 to \
         2147483648\n"
    );
    let back = of("back");
    assert!(
        back.starts_with("error: back.csv:3: time (column 1): "),
        "{back}"
    );
    assert_eq!(
        of("short"),
        "error: short.csv:3: counts: the line has only 1 of its fields; allowed: a number\n"
    );
    assert_eq!(
        of("high"),
        "error: s.toml:4: step 0: target: is 5009000 from the log's first count, -5000000; \
         allowed: -2097152 to 2097152\n"
    );
    assert_eq!(
        of("long"),
        "error: long.csv:3: counts (column 2): is 2097153; allowed: up to 2097152 counts from the first, 0\n"
    );
}

#[test]
fn it_has_no_table() {
    let bench = Bench::new();
    let done = bench.run(&["table", "waves/turntable.toml"]);
    assert_eq!(
        done.stderr,
        "error: waves/turntable.toml:2: circuit: the lead-angle compensator has no table; \
         allowed: pulse_interpolator, or the command run\n  |\n2 | circuit = \"lead_angle\"\n  \
         |           ^^^^^^^^^^^^\n"
    );
}

/// The figures of the README: no step comes to its speed.
#[test]
fn what_is_measured_on_the_way_to_speed_is_of_a_moment_ago() {
    let bench = Bench::new();
    let run = bench.json(&[
        "run",
        "waves/turntable.toml",
        "--no-vcd",
        "--set",
        "acceleration_counts_per_s2=60000",
    ]);
    let names: Vec<&str> = run["systems"]
        .as_array()
        .unwrap()
        .iter()
        .map(|system| system["name"].as_str().unwrap())
        .collect();
    let last = |phase: usize, name: &str| {
        let system = names.iter().position(|other| *other == name).unwrap();
        let steps = run["phases"][phase]["steps"].as_array().unwrap();
        let errors = steps.iter().map(|step| {
            let error = step["last_error_counts"][system].as_i64().unwrap();
            error.unsigned_abs()
        });
        errors.collect::<Vec<_>>()
    };
    assert_eq!(last(0, "tuned"), [1, 5, 2, 46]);
    assert_eq!(last(0, "learning"), [1, 1, 8, 0]);
    assert_eq!(last(1, "tuned"), [91, 170, 539, 765]);
    assert_eq!(last(1, "learning"), [3, 3, 3, 6]);
}
