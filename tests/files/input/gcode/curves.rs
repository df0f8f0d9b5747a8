//! Arcs out of the X-Y plane, several turns, and splines.

use motion_rtl::input::gcode::read;
use motion_rtl::input::{Course, Drawing};

use crate::input::common::{accept, moves, near, refuse, warnings};

const CHORDS: &str = "arcs outside of G17, and splines, are chords within 0.001 mm";

fn chords(text: &str) -> Drawing {
    let drawing = accept(read, text);
    assert!(drawing.moves.iter().all(|step| step.course == Course::Line));
    assert!(warnings(&drawing).iter().any(|text| text.contains(CHORDS)));
    drawing
}

#[test]
fn arcs_in_the_other_planes_turn_as_seen_from_their_axis() {
    // Seen from +Y, Z is to the right and X up; from +X, Y is to the right and Z up.
    for (text, middle, end) in [
        ("G18 G2 X2 Z0 I1 K0 F60", [1.0, 0.0, -1.0], [2.0, 0.0, 0.0]),
        ("G18 G3 X2 Z0 I1 F60", [1.0, 0.0, 1.0], [2.0, 0.0, 0.0]),
        ("G19 G2 Y2 Z0 J1 F60", [0.0, 1.0, 1.0], [0.0, 2.0, 0.0]),
        ("G19 G3 Y2 Z0 J1 F60", [0.0, 1.0, -1.0], [0.0, 2.0, 0.0]),
        ("G19 G2 Y2 R1 X4 F60", [2.0, 1.0, 1.0], [4.0, 2.0, 0.0]),
    ] {
        let drawing = chords(text);
        let near_to =
            |a: [f64; 3], b: [f64; 3]| (0..3).all(|axis| (a[axis] - b[axis]).abs() < 0.12);
        assert!(
            drawing.moves.iter().any(|step| near_to(step.to, middle)),
            "{text}"
        );
        assert!(near(drawing.moves.last().unwrap().to, end), "{text}");
    }
}

#[test]
fn turns_of_one_arc() {
    assert_eq!(
        moves(&accept(read, "G2 Z6 I1 P3 F60")),
        [
            "cw about 1 0 to 0 0 2 F60",
            "cw about 1 0 to 0 0 4 F60",
            "cw about 1 0 to 0 0 6 F60"
        ]
    );
    // Half a turn more than one.
    let drawing = accept(read, "G3 X2 Z3 I1 P2 F60");
    let ends: Vec<_> = drawing.moves.iter().map(|step| step.to).collect();
    assert!(
        near(ends[0], [0.0, 0.0, 2.0]) && near(ends[1], [2.0, 0.0, 3.0]),
        "{ends:?}"
    );
    assert!(refuse(read, "G2 I1 P1.5").starts_with("t:1: P: 1.5 turns"));
    assert_eq!(
        moves(&accept(read, "G92 X1\nG90.1 G2 X3 I2 J0 F60")),
        ["cw about 1 0 to 2 0 0 F60"]
    );
}

#[test]
fn splines_go_through_their_curves() {
    // The middle of a cubic is (p + 3 q + 3 r + s) / 8.
    let cubic = chords("G5 X8 I0 J4 P0 Q4 F60");
    assert!(
        cubic
            .moves
            .iter()
            .any(|step| near(step.to, [4.0, 3.0, 0.0]))
    );
    // The same as a line of its own first control point: the negative of the last one.
    let again = |text: &str| ends(&chords(&format!("G5 X8 I0 J4 P0 Q4 F60\n{text}")));
    assert_eq!(again("X16 P0 Q-4"), again("G5 X16 I0 J-4 P0 Q-4"));
    let quadratic = chords("G5.1 X8 I4 J8 F60");
    assert!(
        quadratic
            .moves
            .iter()
            .any(|step| near(step.to, [4.0, 4.0, 0.0]))
    );
    for (text, fault) in [
        ("G5 X8 I0 J4 F60", "t:1: G5: without its control points"),
        ("G5 X8 P0 Q4 F60", "t:1: G5: without its control points"),
        ("G5.1 X8 F60", "t:1: G5.1: without its control point"),
        ("G5 X8 Z1 I0 J4 P0 Q4", "t:1: G5: with Z, or outside of G17"),
    ] {
        let refused = refuse(read, text);
        assert!(refused.starts_with(fault), "{refused}");
    }
}

#[test]
fn a_probe_goes_to_its_end() {
    let drawing = accept(read, "G38.2 Z-5 F60");
    assert_eq!(moves(&drawing), ["line to 0 0 -5 F60"]);
    assert_eq!(
        warnings(&drawing),
        ["t:1: G38: moves to its end, nothing is touched"]
    );
}

fn ends(drawing: &Drawing) -> Vec<[f64; 3]> {
    drawing.moves.iter().map(|step| step.to).collect()
}
