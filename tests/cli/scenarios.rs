//! Scenarios: those that ship with the crate, and files of one's own.

use super::support::{Bench, LINE, SHORT, list, paths, whole};
use rayon::prelude::*;
use serde_json::{Value, json};
use std::fs;
use std::path::Path;

/// Ticks in the machine's dump.
const MACHINE_SHOWN: i64 = 75_000;

/// Where the crate's own files are.
const CRATE: &str = env!("CARGO_MANIFEST_DIR");

/// Scenarios as `list` names them.
fn shipped() -> Vec<String> {
    let list = Bench::new().json(&["list"]);
    let scenarios = list["scenarios"].as_array().unwrap().iter();
    scenarios
        .map(|scenario| scenario["file"].as_str().unwrap().to_owned())
        .collect()
}

/// A directory with the crate's `waves` in it.
fn copy() -> Bench {
    let bench = Bench::new();
    for entry in fs::read_dir(Path::new(CRATE).join("waves")).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap();
        if [".toml", ".ngc", ".hpgl", ".csv"]
            .iter()
            .any(|end| name.ends_with(end))
        {
            bench.write(&format!("waves/{name}"), fs::read(&path).unwrap());
        }
    }
    bench
}

#[test]
fn every_scenario_that_ships_is_listed_and_none_else() {
    let mut files = copy().names();
    files.retain(|name| name.ends_with(".toml"));
    let mut listed = shipped();
    listed.sort();
    assert_eq!(listed, files);
}

/// Scenarios that take long.
const LONG: [&str; 5] = [
    "waves/machine.toml",
    "waves/turntable.toml",
    "waves/face.toml",
    "waves/saddle.toml",
    "waves/cam.toml",
];

/// The circles and the pocket, which tests of the trajectory controller run.
pub const CIRCLE: &str = "waves/circle.toml";
pub const FEED: &str = "waves/feed.toml";
pub const POCKET: &str = "waves/pocket.toml";

#[test]
#[ignore = "takes long"]
fn the_long_scenarios_run_exactly_and_their_dumps_are_whole() {
    LONG.into_par_iter()
        .for_each(|scenario| drop(runs_exactly(scenario)));
}

#[test]
fn every_other_scenario_runs_exactly_and_its_dump_is_whole() {
    let scenarios = shipped();
    let apart = [&LONG[..], &[CIRCLE, FEED, POCKET]].concat();
    let others = scenarios.iter().map(String::as_str);
    let others: Vec<_> = others
        .filter(|scenario| !apart.contains(scenario))
        .collect();
    assert_eq!(others.len() + apart.len(), scenarios.len());
    for scenario in others {
        runs_exactly(scenario);
    }
}

/// Runs a scenario that ships, and gives where it ran and its summary.
pub fn runs_exactly(scenario: &str) -> (Bench, Value) {
    let bench = Bench::new();
    // The first needs no name.
    let summary = match scenario {
        "waves/machine.toml" => bench.json(&["run"]),
        scenario => bench.json(&["run", scenario]),
    };
    assert_eq!(summary["complaints"], json!([]), "{scenario}");
    assert_eq!(summary["warnings"], json!([]), "{scenario}");
    let mut shown = whole(&summary, "/ticks");
    if summary["circuit"] == "lead_angle" {
        assert_eq!(list(&summary, "positionings").len(), 48);
        // The scenario says so: all ticks would be a gigabyte.
        shown = 300_000;
    } else if summary["circuit"] == "machine" {
        assert_eq!(summary["exact"], true, "{scenario}");
        for end in list(&summary, "ends") {
            assert_eq!(end["position"], json!([0, 0]), "{end}");
        }
        // The scenario says so: all ticks would be a gigabyte.
        shown = MACHINE_SHOWN;
    } else if summary["circuit"] == "linear_interpolator" {
        assert_eq!(summary["exact"], true, "{scenario}");
        let end = &summary["interpolator"]["end_position"];
        assert_eq!(*end, json!([0, 0]), "{scenario}");
    } else if summary["circuit"] == "arc_generator" {
        assert_eq!(summary["exact"], true, "{scenario}");
        // The flange's scenario says so: all ticks would be 200 MB.
        shown = shown.min(200_000);
    } else if summary["circuit"] == "trajectory_controller" {
        assert_eq!(summary["exact"], true, "{scenario}");
        // What the scenarios say: all ticks would be up to a gigabyte and a half.
        shown = match scenario {
            "waves/cam.toml" => 200_000,
            "waves/corner.toml" => shown,
            _ => 150_000,
        };
    } else if summary["patterns"].is_array() || summary["groups"].is_array() {
        assert_eq!(summary["exact"], true, "{scenario}");
    } else {
        assert_eq!(summary["exact"], true, "{scenario}");
        assert_eq!(whole(&summary, "/unattainable_units"), 0, "{scenario}");
        for axis in ["x", "y"] {
            let axis = &summary["axes"][axis];
            assert_eq!(whole(axis, "/end_position"), 0, "{scenario}");
            assert!(whole(axis, "/pulses_up") > 1000, "{scenario}");
        }
    }
    assert_eq!(summary["vcd_window"], json!([0, shown]), "{scenario}");
    let save = scenario.replace(".toml", ".gtkw");
    let text = bench.read(&save);
    let overview = text.split("-overview\n").nth(1).expect("an overview");
    let overview = overview.split("\n@200\n-\n").next().unwrap();
    let rows = overview.lines().filter(|line| line.contains('.')).count();
    // The last row is `clk`.
    let signals = match summary["circuit"].as_str().unwrap() {
        "pulse_interpolator" => {
            let axes = summary["axes"].as_object().unwrap().len();
            let motors = summary["step_rates"]["x"]["motor"].is_object();
            1 + axes * if motors { 6 } else { 4 }
        }
        "pulse_interpolator_groups" => 14,
        "linear_interpolator" => 13,
        "arc_generator" if summary["arm"].is_object() => 17,
        "arc_generator" => 14,
        "lead_angle" => 15,
        "trajectory_controller" => 22,
        "machine" => 29,
        other => panic!("{other}"),
    };
    assert_eq!(rows, signals + 1, "{save}: {overview}");
    assert!(
        text == fs::read_to_string(Path::new(CRATE).join(&save)).unwrap(),
        "{save} in the crate is not what a run of {scenario} writes"
    );
    (bench, summary)
}

#[test]
#[ignore = "takes long"]
fn what_is_built_in_is_what_the_files_say() {
    for scenario in [
        "bracket", "patterns", "rosette", "plotter", "weld", "flange",
    ] {
        let scenario = format!("waves/{scenario}.toml");
        let run = ["run", &scenario, "--no-vcd", "--json"];
        let (built_in, files) = (Bench::new(), copy());
        assert_eq!(built_in.succeed(&run), files.succeed(&run));
        let svg = scenario.replace(".toml", ".svg");
        assert!(built_in.read(&svg) == files.read(&svg), "{svg} differs");
    }
}

#[test]
fn a_file_goes_before_the_scenario_of_its_name() {
    let scenario = &shipped()[1];
    let bench = Bench::with(scenario, "circuit = 1\n");
    let done = bench.run(&["run", scenario]);
    assert_eq!(done.code, 2);
    assert!(
        done.stderr
            .starts_with(&format!("error: {scenario}:1: circuit: "))
    );
}

#[test]
fn without_a_word_the_default_runs() {
    // Where its files go is taken: it ends before it has begun.
    let bench = Bench::with("waves", "");
    for arguments in [&[][..], &["run"], &["run", "waves/machine.toml"]] {
        let done = bench.run(arguments);
        assert!(done.stderr.starts_with("error: --out: "), "{}", done.stderr);
        assert_eq!((done.code, done.stdout.as_str()), (2, ""), "{arguments:?}");
    }
    assert_eq!(shipped()[0], "waves/machine.toml");
}

#[test]
fn the_default_takes_another_input_from_where_it_runs() {
    let bench = Bench::with("bracket.ngc", "G1 X1 F1200\n");
    let summary = bench.json(&["run", "--no-vcd", "--set", "input=bracket.ngc"]);
    assert_eq!(summary["input"], "bracket.ngc");
    assert_eq!(summary["ends"][0]["position"], json!([40, 0]));
    // Without the override the file here is of no matter.
    let done = bench.run(&["run", "--no-vcd", "--set", "steps_per_mm=[1e9, 40]"]);
    let refusal = "error: waves/bracket.ngc:4: X: is ";
    assert!(done.stderr.starts_with(refusal), "{}", done.stderr);
}

#[test]
fn the_input_is_relative_to_its_scenario_an_override_to_where_it_runs() {
    let scenario = "circuit = \"pulse_interpolator\"\ninput = \"parts/line.hpgl\"\n";
    let bench = Bench::with("deep/er/job.toml", scenario);
    bench.write("deep/er/parts/line.hpgl", LINE);
    bench.write("here.hpgl", "PD0,40;");
    let run = [&["run", "deep/er/job.toml", "--no-vcd"], &SHORT[..]].concat();
    let summary = bench.json(&run);
    assert_eq!(summary["input"], "deep/er/parts/line.hpgl");
    assert_eq!(whole(&summary, "/axes/x/steps_demanded"), 800);
    assert_eq!(paths(&summary), json!(["waves/job.svg"]));

    let summary = bench.json(&[&run[..], &["--set", "input=here.hpgl"]].concat());
    assert_eq!(summary["input"], "here.hpgl");
    assert_eq!(whole(&summary, "/axes/y/steps_demanded"), 80);
    // Another override leaves the input where it is.
    let summary = bench.json(&[&run[..], &["--set", "vcd_ticks=10"]].concat());
    assert_eq!(summary["input"], "deep/er/parts/line.hpgl");
}

#[test]
fn every_key_of_a_scenario_is_taken() {
    let scenario = r#"
circuit = "pulse_interpolator"
input = "l.ngc"
variant = "safe"
clock_hz = 200_000
steps_per_mm = [10, -20.0, 5]
feed_mm_per_min = 600
rapid_mm_per_min = 1200.5
corner_mm_per_min = 30
acceleration_mm_per_s2 = 250
line_unit_ticks = 1000
arc_unit_ticks = 800
step_high_ticks = 3
step_low_ticks = 3
dir_setup_ticks = 4
dir_hold_ticks = 4
vcd_ticks = 100

[motor]
holding_torque_nm = 2
inertia_kg_m2 = 1e-5
damping_nm_s = 1e-3
friction_nm = 0.01
full_steps_per_rev = 400
microsteps = 16
"#;
    let bench = Bench::with("all.toml", scenario);
    bench.write("l.ngc", "G1 X2 Y1\nG2 X3 Y2 I1 Z1\n");
    let summary = bench.json(&["run", "all.toml"]);
    assert_eq!(whole(&summary, "/clock_hz"), 200_000);
    assert_eq!(summary["vcd_window"], json!([0, 100]));
    let end = |axis: &str| whole(&summary, &format!("/axes/{axis}/end_position"));
    assert_eq!((end("x"), end("y"), end("z")), (30, -40, 5));
}

#[test]
fn bad_scenarios_are_refused_with_their_line() {
    const NO_TOML: &str = "lines of key = value, in TOML";
    const KEYS: &str = "`motion-rtl keys pulse_interpolator` lists all";
    let missing = "s.toml: circuit: missing, and has no default; allowed: one of `pulse_interpolator`, `linear_interpolator`, `lead_angle`, `arc_generator`, `trajectory_controller`, `machine`";
    let drawing = "the path of an HPGL drawing or a G-code program";
    // What follows the first line, which names the circuit.
    let cases = [
        ("", format!("s.toml: input: missing; allowed: {drawing}")),
        ("input = \"q.ngc\"", "q.ngc: file: cannot be read: No such file or directory (os error 2); allowed: a readable file".into()),
        ("input = 3", "s.toml:2: input: invalid type: integer `3`; allowed: a path".into()),
        ("\ninput = \"l.hpgl\"\n\nclock_hz = 0", "s.toml:5: clock_hz: is 0; allowed: 1 to 10000000000".into()),
        ("input = \"l.hpgl\"\nfeed_mm_per_min = nan", "s.toml:3: feed_mm_per_min: is NaN; allowed: 0.001 to 10000000".into()),
        ("vcd_ticks = 0\ninput = \"l.hpgl\"", "s.toml:2: vcd_ticks: is 0; allowed: 1 to 9223372036854775807; --no-vcd for none".into()),
        ("clock = 1", format!("s.toml:2: clock: unknown key; did you mean clock_hz?; allowed: {KEYS}")),
        ("[motion]\nfeed = 1", format!("s.toml:2: [motion]: unknown key; did you mean motor?; allowed: {KEYS}")),
        ("clock_hz = 1\nclock_hz = 2", format!("s.toml:3: clock_hz: duplicate key; allowed: {NO_TOML}")),
        ("clock_hz", format!("s.toml:2: clock_hz: key with no value, expected `=`; allowed: {NO_TOML}")),
        ("clock_hz = 99999999999999999999", "s.toml:2: clock_hz: invalid type: integer `99999999999999999999`; allowed: a whole number from 1 to 10000000000".into()),
        ("feed_mm_per_min = \"fast\"", "s.toml:2: feed_mm_per_min: invalid type: string \"fast\"; allowed: a number from 0.001 to 10000000".into()),
        ("variant = \"wild\"", "s.toml:2: variant: unknown variant `wild`; allowed: `safe` or `literal`".into()),
        ("steps_per_mm = [\n  80,\n  true,\n]", "s.toml:4: steps_per_mm: invalid type: boolean `true`; allowed: a number from -1000000000 to 1000000000".into()),
    ];
    let bench = Bench::with("l.hpgl", LINE);
    for (text, refusal) in cases {
        bench.write(
            "s.toml",
            format!("circuit = \"pulse_interpolator\"\n{text}\n"),
        );
        for command in ["run", "table"] {
            bench.refuse(&[command, "s.toml"], &refusal);
        }
    }
    for text in ["", "input = \"l.hpgl\"\n", "# nothing\n\n"] {
        bench.write("s.toml", text);
        bench.refuse(&["run", "s.toml"], missing);
    }
    bench.write("s.toml", "circuit = \"cam\"\n");
    bench.refuse(
        &["run", "s.toml"],
        "s.toml:1: circuit: unknown variant `cam`; allowed: one of `pulse_interpolator`, `linear_interpolator`, `lead_angle`, `arc_generator`, `trajectory_controller`, `machine`",
    );
    bench.write("s.toml", b"# fine\n\n\xff\n");
    let not_text = "s.toml:3: file: not UTF-8; allowed: a scenario in TOML";
    bench.refuse(&["run", "s.toml"], not_text);
    bench.refuse(
        &["run", "none.toml"],
        "none.toml: file: cannot be read: No such file or directory (os error 2); allowed: a readable file",
    );
    bench.write("folder.toml/x", "");
    bench.refuse(
        &["run", "folder.toml"],
        "folder.toml: file: not a regular file; allowed: a readable file",
    );
}

#[test]
fn a_later_fault_keeps_its_line_under_overrides() {
    let text = "# one\n# two\ncircuit = \"pulse_interpolator\"\ninput = \"l.hpgl\"\nclock_hz = 0\n";
    let bench = Bench::with("s.toml", text);
    bench.write("l.hpgl", LINE);
    bench.refuse(
        &[
            "run",
            "s.toml",
            "--set",
            "vcd_ticks=5",
            "--set",
            "variant=literal",
        ],
        "s.toml:5: clock_hz: is 0; allowed: 1 to 10000000000",
    );
}
