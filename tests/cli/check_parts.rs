//! `check` as JSON, in parts, and parts put together.

use super::support::{Bench, Done, keys, list};
use serde_json::{Value, json};

/// Proofs and a sweep that take no time.
const WORK: [&str; 6] = [
    "check",
    "touch_probe",
    "differentiator",
    "integrator",
    "axis_switch",
    "--set=position=3",
];

/// Runs part `part` of `of` into a file of that name.
fn part(bench: &Bench, work: &[&str], part: &str, file: &str) -> Done {
    let done = bench.run(&[work, &["--shard", part, "--json"]].concat());
    bench.write(file, &done.stdout);
    done
}

fn parts(bench: &Bench, work: &[&str], of: u32) -> Vec<String> {
    let all = 1..=of;
    all.map(|number| {
        let file = format!("part{number}.json");
        let done = part(bench, work, &format!("{number}/{of}"), &file);
        assert_eq!((done.code, done.stderr.as_str()), (0, ""));
        file
    })
    .collect()
}

/// Without its times.
fn timeless(table: &str) -> String {
    let mut lines = Vec::new();
    for line in table.lines() {
        let words = line.split_whitespace().filter(|word| !word.contains('.'));
        lines.push(words.collect::<Vec<_>>().join(" "));
    }
    lines.join("\n")
}

fn merge(bench: &Bench, files: &[String]) -> Done {
    let files = files.iter().map(String::as_str);
    bench.run(
        &["check", "--merge"]
            .into_iter()
            .chain(files)
            .collect::<Vec<_>>(),
    )
}

#[test]
fn the_table_is_printed_as_json() {
    let report = Bench::new().json(&WORK);
    assert_eq!(
        keys(&report),
        [
            "asked",
            "program_version",
            "rows",
            "shard",
            "too_wide",
            "version"
        ]
    );
    assert_eq!(report["shard"], json!({"part": 1, "of": 1}));
    let rows = list(&report, "rows");
    let named: Vec<_> = rows
        .iter()
        .map(|row| {
            (
                row["circuit"].as_str().unwrap(),
                row["kind"].as_str().unwrap(),
            )
        })
        .collect();
    let expected = [
        ("touch_probe", "proof"),
        ("differentiator", "proof"),
        ("integrator", "sweep"),
        ("axis_switch", "proof"),
    ];
    assert_eq!(named, expected);
    assert_eq!(
        (&rows[0]["states"], &rows[0]["depth"]),
        (&json!(32), &json!(2))
    );
    // Four words of three bits, but those of a master that does not move.
    assert_eq!(rows[2]["states"], 7 << 9);
    assert!(rows.iter().all(|row| row["ended"] == "holds"));
}

#[test]
#[ignore = "takes long"]
fn parts_come_together_to_the_whole() {
    let bench = Bench::new();
    let whole = timeless(&bench.succeed(&WORK));
    assert!(whole.contains("integrator 3 3584"), "{whole}");
    for of in [1, 2, 3, 5] {
        let mut files = parts(&bench, &WORK, of);
        // In whatever order.
        files.reverse();
        let done = merge(&bench, &files);
        assert_eq!((done.code, done.stderr.as_str()), (0, ""));
        assert_eq!(timeless(&done.stdout), whole, "of {of}");
    }
    let report: Value = serde_json::from_str(&bench.read("part1.json")).unwrap();
    let rows = list(&report, "rows");
    // Of five parts the first has the first proof and a fifth of the cases, those of a master of 0
    // or 1 above.
    assert_eq!(rows.len(), 2);
    assert_eq!(rows[1]["states"], 4096 / 5 - 512);
    let text = bench.succeed(&[&WORK[..], &["--shard", "2/3"]].concat());
    assert!(text.ends_with("part 2 of 3\n"), "{text}");
}

#[test]
#[ignore = "takes long"]
fn what_is_broken_in_a_part_is_broken_in_the_whole() {
    let bench = Bench::new();
    let work = [
        "check",
        "unit_law",
        "pulse_generator",
        "--set=variant=literal",
    ];
    let whole = bench.run(&work);
    assert_eq!(whole.code, 1);
    let files = ["a.json".to_owned(), "b.json".to_owned()];
    assert_eq!(part(&bench, &work, "1/2", &files[0]).code, 1);
    assert_eq!(part(&bench, &work, "2/2", &files[1]).code, 1);
    let merged = merge(&bench, &files);
    assert_eq!((merged.code, merged.stderr), (1, whole.stderr));
    assert_eq!(timeless(&merged.stdout), timeless(&whole.stdout));
}

#[test]
fn a_circuit_that_is_named_twice_is_checked_once() {
    let bench = Bench::new();
    let once = ["check", "differentiator", "integrator", "--width", "3"];
    let twice = [
        "check",
        "differentiator",
        "integrator",
        "differentiator",
        "integrator",
        "--width",
        "3",
    ];
    let whole = timeless(&bench.succeed(&once));
    assert_eq!(timeless(&bench.succeed(&twice)), whole);
    let merged = merge(&bench, &parts(&bench, &twice, 2));
    assert_eq!((merged.code, timeless(&merged.stdout)), (0, whole));
}

#[test]
fn what_is_not_decided_is_no_counterexample() {
    let bench = Bench::new();
    let work = ["check", "unit_law", "sync_stage", "--limit", "10"];
    let files = ["a.json".to_owned(), "b.json".to_owned()];
    for (part_of, file, code) in [("1/2", &files[0], 2), ("2/2", &files[1], 0)] {
        assert_eq!(part(&bench, &work, part_of, file).code, code, "{part_of}");
    }
    let (whole, merged) = (bench.run(&work), merge(&bench, &files));
    assert_eq!((whole.code, merged.code), (2, 2));
    assert_eq!(merged.stderr, whole.stderr);

    // A counterexample beside it is what counts, in whichever part.
    let mut broken: Value = serde_json::from_str(&bench.read("b.json")).unwrap();
    broken["rows"][0]["ended"] = json!("broken");
    broken["rows"][0]["fault"] = json!("sync_stage: made up");
    bench.write("b.json", broken.to_string());
    let merged = merge(&bench, &files);
    assert_eq!(merged.code, 1);
    for text in ["not decided within 10 states", "sync_stage: made up"] {
        assert!(merged.stderr.contains(text), "{}", merged.stderr);
    }
}

#[test]
fn a_counterexample_in_a_part_of_a_sweep_is_the_one_that_counts() {
    let bench = Bench::new();
    let work = ["check", "integrator", "--width", "3"];
    let files = parts(&bench, &work, 2);
    for (file, ended) in [(&files[0], "too_wide"), (&files[1], "broken")] {
        let mut report: Value = serde_json::from_str(&bench.read(file)).unwrap();
        report["rows"][0]["ended"] = json!(ended);
        report["rows"][0]["fault"] = json!(ended);
        bench.write(file, report.to_string());
    }
    let merged = merge(&bench, &files);
    assert_eq!(
        (merged.code, merged.stderr.as_str()),
        (1, "error: broken\n")
    );
}

#[test]
fn missing_parts_are_listed_as_far_as_one_reads() {
    let bench = Bench::new();
    let work = ["check", "sync_stage"];
    part(&bench, &work, "2/4294967295", "a.json");
    bench.refuse(
        &["check", "--merge", "a.json"],
        "--merge: without part 1/4294967295, 3/4294967295, 4/4294967295, 5/4294967295, \
         6/4294967295, 7/4294967295, 8/4294967295, 9/4294967295, 10/4294967295, 11/4294967295 and \
         4294967284 more; allowed: all 4294967295 parts",
    );
    part(&bench, &work, "12/12", "a.json");
    part(&bench, &work, "1/12", "b.json");
    let missing: Vec<_> = (2..12).map(|part| format!("{part}/12")).collect();
    bench.refuse(
        &["check", "--merge", "a.json", "b.json"],
        &format!(
            "--merge: without part {}; allowed: all 12 parts",
            missing.join(", ")
        ),
    );
}

#[test]
fn a_part_that_there_is_not_is_refused() {
    let bench = Bench::new();
    for text in ["0/4", "5/4", "1/0", "1", "a/b", "1/4/2", ""] {
        let done = bench.run(&["check", "--shard", text]);
        assert_eq!((done.code, done.stdout.as_str()), (2, ""), "{text}");
        assert!(done.stderr.contains("--shard"), "{}", done.stderr);
    }
    let done = bench.run(&["check", "--merge", "a.json", "--width", "3"]);
    assert_eq!(done.code, 2);
}

#[test]
fn a_width_of_a_sweep_is_refused_by_its_own() {
    let text = "--set: integrator: a sweep over 68719476736 cases; allowed: smaller widths, for \
                4294967296 cases at most";
    Bench::new().refuse(&["check", "integrator", "--width", "9"], text);
}

#[cfg(target_os = "linux")]
#[test]
fn a_part_may_come_through_a_pipe() {
    let bench = Bench::new();
    let files = parts(&bench, &WORK, 2);
    let mut merge = bench.command(&["check", "--merge", &files[0], "/dev/stdin"]);
    let output = merge.write_stdin(bench.read(&files[1])).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    assert_eq!(text(output.stderr), "");
    assert_eq!(text(output.stdout), self::merge(&bench, &files).stdout);
}

#[test]
#[ignore = "takes long"]
fn parts_that_do_not_belong_together_are_refused() {
    let bench = Bench::new();
    let files = parts(&bench, &WORK, 2);
    let [one, two] = [bench.read(&files[0]), bench.read(&files[1])];
    let refuse = |files: &[&str], text: &str| {
        bench.refuse(&[&["check", "--merge"], files].concat(), text);
    };
    refuse(
        &["part1.json"],
        "--merge: without part 2/2; allowed: all 2 parts",
    );
    bench.write("again.json", &one);
    refuse(
        &["part1.json", "again.json"],
        "again.json: shard.part: is 1, as that of part1.json; allowed: each part once",
    );
    let other = ["check", "touch_probe", "--set=position=3", "--limit", "9"];
    part(&bench, &other, "2/2", "other.json");
    refuse(
        &["part1.json", "other.json"],
        "other.json: asked: check touch_probe --set position=3 --limit 9, that of part1.json check \
         touch_probe differentiator integrator axis_switch --set position=3 --limit 67108864; \
         allowed: parts of one work",
    );
    part(&bench, &WORK, "2/3", "third.json");
    refuse(
        &["part1.json", "third.json"],
        "third.json: shard.of: 3, that of part1.json 2; allowed: parts of one work",
    );
    refuse(
        &["nowhere.json"],
        "nowhere.json: file: cannot be read: No such file or directory (os error 2); allowed: a \
         readable file",
    );
    refuse(
        &["."],
        ".: file: not a regular file; allowed: a readable file",
    );
    bench.write("bytes.json", b"{\n\xff}");
    refuse(
        &["bytes.json"],
        "bytes.json:2: file: not UTF-8; allowed: what `check --shard --json` printed",
    );

    let spoilt = |from: &str, to: &str, text: &str| {
        assert!(two.contains(from), "{two}");
        bench.write("spoilt.json", two.replacen(from, to, 1));
        refuse(&["part1.json", "spoilt.json"], text);
    };
    let version = env!("CARGO_PKG_VERSION");
    spoilt(
        &format!("\"program_version\": \"{version}\""),
        "\"program_version\": \"0.0.1\"",
        &format!("spoilt.json: program_version: is 0.0.1; allowed: {version}"),
    );
    spoilt(
        "\"version\": 1",
        "\"version\": 2",
        "spoilt.json: version: is 2; allowed: 1",
    );
    let allowed = "allowed: what `check --shard --json` printed";
    spoilt(
        "\"of\": 2",
        "\"of\": \"two\"",
        &format!(
            "spoilt.json:21: shard.of: invalid type: string \"two\", expected u32 at line 21 column \
             15; {allowed}"
        ),
    );
    spoilt(
        "\"part\": 2",
        "\"part\": 3",
        "spoilt.json: shard: is 3 of 2; allowed: 1 to 2",
    );
    spoilt(
        "\"circuit\": \"differentiator\"",
        "\"circuit\": \"touch_probe\"",
        "spoilt.json: rows[0].circuit: is touch_probe; allowed: differentiator",
    );
    bench.write("spoilt.json", &two[..two.len() / 2]);
    let done = merge(&bench, &["spoilt.json".to_owned()]);
    assert_eq!(done.code, 2);
    assert!(done.stderr.contains("spoilt.json:"), "{}", done.stderr);
    assert!(done.stderr.contains("EOF"), "{}", done.stderr);
    let mut report: Value = serde_json::from_str(&two).unwrap();
    report["rows"].as_array_mut().unwrap().pop();
    bench.write("spoilt.json", report.to_string());
    refuse(
        &["part1.json", "spoilt.json"],
        "spoilt.json: rows: without integrator; allowed: 2 rows",
    );
}

/// The passage of `rtl_notes/commands.md`, on this machine.
#[test]
#[ignore = "needs GNU parallel"]
fn gnu_parallel_does_the_parts() {
    let bench = Bench::new();
    let whole = timeless(&bench.succeed(&WORK));
    let work = WORK[1..].join(" ");
    let program = super::support::PROGRAM;
    let command = format!("{program} check {work} --shard {{}}/4 --json");
    let output = std::process::Command::new("parallel")
        .args(["--will-cite", "--results", "part{}", &command, ":::"])
        .args(["1", "2", "3", "4"])
        .current_dir(bench.path("."))
        .output()
        .expect("GNU parallel");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    let files = [1, 2, 3, 4].map(|part| format!("part{part}"));
    let done = merge(&bench, &files);
    assert_eq!((done.code, done.stderr.as_str()), (0, ""));
    assert_eq!(timeless(&done.stdout), whole);
}
