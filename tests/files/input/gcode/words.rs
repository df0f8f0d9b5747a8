//! Words that say nothing about the path, and those that are refused.

use motion_rtl::input::Options;
use motion_rtl::input::gcode::{read, read_with};

use crate::input::common::{accept, moves, refuse, warnings};

fn strict() -> Options {
    Options {
        strict: true,
        ..Options::default()
    }
}

/// Lines that a printer, a mill or a host sends, and the words they are skipped for.
const NOTHING: &[(&str, &[&str])] = &[
    ("M104 S200", &["M104"]),
    ("M73 P10 R3", &["M73"]),
    ("M106 P1 S255", &["M106"]),
    ("M107", &["M107"]),
    ("M140 S60", &["M140"]),
    ("M190 S60", &["M190"]),
    ("M300 S440 P200", &["M300"]),
    ("M201 X500 Y500", &["M201"]),
    ("M117 G0 X9 (half", &["M117"]),
    ("m486 Acube(1).stl", &["M486"]),
    ("M862.3 P \"MK3S\"", &["M862"]),
    ("M84 X Y E", &["M84"]),
    ("M60", &["M60"]),
    ("G1 E5", &["E"]),
    ("G92 E0", &["E"]),
    ("G1 A0 C0", &["A", "C"]),
    ("D1 H2", &["H", "D"]),
    ("$H", &["$"]),
    ("/ G90", &["/"]),
    ("G61.1", &["G61.1"]),
    ("G43 H1", &["G43"]),
    ("G43.1 Z5", &["G43.1"]),
    ("G64 P0.02 Q0.1", &["G64"]),
    ("G10 L1 P1 Z5", &["G10 tool table"]),
    ("G10", &["G10"]),
    ("G11", &["G11"]),
    ("G29", &["G29"]),
    ("G97 S1000", &["G97"]),
    ("M115 U6.2.4+8909", &["M115"]),
    ("EXCLUDE_OBJECT_START NAME=a", &["EXCLUDE_OBJECT_START"]),
];

#[test]
fn what_says_nothing_is_skipped_once_and_strictly_refused() {
    for (line, words) in NOTHING {
        let drawing = accept(read, &format!("G1 X1 F60\n{line}\n{line}\nX2"));
        assert_eq!(
            moves(&drawing),
            ["line to 1 0 0 F60", "line to 2 0 0 F60"],
            "{line}"
        );
        let shown = warnings(&drawing);
        for word in *words {
            let expected = match *word {
                "G43" => "t:2: tool lengths are taken for 0 (2 times)".to_owned(),
                word => format!("t:2: {word}: skipped (2 times)"),
            };
            assert!(shown.contains(&expected), "{line}: {shown:?}");
        }
        let fault = read_with("t", format!("G1 X1 F60\n{line}").as_bytes(), &strict());
        assert_eq!(fault.unwrap_err().line, 2, "{line}");
    }
    let same = b"T1 M6\nS900 M3 M8\nG54 G64 G49 G40 G1 X1 F60\nG4 P1\nM9 M5 M2";
    assert_eq!(read_with("t", same, &strict()), read("t", same));
}

#[test]
fn what_may_change_the_path_is_refused() {
    for (line, field) in [
        ("G41 D1", "G41"),
        ("G42", "G42"),
        ("G51 X2", "G51"),
        ("G68 R45", "G68"),
        ("G16", "G16"),
        ("G7", "G7"),
        ("G95", "G95"),
        ("G76 P1", "G76"),
        ("G33 Z1 K1", "G33"),
        ("G5.2 X1", "G5.2"),
        ("G17.1", "G17.1"),
        ("G65 P9000", "G65"),
        ("G87 X1 R1 Z1", "G87"),
        ("G123", "G123"),
        ("G10 L2 P1 R45", "G10 R"),
        ("G10 L3", "G10"),
        ("G50 X1", "G50"),
        ("M206 X5", "M206"),
        ("M428", "M428"),
        ("M1234", "M1234"),
        ("G1 A5", "A"),
        ("G1 U1", "U"),
        ("G53 G2 X2 I1", "G53"),
        ("START_PRINT BED=60", "START_PRINT"),
        ("SET_GCODE_OFFSET Z=1", "SET_GCODE_OFFSET"),
        ("Q1", "Q"),
        ("L1", "L"),
        ("F0", "F"),
    ] {
        let refused = refuse(read, &format!("G0 X1\n{line}"));
        assert!(refused.starts_with(&format!("t:2: {field}: ")), "{refused}");
    }
}

#[test]
fn lines_and_numbers_in_all_their_forms() {
    for text in [
        "G00 X1\nG01.X2F60",
        "g0.0x1\rG1 X2 F60\r",
        "G0 X1\r\r\nG1 X2 F60\r\r\n\0\0\x1a",
        "\u{feff}%\nO12\nN1.5 G 0 X 1 . 0\nN 2 G1 X+2. F6 0\n%",
        "G0 X1 (a (nested) b)\nG1 X2 F60 *57",
        "G0\0X1\n:7\nG1 X2 F60",
        "G0 X1\nG4 X9\nG4 P1 G1 X2 F60",
        "G91.1 G0 G80 G0 X1\nG80 G1 X2 F60",
    ] {
        let drawing = accept(read, text);
        assert_eq!(
            moves(&drawing),
            ["rapid to 1 0 0", "line to 2 0 0 F60"],
            "{text:?}"
        );
    }
}

#[test]
fn a_feed_by_inverse_time_is_that_of_the_length() {
    let drawing = accept(read, "G93 G1 X3 Y4 F2\nX0 Y0 F3\nG94 X1 F90");
    assert_eq!(
        moves(&drawing),
        [
            "line to 3 4 0 F10",
            "line to 0 0 0 F15",
            "line to 1 0 0 F90"
        ]
    );
    assert!(refuse(read, "G93 G1 X1 F1\nX2").starts_with("t:2: F: missing under G93"));
    let turn = accept(read, "G93 G2 I1 F1");
    let feed = turn.moves[0].feed_mm_per_min.unwrap();
    assert!((feed - std::f64::consts::TAU).abs() < 1e-9);
}
