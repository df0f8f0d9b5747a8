//! Drawings and part programs whose steps are known by hand, through `run`.

use super::support::{Bench, LINE, SHORT, keys, list, paths, whole};
use serde_json::{Value, json};

/// The summary of a run without waves.
fn summary(name: &str, text: &str, arguments: &[&str]) -> Value {
    let bench = Bench::with(name, text);
    let run = ["run", name, "--no-vcd"];
    bench.json(&[&run, &SHORT[..], arguments].concat())
}

/// Steps demanded, pulses up and down, and the end of an axis.
fn steps(summary: &Value, axis: &str) -> [i64; 4] {
    let field = |name| whole(summary, &format!("/axes/{axis}/{name}"));
    assert_eq!(
        field("pulses_emitted"),
        field("pulses_up") - field("pulses_down")
    );
    assert_eq!(field("pulses_emitted"), field("steps_demanded"));
    [
        field("steps_demanded"),
        field("pulses_up"),
        field("pulses_down"),
        field("end_position"),
    ]
}

#[test]
fn ten_millimetres_are_eight_hundred_steps() {
    let summary = summary("line.hpgl", LINE, &[]);
    assert_eq!(steps(&summary, "x"), [800, 800, 0, 800]);
    assert_eq!(steps(&summary, "y"), [0; 4]);
    assert_eq!(keys(&summary["axes"]), ["x", "y"]);
}

#[test]
fn an_l_in_g_code() {
    let text = "G21 G90\nG1 X10 F1200\nG1 Y-5\n";
    let summary = summary("l.ngc", text, &[]);
    assert_eq!(steps(&summary, "x"), [800, 800, 0, 800]);
    assert_eq!(steps(&summary, "y"), [-400, 0, 400, -400]);
}

#[test]
fn a_circle_ends_where_it_began() {
    // From the left end of a circle of 10 mm: X goes 800 steps and comes back.
    let summary = summary("circle.ngc", "G2 I5 F1200\n", &[]);
    assert_eq!(steps(&summary, "x"), [0, 800, 800, 0]);
    assert_eq!(steps(&summary, "y"), [0, 800, 800, 0]);
}

#[test]
fn relative_moves_add_up_from_where_the_pen_is() {
    let summary = summary("pr.plt", "PU40,40;PR;PD80,0,0,-120;", &[]);
    assert_eq!(steps(&summary, "x"), [240, 240, 0, 240]);
    // Up 1 mm, down 3 mm.
    assert_eq!(steps(&summary, "y"), [-160, 80, 240, -160]);
}

#[test]
fn a_move_in_z_brings_a_third_axis() {
    let summary = summary("z.ngc", "G1 X1 Z-2 F1200\n", &[]);
    assert_eq!(keys(&summary["axes"]), ["x", "y", "z"]);
    assert_eq!(steps(&summary, "z"), [-160, 0, 160, -160]);
    assert_eq!(steps(&summary, "x"), [80, 80, 0, 80]);
}

#[test]
fn one_axis_by_itself() {
    let summary = summary("x.ngc", "G1 X2 F1200\n", &["--set", "steps_per_mm=[-10]"]);
    assert_eq!(keys(&summary["axes"]), ["x"]);
    assert_eq!(steps(&summary, "x"), [-20, 0, 20, -20]);
    assert_eq!(summary["warnings"], json!([]));
}

#[test]
fn where_nothing_moves_the_summary_says_so() {
    let summary = summary(
        "z.ngc",
        "G1 Z1 F1200\n",
        &["--set", "steps_per_mm=[80, 80]"],
    );
    assert_eq!(steps(&summary, "x"), [0; 4]);
    assert_eq!(steps(&summary, "y"), [0; 4]);
    let expected = [
        "z.ngc: the drawing moves in Z, which no axis drives",
        "z.ngc: no axis makes a step",
    ];
    assert_eq!(summary["warnings"], json!(expected));
    for axis in ["x", "y"] {
        let minima = &summary["axes"][axis]["timing_min_ticks"];
        assert_eq!(minima["high"], Value::Null);
    }
}

#[test]
fn every_field_has_its_type_and_value() {
    let summary = summary("line.hpgl", LINE, &[]);
    let expected = [
        "appended_units",
        "axes",
        "circuit",
        "circuits",
        "clock_hz",
        "complaints",
        "exact",
        "files",
        "idle_units",
        "input",
        "remedy",
        "seconds",
        "step_rates",
        "ticks",
        "unattainable_units",
        "units",
        "variant",
        "vcd_window",
        "version",
        "warnings",
    ];
    assert_eq!(keys(&summary), expected);
    assert_eq!(summary["circuit"], "pulse_interpolator");
    assert_eq!(summary["input"], "line.hpgl");
    assert_eq!(summary["variant"], "safe");
    assert_eq!(summary["clock_hz"], 100_000);
    assert_eq!(summary["exact"], true);
    assert_eq!(summary["complaints"], json!([]));
    assert_eq!(paths(&summary), json!(["waves/line.svg"]));
    assert_eq!(summary["vcd_window"], Value::Null);
    assert_eq!(summary["warnings"], json!([]));
    assert_eq!(summary["remedy"], Value::Null);
    assert_eq!(whole(&summary, "/idle_units"), 0);
    assert_eq!(whole(&summary, "/unattainable_units"), 0);

    // 10 mm at 1200 mm/min and 500 mm/s²: 0.04 s to 20 mm/s, 0.46 s of it, 0.04 s to rest.
    let (units, ticks) = (whole(&summary, "/units"), whole(&summary, "/ticks"));
    assert_eq!(units - whole(&summary, "/appended_units"), 108);
    // The unit time at power-on comes before the table, and a tick after it.
    assert_eq!(ticks, (units + 1) * 500 + 1);
    assert_eq!(summary["seconds"].as_f64().unwrap(), ticks as f64 / 1e5);

    let x = &summary["axes"]["x"];
    let expected = [
        "end_position",
        "following_error_max",
        "pulses_down",
        "pulses_emitted",
        "pulses_up",
        "steps_demanded",
        "timing_min_ticks",
    ];
    assert_eq!(keys(x), expected);
    let error = &x["following_error_max"];
    assert_eq!(keys(error), ["line", "steps", "time_s", "unit"]);
    let most = error["steps"].as_f64().unwrap();
    assert!(most > 0.5 && most <= 1.0 + 1e-9, "{most}");
    assert_eq!(whole(error, "/line"), 1);
    let (unit, time_s) = (whole(error, "/unit"), error["time_s"].as_f64().unwrap());
    let unit_s = 500.0 / 1e5;
    let begin = unit as f64 * unit_s;
    assert!((begin..=begin + unit_s + 1e-12).contains(&time_s));

    let minima = &x["timing_min_ticks"];
    assert_eq!(keys(minima), ["high", "hold", "low", "setup"]);
    // 20 mm/s are 8 pulses in 500 ticks. At half-period 32 the last rises at 15 * 32 = 480 and
    // is cut short by the end of the unit time.
    assert_eq!(whole(minima, "/high"), 20);
    assert_eq!(whole(minima, "/low"), 32);
    // X never turns: the direction line does not change.
    assert_eq!(
        (&minima["setup"], &minima["hold"]),
        (&Value::Null, &Value::Null)
    );
}

/// The points of the path of that colour in a picture.
fn points(svg: &str, colour: &str) -> Vec<[f64; 2]> {
    let elements = svg
        .split('<')
        .filter(|element| element.starts_with("path "));
    let mut paths = elements.filter(|path| path.contains(colour));
    let (path, None) = (paths.next().unwrap(), paths.next()) else {
        panic!("two paths of {colour}");
    };
    let (_, data) = path.split_once("d=\"").unwrap();
    let (data, _) = data.split_once('"').unwrap();
    let points = data.split_whitespace().map(|point| {
        let (x, y) = point
            .trim_start_matches(['M', 'L'])
            .split_once(',')
            .unwrap();
        [x, y].map(|number| number.parse().unwrap())
    });
    points.collect()
}

/// What is left to the full circle is a step; the other way round the arc would be a dot.
#[test]
fn an_arc_that_ends_a_step_before_its_start_is_drawn_nearly_all_around() {
    for (turn, end) in [("G3", -0.025), ("G2", 0.025)] {
        let bench = Bench::with("o.ngc", format!("G0 X10\n{turn} Y{end} I-10 F1200\n"));
        let sets = [
            "--set",
            "arc_unit_ticks=500",
            "--set",
            "steps_per_mm=[40,40]",
        ];
        bench.succeed(&[&["run", "o.ngc", "--no-vcd"], &SHORT[..], &sets].concat());
        let drawn = points(&bench.read("waves/o.svg"), "#f0c9a0");
        assert!(drawn.len() > 100, "{turn}: {} points", drawn.len());
        let [x, y] = [0, 1].map(|axis| {
            let all = drawn.iter().map(|point| point[axis]);
            let (least, most) = (
                all.clone().fold(f64::INFINITY, f64::min),
                all.fold(f64::NEG_INFINITY, f64::max),
            );
            most - least
        });
        assert!(x > 300.0 && (x - y).abs() < 0.01 * x, "{turn}: {x} by {y}");
        let gap = |k: usize| drawn[0][k] - drawn[drawn.len() - 1][k];
        assert!(gap(0).hypot(gap(1)) < 0.01 * x, "{turn}");
    }
}

#[test]
fn a_program_with_a_loop_says_what_it_skipped_unless_it_is_strict() {
    let text = "M104 S200\n#1=0\no1 while [#1 LT 4]\n#1=[#1+1]\nG1 X[#1*2.5] F1200\no1 endwhile\n";
    let bench = Bench::with("loop.ngc", text);
    let run = [&["run", "loop.ngc", "--no-vcd"], &SHORT[..]].concat();
    let done = bench.run(&[&run[..], &["--json"]].concat());
    assert_eq!(done.code, 0);
    let summary: Value = serde_json::from_str(&done.stdout).unwrap();
    let said = summary["warnings"].to_string();
    assert!(said.contains("loop.ngc:1: M104: skipped"), "{said}");
    assert_eq!(steps(&summary, "x"), [800, 800, 0, 800]);
    bench.refuse(
        &[&run[..], &["--strict"]].concat(),
        "loop.ngc:1: M104: says nothing about the path, which --strict refuses; allowed: words that \
         move",
    );
    bench.refuse(
        &[&run[..], &["--most-lines", "10"]].concat(),
        "loop.ngc:3: program: more than 10 lines are run; allowed: a program that ends before; \
         --most-lines for more",
    );
}

#[test]
fn zeros_of_a_part_program_come_from_the_scenario() {
    let keys = "circuit = \"pulse_interpolator\"\ninput = \"p.ngc\"\n";
    let zeros = "[program]\ng54_mm = [5, 0, 0]\ng28_mm = [0, 2, 0]\n";
    let bench = Bench::with("p.ngc", "G1 X1 F1200\nG28\n");
    bench.write("s.toml", format!("{keys}{zeros}"));
    let ends = |arguments: &[&str]| {
        let run = [&["run"], arguments, &["--no-vcd"]].concat();
        let run = bench.json(&run);
        ["x", "y"].map(|axis| run["axes"][axis]["end_position"].as_i64().unwrap())
    };
    assert_eq!(ends(&["s.toml"]), [0, 160]);
    assert_eq!(
        ends(&["s.toml", "--set", "program.g28_mm=[6, 0, 0]"]),
        [480, 0]
    );
    assert_eq!(
        ends(&["p.ngc", "--set", "program={g28_mm=[0, 0.5, 0]}"]),
        [0, 40]
    );
    bench.refuse(
        &["run", "s.toml", "--set", "program.g28_mm=[6, nan, 0]"],
        "--set: program.g28_mm: has NaN; allowed: -1000000 to 1000000",
    );
    bench.refuse(
        &["run", "s.toml", "--set", "program.g54_mm=[6, 0]"],
        "--set: program.g54_mm: invalid length 2; allowed: a list of three numbers, of X, Y and Z",
    );
    bench.write("l.hpgl", "PD400,0;");
    bench.refuse(
        &["run", "l.hpgl", "--set", "program={g54_mm=[6, 0, 0]}"],
        "l.hpgl: program: a drawing in HPGL has no zeros and reference points of its own; \
         allowed: them with G-code only",
    );
}

/// A line, half a circle and a line, with a unit time for arcs of their own.
const SHAPE: &str = "G1 X10 F1200\nG3 X10 Y10 I0 J5\nG1 X0\n";

#[test]
fn the_conventional_device_runs_the_same_program() {
    let bench = Bench::with("l.ngc", SHAPE);
    let set = ["--set", "arc_unit_ticks=700"];
    let summary = bench.json(&[&["run", "l.ngc", "--no-vcd", "--beside"], &set[..]].concat());
    bench.succeed(&[&["table", "l.ngc", "--out", "t.csv"], &set[..]].concat());
    assert_eq!(summary["complaints"], json!([]));
    let [own, other] = list(&summary, "circuits") else {
        panic!("{summary}");
    };
    assert_eq!(
        (&own["circuit"], &other["circuit"]),
        (
            &json!("pulse_interpolator"),
            &json!("conventional_pulse_interpolator")
        )
    );
    assert_eq!(
        (whole(own, "/late_units"), whole(other, "/late_units")),
        (0, 0)
    );
    assert_eq!(
        (&own["timing_kept"], &other["timing_kept"]),
        (&json!(true), &json!(true))
    );
    // Two divisions of 27 ticks on each of two axes, and 3.
    assert_eq!(whole(other, "/unit_ticks_least"), 111);
    // Words of two axes have to be written while one is played, at best.
    assert!((2..111).contains(&whole(own, "/unit_ticks_least")), "{own}");
    assert_eq!(
        whole(own, "/units") - whole(other, "/units"),
        whole(&summary, "/appended_units")
    );
    // Pulse k of Y rises at (2k + 1)·n, and is due at (2k + 1)·T/2Y: the last is farthest off.
    let jitter =
        |n: f64, count: f64, period: f64| (2.0 * count - 1.0) * (n - period / (2.0 * count)).abs();
    let text = bench.read("t.csv");
    let largest = text.lines().skip(1).flat_map(|line| {
        let fields: Vec<u64> = line
            .split(',')
            .map(|field| field.parse().unwrap())
            .collect();
        [fields[2], fields[4]].map(|n| (n, fields[1]))
    });
    let largest = largest.filter(|(n, _)| *n > 0).map(|(n, period)| {
        let count = ((period - 1) / n).div_ceil(2);
        jitter(n as f64, count as f64, period as f64)
    });
    let largest = largest.fold(0.0, f64::max);
    let found = own["jitter_ticks_max"].as_f64().unwrap();
    assert!((found - largest).abs() < 1e-9, "{found}, {largest}");
    // Every demand is rounded, and is met where the driver has the time.
    let error = |row: &Value| row["end_error_steps_max"].as_f64().unwrap();
    assert!(error(other) > 0.49 && error(other) <= 0.5, "{other}");
    assert!(error(own) >= error(other), "{own}");
    let [adders, other_adders] = [own, other].map(|row| whole(row, "/adders"));
    assert!(
        0 < adders && adders < other_adders,
        "{adders}, {other_adders}"
    );
    assert_eq!(
        (whole(own, "/memory_bits"), whole(other, "/memory_bits")),
        (2 * 17 * 4096, 0)
    );
}

#[test]
fn a_unit_time_that_is_too_short_for_the_conventional_device_has_every_unit_late() {
    let bench = Bench::with("l.ngc", SHAPE);
    let at = |period: &str| {
        let set = format!("line_unit_ticks={period}");
        bench.json(&["run", "l.ngc", "--no-vcd", "--beside", "--set", &set])
    };
    for (period, late) in [("111", false), ("110", true)] {
        let summary = at(period);
        assert_eq!(summary["complaints"], json!([]));
        let [own, other] = list(&summary, "circuits") else {
            panic!("{summary}");
        };
        assert_eq!(whole(own, "/late_units"), 0, "{period}");
        // Patterns of 2048 units: while one is played, two words for each and a command are written.
        assert_eq!(whole(own, "/unit_ticks_least"), 3, "{period}");
        let expected = if late { whole(other, "/units") - 1 } else { 0 };
        assert_eq!(whole(other, "/late_units"), expected, "{period}");
    }
    let text = bench.succeed(&["run", "l.ngc", "--no-vcd", "--beside"]);
    let rows = text
        .lines()
        .filter(|line| line.contains("pulse_interpolator  "));
    assert_eq!(rows.count(), 4, "{text}");
}
