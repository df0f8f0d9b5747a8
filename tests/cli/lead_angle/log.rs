//! Position logs in place of a body.

use super::refusals::refused;
use super::*;

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
        times from time in ms, by median step; counts from right

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
    .assert_eq(&without_sizes(&text));
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
        "error: fast.csv:3: c: 2000000 counts/s since the sample before, with times in ms \
         (log_time_unit_ms); allowed: up to \
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
