//! `mutate`: single faults, and what finds them.

use super::json_schema::violations;
use super::summaries::schema;
use super::support::{Bench, list, words};
use expect_test::expect;
use serde_json::{Value, json};

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

/// A fault that the chart and the proof of the counter find.
const FAULT: [&str; 6] = [
    "mutate",
    "enable_counter",
    "--charts",
    "note.md",
    "--fault",
    "enable: low",
];

#[test]
fn a_single_fault_is_shown_with_each_check_that_finds_it() {
    let bench = Bench::with("note.md", NOTE);
    let report = bench.json(&[&FAULT[..], &["--out", "found"]].concat());
    let listed = bench.json(&FAULT[..4]);
    let schema = schema();
    let kind = &schema["$defs"]["fault"];
    assert_eq!(violations(&schema, kind, &report, "fault"), [""; 0]);
    let number = report["number"].as_u64().unwrap() as usize;
    let told = &listed["circuits"][0]["suspects"][number - 1];
    assert_eq!(told["number"], number);
    assert_eq!(told["fault"], report["fault"]);
    assert_eq!(told["by"], "a period of three");

    let found = list(&report, "found");
    let chart = &found[0];
    assert_eq!(
        [&chart["by"], &chart["name"]],
        ["chart", "a period of three"]
    );
    assert_eq!(chart["tick"], 2);
    let first = "tick 2: enable is 0, 1 without the fault";
    assert_eq!(chart["first_difference"], first);
    // Every property is either violated or holds.
    let violated = found.iter().filter(|run| run["by"] == "proof");
    let violated = violated.map(|run| run["name"].clone());
    let mut properties: Vec<_> = violated.collect();
    assert!(!properties.is_empty(), "{report}");
    assert_eq!(report["undecided"], json!([]));
    properties.extend(list(&report, "hold").iter().cloned());
    let circuit = &bench.json(&["list", "enable_counter"])["circuits"][0];
    let mut all = list(circuit, "properties").to_vec();
    all.sort_by_key(Value::to_string);
    properties.sort_by_key(Value::to_string);
    assert_eq!(properties, all);

    for run in found {
        let [vcd, save] = list(run, "waves") else {
            panic!("{run}")
        };
        let [vcd, save] = [vcd, save].map(|path| bench.read(path.as_str().unwrap()));
        let paths = ["enable", "without_fault.enable"];
        let paths = paths.map(|path| format!("enable_counter.{path}"));
        let ticks = words(&vcd, &paths.each_ref().map(String::as_str));
        // The run ends with the tick at which the fault shows.
        let tick = run["tick"].as_u64().unwrap() as usize;
        if run["by"] == "proof" {
            assert_eq!(ticks.len(), tick + 1, "{run}");
        }
        assert!(ticks.iter().all(|bits| bits[0] == 0), "{ticks:?}");
        assert!(ticks.iter().any(|bits| bits[1] == 1), "{ticks:?}");
        assert!(save.contains("without_fault"), "{save}");
    }
}

#[test]
fn what_finds_a_single_fault_is_printed() {
    let bench = Bench::with("note.md", NOTE);
    let text = bench.succeed(&[&FAULT[..], &["--out", "found"]].concat());
    let expected =
        "found by chart: a period of three\n  line 4: tick 2: enable is _, the chart says #\n";
    assert!(text.contains(expected), "{text}");
    assert!(text.contains("\nfound by property: "), "{text}");
    let first = "\n  first difference: tick 2: enable is 0, 1 without the fault\n";
    assert!(text.contains(first), "{text}");
    assert!(text.contains("\n  waves: found/enable_counter_"), "{text}");
    // `clean` knows the waves.
    bench.succeed(&["clean", "found", "--yes"]);
    assert!(
        !bench.path("found").read_dir().is_ok_and(|mut files| {
            files.any(|file| file.unwrap().path().extension().is_some())
        })
    );
}

#[test]
fn a_fault_that_nothing_finds_has_the_waves_of_a_random_run() {
    let note = "\
```chart difference_engine nothing happens
tick       0
> modulus  8
= nearest  0
```
";
    let bench = Bench::with("note.md", note);
    let fault = ["--fault", "d1.data: crossed", "--out", "found"];
    let mutate = ["mutate", "difference_engine", "--charts", "note.md"];
    let report = bench.json(&[&mutate[..], &fault].concat());
    assert_eq!(report["found"], json!([]));
    let random = &report["random"];
    assert_eq!(
        [&random["by"], &random["tick"]],
        [&json!("random"), &json!(132)]
    );
    let [vcd, _] = list(random, "waves") else {
        panic!("{random}")
    };
    let vcd = bench.read(vcd.as_str().unwrap());
    let paths = [
        "difference_engine.nearest",
        "difference_engine.without_fault.nearest",
    ];
    let ticks = words(&vcd, &paths);
    let differs = ticks.iter().position(|bits| bits[0] != bits[1]);
    assert_eq!((differs, ticks.len()), (Some(132), 133));
}

#[test]
fn a_fault_that_is_not_in_the_list_is_refused() {
    let bench = Bench::with("note.md", NOTE);
    let mut said = String::new();
    for fault in ["0", "14", "nonsense", "enable_counter.rs"] {
        let mutate = ["mutate", "enable_counter", "--charts", "note.md", "--fault"];
        let done = bench.run(&[&mutate[..], &[fault]].concat());
        assert_eq!((done.code, done.stdout.as_str()), (2, ""), "{fault}");
        said += done.stderr.split(';').next().unwrap_or_default();
        said += "\n";
    }
    let first = said.split(" (src").next().unwrap_or_default();
    assert_eq!(
        first,
        "error: --fault: enable_counter has no fault 0\n\
         error: --fault: enable_counter has no fault 14\n\
         error: --fault: enable_counter has no fault nonsense\n\
         error: --fault: enable_counter.rs is a part of several: 1"
    );
    let allowed = "allowed: one circuit, as in `mutate comparator --fault 1`";
    for (circuits, problem) in [
        (&[][..], "missing beside --fault"),
        (&["sync_stage", "integrator"], "--fault takes one circuit"),
    ] {
        let mutate = [&["mutate"], circuits, &["--fault", "1"]].concat();
        bench.refuse(&mutate, &format!("CIRCUIT: {problem}; {allowed}"));
    }
    for other in [&["--unseen"][..], &["--least", "9"]] {
        let done = bench.run(&[&["mutate", "sync_stage", "--fault", "1"], other].concat());
        assert_eq!(done.code, 2, "{other:?}");
    }
    assert_eq!(
        bench.run(&["mutate", "sync_stage", "--out", "found"]).code,
        2
    );
    assert!(!bench.path("found").exists());
}
