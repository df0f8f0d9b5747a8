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
    ("D1 H0", &["H", "D"]),
    ("$110=500", &["$"]),
    ("$$", &["$"]),
    ("M201 X500 Y500 E5000", &["M201"]),
    ("M201X500E5000", &["M201"]),
    ("M67 E0 Q5", &["M67"]),
    ("/ G90", &["/"]),
    ("G61.1", &["G61.1"]),
    ("G43 H1", &["G43"]),
    ("G64 P0.02 Q0.1", &["G64"]),
    ("G10 L1 P1 R5", &["G10 tool table"]),
    ("G10 L11 P1 Z5", &["G10 tool table"]),
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
        ("G68.2 X1", "G68.2"),
        ("G7", "G7"),
        ("G95", "G95"),
        ("G76 P1", "G76"),
        ("G33 Z1 K1", "G33"),
        ("G5.2 X1", "G5.2"),
        ("G17.1", "G17.1"),
        ("G65 P9000", "G65"),
        ("G87 X1 R1 Z1", "G87"),
        ("G123", "G123"),
        ("G10 L20 P1 R45", "G10 R"),
        ("G10 L3", "G10"),
        ("G50 X1", "G50"),
        ("M206 X5", "M206"),
        ("M428", "M428"),
        ("M1234", "M1234"),
        ("G1 A5", "A"),
        ("G1 U1", "U"),
        ("G53 G2 X2 I1", "G53"),
        ("G1 X2 H1", "H"),
        ("$H", "$H"),
        ("$J=G91 X10 F100", "$J=G91 X10 F100"),
        ("$SD/Run=a.nc", "$SD/Run=a.nc"),
        ("X2 M106 S9", "X"),
        ("M207 Z1", "Z"),
        ("M240 X5", "X"),
        ("M28 a", "M28"),
        ("M121", "M121"),
        ("M402", "M402"),
        ("M524", "M524"),
        ("M99 P10", "P"),
        ("G83 X1 Z-1 R1 Q1 M67 E0", "Q"),
        ("F60 G2 X2 I1 P2 M62", "P"),
        ("F60 G81 X1 Z-1 R1 I1", "I"),
        ("F60 G81 X1 Z-1 R1 Q1", "Q"),
        ("G28 R3", "R"),
        ("G30 P3", "P"),
        ("G43.1 H1", "H"),
        ("G43.1 Z1 I2", "I"),
        ("G0 G43.1 Z1", "G43.1"),
        ("G43 G49", "G49"),
        ("G10 L11 P1 Z1\nG43 H1", "H"),
        ("G10 L10 P1 R1\nG43 H1", "H"),
        ("G10 L1 P1 Z1\nT1\nG43", "G43"),
        ("G10 L1 P1 Z1\nM6\nG43", "G43"),
        ("G10 L1 P1 Z1\nG43", "G43"),
        ("M70\nM71\nM72", "M72"),
        ("G43.1 Z2\nM70\nG49\nM72", "M72"),
        ("SET_KINEMATIC_POSITION X=0", "SET_KINEMATIC_POSITI..."),
        ("SET_SKEW XY=140", "SET_SKEW"),
        ("EXCLUDE_OBJECT NAME=a", "EXCLUDE_OBJECT"),
        ("START_PRINT BED=60", "START_PRINT"),
        ("SET_GCODE_OFFSET Z=1", "SET_GCODE_OFFSET"),
        ("Q1", "Q"),
        ("L1", "L"),
        ("F0", "F"),
    ] {
        let refused = refuse(read, &format!("G0 X1\n{line}"));
        let last = line.lines().count() + 1;
        let expected = format!("t:{last}: {field}: ");
        assert!(refused.starts_with(&expected), "{refused}");
    }
}

#[test]
fn inline_power_says_nothing_about_the_path() {
    let text = "M3 I\nG1 X5 F60 I S20\nS20 I X6\nX7 I(a)S3\nM5 I\nG0 X8 M4 I";
    let drawing = accept(read, text);
    assert_eq!(
        moves(&drawing),
        [
            "line to 5 0 0 F60",
            "line to 6 0 0 F60",
            "line to 7 0 0 F60",
            "rapid to 8 0 0"
        ]
    );
    let said = warnings(&drawing);
    assert!(
        said.contains(&"t:1: I: skipped (6 times)".to_owned()),
        "{said:?}"
    );
    assert!(read_with("t", text.as_bytes(), &strict()).is_err());
    for (line, fault) in [
        ("G1 X5 I", "I: a letter without its number"),
        ("G2 X2 I J0 S5", "I: a letter without its number"),
        (
            "G2 X2 J1 I S5",
            "I: without its number, in the line of an arc",
        ),
        (
            "G2 X2 J1 S5 I",
            "I: without its number, in the line of an arc",
        ),
        (
            "G2 X2 I1 F60\nX4 M3 I",
            "I: without its number, in the line of an arc",
        ),
        ("M3 J", "J: a letter without its number"),
        ("G1 X5 F60 M3 I I1", "I, J, R: with G1"),
    ] {
        let refused = refuse(read, line);
        assert!(refused.contains(fault), "{line}: {refused}");
    }
}

#[test]
fn axis_words_beside_m_words_move() {
    // Results of LinuxCNC's rs274; printers' words keep theirs.
    for (text, expected) in [
        (
            "G0 X1\nX5 M67 E0 Q5",
            &["rapid to 1 0 0", "rapid to 5 0 0"][..],
        ),
        ("G0 X1\nM19 R90 X5", &["rapid to 1 0 0", "rapid to 5 0 0"]),
        ("G0 X1\nX5 M50 P1", &["rapid to 1 0 0", "rapid to 5 0 0"]),
        ("G0 X1\nM92 X80 Y80", &["rapid to 1 0 0"]),
        // P1 is the one turn that an arc makes.
        ("F60 G2 X2 I1 M62 P1", &["cw about 1 0 to 2 0 0 F60"]),
        (
            "F60 G0 Z5\nG81 X1 Z-1 R2\nG80\nG81 X2 Z-1 R4 M62 P0",
            &[
                "rapid to 0 0 5",
                "rapid to 1 0 5",
                "rapid to 1 0 2",
                "line to 1 0 -1 F60",
                "rapid to 1 0 2",
                "rapid to 1 0 4",
                "rapid to 2 0 4",
                "line to 2 0 -1 F60",
                "rapid to 2 0 4",
            ],
        ),
    ] {
        assert_eq!(moves(&accept(read, text)), expected, "{text}");
    }
}

#[test]
fn an_exponent_is_read_whole_or_refused() {
    // In brackets and behind `=` no axis E can stand, nor twice in a line.
    for (text, expected) in [
        ("G0 X[1e1] Y[2.5E-1*4]", "rapid to 10 1 0"),
        ("#1=1.5e+1\nG0 X#1", "rapid to 15 0 0"),
        ("G0 X2.5e1 Y1 E0.5", "rapid to 25 1 0"),
        ("G0 X-1E-1Y2e0", "rapid to -0.1 2 0"),
        ("G0 X1 E5E-2", "rapid to 1 0 0"),
        // An axis: a blank, a comment, a decimal number, a value that no exponent has.
        ("G0 X1 Y2 E3", "rapid to 1 2 0"),
        ("G0X1Y2(a)E3", "rapid to 1 2 0"),
        ("G0X1Y2E3.5", "rapid to 1 2 0"),
        ("G0X1Y2E-.5", "rapid to 1 2 0"),
        ("G0X1Y2E[3]", "rapid to 1 2 0"),
        ("G92E0\nG0X1Y0E3", "rapid to 1 0 0"),
        ("G1E5X1", "line to 1 0 0"),
        ("#<a1 e5>=7\nG0 X#<a1e5>", "rapid to 7 0 0"),
        ("#1=1\nG0 X#1 E3", "rapid to 1 0 0"),
        ("G0 X[1 EQ 1]", "rapid to 1 0 0"),
    ] {
        assert_eq!(moves(&accept(read, text)), [expected], "{text}");
    }
    for (text, fault) in [
        (
            "G0 X-2.2e-16 Y5",
            "t:1: X: -2.2E-16: an exponent, or an axis E; allowed: X-2.2 E-16, or a number \
             without an exponent",
        ),
        ("G2 X5 I2.5 J1.2e-15", "t:1: J: 1.2E-15: an exponent"),
        ("G1 X5 F3000E-5", "t:1: F: 3000E-5: an exponent"),
        ("G1 X1E5", "t:1: X: 1E5: an exponent"),
        ("#1=5\nG1 X#1e2", "t:2: X: #1E2: an exponent"),
        ("#1=5\nG1 X[#1]E2", "t:2: X: [#1]E2: an exponent"),
        ("G0 X[1 E5]", "t:1: expression: no operator at 'E5]'"),
        ("G0 X[1e]", "t:1: expression: no operator at 'E]'"),
        ("G0 X1e", "t:1: E: a letter without its number"),
        ("#[1e0]=5\n#1e0=5", "t:2: #1: without ="),
    ] {
        let refused = refuse(read, text);
        assert!(refused.starts_with(fault), "{text}: {refused}");
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
    let feed = turn.moves.get(0).unwrap().feed_mm_per_min.unwrap();
    assert!((feed - std::f64::consts::TAU).abs() < 1e-9);
}
