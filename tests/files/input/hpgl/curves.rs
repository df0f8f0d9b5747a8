//! Arcs, circles and Bézier curves.

use std::fmt::Write as _;

use motion_rtl::input::hpgl::read;
use motion_rtl::input::{Drawing, REACH_MM};
use proptest::prelude::*;

use super::path;
use crate::input::common::accept;

/// The ends of chords from an angle on, about a centre, as [`path`] shows them.
fn chords(centre: [f64; 2], radius: f64, start_deg: f64, chord_deg: f64, count: u32) -> String {
    let mut shown = String::new();
    for k in 1..=count {
        let angle = (start_deg + f64::from(k) * chord_deg).to_radians();
        let point = [angle.cos(), angle.sin()].map(|part| part * radius);
        let [x, y] = [centre[0] + point[0], centre[1] + point[1]]
            .map(|units| (units * 100.0).round() / 100.0 + 0.0);
        write!(shown, " D{x},{y}").unwrap();
    }
    shown
}

#[test]
fn an_arc_is_drawn_as_chords_and_ends_where_it_says() {
    let quarter = chords([1000.0, 1000.0], 1000.0, 0.0, 5.0, 18);
    let start = "U2000,1000";
    for text in [
        "PU2000,1000;PD;AA1000,1000,90;PR400,0",
        "PU2000,1000;PD;AR-1000,0,90;PR400,0",
        "PU2000,1000;PD;AA1000,1000,90,5;PR400,0",
        "PU2000,1000;PD;CT0;AA1000,1000,90,5;PR400,0",
    ] {
        assert_eq!(path(text), format!("{start}{quarter} D1400,2000"), "{text}");
    }
    let clockwise = chords([1000.0, 1000.0], 1000.0, 0.0, -15.0, 6);
    assert_eq!(
        path("PU2000,1000;PD;AA1000,1000,-90,15"),
        format!("{start}{clockwise}")
    );
    // Chords are equal, and no longer than asked for.
    let uneven = chords([1000.0, 1000.0], 1000.0, 0.0, 25.0, 4);
    assert_eq!(
        path("PU2000,1000;PD;AA1000,1000,100,30"),
        format!("{start}{uneven}")
    );
    // 1000 (1 - cos 30°) off: chords of 60°.
    let coarse = chords([1000.0, 1000.0], 1000.0, 0.0, 60.0, 3);
    assert_eq!(
        path("PU2000,1000;PD;CT1;AA1000,1000,180,133.9746"),
        format!("{start}{coarse}")
    );
    // The pen may be up.
    let up = chords([1000.0, 1000.0], 1000.0, 0.0, 45.0, 2).replace('D', "U");
    assert_eq!(
        path("PU2000,1000;AA1000,1000,90,45"),
        format!("{start}{up}")
    );
}

#[test]
fn arcs_go_through_three_points() {
    let half = chords([1000.0, 0.0], 1000.0, 180.0, -30.0, 6);
    for text in ["PD;AT1000,1000,2000,0,30", "PD;RT1000,1000,2000,0,30;"] {
        assert_eq!(path(text), half.trim_start(), "{text}");
    }
    assert_eq!(path("PD;AT1000,0,2000,0"), "D1000,0 D2000,0");
    let whole = chords([500.0, 0.0], 500.0, 180.0, 90.0, 4);
    assert_eq!(path("PD;AT1000,0,0,0,90"), whole.trim_start());
}

#[test]
fn a_circle_leaves_the_pen_at_its_centre_as_it_was() {
    let circle = chords([400.0, 400.0], 100.0, 0.0, 5.0, 72);
    assert_eq!(
        path("PU400,400;CI100;PD480,400"),
        format!("U400,400 U500,400{circle} U400,400 D480,400")
    );
    assert_eq!(
        path("PD400,400;CI100,5;PR80,0"),
        format!("D400,400 U500,400{circle} U400,400 D480,400")
    );
    let other_side = chords([0.0, 0.0], 100.0, 180.0, 90.0, 4);
    assert_eq!(path("CI-100,90"), format!("U-100,0{other_side} U0,0"));
}

#[test]
fn unequal_scales_make_ellipses() {
    // Twice as long in Y as in X.
    let text = "IP0,0,100,200;SC0,10,0,10;PU5,0;PD;AA0,0,90,90";
    assert_eq!(path(text), "U50,0 D0,100");
}

#[test]
fn bezier_curves_end_exactly_and_stay_near() {
    let drawing = accept(read, "PD;BZ0,400,400,400,400,0;PR40,0");
    let ends: Vec<[f64; 2]> = drawing.moves.iter().map(|m| [m.to[0], m.to[1]]).collect();
    assert_eq!(ends[ends.len() - 2..], [[10.0, 0.0], [11.0, 0.0]]);
    // The top is at three quarters of the control points' height.
    let top = ends.iter().map(|end| end[1]).fold(0.0, f64::max);
    assert!((top - 7.5).abs() < 0.01, "{top}");
    assert!(ends.len() > 10);
    // Relative, two at once.
    let relative = "PD;BR0,400,400,400,400,0,0,-400,400,-400,400,0;";
    let absolute = "PD;BZ0,400,400,400,400,0,400,-400,800,-400,800,0;";
    assert_eq!(path(relative), path(absolute));
    assert!(path(relative).ends_with("D800,0"));
}

fn radii(drawing: &Drawing, centre: [f64; 2]) -> Vec<f64> {
    let radius = |to: [f64; 3]| (to[0] - centre[0]).hypot(to[1] - centre[1]);
    drawing.moves.iter().map(|step| radius(step.to)).collect()
}

proptest! {
    #[test]
    fn ends_of_chords_are_on_the_circle(
        x in -9000..9000i32,
        y in -9000..9000i32,
        sweep in -360..360i32,
        chord in 1..90i32,
    ) {
        prop_assume!(sweep != 0 && (x, y) != (0, 0));
        let drawing = accept(read, &format!("PD;AA{x},{y},{sweep},{chord}"));
        let centre = [x, y].map(|units| f64::from(units) / 40.0);
        let radius = centre[0].hypot(centre[1]);
        for seen in radii(&drawing, centre) {
            prop_assert!((seen - radius).abs() < 1e-9 * REACH_MM);
        }
        let chords = (sweep.abs() + chord - 1) / chord;
        prop_assert_eq!(drawing.moves.len(), chords as usize);
        let end = drawing.moves.get(drawing.moves.len() - 1).unwrap().to;
        let (sin, cos) = f64::from(sweep).to_radians().sin_cos();
        let wanted = [
            centre[0] - centre[0] * cos + centre[1] * sin,
            centre[1] - centre[0] * sin - centre[1] * cos,
        ];
        prop_assert!((end[0] - wanted[0]).hypot(end[1] - wanted[1]) < 1e-6);
    }
}
