//! Every refusal, with its text; and that what is said to be allowed is.

use super::*;
use motion_rtl::circuits::arc_generator::{Rounding, Widths};
use motion_rtl::jobs::arc_generator::prepare::prepare;
use motion_rtl::jobs::arc_generator::record::records;
use motion_rtl::jobs::arc_generator::settings::Settings;
use motion_rtl::path::error::PathError;
use motion_rtl::path::pieces::{Taught, from_points};

const A: Point = [0.0; 3];
const B: Point = [3.0, 3.0, 0.0];
const C: Point = [6.0, 0.0, 0.0];

fn refusal(pieces: &[Piece]) -> PathError {
    prepare(A, pieces, &timing(64)).unwrap_err()
}

/// The speed that a refusal allows.
fn allowed_speed(error: &PathError) -> f64 {
    let allowed = error.reason.allowed();
    let rest = allowed.strip_prefix("at most ").unwrap();
    rest.split(' ').next().unwrap().parse::<f64>().unwrap() / 60.0
}

#[test]
fn an_empty_path() {
    let error = refusal(&[]);
    assert_eq!(
        error.to_string(),
        "piece 0: the path is empty; allowed: one piece or more"
    );
    assert_eq!(error.reason.field(), "piece");
}

#[test]
fn a_piece_without_length() {
    let error = refusal(&[line(C, 5.0), line(C, 5.0)]);
    assert_eq!(
        error.to_string(),
        "piece 1: start and end are the same point; allowed: points apart"
    );
    assert_eq!(
        (error.reason.field(), error.reason.word()),
        ("to_mm", "arc")
    );
}

#[test]
fn a_speed_that_is_none() {
    for (speed, shown) in [
        (0.0, "0"),
        (-1.0, "-60"),
        (f64::NAN, "NaN"),
        (f64::INFINITY, "inf"),
    ] {
        let error = refusal(&[line(C, speed)]);
        assert_eq!(
            error.to_string(),
            format!("piece 0: is {shown} mm/min; allowed: a speed above 0")
        );
        assert_eq!(
            (error.reason.field(), error.reason.word()),
            ("feed_mm_per_min", "F")
        );
    }
}

#[test]
fn a_coordinate_that_is_no_number() {
    let error = refusal(&[line([1.0, f64::NAN, 0.0], 5.0)]);
    assert_eq!(error.to_string(), "piece 0: y is NaN; allowed: a number");
    assert_eq!((error.reason.field(), error.reason.word()), ("to_mm", "y"));
}

#[test]
fn an_arc_off_the_path() {
    let elsewhere = arc([0.0, 1.0, 0.0], B, C, 5.0);
    assert_eq!(
        refusal(&[elsewhere]).to_string(),
        "piece 0: the curve is 1 mm off the path's points; allowed: a curve from the end of the \
         piece before to its own end"
    );
}

#[test]
fn a_speed_too_high_for_the_radius() {
    // 3 mm of radius: v·ta = 3 mm at 93.75 mm/s, but the blends of half a turn end at 60° each.
    let whole = Circle::around([3.0, 0.0, 0.0], A, A, [0.0, 0.0, 1.0]).unwrap();
    let piece = |speed| Piece {
        course: Course::Arc(whole),
        line: Some(12),
        ..line(A, speed)
    };
    let error = refusal(&[piece(100.0)]);
    assert_eq!(
        error.to_string(),
        "piece 0 (line 12): at 6000 mm/min a blend reaches 3.2 mm along an arc of 3 mm radius; \
         allowed: at most 5625 mm/min, whose blends reach no farther than the radius"
    );
    assert_eq!(error.reason.field(), "feed_mm_per_min");
    let path = prepare(A, &[piece(allowed_speed(&error))], &timing(64)).unwrap();
    assert!(path.pieces[0].speed <= 93.75);
    // A short arc says what fits in it.
    let error = refusal(&[arc(A, B, C, 200.0)]);
    let path = prepare(A, &[arc(A, B, C, allowed_speed(&error))], &timing(64)).unwrap();
    assert!(path.pieces[0].speed > 0.97 * allowed_speed(&error));
}

#[test]
fn blends_that_overlap_on_a_line() {
    // 6 mm in 64 + 1 samples.
    let error = refusal(&[line(C, 100.0)]);
    assert_eq!(
        error.to_string(),
        "piece 0: at 6000 mm/min the blends at its ends take more than the piece, 6 mm; \
         allowed: at most 5538.46 mm/min, or shorter blends"
    );
    let path = prepare(A, &[line(C, allowed_speed(&error))], &timing(64)).unwrap();
    assert!(
        path.pieces[0].samples <= 2,
        "what is printed is rounded down"
    );
    // Between that and 6 mm in 64 samples one sample is left, and the speed is that.
    let path = prepare(A, &[line(C, 93.0)], &timing(64)).unwrap();
    assert_eq!(path.pieces[0].samples, 1);
    assert!((path.pieces[0].speed - 6000.0 / 65.0).abs() < 1e-9);
}

#[test]
fn blends_that_overlap_on_an_arc() {
    // A flat arc: 6 mm over a sagitta of 0.1 mm.
    let flat = |speed| arc(A, [3.0, 0.1, 0.0], C, speed);
    let error = refusal(&[flat(100.0)]);
    assert!(error.to_string().starts_with(
        "piece 0: at 6000 mm/min the blends at its ends take more than the piece, 6.00444"
    ));
    let most = allowed_speed(&error);
    let path = prepare(A, &[flat(most)], &timing(64)).unwrap();
    assert!(path.pieces[0].samples <= 2);
    assert!((path.pieces[0].speed / most - 1.0).abs() < 0.02);
}

#[test]
fn short_pieces_can_be_run_slower() {
    let slower = Timing {
        short_pieces: ShortPieces::Slower,
        ..timing(64)
    };
    let pieces = [arc(A, B, C, 200.0), line([6.0, 0.0, 1.0], 100.0)];
    let path = prepare(A, &pieces, &slower).unwrap();
    assert_eq!(path.pieces[1].samples, 1);
    assert!((path.pieces[1].speed - 1000.0 / 65.0).abs() < 1e-9);
    assert!(path.pieces[0].speed <= 93.75);
}

#[test]
fn too_many_samples() {
    let error = refusal(&[line([4000.0, 0.0, 0.0], 1.0)]);
    assert_eq!(
        error.to_string(),
        "piece 0: takes 3999936 samples at 60 mm/min; allowed: at most 1048575 samples: faster, \
         shorter, or sampled less often"
    );
    let slow = refusal(&[line([4000.0, 0.0, 0.0], 1e-300)]);
    assert!(slow.to_string().contains("samples at"));
}

fn reach(pieces: &[Piece], counts_per_mm: f64, widths: &Widths) -> PathError {
    let path = prepare(A, pieces, &timing(4)).unwrap();
    records(&path, counts_per_mm, widths, Rounding::Nearest).unwrap_err()
}

#[test]
fn a_coordinate_too_far() {
    let error = reach(
        &[line(C, 5.0), line([0.0, 0.0, -8400.0], 900.0)],
        1000.0,
        &Widths::FULL,
    );
    // A⁺ of the last blend: v·ta before the end.
    assert_eq!(
        error.to_string(),
        "piece 1: z reaches -8398200.1 counts, which needs W = 25; allowed: -8388607 to 8388607 \
         counts at W = 24: fewer counts per mm"
    );
    assert_eq!((error.reason.field(), error.reason.word()), ("to_mm", "z"));
    // The farthest that fits does.
    let path = prepare(A, &[line([8388.607, 0.0, 0.0], 900.0)], &timing(4)).unwrap();
    assert!(records(&path, 1000.0, &Widths::FULL, Rounding::Nearest).is_ok());
    let path = prepare(A, &[line([8388.608, 0.0, 0.0], 900.0)], &timing(4)).unwrap();
    assert!(records(&path, 1000.0, &Widths::FULL, Rounding::Nearest).is_err());
    assert!(
        reach(&[line([20.0, 0.0, 0.0], 100.0)], 1.0, &Widths::narrow(4))
            .to_string()
            .contains("needs W = 6")
    );
}

#[test]
fn a_radius_a_centre_and_an_arc_too_far() {
    // Radius 450 mm: 450,000 counts, but at 20,000 counts/mm 9,000,000.
    let flat = [arc(A, [3.0, 0.01, 0.0], C, 5.0)];
    assert!(
        reach(&flat, 20_000.0, &Widths::FULL)
            .to_string()
            .contains("radius reaches 9000100.")
    );
    // The centre is too far while the radius is not.
    let path = prepare(
        [8000.0, 0.0, 0.0],
        &[arc(
            [8000.0, 0.0, 0.0],
            [7979.0, 210.0, 0.0],
            [7920.0, 400.0, 0.0],
            50.0,
        )],
        &timing(4),
    );
    let path = path.unwrap();
    assert!(records(&path, 1000.0, &Widths::FULL, Rounding::Nearest).is_ok());
    let bent = prepare(
        [8000.0, 0.0, 0.0],
        &[arc(
            [8000.0, 0.0, 0.0],
            [8021.0, 210.0, 0.0],
            [8080.0, 400.0, 0.0],
            50.0,
        )],
        &timing(4),
    );
    let error = records(&bent.unwrap(), 1000.0, &Widths::FULL, Rounding::Nearest).unwrap_err();
    assert!(error.to_string().contains("centre x reaches 9"), "{error}");
    assert!(error.to_string().contains("needs W = 25"));
    // Both ends are within reach, the arc between is not.
    let ends = [
        [8380.0, -100.0, 0.0],
        [8390.0, 0.0, 0.0],
        [8380.0, 100.0, 0.0],
    ];
    let round = prepare(ends[0], &[arc(ends[0], ends[1], ends[2], 50.0)], &timing(4));
    let error = records(&round.unwrap(), 1000.0, &Widths::FULL, Rounding::Nearest).unwrap_err();
    assert!(error.to_string().contains("x reaches 8390000."), "{error}");
}

#[test]
fn taught_points_that_make_no_piece() {
    let settings = Settings::default();
    let taught = |via, speed| {
        [Taught {
            to: C,
            via,
            spline: false,
            speed,
        }]
    };
    let text = |points: &[Taught]| from_points(A, points, &settings).unwrap_err();
    let error = text(&taught(None, None));
    assert_eq!(
        error.to_string(),
        "piece 0: missing; allowed: a speed of the piece, or one for all"
    );
    let error = text(&taught(Some([2.0, 0.0, 0.0]), Some(5.0)));
    assert_eq!(
        error.to_string(),
        "piece 0: the point via is only 0 mm off the line from start to end, 6 mm long; \
         allowed: a point off the line, or a line: no point via"
    );
    assert_eq!(error.reason.field(), "via_mm");
    assert_eq!(text(&taught(Some(C), Some(5.0))).reason.field(), "via_mm");
    assert_eq!(text(&taught(Some(A), Some(5.0))).reason.field(), "via_mm");
    let settings = Settings {
        feed_mm_per_min: Some(480.0),
        ..settings
    };
    let pieces = from_points(A, &taught(Some(B), None), &settings).unwrap();
    assert_eq!((pieces[0].speed, pieces[0].to), (8.0, C));
    let own = from_points(A, &taught(None, Some(3.0)), &settings).unwrap();
    assert_eq!(own[0], line(C, 3.0));
}
