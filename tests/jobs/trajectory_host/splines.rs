//! Splines as segments: their words, as the circuit reads them, against the curves; curves through
//! points.

use super::config;
use super::segments::read;
use motion_rtl::circuits::trajectory_controller::Widths;
use motion_rtl::jobs::trajectory_controller::segments::{Path, Stretch};
use motion_rtl::jobs::trajectory_controller::splines::{DEVIATION_COUNTS, SPEED};
use motion_rtl::path::cubic::Cubic;
use motion_rtl::path::pieces::{Course, Piece};
use proptest::prelude::*;
use std::f64::consts::TAU;

type Vector = [f64; 3];

/// Guard units of a count, and of a millimetre.
const COUNT: f64 = 65_536.0;
const UNIT: f64 = 1000.0 * COUNT;

/// Chords of a curve that is looked at from outside.
const CHORDS: usize = 20_000;

fn spline(points: [Vector; 4]) -> Piece {
    Piece {
        course: Course::Spline(Cubic { points }),
        to: points[3],
        speed: 10.0,
        line: None,
    }
}

fn sub(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn dot(a: Vector, b: Vector) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn off(a: Vector, b: Vector) -> f64 {
    dot(sub(a, b), sub(a, b)).sqrt()
}

/// A point by de Casteljau's construction, in guard units.
fn constructed(points: [Vector; 4], t: f64) -> Vector {
    let mut left: Vec<Vector> = points.to_vec();
    while left.len() > 1 {
        let between =
            |pair: &[Vector]| [0, 1, 2].map(|k| pair[0][k] + (pair[1][k] - pair[0][k]) * t);
        left = left.windows(2).map(between).collect();
    }
    left[0].map(|mm| mm * UNIT)
}

/// The curve as chords, and where each begins along them.
struct Chords {
    points: Vec<Vector>,
    lengths: Vec<f64>,
    /// Largest distance of the chords from the spline: an eighth of the second derivative, over
    /// their number squared.
    coarse: f64,
}

impl Chords {
    fn of(points: [Vector; 4]) -> Self {
        let bend = |k: usize| {
            [0, 1, 2].map(|axis| {
                let [p, q, r] = [k, k + 1, k + 2].map(|at| points[at][axis]);
                p - 2.0 * q + r
            })
        };
        let bend = off(bend(0), [0.0; 3]).max(off(bend(1), [0.0; 3]));
        let coarse = 6.0 * bend * UNIT / (8.0 * (CHORDS * CHORDS) as f64);
        let at = |k: usize| constructed(points, k as f64 / CHORDS as f64);
        let points: Vec<Vector> = (0..=CHORDS).map(at).collect();
        let mut length = 0.0;
        let lengths = points.windows(2).map(|pair| {
            length += off(pair[0], pair[1]);
            length
        });
        let lengths = std::iter::once(0.0).chain(lengths).collect();
        Chords {
            points,
            lengths,
            coarse,
        }
    }

    fn length(&self) -> f64 {
        self.lengths[CHORDS]
    }

    /// Distance of a point from the chords within so much of a length.
    fn off(&self, point: Vector, length: f64, within: f64) -> f64 {
        let first = self.lengths.partition_point(|at| *at < length - within);
        let behind = self.lengths.partition_point(|at| *at <= length + within);
        let pairs = self.points[first.saturating_sub(1)..(behind + 1).min(CHORDS + 1)].windows(2);
        let distances = pairs.map(|pair| {
            let (way, to) = (sub(pair[1], pair[0]), sub(point, pair[0]));
            let square = dot(way, way);
            let part = if square > 0.0 {
                dot(to, way) / square
            } else {
                0.0
            };
            let part = part.clamp(0.0, 1.0);
            off(to, way.map(|one| one * part))
        });
        distances.fold(f64::INFINITY, f64::min)
    }
}

/// The first derivative of a stretch's words, by a difference over its middle parts.
fn slope(stretch: &Stretch, at: u64, by: u64) -> Vector {
    let [back, on] = [at - by, at + by].map(|at| stretch.segment.point(at as f64));
    sub(on, back).map(|one| one / (2 * by) as f64)
}

/// Checks the properties of every path of one spline; returns its number of segments.
fn check(points: [Vector; 4], parts: &[f64]) -> Result<usize, TestCaseError> {
    let path = Path::of(points[0], &[spline(points)], 1000.0, &Widths::FULL);
    let path = path.map_err(|error| TestCaseError::fail(error.to_string()))?;
    let chords = Chords::of(points);
    // The error of the chords is far below the one under test.
    let long = (path.length as f64 - chords.length()).abs();
    let segments = path.stretches.len();
    prop_assert!(
        long <= 0.5 * segments as f64 + 2e-6 * chords.length() + 2.0,
        "{} of {}",
        long,
        chords.length()
    );
    let (mut begin, mut before) = (0, None::<Stretch>);
    for stretch in &path.stretches {
        prop_assert_eq!(stretch.begin, begin);
        begin += stretch.length;
        let words = stretch.segment.words(&Widths::FULL);
        prop_assert!(words.iter().all(|word| word >> 55 == 0));
        let length = stretch.length as f64;
        let rounding = 2.0 + 3.0 * length / 2f64.powi(41);
        let bound = DEVIATION_COUNTS * COUNT + rounding + chords.coarse;
        for part in [0.0, 0.5, 1.0].into_iter().chain(parts.iter().copied()) {
            let offset = (length * part).round();
            let point = read(&words, offset as u64);
            // Along the curve it may be as much off.
            let at = stretch.begin as f64 + offset;
            let off_curve = chords.off(point, at, 2.0 * bound + 1e-4 * chords.length());
            prop_assert!(
                off_curve <= bound,
                "{}: {} off, not {}",
                at,
                off_curve,
                bound
            );
            prop_assert!(off(stretch.segment.point(offset), point) <= rounding);
        }
        if let Some(before) = before.replace(*stretch) {
            let last = before.segment.point(before.length as f64);
            prop_assert!(off(last, stretch.segment.point(0.0)) <= 1e-3, "a jump");
            let turn = off(before.directions[1], stretch.directions[0]);
            let smooth = before.segment.powers.is_some() && stretch.segment.powers.is_some();
            // But where the curve itself turns back.
            prop_assert!(
                !smooth || turn == 0.0 || turn > 1.99,
                "a corner of {}",
                turn
            );
        }
        if stretch.segment.powers.is_some() && stretch.length > 4096 {
            // A stretch has its stated length everywhere, and at most its stated curvature.
            for at in [
                stretch.length / 4,
                stretch.length / 2,
                stretch.length / 4 * 3,
            ] {
                let by = stretch.length / 8;
                let speed = off(slope(stretch, at, by), [0.0; 3]);
                let uneven = (speed - 1.0).abs();
                prop_assert!(uneven < 2.0 * SPEED + 3.0 / length, "{} at {}", speed, at);
                let [back, on] = [at - by / 2, at + by / 2].map(|at| slope(stretch, at, by / 2));
                let bend = off(back, on) / by as f64 * UNIT;
                let most = stretch.radius.map_or(0.0, f64::recip);
                prop_assert!(bend <= most * (1.0 + 1e-6) + 1e-4, "{} and {}", bend, most);
            }
        }
    }
    prop_assert_eq!(begin, path.length);
    let ends = [path.point(0.0), path.point(path.length as f64)];
    for (end, exact) in ends.into_iter().zip([points[0], points[3]]) {
        prop_assert!(off(end, exact.map(|mm| mm * UNIT)) < 1.0);
    }
    Ok(segments)
}

proptest! {
    #![proptest_config(config(60))]

    #[test]
    fn every_spline_is_its_segments(
        controls in prop::array::uniform4(prop::array::uniform3(-1.0..1.0f64)),
        size in -2.0..2.5f64,
        flat in any::<bool>(),
        parts in prop::array::uniform4(0.0..1.0f64),
    ) {
        let size = 10f64.powf(size);
        let points = controls.map(|[x, y, z]| [x, y, if flat { 0.0 } else { z }].map(|one| one * size));
        check(points, &parts)?;
    }
}

#[test]
fn splines_with_corners_loops_and_no_curve() {
    let parts = [0.1, 0.3, 0.7, 0.9];
    let flat = |points: [[f64; 2]; 4]| points.map(|[x, y]| [x, y, 0.0]);
    for (what, points) in [
        (
            "straight",
            flat([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]]),
        ),
        (
            "straight, unevenly",
            flat([[0.0, 0.0], [0.1, 0.0], [0.2, 0.0], [3.0, 0.0]]),
        ),
        (
            "from a control point",
            flat([[0.0, 0.0], [0.0, 0.0], [2.0, 3.0], [4.0, 0.0]]),
        ),
        (
            "to a control point",
            flat([[0.0, 0.0], [2.0, 3.0], [4.0, 0.0], [4.0, 0.0]]),
        ),
        (
            "a loop",
            flat([[0.0, 0.0], [9.0, 9.0], [-9.0, 9.0], [0.0, 0.0]]),
        ),
        (
            "a cusp",
            flat([[0.0, 0.0], [3.0, 3.0], [0.0, 3.0], [3.0, 0.0]]),
        ),
        (
            "there and back",
            flat([[0.0, 0.0], [4.0, 0.0], [4.0, 0.0], [0.0, 0.0]]),
        ),
        (
            "an S",
            flat([[0.0, 0.0], [5.0, 0.0], [0.0, 5.0], [5.0, 5.0]]),
        ),
        (
            "a micrometre",
            flat([[0.0, 0.0], [0.0, 0.001], [0.001, 0.001], [0.001, 0.0]]),
        ),
    ] {
        let segments = check(points, &parts).unwrap_or_else(|error| panic!("{what}: {error}"));
        println!("{what}: {segments} segments");
        assert!(segments < 400, "{what}: {segments}");
    }
    // Nothing at all has no segment.
    let still = Path::of([1.0; 3], &[spline([[1.0; 3]; 4])], 1000.0, &Widths::FULL);
    assert!(still.unwrap_err().to_string().contains("the path is empty"));
}

#[test]
fn a_quarter_of_a_circle_takes_the_segments_that_its_radius_asks_for() {
    // 10 mm, by the usual control points: the radius is off by 0.03 %.
    let k = 10.0 * 0.552_284_75;
    let points = [[10.0, 0.0], [10.0, k], [k, 10.0], [0.0, 10.0]].map(|[x, y]| [x, y, 0.0]);
    let path = Path::of(points[0], &[spline(points)], 1000.0, &Widths::FULL).unwrap();
    // l⁴/384r³ = 0.01 count at l = 1.4 mm, half of that is asked for, and parts are halves.
    assert_eq!(path.stretches.len(), 18);
    for stretch in &path.stretches {
        let radius = stretch.radius.unwrap();
        assert!((radius / 10.0 - 1.0).abs() < 0.02, "{radius}");
    }
}

#[test]
fn splines_that_do_not_fit_are_refused() {
    let refused = |points: [Vector; 4], widths: &Widths| {
        let error = Path::of(points[0], &[spline(points)], 1000.0, widths);
        error.unwrap_err().to_string()
    };
    // Between its ends.
    let far = [
        [0.0; 3],
        [0.0, 1.5e6, 0.0],
        [10.0, 1.5e6, 0.0],
        [10.0, 0.0, 0.0],
    ];
    assert_eq!(
        refused(far, &Widths::FULL),
        "piece 0: y reaches 1125000000.0 counts, which needs W = 32; \
         allowed: -1073741823 to 1073741823 counts at W = 31: fewer counts per mm"
    );
    let half = far.map(|[x, y, z]| [x, y / 2.0, z]);
    assert!(refused(half, &Widths::FULL).contains("y from the start reaches 562500000.0"));
    let bent = [
        [0.0; 3],
        [0.0, 10.0, 0.0],
        [10.0, 10.0, 0.0],
        [10.0, 0.0, 0.0],
    ];
    let few = Widths {
        segment: 2,
        ..Widths::FULL
    };
    let text = refused(bent, &few);
    assert!(
        text.contains("segments, which take addresses of A = "),
        "{text}"
    );
    let mut elsewhere = spline(bent);
    elsewhere.to = [10.0, 1.0, 0.0];
    let error = Path::of([0.0; 3], &[elsewhere], 1000.0, &Widths::FULL).unwrap_err();
    assert!(
        error.to_string().contains("1 mm off the path's points"),
        "{error}"
    );
}

/// Derivatives by the chord's length at the start and the end of a cubic: first and second.
fn derivatives(cubic: &Cubic) -> [[Vector; 2]; 2] {
    let [a, b, c, d] = cubic.points;
    let chord = off(a, d);
    let first = |from: Vector, to: Vector| sub(to, from).map(|one| 3.0 * one / chord);
    let second = |p: Vector, q: Vector, r: Vector| {
        [0, 1, 2].map(|k| 6.0 * (p[k] - 2.0 * q[k] + r[k]) / (chord * chord))
    };
    [
        [first(a, b), second(a, b, c)],
        [first(c, d), second(b, c, d)],
    ]
}

proptest! {
    #![proptest_config(config(200))]

    #[test]
    fn a_curve_through_points_meets_in_both_derivatives(
        points in prop::collection::vec(prop::array::uniform3(-10.0..10.0f64), 2..12),
        closed in any::<bool>(),
    ) {
        let mut points = points;
        if closed && points.len() > 3 {
            points.push(points[0]);
        }
        prop_assume!(points.windows(2).all(|pair| off(pair[0], pair[1]) > 1e-3));
        let cubics = Cubic::through(&points);
        prop_assert_eq!(cubics.len(), points.len() - 1);
        let size = cubics.iter().flat_map(derivatives_flat).fold(1.0, f64::max);
        let near = |a: Vector, b: Vector| off(a, b) < 1e-9 * size;
        for (cubic, pair) in cubics.iter().zip(points.windows(2)) {
            prop_assert_eq!([cubic.points[0], cubic.points[3]], [pair[0], pair[1]]);
        }
        let ends = [derivatives(&cubics[0])[0], derivatives(&cubics[cubics.len() - 1])[1]];
        let meets = cubics.windows(2).map(|pair| [derivatives(&pair[0])[1], derivatives(&pair[1])[0]]);
        let is_closed = points[0] == points[points.len() - 1] && cubics.len() > 2;
        for [one, other] in meets.chain(is_closed.then_some([ends[1], ends[0]])) {
            prop_assert!(near(one[0], other[0]) && near(one[1], other[1]), "{:?} {:?}", one, other);
        }
        if !is_closed {
            prop_assert!(ends.iter().all(|[_, second]| near(*second, [0.0; 3])));
        }
    }
}

fn derivatives_flat(cubic: &Cubic) -> Vec<f64> {
    derivatives(cubic)
        .into_iter()
        .flatten()
        .map(|one| off(one, [0.0; 3]))
        .collect()
}

#[test]
fn a_closed_curve_through_points_of_a_circle_is_nearly_it() {
    let on = |k: usize| {
        let (sin, cos) = (TAU * (k % 16) as f64 / 16.0).sin_cos();
        [10.0 * cos, 10.0 * sin, 3.0]
    };
    let points: Vec<Vector> = (0..=16).map(on).collect();
    for cubic in Cubic::through(&points) {
        for part in [0.25, 0.5, 0.75] {
            let [x, y, z] = cubic.point(part);
            assert!(
                (x.hypot(y) - 10.0).abs() < 1e-3 && (z - 3.0).abs() < 1e-12,
                "{x} {y} {z}"
            );
        }
    }
}
