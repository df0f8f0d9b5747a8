//! The steady correction on splines: c·v²/ρ along the normal at every point.

use super::*;
use motion_rtl::jobs::trajectory_controller::speed_limits::spans;
use motion_rtl::path::cubic::Cubic;
use motion_rtl::path::vector::{distance, scale, sub};
use std::f64::consts::TAU;

fn spline(points: [Point; 4], speed: f64) -> Piece {
    Piece {
        course: Course::Spline(Cubic { points }),
        ..line(points[3], speed)
    }
}

/// A circle of 10 mm in eighths.
fn eighths() -> Vec<Piece> {
    let Course::Arc(circle) = arc(10.0, TAU, 100.0).course else {
        unreachable!("it is an arc")
    };
    let reach = 4.0 / 3.0 * (TAU / 32.0).tan() * 10.0;
    let eighth = |k: u32| {
        let [begin, end] = [k, k + 1].map(|k| TAU * f64::from(k) / 8.0);
        let way = |angle: f64, by: f64| {
            let (point, along) = (circle.point(angle), circle.direction(angle));
            [0, 1, 2].map(|axis| point[axis] + by * along[axis])
        };
        spline(
            [
                way(begin, 0.0),
                way(begin, reach),
                way(end, -reach),
                way(end, 0.0),
            ],
            100.0,
        )
    };
    (0..8).map(eighth).collect()
}

/// Mean contour error of the models in mm, from 0.4 to 0.7 of the path.
fn mean_mm(run: &Run) -> f64 {
    let errors = run.measured().model;
    let length = run.program.path.length as f64;
    let steady = errors
        .deviations
        .iter()
        .filter(|one| (0.4..0.7).contains(&(one.length_mm * MM / length)))
        .map(|one| one.contour_mm);
    let all: Vec<f64> = steady.collect();
    all.iter().sum::<f64>() / all.len() as f64
}

#[test]
fn a_circle_of_splines_is_widened_as_an_arc_is() {
    let machine = [TwoMassParameters::default(); 2];
    let of = |pieces: &[Piece], correction| {
        let run = run([0.0; 3], pieces, &settings(), &machine, correction);
        mean_mm(&run)
    };
    let (arc, splines) = ([arc(10.0, TAU, 100.0)], eighths());
    let none = of(&splines, Correction::None);
    assert!(
        (none / of(&arc, Correction::None) - 1.0).abs() < 0.01,
        "{none}"
    );
    let steady = of(&splines, Correction::Steady);
    let by_arc = of(&arc, Correction::Steady);
    println!("none {none}, steady {steady}, on the arc {by_arc}");
    assert!(none > 0.08 && steady < 0.002, "{none}, {steady}");
    assert!((steady - by_arc).abs() < 5e-4, "{steady}, {by_arc}");
}

/// The correction is −c·v² times the second derivative beside the path, on a curve whose curvature
/// changes and changes its sign.
#[test]
fn what_is_added_is_the_acceleration_times_c() {
    let points = [
        [0.0; 3],
        [6.0, 14.0, 3.0],
        [14.0, -14.0, -5.0],
        [20.0, 0.0, 2.0],
    ];
    let pieces = [spline(points, 60.0)];
    let machine = [TwoMassParameters::default(); 3];
    let program = Program::of([0.0; 3], &pieces, &settings(), &machine, &Widths::FULL).unwrap();
    let c = program
        .tangential
        .radial_s2(&Widths::FULL, program.motion.period);
    let (mut checked, mut most, step) = (0, 0.0_f64, 4000.0);
    for (stretch, span) in program
        .path
        .stretches
        .iter()
        .zip(spans(&program.path, &program.motion))
    {
        for part in [0.2, 0.5, 0.8] {
            let at = stretch.begin as f64 + part * stretch.length as f64;
            let [before, here, after] = [-step, 0.0, step].map(|by| program.path.point(at + by));
            let bend = sub(sub(after, here), sub(here, before));
            let wanted = scale(bend, -c * span.speed * span.speed / (step * step));
            let [x, y, z, w] = program.path.looked_up(at, Correction::Steady);
            let added = sub([x, y, z], here);
            assert_eq!(w, 0.0);
            // The base is rounded to a guard unit, the bend by its differences.
            let off = distance(added, wanted);
            assert!(
                off < 2.0 + 1e-3 * distance(wanted, [0.0; 3]),
                "{added:?}, not {wanted:?}"
            );
            assert_eq!(program.path.looked_up(at, Correction::Vector)[..3], here);
            (checked, most) = (checked + 1, most.max(distance(added, [0.0; 3])));
        }
    }
    assert!(checked > 20, "{checked}");
    // 0.02 mm and more somewhere.
    assert!(most > 0.02 * MM, "{most}");
}
