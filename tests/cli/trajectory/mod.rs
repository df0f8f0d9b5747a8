//! `run` of the trajectory controller: figures against closed forms, files, windows.

mod axes;
mod chords;
mod curves;
mod fourth;
mod plant;
mod tolerance;

use super::scenarios::{CIRCLE, FEED, POCKET, runs_exactly};
use super::support::{Bench, keys, list, near, number, paths, whole};
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

/// A millisecond of 400 ticks, 1 um a count.
const HEAD: &str = "circuit = \"trajectory_controller\"\nclock_hz = 400_000\nperiod_ms = 1\n\
     counts_per_mm = 1000\nfeed_mm_per_min = 3000\n";

/// Ten millimetres along x.
const LINE: &str = "[[piece]]\nto_mm = [10, 0, 0]\n";

/// Within so large a part.
#[track_caller]
fn close(value: f64, expected: f64, part: f64) {
    near(value, expected, part * expected.abs());
}

pub fn with(text: &str) -> Bench {
    Bench::with("s.toml", format!("{HEAD}{text}"))
}

/// The row of a correction.
fn of<'a>(summary: &'a Value, correction: &str) -> &'a Value {
    let mut rows = list(summary, "corrections").iter();
    rows.find(|row| row["correction"] == correction).unwrap()
}

/// r(1 − |G|) and r(1 − |G(1 + e^(−jωτ) − G)|) of continuous models, in um.
fn closed_forms(radius_mm: f64, speed: f64, [k1, k2]: [f64; 2]) -> [f64; 2] {
    let omega = speed / radius_mm;
    // G = K1·K2 / (K1·K2 − ω² + jωK2), as amplitude and phase.
    let (re, im) = (k1 * k2 - omega * omega, omega * k2);
    let (size, phase) = (k1 * k2 / re.hypot(im), -im.atan2(re));
    let lag = -omega / k1;
    let sum = [
        1.0 + lag.cos() - size * phase.cos(),
        lag.sin() - size * phase.sin(),
    ];
    let corrected = size * sum[0].hypot(sum[1]);
    [size, corrected].map(|size| radius_mm * (1.0 - size) * 1e3)
}

#[test]
#[ignore = "takes long"]
fn the_circle_is_what_closed_forms_say() {
    let (_, summary) = runs_exactly(CIRCLE);
    assert_eq!(
        keys(&summary),
        [
            "axes",
            "circuit",
            "clock_hz",
            "complaints",
            "corrections",
            "exact",
            "feedback_gains",
            "files",
            "input",
            "loading_ticks",
            "path",
            "period_ticks",
            "period_ticks_needed",
            "periods",
            "plan",
            "seconds",
            "segments",
            "settings",
            "ticks",
            "vcd_window",
            "version",
            "warnings"
        ]
    );
    assert_eq!(summary["circuit"], "trajectory_controller");
    assert_eq!(summary["input"], "circle");
    assert_eq!(summary["settings"]["correction"], "vector");
    assert_eq!(summary["settings"]["rounding"], "nearest");
    assert_eq!(summary["exact"], true);
    let files = ["vcd", "gtkw", "svg"].map(|kind| format!("waves/circle.{kind}"));
    assert_eq!(paths(&summary), json!(files));
    assert_eq!(whole(&summary, "/axes"), 2);
    assert_eq!(whole(&summary, "/period_ticks"), 400);
    assert!(whole(&summary, "/period_ticks_needed") <= 400);
    let ticks = whole(&summary, "/ticks");
    near(
        number(&summary, "/seconds"),
        ticks as f64 / 3_276_800.0,
        1e-9,
    );
    // Two segments, of 13 words each.
    assert!(whole(&summary, "/loading_ticks") >= 26);

    // 2πr, at v but for two ramps, which take v/a each and half of it as way.
    near(number(&summary, "/path/length_mm"), TAU * 10.0, 1e-6);
    assert_eq!(whole(&summary, "/path/segments"), 2);
    near(
        number(&summary, "/plan/seconds"),
        TAU * 10.0 / 100.0 + 100.0 / 2000.0,
        1e-6,
    );
    near(number(&summary, "/plan/speed_max_mm_per_s"), 100.0, 1e-9);
    assert_eq!(whole(&summary, "/plan/stops"), 0);
    assert_eq!(whole(&summary, "/plan/slowest_joint/segment"), 1);

    let [plain, corrected] = closed_forms(10.0, 100.0, [50.0, 200.0]);
    // The figures of the patent's two cases: 0.099 mm and 0.0042 mm.
    near(plain, 99.0, 0.05);
    near(corrected, 4.19, 0.005);
    let circle = |correction: &str, which: &str| {
        number(of(&summary, correction), &format!("/circle/{which}"))
    };
    for (correction, form) in [("none", plain), ("vector", corrected)] {
        near(circle(correction, "radius_mm"), 10.0, 1e-6);
        near(circle(correction, "speed_mm_per_s"), 100.0, 1e-9);
        close(circle(correction, "continuous_um"), form, 1e-6);
        close(
            circle(correction, "model_um"),
            circle(correction, "sampled_um"),
            0.005,
        );
        // The shaft's twist, m·ω²r outwards, and the noise of counts.
        let twist = 2e-3 * 100.0 / 5000.0 * 10_000.0;
        near(
            circle(correction, "load_um"),
            circle(correction, "model_um") - twist,
            0.25,
        );
    }
    close(circle("none", "model_um"), plain, 0.02);
    // Steps of 1/8192 s are still seen in what is left by the correction.
    close(circle("vector", "model_um"), corrected, 0.03);
    // The prior art is made for this, and for this alone: the arc ends widened.
    assert!(circle("steady", "model_um") < 0.01);
    near(number(of(&summary, "steady"), "/model/end_um"), plain, 1.3);
    for correction in ["none", "vector"] {
        let row = of(&summary, correction);
        assert!(number(row, "/model/end_um") < 0.2, "{row}");
        assert!(number(row, "/load/end_um") < 1.0, "{row}");
        for axis in list(row, "axes") {
            assert!(whole(axis, "/end_position").abs() <= 2, "{axis}");
        }
        // v/K1 of the tangential response, and its sagitta.
        let following = number(row, "/load/following_max_mm");
        near(following, 2.0, 0.04);
    }
    // J·ω·v at the load and the motor, and what the ramps take: within the motor.
    for row in list(&summary, "corrections") {
        for axis in list(row, "axes") {
            let torque = number(axis, "/torque_max_nm");
            assert!(torque > 1.8 && torque < 5.0, "{axis}");
        }
    }
}

/// The figures of the note: each correction by the feed of a quarter.
#[test]
#[ignore = "takes long"]
fn where_the_feed_changes_the_vector_is_not_right() {
    let (_, summary) = runs_exactly(FEED);
    let names: Vec<_> = list(&summary, "corrections")
        .iter()
        .map(|one| one["correction"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["none", "steady", "feedback", "vector"]);
    let loads: Vec<Vec<f64>> = list(&summary, "segments")
        .iter()
        .map(|segment| {
            let each = list(segment, "contour_um").iter();
            each.map(|um| (um.as_f64().unwrap() * 10.0).round() / 10.0)
                .collect()
        })
        .collect();
    let expected = [
        // From rest, braking from 100 mm/s to 40, at 40, from 40 to 100.
        [97.6, 80.9, 6.9, 33.6],
        [97.5, 27.1, 6.4, 28.8],
        [35.4, 43.1, 5.5, 28.2],
        [97.6, 53.4, 7.1, 30.0],
        // All at 100 mm/s; the other three as before, but for the rest at the end.
        [97.5, 0.4, 0.3, 3.8],
        [97.5, 26.9, 6.5, 28.8],
        [35.5, 43.4, 5.5, 28.2],
        [97.6, 98.7, 20.2, 32.7],
    ];
    assert_eq!(loads, expected);
    let rms = |correction: &str| number(of(&summary, correction), "/load/contour_rms_um");
    for (correction, um) in [
        ("none", 65.1),
        ("steady", 27.3),
        ("feedback", 2.4),
        ("vector", 10.8),
    ] {
        near(rms(correction), um, 0.05);
    }
}

/// A piece of another feed than `feed_mm_per_min` takes the same time to it.
#[test]
fn an_acceleration_time_is_that_to_each_feed() {
    // The same way at the same feed, with and without a second piece of another one.
    let slow = "[[piece]]\nto_mm = [10, 0, 0]\nfeed_mm_per_min = 1200\n";
    let run = [
        "run",
        "s.toml",
        "--no-vcd",
        "--set",
        "acceleration_time_ms=50",
    ];
    let summary = with(slow).json(&run);
    // Up and down in 50 ms each, and 9 mm between.
    close(number(&summary, "/plan/seconds"), 0.1 + 0.45, 1e-6);
    close(
        number(&summary, "/plan/acceleration_mm_per_s2"),
        400.0,
        1e-6,
    );
    let told = "acceleration_time_ms = 50 is the time from rest to each feed: to 50 mm/s with 1000 \
                mm/s2, to 20 mm/s with 400 mm/s2; acceleration_mm_per_s2 = 1000 is the same for all";
    assert_eq!(summary["warnings"], json!([told]));
    // From 50 mm/s to 20 in 3/5 of the time, from 20 to rest in all of it.
    let summary = with(&format!(
        "{LINE}[[piece]]\nto_mm = [20, 0, 0]\nfeed_mm_per_min = 1200\n"
    ))
    .json(&run);
    let fast = 0.05 + 0.03 + (10.0 - 1.25 - 1.05) / 50.0;
    close(
        number(&summary, "/plan/seconds"),
        fast + 0.05 + 9.5 / 20.0,
        1e-6,
    );
    let summary = with(LINE).json(&run);
    assert_eq!(summary["warnings"], json!([]));
    close(
        number(&summary, "/plan/acceleration_mm_per_s2"),
        1000.0,
        1e-6,
    );
    // Feeds in F need no feed_mm_per_min.
    let bench = Bench::new();
    bench.write("p.ngc", "G21 G17 G90\nG1 X10 F1200\nG1 X20 F3000\nM2\n");
    let head = HEAD.replace(
        "feed_mm_per_min = 3000\n",
        "input = \"p.ngc\"\nacceleration_time_ms = 50\n",
    );
    bench.write("f.toml", format!("{head}[machine]\n{MACHINE}"));
    let summary = bench.json(&["run", "f.toml", "--no-vcd"]);
    assert_eq!(summary["warnings"], json!([]));
    let fast = 0.05 + 0.03 + (10.0 - 1.25 - 1.05) / 50.0;
    close(
        number(&summary, "/plan/seconds"),
        fast + 0.05 + 9.5 / 20.0,
        1e-6,
    );
}

#[test]
#[ignore = "takes long"]
fn in_shorter_periods_the_continuous_forms_hold() {
    // Two fifths of a circle, in periods of 1/4096 s.
    let text = "circuit = \"trajectory_controller\"\nclock_hz = 1_638_400\n\
         period_ms = 0.244140625\ncounts_per_mm = 2000\nfeed_mm_per_min = 6000\n\
         acceleration_mm_per_s2 = 4000\nstart_mm = [10, 0, 0]\n\
         [[piece]]\nvia_mm = [0, 10, 0]\nto_mm = [-8, 6, 0]\n\
         [machine]\nmax_torque_nm = 20\nmotor_inertia_kg_m2 = 1e-3\nload_inertia_kg_m2 = 2e-3\n\
         stiffness_nm_per_rad = 5000\ndamping_nm_s_per_rad = 0.2\n\
         counts_per_rev = 20_000\nmm_per_rev = 10\n";
    let bench = Bench::with("s.toml", text);
    let summary = bench.json(&["run", "--beside", "s.toml", "--no-vcd"]);
    let [plain, corrected] = closed_forms(10.0, 100.0, [50.0, 200.0]);
    for (correction, form) in [("none", plain), ("vector", corrected)] {
        let model = number(of(&summary, correction), "/circle/model_um");
        close(model, form, 0.06);
    }
}

#[test]
#[ignore = "takes long"]
fn a_straight_path_needs_no_correction() {
    let bench = with("[[piece]]\nto_mm = [8, 6, 0]\n");
    let summary = bench.json(&["run", "--beside", "s.toml", "--no-vcd"]);
    assert_eq!(summary["complaints"], json!([]));
    near(number(&summary, "/path/length_mm"), 10.0, 1e-6);
    for row in list(&summary, "corrections") {
        assert_eq!(row["circle"], Value::Null);
        if row["correction"] == "feedback" {
            // Half as late, and beyond the end by what a K1 of twice as much makes of it.
            near(number(row, "/load/following_max_mm"), 0.5, 0.01);
            near(number(row, "/model/contour_max_um"), 15.4, 0.5);
            near(number(row, "/model/at_mm"), 10.0, 1e-3);
            continue;
        }
        // Rounding alone: half a count is 0.5 um.
        assert!(number(row, "/model/contour_max_um") < 0.01, "{row}");
        // Equal motors see equal ways but for their counts.
        assert!(number(row, "/load/contour_max_um") < 3.0, "{row}");
        let end = |axis: usize| whole(row, &format!("/axes/{axis}/end_position"));
        assert!((end(0) - 8000).abs() <= 2 && (end(1) - 6000).abs() <= 2);
        // v/K1 less the period in which the model already moves.
        near(
            number(row, "/load/following_max_mm"),
            50.0 / 50.0 - 0.05,
            0.005,
        );
    }
    assert_eq!(summary["plan"]["slowest_joint"], Value::Null);
    let text = bench.succeed(&["run", "--beside", "s.toml", "--no-vcd"]);
    assert!(
        text.starts_with("s on trajectory_controller (vector, nearest): 2 axes, "),
        "{text}"
    );
    assert!(
        text.contains("mm/s; no stop\n\ncontour error um "),
        "{text}"
    );
    assert!(!text.contains("circle of"), "{text}");
}

#[test]
#[ignore = "takes long"]
fn the_correction_of_the_waves_is_chosen() {
    let quarter = "[[piece]]\nvia_mm = [3, 1, 0]\nto_mm = [4, 4, 0]\n";
    let only = "trajectory_controller.x.corrector.correction";
    for correction in ["none", "steady", "feedback", "vector"] {
        let bench = with(&format!("correction = \"{correction}\"\n{quarter}"));
        let run = bench.json(&["run", "--beside", "s.toml", "--only", only, "--out", "o"]);
        assert_eq!(run["settings"]["correction"], correction);
        let shown = list(&run, "corrections").iter();
        let shown: Vec<_> = shown
            .filter(|row| row["in_waves"] == true)
            .map(|row| &row["correction"])
            .collect();
        assert_eq!(shown, [correction]);
        let own = of(&run, correction);
        assert_eq!(
            (&own["ticks"], &own["periods"]),
            (&run["ticks"], &run["periods"])
        );
        let name = format!("loads, {correction}");
        assert!(bench.read("o/s.svg").contains(&name), "{name}");
        // Without a correction nothing is added but at first.
        let dump = bench.read("o/s.vcd");
        let values = dump.lines().filter(|line| line.starts_with('b')).count();
        assert_eq!(values == 1, correction == "none", "{values}");
    }
}

#[test]
#[ignore = "takes long"]
fn the_worst_segments_are_shown_or_all() {
    let piece = |k: u32| format!("[[piece]]\nto_mm = [{}, {}, 0]\n", k / 2, k.div_ceil(2));
    let pieces: String = (1..=9).map(piece).collect();
    let bench = with(&pieces);
    let text = bench.succeed(&["run", "--beside", "s.toml", "--no-vcd"]);
    assert!(text.contains("and 3 more, of smaller contour error: --segments shows all\n"));
    let text = bench.succeed(&["run", "--beside", "s.toml", "--no-vcd", "--segments"]);
    assert!(!text.contains(" more, "));
    let rows = text.lines().skip_while(|line| !line.starts_with("segment"));
    let rows = rows.skip(1).take_while(|line| !line.is_empty());
    assert_eq!(rows.count(), 9);
}

#[test]
#[ignore = "takes long"]
fn the_pocket_moves_three_axes() {
    let (bench, summary) = runs_exactly(POCKET);
    assert_eq!(whole(&summary, "/axes"), 3);
    let kinds = |kind: &str| {
        let segments = list(&summary, "segments").iter();
        segments.filter(|row| row["kind"] == kind).count()
    };
    assert_eq!((kinds("rapid"), kinds("arc"), kinds("line")), (2, 9, 13));
    for row in list(&summary, "corrections") {
        let ends: Vec<_> = list(row, "axes")
            .iter()
            .map(|axis| whole(axis, "/end_position"))
            .collect();
        assert!(ends[0].abs() <= 2 && ends[1].abs() <= 2, "{ends:?}");
        assert!((ends[2] - 2000).abs() <= 2, "{ends:?}");
    }
    // A corner of 4 mm at 80 mm/s, by v²/r of K1 and K2.
    let arc = &list(&summary, "segments")[8];
    near(number(arc, "/radius_mm"), 4.0, 1e-6);
    near(number(arc, "/speed_mm_per_s"), 80.0, 1e-6);
    let [plain, _] = closed_forms(4.0, 80.0, [50.0, 200.0]);
    close(number(arc, "/contour_um/0"), plain, 0.25);
    let rms = |correction: &str| number(of(&summary, correction), "/load/contour_rms_um");
    assert!(rms("vector") < rms("none") / 2.0);
    let svg = bench.read("waves/pocket.svg");
    assert!(svg.contains("path from above, errors of the loads times 10"));
}

#[test]
#[ignore = "takes long"]
fn the_files_of_a_run() {
    let bench = with(LINE);
    let summary = bench.json(&["run", "--beside", "s.toml", "--to", "3000", "--out", "o"]);
    assert_eq!(paths(&summary), json!(["o/s.vcd", "o/s.gtkw", "o/s.svg"]));
    assert_eq!(summary["vcd_window"], json!([0, 3000]));
    assert_eq!(
        bench.names(),
        ["o/", "o/s.gtkw", "o/s.svg", "o/s.vcd", "s.toml"]
    );
    let svg = bench.read("o/s.svg");
    for title in [
        "s: trajectory controller",
        "contour error of the loads",
        "following error of the loads",
        "speed",
        "none",
        "steady",
        "vector",
    ] {
        assert!(svg.contains(&format!("\n{title}\n")), "{title}");
    }
    let only = "trajectory_controller.tangential";
    let summary = bench.json(&["run", "--beside", "s.toml", "--only", only, "--out", "o"]);
    assert_eq!(summary["vcd_window"], json!([0, whole(&summary, "/ticks")]));
    let wide = bench.read("o/s.vcd");
    assert!(wide.contains("$scope module tangential") && !wide.contains("distribution"));
    let verilog = bench.json(&[
        "run",
        "--beside",
        "s.toml",
        "--no-vcd",
        "--verilog",
        "--out",
        "o",
    ]);
    let files = paths(&verilog);
    let files = files.as_array().unwrap();
    assert!(files.contains(&json!("o/trajectory_controller.v")));
    assert!(files.contains(&json!("o/trajectory_controller.stimulus")));
}

#[test]
#[ignore = "takes long"]
fn every_key_of_a_scenario_is_taken() {
    let text = "circuit = \"trajectory_controller\"\ninput = \"l.ngc\"\naxes = 3\n\
         clock_hz = 250_000\nperiod_ms = 2\ncounts_per_mm = 500\nfeed_mm_per_min = 1200\n\
         rapid_mm_per_min = 2400\nacceleration_mm_per_s2 = 500\nnormal_acceleration_mm_per_s2 = 500\n\
         jerk_time_ms = 10\ncorner_mm_per_min = 0\nk1_per_s = 40\nk2_per_s = 90\n\
         allow_overshoot = true\nrounding = \"floor\"\ncorrection = \"none\"\n\
         tangential_gain = 0.0625\nnormal_gain = 0.125\n\
         position_gain_per_s = 20\nspeed_hz = 15\nintegral_ms = 0\nvcd_ticks = 100\n\
         inertia_factor = [1, 0.9, 1]\n\
         [[load_torque]]\naxis = \"y\"\ntorque_nm = 0.1\nfrom_s = 0.1\nto_s = 0.2\n\
         [[axis]]\nmax_torque_nm = 5\nmotor_inertia_kg_m2 = 1e-3\nload_inertia_kg_m2 = 1e-3\n\
         stiffness_nm_per_rad = 300\ncounts_per_rev = 5000\nmm_per_rev = 10\n\
         damping_nm_s_per_rad = 0.02\n";
    let axis = "[[axis]]\nmax_torque_nm = 6\nmotor_inertia_kg_m2 = 1e-3\n\
         load_inertia_kg_m2 = 1e-3\nstiffness_nm_per_rad = 300\ncounts_per_rev = 2500\n\
         mm_per_rev = 5\ndamping_nm_s_per_rad = 0.02\n";
    let bench = Bench::with("all.toml", format!("{text}{axis}{axis}"));
    bench.write("l.ngc", "G0 X1\nG1 Y1\nG3 X0 Y2 I-1\nG1 X-1 F600\n");
    let summary = bench.json(&["run", "--beside", "all.toml"]);
    assert_eq!(summary["complaints"], json!([]));
    assert_eq!(summary["settings"]["rounding"], "floor");
    assert_eq!(summary["settings"]["correction"], "none");
    assert_eq!(summary["feedback_gains"], json!([0.0625, 0.125]));
    assert_eq!(whole(&summary, "/axes"), 3);
    assert_eq!(whole(&summary, "/clock_hz"), 250_000);
    assert_eq!(whole(&summary, "/period_ticks"), 500);
    assert_eq!(summary["vcd_window"], json!([0, 100]));
    let row = |k: usize, name: &str| number(&summary, &format!("/segments/{k}/{name}"));
    assert_eq!(row(0, "speed_wanted_mm_per_s"), 40.0);
    assert_eq!(row(1, "speed_wanted_mm_per_s"), 20.0);
    // √(a·r) of the arc is more; F of the program goes before the feed.
    near(row(2, "speed_limit_mm_per_s"), 20.0, 1e-9);
    assert_eq!(row(3, "speed_wanted_mm_per_s"), 10.0);
    // A corner is a stop where no step of the velocity is allowed; the arc is tangential.
    assert_eq!(row(1, "entry_limit_mm_per_s"), 0.0);
    assert_eq!(whole(&summary, "/plan/stops"), 1);
    near(row(2, "entry_mm_per_s"), 20.0, 1e-6);
    near(row(3, "entry_mm_per_s"), 10.0, 1e-6);
    let ends: Vec<_> = list(of(&summary, "none"), "axes")
        .iter()
        .map(|axis| whole(axis, "/end_position"))
        .collect();
    assert!(
        (ends[0] + 500).abs() <= 4 && (ends[1] - 1000).abs() <= 4,
        "{ends:?}"
    );

    // What shows in no single figure changes some.
    let figures = |summary: &Value| [&summary["plan"], &summary["corrections"]].map(Value::clone);
    for set in [
        "jerk_time_ms=0",
        "acceleration_mm_per_s2=400",
        "k1_per_s=30",
        "k2_per_s=100",
        "tangential_gain=0.25",
        "normal_gain=0",
        "position_gain_per_s=10",
        "speed_hz=10",
        "integral_ms=100",
        "axis_acceleration_mm_per_s2=300",
        "axis_acceleration_mm_per_s2=[1e5,300,1e5]",
        "k1_per_s=[40,38,40]",
        "k2_per_s=[90,95,90]",
        "inertia_factor=1",
        "load_torque=[]",
        "load_torque=[{axis=\"y\",torque_nm=0.1,from_s=0.1,to_s=0.19}]",
        "load_torque=[{axis=\"y\",torque_nm=0.1,to_s=0.2}]",
        "rounding=nearest",
    ] {
        let changed = bench.json(&["run", "--beside", "all.toml", "--no-vcd", "--set", set]);
        assert_ne!(figures(&changed), figures(&summary), "{set}");
    }

    // Across the path less is allowed than the feed on the arc.
    let slow = bench.json(&[
        "run",
        "all.toml",
        "--no-vcd",
        "--set",
        "normal_acceleration_mm_per_s2=20",
    ]);
    near(
        number(&slow, "/segments/2/speed_mm_per_s"),
        20.0f64.sqrt(),
        1e-6,
    );
}

#[test]
#[ignore = "takes long"]
fn a_drawing_by_itself() {
    let bench = Bench::with("l.ngc", "G1 X5 F1200\nG1 Z1\n");
    let run = [
        "run",
        "l.ngc",
        "--no-vcd",
        "--set",
        "circuit=trajectory_controller",
    ];
    let summary = bench.json(&run);
    assert_eq!(summary["input"], "l.ngc");
    assert_eq!(whole(&summary, "/axes"), 3);
    bench.refuse(
        &[&run[..], &["--set", "axes=2"]].concat(),
        "l.ngc:2: Z: leaves the plane of x and y by 1 mm; allowed: the height of the start, or \
         three axes",
    );
    bench.write("l.hpgl", "PD400,0;");
    let run = [
        "run",
        "l.hpgl",
        "--no-vcd",
        "--set",
        "circuit=trajectory_controller",
    ];
    bench.refuse(
        &run,
        "l.hpgl:1: F: missing; allowed: a feed, or feed_mm_per_min for all",
    );
    let summary = bench.json(&[&run[..], &["--set", "feed_mm_per_min=1800"]].concat());
    assert_eq!(whole(&summary, "/axes"), 2);
    near(number(&summary, "/path/length_mm"), 10.0, 1e-6);
}

pub const MACHINE: &str = "max_torque_nm = 10\nmotor_inertia_kg_m2 = 1e-3\n\
     load_inertia_kg_m2 = 2e-3\nstiffness_nm_per_rad = 200\ncounts_per_rev = 10_000\n\
     mm_per_rev = 10\n";

/// What the save file begins with is all there: a path that is none would be left out. That the file
/// is what the run writes, `the_circle_is_what_closed_forms_say` sees.
#[test]
fn the_overview_is_whole() {
    let save = concat!(env!("CARGO_MANIFEST_DIR"), "/waves/circle.gtkw");
    let save = std::fs::read_to_string(save).unwrap();
    let (_, rest) = save.split_once("\n-overview\n").unwrap();
    let (overview, _) = rest.split_once("\n-ports in\n").unwrap();
    let rows = overview
        .lines()
        .filter(|line| line.contains("trajectory_controller."));
    // The last one is `clk`.
    assert_eq!(rows.count(), 23, "{overview}");
}

/// As the note on errors that are fed back has it.
#[test]
#[ignore = "takes long"]
fn a_gain_that_the_corner_does_not_bear() {
    let run = Bench::new().run(&[
        "run",
        "waves/corner.toml",
        "--no-vcd",
        "--set",
        "correction=feedback",
        "--set",
        "tangential_gain=0",
        "--set",
        "normal_gain=12",
        "--set",
        "beside=false",
    ]);
    assert_eq!(run.code, 1, "{}", run.stderr);
    let all = run.stdout + &run.stderr;
    assert!(all.contains(", 1963 periods, "), "{all}");
    let limited = "feedback: in 1161 periods x asks for more than 10 Nm";
    assert!(all.contains(limited), "{all}");
}
