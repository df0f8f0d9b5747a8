//! `table`: the report, the CSV, and scaling.

use super::support::{Bench, LINE, keys, paths, whole};
use serde_json::{Value, json};
use std::fmt::Write as _;

const L: &str = "G1 X10 F1200\nG3 X10 Y10 I0 J5\nG1 X0\n";

/// A row of the CSV: T, then half-period and whether down for each axis.
struct Row {
    period: u64,
    words: Vec<(u64, bool)>,
}

fn rows(csv: &str) -> Vec<Row> {
    let mut lines = csv.lines();
    let header = "unit,period_ticks,x_half_period_ticks,x_down,y_half_period_ticks,y_down";
    assert_eq!(lines.next(), Some(header));
    let numbers =
        |line: &str| -> Vec<u64> { line.split(',').map(|n| n.parse().unwrap()).collect() };
    lines
        .enumerate()
        .map(|(unit, line)| {
            let numbers = numbers(line);
            assert_eq!(numbers[0], unit as u64);
            let words = numbers[2..].chunks(2).map(|word| {
                assert!(word[1] <= 1);
                (word[0], word[1] == 1)
            });
            Row {
                period: numbers[1],
                words: words.collect(),
            }
        })
        .collect()
}

/// Steps up and down of an axis, by the law: one at every odd multiple of n below T.
fn count(rows: &[Row], axis: usize) -> (i64, i64) {
    let (mut up, mut down) = (0, 0);
    for row in rows {
        let (n, negative) = row.words[axis];
        let steps = (n..row.period).step_by((2 * n).max(1) as usize).count() as i64;
        let steps = if n == 0 { 0 } else { steps };
        *(if negative { &mut down } else { &mut up }) += steps;
    }
    (up, down)
}

#[test]
fn a_table_does_not_overwrite_what_it_is_made_from() {
    let bench = Bench::with("p.ngc", L);
    bench.write(
        "s.toml",
        "circuit = \"pulse_interpolator\"\ninput = \"p.ngc\"\n",
    );
    for (input, out) in [
        ("p.ngc", "p.ngc"),
        ("s.toml", "s.toml"),
        ("s.toml", "./p.ngc"),
    ] {
        let done = bench.run(&["table", input, "--out", out]);
        assert_eq!(done.code, 2, "{}", done.stdout);
        assert!(done.stderr.starts_with("error: --out: "), "{}", done.stderr);
        assert!(
            done.stderr
                .ends_with(" is the input; allowed: another file\n")
        );
    }
    assert_eq!(bench.read("p.ngc"), L);
    assert!(bench.read("s.toml").starts_with("circuit"));
}

#[test]
fn the_csv_counts_what_the_report_says() {
    let bench = Bench::with("l.ngc", L);
    let set = ["--set", "arc_unit_ticks=700"];
    let report = bench.json(&[&["table", "l.ngc", "--out", "sub/t.csv"], &set[..]].concat());
    assert_eq!(bench.names(), ["l.ngc", "sub/", "sub/t.csv"]);
    assert_eq!(paths(&report), json!(["sub/t.csv"]));
    let rows = rows(&bench.read("sub/t.csv"));
    assert_eq!(rows.len() as i64, whole(&report, "/units"));
    let ticks: u64 = rows.iter().map(|row| row.period).sum();
    assert_eq!(ticks as i64, whole(&report, "/total_ticks"));
    for (axis, end) in [(0, 0), (1, 800)] {
        let field = |name| whole(&report, &format!("/axes/{axis}/{name}"));
        let (up, down) = count(&rows, axis);
        assert_eq!(
            (field("pulses_forward"), field("pulses_backward")),
            (up, down)
        );
        assert_eq!((field("steps_demanded"), field("end_position")), (end, end));
        assert_eq!(up - down, end);
    }
    // Three patterns: line, arc, line.
    assert_eq!(whole(&report, "/patterns"), 3);
    let mut periods: Vec<_> = rows.iter().map(|row| row.period).collect();
    periods.dedup();
    assert_eq!(periods, [1000, 700, 1000]);
}

#[test]
fn the_report_has_its_fields() {
    let bench = Bench::with("l.hpgl", LINE);
    let report = bench.json(&["table", "l.hpgl"]);
    assert_eq!(
        keys(&report),
        [
            "appended_units",
            "axes",
            "clock_hz",
            "files",
            "input",
            "patterns",
            "remedy",
            "scaling",
            "total_ticks",
            "unattainable_units",
            "undriven",
            "units",
            "version",
            "warnings",
        ]
    );
    assert_eq!(report["input"], "l.hpgl");
    assert_eq!(report["scaling"], Value::Null);
    assert_eq!(whole(&report, "/axes/0/pulses_forward"), 800);
    assert_eq!(bench.names(), ["l.hpgl"]);
    let text = bench.succeed(&["table", "l.hpgl"]);
    let x = text.lines().find(|line| line.starts_with("x ")).unwrap();
    let columns: Vec<_> = x.split_whitespace().take(5).collect();
    assert_eq!(columns, ["x", "800", "800", "0", "800"]);
}

#[test]
fn a_demand_that_is_not_attainable_comes_with_its_remedy() {
    // 26 pulses in 1000 ticks: (2·26-1)² > 1000, and 999/51 = 999/53 rounded down is false; 25 is.
    let bench = Bench::with("l.hpgl", LINE);
    let fast = ["--set", "steps_per_mm=[1600, 1600]"];
    let report = bench.json(&[&["table", "l.hpgl"], &fast[..]].concat());
    assert!(whole(&report, "/unattainable_units") > 0);
    let period = whole(&report, "/remedy/period");
    assert!((2..1000).contains(&period), "{period}");
    let set = format!("line_unit_ticks={period}");
    let again = bench.json(&[&["table", "l.hpgl", "--set", &set], &fast[..]].concat());
    assert_eq!(whole(&again, "/unattainable_units"), 0);
    assert_eq!(whole(&again, "/axes/0/end_position"), 16_000);
}

#[test]
fn scaling_multiplies_every_half_period() {
    let bench = Bench::with("l.ngc", L);
    bench.succeed(&["table", "l.ngc", "--out", "one.csv"]);
    let one = rows(&bench.read("one.csv"));
    for (text, num, den) in [("3", 3, 1), ("3/2", 3, 2), (" 1 / 2 ", 1, 2)] {
        let report = bench.json(&["table", "l.ngc", "--scale", text, "--out", "two.csv"]);
        let two = rows(&bench.read("two.csv"));
        assert_eq!(one.len(), two.len());
        let mut rounded = [0; 2];
        for (one, two) in one.iter().zip(&two) {
            for (axis, (a, b)) in one.words.iter().zip(&two.words).enumerate() {
                assert_eq!(a.1, b.1);
                if b.0 == 0 {
                    assert!(
                        a.0 == 0 || a.0 * num / den >= one.period - 1,
                        "{} became 0",
                        a.0
                    );
                } else {
                    assert!(
                        (b.0 * den).abs_diff(a.0 * num) * 2 <= den,
                        "{} to {}",
                        a.0,
                        b.0
                    );
                    rounded[axis] += i64::from(b.0 * den != a.0 * num);
                }
            }
        }
        for (axis, rounded) in rounded.iter().enumerate() {
            let scaling = &report["scaling"][axis];
            assert_eq!(whole(scaling, "/rounded_units"), *rounded, "{text}");
            let (up, down) = count(&two, axis);
            let (whole_up, whole_down) = count(&one, axis);
            let ideal = (whole_up - whole_down) as f64 * den as f64 / num as f64;
            let drift = scaling["drift_steps"].as_f64().unwrap();
            assert!(
                ((up - down) as f64 - ideal - drift).abs() < 1e-6,
                "{text}: {drift}"
            );
        }
    }
}

#[test]
fn a_table_has_no_standard_output() {
    let bench = Bench::with("l.ngc", "G1 X0.1 F1\n");
    let text = "--out: is -; allowed: the path of a file";
    bench.refuse(&["table", "l.ngc", "--out", "-"], text);
    assert_eq!(bench.names(), ["l.ngc"]);
}

#[test]
fn bad_ratios_are_refused() {
    let bench = Bench::with("l.ngc", "G1 X0.1 F1\n");
    for ratio in ["0", "1/0", "", "x", "1/2/3", "1.5", "+", "4294967296"] {
        let text = format!(
            "--scale: is {ratio}; allowed: NUM/DEN, two whole numbers from 1 to 4294967295"
        );
        bench.refuse(
            &["table", "l.ngc", "--scale", ratio, "--out", "t.csv"],
            &text,
        );
    }
    bench.refuse(
        &[
            "table",
            "l.ngc",
            "--set",
            "line_unit_ticks=190000",
            "--scale",
            "2",
        ],
        "--scale: unit 1, x: scaled half-period 131070 is not from 1 to 65535; allowed: a \
         smaller ratio",
    );
}

#[test]
fn a_million_points_are_compiled() {
    // 25 m along X, up and down by a plotter unit: drawn at 10 m/s.
    let mut text = String::from("PR;PD");
    for point in 0..1_000_000 {
        let _ = write!(
            text,
            "{}1,{}",
            if point == 0 { "" } else { "," },
            [1, -1][point % 2]
        );
    }
    let bench = Bench::with("long.hpgl", text + ";");
    let settings = [
        "--set",
        "steps_per_mm=[1, 1]",
        "--set",
        "feed_mm_per_min=600000",
        "--set",
        "corner_mm_per_min=1000000",
        "--set",
        "acceleration_mm_per_s2=100000",
        "--set",
        "line_unit_ticks=500",
    ];
    let report = bench.json(&[&["table", "long.hpgl"], &settings[..]].concat());
    assert_eq!(whole(&report, "/axes/0/pulses_forward"), 25_000);
    assert_eq!(whole(&report, "/axes/1/end_position"), 0);
    assert_eq!(whole(&report, "/unattainable_units"), 0);
}

/// Where one error is as large as another, the earlier, by the same numbers.
#[test]
fn run_and_table_tell_the_same_largest_following_errors() {
    for scenario in ["waves/bracket.toml", "waves/rosette.toml"] {
        let bench = Bench::new();
        let run = bench.json(&["run", scenario, "--no-vcd"]);
        let table = bench.json(&["table", scenario]);
        for (index, axis) in ["x", "y"].into_iter().enumerate() {
            assert_eq!(
                run["axes"][axis]["following_error_max"], table["axes"][index]["following_error"],
                "{scenario}, {axis}"
            );
        }
    }
}
