//! Bad settings, pieces and moves of the arc generator: their errors.

use super::arc::{HEAD, SEAM, with};
use super::support::Bench;

#[test]
fn bad_settings_are_refused() {
    const SPEEDS: &str = "allowed: 0.00006 to 60000000000";
    const RANGE: &str = "allowed: 0.000001 to 1000000000";
    let cases = [
        ("sample_period_ms=-1", "sample_period_ms: is -1; allowed: "),
        (
            "sample_period_ms=10.05",
            "sample_period_ms: is 10.05: 100.5 ticks; allowed: whole ticks: ",
        ),
        (
            "acceleration_ms=30",
            "acceleration_ms: is 30: 3 samples; allowed: an even number of samples: 20 or 40\n",
        ),
        (
            "acceleration_ms=20000",
            "acceleration_ms: is 20000; allowed: 20 to 10240 ms: 2 to 1024 samples\n",
        ),
        (
            "counts_per_mm=0",
            &format!("counts_per_mm: is 0; {RANGE}\n"),
        ),
        (
            "feed_mm_per_min=0",
            &format!("feed_mm_per_min: is 0; {SPEEDS}\n"),
        ),
        (
            "rapid_mm_per_min=nan",
            &format!("rapid_mm_per_min: is NaN; {SPEEDS}\n"),
        ),
        ("corner_deg=181", "corner_deg: is 181; allowed: 0 to 180\n"),
        ("clock_hz=0", "clock_hz: is 0; allowed: 1 to 10000000000\n"),
        (
            "vcd_ticks=0",
            "vcd_ticks: is 0; allowed: 1 to 9223372036854775807; --no-vcd for none\n",
        ),
        (
            "rounding=up",
            "rounding: unknown variant `up`; allowed: `nearest` or `floor`\n",
        ),
        (
            "blend=cubes",
            "blend: unknown variant `cubes`; allowed: `differences` or `products`\n",
        ),
        (
            "short_pieces=no",
            "short_pieces: unknown variant `no`; allowed: `refuse` or `slower`\n",
        ),
        (
            "feed=1",
            "feed: unknown key; did you mean feed_mm_per_min?; allowed: `motion-rtl keys arc_generator` lists all",
        ),
        (
            "input=p.ngc",
            "input: given beside tables [[piece]]; allowed: a drawing or pieces, not both\n",
        ),
    ];
    let bench = with(SEAM);
    for (set, refusal) in cases {
        let before = bench.names();
        let done = bench.run(&["run", "s.toml", "--set", set, "--out", "new"]);
        assert_eq!((done.code, done.stdout.as_str()), (2, ""), "{set}");
        let start = format!("error: --set: {refusal}");
        assert!(done.stderr.starts_with(&start), "{set}: {}", done.stderr);
        assert_eq!(bench.names(), before, "{set} left something");
    }
    bench.write(
        "s.toml",
        format!("# Ts\n{HEAD}{SEAM}").replace("period_ms = 10", "period_ms = 0"),
    );
    let done = bench.run(&["run", "s.toml"]);
    let start = "error: s.toml:4: sample_period_ms: is 0; allowed: ";
    assert!(done.stderr.starts_with(start), "{}", done.stderr);
}

#[test]
fn bad_pieces_are_refused_with_their_line() {
    // The head has six lines, the seam three.
    let cases = [
        (
            String::new(),
            "s.toml: piece: missing; allowed: tables [[piece]], or an input: an HPGL drawing or a G-code program",
        ),
        (
            "input = \"l.ngc\"\nstart_mm = [1, 0, 0]\n".into(),
            "s.toml:8: start_mm: is [1.0, 0.0, 0.0] beside an input; allowed: where the drawing begins: no start_mm",
        ),
        (
            format!("input = \"l.ngc\"\n{SEAM}"),
            "s.toml:7: input: given beside tables [[piece]]; allowed: a drawing or pieces, not both",
        ),
        (
            format!("{SEAM}[[piece]]\nto_mm = [20, 0, 0]\n"),
            "s.toml:11: piece 1: to_mm: start and end are the same point; allowed: points apart",
        ),
        (
            format!("{SEAM}[[piece]]\nvia_mm = [20, 0, 0]\nto_mm = [30, 0, 0]\n"),
            "s.toml:11: piece 1: via_mm: start and via are the same point; allowed: points apart",
        ),
        (
            format!("{SEAM}[[piece]]\nto_mm = [30, 0, 0]\nfeed_mm_per_min = 3600\n"),
            "s.toml:12: piece 1: feed_mm_per_min: at 3600 mm/min the blends at its ends take more than the piece, 10 mm; allowed: at most 2857.14 mm/min, or shorter blends",
        ),
        (
            format!("{SEAM}[[piece]]\nto_mm = [30, 0, 0]\nfeed_mm_per_min = -60\n"),
            "s.toml:12: piece 1: feed_mm_per_min: is -60; allowed: 0.00006 to 60000000000",
        ),
        (
            format!("{SEAM}feed_mm_per_min = 7200\n"),
            "s.toml:10: piece 0: feed_mm_per_min: at 7200 mm/min a blend reaches 12 mm along an arc of 10 mm radius; allowed: at most 6000 mm/min, whose blends reach no farther than the radius",
        ),
        (
            "[[piece]]\nto_mm = [2000, 0, 0]\n".into(),
            "s.toml:8: piece 0: to_mm: x reaches 19980000.0 counts, which needs W = 26; allowed: -8388607 to 8388607 counts at W = 24: fewer counts per mm",
        ),
        (
            "[[piece]]\nto_mm = [200, 0, 0]\nfeed_mm_per_min = 0.006\n".into(),
            "s.toml:9: piece 0: feed_mm_per_min: takes 199999980 samples at 0.006 mm/min; allowed: at most 1048575 samples: faster, shorter, or sampled less often",
        ),
        (
            "[[piece]]\nto_mm = [200, 0]\n".into(),
            "s.toml:8: to_mm: invalid length 2; allowed: a list of three numbers, of X, Y and Z, or of four with W",
        ),
        (
            "[[piece]]\nvia = [200, 0, 0]\n".into(),
            "s.toml:8: via: unknown key; did you mean via_mm?; allowed: one of `to_mm`, `via_mm`, `spline`, `feed_mm_per_min`",
        ),
        (
            "[[piece]]\nvia_mm = [200, 0, 0]\n".into(),
            "s.toml:7: to_mm: missing, and has no default; allowed: a list of X, Y, Z, or of X, Y, Z, W",
        ),
        (
            "[[piece]]\nto_mm = [200, 0, 0]\nspline = true\n".into(),
            "s.toml:9: piece 0: spline: is a spline; allowed: a line or an arc",
        ),
        (
            "[[piece]]\nto_mm = [nan, 0, 0]\n".into(),
            "s.toml:8: piece 0: to_mm: is NaN for x; allowed: -1000000000 to 1000000000",
        ),
        (
            "[[piece]]\nto_mm = [10, 0, 0]\nvia_mm = [5, inf, 0]\n".into(),
            "s.toml:9: piece 0: via_mm: is inf for y; allowed: -1000000000 to 1000000000",
        ),
    ];
    for (text, refusal) in cases {
        let bench = with(&text);
        bench.write("l.ngc", "G1 X20 F600\n");
        bench.refuse(&["run", "s.toml", "--out", "new/deep"], refusal);
    }
    // The three points on a line.
    let bench = with(&format!(
        "{SEAM}[[piece]]\nvia_mm = [25, 0, 0]\nto_mm = [30, 0, 0]\n"
    ));
    let done = bench.run(&["run", "s.toml"]);
    let start = "error: s.toml:11: piece 1: via_mm: the point via is only ";
    let end = "allowed: a point off the line, or a line: no point via\n";
    let text = done.stderr;
    assert!(
        done.code == 2 && text.starts_with(start) && text.contains(end),
        "{text}"
    );
    // No speed of the piece, and none for all.
    let bench = Bench::with("s.toml", format!("circuit = \"arc_generator\"\n{SEAM}"));
    bench.refuse(
        &["run", "s.toml"],
        "s.toml:2: piece 0: feed_mm_per_min: missing; allowed: a speed of the piece, or one for all",
    );
    bench.write("l.ngc", "G1 X20 F600\n");
    bench.refuse(
        &[
            "run",
            "l.ngc",
            "--set",
            "circuit=arc_generator",
            "--set",
            "piece=[{to_mm=[1,2,3]}]",
        ],
        "--set: piece: given beside an input; allowed: a drawing or pieces, not both",
    );
}

#[test]
fn bad_moves_are_refused_with_their_line() {
    let cases = [
        (
            "p.ngc",
            "G1 X20 F600\nG2 X40 I10 Z5\n",
            "p.ngc:2: Z: climbs 5 mm along its axis: a helix; allowed: an arc in a plane: a rotation has no feed along its axis",
        ),
        (
            "p.ngc",
            "G1 X60 F1200\n(fast)\nG3 I-2 F2400\n",
            "p.ngc:3: F: at 2400 mm/min a blend reaches 4 mm along an arc of 2 mm radius; allowed: at most 1200 mm/min, whose blends reach no farther than the radius",
        ),
        (
            "p.ngc",
            "G1 X20 F6000\n",
            "p.ngc:1: F: at 6000 mm/min the blends at its ends take more than the piece, 20 mm; allowed: at most 5714.28 mm/min, or shorter blends",
        ),
        (
            "p.ngc",
            "\nG0 X20\nG1 X40 F600\n",
            "p.ngc:2: rapid_mm_per_min: at 12000 mm/min the blends at its ends take more than the piece, 20 mm; allowed: at most 5714.28 mm/min, or shorter blends",
        ),
        (
            "p.ngc",
            "G1 X1\n",
            "p.ngc:1: feed_mm_per_min: at 1200 mm/min the blends at its ends take more than the piece, 1 mm; allowed: at most 285.714 mm/min, or shorter blends",
        ),
        (
            "p.ngc",
            "G1 X20 F600\nG1 X2000\n",
            "p.ngc:2: x: x reaches 19990000.0 counts, which needs W = 26; allowed: -8388607 to 8388607 counts at W = 24: fewer counts per mm",
        ),
        (
            "p.ngc",
            "G1 X20 F600\nG2 X40 Y1 I3\n",
            "p.ngc:2: I, J: the radius is 3.0000 mm at the start and 17.0294 mm at the end; allowed: radii that agree to 0.0283 mm, or to 0.1 % and 2.83 mm",
        ),
        (
            "p.hpgl",
            "PU4000,0;\nPD4200,0;",
            "p.hpgl:2: feed_mm_per_min: at 1200 mm/min the blends at its ends take more than the piece, 5 mm; allowed: at most 731.707 mm/min, or shorter blends",
        ),
    ];
    for (name, text, refusal) in cases {
        let bench = with(&format!("input = \"{name}\"\n"));
        bench.write(name, text);
        let slow = ["--set", "acceleration_ms=400"];
        let more = match name {
            "p.hpgl" => &slow[..],
            _ => &[],
        };
        bench.refuse(
            &[&["run", "s.toml", "--out", "new"], more].concat(),
            refusal,
        );
    }
    let bench = Bench::with("l.hpgl", "PD400,0;");
    bench.refuse(
        &["run", "l.hpgl", "--set", "circuit=arc_generator"],
        "l.hpgl:1: F: missing; allowed: a feed, or feed_mm_per_min for all",
    );
    bench.refuse(
        &["table", "waves/weld.toml"],
        "waves/weld.toml:3: circuit: the arc generator has no table; allowed: pulse_interpolator, \
         or the command run",
    );
}
