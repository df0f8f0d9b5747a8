//! Arcs from points, against arcs that are built from their angle.

use super::*;
use motion_rtl::input::{self, Drawing, Move};
use motion_rtl::jobs::arc_generator::prepare::prepare;
use motion_rtl::jobs::arc_generator::settings::Settings;
use motion_rtl::path::circle::CircleError;
use motion_rtl::path::pieces::from_drawing;
use std::f64::consts::{PI, TAU};

fn points() -> impl Strategy<Value = Point> {
    let number = || -500.0..500.0f64;
    (number(), number(), number()).prop_map(|(x, y, z)| [x, y, z])
}

/// System, centre, radius, angle.
fn arcs() -> impl Strategy<Value = ([Point; 3], Point, f64, f64)> {
    let radius = (-1.0..3.0f64).prop_map(|power| 10f64.powf(power));
    (frames(), points(), radius, 0.02..TAU - 0.02)
}

proptest! {
    #[test]
    fn three_points_give_their_arc(
        (frame, centre, radius, angle) in arcs(),
        share in 0.05..0.95f64,
    ) {
        let at = |angle| on_circle(frame, centre, radius, angle);
        let circle = Circle::through(at(0.0), at(angle * share), at(angle)).unwrap();
        // The middle point's distance from the chord is what the digits are lost by.
        let sagitta = radius * (1.0 - (angle * share.min(1.0 - share)).cos().abs()).max(1e-4);
        let near = 1e-11 * (500.0 + radius) * (radius / sagitta);
        for point in [at(0.0), at(angle * share), at(angle)] {
            let off = length(minus(point, circle.centre)) - circle.radius;
            prop_assert!(off.abs() < near, "{off} off the radius");
        }
        prop_assert!((circle.radius - radius).abs() < near);
        prop_assert!(length(minus(circle.centre, centre)) < near);
        prop_assert!(length(minus(circle.axis, frame[2])) < near / radius, "the axis");
        prop_assert!((circle.angle - angle).abs() < near / radius, "the angle");
        prop_assert!(length(minus(circle.end(), at(angle))) < near, "the end");
        prop_assert!(length(minus(circle.direction(0.0), frame[1])) < near / radius);
        prop_assert!(circle.distance(at(angle * share)) < near, "B is on the arc");
    }

    #[test]
    fn extremes_hold_every_point((frame, centre, radius, angle) in arcs()) {
        let at = |angle| on_circle(frame, centre, radius, angle);
        let circle = Circle { centre, axis: frame[2], start: at(0.0), radius, angle };
        let extremes = circle.extremes();
        let mut seen = [[f64::INFINITY, f64::NEG_INFINITY]; 3];
        for n in 0..=2000 {
            let point = at(angle * f64::from(n) / 2000.0);
            for k in 0..3 {
                seen[k] = [seen[k][0].min(point[k]), seen[k][1].max(point[k])];
            }
        }
        for (wide, seen) in extremes.iter().zip(seen) {
            // Between two of the points the arc swings out by no more than this.
            let swing = radius * (angle / 2000.0).powi(2) / 8.0 + 1e-9;
            prop_assert!(wide[0] <= seen[0] + 1e-9 && wide[0] >= seen[0] - swing);
            prop_assert!(wide[1] >= seen[1] - 1e-9 && wide[1] <= seen[1] + swing);
        }
    }

    #[test]
    fn distances_are_those_to_the_nearest_point(
        (frame, centre, radius, angle) in arcs(),
        aside in points(),
    ) {
        let at = |angle| on_circle(frame, centre, radius, angle);
        let circle = Circle { centre, axis: frame[2], start: at(0.0), radius, angle };
        let step = angle / 4000.0;
        let distances = (0..=4000).map(|n| length(minus(at(f64::from(n) * step), aside)));
        let nearest = distances.fold(f64::INFINITY, f64::min);
        let distance = circle.distance(aside);
        prop_assert!(distance <= nearest + 1e-9);
        prop_assert!(distance >= nearest - radius * step, "{distance}, {nearest}");
    }

    #[test]
    fn a_moved_centre_is_as_far_from_both_ends(
        (frame, centre, radius, angle) in arcs(),
        off in -0.005..0.005f64,
    ) {
        // The end's radius is off, and the centre is given above the plane.
        let from = on_circle(frame, centre, radius, 0.0);
        let to = on_circle(frame, centre, radius * (1.0 + off), angle);
        let span = length(minus(to, from));
        prop_assume!(radius * radius * off.abs() * 1.01 < 0.04 * radius * span);
        let given = [0, 1, 2].map(|k| centre[k] + 7.0 * frame[2][k]);
        let circle = Circle::around(given, from, to, frame[2].map(|x| 3.0 * x)).unwrap();
        prop_assert!((length(minus(from, circle.centre)) - circle.radius).abs() < 1e-9);
        prop_assert!((length(minus(to, circle.centre)) - circle.radius).abs() < 1e-9);
        prop_assert!(length(minus(circle.end(), to)) < 1e-9);
        prop_assert!(inner(minus(circle.centre, from), frame[2]).abs() < 1e-9, "in the plane");
        let moved = length(minus(circle.centre, centre));
        prop_assert!(moved <= 0.05 * radius * 1.01);
        // The arc goes the same way around.
        prop_assert!((circle.angle - angle).abs() < 0.15, "{} for {angle}", circle.angle);
        prop_assert!(inner(circle.direction(0.0), frame[1]) > 0.98);
    }
}

#[test]
fn points_that_make_no_arc_are_refused() {
    let (a, b, c) = ([0.0; 3], [10.0, 0.0, 0.0], [20.0, 0.0, 0.0]);
    let text = |result: Result<Circle, CircleError>| result.unwrap_err().to_string();
    assert_eq!(
        text(Circle::through(a, a, c)),
        "start and via are the same point"
    );
    assert_eq!(
        text(Circle::through(a, c, c)),
        "via and end are the same point"
    );
    assert_eq!(
        text(Circle::through(a, b, a)),
        "start and end are the same point"
    );
    assert_eq!(
        text(Circle::through(a, b, c)),
        "the point via is only 0 mm off the line from start to end, 20 mm long"
    );
    assert_eq!(
        text(Circle::through(a, [10.0, 1e-9, 0.0], c)),
        "the point via is only 0.000000001 mm off the line from start to end, 20 mm long"
    );
    // Beyond the end as well as between.
    assert!(Circle::through(a, c, b).is_err());
    assert!(Circle::through(a, [10.0, 1e-6, 0.0], c).is_ok());
    let z = [0.0, 0.0, 1.0];
    assert_eq!(
        text(Circle::around(b, a, [20.0, 0.0, 0.5], z)),
        "climbs 0.5 mm along its axis: a helix"
    );
    assert_eq!(
        text(Circle::around([0.0, 0.0, 9.0], a, c, z)),
        "start and centre are the same point"
    );
    assert_eq!(
        text(Circle::around([8.0, 0.0, 0.0], a, c, z)),
        "the radius is 8 mm at the start and 12 mm at the end"
    );
}

/// A drawing of one move.
fn drawing(to: Point, centre: [f64; 2], clockwise: bool) -> Drawing {
    Drawing {
        file: "x.ngc".to_owned(),
        start: [1.0, 2.0, 3.0],
        moves: [Move {
            to,
            course: input::Course::Arc { centre, clockwise },
            rapid: false,
            feed_mm_per_min: Some(600.0),
            line: 7,
        }]
        .into_iter()
        .collect(),
        fourth: Vec::new(),
        zero_length: 0,
        warnings: Vec::new(),
    }
}

#[test]
fn arcs_of_a_drawing_turn_as_they_say() {
    let settings = Settings::default();
    for (clockwise, to, angle, quarter) in [
        (false, [1.0, 2.0, 3.0], TAU, [6.0, -3.0, 3.0]),
        (true, [1.0, 2.0, 3.0], TAU, [6.0, 7.0, 3.0]),
        (false, [11.0, 2.0, 3.0], PI, [6.0, -3.0, 3.0]),
        (true, [11.0, 2.0, 3.0], PI, [6.0, 7.0, 3.0]),
        (false, [6.0, 7.0, 3.0], 1.5 * PI, [6.0, -3.0, 3.0]),
        (true, [6.0, 7.0, 3.0], 0.5 * PI, [6.0, 7.0, 3.0]),
    ] {
        let pieces = from_drawing(&drawing(to, [6.0, 2.0], clockwise), &settings).unwrap();
        let Course::Arc(circle) = pieces[0].course else {
            panic!("an arc");
        };
        assert!((circle.angle - angle).abs() < 1e-12, "{clockwise} {to:?}");
        assert!(length(minus(circle.point(PI / 2.0), quarter)) < 1e-12);
        assert_eq!((pieces[0].speed, pieces[0].line), (10.0, Some(7)));
        assert_eq!(pieces[0].to, to);
    }
}

#[test]
fn a_helix_of_a_drawing_is_refused_with_its_line() {
    let helix = drawing([11.0, 2.0, 4.0], [6.0, 2.0], true);
    let pieces = from_drawing(&helix, &Settings::default()).unwrap();
    let error = prepare(helix.start, &pieces, &timing(64)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "piece 0 (line 7): climbs 1 mm along its axis: a helix; allowed: an arc in a plane: \
         a rotation has no feed along its axis"
    );
    assert_eq!(error.reason.word(), "Z");
}

#[test]
fn moves_of_a_drawing_have_their_speeds() {
    let mut drawing = drawing([11.0, 2.0, 3.0], [6.0, 2.0], true);
    let step = |rapid, feed_mm_per_min, line| Move {
        to: [0.0, 0.0, line as f64],
        course: input::Course::Line,
        rapid,
        feed_mm_per_min,
        line,
    };
    drawing.moves.push(step(true, Some(60.0), 8));
    drawing.moves.push(step(false, None, 9));
    let speeds = |settings: &Settings| {
        let pieces = from_drawing(&drawing, settings)?;
        Ok(pieces.iter().map(|piece| piece.speed).collect())
    };
    let mut settings = Settings::default();
    let error: motion_rtl::path::error::PathError = match speeds(&settings) {
        Ok(speeds) => {
            let _: Vec<f64> = speeds;
            panic!("no speed")
        }
        Err(error) => error,
    };
    assert_eq!(
        error.to_string(),
        "piece 2 (line 9): missing; allowed: a speed of the piece, or one for all"
    );
    settings.feed_mm_per_min = Some(300.0);
    assert_eq!(speeds(&settings), Ok(vec![10.0, 200.0, 5.0]));
}
