//! The host side of the arc generator: paths, segments, records and their errors, against geometry
//! and integer arithmetic that know nothing of it.

mod bounds;
mod circles;
mod conventional;
mod drawings;
mod joints;
mod measures;
mod paths;
mod products;
mod records;
mod refusals;
mod scenario;
mod settings;

use motion_rtl::input::Point;
use motion_rtl::jobs::arc_generator::prepare::Timing;
use motion_rtl::jobs::arc_generator::prepared::{Prepared, Segment, Shape};
use motion_rtl::jobs::arc_generator::settings::ShortPieces;
use motion_rtl::path::circle::Circle;
use motion_rtl::path::pieces::{Course, Piece};
use proptest::prelude::*;

/// 1 ms, with so many samples in a blend.
fn timing(blend_samples: u64) -> Timing {
    Timing {
        sample_s: 1e-3,
        blend_samples,
        corner: 20f64.to_radians(),
        short_pieces: ShortPieces::Refuse,
        most_samples: (1 << 20) - 1,
    }
}

fn line(to: Point, speed: f64) -> Piece {
    Piece {
        course: Course::Line,
        to,
        speed,
        line: None,
    }
}

fn arc(from: Point, via: Point, to: Point, speed: f64) -> Piece {
    Piece {
        course: Course::Arc(Circle::through(from, via, to).unwrap()),
        to,
        speed,
        line: None,
    }
}

/// A path of one segment that the arithmetic is to be tested with.
fn single(shape: Shape, samples: u64) -> Prepared {
    Prepared {
        segments: vec![Segment {
            shape,
            samples,
            first_sample: 0,
            piece: 0,
            next_piece: None,
            ends_at_rest: false,
        }],
        pieces: Vec::new(),
        timing: timing(2),
    }
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn length(a: Point) -> f64 {
    (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]).sqrt()
}

fn inner(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Two unit vectors at right angles, and the one that makes them a right-handed system: u × v = w.
fn frames() -> impl Strategy<Value = [Point; 3]> {
    let number = || -1.0..1.0f64;
    let vector = move || (number(), number(), number()).prop_map(|(x, y, z)| [x, y, z]);
    (vector(), vector()).prop_filter_map("vectors that span a plane", |(a, b)| {
        let u = a.map(|x| x / length(a));
        let along = inner(b, u);
        let flat = [0, 1, 2].map(|k| b[k] - along * u[k]);
        if length(a) < 0.1 || length(flat) < 0.1 {
            return None;
        }
        let v = flat.map(|x| x / length(flat));
        let w = [
            u[1] * v[2] - u[2] * v[1],
            u[2] * v[0] - u[0] * v[2],
            u[0] * v[1] - u[1] * v[0],
        ];
        Some([u, v, w])
    })
}

/// A point of the circle that turns from u to v around a centre.
fn on_circle([u, v, _]: [Point; 3], centre: Point, radius: f64, angle: f64) -> Point {
    let (sin, cos) = angle.sin_cos();
    [0, 1, 2].map(|k| centre[k] + radius * (u[k] * cos + v[k] * sin))
}
