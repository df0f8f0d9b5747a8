//! Skipped instructions, with their messages, and those skipped only if lenient.

use motion_rtl::input::Options;
use motion_rtl::input::hpgl::{read, read_with};

use crate::input::common::{accept, moves, refuse, warnings};

const ONE: [&str; 1] = ["line to 0.025 0.025 0"];

#[test]
fn what_is_skipped_is_said_once() {
    let cases: &[(&str, &[&str])] = &[
        (
            "VS10;LT;\nVS20;PD1,1;lt2,4",
            &["t:1: VS: skipped (2 times)", "t:1: LT: skipped (2 times)"],
        ),
        ("CO\"PD9,9;\";PD1,1", &["t:1: CO: skipped"]),
        ("CO PD9,9;PD1,1", &["t:1: CO: skipped"]),
        (
            "WDPD9,9\x03PD1,1;MGPD9,9;",
            &["t:1: WD: skipped", "t:1: MG: skipped"],
        ),
        (
            "CS1;CA2;SS;SA;PD1,1",
            &[
                "t:1: CS: skipped",
                "t:1: CA: skipped",
                "t:1: SS: skipped",
                "t:1: SA: skipped",
            ],
        ),
        (
            "PD1,1;\nPG;PG",
            &["t:2: PG: skipped; all pages are drawn over each other, once (2 times)"],
        ),
        (
            "\x1b.(\nPD1,1\x1b.)",
            &["t:1: ESC .: escape sequence skipped (2 times)"],
        ),
        (
            "SP1;SP0;SP1;PD1,1;\nSP2",
            &["t:2: SP: more than one pen; all pens draw alike"],
        ),
        ("PS4;PD1,1;!PG;", &["t:1: PS: skipped", "t:1: !PG: skipped"]),
    ];
    for (text, expected) in cases {
        let drawing = accept(read, text);
        assert_eq!(warnings(&drawing), *expected, "{text:?}");
        assert_eq!(moves(&drawing), ONE, "{text:?}");
    }
}

#[test]
fn what_is_not_known_is_refused_unless_lenient() {
    const KNOWN: &str = "is not known and may move the pen; allowed: instructions of HPGL and \
                         HPGL/2; with --lenient it is skipped";
    const LETTERS: &str = "no instruction starts with it; allowed: instructions of two letters, \
                           such as PD";
    let missing = "not known, skipped; what it draws or moves is missing";
    let cases: &[(&str, String, String)] = &[
        (
            "PD1,1;\nQQ4,\"PD9,9\",5;ZZ",
            format!("t:2: QQ: {KNOWN}"),
            format!("t:2: QQ: {missing}|t:2: ZZ: {missing}"),
        ),
        (
            "!ZZ1,2,3;PD1,1;!ZZ4,5,6",
            format!("t:1: !ZZ: {KNOWN}"),
            format!("t:1: !ZZ: {missing} (2 times)"),
        ),
        (
            "# 9,9\nPD1,1;\n1,2;",
            format!("t:1: '#': {LETTERS}"),
            "t:1: '#': no instruction, skipped (2 times)".to_owned(),
        ),
        (
            "PD1,1;\nPD7;",
            "t:2: PD: an X without its Y: an odd count of coordinates; allowed: pairs of X and Y"
                .to_owned(),
            "t:2: PD: an X without its Y: an odd count of coordinates; the X is skipped".to_owned(),
        ),
        (
            "AA5,5;CI;AA5;PD1,1",
            "t:1: AA: 2 parameters; allowed: 3, 4 parameters".to_owned(),
            "t:1: AA: 2 parameters; skipped|t:1: CI: 0 parameters; skipped|t:1: AA: 1 parameters; \
             skipped"
                .to_owned(),
        ),
        (
            "PD1,1;IP1,2,3;TL1,2,3,4;",
            "t:1: IP: 3 parameters; allowed: 0, 2, 4 parameters".to_owned(),
            "t:1: IP: 3 parameters; taken as without any|t:1: TL: too many parameters; those \
             beyond are skipped (2 times)"
                .to_owned(),
        ),
        (
            "PD1,1;BZ1,2,3,4",
            "t:1: BZ: a curve without all of its points; allowed: two control points and an end \
             for each curve"
                .to_owned(),
            "t:1: BZ: a curve without all of its points; the curve is skipped".to_owned(),
        ),
        (
            "PD1,,1",
            "t:1: PD: ',' in place of a number; allowed: decimal numbers such as -12.5, separated \
             by commas or spaces"
                .to_owned(),
            String::new(),
        ),
        (
            "PM0;LBa\x03PM2;PD1,1",
            "t:1: LB: stands in polygon mode; allowed: AA, AR, AT, BR, BZ, CI, PA, PD, PE, PR, PU \
             or RT up to PM2"
                .to_owned(),
            "t:1: LB: stands in polygon mode, skipped".to_owned(),
        ),
    ];
    for (text, fault, warning) in cases {
        assert_eq!(refuse(read, text), *fault, "{text:?}");
        let drawing = read_with("t", text.as_bytes(), &Options::lenient()).unwrap();
        assert_eq!(warnings(&drawing).join("|"), *warning, "{text:?}");
        assert_eq!(moves(&drawing), ONE, "{text:?}");
    }
}
