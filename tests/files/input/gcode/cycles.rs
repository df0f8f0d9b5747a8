//! Drilling cycles.

use motion_rtl::input::gcode::read;

use crate::input::common::{accept, moves, refuse, warnings};

#[test]
fn holes_and_their_moves() {
    let cases: &[(&str, &[&str])] = &[
        // Back to where Z was, then to R alone.
        (
            "F60 G98 G0 Z5\nG81 X1 R2 Z-3\nX2",
            &[
                "rapid to 0 0 5",
                "rapid to 1 0 5",
                "rapid to 1 0 2",
                "line to 1 0 -3 F60",
                "rapid to 1 0 2",
                "rapid to 1 0 5",
                "rapid to 2 0 5",
                "rapid to 2 0 2",
                "line to 2 0 -3 F60",
                "rapid to 2 0 2",
                "rapid to 2 0 5",
            ],
        ),
        (
            "F60 G0 Z5\nG99 G82 X1 R2 Z-3 P1\nX2\nG80\nG0 X0",
            &[
                "rapid to 0 0 5",
                "rapid to 1 0 5",
                "rapid to 1 0 2",
                "line to 1 0 -3 F60",
                "rapid to 1 0 2",
                "rapid to 2 0 2",
                "line to 2 0 -3 F60",
                "rapid to 2 0 2",
                "rapid to 0 0 2",
            ],
        ),
        // From below R.
        (
            "F60 G85 X1 R2 Z1",
            &[
                "rapid to 0 0 2",
                "rapid to 1 0 2",
                "line to 1 0 1 F60",
                "line to 1 0 2 F60",
            ],
        ),
        // Pecks: out of the hole, and a little up.
        (
            "F60 G83 R0 Z-5 Q2",
            &[
                "line to 0 0 -2 F60",
                "rapid to 0 0 0",
                "rapid to 0 0 -1.746",
                "line to 0 0 -4 F60",
                "rapid to 0 0 0",
                "rapid to 0 0 -3.746",
                "line to 0 0 -5 F60",
                "rapid to 0 0 0",
            ],
        ),
        (
            "F60 G73 R0 Z-3 Q2",
            &[
                "line to 0 0 -2 F60",
                "rapid to 0 0 -1.746",
                "line to 0 0 -3 F60",
                "rapid to 0 0 0",
            ],
        ),
        // Repeated in steps; R from where Z was, Z from R.
        (
            "F60 G0 Z4\nG98 G91 G81 X1 R-3 Z-2 L2",
            &[
                "rapid to 0 0 4",
                "rapid to 1 0 4",
                "rapid to 1 0 1",
                "line to 1 0 -1 F60",
                "rapid to 1 0 1",
                "rapid to 1 0 4",
                "rapid to 2 0 4",
                "rapid to 2 0 1",
                "line to 2 0 -1 F60",
                "rapid to 2 0 1",
                "rapid to 2 0 4",
            ],
        ),
        // Without G98 or G99 to R, as LinuxCNC.
        (
            "F60 G0 Z5\nG81 X1 R2 Z-3\nG80 G0 X[#<_retract_r_plane> * 9]",
            &[
                "rapid to 0 0 5",
                "rapid to 1 0 5",
                "rapid to 1 0 2",
                "line to 1 0 -3 F60",
                "rapid to 1 0 2",
                "rapid to 9 0 2",
            ],
        ),
    ];
    for (text, expected) in cases {
        assert_eq!(moves(&accept(read, text)), *expected, "{text}");
    }
    let told = "t:2: neither G98 nor G99: the cycle ends at R, as by G99".to_owned();
    let warned = |text| warnings(&accept(read, text)).contains(&told);
    assert!(warned("F60 G0 Z5\nG81 X1 R2 Z-3"));
    assert!(!warned("F60 G99 G0 Z5\nG81 X1 R2 Z-3"));
}

#[test]
fn what_a_cycle_lacks() {
    for (text, fault) in [
        ("G81 X1 Z-1", "t:1: G81: without R"),
        ("G81 X1 R1", "t:1: G81: without Z"),
        ("G81 X1 R-2 Z-1", "t:1: G81: R is below Z by 1 mm"),
        ("G83 X1 R1 Z-1", "t:1: G83: without a Q that fits the depth"),
        (
            "G83 X1 R1 Z-1 Q0",
            "t:1: G83: without a Q that fits the depth",
        ),
        ("G81 X1 R1 Z-1 L1.5", "t:1: L: is 1.5"),
        (
            "G81 X1 R1 Z-1\nG80\nX2",
            "t:3: X, Y, Z: no G0, G1, G2 or G3 in force",
        ),
    ] {
        let refused = refuse(read, text);
        assert!(refused.starts_with(fault), "{refused}");
    }
}

#[test]
fn holes_along_the_other_axes() {
    for (text, expected) in [
        (
            "F60 G18 G99 G0 Y5\nG81 X1 Z2 R3 Y-1\nG91 X2",
            &[
                "rapid to 0 5 0",
                "rapid to 1 5 2",
                "rapid to 1 3 2",
                "line to 1 -1 2 F60",
                "rapid to 1 3 2",
                "rapid to 3 3 2",
                "line to 3 -1 2 F60",
                "rapid to 3 3 2",
            ][..],
        ),
        (
            "F60 G19 G98 G91 G0 X5\nG85 Y1 Z2 R-2 X-3",
            &[
                "rapid to 5 0 0",
                "rapid to 5 1 2",
                "rapid to 3 1 2",
                "line to 0 1 2 F60",
                "line to 3 1 2 F60",
                "rapid to 5 1 2",
            ],
        ),
        (
            "F60 G18 G10 L2 P1 Y1\nG82 R0 Y-1",
            &["rapid to 0 1 0", "line to 0 0 0 F60", "rapid to 0 1 0"],
        ),
    ] {
        assert_eq!(moves(&accept(read, text)), expected, "{text}");
    }
    assert!(refuse(read, "G18 G84 X1 R1 Y-1").starts_with("t:1: G84: outside of G17"));
    // Another plane begins another cycle.
    assert!(refuse(read, "G81 R2 Z1\nG18 Y1").starts_with("t:2: G81: without R"));
    assert!(refuse(read, "G18 G81 R2 Z1").starts_with("t:1: G81: without Y; allowed: Y with"));
    assert!(refuse(read, "G19 G81 R2 X3").contains("R is below X by 1 mm; allowed: R at X or"));
}
