//! HPGL: what is read, skipped and refused.

use motion_rtl::input::hpgl::read;

use super::common::{accept, moves, refuse, warnings};

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
fn scaled_units_land_between_p1_and_p2() {
    // By hand, in plotter units. The default area is 10000 x 7200 from (250, 279).
    let cases: &[(&str, &str)] = &[
        ("SC0,100,0,100;PD50,50", "line to 131.25 96.975 0"),
        ("SC0,100,0,100;PD0,100", "line to 6.25 186.975 0"),
        ("IP0,0,4000,2000;SC-1,1,0,10;PD0,5", "line to 50 25 0"),
        // P2 moves along with P1, to (11000, 7600).
        ("IP1000,400;SC0,10,0,10;PD10,10", "line to 275 190 0"),
        (
            "IP0,0,400,400;IP1000,400;SC0,1,0,1;PD1,1",
            "line to 35 20 0",
        ),
        (
            "IP0,0,40,40;IP;SC0,100,0,100;PD100,100",
            "line to 256.25 186.975 0",
        ),
        // The order of IP and SC does not matter.
        ("SC0,10,0,10;IP0,0,400,800;PD5,5", "line to 5 10 0"),
        ("SC0,10,0,10;SC;PD40,40", "line to 1 1 0"),
        ("SC0,10,0,10;IN;PD40,40", "line to 1 1 0"),
        // 10 plotter units a unit in Y, so too in X; 3000 are left over there.
        (
            "IP0,0,4000,1000;SC0,100,0,100,1;PD100,100",
            "line to 62.5 25 0",
        ),
        (
            "IP0,0,4000,1000;SC0,100,0,100,1,0,50;PD100,100",
            "line to 25 25 0",
        ),
        (
            "IP0,0,4000,1000;SC0,100,0,100,1,100,50;PD100,100",
            "line to 100 25 0",
        ),
        (
            "IP0,0,4000,1000;SC0,100,0,100,0;PD100,100",
            "line to 100 25 0",
        ),
        // Relative moves scale, and the pen stays on the paper when the scale changes.
        ("IP0,0,400,800;SC0,10,0,10;PD;PR5,5", "line to 5 10 0"),
        ("PR40,40;IP0,0,400,800;SC0,10,0,10;PD1,1", "line to 2 3 0"),
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
fn zero_length_moves_are_counted_apart() {
    let drawing = accept(read, "PU0,0;PD40,0;PD40,0;PD;PR0,0;PR40,0;");
    assert_eq!(moves(&drawing), ["line to 1 0 0", "line to 2 0 0"]);
    assert_eq!(drawing.zero_length, 3);
    assert!(drawing.warnings.is_empty());
}

#[test]
fn moves_carry_their_lines() {
    let drawing = accept(read, "IN;\r\nPD40,0,\n80,0;\rLBa\nb\x03PU0,0");
    let lines: Vec<usize> = drawing.moves.iter().map(|step| step.line).collect();
    assert_eq!(lines, [2, 3, 5]);
}

#[test]
fn what_is_skipped_is_said_once() {
    let cases: &[(&str, &[&str])] = &[
        (
            "VS10;LT;\nVS20;PD1,1;lt2,4",
            &["t:1: VS: skipped (2 times)", "t:1: LT: skipped (2 times)"],
        ),
        (
            "PD1,1;\nCI50",
            &["t:2: CI: skipped; what it draws or moves is missing"],
        ),
        // Letters of a label are not instructions.
        (
            "LBPD40,40;PU\x03PD1,1",
            &["t:1: LB: skipped; what it draws or moves is missing"],
        ),
        (
            "DT#;LBPU;\x03PD9,9#PD1,1",
            &["t:1: LB: skipped; what it draws or moves is missing"],
        ),
        (
            "DT#,1;DT;LBPU#PD9,9\x03PD1,1",
            &["t:1: LB: skipped; what it draws or moves is missing"],
        ),
        (
            "DT#;IN;LBPU#\x03PD1,1",
            &["t:1: LB: skipped; what it draws or moves is missing"],
        ),
        (
            "PE<=PD9,9;PD1,1",
            &["t:1: PE: skipped; what it draws or moves is missing"],
        ),
        ("CO\"PD9,9;\";PD1,1", &["t:1: CO: skipped"]),
        (
            "SMP;PD1,1;SM;",
            &["t:1: SM: skipped; what it draws or moves is missing (2 times)"],
        ),
        (
            "\x1b.(\nPD1,1\x1b.)",
            &["t:1: ESC .: escape sequence skipped (2 times)"],
        ),
        (
            "SP1;SP0;SP1;PD1,1;\nSP2",
            &["t:2: SP: more than one pen; all pens draw alike"],
        ),
    ];
    for (text, expected) in cases {
        let drawing = accept(read, text);
        assert_eq!(warnings(&drawing), *expected, "{text:?}");
        assert_eq!(moves(&drawing), ["line to 0.025 0.025 0"], "{text:?}");
    }
}

#[test]
fn labels_hold_any_bytes() {
    let drawing = read("t", b"LB\xe4\xff\x00\x03PD40,0").unwrap();
    assert_eq!(moves(&drawing), ["line to 1 0 0"]);
}

#[test]
fn malformed_texts_and_their_faults() {
    const NUMBER: &str = "allowed: decimal numbers such as -12.5, separated by commas or spaces";
    const PAIRS: &str = "allowed: pairs of X and Y";
    const LETTERS: &str = "allowed: instructions of two letters, such as PD";
    let none = "t: file: no move in it; allowed: an HPGL drawing with at least one move";
    let odd = "an X without its Y: an odd count of coordinates";
    let cases: &[(&str, &str)] = &[
        ("", none),
        ("IN;SP1;PD;PU", none),
        ("PD0,0;PU0,0", none),
        (
            "PD1,1;\nPD1,\n2,3\n;PU",
            &format!("t:3: PD: {odd}; {PAIRS}"),
        ),
        ("PA5", &format!("t:1: PA: {odd}; {PAIRS}")),
        (
            "PD1..5,2",
            &format!("t:1: PD: 1..5 is not a number; {NUMBER}"),
        ),
        ("\nPU-,2", &format!("t:2: PU: - is not a number; {NUMBER}")),
        (
            "PD1,,2",
            &format!("t:1: PD: ',' in place of a number; {NUMBER}"),
        ),
        (
            "PD,1,2",
            &format!("t:1: PD: ',' in place of a number; {NUMBER}"),
        ),
        (
            "PD1,2,;",
            &format!("t:1: PD: ';' in place of a number; {NUMBER}"),
        ),
        (
            "PD1,2,",
            &format!("t:1: PD: no number after the comma; {NUMBER}"),
        ),
        (
            "PD1,#2",
            &format!("t:1: PD: '#' in place of a number; {NUMBER}"),
        ),
        (
            "PR2000000000,0",
            "t:1: PR: 2000000000 is out of range; allowed: -1073741824 to 1073741824",
        ),
        (
            "PA0,-1000000000",
            "t:1: PA: Y would be -25000000 mm; allowed: -1000000 to 1000000 mm",
        ),
        (
            "1,2",
            &format!("t:1: '1': no instruction starts with it; {LETTERS}"),
        ),
        (
            "PD;DF;40,0",
            &format!("t:1: '4': no instruction starts with it; {LETTERS}"),
        ),
        (
            "P;",
            &format!("t:1: 'P': no instruction starts with it; {LETTERS}"),
        ),
        (
            "PD1,1;\n\0",
            &format!("t:2: '\\u{{0}}': no instruction starts with it; {LETTERS}"),
        ),
        (
            "PD1,1e5",
            &format!("t:1: 'e': no instruction starts with it; {LETTERS}"),
        ),
        (
            "SC5,5,0,1;\nPD1,1",
            "t:1: SC: X runs from 5 to 5; allowed: a minimum and a maximum that differ",
        ),
        (
            "SC0,1,2,2\nPD1,1",
            "t:1: SC: Y runs from 2 to 2; allowed: a minimum and a maximum that differ",
        ),
        (
            "SC0,1,2",
            "t:1: SC: 3 parameters; allowed: 0, 4, 5, 7 parameters",
        ),
        (
            "SC0,1,0,1,2",
            "t:1: SC: scaling of type 2; allowed: 0 (anisotropic, without further parameters) or 1 \
             (isotropic)",
        ),
        (
            "SC0,1,0,1,1,101,0",
            "t:1: SC: 101 % of the room left over; allowed: 0 to 100 %",
        ),
        (
            "IP1,2,3",
            "t:1: IP: 3 parameters; allowed: 0, 2, 4 parameters",
        ),
        (
            "IP1,2,3,4,5",
            "t:1: IP: too many parameters; allowed: at most 4",
        ),
        (
            "IP0,0,0,10",
            "t:1: IP: P1 and P2 leave no area between them; allowed: P1 and P2 that differ in X \
             and in Y",
        ),
        (
            "SP1.5",
            "t:1: SP: 1.5 is not a pen; allowed: a whole number from 0",
        ),
        ("DF1;", "t:1: DF: too many parameters; allowed: at most 0"),
        (
            "PD1,1;\nLBopen;\nPU;",
            "t:2: LB: no label terminator after it, to the end of the file; allowed: '\\u{3}' at \
             its end",
        ),
        (
            "PE<=",
            "t:1: PE: no semicolon after it, to the end of the file; allowed: ';' at its end",
        ),
        (
            "CO\"a;",
            "t:1: CO: no closing quote, to the end of the file; allowed: '\\\"' at its end",
        ),
    ];
    for (text, expected) in cases {
        assert_eq!(refuse(read, text), *expected, "{text:?}");
    }
}
