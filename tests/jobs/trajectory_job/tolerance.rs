//! The feed that keeps models, with nothing added, within a contour error (¶0004).

use super::*;
use motion_rtl::jobs::trajectory_controller::each_axis::EachAxis;
use motion_rtl::path::cubic::Cubic;
use motion_rtl::path::helix::Helix;
use std::f64::consts::TAU;

const TOLERANCE_MM: f64 = 0.02;

fn limited() -> Settings {
    Settings {
        contour_tolerance_mm: Some(TOLERANCE_MM),
        ..settings()
    }
}

/// The acceleration across the path that makes it, by c of the note.
fn acceleration() -> f64 {
    let [k1, k2] = [1638.0, 6554.0].map(|word| word / 32_768.0 / 1e-3);
    TOLERANCE_MM / (0.5 * (1.0 / (k1 * k1) - 1e-3 / k1 - 2.0 / (k1 * k2)))
}

fn uncorrected(pieces: &[Piece]) -> Run {
    let machine = [TwoMassParameters::default(); 3];
    run([0.0; 3], pieces, &limited(), &machine, Correction::None)
}

/// Arcs, helices, splines and chords whose curvature is the same all the way have the error that is
/// allowed once they run steadily, and never more.
#[test]
#[ignore = "takes long"]
fn the_error_of_a_steady_curve_is_the_tolerance() {
    let whole = arc(10.0, TAU, 100.0);
    let Course::Arc(circle) = whole.course else {
        unreachable!("it is an arc")
    };
    let helix = Helix { circle, rise: 20.0 };
    let climb = Piece {
        course: Course::Helix(helix),
        to: helix.point(1.0),
        ..whole
    };
    let at = |k: u32| circle.point(TAU * f64::from(k) / 360.0);
    let spline = |k: u32| {
        // Control points of an eighth of the circle.
        let reach = 4.0 / 3.0 * (TAU / 32.0).tan() * 10.0;
        let way = |k: u32, by: f64| {
            let (point, along) = (at(k), circle.direction(TAU * f64::from(k) / 360.0));
            [0, 1, 2].map(|axis| point[axis] + by * along[axis])
        };
        let points = [at(k), way(k, reach), way(k + 45, -reach), at(k + 45)];
        Piece {
            course: Course::Spline(Cubic { points }),
            ..line(points[3], 100.0)
        }
    };
    let splines: Vec<_> = (0..8).map(|k| spline(45 * k)).collect();
    // Chords of a degree, 0.4 um below the arc at most.
    let chords: Vec<_> = (1..=360).map(|k| line(at(k), 100.0)).collect();
    let kinds: [(&str, &[Piece], f64); 4] = [
        ("arc", &[whole], 10.0),
        ("helix", &[climb], helix.curvature_radius()),
        ("splines", &splines, 10.0),
        ("chords", &chords, 10.0),
    ];
    for (kind, pieces, radius) in kinds {
        let run = uncorrected(pieces);
        let errors = run.measured().model;
        let speed = (acceleration() * radius).sqrt();
        let length = run.program.path.length as f64;
        let planned = run.program.profile.at(run.program.profile.duration / 2.0)[1] / MM;
        assert!(
            (planned / speed - 1.0).abs() < 0.01,
            "{kind}: {planned}, not {speed}"
        );
        let steady = errors
            .deviations
            .iter()
            .filter(|one| (0.4..0.7).contains(&(one.length_mm * MM / length)));
        let (sum, count) = steady.fold((0.0, 0), |(sum, count), one| {
            (sum + one.contour_mm, count + 1)
        });
        let mean = sum / f64::from(count) / TOLERANCE_MM;
        println!(
            "{kind}: {:.3} um, {mean:.4} of it steadily",
            errors.contour_max_um
        );
        assert!(mean > 0.96 && mean <= 1.0, "{kind}: {mean}");
        assert!(
            errors.contour_max_um <= TOLERANCE_MM * 1020.0,
            "{kind}: {:?}",
            errors.contour_max_um
        );
    }
}

/// Where the feed is below the limit, and on lines, all is as without a tolerance.
#[test]
fn what_is_within_it_is_run_at_feed() {
    let corner = [
        line([20.0, 0.0, 0.0], 100.0),
        line([20.0, 20.0, 0.0], 100.0),
        line([24.0, 40.0, 0.0], 100.0),
    ];
    let machine = [TwoMassParameters::default(); 2];
    let slow = 0.999 * (acceleration() * 10.0).sqrt();
    for pieces in [&corner[..], &[arc(10.0, 3.0, slow)]] {
        let plan = |settings: &Settings| {
            Program::of([0.0; 3], pieces, settings, &machine, &Widths::FULL).unwrap()
        };
        assert_eq!(plan(&limited()).profile, plan(&settings()).profile);
    }
    // A little faster, and it is limited.
    let pieces = [arc(10.0, 3.0, 1.01 * slow)];
    let program = Program::of([0.0; 3], &pieces, &limited(), &machine, &Widths::FULL).unwrap();
    let highest = program.profile.pieces.iter().map(|piece| piece.v / MM);
    let highest = highest.fold(0.0, f64::max);
    assert!((highest / slow - 1.0 / 0.999).abs() < 1e-6, "{highest}");
}

#[test]
fn a_tolerance_that_does_not_hold_is_refused() {
    let machine = [TwoMassParameters::default(); 2];
    let refused = |change: &dyn Fn(&mut Settings), text: &str| {
        let mut settings = limited();
        change(&mut settings);
        let pieces = [arc(10.0, 1.0, 100.0)];
        let program = Program::of([0.0; 3], &pieces, &settings, &machine, &Widths::FULL);
        assert_eq!(program.unwrap_err().to_string(), text);
        assert_eq!(
            settings.validate(&Widths::FULL).unwrap_err().to_string(),
            text
        );
    };
    for (mm, is) in [
        (0.0, "0"),
        (-0.1, "-0.1"),
        (f64::NAN, "NaN"),
        (1001.0, "1001"),
    ] {
        let text = format!("contour_tolerance_mm: is {is}; allowed: 0.000001 to 1000");
        refused(&|settings| settings.contour_tolerance_mm = Some(mm), &text);
    }
    refused(
        &|settings| settings.k1_per_s = EachAxis::Each(vec![50.0, 49.0]),
        "contour_tolerance_mm: is 0.02 beside models that differ; allowed: the same k1_per_s and \
         k2_per_s for all axes",
    );
    refused(
        &|settings| (settings.k2_per_s, settings.allow_overshoot) = (150.0.into(), true),
        "contour_tolerance_mm: is 0.02 beside models that overshoot; allowed: k2_per_s of 4 times \
         k1_per_s or more",
    );
}
