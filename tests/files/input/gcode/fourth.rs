//! W as an axis beside X, Y and Z.

use super::super::common::{accept, moves, refuse};
use motion_rtl::input::gcode::{read, read_with};
use motion_rtl::input::{Drawing, Fault, Options};

fn with_w(_: &str, text: &[u8]) -> Result<Drawing, Fault> {
    let options = Options {
        fourth: true,
        ..Options::default()
    };
    read_with("t", text, &options)
}

#[test]
fn w_goes_with_the_moves() {
    let cases: [(&str, &[f64], &[&str]); 5] = [
        (
            "G1 X3 W4 F60\nW1\nG91 X1 W2\nG53 G0 W1\nG90 G20 W1",
            &[4.0, 1.0, 3.0, 1.0, 25.4],
            &[
                "line to 3 0 0 F60",
                "line to 3 0 0 F60",
                "line to 4 0 0 F60",
                "rapid to 4 0 0",
                "rapid to 4 0 0",
            ],
        ),
        // A turn has its part of W, and offsets are none of it.
        (
            "G10 L2 P1 X1\nG92 X0\nG3 I5 P2 W10 F60\nG28\nG1 X#5428",
            &[5.0, 10.0, 10.0],
            &[
                "ccw about 5 0 to 0 0 0 F60",
                "ccw about 5 0 to 0 0 0 F60",
                "line to 10 0 0 F60",
            ],
        ),
        // The way of all four in 1/10 min.
        ("G93 G1 X3 W4 F10", &[4.0], &["line to 3 0 0 F50"]),
        (
            "G1 W-7 F60\nX#<_w>",
            &[-7.0, -7.0],
            &["line to 0 0 0 F60", "line to -7 0 0 F60"],
        ),
        (
            "G38.2 X1 W1 F60\nG0 Y2",
            &[1.0, 1.0],
            &["line to 1 0 0 F60", "rapid to 1 2 0"],
        ),
    ];
    for (text, w, lines) in cases {
        let drawing = accept(with_w, text);
        assert_eq!(drawing.fourth, w, "{text:?}");
        assert_eq!(moves(&drawing), lines, "{text:?}");
    }
    // Lines without a move are left out, and tiny steps add up.
    let drawing = accept(with_w, "G1 X1 W2 F60\nW2\nW2.0000006\nW2.0000012\nX2");
    assert_eq!(drawing.fourth, [2.0, 2.0000012, 2.0000012]);
    assert_eq!(drawing.zero_length, 2);
    // Without the axis it may stand at 0, as ever.
    let drawing = accept(read, "G1 X1 W0 F60");
    assert!(drawing.fourth.is_empty());
    assert_eq!(drawing.warnings[0].text, "W: skipped");
}

#[test]
fn chords_of_an_arc_have_their_parts_of_w() {
    let drawing = accept(with_w, "G18 G1 X1 W1 F60\nG2 X11 I5 W9");
    let arc = &drawing.fourth[1..];
    let steps: Vec<f64> = drawing
        .fourth
        .windows(2)
        .map(|pair| pair[1] - pair[0])
        .collect();
    let step = 8.0 / arc.len() as f64;
    assert!(arc.len() > 10 && arc.last() == Some(&9.0), "{arc:?}");
    assert!(
        steps.iter().all(|own| (own - step).abs() < 1e-9),
        "{steps:?}"
    );
}

#[test]
fn w_out_of_place_is_refused() {
    let own = "allowed: X, Y and Z: W has no offsets";
    for (text, fault) in [
        ("G0 X1\nG92 X1 W1", format!("t:2: W: with G92; {own}")),
        ("G28 W0", format!("t:1: W: with G28; {own}")),
        ("G10 L2 P1 W1", format!("t:1: W: with G10; {own}")),
        (
            "G5.1 X8 Y1 I1 W1 F60",
            "t:1: W: without a word that it belongs to; allowed: W with G0 to G3 and G38".into(),
        ),
        (
            "G81 X1 Z-1 R1 W1 F60",
            "t:1: W: without a word that it belongs to; allowed: W with G0 to G3 and G38".into(),
        ),
        (
            "G1 X1 F60\nG1 W10000000",
            "t:2: G1: W would be 10000000 mm; allowed: -1000000 to 1000000 mm".into(),
        ),
        (
            "G1 X1 W1 W2 F60",
            "t:1: W: twice in one line; allowed: each of these letters once in a line".into(),
        ),
        (
            "G0 A1",
            "t:1: A: 1: an axis that no circuit has; allowed: X, Y and Z; A, B, C, U, V and W at 0"
                .into(),
        ),
    ] {
        assert_eq!(refuse(with_w, text), fault, "{text:?}");
    }
    assert_eq!(
        refuse(read, "G1 X1 F60\nG1 X2 W5"),
        "t:2: W: 5: a fourth axis; allowed: W at 0; any with axes = 4 of the trajectory controller"
    );
}
