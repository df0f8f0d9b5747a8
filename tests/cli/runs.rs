//! What `run` puts into its files: windows and scopes of the dump, the same bytes every time.

use super::support::{Bench, LINE, SHORT, list, paths, whole, without_sizes};
use serde_json::json;
use std::fs;

/// Runs the line with these arguments; gives the dump.
fn dump(arguments: &[&str]) -> String {
    let bench = Bench::with("line.hpgl", LINE);
    let run = ["run", "line.hpgl", "--out", "o"];
    bench.json(&[&run, &SHORT[..], arguments].concat());
    assert_eq!(
        bench.names(),
        ["line.hpgl", "o/", "o/line.gtkw", "o/line.svg", "o/line.vcd"]
    );
    bench.read("o/line.vcd")
}

/// The first and the last time in a dump.
fn times(dump: &str) -> [u64; 2] {
    let mut times = dump.lines().filter_map(|line| line.strip_prefix('#'));
    let first = times.next().unwrap().parse().unwrap();
    [first, times.next_back().unwrap().parse().unwrap()]
}

/// The variables of a dump as `scope.name`.
fn variables(dump: &str) -> Vec<String> {
    let (mut scopes, mut names) = (Vec::new(), Vec::new());
    for line in dump.lines().take_while(|line| !line.starts_with('#')) {
        let words: Vec<_> = line.split_whitespace().collect();
        match words.first() {
            Some(&"$scope") => scopes.push(words[2]),
            Some(&"$upscope") => drop(scopes.pop()),
            Some(&"$var") => names.push(format!("{}.{}", scopes.join("."), words[4])),
            _ => {}
        }
    }
    names
}

#[test]
fn a_window_holds_its_ticks_and_no_more() {
    // 100 kHz: a tick is 10 units of 1 us.
    let dump = dump(&["--from", "1000", "--to", "1500"]);
    assert!(dump.contains("$timescale 1 us $end"));
    assert_eq!(times(&dump), [10_000, 15_000]);
}

#[test]
fn a_window_without_end_takes_as_many_ticks_as_the_scenario_allows() {
    let dump = dump(&["--from", "700", "--set", "vcd_ticks=300"]);
    assert_eq!(times(&dump), [7_000, 10_000]);
}

#[test]
fn a_window_past_the_end_ends_with_the_run() {
    let bench = Bench::with("line.hpgl", LINE);
    let run = [
        "run",
        "line.hpgl",
        "--from",
        "50000",
        "--to",
        "18446744073709551615",
    ];
    let summary = bench.json(&[&run, &SHORT[..]].concat());
    let ticks = whole(&summary, "/ticks");
    assert_eq!(summary["vcd_window"], json!([50_000, ticks]));
    let last = 10 * ticks as u64;
    assert_eq!(times(&bench.read("waves/line.vcd")), [500_000, last]);
    assert_eq!(
        paths(&summary),
        json!(["waves/line.vcd", "waves/line.gtkw", "waves/line.svg"])
    );
}

#[test]
fn a_window_that_begins_with_the_last_tick_is_the_last_that_is_taken() {
    let bench = Bench::with("line.hpgl", LINE);
    let run = [&["run", "line.hpgl"], &SHORT[..]].concat();
    let ticks = whole(&bench.json(&[&run[..], &["--no-vcd"]].concat()), "/ticks");
    let (last, over) = (&(ticks - 1).to_string(), &ticks.to_string());
    let summary = bench.json(&[&run[..], &["--from", last]].concat());
    assert_eq!(summary["vcd_window"], json!([ticks - 1, ticks]));
    let bench = Bench::with("line.hpgl", LINE);
    bench.refuse(
        &[&run[..], &["--from", over]].concat(),
        &format!("--from: is {over}; allowed: 0 to {last}, the last tick of the run"),
    );
}

#[test]
fn only_what_is_asked_for_is_dumped() {
    let only = |scopes: &[&str]| {
        let flags = scopes.iter().flat_map(|scope| ["--only", scope]);
        let arguments: Vec<_> = flags.chain(["--to", "10"]).collect();
        variables(&dump(&arguments))
    };
    let sync = only(&["pulse_interpolator.y.sync"]);
    assert_eq!(
        sync,
        [
            "pulse_interpolator.clk",
            "pulse_interpolator.y.sync.step",
            "pulse_interpolator.y.sync.pulse",
            "pulse_interpolator.y.sync.unit_rst",
        ]
    );
    let step = "pulse_interpolator.step_x";
    let two = only(&["pulse_interpolator.y.sync", step]);
    assert_eq!(two.len(), sync.len() + 1);
    assert!(two.contains(&step.to_owned()));
    assert!(variables(&dump(&["--to", "10"])).len() > 1000);
}

#[test]
fn the_save_file_shows_only_what_is_dumped() {
    let bench = Bench::with("line.hpgl", LINE);
    let only = ["--only", "pulse_interpolator.x.generator", "--to", "10"];
    bench.succeed(&[&["run", "line.hpgl"], &only[..], &SHORT[..]].concat());
    let save = bench.read("waves/line.gtkw");
    assert!(save.contains("[dumpfile] \"line.vcd\""));
    let of = |scope: &str| save.lines().any(|line| line.starts_with(scope));
    assert!(of("pulse_interpolator.x.generator."));
    assert!(!of("pulse_interpolator.y"));
}

#[test]
fn two_runs_write_the_same_bytes() {
    let run = || {
        let bench = Bench::with("l.ngc", "G1 X1 F1200\nG3 X2 Y1 J1\n");
        let text = bench.succeed(&[&["run", "l.ngc", "--json"], &SHORT[..]].concat());
        (text, bench)
    };
    let ((one_text, one), (other_text, other)) = (run(), run());
    assert_eq!(one_text, other_text);
    assert_eq!(one.names(), other.names());
    for file in ["waves/l.vcd", "waves/l.gtkw", "waves/l.svg"] {
        let (a, b) = (
            fs::read(one.path(file)).unwrap(),
            fs::read(other.path(file)).unwrap(),
        );
        assert!(!a.is_empty() && a == b, "{file} differs");
    }
}

#[test]
fn files_of_an_earlier_run_are_replaced() {
    let bench = Bench::with("line.hpgl", LINE);
    for file in ["waves/line.vcd", "waves/line.svg"] {
        bench.write(file, "old");
    }
    bench.write("waves/other.vcd", "kept");
    bench.succeed(&[&["run", "line.hpgl", "--to", "20"], &SHORT[..]].concat());
    assert!(bench.read("waves/line.vcd").starts_with("$version"));
    assert!(bench.read("waves/line.gtkw").starts_with("[*]"));
    assert!(bench.read("waves/line.svg").contains("<svg"));
    assert_eq!(bench.read("waves/other.vcd"), "kept");
    assert_eq!(bench.names().len(), 6);
}

#[test]
fn the_summary_for_people_says_what_the_one_for_machines_does() {
    let bench = Bench::with("line.hpgl", LINE);
    let run = [&["run", "line.hpgl", "--to", "100"], &SHORT[..]].concat();
    let ticks = whole(&bench.json(&run), "/ticks");
    let text = bench.succeed(&run);
    let first = format!("line.hpgl on pulse_interpolator (safe): {ticks} ticks, ");
    assert!(text.starts_with(&first), "{text}");
    let x = text.lines().find(|line| line.starts_with("x ")).unwrap();
    let columns: Vec<_> = x.split_whitespace().take(6).collect();
    assert_eq!(columns, ["x", "800", "800", "800", "0", "800"]);
    let window = format!("the waves show ticks 0 to 100 of {ticks}: --from and --to");
    assert!(text.contains(&window), "{text}");
    assert!(
        without_sizes(&text).ends_with("wrote waves/line.svg\n"),
        "{text}"
    );
}

#[test]
fn the_literal_variant_fails_and_says_where_it_first_miscounts() {
    let bench = Bench::with("line.hpgl", LINE);
    let literal = ["--set", "variant=literal", "--to", "50", "--json"];
    let done = bench.run(&[&["run", "line.hpgl"], &literal[..], &SHORT[..]].concat());
    assert_eq!(done.code, 1);
    let mut lines = done.stderr.lines();
    let first = lines.next().unwrap();
    // The first units have few pulses and begin with RST alike; then the counter runs on.
    assert!(first.starts_with("error: x: unit time "), "{first}");
    let words: Vec<_> = first.split(' ').collect();
    let number = |after: &str| -> u64 {
        let place = words.iter().position(|word| *word == after).unwrap();
        words[place + 1]
            .trim_end_matches([',', ':'])
            .parse()
            .unwrap()
    };
    let (unit, begin) = (number("time"), number("ticks"));
    assert_eq!(begin, (unit + 1) * 500, "{first}");
    assert_eq!(number("to"), begin + 500, "{first}");
    let (n, due) = (number("half-period"), number("make"));
    assert_eq!((499 / n).div_ceil(2), due, "{first}");
    let counted: u64 = words[words.iter().position(|w| *w == "steps").unwrap() - 1]
        .parse()
        .unwrap();
    assert_ne!(counted, due, "{first}");

    // The waves are there to look at, and the summary names the same faults.
    let summary: serde_json::Value = serde_json::from_str(&done.stdout).unwrap();
    assert_eq!(
        (&summary["exact"], &summary["variant"]),
        (&json!(false), &json!("literal"))
    );
    let complaints = list(&summary, "complaints");
    let complaints: Vec<_> = complaints
        .iter()
        .map(|text| text.as_str().unwrap())
        .collect();
    assert_eq!(done.stderr, format!("error: {}\n", complaints.join("\n")));
    let emitted = whole(&summary, "/axes/x/pulses_emitted");
    assert_ne!(emitted, 800);
    let ended = format!("x: {emitted} steps where 800 are demanded");
    assert!(complaints.contains(&ended.as_str()), "{complaints:?}");
    assert!(bench.names().contains(&"waves/line.vcd".to_owned()));
}

#[test]
fn without_waves_everything_else_is_the_same() {
    let run = ["run", "line.hpgl"];
    let [with, without] = [&[][..], &["--no-vcd"]].map(|no_vcd| {
        let bench = Bench::with("line.hpgl", LINE);
        let mut summary = bench.json(&[&run, no_vcd, &SHORT[..]].concat());
        summary["files"].take();
        summary["vcd_window"].take();
        (summary, bench.read("waves/line.svg"))
    });
    assert_eq!(with, without);
}

/// Without waves circuits and motors go over many ticks at once.
#[test]
#[ignore = "takes long"]
fn a_run_is_the_same_without_waves() {
    let bench = Bench::with("p.ngc", "G1 X2 F1500\nX1 Y1\nG3 X2 Y1 I0.5\nG0 X0 Y0\n");
    bench.write("straight.ngc", "G1 X2 F1500\nX1 Y1\nG0 X0 Y0\n");
    for (circuit, program, scope, others) in [
        (
            "pulse_interpolator",
            "p.ngc",
            "pulse_interpolator.unit_time",
            &[][..],
        ),
        ("linear_interpolator", "p.ngc", "controller.plant", &[]),
        (
            "linear_interpolator",
            "straight.ngc",
            "controller.plant",
            &["clock_hz=200000", "scan_ticks=200"],
        ),
        (
            "arc_generator",
            "straight.ngc",
            "arc_generator.sequencer",
            &["acceleration_ms=20", "rapid_mm_per_min=1200"],
        ),
        (
            "trajectory_controller",
            "p.ngc",
            "trajectory_controller.progress",
            &[],
        ),
        ("machine", "p.ngc", "machine.plant", &[]),
    ] {
        let circuit = format!("circuit={circuit}");
        let sets = std::iter::once(circuit.as_str()).chain(others.iter().copied());
        let sets = sets.flat_map(|set| ["--set", set]);
        let run: Vec<&str> = ["run", program].into_iter().chain(sets).collect();
        let told = |more: &[&str]| {
            let mut told = bench.json(&[&run, more].concat());
            let told = told.as_object_mut().unwrap();
            for of_waves in ["vcd_window", "files"] {
                told.remove(of_waves).unwrap();
            }
            serde_json::to_string_pretty(told).unwrap()
        };
        let quick = told(&["--no-vcd"]);
        // All of it in the waves, and a part in the middle.
        for window in [["0", "4000000000"], ["30000", "50000"]] {
            let waves = ["--format", "fst", "--only", scope];
            let [from, to] = window;
            let told = told(&[&waves[..], &["--from", from, "--to", to]].concat());
            assert_eq!(told, quick, "{run:?} {window:?}");
        }
    }
}
