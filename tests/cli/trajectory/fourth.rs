//! A fourth axis, W: taught and in a part program.

use super::*;

/// Four axes need 404 ticks a period.
const FOUR: &str = "circuit = \"trajectory_controller\"\naxes = 4\nclock_hz = 404_000\nperiod_ms = 1\n\
     counts_per_mm = 1000\nfeed_mm_per_min = 3000\n";

fn four(text: &str) -> Bench {
    Bench::with("s.toml", format!("{FOUR}{text}"))
}

/// A line in X and W, half a circle, W alone, a line in space.
const PIECES: &str = "[[piece]]\nto_mm = [3, 0, 0, 4]\n\
     [[piece]]\nvia_mm = [8, 5, 0]\nto_mm = [3, 10, 0, 6]\n\
     [[piece]]\nto_mm = [3, 10, 0, 9]\n\
     [[piece]]\nto_mm = [0, 4, 2, 2]\n";

#[test]
#[ignore = "takes long"]
fn w_is_an_axis_as_the_others() {
    let bench = four(PIECES);
    let summary = bench.json(&["run", "--beside", "s.toml", "--out", "o", "--to", "9000"]);
    assert_eq!(summary["complaints"], json!([]));
    assert_eq!(whole(&summary, "/axes"), 4);
    assert_eq!(whole(&summary, "/period_ticks"), 404);
    assert_eq!(whole(&summary, "/period_ticks_needed"), 404);
    let ways = [
        5.0,
        (TAU / 2.0 * 5.0).hypot(2.0),
        3.0,
        (9.0f64 + 36.0 + 4.0 + 49.0).sqrt(),
    ];
    near(number(&summary, "/path/length_mm"), ways.iter().sum(), 1e-5);
    for (segment, way) in list(&summary, "segments").iter().zip(ways) {
        near(number(segment, "/length_mm"), way, 1e-5);
    }
    for row in list(&summary, "corrections") {
        let axes = list(row, "axes");
        assert_eq!(axes[3]["axis"], "w");
        for (axis, end) in axes.iter().zip([0, 4000, 2000, 2000]) {
            assert!((whole(axis, "/end_position") - end).abs() <= 2, "{axis}");
        }
        assert!(number(row, "/load/end_um") < 4.0, "{row}");
    }
    let rms = |correction| number(of(&summary, correction), "/model/contour_rms_um");
    assert!(rms("vector") < 0.7 * rms("none"), "{}", rms("vector"));
    let wave = bench.read("o/s.vcd");
    assert!(wave.contains("$scope module w $end") && wave.contains(" torque_w "));
    let svg = bench.read("o/s.svg");
    assert!(svg.contains("path from above"), "from above");
    let text = bench.succeed(&["run", "--beside", "s.toml", "--no-vcd"]);
    assert!(text.contains("(vector, nearest): 4 axes, "), "{text}");

    // The same as a part program: figures are the same.
    let same = four("input = \"p.ngc\"\n");
    same.write(
        "p.ngc",
        "G17 G21 G90\nG1 X3 W4 F3000\nG3 X3 Y10 J5 W6\nG1 W9\nX0 Y4 Z2 W2\n",
    );
    let program = same.json(&["run", "--beside", "s.toml", "--no-vcd"]);
    assert_eq!(program["corrections"], summary["corrections"]);
    assert_eq!(program["plan"]["seconds"], summary["plan"]["seconds"]);
}

/// What W is late by across the others is a contour error: with its own gains it leaves a line.
#[test]
#[ignore = "takes long"]
fn contour_errors_have_w_in_them() {
    let bench = four("start_mm = [1, 0, 0, -4]\n[[piece]]\nto_mm = [1, 24, 0, 14]\n");
    let summary = bench.json(&[
        "run",
        "--beside",
        "s.toml",
        "--no-vcd",
        "--set",
        "k1_per_s=[50,50,50,40]",
    ]);
    let exact = 50.0 * 0.48 * (1.0 / 40.0 - 1.0 / 50.0) * 1e3;
    close(
        number(of(&summary, "none"), "/model/contour_max_um"),
        exact,
        0.01,
    );
    let turned = "load_torque=[{axis=\"w\",torque_nm=0.5,from_s=0.3}]";
    let pushed = bench.json(&["run", "--beside", "s.toml", "--no-vcd", "--set", turned]);
    let off = |summary: &Value, axis: usize| {
        number(of(summary, "none"), &format!("/axes/{axis}/off_model_um"))
    };
    assert!(
        off(&pushed, 3) > 30.0 && off(&pushed, 1) < 12.0,
        "{}",
        off(&pushed, 3)
    );
    // Its own acceleration, as 18 of 30 mm.
    let set = "axis_acceleration_mm_per_s2=[1e5,1e5,1e5,300]";
    let slow = bench.json(&["run", "--beside", "s.toml", "--no-vcd", "--set", set]);
    close(number(&slow, "/plan/acceleration_mm_per_s2"), 500.0, 1e-6);
}

#[test]
fn w_at_fault_is_refused_with_its_line() {
    let list = "is a list of 3; allowed: four numbers, of X, Y, Z and W";
    for (text, refusal) in [
        (
            "[[piece]]\nto_mm = [3, 0, 0, 4]\n[[piece]]\nto_mm = [3, 1, 0]\n",
            format!("s.toml:10: piece 1: to_mm: {list}"),
        ),
        (
            "start_mm = [1, 2, 3]\n[[piece]]\nto_mm = [3, 0, 0, 4]\n",
            format!("s.toml:7: start_mm: {list}"),
        ),
        (
            "[[piece]]\nto_mm = [3, 0, 0, 4, 5]\n",
            "s.toml:8: to_mm: invalid length 5; allowed: a list of three numbers, of X, Y and Z, \
             or of four with W"
                .to_owned(),
        ),
        (
            "[[piece]]\nto_mm = [3, 0, 0, nan]\n",
            "s.toml:8: piece 0: to_mm: is NaN for w; allowed: -1000000000 to 1000000000".to_owned(),
        ),
        (
            "[[piece]]\nspline = true\nto_mm = [3, 0, 0, 1]\n",
            "s.toml:8: piece 0: spline: is a spline along which W moves; allowed: a line or an \
             arc, or W at rest"
                .to_owned(),
        ),
        (
            "k1_per_s = [50, 50, 50]\n[[piece]]\nto_mm = [3, 0, 0, 4]\n",
            "s.toml:7: k1_per_s: is a list of 3; allowed: a number for all axes, or a list of 4"
                .to_owned(),
        ),
        (
            "start_mm = [0, 0, 0, 1]\ninput = \"p.ngc\"\n",
            "s.toml:7: start_mm: has W beside an input; allowed: where the drawing begins: no \
             start_mm"
                .to_owned(),
        ),
    ] {
        let bench = four(text);
        bench.write("p.ngc", "G1 X3 W4 F600\n");
        bench.refuse(&["run", "--beside", "s.toml", "--no-vcd"], &refusal);
    }
    let bench = four("[[piece]]\nto_mm = [3, 0, 0, 4]\n");
    let set = |set| ["run", "--beside", "s.toml", "--no-vcd", "--set", set];
    bench.refuse(
        &set("clock_hz=400000"),
        "s.toml:4: period_ms: is 1: 400 ticks; allowed: 404 ticks or more for 4 axes",
    );
    bench.refuse(
        &set("axes=3"),
        "s.toml:8: piece 0: to_mm: is a list of 4; allowed: three numbers, of X, Y and Z; four \
         where there are four axes",
    );
    // A program for three axes.
    let bench = with("input = \"p.ngc\"\n");
    bench.write("p.ngc", "G1 X3 F600\nX4 W5\n");
    bench.refuse(
        &["run", "--beside", "s.toml", "--no-vcd"],
        "p.ngc:2: W: 5: a fourth axis; allowed: W at 0; any with axes = 4 of the trajectory \
         controller",
    );
    // The arc generator has none either.
    let arc =
        "circuit = \"arc_generator\"\nfeed_mm_per_min = 3000\n[[piece]]\nto_mm = [3, 0, 0, 4]\n";
    Bench::with("a.toml", arc).refuse(
        &["run", "a.toml", "--no-vcd"],
        "a.toml:4: piece 0: to_mm: is a list of 4; allowed: three numbers, of X, Y and Z; four where there are four axes",
    );
}
