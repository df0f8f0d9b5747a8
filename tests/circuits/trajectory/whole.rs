//! The whole at small widths, in three axes, and at the edges of its timing.

use super::bench::{FED, PLANE, Path, Period, Record, SMALL, SPACE};
use super::feedback::expected;
use super::point::Segment;
use motion_rtl::circuits::blocks::cordic_state;
use motion_rtl::circuits::trajectory_controller::controller::In;
use motion_rtl::circuits::trajectory_controller::vector_correction::Correction;
use motion_rtl::circuits::trajectory_controller::{ErrorFeedback, Widths, error_feedback};
use motion_rtl::trace::LastTicks;
use proptest::prelude::*;
use std::f64::consts::TAU;

/// A profile that goes to lengths, one a period, and rests at the last.
fn steps(lengths: &[u64]) -> Vec<Record> {
    let mut from = 0u64;
    let mut records = Vec::new();
    for (index, &to) in lengths.iter().enumerate() {
        let mut record = [0; 32];
        record[0] = 1 | u64::from(index + 1 == lengths.len()) << 2 | 1 << 3;
        record[1] = 1;
        record[2] = from;
        record[8] = to - from;
        records.push(record);
        from = to;
    }
    records
}

/// Words of a line along an axis, at the small widths.
fn small_line(axis: usize, base: i64, sign: i64) -> [u64; 16] {
    const D: u64 = 12;
    const ONE: i64 = 1 << 4;
    let word = |value: i64| value as u64 & ((1 << D) - 1);
    let mut words = [0; 16];
    words[3 + axis] = word(base);
    words[6 + axis] = word(sign * ONE);
    words
}

/// Widths: points of 6 bits with 2 of them guard bits, gains of 4. Every start and every end within
/// the counts, both axes, in a step and in several: no correction in any period, and the end is
/// reached, for every pair of gains that does not overshoot and has a product of 2^−2 at least.
#[test]
#[ignore = "takes long"]
fn every_small_move_along_an_axis_is_never_corrected() {
    let at_power_on = SMALL.at_power_on(Correction::Vector).compiled();
    for axis in 0..2 {
        for begin in -15..=15i64 {
            for end in -15..=15i64 {
                let length = begin.abs_diff(end);
                let Some(sign) = [-1, 1]
                    .into_iter()
                    .find(|sign| begin + sign * length as i64 == end)
                else {
                    unreachable!("one of both")
                };
                if length == 0 {
                    continue;
                }
                let path: Path = vec![(length, small_line(axis, begin, sign))];
                let gains = [[2, 8], [2, 15], [3, 12]][(begin + end).rem_euclid(3) as usize];
                let third = length / 3;
                let profile = match end % 2 == 0 {
                    true => steps(&[length]),
                    false => steps(&[third, 2 * third, length]),
                };
                let seen = at_power_on.run(&path, &profile, gains, (110, 30));
                for period in &seen {
                    assert_eq!(period.correction, [0, 0], "{begin} to {end}: {period:?}");
                    let mut command = [0, 0];
                    command[axis] = begin + sign * period.length;
                    assert_eq!(period.command, command);
                    let mut response = [0, 0];
                    response[axis] = begin + sign * period.answered;
                    assert_eq!(period.response, response);
                }
                let last = seen.last().expect("periods");
                // To the count: within half of its 4 guard units.
                assert!(
                    (last.response[axis] - end).abs() <= 2,
                    "{begin} to {end}: {last:?}"
                );
            }
        }
    }
}

/// A line of the plane, or an arc.
fn segment(length: u64, base: [f64; 2], along: [f64; 2], radius: Option<f64>) -> Segment {
    Segment {
        length,
        base: [base[0].round() as i64, base[1].round() as i64, 0],
        along: [along[0], along[1], 0.0],
        across: match radius {
            Some(_) => [-along[1], along[0], 0.0],
            None => [0.0; 3],
        },
        third: [0.0; 3],
        radius,
        powers: None,
    }
}

fn words(segments: &[Segment]) -> Path {
    let words = |segment: &Segment| (segment.length, segment.words());
    segments.iter().map(words).collect()
}

/// 0.05 and 0.2 a period.
const GAINS: [u64; 2] = [1638, 6554];
const PERIOD: u64 = 480;

/// Lines and arcs one after the other, in any directions.
fn polyline() -> impl Strategy<Value = Vec<Segment>> {
    let piece = (0.0..TAU, 4.0..24.0f64, prop::option::of(8.0..22.0f64));
    prop::collection::vec(piece, 1..12).prop_map(|pieces| {
        let mut at = [0.0, 0.0];
        let mut segments = Vec::new();
        for (direction, size, radius) in pieces {
            let (sin, cos) = direction.sin_cos();
            let length = size.exp2().round();
            match radius.map(f64::exp2) {
                None => {
                    segments.push(segment(length as u64, at, [cos, sin], None));
                    at = [at[0] + cos * length, at[1] + sin * length];
                }
                Some(radius) => {
                    let length = length.min((6.0 * radius).floor()).max(1.0);
                    let centre = [at[0] - cos * radius, at[1] - sin * radius];
                    segments.push(segment(length as u64, centre, [cos, sin], Some(radius)));
                    let (sin, cos) = (direction + length / radius).sin_cos();
                    at = [centre[0] + cos * radius, centre[1] + sin * radius];
                }
            }
        }
        segments
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// Whatever the path, the lengths that are looked up are on it, and the segments that are found
    /// contain them; with gains that overshoot too.
    #[test]
    fn lengths_stay_on_the_path_and_in_their_segments(
        segments in polyline(),
        parts in prop::collection::vec(0.0..=1.0f64, 0..10),
        overshoots in any::<bool>(),
    ) {
        let path = words(&segments);
        let end: u64 = path.iter().map(|segment| segment.0).sum();
        let mut lengths: Vec<u64> = parts.iter().map(|part| (part * end as f64) as u64).collect();
        lengths.push(end);
        lengths.sort_unstable();
        let gains = if overshoots { [6000, 14_000] } else { [4000, 20_000] };
        let seen = PLANE.run(&path, &steps(&lengths), gains, Correction::Vector, (PERIOD, 60));
        let mut begins = vec![0];
        for segment in &path {
            begins.push(begins[begins.len() - 1] + segment.0);
        }
        for period in &seen {
            for (length, found) in period.looked_up.into_iter().zip(period.segments) {
                prop_assert!(length <= end);
                let last = found + 1 == path.len();
                prop_assert!(begins[found] <= length);
                prop_assert!(length < begins[found + 1] || (last && length == end));
            }
            let expected = [period.length, period.answered].map(|length| length.clamp(0, end as i64) as u64);
            prop_assert_eq!(period.looked_up, expected);
            for k in 0..2 {
                prop_assert_eq!(period.correction[k], period.reference[k] - period.response[k]);
                prop_assert_eq!(period.corrected[k], period.command[k] + period.correction[k]);
            }
        }
        prop_assert_eq!(seen.last().expect("periods").length, end as i64);
    }

    /// The axes are alike: with x, y and z exchanged in the path they are in all that comes of it.
    #[test]
    #[ignore = "takes long"]
    fn axes_are_alike(segments in polyline(), exchange in 0..6usize) {
        const ORDERS: [[usize; 3]; 6] =
            [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
        let order = ORDERS[exchange];
        let turned: Vec<Segment> = segments.iter().map(|segment| {
            let mut turned = segment.clone();
            for (from, &to) in order.iter().enumerate() {
                turned.base[to] = segment.base[from];
                turned.along[to] = segment.along[from];
                turned.across[to] = segment.across[from];
            }
            turned
        }).collect();
        let end: u64 = segments.iter().map(|segment| segment.length).sum();
        let profile = steps(&[end / 5, end / 3, end / 2, end]);
        let run = |segments: &[Segment]| {
            SPACE.run(&words(segments), &profile, GAINS, Correction::Vector, (PERIOD, 40))
        };
        for (one, other) in run(&segments).iter().zip(&run(&turned)) {
            for (from, &to) in order.iter().enumerate() {
                let all = |p: &Period, k: usize| {
                    [p.command[k], p.response[k], p.reference[k], p.corrected[k], p.model[k]]
                };
                prop_assert_eq!(all(one, from), all(other, to));
            }
        }
    }
}

/// Without a correction the responses of all axes and the servos' own models are the same filter as
/// the tangential one: on a line along an axis they go through the same numbers.
#[test]
fn all_models_are_the_same_to_the_bit() {
    for axis in 0..3 {
        let mut line = segment(40_000_000, [0.0; 2], [0.0; 2], None);
        line.along[axis] = 1.0;
        let profile = steps(&[1_234_567, 20_000_001, 20_000_002, 40_000_000]);
        let seen = SPACE.run(
            &words(&[line]),
            &profile,
            GAINS,
            Correction::None,
            (PERIOD, 200),
        );
        for period in &seen {
            assert_eq!(period.response[axis], period.answered);
            assert_eq!(period.model[axis], period.answered);
        }
        let last = seen.last().expect("periods").answered;
        assert!((last - 40_000_000).abs() <= 50, "{last}");
    }
}

/// The feedback is computed from the command, the motors' positions, and the direction from the
/// point a count before the command, on a line, over a corner and on an arc.
#[test]
fn what_is_fed_back_is_by_the_direction_at_the_command() {
    let (radius, count) = (30_000_000.0, 65_536);
    let line = segment(20_000_000, [0.0, -radius], [1.0, 0.0], None);
    let up = segment(20_000_000, [20_000_000.0, -radius], [0.0, 1.0], None);
    let arc = segment(
        60_000_000,
        [20_000_000.0, radius],
        [0.0, -1.0],
        Some(radius),
    );
    let path = words(&[line, up, arc]);
    let lengths = [
        1, 40_000, 20_000_000, 20_030_000, 20_070_000, 55_000_000, 99_000_000,
    ];
    let profile = steps(&lengths);
    let seen = PLANE.run(&path, &profile, GAINS, Correction::Feedback, (PERIOD, 9));
    let widths = Widths::FULL.feedback();
    let feedback = ErrorFeedback { widths, axes: 2 };
    for period in &seen {
        let behind = (period.length - count).max(0);
        assert_eq!(
            period.looked_up,
            [period.length, behind].map(|length| length as u64)
        );
        let way = [0, 1].map(|k| (period.command[k] - period.reference[k]) as f64);
        let turned = match period.length {
            20_000_000 => Some(0.0),
            20_070_000 => Some(TAU / 4.0),
            length @ 40_000_000.. => Some((length as f64 - 40_000_000.0 - 32_768.0) / radius),
            _ => None,
        };
        // A count long, but shorter at the path's start and over the corner.
        let near = match turned {
            None => way[0].hypot(way[1]) < 60_000.0,
            Some(turned) => {
                let exact = [turned.cos(), turned.sin()].map(|part| count as f64 * part);
                (0..2).all(|k| (way[k] - exact[k]).abs() < 1.5)
            }
        };
        assert!(near, "{way:?}: {period:?}");
        let fed = expected(
            &feedback,
            &error_feedback::In {
                start: true,
                command: period.command.clone(),
                path: period.command.clone(),
                behind: period.reference.clone(),
                // The motors stand at power-on.
                position: vec![0; 2],
                gains: FED,
            },
        );
        for (k, fed) in fed.into_iter().enumerate() {
            assert_eq!(i128::from(period.correction[k]), fed, "{period:?}");
            assert_eq!(
                period.corrected[k],
                period.command[k] + period.correction[k]
            );
        }
    }
    assert_eq!(seen.last().map(|period| period.length), Some(99_000_000));
}

/// The steady correction is that of the wider arc at the command's length; on a line there is none.
#[test]
fn the_steady_correction_is_a_wider_radius() {
    let (radius, wider) = (30_000_000.0, 30_040_000.0);
    let line = segment(20_000_000, [0.0, -radius], [1.0, 0.0], None);
    let arc = segment(60_000_000, [20_000_000.0, 0.0], [0.0, -1.0], Some(radius));
    let mut path = words(&[line, arc]);
    path[1].1[12] = (wider / cordic_state::GAIN * 256.0).round() as u64;
    let lengths: Vec<u64> = (1..=16).map(|n| 5_000_000 * n).collect();
    let seen = PLANE.run(
        &path,
        &steps(&lengths),
        GAINS,
        Correction::Steady,
        (PERIOD, 20),
    );
    for period in &seen {
        assert_eq!(period.looked_up[0], period.length as u64);
        let turned = (period.length as f64 - 20_000_000.0) / radius;
        let expected = match turned < 0.0 {
            true => [0.0, 0.0],
            false => [turned.sin(), -turned.cos()].map(|part| part * (wider - radius)),
        };
        for (k, expected) in expected.into_iter().enumerate() {
            let off = period.correction[k] as f64 - expected;
            assert!(off.abs() <= 2.5, "{off}: {period:?}");
            assert_eq!(
                period.corrected[k],
                period.command[k] + period.correction[k]
            );
        }
    }
    assert!(seen.iter().any(|period| period.length == 80_000_000));
}

/// The smallest arc takes the most shifts. A period of `LEAST_PERIOD` is never late on it, with one
/// tick less it is.
#[test]
fn the_least_period_is_enough_and_one_tick_less_is_not() {
    // A turn is just below a guard unit, the length of its segment; the search takes the same time for any path.
    let radius = 0.99 / TAU;
    let path = words(&[segment(1, [0.0; 2], [1.0, 0.0], Some(radius))]);
    let circuit = PLANE.controller(Correction::Vector);
    let least = circuit.least_period();
    for period in [least - 1, least] {
        let mut simulator = LastTicks::simulator(&circuit).unwrap();
        let writes = PLANE.writes(&path, &steps(&[1]), GAINS, period);
        let idle = PLANE.idle(&path, GAINS, period);
        let idle = (0..8 * period).map(|_| idle.clone());
        for i in writes.into_iter().chain(idle) {
            simulator.step_with(&i, |_| ()).unwrap();
        }
        let late = simulator.see(|s| s.w.late);
        assert_eq!(late, period < least, "{period} ticks");
    }
}

/// A second path begins where the first has ended, while the servo controls go on; what rounding
/// left of the first is not corrected in it.
#[test]
fn a_second_path_begins_where_the_first_has_ended() {
    let circuit = PLANE.controller(Correction::Vector);
    let mut simulator = LastTicks::simulator(&circuit).unwrap();
    let (sin, cos) = 0.7f64.sin_cos();
    let first = segment(10_000_001, [0.0; 2], [cos, sin], None);
    let end = [cos, sin].map(|part| part * 10_000_001.0);
    let second = segment(20_000_000, end, [-1.0, 0.0], None);
    let paths = [first, second].map(|segment| words(&[segment]));
    let (mut ticks, mut driven) = (0, 0);
    for (number, path) in paths.iter().enumerate() {
        let writes = PLANE.writes(path, &steps(&[path[0].0]), GAINS, PERIOD);
        let restart = In {
            restart: true,
            ..PLANE.idle(&paths[0], GAINS, PERIOD)
        };
        let wait = vec![PLANE.idle(&paths[0], GAINS, PERIOD); 2 * PERIOD as usize];
        let before = [restart].into_iter().chain(wait).filter(|_| number == 1);
        let idle = PLANE.idle(path, GAINS, PERIOD);
        let after = (0..400 * PERIOD).map(|_| idle.clone());
        let mut corrected = None;
        for i in before.chain(writes).chain(after) {
            let seen = simulator
                .step_with(&i, |now| {
                    let driven = now.see(|s| s.p.axes[0].w.driven);
                    let waiting = now.see(|s| s.p.progress.q.waiting);
                    let corrected = [0, 1].map(|k| now.see(|s| s.p.axes[k].w.corrected));
                    let correction = [0, 1].map(|k| now.see(|s| s.p.axes[k].w.deviation));
                    (driven, waiting, corrected, correction)
                })
                .unwrap();
            driven += u64::from(seen.0);
            ticks += 1;
            if number == 1 && seen.1 {
                // The commands stand while there is no path, but for what rounding left.
                let before = *corrected.get_or_insert(seen.2);
                assert!(
                    (0..2).all(|k| (seen.2[k] - before[k]).abs() <= 50),
                    "{seen:?}"
                );
            }
            if number == 1 && !seen.1 && seen.0 {
                // Along the axis nothing is corrected: not the first path's rest either. Beyond
                // the end the response is held by its rounding.
                assert!(
                    (0..=50).contains(&seen.3[0]) && seen.3[1] == 0,
                    "{:?}",
                    seen.3
                );
            }
        }
        assert!(!simulator.see(|s| s.w.late));
    }
    let position = [0, 1].map(|k| simulator.see(|s| s.p.axes[k].p.response.w.position));
    let expected = [end[0] - 20_000_000.0, end[1]];
    for k in 0..2 {
        assert!(
            (position[k] as f64 - expected[k]).abs() <= 52.0,
            "{position:?}"
        );
    }
    // Every period has its torque, with a path and without one.
    assert!(
        driven == ticks / PERIOD || driven + 1 == ticks / PERIOD,
        "{driven} torques in {ticks} ticks"
    );
}
