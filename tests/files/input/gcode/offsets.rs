//! Coordinate systems, offsets and reference points.

use motion_rtl::input::gcode::{read, read_with};
use motion_rtl::input::{Options, Zeros, hpgl};

use crate::input::common::{accept, moves, refuse};

#[test]
fn offsets_and_where_they_lead() {
    let cases: &[(&str, &[&str])] = &[
        ("G92 X10\nG0 X12", &["rapid to 2 0 0"]),
        ("G10 L2 P1 X10\nG92 X3\nG0 X4", &["rapid to 1 0 0"]),
        (
            "G0 X5\nG92 X0 Y1\nX1 Y1\nG92.1\nX1",
            &["rapid to 5 0 0", "rapid to 6 0 0", "rapid to 1 0 0"],
        ),
        (
            "G92 X10\nG92.2\nG0 X1\nG92.3\nX12",
            &["rapid to 1 0 0", "rapid to 2 0 0"],
        ),
        ("G0 X5\nG92\nX1", &["rapid to 5 0 0", "rapid to 6 0 0"]),
        (
            "G52 X5\nG0 X1\nG52 X0\nX1",
            &["rapid to 6 0 0", "rapid to 1 0 0"],
        ),
        (
            "G10 L2 P2 X10 Z1\nG0 X1\nG55 X1 Z0\nG53 X1",
            &["rapid to 1 0 0", "rapid to 11 0 1", "rapid to 1 0 1"],
        ),
        (
            "G0 X5\nG10 L20 P0 X0\nX1",
            &["rapid to 5 0 0", "rapid to 6 0 0"],
        ),
        ("G20 G10 L2 P9 Y1\nG59.3 G0 Y1", &["rapid to 0 50.8 0"]),
        (
            "G91 G0 X5\nG53 X1\nX1",
            &["rapid to 5 0 0", "rapid to 1 0 0", "rapid to 2 0 0"],
        ),
        ("G0 X5 Y5\nG28", &["rapid to 5 5 0", "rapid to 0 0 0"]),
        ("G0 X5 Y5\nG28 X", &["rapid to 5 5 0", "rapid to 0 5 0"]),
        (
            "G0 X5 Y5\nG91 G28 Z3",
            &["rapid to 5 5 0", "rapid to 5 5 3", "rapid to 5 5 0"],
        ),
        (
            "G0 X5\nG28.1\nX9 Y9\nG28",
            &["rapid to 5 0 0", "rapid to 9 9 0", "rapid to 5 0 0"],
        ),
        (
            "G0 X5\nG30.1\nX9\nG30 X7",
            &[
                "rapid to 5 0 0",
                "rapid to 9 0 0",
                "rapid to 7 0 0",
                "rapid to 5 0 0",
            ],
        ),
        // G28.1 and G30.1 keep the place before the move of their line.
        (
            "G0 X3\nG28.1 X7\nX20\nG28",
            &[
                "rapid to 3 0 0",
                "rapid to 7 0 0",
                "rapid to 20 0 0",
                "rapid to 3 0 0",
            ],
        ),
        ("F60 G1 G30.1 X1", &["line to 1 0 0 F60"]),
        // A letter alone goes to the reference point straight, wherever the zero is.
        (
            "G0 X5\nG92 X8\nG28 X",
            &["rapid to 5 0 0", "rapid to 0 0 0"],
        ),
    ];
    for (text, expected) in cases {
        assert_eq!(moves(&accept(read, text)), *expected, "{text}");
    }
    let none = refuse(read, "G28.1 X1");
    assert!(none.starts_with("t:1: X, Y, Z: no G0"), "{none}");
    assert!(refuse(read, "G10 L2 P10 X1").starts_with("t:1: G10 P: "));
    assert!(refuse(read, "G52 G1 X1").starts_with("t:1: G52: together with a motion"));
}

#[test]
fn tool_lengths_shift_the_path() {
    // Results of LinuxCNC's rs274.
    let cases: &[(&str, &[&str])] = &[
        (
            "G0 Z5\nG43.1 Z2.5\nG0 Z5\nG91 Z1\nG90 G53 Z0\nZ1\nG49\nZ1",
            &[
                "rapid to 0 0 5",
                "rapid to 0 0 7.5",
                "rapid to 0 0 8.5",
                "rapid to 0 0 0",
                "rapid to 0 0 3.5",
                "rapid to 0 0 1",
            ],
        ),
        ("G43.1 Z1\nG43.1 X2\nG0 X0 Z0", &["rapid to 2 0 1"]),
        ("G91 G43.1 Z1\nG43.1 Z1\nG90 G0 Z0", &["rapid to 0 0 1"]),
        ("G20 G43.1 Z1\nG21 G0 Z0", &["rapid to 0 0 25.4"]),
        ("G43.1 X1 Y2\nG92 X0\nG0 X0 Y0", &["rapid to 0 2 0"]),
        ("G43.1 X1\nG92\nG0 X1 Y1", &["rapid to 1 1 0"]),
        ("G43.1 Y2\nG10 L20 P1 Y9\nG49\nG0 Y0", &["rapid to 0 -11 0"]),
        (
            "G0 Z1\nG43.1 Z3\nG92 Z0\nG49\nG0 Z0",
            &["rapid to 0 0 1", "rapid to 0 0 -2"],
        ),
        ("G43.1 Z4\nG43 H0\nG0 Z1", &["rapid to 0 0 1"]),
        ("M70\nG43.1 Z2\nM72\nG0 Z1", &["rapid to 0 0 1"]),
        (
            "G10 L1 P1 Z5\nG10 L1 P1 X3\nG43 H1\nG0 X1 Z1\nG43.2 H1\nX1 Z1\nG44 H1\nX1 Z1",
            &["rapid to 4 0 6", "rapid to 7 0 11", "rapid to -2 0 -4"],
        ),
        // Without H the tool is that in the spindle.
        ("G10 L1 P2 Z5\nT2 M6\nT1\nG43 G0 Z1", &["rapid to 0 0 6"]),
        ("T1\nM6 G10 L1 P1 Z5\nG43 G0 Z1", &["rapid to 0 0 6"]),
        ("G10 L1 P2 Z5\nM61 Q2\nG43 G0 Z1", &["rapid to 0 0 6"]),
        // The length with which the tool is where it is said to be.
        (
            "G0 Z10\nG92 Z9\nG10 L10 P1 Z2\nG43 H1 G0 Z3",
            &["rapid to 0 0 10", "rapid to 0 0 11"],
        ),
        ("G43.1 Z4\nG0 X#5403 Z[#5422]", &["rapid to 4 0 0"]),
    ];
    for (text, expected) in cases {
        assert_eq!(moves(&accept(read, text)), *expected, "{text}");
    }
}

#[test]
fn parameters_show_the_offsets() {
    let text = "G10 L2 P2 X10\nG55\nG92 Y3\nG0 X[#5241+#5220]\nX[#5420+#5212+1]";
    let ends: Vec<_> = accept(read, text)
        .moves
        .iter()
        .map(|step| step.to)
        .collect();
    assert_eq!(ends, [[22.0, 0.0, 0.0], [20.0, 0.0, 0.0]]);
}

#[test]
fn zeros_are_where_they_are_given_until_the_program_sets_them() {
    let mut zeros = Zeros::default();
    zeros.systems[0] = [10.0, 20.0, 30.0];
    zeros.systems[8] = [0.0, 0.0, -1.0];
    zeros.references = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]];
    let options = Options {
        zeros,
        ..Options::default()
    };
    let with_zeros = |text: &str| {
        let drawing = read_with("t", text.as_bytes(), &options).unwrap();
        moves(&drawing)
    };
    for (text, expected) in [
        ("G0 X1 Y1 Z1", &["rapid to 11 21 31"][..]),
        ("G59.3 G0 Z1 X2", &["rapid to 2 0 0"]),
        ("G10 L2 P1 X5\nG0 X1 Z0", &["rapid to 6 0 30"]),
        ("G28", &["rapid to 1 2 3"]),
        ("G30 Z5", &["rapid to 0 0 35", "rapid to 0 0 6"]),
        (
            "G53 G0 X7\nG28.1\nG53 G0 X0\nG28 X0",
            &[
                "rapid to 7 0 0",
                "rapid to 0 0 0",
                "rapid to 10 0 0",
                "rapid to 7 0 0",
            ],
        ),
        ("G0 X#5221 Y[#5161 + #5183]", &["rapid to 20 27 0"]),
    ] {
        assert_eq!(with_zeros(text), expected, "{text}");
    }
    let fault = hpgl::read_with("t", b"PD1,1;", &options).unwrap_err();
    assert_eq!(fault.field, "program");
}
