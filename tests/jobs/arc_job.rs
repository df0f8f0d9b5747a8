//! Paths on the arc generator: what it commands, against integers and against the exact curves.

use motion_rtl::circuits::arc_generator::{Rounding, Widths};
use motion_rtl::input::Point;
use motion_rtl::jobs::arc_generator::bounds::{command_error, rotation_error};
use motion_rtl::jobs::arc_generator::job::{arc_generator, play};
use motion_rtl::jobs::arc_generator::prepare::{Timing, prepare};
use motion_rtl::jobs::arc_generator::prepared::{Prepared, Segment, Shape};
use motion_rtl::jobs::arc_generator::record::records;
use motion_rtl::jobs::arc_generator::reference::{Decoded, commands};
use motion_rtl::jobs::arc_generator::settings::{LEAST_SAMPLE_TICKS, Settings, ShortPieces};
use motion_rtl::path::pieces::{Taught, from_points};
use motion_rtl::path::record::Record;
use proptest::prelude::*;
use std::f64::consts::TAU;

const FULL: Widths = Widths::FULL;

/// A count is a millimetre, a sample a millisecond.
fn timing(blend_samples: u64) -> Timing {
    Timing {
        sample_s: 1e-3,
        blend_samples,
        corner: 0.3,
        short_pieces: ShortPieces::Slower,
        most_samples: FULL.most_samples(),
    }
}

fn norm(v: Point) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn sub(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn cross(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|k| {
        let (m, n) = ((k + 1) % 3, (k + 2) % 3);
        a[m] * b[n] - a[n] * b[m]
    })
}

/// An arc of `angle` in any attitude, as three taught points, and what it is meant to be.
#[derive(Debug, Clone)]
struct Wanted {
    centre: Point,
    axis: Point,
    radius: f64,
    points: [Point; 3],
}

impl Wanted {
    fn new(centre: Point, attitude: [f64; 3], radius: f64, angle: f64) -> Self {
        let [azimuth, height, turn] = attitude;
        let flat = (1.0 - height * height).sqrt();
        let axis = [flat * azimuth.cos(), flat * azimuth.sin(), height];
        // Any vector that is not along the axis makes a frame with it.
        let helper = if axis[0].abs() < 0.6 {
            [1.0, 0.0, 0.0]
        } else {
            [0.0, 1.0, 0.0]
        };
        let u = cross(axis, helper);
        let u = u.map(|x| x / norm(u));
        let w = cross(axis, u);
        let at = |share: f64| {
            let (sin, cos) = (turn + angle * share).sin_cos();
            [0, 1, 2].map(|k| centre[k] + radius * (cos * u[k] + sin * w[k]))
        };
        Wanted {
            centre,
            axis,
            radius,
            points: [at(0.0), at(0.4), at(1.0)],
        }
    }

    /// Distance of a point outside the circle, and above its plane.
    fn off(&self, point: Point) -> [f64; 2] {
        let vector = sub(point, self.centre);
        let height = (0..3).map(|k| vector[k] * self.axis[k]).sum::<f64>();
        let flat = sub(vector, self.axis.map(|x| x * height));
        [norm(flat) - self.radius, height]
    }
}

fn path(wanted: &Wanted, speed: f64, blend_samples: u64) -> Prepared {
    let [from, via, to] = wanted.points;
    let taught = Taught {
        to,
        via: Some(via),
        spline: false,
        speed: Some(speed),
    };
    let pieces = from_points(from, &[taught], &Settings::default()).expect("an arc");
    prepare(from, &pieces, &timing(blend_samples)).expect("a path")
}

fn played(records: &[Record], rounding: Rounding) -> Vec<[i64; 3]> {
    let circuit = arc_generator(&Settings {
        rounding,
        ..Settings::default()
    });
    let played =
        play(&circuit, records, LEAST_SAMPLE_TICKS as u32, &mut ()).expect("nothing objects");
    assert!(!played.late && !played.starved);
    let ticks = played.commands.iter().map(|command| command.tick);
    let first = played.commands[0].tick;
    let due = (0..).map(|sample| first + sample * LEAST_SAMPLE_TICKS);
    assert!(ticks.eq(due.take(played.commands.len())));
    let counts = played.commands.iter().map(|command| command.counts);
    counts.collect()
}

/// The rotation of a path of one arc, with its record.
fn rotation<'a>(prepared: &'a Prepared, records: &'a [Record]) -> (&'a Segment, &'a Record) {
    let mut arcs = prepared.segments.iter().zip(records);
    let is_arc = |(segment, _): &(&Segment, &Record)| matches!(segment.shape, Shape::Arc { .. });
    arcs.find(is_arc).expect("a rotation")
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, max_shrink_iters: 30, ..ProptestConfig::default() })]

    /// Arcs of every size and attitude, over nearly a turn.
    #[test]
    fn an_arc_stays_within_its_bound(
        size in 1.3..6.6f64,
        attitude in (0.0..TAU, -1.0..1.0f64, 0.0..TAU),
        angle in 0.4..6.2f64,
        place in prop::array::uniform3(-1.0..1.0f64),
        step in -6.0..-1.2f64,
        half_blend in 1..64u64,
        nearest in any::<bool>(),
    ) {
        let rounding = if nearest { Rounding::Nearest } else { Rounding::Floor };
        let radius = 10f64.powf(size);
        let room = f64::from(1 << 23) - 2.0 - radius;
        let wanted = Wanted::new(place.map(|x| x * room), attitude.into(), radius, angle);
        let speed = radius * step.exp() / 1e-3;
        let prepared = path(&wanted, speed, 2 * half_blend);
        let records = records(&prepared, 1.0, &FULL, rounding).expect("it fits");
        let seen = played(&records, rounding);
        prop_assert_eq!(&seen, &commands(&records, &FULL, rounding).collect::<Vec<_>>());

        // The arc begins and ends on its points.
        let [from, _, to] = wanted.points;
        let whole = |point: Point| point.map(|x| (x * 65_536.0).round() / 65_536.0);
        let counts = |point: Point| whole(point).map(|x| (x + 0.5).floor() as i64);
        prop_assert_eq!(seen[0], counts(from));
        prop_assert_eq!(*seen.last().expect("commands"), counts(to));

        let (segment, record) = rotation(&prepared, &records);
        let steps = segment.samples;
        let bound = command_error(radius, steps, &FULL, rounding);
        let own = &seen[segment.first_sample as usize..=segment.end() as usize];
        for command in own {
            let [outside, height] = wanted.off(command.map(|x| x as f64));
            prop_assert!(outside.hypot(height) <= bound, "{} by {}", outside, height);
        }

        // Before the last rounding: where it ends, and the way of each sample.
        let units = f64::from(1 << FULL.guard());
        let points = Decoded::of(record, &FULL).points(&FULL, rounding);
        let points: Vec<Point> = points.map(|p| p.map(|x| x as f64 / units)).collect();
        let bound = rotation_error(radius, steps, &FULL, rounding);
        let end = segment.point(steps);
        let last = *points.last().expect("points");
        prop_assert!(norm(sub(last, end)) <= bound, "{:?} is not {:?}", last, end);
        let Shape::Arc { step, .. } = segment.shape else { unreachable!() };
        let chord = 2.0 * radius * (step / 2.0).sin();
        let once = rotation_error(radius, 1, &FULL, rounding);
        for pair in points.windows(2) {
            let way = norm(sub(pair[1], pair[0]));
            let allowed = chord / radius * bound + once;
            prop_assert!((way - chord).abs() <= allowed, "{} instead of {}", way, chord);
        }
    }
}

/// The largest distance from the circle over a turn of 3,600 steps, in counts, before the last
/// rounding; and what is left along the axis.
fn drift(rounding: Rounding) -> [f64; 2] {
    let wanted = Wanted::new([0.0; 3], [0.7, 0.4, 0.1], 1e6, TAU * 0.999);
    let prepared = path(&wanted, 1e6 * TAU / 3600.0 / 1e-3, 64);
    let records = records(&prepared, 1.0, &FULL, rounding).expect("it fits");
    let (_, record) = rotation(&prepared, &records);
    let units = f64::from(1 << FULL.guard());
    let points = Decoded::of(record, &FULL).points(&FULL, rounding);
    let off = points.map(|p| wanted.off(p.map(|x| x as f64 / units)));
    off.fold([0.0, 0.0], |[worst, _], [outside, height]| {
        [f64::max(worst, outside.hypot(height)), height]
    })
}

/// Rounding down pulls every step the same way, half a guard unit a coordinate. What of it lies in
/// the plane turns with the arc and cancels over a turn; what is along the axis adds up.
#[test]
fn rounding_down_drifts_along_the_axis() {
    let [nearest, _] = drift(Rounding::Nearest);
    let [floor, height] = drift(Rounding::Floor);
    let axis: f64 = Wanted::new([0.0; 3], [0.7, 0.4, 0.1], 1.0, 1.0)
        .axis
        .iter()
        .sum();
    let expected = -3500.0 / 2.0 / 65_536.0 * axis;
    assert!(
        (height / expected - 1.0).abs() < 0.1,
        "{height}, not {expected}"
    );
    assert!(floor > 10.0 * nearest, "{floor} beside {nearest}");
}
