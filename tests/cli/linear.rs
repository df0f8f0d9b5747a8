//! `run` of the linear interpolator: summary, files, settings.

use super::support::{Bench, LINE, keys, list, paths, whole, without_sizes};
use serde_json::{Value, json};
use std::fs;

pub const LINEAR: [&str; 2] = ["--set", "circuit=linear_interpolator"];

/// The arguments of a run of a file on the linear interpolator.
pub fn run<'a>(file: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&["run", file, "--no-vcd"], &LINEAR[..], more].concat()
}

fn summary(name: &str, text: &str, more: &[&str]) -> Value {
    Bench::with(name, text).json(&run(name, more))
}

/// A number of a cycle, by its pointer.
fn of(summary: &Value, segment: usize, pointer: &str) -> Value {
    let segment = &summary["segments"][segment];
    let found = segment.pointer(pointer);
    found.unwrap_or_else(|| panic!("no {pointer}")).clone()
}

#[test]
fn a_ramp_that_is_no_whole_number_of_scans_is_told() {
    let times = |acceleration: &str, deceleration: &str| {
        let sets = [
            "--set",
            "scan_ticks=2000",
            "--set",
            &format!("acceleration_ms={acceleration}"),
            "--set",
            &format!("deceleration_ms={deceleration}"),
        ];
        summary("line.hpgl", LINE, &sets)["warnings"].clone()
    };
    assert_eq!(times("26", "40.0"), json!([]));
    let rounded = [
        "acceleration_ms: 24.9 ms taken as 24 ms (scan of 2 ms × 12)",
        "deceleration_ms: 0 ms taken as 2 ms (scan of 2 ms × 1)",
    ];
    assert_eq!(times("24.9", "0"), json!(rounded));
}

#[test]
fn ten_millimetres_are_a_hundred_and_thirty_four_scans() {
    // 2000 counts at 20 a scan, a third of 100 % speed: 34 scans each to get there and to rest.
    let summary = summary("line.hpgl", LINE, &["--beside"]);
    let expected = [
        "circuit",
        "clock_hz",
        "complaints",
        "conventional",
        "conventional_in_proportion",
        "dropped_points",
        "exact",
        "files",
        "input",
        "interpolator",
        "interpolator_other_master",
        "other_master",
        "scans",
        "seconds",
        "segments",
        "settings",
        "ticks",
        "vcd_window",
        "version",
        "warnings",
    ];
    assert_eq!(keys(&summary), expected);
    assert_eq!(summary["circuit"], "linear_interpolator");
    assert_eq!(summary["input"], "line.hpgl");
    assert_eq!(summary["settings"]["variant"], "floor");
    assert_eq!(summary["exact"], true);
    assert_eq!(summary["complaints"], json!([]));
    assert_eq!(summary["warnings"], json!([]));
    assert_eq!(paths(&summary), json!(["waves/line.svg"]));
    assert_eq!(summary["vcd_window"], Value::Null);
    assert_eq!(whole(&summary, "/clock_hz"), 1_000_000);
    assert_eq!(whole(&summary, "/settings/scan_ticks"), 1000);
    let (scans, ticks) = (whole(&summary, "/scans"), whole(&summary, "/ticks"));
    assert!(
        ticks >= scans * 1000 && scans > 134,
        "{scans} scans, {ticks} ticks"
    );
    assert_eq!(summary["seconds"].as_f64().unwrap(), ticks as f64 / 1e6);

    let system = [
        "contour_error_max_rapid_um",
        "contour_error_max_um",
        "deviation_max_lsb",
        "end_position",
        "master_acceleration_max_counts_per_scan2",
        "saturated_scans",
        "scans",
        "seconds",
        "slave_acceleration_max_counts_per_scan2",
        "ticks",
    ];
    let row = [
        "conventional",
        "conventional_in_proportion",
        "delta",
        "from",
        "interpolator",
        "line",
        "master",
        "other_master",
        "rapid",
        "segment",
        "speed_asked_mm_per_min",
        "speed_counts_per_scan",
        "speed_reached_mm_per_min",
        "to",
    ];
    let figures = [
        "contour_error_counts",
        "contour_error_um",
        "deviation_lsb",
        "deviation_perpendicular_counts",
        "end_error_counts",
        "master_acceleration_counts_per_scan2",
        "scans",
        "seconds",
        "slave_acceleration_counts_per_scan2",
    ];
    assert_eq!(list(&summary, "segments").len(), 1);
    assert_eq!(keys(&summary["segments"][0]), row);
    for name in ["interpolator", "conventional", "conventional_in_proportion"] {
        assert_eq!(keys(&summary[name]), system);
        assert_eq!(summary[name]["end_position"], json!([2000, 0]));
        let played = of(&summary, 0, &format!("/{name}"));
        assert_eq!(keys(&played), figures);
        assert_eq!(whole(&played, "/scans"), 134);
        assert_eq!(played["seconds"], 0.134);
        assert_eq!(played["end_error_counts"], json!([0, 0]));
        assert_eq!(played["deviation_lsb"], 0.0);
    }
    assert_eq!(of(&summary, 0, "/delta"), json!([2000, 0]));
    assert_eq!(of(&summary, 0, "/master"), "x");
    assert_eq!(of(&summary, 0, "/line"), 1);
    assert_eq!(of(&summary, 0, "/rapid"), false);
    assert_eq!(of(&summary, 0, "/speed_counts_per_scan"), 20.0);
    assert_eq!(of(&summary, 0, "/speed_asked_mm_per_min"), 6000.0);
    let reached = of(&summary, 0, "/speed_reached_mm_per_min");
    assert!((reached.as_f64().unwrap() - 6000.0).abs() < 1e-6);
}

/// What whole counts a scan would have halved, in every direction.
#[test]
#[ignore = "takes long"]
fn a_slow_feed_is_reached() {
    for feed in [290, 590] {
        for to in ["X20", "X20 Y11.547", "Y-20"] {
            let summary = summary("s.ngc", &format!("G1 {to} F{feed}\n"), &[]);
            let speed = |which: &str| {
                let value = of(&summary, 0, &format!("/speed_{which}_mm_per_min"));
                value.as_f64().unwrap()
            };
            assert_eq!(speed("asked"), f64::from(feed));
            let part = speed("reached") / f64::from(feed);
            assert!((0.99..=1.0 + 1e-9).contains(&part), "{to} F{feed}: {part}");
            let length = if to == "X20 Y11.547" { 23.094 } else { 20.0 };
            let seconds = summary["seconds"].as_f64().unwrap();
            let asked = 60.0 * length / f64::from(feed);
            // The ramps, and the motors' settling.
            assert!((seconds - asked).abs() < 0.2, "{to} F{feed}: {seconds} s");
        }
    }
}

#[test]
fn the_path_of_the_conventional_system_bends_and_ours_does_not() {
    // 40 mm by 3, where the conventional system with the same settings goes Y as fast as X.
    let summary = summary("flat.ngc", "G1 X40 Y3 F6018\nG0 X0 Y0\n", &["--beside"]);
    assert_eq!(summary["exact"], true);
    let lsb = |system: &str, segment| {
        let pointer = format!("/{system}/deviation_lsb");
        of(&summary, segment, &pointer).as_f64().unwrap()
    };
    let speed = of(&summary, 0, "/speed_counts_per_scan");
    assert!((speed.as_f64().unwrap() - 20.0037).abs() < 1e-3);
    assert!(lsb("interpolator", 0) < 1.0 && lsb("interpolator", 0) > 0.5);
    assert!(lsb("conventional", 0) > 100.0, "{}", lsb("conventional", 0));
    let inverse = lsb("conventional_in_proportion", 0);
    assert!(inverse < 20.0, "{inverse}");
    assert_eq!(of(&summary, 1, "/rapid"), true);
    assert_eq!(summary["interpolator"]["end_position"], json!([0, 0]));
}

#[test]
#[ignore = "takes long"]
fn each_rule_of_division_keeps_its_bound() {
    for (variant, most) in [("floor", 1.0), ("truncating", 1.0), ("centred", 0.501)] {
        let set = format!("variant={variant}");
        let text = "G1 X-13.7 Y5.1\nG1 X2 Y-7\nG1 X0 Y0\n";
        let summary = summary("v.ngc", text, &["--set", &set]);
        assert_eq!(summary["settings"]["variant"], variant);
        let deviation = summary["interpolator"]["deviation_max_lsb"]
            .as_f64()
            .unwrap();
        assert!(
            deviation > 0.4 && deviation < most,
            "{variant}: {deviation}"
        );
    }
}

#[test]
fn every_key_of_a_scenario_is_taken() {
    let scenario = r#"
circuit = "linear_interpolator"
input = "l.ngc"
variant = "centred"
clock_hz = 500_000
scan_ticks = 600
counts_per_mm = [100, 250.0]
feed_mm_per_min = 3000
rapid_mm_per_min = 9000.5
full_speed_mm_per_min = 12000
acceleration_ms = 30
deceleration_ms = 45.5
short_moves = "constant_time"
chord_tolerance_mm = 0.1
exact_stop = false
in_position_counts = 2
position_gain_per_s = [50, 40]
rated_speed_rev_per_min = [2000, 3000]
counts_per_rev = [4000, 8000]
velocity_loop_ms = [1, 1.5]
inertia_kg_m2 = [1e-5, 2e-5]
max_torque_nm = [0.5, 1]
friction_nm = [0, 1e-5]
vcd_ticks = 100
"#;
    let bench = Bench::with("all.toml", scenario);
    bench.write("l.ngc", "G1 X2 Y1\nG2 X3 Y2 I1 J0\n");
    let summary = bench.json(&["run", "all.toml"]);
    assert_eq!(summary["settings"]["variant"], "centred");
    assert_eq!(whole(&summary, "/clock_hz"), 500_000);
    assert_eq!(whole(&summary, "/settings/scan_ticks"), 600);
    assert_eq!(summary["interpolator"]["end_position"], json!([300, 500]));
    assert_eq!(
        bench.names(),
        [
            "all.toml",
            "l.ngc",
            "waves/",
            "waves/all.gtkw",
            "waves/all.svg",
            "waves/all.vcd"
        ]
    );
    // 30 and 45.5 ms are 25 and 38 scans of 1.2 ms to 100 % speed, and a quarter of them at most to
    // the feed: 7 and 10, also for the chords, which are too short. The first line is longer.
    let rows = list(&summary, "segments");
    let scans: Vec<i64> = rows
        .iter()
        .map(|row| whole(row, "/interpolator/scans"))
        .collect();
    assert!(
        scans[0] > 30 && scans[1..].iter().all(|scans| (17..25).contains(scans)),
        "{scans:?}"
    );
}

#[test]
fn the_order_of_overrides_does_not_matter_to_the_circuit() {
    let bench = Bench::with("l.hpgl", LINE);
    let after = [
        "run",
        "l.hpgl",
        "--set",
        "scan_ticks=2000",
        "--set",
        "variant=centred",
    ];
    let summary = bench.json(&[&after[..], &LINEAR[..]].concat());
    assert_eq!(whole(&summary, "/settings/scan_ticks"), 2000);
    assert_eq!(summary["settings"]["variant"], "centred");
}

#[test]
fn an_arc_becomes_chords_and_z_is_left_out_with_a_warning() {
    let text = "G1 X5 Z-1 F1000\nG3 X5 Y10 J5\n";
    let summary = summary("arc.ngc", text, &["--set", "chord_tolerance_mm=0.5"]);
    let warnings = ["arc.ngc: the drawing moves in Z, which no axis drives"];
    assert_eq!(summary["warnings"], json!(warnings));
    // Half a circle of 5 mm: 0.5 mm off are 51.7 degrees.
    assert_eq!(list(&summary, "segments").len(), 1 + 4);
    assert_eq!(summary["interpolator"]["end_position"], json!([1000, 2000]));
}

#[test]
fn what_moves_no_axis_is_told() {
    let dropped = |count| match count {
        1 => "z.ngc: 1 point left out that has the counts of the point before".to_owned(),
        _ => format!("z.ngc: {count} points left out that have the counts of the point before"),
    };
    let run = summary("z.ngc", "G1 X1 F1000\nG1 X1.001\nG1 X1.002\nG1 X2\n", &[]);
    assert_eq!(run["warnings"], json!([dropped(2)]));
    assert_eq!(whole(&run, "/dropped_points"), 2);
    let run = summary("z.ngc", "G1 X0.001 F1000\n", &[]);
    assert_eq!(run["warnings"], json!([dropped(1), "z.ngc: no axis moves"]));
    assert_eq!(run["segments"], json!([]));
    assert_eq!(run["exact"], true);
}

#[test]
fn a_motor_that_is_too_slow_is_told() {
    // 100 mm/s are 300 rev/min.
    let slow = ["--set", "rated_speed_rev_per_min=[250, 3000]"];
    let summary = summary("l.hpgl", "PD4000,0;", &slow);
    let saturated = whole(&summary, "/interpolator/saturated_scans/0");
    assert!(saturated > 100);
    let text = format!("x: in {saturated} scans the position loop asks for more than 250 rev/min");
    assert_eq!(summary["warnings"], json!([text]));
}

/// A zigzag of so many strokes.
fn zigzag(strokes: usize) -> String {
    let points = (1..=strokes).map(|k| format!("{},{}", 40 * k, (k % 2) * (40 + k)));
    format!("PD{};", points.collect::<Vec<_>>().join(","))
}

#[test]
#[ignore = "takes long"]
fn people_see_the_worst_segments_or_all_and_machines_see_all() {
    let bench = Bench::with("z.hpgl", zigzag(15));
    let text = bench.succeed(&run("z.hpgl", &[]));
    let json = bench.json(&run("z.hpgl", &[]));
    assert_eq!(list(&json, "segments").len(), 15);
    let (scans, ticks) = (whole(&json, "/scans"), whole(&json, "/ticks"));
    let seconds = ticks as f64 / 1e6;
    let head = format!(
        "z.hpgl on linear_interpolator (floor, master longer): {scans} scans, {ticks} ticks, {seconds:.3} s at \
         1000000 Hz\n"
    );
    assert!(text.starts_with(&head), "{text}");
    let segments = |text: &str| -> Vec<usize> {
        let rows = text.lines().skip_while(|line| !line.starts_with("segment"));
        let numbers = rows
            .skip(1)
            .map_while(|row| row.split_whitespace().next()?.parse().ok());
        numbers.collect()
    };
    let error = |segment: &usize| {
        let error = of(&json, *segment, "/interpolator/contour_error_um");
        error.as_f64().unwrap()
    };
    let shown = segments(&text);
    assert_eq!(shown.len(), 12);
    assert!(shown.is_sorted_by(|a, b| error(a) >= error(b)));
    let least = error(&shown[11]);
    assert!((0..15).all(|k| shown.contains(&k) || error(&k) <= least));
    let more = "and 3 more, of smaller contour error or with the pen up: --segments shows all\n";
    assert!(text.contains(more), "{text}");
    assert!(without_sizes(&text).ends_with("wrote waves/z.svg\n"));

    let text = bench.succeed(&run("z.hpgl", &["--segments"]));
    assert_eq!(segments(&text), (0..15).collect::<Vec<_>>());
    assert!(!text.contains("more, of"), "{text}");
    // Twelve are shown as they are.
    let bench = Bench::with("z.hpgl", zigzag(12));
    assert!(!bench.succeed(&run("z.hpgl", &[])).contains("more, of"));
}

#[test]
fn two_runs_write_the_same_bytes() {
    let once = || {
        let bench = Bench::with("z.hpgl", zigzag(5));
        let text = bench.succeed(&run("z.hpgl", &["--json", "--out", "a/b"]));
        assert_eq!(bench.names(), ["a/", "a/b/", "a/b/z.svg", "z.hpgl"]);
        (text, fs::read(bench.path("a/b/z.svg")).unwrap())
    };
    let (one, other) = (once(), once());
    assert!(one == other && one.1.len() > 1000);
}

#[test]
fn the_picture_says_what_it_shows() {
    let bench = Bench::with("z.hpgl", zigzag(5));
    let gains = ["--beside", "--set", "position_gain_per_s=[40, 30]"];
    bench.succeed(&run("z.hpgl", &gains));
    let svg = bench.read("waves/z.svg");
    for text in [
        "z: linear interpolator",
        "linear interpolator: path, errors times ",
        "conventional, same settings: path",
        "conventional, in proportion: path",
        "contour error",
        "path speed",
    ] {
        assert!(svg.contains(text), "{text}");
    }
}

#[test]
fn surfer_finds_the_names_of_states_beside_the_waves() {
    let bench = Bench::with("l.hpgl", LINE);
    let only = "controller.interpolator.pattern";
    let run = ["run", "l.hpgl", "--only", only, "--out", "o"];
    bench.succeed(&[&run[..], &LINEAR].concat());
    assert!(!bench.path("o/.surfer").exists());
    let said = bench.succeed(&[&run[..], &LINEAR, &["--surfer"]].concat());
    let phase = format!("{only}.trapezoid.phase");
    let file = format!("o/.surfer/mappings/{phase}.mapping");
    assert!(said.contains(&format!("wrote {file} (")), "{said}");
    let table = format!("\nName = {phase}\nBits = 2\n0 accelerate\n1 steady\n");
    let text = bench.read(&file);
    assert!(text.contains(&table), "{text}");
    bench.refuse_with(&["run", "l.hpgl", "--surfer", "--no-vcd"], |stderr| {
        let text = "error: the argument '--surfer' cannot be used with";
        assert!(stderr.starts_with(text), "{stderr}");
    });
}

#[test]
fn waves_have_the_window_and_the_scopes_that_are_asked_for() {
    let bench = Bench::with("l.hpgl", LINE);
    let arguments = ["run", "l.hpgl", "--from", "500", "--to", "3000"];
    let only = [
        "--only",
        "controller.loop_x",
        "--only",
        "controller.plant.x.position",
    ];
    let summary = bench.json(&[&arguments[..], &LINEAR, &only].concat());
    assert_eq!(summary["vcd_window"], json!([500, 3000]));
    let vcd = bench.read("waves/l.vcd");
    for (text, there) in [
        (" speed_ref ", true),
        (" position ", true),
        (" integral ", false),
    ] {
        assert_eq!(vcd.contains(text), there, "{text}");
    }
    let save = bench.read("waves/l.gtkw");
    assert!(save.contains("controller.loop_x.") && !save.contains("controller.loop_y."));

    let refuse = |flags: &[&str], text: &str| {
        bench.refuse(&[&["run", "l.hpgl"], &LINEAR[..], flags].concat(), text);
    };
    refuse(
        &["--only", "controller.pen"],
        "--only: there is no controller.pen; allowed: a signal, or a scope: controller, \
         controller.plant, controller.plant.x, controller.plant.y, controller.scan_counter, \
         controller.interpolator, controller.interpolator.targets, \
         controller.interpolator.targets.xs, controller.interpolator.targets.ys, \
         controller.interpolator.targets.speeds, controller.interpolator.targets.accelerations, \
         controller.interpolator.targets.decelerations, controller.interpolator.sequencer, \
         controller.interpolator.pattern, controller.interpolator.pattern.trapezoid, \
         controller.interpolator.pattern.mul_div, controller.interpolator.differentiator, \
         controller.interpolator.integrator, controller.interpolator.integrator.accumulator, \
         controller.interpolator.integrator.mul_div, controller.interpolator.switch, \
         controller.loop_x, controller.loop_x.counter, controller.loop_x.control, \
         controller.loop_y, controller.loop_y.counter, controller.loop_y.control, controller.gate",
    );
    refuse(
        &["--from", "9", "--to", "9"],
        "--from, --to: no tick from 9 to 9; allowed: --from below --to",
    );
}

#[test]
fn the_plotter_shows_what_the_circuit_is_for() {
    let bench = Bench::new();
    let summary = bench.json(&["run", "waves/plotter.toml", "--no-vcd"]);
    assert!(whole(&summary, "/ticks") < 2_000_000);
    assert!(list(&summary, "segments").len() > 50);
    let system = |name: &str, field: &str| summary[name][field].as_f64().unwrap();
    assert!(system("interpolator", "deviation_max_lsb") < 1.0);
    assert!(system("conventional", "deviation_max_lsb") > 20.0);
    let [ours, others] =
        ["interpolator", "conventional"].map(|s| system(s, "contour_error_max_um"));
    assert!(ours < others, "{ours} and {others} um");
    let masters = |name: &str| {
        let rows = list(&summary, "segments");
        rows.iter().filter(|row| row["master"] == name).count()
    };
    assert!(masters("x") > 20 && masters("y") > 20);
}
