//! The conventional method: on the circle all the time, at its price.

use super::*;
use motion_rtl::jobs::arc_generator::conventional::{
    Conventional, Operations, blend, blend_terms, difference_engines, rotation,
};
use motion_rtl::path::vector::rodrigues;

fn count(multiplications: u64, additions: u64, trigonometric: u64) -> Operations {
    Operations {
        multiplications,
        additions,
        trigonometric,
    }
}

fn quarter() -> Circle {
    let (a, b, c) = ([10.0, 0.0, 0.0], [6.0, 4.8, 6.4], [0.0, 6.0, 8.0]);
    Circle::through(a, b, c).unwrap()
}

#[test]
fn it_stays_on_the_circle_and_ends_at_the_end() {
    let circle = quarter();
    for (speed, blend) in [(30.0, 64), (5.0, 2), (200.0, 64), (1000.0, 128)] {
        let method = Conventional::new(&circle, speed, &timing(blend));
        let points: Vec<_> = method.samples().map(|(point, _)| point).collect();
        assert_eq!(points.len() as u64, 2 * method.ramp + method.samples + 1);
        assert!(method.speed <= speed);
        for point in &points {
            let [outside, height] = circle.off(*point);
            assert!(
                outside.abs() < 1e-9 && height.abs() < 1e-9,
                "{outside} {height}"
            );
        }
        assert_eq!(points[0], circle.start);
        assert!(length(minus(points[points.len() - 1], circle.end())) < 1e-9);
        // Speeds rise, stay, fall.
        let chords: Vec<_> = points
            .windows(2)
            .map(|p| length(minus(p[1], p[0])))
            .collect();
        let ramp = method.ramp as usize;
        let last = chords.len() - ramp;
        assert!(chords[..ramp].is_sorted());
        assert!(chords[last..].iter().rev().is_sorted());
        let step = 2.0 * circle.radius * (method.speed * 1e-3 / circle.radius / 2.0).sin();
        assert!(
            chords[ramp..last]
                .iter()
                .all(|chord| (chord - step).abs() < 1e-9)
        );
        assert!(chords[0] < step && chords[ramp - 1] <= step * (1.0 + 1e-9));
    }
}

#[test]
fn operations_are_counted_as_they_are_made() {
    let circle = quarter();
    let method = Conventional::new(&circle, 30.0, &timing(64));
    let counts: Vec<_> = method.samples().map(|(_, count)| count).collect();
    // Rodrigues: 12 products, 10 sums; the vector: 9 and 6; the centre: 3; Δθ: 1.
    let always = count(21, 20, 2);
    let ramp = always + count(5, 1, 0);
    let (first, last) = (64, 64 + method.samples as usize);
    assert_eq!(counts[0], count(0, 0, 0));
    assert!(counts[1..=first].iter().all(|&c| c == ramp));
    assert!(
        counts[first + 1..=last]
            .iter()
            .all(|&c| c == always + count(1, 1, 0))
    );
    assert!(
        counts[last + 1..counts.len() - 1]
            .iter()
            .all(|&c| c == ramp + count(0, 1, 0))
    );
}

#[test]
fn the_patent_rotates_by_a_constant_matrix() {
    let circle = quarter();
    let matrix = rodrigues(circle.axis, 0.01);
    let mut vector = minus(circle.start, circle.centre);
    for n in 1..=100 {
        let (point, cost) = rotation(&matrix, &mut vector, circle.centre);
        assert_eq!(cost, count(9, 9, 0));
        assert!(length(minus(point, circle.point(0.01 * f64::from(n)))) < 1e-12);
    }
}

#[test]
fn the_patent_blends_by_its_equation() {
    let (before, corner, behind) = ([1.0, 2.0, 3.0], [4.0, 0.0, -1.0], [2.0, 2.0, 7.0]);
    let path = single(
        Shape::Blend {
            before,
            corner,
            behind,
        },
        64,
    );
    let terms = blend_terms(before, corner, behind);
    for n in 0..=64 {
        let (point, cost) = blend(&terms, n as f64 / 64.0);
        assert_eq!(cost, count(9, 7, 0));
        assert!(length(minus(point, path.segments[0].point(n))) < 1e-12);
    }
    // A column: sum of the parts, comparison with the modulus, their difference, sum of the wholes,
    // carry; four of them a coordinate, and what rounds.
    assert_eq!(difference_engines().unwrap(), count(0, 3 * (4 * 5 + 2), 0));
}
