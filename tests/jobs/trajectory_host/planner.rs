//! Profiles: limits, continuity, and time against the fastest there is.

use super::{config, spans};
use motion_rtl::circuits::trajectory_controller::Widths;
use motion_rtl::jobs::trajectory_controller::planner::plan;
use motion_rtl::jobs::trajectory_controller::profile::{Cubic, Profile};
use motion_rtl::jobs::trajectory_controller::ramp::Slope;
use motion_rtl::jobs::trajectory_controller::segments::Path;
use motion_rtl::jobs::trajectory_controller::settings::Settings;
use motion_rtl::jobs::trajectory_controller::speed_limits::{self, Span};
use motion_rtl::path::circle::Circle;
use motion_rtl::path::pieces::{Course, Piece};
use proptest::prelude::*;

fn joints(spans: &[Span]) -> Vec<f64> {
    let mut at = 0;
    let ends = spans.iter().map(|span| {
        at += span.length;
        at as f64
    });
    std::iter::once(0.0).chain(ends).collect()
}

/// When the profile has come to a length, between two times.
fn when(profile: &Profile, length: f64) -> f64 {
    let [mut early, mut late] = [0.0, profile.duration];
    for _ in 0..200 {
        let middle = f64::midpoint(early, late);
        match profile.at(middle)[0] < length {
            true => early = middle,
            false => late = middle,
        }
    }
    early
}

/// Everything that holds for any profile.
fn check(profile: &Profile, spans: &[Span], slope: Slope) -> Result<(), TestCaseError> {
    let joints = joints(spans);
    let length = joints[spans.len()];
    prop_assert_eq!(profile.length, length);
    let Slope {
        acceleration,
        jerk_time,
        ..
    } = slope;
    let fastest = spans.iter().map(|span| span.speed).fold(0.0, f64::max);
    let jerk = match jerk_time > 0.0 {
        true => acceleration / jerk_time,
        false => 0.0,
    };
    // Value of the last digits of a time.
    let digits = profile.duration * 1e-15;
    let (near_q, near_v, near_a) = (
        1e-9 * length + fastest * digits,
        1e-9 * fastest + acceleration * digits,
        1e-9 * acceleration + jerk * digits,
    );
    let near = |one: f64, other: f64, by: f64| (one - other).abs() <= by;
    let ends = profile.pieces.iter().skip(1).map(|piece| piece.t);
    let ends = ends.chain([profile.duration]);
    let rest = Cubic {
        t: profile.duration,
        q: length,
        v: 0.0,
        a: 0.0,
        jerk: 0.0,
    };
    let nexts = profile.pieces.iter().skip(1).chain([&rest]);
    prop_assert_eq!(profile.pieces[0].t, 0.0);
    prop_assert_eq!(profile.pieces[0].q, 0.0);
    prop_assert_eq!(profile.pieces[0].v, 0.0);
    for ((piece, end), next) in profile.pieces.iter().zip(ends).zip(nexts) {
        prop_assert!(end > piece.t);
        let [q, v, a] = piece.at(end);
        prop_assert!(near(q, next.q, near_q), "{:?} {:?}", piece, next);
        prop_assert!(near(v, next.v, near_v), "{:?} {:?}", piece, next);
        if jerk_time > 0.0 {
            prop_assert!(near(a, next.a, near_a), "{:?} {:?}", piece, next);
            prop_assert!(piece.jerk.abs() <= jerk * (1.0 + 1e-9));
        } else {
            prop_assert_eq!(piece.jerk, 0.0);
        }
        let mut before = piece.q;
        for part in 0..=20 {
            let t = piece.t + (end - piece.t) * f64::from(part) / 20.0;
            let [q, v, a] = piece.at(t);
            prop_assert!(q >= before - near_q && v >= -near_v);
            before = q;
            prop_assert!(a.abs() <= acceleration + near_a);
            // On the faster side of a joint that is nearer than the rounding.
            let behind = joints.partition_point(|&joint| joint <= q - 1e-9 * length);
            let ahead = joints.partition_point(|&joint| joint <= q + 1e-9 * length);
            let spans = &spans[behind.max(1) - 1..ahead.clamp(1, spans.len())];
            let limit = spans.iter().map(|span| span.speed).fold(0.0, f64::max);
            prop_assert!(
                v <= limit * (1.0 + 1e-9) + acceleration * digits,
                "{} above {} at {}",
                v,
                limit,
                q
            );
        }
    }
    for (joint, span) in joints.iter().zip(spans) {
        let t = when(profile, *joint);
        let v = profile.at(t)[1];
        // A time's last digit is worth this much of the speed; near a stop the length's digits are.
        let digit =
            acceleration * (profile.duration * 1e-12) + (acceleration * length * 1e-12).sqrt();
        let limit = span.entry.max(0.0) * (1.0 + 1e-9) + digit;
        prop_assert!(
            *joint == 0.0 || v <= limit,
            "{} above {} at joint {}",
            v,
            limit,
            joint
        );
    }
    Ok(())
}

/// The least time with so much acceleration: the speed at every length is the lowest that any limit
/// allows from its distance.
fn least_time(spans: &[Span], acceleration: f64) -> f64 {
    let joints = joints(spans);
    let at_joint = |k: usize| match k {
        0 => 0.0,
        k if k == spans.len() => 0.0,
        k => spans[k].entry.min(spans[k].speed).min(spans[k - 1].speed),
    };
    let square = |k: usize| {
        let limits = (0..joints.len()).map(|other| {
            let distance = (joints[other] - joints[k]).abs();
            at_joint(other).powi(2) + 2.0 * acceleration * distance
        });
        limits.fold(f64::INFINITY, f64::min)
    };
    let squares: Vec<f64> = (0..joints.len()).map(square).collect();
    let times = spans.iter().enumerate().map(|(k, span)| {
        let [first, last] = [squares[k], squares[k + 1]];
        let length = span.length as f64;
        let top = f64::midpoint(first, last) + acceleration * length;
        let top = top.min(span.speed.powi(2));
        let ramps = (2.0 * top - first - last) / (2.0 * acceleration);
        let (v, slow) = (top.sqrt(), first.sqrt() + last.sqrt());
        (2.0 * v - slow) / acceleration + (length - ramps) / v
    });
    times.sum()
}

proptest! {
    #![proptest_config(config(400))]

    #[test]
    fn a_trapezoid_is_as_fast_as_can_be(spans in spans(1..30), acceleration in 2.0..6.0f64) {
        let slope = Slope { acceleration: 10f64.powf(acceleration), time_constant: 0.0, jerk_time: 0.0 };
        let profile = plan(&spans, slope);
        check(&profile, &spans, slope)?;
        let least = least_time(&spans, slope.acceleration);
        let ratio = profile.duration / least;
        prop_assert!((1.0 - 1e-6..1.0 + 1e-3).contains(&ratio), "{}", ratio);
    }

    #[test]
    fn with_a_time_constant_every_ramp_has_its_part_of_it(
        spans in spans(1..30),
        acceleration in 2.0..6.0f64,
        time_constant in -3.0..2.0f64,
    ) {
        let time_constant = 10f64.powf(time_constant);
        let slope = Slope { acceleration: 10f64.powf(acceleration), time_constant, jerk_time: 0.0 };
        let profile = plan(&spans, slope);
        check(&profile, &spans, slope)?;
        let ends = profile.pieces.iter().skip(1).map(|piece| piece.t);
        let pieces = profile.pieces.iter().zip(ends.chain([profile.duration]));
        for (piece, end) in pieces.filter(|(piece, _)| piece.a != 0.0) {
            let last = piece.at(end)[1];
            let (high, low) = (piece.v.max(last), piece.v.min(last));
            let longest = time_constant.max(high / slope.acceleration);
            let time = longest * (1.0 - low / high);
            prop_assert!(
                (end - piece.t - time).abs() <= 1e-6 * time + 1e-12 * profile.duration,
                "{} to {} in {}, not {}", piece.v, last, end - piece.t, time
            );
        }
    }

    #[test]
    fn with_jerk_time_every_limit_holds(
        spans in spans(1..30),
        acceleration in 2.0..6.0f64,
        jerk_time in -4.0..1.0f64,
    ) {
        let (acceleration, jerk_time) = (10f64.powf(acceleration), 10f64.powf(jerk_time));
        let slope = Slope { acceleration, time_constant: 0.0, jerk_time };
        let profile = plan(&spans, slope);
        check(&profile, &spans, slope)?;
        // Each span may take two ramps, and a short ramp longer than its acceleration.
        let least = least_time(&spans, acceleration);
        let most = 1.001 * least + 4.0 * jerk_time * spans.len() as f64;
        prop_assert!(profile.duration <= most, "{} {}", profile.duration, least);
        prop_assert!(profile.duration >= least * (1.0 - 1e-6));
    }
}

/// Pieces of chords of `chord` mm of a curve that winds with radii from 8 mm on.
fn chords(count: usize, chord: f64, speed: f64) -> Vec<Piece> {
    let (mut at, mut pieces) = ([0.0; 3], Vec::new());
    for k in 0..count {
        let way = k as f64 * chord;
        let heading = 2.0 * (way / 16.0).sin() + 0.3 * (way / 5.0).cos();
        at[0] += chord * heading.cos();
        at[1] += chord * heading.sin();
        pieces.push(Piece {
            course: Course::Line,
            to: at,
            speed,
            line: None,
        });
    }
    pieces
}

#[test]
fn chords_of_a_curve_run_at_feed() {
    for jerk_time_ms in [0.0, 20.0] {
        let widths = Widths {
            segment: 13,
            ..Widths::FULL
        };
        let settings = Settings {
            jerk_time_ms,
            corner_mm_per_min: 60.0,
            acceleration_mm_per_s2: Some(1000.0),
            ..Settings::default()
        };
        let motion = settings.motion(&widths).unwrap();
        let pieces = chords(5000, 0.05, 80.0);
        let path = Path::of([0.0; 3], &pieces, 1000.0, &widths).unwrap();
        assert_eq!(path.stretches.len(), 5000);
        let spans = speed_limits::spans(&path, &motion);
        let profile = plan(&spans, motion.slope);
        check(&profile, &spans, motion.slope).unwrap();
        // 250 mm at 80 mm/s, and for both ramps 80 / 1000 + t_j each at half of it.
        let expected = 250.0 / 80.0 + 80.0 / 1000.0 + jerk_time_ms / 1e3;
        let ratio = profile.duration / expected;
        assert!((ratio - 1.0).abs() < 1e-6, "{ratio}");
        // Corners stop it where none is allowed.
        let spans: Vec<Span> = spans
            .iter()
            .map(|span| Span {
                entry: 0.0,
                ..*span
            })
            .collect();
        let stops = plan(&spans, motion.slope);
        assert!(stops.duration > 10.0 * profile.duration);
    }
}

#[test]
fn a_tangent_arc_is_entered_without_a_stop_at_the_speed_of_its_radius() {
    let speed = 80.0;
    let mut piece = Piece {
        course: Course::Line,
        to: [50.0, 0.0, 0.0],
        speed,
        line: None,
    };
    let mut pieces = vec![piece];
    let arc = Circle::around(
        [50.0, 2.0, 0.0],
        piece.to,
        [50.0, 4.0, 0.0],
        [0.0, 0.0, 1.0],
    );
    (piece.course, piece.to) = (Course::Arc(arc.unwrap()), [50.0, 4.0, 0.0]);
    pieces.push(piece);
    (piece.course, piece.to) = (Course::Line, [0.0, 4.0, 0.0]);
    pieces.push(piece);
    let settings = Settings {
        normal_acceleration_mm_per_s2: 800.0,
        corner_mm_per_min: 0.0,
        ..Settings::default()
    };
    let motion = settings.motion(&Widths::FULL).unwrap();
    let path = Path::of([0.0; 3], &pieces, 1000.0, &Widths::FULL).unwrap();
    let spans = speed_limits::spans(&path, &motion);
    let profile = plan(&spans, motion.slope);
    check(&profile, &spans, motion.slope).unwrap();
    // √(800 · 2) on the arc; from 0 to 80, and from 80 to 40 at its ends, with 2000 mm/s².
    let (around, ramps) = (40.0, 80.0 / 2000.0 + 40.0 / 2000.0);
    let ways = 80.0 * 80.0 / 4000.0 + (80.0 * 80.0 - 40.0 * 40.0) / 4000.0;
    let line = ramps + (50.0 - ways) / 80.0;
    let expected = 2.0 * line + std::f64::consts::PI * 2.0 / around;
    let ratio = profile.duration / expected;
    assert!((ratio - 1.0).abs() < 1e-6, "{ratio}");
}

#[test]
fn a_slower_curve_is_slowed_down_for_no_more_than_it_needs() {
    // A turn of up to 0.0068 rad a chord: with 0.3 mm/s, 44 mm/s and more of 80 mm/s.
    let settings = |jerk_time_ms| Settings {
        jerk_time_ms,
        corner_mm_per_min: 18.0,
        acceleration_mm_per_s2: Some(1000.0),
        ..Settings::default()
    };
    let pieces = chords(4000, 0.05, 80.0);
    let path = Path::of([0.0; 3], &pieces, 1000.0, &Widths::FULL).unwrap();
    let duration = |jerk_time_ms| {
        let motion = settings(jerk_time_ms).motion(&Widths::FULL).unwrap();
        let spans = speed_limits::spans(&path, &motion);
        let profile = plan(&spans, motion.slope);
        check(&profile, &spans, motion.slope).unwrap();
        let least = least_time(&spans, motion.slope.acceleration);
        println!(
            "{jerk_time_ms} ms: {} s, {} pieces, least {least}",
            profile.duration,
            profile.pieces.len()
        );
        profile.duration / least
    };
    assert!((duration(0.0) - 1.0).abs() < 1e-3);
    for jerk_time in [5.0, 20.0] {
        let ratio = duration(jerk_time);
        assert!(ratio < 1.05, "{ratio}");
    }
}

#[test]
#[ignore = "takes long"]
fn a_hundred_thousand_segments_keep_their_limits() {
    let mut seed = 1u64;
    let mut random = || {
        seed = seed
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (seed >> 33) as f64 / (1u64 << 31) as f64
    };
    let equal = |_: usize| 1.0;
    let mut noise = |_: usize| random();
    let slow = |k: usize| 0.3 + 0.2 * (k as f64 / 300.0).sin();
    let mut kinds: [(&str, &mut dyn FnMut(usize) -> f64); 3] = [
        ("equal", &mut { equal }),
        ("noise", &mut noise),
        ("slow", &mut { slow }),
    ];
    for jerk_time in [0.0, 0.02] {
        for (name, kind) in &mut kinds {
            let spans: Vec<Span> = (0..100_000)
                .map(|k| Span {
                    length: 3_000_000,
                    speed: 6e9,
                    entry: 1e10 * kind(k),
                })
                .collect();
            let slope = Slope {
                acceleration: 6e10,
                time_constant: 0.0,
                jerk_time,
            };
            let profile = plan(&spans, slope);
            check(&profile, &spans, slope).unwrap_or_else(|error| panic!("{name}: {error}"));
        }
    }
}
