//! `mutate`: single faults, and what finds them.

use super::support::Bench;
use expect_test::expect;
use serde_json::json;

/// A chart that sees one period and nothing of the tick after it.
const NOTE: &str = "\
```chart enable_counter[width=4] a period of three
tick      0  1  2
> period  3  .  .
= enable  _  _  #
```
";

/// Without times, and with single spaces.
fn timeless(text: &str) -> String {
    let mut lines = Vec::new();
    for line in text.lines() {
        let line = line.split_whitespace().collect::<Vec<_>>().join(" ");
        let time = line.rfind(" % ").filter(|_| line.ends_with(" s"));
        lines.push(time.map_or(line.clone(), |at| line[..at + 2].to_owned()));
    }
    lines.join("\n") + "\n"
}

#[test]
fn faults_are_found_by_charts_then_by_the_proof() {
    let bench = Bench::with("rtl_notes/blocks/note.md", NOTE);
    expect![[r#"
        circuit faults chart proof around unseen missed found time
        enable_counter 13 10 3 0 0 0 100.0 %
        13 faults, 0 of them not seen at a port out; of the others 100.00 % found, 0 missed
    "#]]
    .assert_eq(&timeless(&bench.succeed(&[
        "mutate",
        "enable_counter",
        "--charts",
        "rtl_notes",
    ])));
}

/// The notes that ship are in the program.
#[test]
fn it_runs_where_there_are_no_notes() {
    let report = Bench::new().json(&["mutate", "sync_stage"]);
    let row = &report["circuits"][0];
    assert!(row["chart"].as_u64().unwrap() > 0, "{row}");
    assert_eq!(row["missed"], 0, "{row}");
}

#[test]
fn what_nothing_finds_is_listed_with_where_it_shows() {
    // The circuit is too wide for a proof.
    let note = "\
```chart difference_engine nothing happens
tick       0
> modulus  8
= nearest  0
```
";
    let bench = Bench::with("note.md", note);
    let done = bench.run(&[
        "mutate",
        "difference_engine",
        "--charts",
        "note.md",
        "--least",
        "50",
    ]);
    assert_eq!(done.code, 1, "{}", done.stderr);
    expect![[r#"
        circuit faults chart proof around unseen missed found time
        difference_engine 6 1 0 0 0 5 16.7 %
        6 faults, 0 of them not seen at a port out; of the others 16.67 % found, 5 missed
        difference_engine: nearest: low: missed
        shows at small[], random run 0, tick 0: difference_engine.nearest
        difference_engine: d1.data: crossed with the next one: missed
        shows at small[], random run 0, tick 132: difference_engine.nearest
        difference_engine: d2.data: crossed with the next one: missed
        shows at small[], random run 0, tick 828: difference_engine.nearest
        difference_engine: d3.data: crossed with the next one: missed
        shows at small[], random run 0, tick 829: difference_engine.nearest
        difference_engine: d4.data: crossed with the next one: missed
        shows at small[], random run 0, tick 1994: difference_engine.nearest
    "#]]
    .assert_eq(&timeless(&done.stdout));
    expect![[r#"
        error: 16.67 % of the faults that show are found; wanted: 50 %
    "#]]
    .assert_eq(&done.stderr);
}

#[test]
fn every_fault_is_told_as_json() {
    let bench = Bench::with("note.md", NOTE);
    let report = bench.json(&["mutate", "enable_counter", "--charts", "note.md"]);
    assert_eq!(report["found_percent"], json!(100.0));
    let row = &report["circuits"][0];
    let suspects = row["suspects"].as_array().unwrap();
    let fates = ["chart", "proof", "around", "unseen", "missed"];
    let told = fates.map(|fate| suspects.iter().filter(|told| told["fate"] == fate).count());
    for (fate, told) in fates.iter().zip(told) {
        assert_eq!(row[fate], json!(told), "{fate}");
    }
    assert_eq!(row["faults"], json!(suspects.len()));
    let first = &suspects[0];
    assert!(
        first["fault"]
            .as_str()
            .unwrap()
            .starts_with("src/circuits/blocks/enable_counter.rs:")
    );
    assert_eq!(first["by"], "a period of three");
}

#[test]
fn a_chart_that_does_not_hold_would_find_everything() {
    let bench = Bench::with("note.md", NOTE.replace("_  _  #", "_  #  #"));
    let done = bench.run(&["mutate", "enable_counter", "--charts", "note.md"]);
    assert_eq!((done.code, done.stdout.as_str()), (1, ""));
    expect![[r#"
        error: note.md: line 4: tick 1: enable is _, the chart says #
        what the circuit does:
        ```chart enable_counter[width=4] a period of three
        tick      0  1  2
        > period  3  .  .
        = enable  _  _  #
        ```
    "#]]
    .assert_eq(&done.stderr);
}

#[test]
fn notes_that_cannot_be_read_are_refused() {
    let bench = Bench::with("note.md", "```chart enable_counter[width=4\n```\n");
    bench.write("empty/other.txt", NOTE);
    let mut said = String::new();
    for path in ["note.md", "empty", "none"] {
        let done = bench.run(&["mutate", "enable_counter", "--charts", path]);
        assert_eq!((done.code, done.stdout.as_str()), (2, ""), "{path}");
        said += &done.stderr;
    }
    for arguments in [
        ["mutate", "counter"],
        ["mutate", "--ticks=0"],
        ["mutate", "--least=101"],
    ] {
        let done = bench.run(&arguments);
        assert_eq!((done.code, done.stdout.as_str()), (2, ""), "{arguments:?}");
        let first = done.stderr.lines().next().unwrap_or_default();
        said += &format!("{}\n", first.split("; allowed").next().unwrap_or_default());
    }
    expect![[r#"
        error: note.md:1: chart: a chart begins with ```chart CIRCUIT or ```chart CIRCUIT[KEY=VALUE, ...]; allowed: Markdown with timing charts, or a folder of it
        error: --charts: empty has no timing chart; allowed: Markdown with timing charts, or a folder of it
        error: none: file: cannot be read: No such file or directory (os error 2); allowed: a readable file
        error: CIRCUIT: there is no counter
        error: invalid value '0' for '--ticks <TICKS>': 0 is not in 1..=100000000
        error: invalid value '101' for '--least <PERCENT>': 101 is not in 0..=100
    "#]].assert_eq(&said);
}
