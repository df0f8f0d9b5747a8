//! Lines, and what stands between them.

use motion_rtl::input::hpgl::read;

use super::path;
use crate::input::common::{accept, moves};

#[test]
fn texts_and_their_moves() {
    let cases: &[(&str, &[&str])] = &[
        ("PU40,80;PD80,80;", &["rapid to 1 2 0", "line to 2 2 0"]),
        ("pu40,80pd80 80", &["rapid to 1 2 0", "line to 2 2 0"]),
        (
            "IN;SP1;PD;PA10,0,10,-10;PU",
            &["line to 0.25 0 0", "line to 0.25 -0.25 0"],
        ),
        (
            "PD 40 , 80\r\n120\t+80-40+.5;",
            &["line to 1 2 0", "line to 3 2 0", "line to -1 0.0125 0"],
        ),
        (
            "PR40,0,0,40;PD40,40;PA;PD0,0",
            &[
                "rapid to 1 0 0",
                "rapid to 1 1 0",
                "line to 2 2 0",
                "line to 0 0 0",
            ],
        ),
        ("PD40,0;IN;PA80,0", &["line to 1 0 0", "rapid to 2 0 0"]),
        ("PD;PR40,0;DF;PD40,40", &["line to 1 0 0", "line to 1 1 0"]),
        ("PD1.25,2.;", &["line to 0.03125 0.05 0"]),
        (
            "\x1b%-12345X@PJL ENTER LANGUAGE=HPGL2\n\x1b%0BPD40,0;\x1b%0A\x1bE",
            &["line to 1 0 0"],
        ),
        (
            "\x1b.(PD40,0\x1b.I81;;17:PD0,0\x1b.@;0:PU40,40\x1b.Z",
            &["line to 1 0 0", "line to 0 0 0", "rapid to 1 1 0"],
        ),
    ];
    for (text, expected) in cases {
        assert_eq!(moves(&accept(read, text)), *expected, "{text:?}");
    }
}

#[test]
fn zero_length_moves_are_counted_apart() {
    let drawing = accept(read, "PU0,0;PD40,0;PD40,0;PD;PR0,0;PR40,0;");
    assert_eq!(moves(&drawing), ["line to 1 0 0", "line to 2 0 0"]);
    assert_eq!(drawing.zero_length, 3);
    assert!(drawing.warnings.is_empty());
}

#[test]
fn moves_carry_their_lines() {
    let drawing = accept(read, "IN;\r\nPD40,0,\n80,0;\r\r\nCO\"a\nb\";PU0,0");
    let lines: Vec<usize> = drawing.moves.iter().map(|step| step.line).collect();
    assert_eq!(lines, [2, 3, 5]);
}

#[test]
fn what_stands_between_instructions_does_not_matter() {
    let drawn = "U40,80 D400,400";
    for text in [
        "IN;PA40,80;PD;PA400,400;",
        "IN;PA,40,80;PD;PA,400,400;",
        "IN;;PA40,80;;PD;,PA400,400;;",
        "in pa40 80 pd pa400 400",
        "PU40,80,;PD400,400,",
        "IN\r\r\nPU40,80\r\r\nPD400,400\r\r\n",
        "PU40,80;PD400,400;\0\0",
        "PU40,80;\x00PD400,\x00400;\x1a",
        "\u{feff}PU40,80;PD400,400;",
        "PU40,80;PD400,400;!PG;",
        "!ST1;PU40,80!FS80,2PD400,400!PG",
        "\x03PU40,80;PD400,400;\x03",
        "\x1b.N;19:\x1b.I81;;17:PU40,80;\x1b.M500;;;10:PD400,400;\x1b.)",
        "\x1bE\x1b%1BBP5,1,1,\"PD9,9;\";IN;PU40,80;PD400,400;\x1b%1A;PD0,0\x1bE",
        "PU40,80PD400,400\x1b%0APD9,9;\x1b*b3WPD0\x1b%0BPU",
        "@PJL SET X=1\nPU40,80;PD400,400",
        "PU-0+0PU40+80PD400,+400.0",
    ] {
        assert_eq!(path(text), drawn, "{text:?}");
    }
}

#[test]
fn lines_are_counted_as_an_editor_does() {
    for (text, line) in [
        ("IN;\nSP1;\nPD9,9;", 3),
        ("IN;\r\nSP1;\r\nPD9,9;", 3),
        ("IN;\r\r\nSP1;\r\r\nPD9,9;", 3),
        ("IN;\rSP1;\rPD9,9;", 3),
        ("IN;\n\n\nPD\n9,9;", 5),
    ] {
        assert_eq!(
            accept(read, text).moves.get(0).unwrap().line,
            line,
            "{text:?}"
        );
    }
}
