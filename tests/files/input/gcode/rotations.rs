//! Rotated coordinates and polar ones.

use motion_rtl::input::gcode::read;
use motion_rtl::input::{Course, Drawing};

use crate::input::common::{accept, near, refuse};

fn ends(drawing: &Drawing) -> Vec<[f64; 3]> {
    drawing.moves.iter().map(|step| step.to).collect()
}

/// Expects a program to go to these places.
fn goes(text: &str, expected: &[[f64; 3]]) {
    let found = ends(&accept(read, text));
    let same = found.iter().zip(expected).all(|(a, b)| near(*a, *b));
    assert!(same && found.len() == expected.len(), "{text}: {found:?}");
}

#[test]
fn a_system_by_g10_r_is_rotated_about_its_zero() {
    // As rs274 of LinuxCNC has them.
    for (text, expected) in [
        (
            "G10 L2 P1 X10 R90\nG0 X1 Y0\nG91 X1\nG90 G53 X0\nX1",
            &[
                [10.0, 1.0, 0.0],
                [10.0, 2.0, 0.0],
                [0.0, 2.0, 0.0],
                [0.0, 1.0, 0.0],
            ][..],
        ),
        (
            "G10 L2 P2 R180\nG0 X1\nG55 X2 Y1 Z3\nG54 X3 Y1",
            &[[1.0, 0.0, 0.0], [-2.0, -1.0, 3.0], [3.0, 1.0, 3.0]],
        ),
        (
            "G10 L2 P1 R90\nG0 X2 Y0\nG92 X0\nX1",
            &[[0.0, 2.0, 0.0], [0.0, 3.0, 0.0]],
        ),
        ("G92 X1 Y1\nG10 L2 P1 R90\nG0 X2 Y1", &[[0.0, 1.0, 0.0]]),
        (
            "G10 L2 P1 R90\nG0 X2 Y1\nG10 L20 P1 X0\nX0 Y0\nY1",
            &[[-1.0, 2.0, 0.0], [0.0, 2.0, 0.0], [-1.0, 2.0, 0.0]],
        ),
        (
            "G10 L2 P2 X5 R90\nG0 X2 Y1\nG10 L20 P2 X1 Y1 Z1\nG55 X0 Y0 Z0",
            &[[2.0, 1.0, 0.0], [3.0, 0.0, -1.0]],
        ),
        (
            "G10 L2 P1 R90\nG0 X5 Y0 Z2\nG28.1\nX0 Y0\nG28\nX1 Y0\nG28 Z4",
            &[
                [0.0, 5.0, 2.0],
                [0.0, 0.0, 2.0],
                [0.0, 5.0, 2.0],
                [0.0, 1.0, 2.0],
                [0.0, 1.0, 4.0],
                [0.0, 1.0, 2.0],
            ],
        ),
        ("G43.1 X1\nG10 L2 P1 R90\nG0 X2 Y0", &[[1.0, 2.0, 0.0]]),
        (
            "G10 L2 P1 R90\nG0 X2 Y1\nG10 L2 P1 R0\nX[#<_x>+1]",
            &[[-1.0, 2.0, 0.0], [0.0, 2.0, 0.0]],
        ),
        (
            "G10 L2 P1 R90\nG0 X2 Y1\nX#<_x> Y#<_y> Z#5230\nG53 X0 Y#<_abs_x>",
            &[[-1.0, 2.0, 0.0], [-1.0, 2.0, 90.0], [0.0, -1.0, 90.0]],
        ),
    ] {
        goes(text, expected);
    }
    for (line, fault) in [
        (
            "G28 X0",
            "G28: with one of X and Y where the coordinates are rotated",
        ),
        ("G28 X Y1", "G28: with one of X and Y"),
        ("G10 L20 P1 X0 R5", "G10 R: with L20"),
    ] {
        let refused = refuse(read, &format!("G10 L2 P1 R90\n{line}"));
        assert!(refused.starts_with(&format!("t:2: {fault}")), "{refused}");
    }
}

#[test]
fn curves_turn_with_the_coordinates() {
    let arc = accept(read, "G10 L2 P1 X1 R90\nG0 X0 Y0\nG2 X10 Y0 I5 F60")
        .moves
        .get(1)
        .unwrap();
    let Course::Arc {
        centre: [x, y],
        clockwise: true,
    } = arc.course
    else {
        panic!("{arc:?}");
    };
    assert!(near([x, y, 0.0], [1.0, 5.0, 0.0]) && near(arc.to, [1.0, 10.0, 0.0]));
    // A full circle ends where it began, to the last bit.
    for text in [
        "G10 L2 P1 X1 R30\nG0 X0.1 Y0.2\nG91 X0.1 Y0.7\nG3 I2 F60",
        "G0 X0.1 Y0.2\nG68 X1 Y1 R30\nX0.7 Y0.7\nG2 X0.7 Y0.7 Z3 I2 F60",
    ] {
        let drawing = accept(read, text);
        let [.., before, circle] = drawing.moves.iter().collect::<Vec<_>>()[..] else {
            panic!("{drawing:?}");
        };
        assert_eq!(circle.to[..2], before.to[..2], "{text}");
    }
    // Out of the X-Y plane, and splines.
    let chords = ends(&accept(read, "G10 L2 P1 R90\nG18 G2 X2 Z0 I1 F60"));
    assert!(
        chords
            .iter()
            .any(|to| (to[2] + 1.0).abs() < 1e-3 && to[0].abs() < 1e-9)
    );
    assert!(near(*chords.last().unwrap(), [0.0, 2.0, 0.0]));
    let spline = ends(&accept(read, "G10 L2 P1 R90\nG5 X8 I0 J4 P0 Q4 F60"));
    assert!(
        spline.iter().any(|to| near(*to, [-3.0, 4.0, 0.0])),
        "{spline:?}"
    );
    let nurbs = ends(&accept(
        read,
        "G10 L2 P1 R90\nG5.2 X0 Y4 P1 L2 F60\nX4 Y4 P1\nG5.3",
    ));
    assert!(near(*nurbs.last().unwrap(), [-4.0, 4.0, 0.0]), "{nurbs:?}");
}

#[test]
fn g68_turns_the_program_until_g69() {
    for (text, expected) in [
        (
            "G0 X1\nG68 X0 Y0 R90\nX10 Y0\nY5\nG69\nX1 Y1\nX2",
            &[
                [1.0, 0.0, 0.0],
                [0.0, 10.0, 0.0],
                [-5.0, 10.0, 0.0],
                [1.0, 1.0, 0.0],
                [2.0, 1.0, 0.0],
            ][..],
        ),
        // About another point, and about where the tool is.
        ("G68 X10 Y0 R180\nG0 X0 Y0", &[[20.0, 0.0, 0.0]]),
        (
            "G0 X10\nG68 R90\nG91 X5\nG90 X10 Y0",
            &[[10.0, 0.0, 0.0], [10.0, 5.0, 0.0], [10.0, 0.0, 0.0]],
        ),
        // From the zero of the program, in its units, with what rotates the system.
        ("G20 G92 X-1\nG68 X0 Y0 R90\nG0 X1 Y0", &[[25.4, 25.4, 0.0]]),
        (
            "G10 L2 P1 X5 R90\nG68 X2 Y0 R90\nG0 X3 Y0",
            &[[4.0, 2.0, 0.0]],
        ),
        (
            "G68 X0 Y0 R90\nG68 X0 Y0 R-90\nG0 X1 Y0 Z1",
            &[[0.0, -1.0, 1.0]],
        ),
        (
            "G68 X0 Y0 R90\nG0 Z3\nX1 Y0",
            &[[0.0, 0.0, 3.0], [0.0, 1.0, 3.0]],
        ),
        ("G69 G0 X1", &[[1.0, 0.0, 0.0]]),
    ] {
        goes(text, expected);
    }
    for (text, fault) in [
        ("G68 X0 Y0", "t:1: G68: without an angle"),
        ("G68 X0 R5", "t:1: G68: without a centre by X and Y"),
        ("G68 X0 Y0 Z0 R5", "t:1: G68: without a centre by X and Y"),
        (
            "G68 X0 Y0 R5 I1",
            "t:1: I: without a word that it belongs to",
        ),
        ("G68 R5\nG68 R6", "t:2: G68: without a centre by X and Y"),
        ("G68 X0 Y0 R361", "t:1: R: an angle of 361 degrees"),
        ("G91 G68 X0 Y0 R5", "t:1: G68: under G91"),
        ("G18 G68 X0 Z0 R5", "t:1: G68: outside of G17"),
        ("G68 X0 Y0 R5 G1", "t:1: G68: together with a motion"),
        ("G68.2 X0 Y0 Z0", "t:1: G68.2: a rotation in space"),
        ("G68 G69 X0 Y0 R5", "t:1: G69: together with G68"),
        ("G68 R5\nG92 X0", "t:2: G92: under G68; allowed: G69 before"),
        ("G68 R5\nG28", "t:2: G28: under G68"),
        ("G68 R5\nG55", "t:2: G54 to G59.3: under G68"),
        ("G68 R5\nG53 G0 X1 Y1", "t:2: G53: under G68"),
        ("G68 R5\nG19", "t:2: G18, G19: under G68"),
        (
            "G68 R5\nG0 X5",
            "t:2: X, Y: the first move behind G68; allowed: X and Y under G90",
        ),
        ("G68 R5\nG2 I1 F60", "t:2: X, Y: the first move behind G68"),
        (
            "G68 R5\nG69\nG91 G0 X5",
            "t:3: X, Y: the first move behind G69",
        ),
        ("G68 R5\nG69 G0 Y5", "t:2: X, Y: the first move behind G69"),
    ] {
        let refused = refuse(read, text);
        assert!(refused.starts_with(fault), "{text:?}: {refused}");
    }
}

#[test]
fn g16_takes_x_for_a_radius_and_y_for_an_angle() {
    for (text, expected) in [
        (
            "G16 G0 X10 Y90\nY180\nX5 Z1\nZ2\nG15 X1 Y1",
            &[
                [0.0, 10.0, 0.0],
                [-10.0, 0.0, 0.0],
                [-5.0, 0.0, 1.0],
                [-5.0, 0.0, 2.0],
                [1.0, 1.0, 2.0],
            ][..],
        ),
        (
            "G20 G52 X1\nG16\nG0 X1 Y60",
            &[[38.1, 25.4 * 0.75_f64.sqrt(), 0.0]],
        ),
        (
            "G16 G0 X1 Y0\nG3 X1 Y90 R1 F60",
            &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        ),
        (
            "G16 G81 X10 Y90 R0 Z-1 F60\nY180\nG80",
            &[
                [0.0, 10.0, 0.0],
                [0.0, 10.0, -1.0],
                [0.0, 10.0, 0.0],
                [-10.0, 0.0, 0.0],
                [-10.0, 0.0, -1.0],
                [-10.0, 0.0, 0.0],
            ],
        ),
        ("G15 G0 X1 Y2", &[[1.0, 2.0, 0.0]]),
        ("G16\nG92 X1\nG15 G0 X2", &[[1.0, 0.0, 0.0]]),
    ] {
        goes(text, expected);
    }
    for (text, fault) in [
        ("G16 G0 X1", "t:1: G16: without its radius or angle"),
        (
            "G16 G0 X1 Y1\nG16\nX1",
            "t:3: G16: without its radius or angle",
        ),
        ("G16 G91 G0 X1 Y1", "t:1: G16: with G91 or G53"),
        ("G16 G53 G0 X1 Y1", "t:1: G16: with G91 or G53"),
        ("G16 G18 G0 X1 Y1", "t:1: G16: outside of G17"),
        ("G16 G2 X1 Y1 I1", "t:1: G16: with I and J, or a curve"),
        ("G16 G5.1 X1 Y1 I1", "t:1: G16: with I and J, or a curve"),
        ("G15 G16", "t:1: G16: together with G15"),
    ] {
        let refused = refuse(read, text);
        assert!(refused.starts_with(fault), "{text:?}: {refused}");
    }
}

#[test]
fn radius_and_angle_have_words_of_their_own() {
    // As rs274 of LinuxCNC has them.
    for (text, expected) in [
        (
            "G0 @10 ^90\n^180\n@5\nG91 @5 ^90 Z1\nG90 @1",
            &[
                [0.0, 10.0, 0.0],
                [-10.0, 0.0, 0.0],
                [-5.0, 0.0, 0.0],
                [0.0, -10.0, 1.0],
                [0.0, -1.0, 1.0],
            ][..],
        ),
        ("G20 G92 X-1\nG1 @1^0 F60", &[[50.8, 0.0, 0.0]]),
        (
            "G1 @2 ^90 F60\nG3 ^180 I0 J-2",
            &[[0.0, 2.0, 0.0], [-2.0, 0.0, 0.0]],
        ),
        (
            "G0 X5\nG91 G81 ^90 R0 Z-1 L2 F60",
            &[
                [5.0, 0.0, 0.0],
                [0.0, 5.0, 0.0],
                [0.0, 5.0, -1.0],
                [0.0, 5.0, 0.0],
                [-5.0, 0.0, 0.0],
                [-5.0, 0.0, -1.0],
                [-5.0, 0.0, 0.0],
            ],
        ),
    ] {
        goes(text, expected);
    }
    for (text, fault) in [
        ("G0 @1 ^2 X3", "t:1: @, ^: with X, Y, G16 or G53"),
        ("G16 G0 @1 ^2", "t:1: @, ^: with X, Y, G16 or G53"),
        ("G53 G0 @1 ^2", "t:1: @, ^: with X, Y, G16 or G53"),
        ("G18 G0 @1 ^2", "t:1: @, ^: outside of G17, or with a curve"),
        (
            "G5.1 @1 ^2 I1",
            "t:1: @, ^: outside of G17, or with a curve",
        ),
        ("G92 @1", "t:1: @, ^: with G92"),
        ("G0 ^5", "t:1: @, ^: from the zero, where there is no angle"),
        ("G91 G0 @5 ^5", "t:1: @, ^: from the zero"),
        ("G0 @1 @2", "t:1: @: twice in one line"),
        ("G0 @", "t:1: expression: no value at ''"),
        ("G0 @9999999999 ^1", "t:1: @: 9999999999 is out of range"),
    ] {
        let refused = refuse(read, text);
        assert!(refused.starts_with(fault), "{text:?}: {refused}");
    }
}
