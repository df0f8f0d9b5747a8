//! Pieces as segments: what lies where, how fast, and that everything meets.

use super::*;
use motion_rtl::jobs::arc_generator::prepare::prepare;
use motion_rtl::jobs::arc_generator::prepared::{Kind, Place};
use motion_rtl::path::vector::{apply, rodrigues};
use std::f64::consts::TAU;

/// Velocity at the start and at the end of a segment, from its points alone.
fn velocities(segment: &Segment, timing: &Timing) -> [Point; 2] {
    let ts = timing.sample_s;
    match segment.shape {
        Shape::Blend {
            before,
            corner,
            behind,
        } => {
            let ta = ts * segment.samples as f64 / 2.0;
            [minus(corner, before), minus(behind, corner)].map(|way| way.map(|x| x / ta))
        }
        Shape::Line { from, to } => [minus(to, from).map(|x| x / (ts * segment.samples as f64)); 2],
        Shape::Arc { circle, from, step } => {
            [from, from + step * segment.samples as f64].map(|angle| {
                let vector = minus(circle.point(angle), circle.centre);
                let [x, y, z] = circle.axis;
                let [u, v, w] = vector;
                [y * w - z * v, z * u - x * w, x * v - y * u].map(|x| x * step / ts)
            })
        }
    }
}

/// Everything that holds for any path.
fn check(path: &Prepared) -> Result<(), TestCaseError> {
    let timing = &path.timing;
    let ta = timing.half_blend_s();
    for piece in &path.pieces {
        prop_assert!(piece.speed <= piece.wanted * (1.0 + 1e-9));
        prop_assert!(piece.samples >= 1);
        let least = piece.wanted * (1.0 - 1.0 / piece.samples as f64);
        prop_assert!(
            piece.speed >= least * (1.0 - 1e-6),
            "{} of {}",
            piece.speed,
            piece.wanted
        );
        let [entry, exit] = piece.between_blends();
        let reach = piece.speed * ta;
        prop_assert!((length(minus(entry, piece.from)) - reach).abs() < 1e-9 * (1.0 + reach));
        prop_assert!((length(minus(exit, piece.to)) - reach).abs() < 1e-9 * (1.0 + reach));
        if let Some(arc) = piece.arc {
            // From A⁺ by N rotations to C⁻.
            let matrix = rodrigues(arc.circle.axis, arc.step);
            let mut vector = minus(entry, arc.circle.centre);
            for _ in 0..piece.samples {
                vector = apply(&matrix, vector);
            }
            let last = [0, 1, 2].map(|k| arc.circle.centre[k] + vector[k]);
            // Each product of doubles rounds.
            let near = (1e-16 * arc.circle.radius * piece.samples as f64).max(1e-9);
            prop_assert!(length(minus(last, exit)) < near, "{last:?} {exit:?}");
            let speed = arc.step * arc.circle.radius / timing.sample_s;
            prop_assert!((speed / piece.speed - 1.0).abs() < 1e-9);
            let jump = (reach / (2.0 * arc.circle.radius)).asin();
            prop_assert!((arc.direction_jump - jump).abs() < 1e-12);
            let ratio = arc.blend_distance / arc.blend_distance_estimate;
            prop_assert!((1.0..1.08).contains(&ratio), "{ratio}");
        }
    }
    let start = path.pieces[0].from;
    prop_assert!(length(minus(path.segments[0].point(0), start)) < 1e-12);
    prop_assert_eq!(velocities(&path.segments[0], timing)[0], [0.0; 3]);
    let mut at = 0;
    for pair in path.segments.windows(2) {
        prop_assert_eq!(pair[0].first_sample, at);
        at += pair[0].samples;
        let gap = minus(pair[0].point(pair[0].samples), pair[1].point(0));
        prop_assert!(length(gap) < 1e-9, "{:?}", gap);
        let [ends, begins] = [
            velocities(&pair[0], timing)[1],
            velocities(&pair[1], timing)[0],
        ];
        let size = length(begins);
        prop_assert!(
            (length(ends) - size).abs() < 1e-6 * (1.0 + size),
            "speeds meet"
        );
        let arc = pair.iter().find(|segment| segment.kind() == Kind::Arc);
        // Directions meet but for the chord's on an arc.
        let jump = arc.map_or(0.0, |segment| {
            path.pieces[segment.piece].arc.unwrap().direction_jump
        });
        let wanted = 2.0 * size * (jump / 2.0).sin();
        let change = length(minus(ends, begins));
        prop_assert!(
            (change - wanted).abs() < 1e-6 * (1.0 + size),
            "{change} {wanted}"
        );
    }
    let last = path.segments.last().unwrap();
    prop_assert!(last.ends_at_rest);
    prop_assert_eq!(path.samples(), at + last.samples + 1);
    prop_assert_eq!(last.point(last.samples), path.pieces.last().unwrap().to);
    Ok(())
}

/// Pieces that go somewhere: a way, a bend of the way, a speed.
fn pieces() -> impl Strategy<Value = Vec<(Point, Option<f64>, f64)>> {
    let way = proptest::array::uniform3(-80.0..80.0f64)
        .prop_filter("a way that blends fit in", |way| length(*way) > 20.0);
    let bend = proptest::option::of(0.05..2.0f64);
    proptest::collection::vec((way, bend, 1.0..90.0f64), 1..6)
}

proptest! {
    #[test]
    fn paths_of_any_shape_meet(ways in pieces(), half in 1u64..40, corner in 0.0..180.0f64) {
        let mut from = [1.0, -2.0, 3.0];
        let mut path = Vec::new();
        for (way, bend, speed) in ways {
            let to = [0, 1, 2].map(|k| from[k] + way[k]);
            path.push(match bend {
                None => line(to, speed),
                Some(bend) => {
                    // Aside of the middle, at a right angle to the way in X-Y or X-Z.
                    let aside = match way[0].abs() + way[1].abs() > 1.0 {
                        true => [-way[1], way[0], 0.0],
                        false => [-way[2], 0.0, way[0]],
                    };
                    let size = bend * length(way) / length(aside);
                    let via = [0, 1, 2].map(|k| from[k] + way[k] / 2.0 + aside[k] * size);
                    arc(from, via, to, speed)
                }
            });
            from = to;
        }
        let timing = Timing {
            corner: corner.to_radians(),
            short_pieces: ShortPieces::Slower,
            ..timing(2 * half)
        };
        let made = prepare([1.0, -2.0, 3.0], &path, &timing).unwrap();
        // Where a piece had to be slower than wanted, that is what is wanted.
        let fits = path.iter().zip(&made.pieces).map(|(piece, report)| Piece {
            speed: match report.samples {
                1 => report.speed,
                _ => piece.speed.min(report.arc.map_or(f64::MAX, |arc| {
                    arc.circle.radius / timing.half_blend_s()
                })),
            },
            ..*piece
        });
        let fits: Vec<_> = fits.collect();
        let timing = Timing { short_pieces: ShortPieces::Refuse, ..timing };
        let made = prepare([1.0, -2.0, 3.0], &fits, &timing).unwrap();
        check(&made)?;
    }
}

#[test]
fn a_line_has_the_speed_at_which_its_samples_are_whole() {
    // 100 mm at 30 mm/s take 3333.3 ms and a blend: N + M = 3334.
    let path = prepare([0.0; 3], &[line([60.0, 80.0, 0.0], 30.0)], &timing(64)).unwrap();
    let piece = path.pieces[0];
    assert_eq!(piece.samples, 3334 - 64);
    assert!((piece.speed - 100.0 / 3.334).abs() < 1e-12);
    let kinds: Vec<_> = path.segments.iter().map(Segment::kind).collect();
    assert_eq!(kinds, [Kind::Blend, Kind::Line, Kind::Blend]);
    assert_eq!(path.samples(), 1 + 64 + 3270 + 64);
    // A whole number stays what it is.
    let path = prepare([0.0; 3], &[line([30.0, 0.0, 0.0], 30.0)], &timing(64)).unwrap();
    assert_eq!(path.pieces[0].samples, 1000 - 64);
    assert_eq!(path.pieces[0].speed, 30.0);
}

#[test]
fn an_arc_of_nearly_a_whole_turn_and_a_whole_one() {
    let around = |angle: f64| [10.0 * angle.cos(), 10.0 * angle.sin(), 5.0];
    let end = around(TAU - 0.4);
    let path = [arc(around(0.0), around(3.0), end, 20.0)];
    let path = prepare(around(0.0), &path, &timing(64)).unwrap();
    check(&path).unwrap();
    assert!((path.pieces[0].arc.unwrap().circle.angle - TAU + 0.4).abs() < 1e-12);
    let whole = Circle::around([0.0; 3], around(1.0), around(1.0), [0.0, 0.0, -1.0]).unwrap();
    let piece = Piece {
        course: Course::Arc(whole),
        ..line(around(1.0), 20.0)
    };
    let path = prepare(around(1.0), &[piece, piece], &timing(64)).unwrap();
    check(&path).unwrap();
    assert_eq!(path.segments.len(), 5, "two turns without a stop");
    assert!(path.pieces[0].arc.unwrap().circle.axis[2] == -1.0);
}

#[test]
fn corners_stop_or_blend_by_their_turn() {
    let corner = |turn: f64| {
        let to = [10.0 + 10.0 * turn.cos(), 10.0 * turn.sin(), 0.0];
        let path = [line([10.0, 0.0, 0.0], 30.0), line(to, 20.0)];
        let path = prepare([0.0; 3], &path, &timing(64)).unwrap();
        check(&path).unwrap();
        path
    };
    let blended = corner(19.9f64.to_radians());
    assert_eq!(blended.segments.len(), 5);
    let joint = blended.segments[2];
    assert_eq!((joint.piece, joint.next_piece), (0, Some(1)));
    assert!(!joint.ends_at_rest);
    let stopped = corner(20.1f64.to_radians());
    assert_eq!(stopped.segments.len(), 6);
    let rests: Vec<_> = stopped.segments.iter().map(|s| s.ends_at_rest).collect();
    assert_eq!(rests, [false, false, true, false, false, true]);
    // At half its time a blend is 3/16·|A⁻ − 2A + A⁺| from the corner, where it bends most.
    let at_half = length(minus(joint.point(32), [10.0, 0.0, 0.0]));
    assert!((joint.corner_distance().unwrap() - at_half).abs() < 1e-12);
    let second =
        [0, 1, 2].map(|k| joint.point(33)[k] - 2.0 * joint.point(32)[k] + joint.point(31)[k]);
    let peak = joint.peak_acceleration(&blended.timing).unwrap();
    assert!((length(second) * 1e6 / peak - 1.0).abs() < 1e-3);
    assert_eq!(blended.segments[1].corner_distance(), None);
}

#[test]
fn every_sample_has_its_place() {
    let (b, c) = ([20.0, 0.0, 0.0], [40.0, 20.0, 0.0]);
    let pieces = [line(b, 30.0), arc(b, [34.0, 6.0, 0.0], c, 25.0)];
    let path = prepare([0.0; 3], &pieces, &timing(16)).unwrap();
    let mut sample = 0;
    assert_eq!(
        path.place(0),
        Some(Place {
            segment: 0,
            step: 0
        })
    );
    for (index, segment) in path.segments.iter().enumerate() {
        for step in 1..=segment.samples {
            sample += 1;
            let place = Place {
                segment: index,
                step,
            };
            assert_eq!(path.place(sample), Some(place));
            assert_eq!(path.point(sample), Some(segment.point(step)));
        }
        assert_eq!(segment.end(), sample);
    }
    assert_eq!(path.samples(), sample + 1);
    assert_eq!(path.place(sample + 1), None);
    assert_eq!(path.point(sample + 1), None);
}
