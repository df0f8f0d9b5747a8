//! G-code: what is read, skipped and refused.

mod curves;
mod cycles;
mod flow;
mod fourth;
mod offsets;
mod rotations;
mod subroutines;
mod words;

use motion_rtl::input::gcode::read;

use super::common::{accept, moves, refuse, warnings};

#[test]
fn texts_and_their_moves() {
    let cases: &[(&str, &[&str])] = &[
        (
            "G0 X1 Y2 Z3\nG1 X4 F100",
            &["rapid to 1 2 3", "line to 4 2 3 F100"],
        ),
        // Modal: the motion, the feed and the coordinates not given.
        (
            "g1x1f60\ny2\nf90\nz3",
            &[
                "line to 1 0 0 F60",
                "line to 1 2 0 F60",
                "line to 1 2 3 F90",
            ],
        ),
        (
            "G1 F60\nG0 X1\nG1 Y1",
            &["rapid to 1 0 0", "line to 1 1 0 F60"],
        ),
        (
            "G91 G1 X1 F60\nX1 Y-1\nG90 X1",
            &[
                "line to 1 0 0 F60",
                "line to 2 -1 0 F60",
                "line to 1 -1 0 F60",
            ],
        ),
        (
            "G20 G1 X1 F10\nG21 X1",
            &["line to 25.4 0 0 F254", "line to 1 0 0 F254"],
        ),
        // Words act in the order of the modes, not of the line.
        (
            "X1 F60 G1 G91\nX1 F10 G20",
            &["line to 1 0 0 F60", "line to 26.4 0 0 F254"],
        ),
        (
            "%\nO0001\nN10 G17 G21 G90 G94 G40 G49 G80 G91.1\nN20 G0 X1 ; (\n(X9) Y2 (Z9)\nM30\n%\n",
            &["rapid to 1 0 0", "rapid to 1 2 0"],
        ),
        ("G0 X1 M2\nX5", &["rapid to 1 0 0"]),
        ("%\r\nG0 X1\r\n%\r\nX5", &["rapid to 1 0 0"]),
        ("G0 X1.23456789012", &["rapid to 1.23456789012 0 0"]),
        ("\u{feff}G0 X - 1.5", &["rapid to -1.5 0 0"]),
    ];
    for (text, expected) in cases {
        assert_eq!(moves(&accept(read, text)), *expected, "{text:?}");
    }
}

#[test]
fn arcs_and_their_centres() {
    let cases: &[(&str, &str)] = &[
        ("G2 X10 Y0 I5 F60", "cw about 5 0 to 10 0 0 F60"),
        ("G3 X5 Y5 J5 F60", "ccw about 0 5 to 5 5 0 F60"),
        ("G1 X1 Y1 F60\nG2 X2 Y2 I1", "cw about 2 1 to 2 2 0 F60"),
        ("G91 G1 X1 Y1 F60\nG2 X1 Y1 I1", "cw about 2 1 to 2 2 0 F60"),
        // Full circles, flat and helical.
        ("G3 I-5 F60", "ccw about -5 0 to 0 0 0 F60"),
        ("G3 X0 Y0 Z2 J2 F60", "ccw about 0 2 to 0 0 2 F60"),
        ("G2 X10 Z-3 I5 F60", "cw about 5 0 to 10 0 -3 F60"),
        // By the radius: minor and major, both ways round, and the half circle.
        ("G2 X6 R5 F60", "cw about 3 -4 to 6 0 0 F60"),
        ("G2 X6 R-5 F60", "cw about 3 4 to 6 0 0 F60"),
        ("G3 X6 R5 F60", "ccw about 3 4 to 6 0 0 F60"),
        ("G3 X6 R-5 F60", "ccw about 3 -4 to 6 0 0 F60"),
        ("G2 X6 R3 F60", "cw about 3 0 to 6 0 0 F60"),
        ("G2 X6 R2.996 F60", "cw about 3 0 to 6 0 0 F60"),
        ("G20 G2 X10 I5 F10", "cw about 127 0 to 254 0 0 F254"),
        ("G20 G2 X10 R5 F10", "cw about 127 0 to 254 0 0 F254"),
        // A little off the circle: the centre stays as written.
        ("G2 X10.004 I5 F60", "cw about 5 0 to 10.004 0 0 F60"),
        ("G2 X10.025 I5 F60", "cw about 5 0 to 10.025 0 0 F60"),
        (
            "G20 G2 X0.4 I0.201 F60",
            "cw about 5.1054 0 to 10.16 0 0 F1524",
        ),
        ("G2 X1000 I499.8 F60", "cw about 499.8 0 to 1000 0 0 F60"),
        (
            "G1 X-10 F60\nG2 X10 I10\nX-10 I-10",
            "cw about 0 0 to -10 0 0 F60",
        ),
    ];
    for (text, expected) in cases {
        let shown = moves(&accept(read, text));
        assert_eq!(
            shown.last().map(String::as_str),
            Some(*expected),
            "{text:?}"
        );
    }
}

#[test]
fn a_full_circle_survives_rounding() {
    // 0.1 + 0.2 is not 0.3 in binary.
    let drawing = accept(read, "F60 G91 G1 X0.1\nX0.2\nG90 G2 X0.3 Y0 I1");
    let [.., before, circle] = drawing.moves.iter().collect::<Vec<_>>()[..] else {
        panic!("{drawing:?}");
    };
    assert_ne!(before.to[0], 0.3);
    assert_eq!(circle.to, before.to);
}

#[test]
fn zero_length_moves_are_counted_apart() {
    let drawing = accept(read, "G0 X0\nG1 X1 F60\nX1 Y0\nG91 Z0\nG2 I1");
    assert_eq!(
        moves(&drawing),
        ["line to 1 0 0 F60", "cw about 2 0 to 1 0 0 F60"]
    );
    assert_eq!(drawing.zero_length, 3);
}

#[test]
fn moves_carry_their_lines() {
    let drawing = accept(read, "%\r\n\r\n(a)\r\nG0 X1\r\nG4 P1\r\nX2\r\n");
    let lines: Vec<usize> = drawing.moves.iter().map(|step| step.line).collect();
    assert_eq!(lines, [4, 6]);
}

#[test]
fn what_is_skipped_or_assumed_is_said_once() {
    let cases: &[(&str, &[&str])] = &[
        (
            "T1 M6\nS900 M3\nG0 X1\nM5 S0",
            &[
                "t:1: M6: skipped",
                "t:1: T: skipped",
                "t:2: M3: skipped",
                "t:2: S: skipped (2 times)",
                "t:4: M5: skipped",
            ],
        ),
        (
            "G54 M8\nG64 G0 X1\nM9 M7\nM4",
            &[
                "t:1: M8: skipped",
                "t:2: G64: skipped",
                "t:3: M9: skipped",
                "t:3: M7: skipped",
                "t:4: M4: skipped",
            ],
        ),
        (
            "O7\nG0 X1\nG4 P0.5\nG4 P1",
            &["t:1: O: skipped", "t:3: G4: no dwell is made (2 times)"],
        ),
        (
            "G0 X2\n\nG1 X1\nX2",
            &["t:3: no feed set; the feed of the settings applies (2 times)"],
        ),
        (
            "G0 X1\nM30\n%\n\nG0 X5\nX6",
            &["t:5: text after the end of the program is not read"],
        ),
        ("G0 X1\nM30\n%\n", &[]),
        ("G0 X1\nG80", &[]),
    ];
    for (text, expected) in cases {
        assert_eq!(warnings(&accept(read, text)), *expected, "{text:?}");
    }
}

#[test]
fn comments_hold_any_bytes_and_words_do_not() {
    let drawing = read("t", b"(\xf6)G0 X1 ;\xfc").unwrap();
    assert_eq!(moves(&drawing), ["rapid to 1 0 0"]);
    assert_eq!(
        read("t", b"G0 X1\n\xf6").unwrap_err().to_string(),
        "t:2: line: characters that are not UTF-8; allowed: ASCII letters, digits and signs, in lines that end in LF, CR or CR LF"
    );
}

#[test]
fn malformed_texts_and_their_faults() {
    const ONE: &str = "in one line; allowed: one of them in a line";
    const FORMS: &str = "allowed: either I and J (the centre from the start) or R (the radius)";
    const WORDS: &str = "allowed: words of a letter and a number, such as X10.5";
    const RADII: &str = "allowed: radii that agree to 0.0283 mm, or to 0.1 % and 2.83 mm";
    const SPAN: &str = "allowed: half the distance to the end, or more";
    const PLACE: &str = "a letter without its number, or out of place";
    const REACH: &str = "allowed: -1000000 to 1000000 mm";
    let none = "t: file: no move in it; allowed: a G-code program with at least one move";
    let cases: &[(&str, &str)] = &[
        ("", none),
        ("%\nG90 F100\nM30\n", none),
        ("G0 X0", none),
        ("G0 G1 X1", &format!("t:1: G1: together with G0 {ONE}")),
        ("G90 G91", &format!("t:1: G91: together with G90 {ONE}")),
        ("G20 G21", &format!("t:1: G21: together with G20 {ONE}")),
        (
            "X1",
            "t:1: X, Y, Z: no G0, G1, G2 or G3 in force; allowed: G0 G1 G2 G3",
        ),
        (
            "G0 X1\nG80\nX2",
            "t:3: X, Y, Z: no G0, G1, G2 or G3 in force; allowed: G0 G1 G2 G3",
        ),
        ("G1 X1 F0", "t:1: F: a feed of 0; allowed: a feed above 0"),
        ("G1 X1 F-5", "t:1: F: a feed of -5; allowed: a feed above 0"),
        (
            "G2 X5",
            &format!("t:1: I, J, R: an arc without centre or radius; {FORMS}"),
        ),
        (
            "G2",
            &format!("t:1: I, J, R: an arc without centre or radius; {FORMS}"),
        ),
        (
            "G2 I1\nZ5",
            &format!("t:2: I, J, R: an arc without centre or radius; {FORMS}"),
        ),
        (
            "G2 X5 I1 R5",
            &format!("t:1: I, J, R: a centre and a radius; {FORMS}"),
        ),
        (
            "G1 X5 I1",
            "t:1: I, J, R: with G1; allowed: I, J and R with G2 and G3 only",
        ),
        (
            "G2 X10 I4",
            &format!(
                "t:1: I, J: the radius is 4.0000 mm at the start and 6.0000 mm at the end; {RADII}"
            ),
        ),
        (
            "G2 X10.03 I5",
            &format!(
                "t:1: I, J: the radius is 5.0000 mm at the start and 5.0300 mm at the end; {RADII}"
            ),
        ),
        (
            "G2 X10 I0",
            &format!("t:1: I, J: a radius of zero; {RADII}"),
        ),
        (
            "G2 X10 R4",
            &format!("t:1: R: a radius of 4.0000 mm does not span 10.0000 mm; {SPAN}"),
        ),
        (
            "G0 X1\nG3 X1 R4",
            &format!("t:2: R: an arc by its radius that ends where it starts; {SPAN}"),
        ),
        (
            "G3 R4",
            &format!("t:1: R: an arc by its radius that ends where it starts; {SPAN}"),
        ),
        (
            "G0 A1",
            "t:1: A: 1: an axis that no circuit has; allowed: X, Y and Z; A, B, C, U, V and W at 0",
        ),
        (
            "G2 X10 I5 K1",
            "t:1: I, J, K: a centre outside of the plane; allowed: the centre in the plane in force",
        ),
        (
            "G0 X1\nM98 P1",
            "t:2: M98: calls program O1, which is not in this file; allowed: subroutines of the file itself, and of files in the directories of --subroutines",
        ),
        (
            "G0 X1 P1",
            "t:1: P: without a word that it belongs to; allowed: P with G2 to G5, G10, cycles and M words",
        ),
        (
            "G0\nG4 Y1",
            "t:2: G4: a dwell and a move in one line; allowed: G4 with P, or with X alone",
        ),
        (
            "G0 X1 X2",
            "t:1: X: twice in one line; allowed: each of these letters once in a line",
        ),
        ("G0 X", &format!("t:1: X: {PLACE}; {WORDS}")),
        ("G0 X1(a)2", &format!("t:1: 2: not a word; {WORDS}")),
        (
            "G0 X1 %",
            "t:1: %: not alone in its line; allowed: % on a line of its own",
        ),
        (
            "G0 X1 (a\nX2)",
            "t:1: comment: no closing ); allowed: comments closed in their line",
        ),
        (
            "G0.55 X5",
            "t:1: G: 0.55 is not the number of a code; allowed: a whole number, or one with one decimal",
        ),
        (
            "G0 X1000001",
            &format!("t:1: G0: X would be 1000001 mm; {REACH}"),
        ),
        (
            "G20 G0 Z-40000",
            &format!("t:1: G0: Z would be -1016000 mm; {REACH}"),
        ),
        (
            "G2 I2000000",
            &format!("t:1: G2: the centre's X would be 2000000 mm; {REACH}"),
        ),
        (
            "G0 X9999999999",
            "t:1: X: 9999999999 is out of range; allowed: -1000000000 to 1000000000",
        ),
    ];
    for (text, expected) in cases {
        assert_eq!(refuse(read, text), *expected, "{text:?}");
    }
}

#[test]
fn a_number_of_any_length_is_no_danger() {
    let long = "9".repeat(500);
    for letter in ["X", "G", "N", "#", "O"] {
        let refused = refuse(read, &format!("G0 X1\n{letter}{long}\nX"));
        assert!(refused.len() < 200, "{refused}");
    }
}
