//! Every axis within its acceleration, on lines and curves, and no slower than need be.

use super::*;
use motion_rtl::circuits::trajectory_controller::Widths;
use motion_rtl::jobs::trajectory_controller::each_axis::EachAxis;
use motion_rtl::jobs::trajectory_controller::job::Program;
use motion_rtl::jobs::trajectory_controller::settings::Settings;
use motion_rtl::path::circle::Circle;
use motion_rtl::path::cubic::Cubic;
use motion_rtl::path::helix::Helix;
use motion_rtl::path::pieces::{Course, Piece};
use motion_rtl::path::vector::add;
use motion_rtl::plant::TwoMassParameters;
use proptest::prelude::*;
use std::f64::consts::TAU;

fn program(pieces: &[Piece], allowed: &[f64], normal: f64) -> Program {
    let settings = Settings {
        acceleration_mm_per_s2: Some(1e5),
        normal_acceleration_mm_per_s2: normal,
        axis_acceleration_mm_per_s2: Some(EachAxis::Each(allowed.to_vec())),
        ..Settings::default()
    };
    let machine = vec![TwoMassParameters::default(); allowed.len()];
    Program::of([0.0; 3], pieces, &settings, &machine, &Widths::FULL).unwrap()
}

fn line(to: [f64; 3]) -> Piece {
    Piece {
        course: Course::Line,
        to,
        speed: 200.0,
        line: None,
    }
}

/// An arc in the plane of x and y that begins at the origin in this direction.
fn arc(direction: f64, radius: f64, angle: f64) -> Piece {
    let (sin, cos) = direction.sin_cos();
    let circle = Circle {
        centre: [-radius * sin, radius * cos, 0.0],
        axis: [0.0, 0.0, 1.0],
        start: [0.0; 3],
        radius,
        angle,
    };
    Piece {
        course: Course::Arc(circle),
        ..line(circle.end())
    }
}

/// The largest acceleration of each axis in mm/s², by second differences of the exact points.
fn largest(program: &Program) -> [f64; 3] {
    let (profile, unit) = (&program.profile, program.motion.units_per_mm);
    let steps = 20_000;
    let dt = profile.duration / f64::from(steps);
    let at = |n: i32| {
        let [q, ..] = profile.at(f64::from(n) * dt);
        program.path.point(q).map(|units| units / unit)
    };
    let mut most = [0.0f64; 3];
    for n in 1..steps {
        let [a, b, c] = [n - 1, n, n + 1].map(at);
        for axis in 0..3 {
            most[axis] = most[axis].max(((a[axis] - 2.0 * b[axis] + c[axis]) / (dt * dt)).abs());
        }
    }
    most
}

#[test]
fn a_line_is_as_fast_as_its_weakest_axis() {
    // 3-4-12 in a length of 13.
    let way = [30.0, 40.0, 120.0];
    for (allowed, along) in [
        ([1000.0, 1e5, 1e5], 1000.0 * 13.0 / 3.0),
        ([1e5, 1000.0, 1e5], 1000.0 * 13.0 / 4.0),
        ([1e5, 1e5, 1000.0], 1000.0 * 13.0 / 12.0),
    ] {
        let program = program(&[line(way)], &allowed, 1e5);
        let seen = program.motion.slope.acceleration / program.motion.units_per_mm;
        assert!((seen / along - 1.0).abs() < 1e-9, "{seen} {along}");
        // Trapezoid: L/v + v/a.
        let time = 130.0 / 200.0 + 200.0 / along;
        assert!((program.profile.duration / time - 1.0).abs() < 1e-6);
        let most = largest(&program);
        let part = (0..3).map(|k| most[k] / allowed[k]).fold(0.0, f64::max);
        assert!((part - 1.0).abs() < 1e-3, "{most:?}");
    }
    // An axis that does not move does not matter.
    let program = program(&[line([30.0, 0.0, 0.0])], &[1e4, 1.0, 1.0], 1e5);
    let seen = program.motion.slope.acceleration / program.motion.units_per_mm;
    assert!((seen - 1e4).abs() < 1e-6, "{seen}");
}

#[test]
fn a_circle_shares_its_acceleration() {
    // Half of the square is for either.
    let program = program(&[arc(0.0, 20.0, TAU)], &[1000.0, 2000.0], 1e5);
    let motion = &program.motion;
    let along = motion.slope.acceleration / motion.units_per_mm;
    assert!(
        (along / 1000.0 * 2.0f64.sqrt() - 1.0).abs() < 1e-9,
        "{along}"
    );
    let speeds = program.profile.pieces.iter().map(|piece| piece.v);
    let speed = speeds.fold(0.0, f64::max) / motion.units_per_mm;
    let exact = (1000.0 / 2.0f64.sqrt() * 20.0).sqrt();
    assert!((speed / exact - 1.0).abs() < 1e-6, "{speed} {exact}");
    let most = largest(&program);
    assert!(most[0] < 1000.0 * 1.001 && most[0] > 700.0, "{most:?}");
    // The limit across the path still holds.
    let slow = self::program(&[arc(0.0, 20.0, TAU)], &[1000.0, 2000.0], 100.0);
    let speeds = slow.profile.pieces.iter().map(|piece| piece.v);
    let speed = speeds.fold(0.0, f64::max) / slow.motion.units_per_mm;
    assert!((speed / 2000.0f64.sqrt() - 1.0).abs() < 1e-6, "{speed}");
}

#[test]
fn helices_and_splines_stay_within() {
    let circle = Circle::around([0.0, 20.0, 0.0], [0.0; 3], [0.0; 3], [0.0, 0.0, 1.0]).unwrap();
    let helix = Helix { circle, rise: 60.0 };
    let helix = Piece {
        course: Course::Helix(helix),
        ..line(helix.point(1.0))
    };
    let points = [
        [0.0; 3],
        [30.0, 5.0, 10.0],
        [40.0, 40.0, -5.0],
        [0.0, 60.0, 0.0],
    ];
    let splines = Cubic::through(&points).into_iter().map(|cubic| Piece {
        course: Course::Spline(cubic),
        ..line(cubic.points[3])
    });
    let allowed = [800.0, 1500.0, 600.0];
    for (path, used) in [(vec![helix], 0.5), (splines.collect(), 0.25)] {
        let most = largest(&program(&path, &allowed, 1e5));
        let parts = [0, 1, 2].map(|axis| most[axis] / allowed[axis]);
        let part = parts.into_iter().fold(0.0, f64::max);
        assert!((used..1.001).contains(&part), "{parts:?}");
    }
}

proptest! {
    #![proptest_config(config(100))]

    #[test]
    #[ignore = "takes long"]
    fn no_axis_has_more_than_it_is_allowed(
        direction in 0.0..TAU,
        radius in 1.0..50.0f64,
        angle in 0.3..6.0f64,
        run in 1.0..60.0f64,
        allowed in [100.0..5000.0f64, 100.0..5000.0],
    ) {
        // A line, and an arc that it is tangent to.
        let (sin, cos) = direction.sin_cos();
        let end = [run * cos, run * sin, 0.0];
        let mut bend = arc(direction, radius, angle);
        if let Course::Arc(circle) = &mut bend.course {
            circle.centre = add(circle.centre, end);
            circle.start = add(circle.start, end);
            bend.to = circle.end();
        }
        let program = program(&[line(end), bend], &allowed, 1e5);
        // Behind the line the acceleration across is there at once: no more than is allowed either.
        let most = largest(&program);
        for k in 0..2 {
            prop_assert!(most[k] < allowed[k] * 1.01, "{:?} {:?}", most, allowed);
        }
    }
}
