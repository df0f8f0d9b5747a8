//! `run` of the arc generator: summary against closed forms.

use super::support::{Bench, keys, list, near, number, paths, whole, without_sizes};
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};

/// Ts = 10 ms of 100 ticks, blends of 20 samples, 0.1 um a count.
pub const HEAD: &str = "circuit = \"arc_generator\"\nclock_hz = 10_000\nsample_period_ms = 10\n\
     acceleration_ms = 200\ncounts_per_mm = 10_000\nfeed_mm_per_min = 1200\n";
const TS: f64 = 0.01;
const TA: f64 = 0.1;

/// Half a circle of 10 mm, from the origin.
pub const SEAM: &str = "[[piece]]\nvia_mm = [10, 10, 0]\nto_mm = [20, 0, 0]\n";

/// A scenario with the usual head.
pub fn with(text: &str) -> Bench {
    Bench::with("s.toml", format!("{HEAD}{text}"))
}

fn summary(text: &str, more: &[&str]) -> Value {
    with(text).json(&[&["run", "s.toml", "--no-vcd"], more].concat())
}

/// Of an arc from rest to rest at up to `wanted` mm/s: samples and speed, by trial of every N.
fn samples_and_speed(radius: f64, angle: f64, wanted: f64) -> (i64, f64) {
    // What is left of the angle after both blends and N samples falls with the speed.
    let left =
        |n: f64, v: f64| angle - 4.0 * (v * TA / (2.0 * radius)).asin() - n * v * TS / radius;
    let n = (1..).find(|&n| left(n as f64, wanted) <= 0.0).unwrap();
    let (mut slow, mut fast) = (0.0, wanted);
    for _ in 0..100 {
        let v = f64::midpoint(slow, fast);
        match left(n as f64, v) > 0.0 {
            true => slow = v,
            false => fast = v,
        }
    }
    (n, slow)
}

#[test]
fn the_seam_is_what_closed_forms_say() {
    let run = ["run", "waves/weld.toml", "--no-vcd"];
    let bench = Bench::new();
    let summary = bench.json(&run);
    assert_eq!(
        keys(&summary),
        [
            "arcs",
            "arm",
            "blend_samples",
            "blends",
            "circuit",
            "circuits",
            "clock_hz",
            "complaints",
            "end_demanded",
            "end_position",
            "error_bound_um",
            "error_max_um",
            "exact",
            "files",
            "input",
            "lines",
            "operations",
            "point_bits",
            "record_bits",
            "sample_ticks",
            "sample_ticks_needed",
            "samples",
            "seconds",
            "settings",
            "speed_changes",
            "ticks",
            "vcd_window",
            "version",
            "warnings"
        ]
    );
    assert_eq!(summary["circuit"], "arc_generator");
    assert_eq!(whole(&summary, "/record_bits"), 3 * 32 * 42);
    assert_eq!(whole(&summary, "/point_bits"), 1271 * 3 * 24);
    assert_eq!(summary["input"], "weld");
    assert_eq!(summary["settings"]["rounding"], "nearest");
    assert_eq!(summary["exact"], true);
    assert_eq!(summary["complaints"], json!([]));
    assert_eq!(paths(&summary), json!(["waves/weld.svg"]));
    assert_eq!(
        summary["end_position"],
        json!([3_648_000, 1_864_000, 2_640_000])
    );
    assert_eq!(summary["lines"], json!([]));
    assert_eq!(whole(&summary, "/sample_ticks"), 100);
    assert_eq!(whole(&summary, "/sample_ticks_needed"), 82);
    assert_eq!(whole(&summary, "/blend_samples"), 20);

    // The points lie at cosines of 1, 0.6 and −0.8 on the circle.
    let (radius, angle) = (100.0, (-0.8f64).acos());
    let (n, v) = samples_and_speed(radius, angle, 20.0);
    let [arc] = list(&summary, "arcs") else {
        panic!("one arc");
    };
    near(number(arc, "/radius_mm"), radius, 1e-9);
    near(number(arc, "/angle_deg"), angle.to_degrees(), 1e-9);
    for (k, centre, axis) in [(0, 400.0, 0.36), (1, 100.0, 0.48), (2, 300.0, 0.8)] {
        near(number(arc, &format!("/centre_mm/{k}")), centre, 1e-9);
        near(number(arc, &format!("/axis/{k}")), axis, 1e-12);
    }
    assert_eq!(arc["line"], Value::Null);
    assert_eq!(whole(arc, "/samples"), n);
    near(number(arc, "/speed_mm_per_s/expected"), v, 1e-9);
    // A chord for each sample.
    near(number(arc, "/speed_mm_per_s/measured"), v, 1e-3);
    // Half a count of each coordinate at both ends of a sample.
    let count = 1e-4;
    assert!(number(arc, "/speed_deviation_mm_per_s") < 3f64.sqrt() * count / TS);
    let phi = 2.0 * (v * TA / (2.0 * radius)).asin();
    near(number(arc, "/blend_angle_deg"), phi.to_degrees(), 1e-9);
    let step = (angle - 2.0 * phi) / n as f64;
    near(number(arc, "/step_deg"), step.to_degrees(), 1e-12);

    // No error above √3/2 counts and what 1230 steps add; a rounding has 1/√12 counts rms.
    let bound = number(arc, "/bound_um");
    assert!(bound > 0.0866 && bound < 0.09, "{bound}");
    let least = number(arc, "/radius_error_um/0");
    let largest = number(arc, "/radius_error_um/1");
    assert!(least < -0.03 && largest > 0.03 && largest.max(-least) < bound);
    near(
        number(arc, "/radius_error_rms_um"),
        0.1 / 12f64.sqrt(),
        0.002,
    );
    assert!(number(arc, "/end_error_um") < bound);
    let conventional = number(arc, "/conventional_radius_error_um");
    assert!(
        conventional > 0.03 && conventional < 0.0867,
        "{conventional}"
    );
    assert!(number(&summary, "/error_max_um") < number(&summary, "/error_bound_um"));

    let ends = list(arc, "ends");
    assert_eq!(
        ends.iter().map(|end| &end["at"]).collect::<Vec<_>>(),
        ["A+", "C-"]
    );
    for end in ends {
        assert_eq!(end["rest"], true);
        let direction = (v * TA / (2.0 * radius)).asin().to_degrees();
        near(number(end, "/direction_jump_deg/expected"), direction, 1e-9);
        near(number(end, "/direction_jump_deg/measured"), direction, 0.01);
        let acceleration = v * v / radius;
        let pointer = "/acceleration_jump_mm_per_s2";
        near(
            number(end, &format!("{pointer}/expected")),
            acceleration,
            1e-9,
        );
        near(
            number(end, &format!("{pointer}/measured")),
            acceleration,
            0.3,
        );
        let off = radius * (1.0 - (phi / 2.0).cos()) * 1e3;
        near(number(end, "/off_arc_um/expected"), off, 1e-6);
        near(number(end, "/off_arc_um/measured"), off, 0.0867);
        let estimate = (v * TA).powi(2) / (8.0 * radius) * 1e3;
        near(number(end, "/off_arc_estimate_um"), estimate, 1e-9);
        near(estimate, off, 0.01);
    }

    // From rest: 3·v·ta/(2ta)².
    let blends = list(&summary, "blends");
    assert_eq!(
        blends
            .iter()
            .map(|blend| &blend["kind"])
            .collect::<Vec<_>>(),
        ["from rest", "to rest"]
    );
    for blend in blends {
        let peak = 0.75 * v / TA;
        near(
            number(blend, "/peak_acceleration_mm_per_s2/expected"),
            peak,
            1e-9,
        );
        near(
            number(blend, "/peak_acceleration_mm_per_s2/measured"),
            peak,
            0.005 * peak,
        );
        assert_eq!(blend["corner_distance_um"], Value::Null);
    }

    // The first command and one for every sample.
    let samples = whole(&summary, "/samples");
    assert_eq!(samples, 1 + n + 2 * 20);
    let ticks = whole(&summary, "/ticks");
    assert!(
        ticks > (samples - 1) * 100 && ticks <= (samples + 6) * 100,
        "{ticks}"
    );
    near(number(&summary, "/seconds"), ticks as f64 / 1e4, 1e-9);
}

#[test]
fn a_sample_costs_what_the_patent_counts() {
    let summary = Bench::new().json(&["run", "waves/weld.toml", "--no-vcd"]);
    let cost = |method: &str| {
        let rows = list(&summary, "operations").iter();
        let row = rows.clone().find(|row| row["method"] == method).unwrap();
        let names = ["multiplications", "additions", "sines_and_cosines"];
        names.map(|name| row[name].as_u64().unwrap())
    };
    assert_eq!(cost("patent, arc"), [9, 6 + 3, 0]);
    // A column: the sum of the parts, its comparison with the modulus and their difference, the sum
    // of the wholes and the carry. Four of them a coordinate, and a comparison and a carry that round.
    assert_eq!(cost("circuit, blend and line"), [0, 3 * (4 * 5 + 2), 0]);
    for method in ["conventional, arc", "conventional, accelerating"] {
        let [multiplications, additions, sines] = cost(method);
        assert!(
            multiplications > 18 && additions > 18 && sines == 2,
            "{method}"
        );
    }
}

/// The shorter sampling time that the text claims, and what it takes.
#[test]
fn the_conventional_circuit_runs_beside() {
    let bench = Bench::new();
    let run = ["run", "waves/weld.toml", "--no-vcd"];
    let summary = bench.json(&run);
    let [own, conventional] = list(&summary, "circuits") else {
        panic!("two circuits");
    };
    assert_eq!(own["circuit"], "arc_generator");
    assert_eq!(conventional["circuit"], "conventional_generator");
    let ticks = |row: &Value| {
        ["straight", "arc", "change", "most"].map(|name| row[format!("ticks_{name}")].as_u64())
    };
    assert_eq!(ticks(own), [2, 47, 82, 82].map(Some));
    assert_eq!(ticks(conventional), [None, Some(134), Some(169), Some(169)]);
    // Ts is 100 ticks.
    assert_eq!([&own["in_time"], &conventional["in_time"]], [true, false]);
    for row in [own, conventional] {
        let error = number(row, "/error_max_um");
        assert!(
            error > 0.03 && error < number(row, "/error_bound_um"),
            "{row}"
        );
        assert!(whole(row, "/adder_bits") > 20 * whole(row, "/adders"));
    }
    // By one: the engines of two coordinates against CORDIC and the matrix.
    assert!(whole(own, "/adders") > whole(conventional, "/adders"));
    let slow = [
        "--set",
        "sample_period_ms=17",
        "--set",
        "acceleration_ms=340",
    ];
    let summary = bench.json(&[&run[..], &slow].concat());
    let [_, conventional] = list(&summary, "circuits") else {
        panic!("two circuits");
    };
    assert_eq!(conventional["in_time"], true);
    assert_eq!(summary["complaints"], json!([]));
}

#[test]
fn the_joint_does_not_stop() {
    let summary = Bench::new().json(&["run", "waves/joint.toml", "--no-vcd"]);
    assert_eq!(summary["complaints"], json!([]));
    let kinds: Vec<_> = list(&summary, "blends")
        .iter()
        .map(|blend| &blend["kind"])
        .collect();
    assert_eq!(kinds, ["from rest", "joint", "joint", "to rest"]);
    let [arc] = list(&summary, "arcs") else {
        panic!("one arc");
    };
    near(number(arc, "/radius_mm"), 50.0, 1e-9);
    let v = number(arc, "/speed_mm_per_s/expected");
    assert!(v > 39.0 && v <= 40.0, "{v}");
    for end in list(arc, "ends") {
        assert_eq!(end["rest"], false);
        assert_eq!(end["off_arc_um"], Value::Null);
        let direction = (v * TA / 100.0).asin().to_degrees();
        near(number(end, "/direction_jump_deg/measured"), direction, 0.01);
        near(
            number(end, "/acceleration_jump_mm_per_s2/measured"),
            v * v / 50.0,
            0.5,
        );
    }
    for blend in &list(&summary, "blends")[1..3] {
        near(number(blend, "/turn_deg"), 0.0, 1e-6);
        let corner = |which: &str| number(blend, &format!("/corner_distance_um/{which}"));
        near(corner("measured"), corner("expected"), 0.2);
        // v·ta along the line, a chord of that length on the arc: 3/16 of what it leaves the line.
        let chord = v * TA;
        near(
            corner("expected"),
            3.0 / 16.0 * 1e3 * chord * chord / 100.0,
            0.1,
        );
    }
    let [first, last] = list(&summary, "lines") else {
        panic!("two lines");
    };
    near(number(first, "/length_mm"), 50.0, 1e-9);
    near(number(last, "/length_mm"), 80.0, 1e-9);
    // L/(v·Ts) samples less those of a blend.
    assert_eq!(whole(first, "/samples"), 50 * 100 / 40 - 20);
    assert_eq!(whole(last, "/samples"), 80 * 100 / 40 - 20);
}

#[test]
fn the_flange_is_the_whole_job() {
    let bench = Bench::new();
    let summary = bench.json(&["run", "waves/flange.toml", "--no-vcd"]);
    assert_eq!(summary["complaints"], json!([]));
    assert_eq!(summary["end_position"], json!([0, 0, 0]));
    let arcs = list(&summary, "arcs");
    // Bore, four holes, four ends of slots, nine of the outline.
    assert_eq!(arcs.len(), 1 + 4 + 4 + 9);
    let full = arcs.iter().filter(|arc| number(arc, "/angle_deg") == 360.0);
    assert_eq!(full.count(), 5);
    let up = arcs
        .iter()
        .filter(|arc| arc["axis"] == json!([0.0, 0.0, 1.0]));
    assert_eq!(up.count(), 5 + 5);
    let lobe = arcs.iter().find(|arc| arc["line"] == 39).unwrap();
    near(number(lobe, "/radius_mm"), 13.0, 1e-9);
    near(
        number(lobe, "/angle_deg"),
        360.0 - 2.0 * 12f64.atan2(5.0).to_degrees(),
        1e-9,
    );
    assert_eq!(number(lobe, "/speed_wanted_mm_per_s"), 20.0);
    // Eleven pieces of the outline, joined without a stop.
    let joints = list(&summary, "blends")
        .iter()
        .filter(|blend| blend["kind"] == "joint");
    let lines: Vec<_> = joints
        .map(|blend| whole(blend, "/line"))
        .filter(|line| *line > 35)
        .collect();
    assert_eq!(lines, (36..=45).collect::<Vec<_>>());
    for arc in arcs {
        let error = |k: usize| number(arc, &format!("/radius_error_um/{k}")).abs();
        assert!(error(0).max(error(1)) <= number(arc, "/bound_um"), "{arc}");
    }

    let text = bench.succeed(&["run", "waves/flange.toml", "--no-vcd"]);
    let start = "waves/flange.ngc on arc_generator (nearest): ";
    assert!(text.starts_with(start), "{text}");
    let table = |text: &str, head: &str| {
        let rows = text
            .lines()
            .skip_while(|line| !line.starts_with(head))
            .skip(1);
        rows.take_while(|line| line.starts_with(' ')).count()
    };
    assert_eq!(table(&text, "arc: piece"), 6);
    assert!(text.contains("and 12 more, of smaller radius error: --segments shows all\n"));
    assert_eq!(table(&text, "line: piece"), 6);
    assert_eq!(table(&text, "blend: piece"), 6);
    let text = bench.succeed(&["run", "waves/flange.toml", "--no-vcd", "--segments"]);
    assert_eq!(table(&text, "arc: piece"), 18);
    assert_eq!(table(&text, "radius error um: piece"), 18);
    assert_eq!(table(&text, "jumps: piece"), 36);
    assert_eq!(table(&text, "line: piece"), list(&summary, "lines").len());
    assert_eq!(table(&text, "blend: piece"), list(&summary, "blends").len());
    assert!(!text.contains("more, "), "{text}");
    assert!(without_sizes(&text).ends_with("wrote waves/flange.svg\n"));
}

#[test]
fn both_roundings_keep_their_bounds() {
    let bound = |rounding: &str| {
        let set = format!("rounding={rounding}");
        let summary = Bench::new().json(&["run", "waves/weld.toml", "--no-vcd", "--set", &set]);
        assert_eq!(summary["settings"]["rounding"], rounding);
        assert_eq!(summary["exact"], true);
        number(&summary, "/arcs/0/bound_um")
    };
    let (nearest, floor) = (bound("nearest"), bound("floor"));
    // Half a guard unit of each coordinate and step more: N·√3·2^-17 counts of 0.1 um.
    near(
        floor - nearest,
        1230.0 * 3f64.sqrt() * 0.5f64.powi(17) * 0.1,
        1e-5,
    );
}

#[test]
fn a_circle_by_hand() {
    // A full turn of 5 mm, from a part program that is given by itself.
    let bench = Bench::with("c.ngc", "G3 I5 F600\n");
    let arguments = ["run", "c.ngc", "--no-vcd", "--set", "circuit=arc_generator"];
    let summary = bench.json(&arguments);
    assert_eq!(summary["exact"], true);
    assert_eq!(summary["end_position"], json!([0, 0, 0]));
    let arc = &summary["arcs"][0];
    assert_eq!(whole(arc, "/line"), 1);
    near(number(arc, "/angle_deg"), 360.0, 1e-12);
    // Ts is 1 ms, 2ta 64 ms: the chords of both blends and N arcs of v·Ts make the turn.
    let (v, n) = (
        number(arc, "/speed_mm_per_s/expected"),
        whole(arc, "/samples"),
    );
    let turn = 4.0 * (v * 0.032 / 10.0).asin() + n as f64 * v * 1e-3 / 5.0;
    near(turn, TAU, 1e-9);
    assert!(v <= 10.0 && v > 10.0 * (1.0 - 1.0 / n as f64), "{v}");
}

#[test]
fn speeds_of_pieces_and_slower_ones() {
    let own = format!("{SEAM}feed_mm_per_min = 300\n");
    let run = summary(&own, &[]);
    assert_eq!(number(&run, "/arcs/0/speed_wanted_mm_per_s"), 5.0);
    let (n, v) = samples_and_speed(10.0, PI, 5.0);
    assert_eq!(whole(&run, "/arcs/0/samples"), n);
    near(number(&run, "/arcs/0/speed_mm_per_s/expected"), v, 1e-9);

    let fast = format!("{SEAM}feed_mm_per_min = 30000\n");
    let run = summary(&fast, &["--set", "short_pieces=slower"]);
    let v = number(&run, "/arcs/0/speed_mm_per_s/expected");
    // A blend reaches no farther than the radius.
    assert!(v <= 100.0 && v > 80.0, "{v}");
    assert_eq!(run["exact"], true);
}
