//! Splines and helices.

use super::*;

#[test]
#[ignore = "takes long"]
fn splines_of_a_program_are_run_as_curves() {
    // A circle of 10 mm in four parts, entered and left in its tangent; the fourth part leaves out
    // what goes on from the third.
    let program = "G17 G21 G90\nG1 Y10 F6000\nG5 X-10 Y20 I0 J5.5228475 P5.5228475 Q0\n\
         G5 X-20 Y10 I-5.5228475 J0 P0 Q5.5228475\nX-10 Y0 P-5.5228475 Q0\nX0 Y10 P0 Q-5.5228475\n\
         G1 Y20\nM2\n";
    let bench = with("input = \"l.ngc\"\nacceleration_mm_per_s2 = 2000\ncorner_mm_per_min = 60\n");
    bench.write("l.ngc", program);
    let summary = bench.json(&["run", "--beside", "s.toml", "--out", "o"]);
    assert_eq!(summary["complaints"], json!([]));
    assert_eq!(summary["warnings"], json!([]));
    assert_eq!(summary["plan"]["stops"], 0);
    let segments = list(&summary, "segments");
    // As many a quarter as its curvature asks for, of the quarter's line each.
    for line in 3..=6 {
        let own = segments.iter().filter(|row| row["line"] == line);
        let own: Vec<_> = own.collect();
        assert_eq!(own.len(), 18, "{line}");
        for row in own {
            assert_eq!(row["kind"], "spline");
            near(number(row, "/radius_mm"), 10.0, 0.2);
            near(number(row, "/speed_mm_per_s"), 100.0, 0.01);
        }
    }
    near(number(&summary, "/path/length_mm"), 20.0 + 10.0 * TAU, 0.02);
    // The errors are those of the circle, as its closed forms say but for the periods of 1 ms.
    let [none, _] = closed_forms(10.0, 100.0, [50.0, 200.0]);
    let model = |correction: &str, key: &str| {
        number(
            of(&summary, correction),
            &format!("/model/contour_{key}_um"),
        )
    };
    close(model("none", "max"), none, 0.15);
    assert!(model("vector", "max") < none / 2.0);
    assert!(model("vector", "rms") < model("none", "rms") / 5.0);
    // The prior art knows the radius of a spline too, and not of the speed at its ends.
    assert!(model("steady", "rms") < model("none", "rms") / 2.0);
    assert!(bench.read("o/s.svg").contains("ideal"));
}

/// The figures of the note.
#[test]
#[ignore = "takes long"]
fn the_saddle_has_the_prior_arts_radius_at_every_point() {
    let summary = Bench::new().json(&["run", "waves/saddle.toml", "--no-vcd"]);
    for (correction, max, rms) in [
        ("none", 54.116, 43.192),
        ("steady", 53.600, 15.082),
        ("vector", 16.785, 4.516),
    ] {
        let model = |key: &str| {
            number(
                of(&summary, correction),
                &format!("/model/contour_{key}_um"),
            )
        };
        near(model("max"), max, 1e-3);
        near(model("rms"), rms, 1e-3);
    }
    // At its end, by c·v²/ρ.
    near(
        number(of(&summary, "steady"), "/model/end_um"),
        53.600,
        1e-3,
    );
}

#[test]
#[ignore = "takes long"]
fn taught_points_are_joined_by_one_curve_in_space() {
    // A closed loop that rises and falls, with a line to it.
    let mut text = String::from("[[piece]]\nto_mm = [20, 0, 5]\n");
    for k in 1..=12 {
        let (sin, cos) = (TAU * f64::from(k) / 12.0).sin_cos();
        let to = [
            20.0 * cos,
            20.0 * sin,
            5.0 * (2.0 * TAU * f64::from(k) / 12.0).cos(),
        ];
        let to = to.map(|mm| (mm * 1e3).round() / 1e3);
        text.push_str(&format!("[[piece]]\nto_mm = {to:?}\nspline = true\n"));
    }
    let bench = with(&format!("start_mm = [20, -10, 5]\n{text}"));
    let summary = bench.json(&["run", "--beside", "s.toml", "--no-vcd"]);
    assert_eq!(summary["complaints"], json!([]));
    assert_eq!(summary["axes"], 3);
    let segments = list(&summary, "segments");
    let of_piece = |piece: usize| segments.iter().filter(move |row| row["piece"] == piece);
    assert!(of_piece(0).all(|row| row["kind"] == "line"));
    for piece in 1..=12 {
        assert!(of_piece(piece).count() > 2, "{piece}");
        assert!(
            of_piece(piece).all(|row| row["kind"] == "spline"),
            "{piece}"
        );
    }
    // Where points are it does not slow down, nor where the line meets it.
    for row in &segments[1..] {
        let entry = number(row, "/entry_limit_mm_per_s");
        near(entry, number(row, "/speed_limit_mm_per_s"), 2.0);
    }
    let rms = |correction: &str| number(of(&summary, correction), "/model/contour_rms_um");
    assert!(
        rms("vector") < rms("none") / 3.0,
        "{} {}",
        rms("vector"),
        rms("none")
    );
    // The prior art ends beside the path, by c·v²/ρ there.
    let steady = number(of(&summary, "steady"), "/model/end_um");
    near(steady, 18.056, 0.01);
    let others = list(&summary, "corrections").iter();
    for row in others.filter(|row| row["correction"] != "steady") {
        for (axis, end) in [0, 10_000, 0].into_iter().enumerate() {
            let seen = whole(row, &format!("/axes/{axis}/end_position"));
            assert!((seen - end).abs() <= 2, "{row}");
        }
        assert!(number(row, "/model/end_um") < 1.0, "{row}");
    }
}

#[test]
#[ignore = "takes long"]
fn a_helix_is_a_segment_a_turn() {
    let program = "G17 G21 G90\nG1 X20 F6000\nG3 X20 Z4 I0 J10 P2\nG1 X40\nM2\n";
    let bench = with("input = \"l.ngc\"\n");
    bench.write("l.ngc", program);
    let summary = bench.json(&["run", "--beside", "s.toml", "--no-vcd"]);
    assert_eq!(
        (&summary["complaints"], &summary["axes"]),
        (&json!([]), &json!(3))
    );
    let segments = list(&summary, "segments");
    let turns: Vec<_> = segments.iter().filter(|row| row["line"] == 3).collect();
    assert_eq!(turns.len(), 2);
    for turn in turns {
        assert_eq!(turn["kind"], "helix");
        near(
            number(turn, "/length_mm"),
            (20.0 * TAU / 2.0).hypot(2.0),
            1e-6,
        );
        // (r² + h²)/r, h being what it climbs a radian.
        let climb = 2.0 / TAU;
        near(
            number(turn, "/radius_mm"),
            10.0 + climb * climb / 10.0,
            1e-9,
        );
    }
    // Around it is a circle, along its axis a line.
    let [none, _] = closed_forms(10.0, 100.0, [50.0, 200.0]);
    let model = |correction: &str| number(of(&summary, correction), "/model/contour_rms_um");
    close(model("none"), none, 0.3);
    assert!(model("vector") < none / 5.0, "{}", model("vector"));
    for row in list(&summary, "corrections") {
        assert_eq!(row["circle"], Value::Null);
        for (axis, end) in [40_000, 0, 4_000].into_iter().enumerate() {
            let seen = whole(row, &format!("/axes/{axis}/end_position"));
            assert!((seen - end).abs() <= 2, "{row}");
        }
    }
}
