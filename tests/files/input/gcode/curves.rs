//! Arcs out of the X-Y plane, several turns, and splines.

use motion_rtl::input::gcode::{read, read_with};
use motion_rtl::input::{Course, Drawing, Options};
use motion_rtl::plan::{MotionLimits, Plan};

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
    // Equal to a line with its own first control point: the negative of the last one.
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
        (
            "G5 X8 I1 P0 Q4 F60",
            "t:1: G5: without its control points; allowed: I, J, P and Q; behind another G5 P and Q",
        ),
        ("G5 X8 I0 J4 P1 F60", "t:1: G5: without its control points"),
        (
            "G5 X8 I0 J4 P0 Q4 F60\nX16 J1 P0 Q4",
            "t:2: G5: without its control points",
        ),
        (
            "G5 X8 I0 J4 P0 Q4 F60\nG1 X9\nG5 X16 P0 Q4",
            "t:3: G5: without its control points",
        ),
        ("G5.1 X8 F60", "t:1: G5.1: without its control point"),
        (
            "G5.1 X8 I0 J0 F60",
            "t:1: G5.1: without its control point; allowed: I and J, not both 0",
        ),
        (
            "G18 G5 X8 I0 J4 P0 Q4",
            "t:1: G5: with Z, or outside of G17",
        ),
        ("G5 X8 Z1 I0 J4 P0 Q4", "t:1: G5: with Z, or outside of G17"),
    ] {
        let refused = refuse(read, text);
        assert!(refused.starts_with(fault), "{refused}");
    }
}

#[test]
fn splines_are_moves_where_they_are_asked_for() {
    let options = Options {
        splines: true,
        ..Options::default()
    };
    let read = |text: &str| read_with("t", text.as_bytes(), &options);
    let drawing = read("G20 G91 G1 X1 F60\nG5 X2 I0 J1 P0 Q1\nX2 P0 Q-1\nG5.1 X2 Y1 I1").unwrap();
    assert!(drawing.warnings.is_empty(), "{:?}", drawing.warnings);
    let courses: Vec<Course> = drawing.moves.iter().map(|step| step.course).collect();
    let inches = |x: f64, y: f64| [x * 25.4, y * 25.4, 0.0];
    let expected = [
        [inches(1.0, 1.0), inches(3.0, 1.0)],
        [inches(3.0, -1.0), inches(5.0, -1.0)],
        // Two thirds of the way to the one control point.
        [
            inches(5.0 + 2.0 / 3.0, 0.0),
            inches(6.0 + 1.0 / 3.0, 1.0 / 3.0),
        ],
    ];
    assert_eq!(courses.len(), 4);
    for (course, expected) in courses[1..].iter().zip(expected) {
        let Course::Spline { controls } = course else {
            panic!("{course:?}");
        };
        assert!(
            controls.iter().zip(expected).all(|(a, b)| near(*a, b)),
            "{controls:?}"
        );
    }
    // A time is that of the spline: 60 mm/min over what it is long.
    let timed = read("G93 G5 X8 I0 J0 P0 Q0 F1").unwrap();
    assert_eq!(timed.moves.get(0).unwrap().feed_mm_per_min, Some(8.0));
    // A curve that goes nowhere is none; one that comes back is.
    let still = read("G1 X1 F60\nG5 X1 I0 J0 P0 Q0").unwrap();
    assert_eq!((still.moves.len(), still.zero_length), (1, 1));
    assert_eq!(read("G5 X0 I9 J0 P0 Q9 F60").unwrap().moves.len(), 1);
    let far = read("G5 X0 I2000000 J0 P0 Q9 F60").unwrap_err().to_string();
    assert!(
        far.starts_with("t:1: G5: a control point's X would be 2000000 mm"),
        "{far}"
    );
    // One of a quarter's circle of 10 mm, which is many chords.
    let quarter = "G5 X-10 Y10 I0 J5.5228475 P5.5228475 Q0 F600";
    let chords = read_with("t", quarter.as_bytes(), &Options::default()).unwrap();
    assert_eq!(
        [read(quarter).unwrap().moves.len(), chords.moves.len()],
        [1, 59]
    );
    // NURBS are chords whatever is asked for, and the planner of other circuits takes no splines.
    let nurbs = read(LOOP[0]).unwrap();
    assert!(nurbs.moves.iter().all(|step| step.course == Course::Line));
    let plan = Plan::new(&drawing, &MotionLimits::default());
    assert_eq!(
        plan.unwrap_err().to_string(),
        "line 2: a spline: allowed are lines and arcs, as without Options::splines"
    );
}

/// A closed curve of order 3 over five control points, as LinuxCNC's manual has it.
const LOOP: [&str; 2] = [
    "F60\nG5.2 P1 L3\nX0 Y1 P1\nX2 Y2 P1\nX2 Y0 P1\nX0 Y0 P2\nG5.3",
    "F60\nG6.2 X0 Y0 R1 K0 P3 Q1\nX0 Y1 R1 K0\nX2 Y2 R1 K0\nX2 Y0 R1 K1\nX0 Y0 R2 K2\nG6.2 K3\n\
     G6.2 K3\nG6.2 K3",
];

#[test]
fn a_nurbs_goes_through_its_curve_by_either_form() {
    let drawings = LOOP.map(chords);
    assert_eq!(ends(&drawings[0]), ends(&drawings[1]));
    let path = ends(&drawings[0]);
    // Halfway through the middle span the basis is 1/8, 3/4, 1/8; between spans half and half.
    for point in [[1.75, 1.625, 0.0], [1.0, 1.5, 0.0], [2.0, 1.0, 0.0]] {
        assert!(
            path.iter().any(|to| near(*to, point)),
            "{point:?}: {path:?}"
        );
    }
    assert!(near(*path.last().unwrap(), [0.0; 3]));
    // The moves belong to one line, that of the end.
    assert!(drawings[0].moves.iter().all(|step| step.line == 7));
    // The next line needs a motion of its own, and starts at its end.
    let after = |text: &str| format!("{}\n{text}", LOOP[0]);
    assert!(refuse(read, &after("X5")).starts_with("t:8: X, Y, Z: no G0, G1, G2 or G3 in force"));
    let last = accept(read, &after("G91 G1 X5")).moves.last().unwrap();
    assert!(near(last.to, [5.0, 0.0, 0.0]));
}

#[test]
fn a_nurbs_lies_in_the_plane_in_force() {
    let drawing = chords("G19 G0 X7\nG5.2 Y0 Z4 P1 L2 F60\nY4 Z4 P1\nG5.3");
    let path = ends(&drawing);
    assert_eq!(path[0], [7.0, 0.0, 0.0]);
    assert!(path.contains(&[7.0, 0.0, 4.0]), "{path:?}");
    assert_eq!(path.last(), Some(&[7.0, 4.0, 4.0]));
}

#[test]
fn a_nurbs_that_is_not_whole_is_refused() {
    for (text, fault) in [
        ("G1 X1 F60\nG5.3", "t:2: G5.3: without G5.2 before"),
        (
            "G5.2 X1 P1",
            "t:1: G5.2: control points have both coordinates",
        ),
        (
            "G5.2 X1 Y1 Z1",
            "t:1: G5.2: control points have both coordinates",
        ),
        ("G5.2 X1 Y1 P0", "t:1: P: a weight that is not above 0"),
        ("G5.2 X1 Y1 L2.5", "t:1: L: an order of 2.5"),
        ("G5.2 X1 Y1 L21", "t:1: L: an order of 21"),
        (
            "G5.2 X1 Y1\nP2",
            "t:2: P: a weight without its control point",
        ),
        (
            "G5.2 X1 Y1\nG5.3",
            "t:2: G5.2: 2 control points, the first included",
        ),
        (
            "G5.2 X1 Y1\nG1 X2",
            "t:2: G1: within the NURBS that G5.2 began in line 1",
        ),
        (
            "G5.2 X1 Y1\nG28",
            "t:2: G5.2: within the NURBS that G5.2 began in line 1",
        ),
        ("G1 X1 F60\nG5.2 X1 Y1", "t:2: G5.2: without its end"),
        ("G6.2 X1 Y1 K0", "t:1: P: a G6.2 begins without its order"),
        ("G6.2 X1 Y1 P3", "t:1: K: a line of a G6.2 without its knot"),
        (
            "G6.2 X1 Y1 P3 K1\nX2 Y2 K0",
            "t:2: K: knot 0 is less than the one before",
        ),
        (
            "G6.2 X1 Y1 P3 K0\nG5.3",
            "t:2: G5.3: within the NURBS that G6.2 began in line 1",
        ),
        ("G5.2 X1 Y1 I2", "t:1: I: without a word that it belongs to"),
    ] {
        let refused = refuse(read, text);
        assert!(refused.starts_with(fault), "{text:?}: {refused}");
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
