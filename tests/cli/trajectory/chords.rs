//! Curves as short chords, which have no radius: a cam in the plane, a face in space.

use super::*;

/// The cam as its own header has it.
fn cam() -> String {
    let rise = |u: f64| u - (TAU * u).sin() / TAU;
    let s = |t: f64| match t {
        t if t < 60.0 => 0.0,
        t if t < 180.0 => rise((t - 60.0) / 120.0),
        t if t < 240.0 => 1.0,
        t => 1.0 - rise((t - 240.0) / 120.0),
    };
    let mut text = String::new();
    for k in 1..=3600 {
        let t = f64::from(k) / 10.0;
        let (sin, cos) = t.to_radians().sin_cos();
        let r = 20.0 + 6.0 * s(t);
        let point = format!("X{:.4} Y{:.4}\n", r * cos, r * sin);
        text.push_str(&point.replace("-0.0000", "0.0000"));
    }
    text
}

#[test]
#[ignore = "takes long"]
fn the_cam_is_its_formula_and_is_run_at_feed() {
    let program = Path::new(env!("CARGO_MANIFEST_DIR")).join("waves/cam.ngc");
    let program = fs::read_to_string(program).unwrap();
    let begin = program.find("X20.0000").unwrap();
    let end = program.find("X20 Y5").unwrap();
    assert!(program[begin..end] == cam(), "the points of the cam");

    let bench = Bench::new();
    let summary = bench.json(&["run", "waves/cam.toml", "--no-vcd"]);
    assert_eq!(summary["complaints"], json!([]));
    let segments = list(&summary, "segments");
    assert_eq!(segments.len(), 1 + 1 + 3600 + 1);
    // Every chord at feed, from its start to its end.
    for chord in &segments[2..3602] {
        near(number(chord, "/entry_mm_per_s"), 100.0, 1e-6);
        near(number(chord, "/speed_mm_per_s"), 100.0, 1e-6);
    }
    near(
        number(&summary, "/plan/slowest_joint/speed_mm_per_s"),
        100.0,
        1e-6,
    );
    assert_eq!(segments[0]["kind"], "rapid");
    // A tick for each of 13 words a segment.
    assert!(whole(&summary, "/loading_ticks") >= 3603 * 13);
    let rms = |correction: &str| number(of(&summary, correction), "/load/contour_rms_um");
    assert!(rms("vector") < rms("none") / 4.0);
    // Chords have no radius.
    assert_eq!(rms("steady"), rms("none"));
}

/// A spiral of chords on a saddle, which no radius is known of.
#[test]
#[ignore = "takes long"]
fn a_face_in_space_is_corrected_chord_by_chord() {
    let summary = Bench::new().json(&["run", "waves/face.toml", "--no-vcd"]);
    assert_eq!(summary["complaints"], json!([]));
    assert_eq!(whole(&summary, "/axes"), 3);
    let segments = list(&summary, "segments");
    let chords = &segments[3..segments.len() - 3];
    // 14 mm to 6 mm, 2 mm a turn, a hair nearer with each chord.
    let (mut radius, mut angle, mut from) = (14.0, 0.0f64, [14.0, 0.0, 4.9]);
    for chord in chords {
        assert_eq!(chord["kind"], "line");
        assert!(radius > 6.0);
        let slope = radius / 20.0 * (2.0 * angle).sin();
        let step = 0.1 / slope.hypot(1.0) / radius;
        angle += step;
        radius -= 2.0 * step / TAU;
        let [x, y] = [radius * angle.cos(), radius * angle.sin()];
        let to = [x, y, (x * x - y * y) / 40.0];
        let way = [0, 1, 2].map(|k| to[k] - from[k]);
        let length = way.iter().fold(0.0, |sum: f64, way| sum.hypot(*way));
        near(number(chord, "/length_mm"), length, 1e-5);
        from = to;
    }
    assert!(radius <= 6.0);
    // At feed but at its ends.
    for chord in &chords[200..chords.len() - 200] {
        near(number(chord, "/entry_mm_per_s"), 80.0, 1e-6);
        near(number(chord, "/speed_mm_per_s"), 80.0, 1e-6);
        // v²/r of K1 and K2 on some radius of curvature between 6 and 14 mm, whatever the plane.
        let um = |k: usize| number(chord, &format!("/contour_um/{k}"));
        assert!(
            um(0) > 20.0 && um(3) < 15.0 && um(3) < um(0) / 2.0,
            "{chord}"
        );
        assert_eq!(um(0), um(1));
    }
    let rms = |correction: &str| number(of(&summary, correction), "/load/contour_rms_um");
    assert!(rms("vector") < rms("none") / 4.0);
    assert_eq!(rms("steady"), rms("none"));
}
