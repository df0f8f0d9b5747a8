//! Refused texts, with their messages.

use motion_rtl::input::hpgl::read;

use crate::input::common::refuse;

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
        ("PD1,1e5", &format!("t:1: PD: 1 has an exponent; {NUMBER}")),
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
            "SC0,1,0,0,2",
            "t:1: SC: a factor of 0; allowed: factors of plotter units a user unit other than 0",
        ),
        (
            "SC0,1,0,1,3",
            "t:1: SC: scaling of type 3; allowed: 0 (anisotropic) or 2 (factors), both without \
             further parameters, or 1 (isotropic)",
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
            "RO45",
            "t:1: RO: a turn of 45 degrees; allowed: 0, 90, 180 or 270",
        ),
        (
            "PS0,9",
            "t:1: PS: paper without a size; allowed: two sizes above 0",
        ),
        (
            "BZ1,2,3,4",
            "t:1: BZ: a curve without all of its points; allowed: two control points and an end \
             for each curve",
        ),
        ("AA1,2", "t:1: AA: 2 parameters; allowed: 3, 4 parameters"),
        (
            "CO\"a;",
            "t:1: CO: no closing quote, to the end of the file; allowed: '\\\"' at its end",
        ),
    ];
    for (text, expected) in cases {
        assert_eq!(refuse(read, text), *expected, "{text:?}");
    }
}
