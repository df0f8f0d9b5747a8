//! Measures of commands, against what the geometry says.

use super::*;
use motion_rtl::circuits::arc_generator::{Rounding, Widths};
use motion_rtl::jobs::arc_generator::bounds::command_error;
use motion_rtl::jobs::arc_generator::measure::{Measured, Measuring, SampleMeasured};
use motion_rtl::jobs::arc_generator::prepare::prepare;
use motion_rtl::jobs::arc_generator::prepared::Kind;
use motion_rtl::jobs::arc_generator::record::records;
use motion_rtl::jobs::arc_generator::reference::commands;
use motion_rtl::jobs::arc_generator::settings::Settings;

const COUNTS: f64 = 1000.0;

/// A half circle of 20 mm radius, a line that leaves it smoothly, and a corner.
fn path() -> Prepared {
    let (a, b, c) = ([0.0; 3], [20.0, 12.0, 16.0], [40.0, 0.0, 0.0]);
    let down = [40.0, -18.0, -24.0];
    let pieces = [
        arc(a, b, c, 30.0),
        line(down, 40.0),
        line([80.0, -18.0, -24.0], 40.0),
    ];
    prepare(a, &pieces, &timing(64)).unwrap()
}

fn two_lines() -> Prepared {
    let pieces = [line([10.0, 0.0, 0.0], 20.0), line([20.0, 0.0, 0.0], 20.0)];
    prepare([0.0; 3], &pieces, &timing(64)).unwrap()
}

fn played(path: &Prepared) -> Vec<[i64; 3]> {
    let records = records(path, COUNTS, &Widths::FULL, Rounding::Nearest).unwrap();
    commands(&records, &Widths::FULL, Rounding::Nearest).collect()
}

fn settings() -> Settings {
    Settings {
        counts_per_mm: COUNTS,
        ..Settings::default()
    }
}

/// Measures of every sample.
fn samples(path: &Prepared, commands: &[[i64; 3]]) -> Vec<SampleMeasured> {
    let settings = settings();
    let mut measuring = Measuring::new(path, &settings);
    let each = commands.iter().map(|counts| measuring.take(*counts));
    each.map(Option::unwrap).collect()
}

#[test]
fn jumps_at_the_joints_are_those_of_the_report() {
    let path = path();
    let kinds: Vec<_> = path.segments.iter().map(Segment::kind).collect();
    use Kind::{Arc, Blend, Line};
    assert_eq!(kinds, [Blend, Arc, Blend, Line, Blend, Blend, Line, Blend]);
    let measured = Measured::of(&path, &settings(), &played(&path)).unwrap();
    let report = path.pieces[0].arc.unwrap();
    assert_eq!(measured.joints.len(), 7);
    for (index, joint) in measured.joints.iter().enumerate() {
        assert_eq!(
            (joint.segment, joint.sample),
            (index, path.segments[index].end())
        );
        println!(
            "{joint:?} of {} {}",
            report.direction_jump, report.acceleration_jump
        );
        // Into and out of the arc, else everything meets.
        let (direction, acceleration) = match index {
            0 | 1 => (report.direction_jump, report.acceleration_jump),
            _ => (0.0, 0.0),
        };
        assert!(
            (joint.direction_jump_deg.to_radians() - direction).abs() < 0.004,
            "{joint:?}"
        );
        assert!(
            (joint.acceleration_jump_mm_per_s2 - acceleration).abs() < 40.0,
            "{joint:?}"
        );
        let speed = 2.0 * path.pieces[0].speed * (direction / 2.0).sin();
        assert!(
            (joint.velocity_jump_mm_per_s - speed).abs() < 0.2,
            "{joint:?}"
        );
    }
    let [arc] = &measured.arcs[..] else {
        panic!("one arc")
    };
    let seen: Vec<_> = arc.ends.iter().map(|end| (end.at, end.rest)).collect();
    assert_eq!(seen, [("A+", true), ("C-", false)]);
    for (end, joint) in arc.ends.iter().zip(&measured.joints) {
        let [direction, acceleration] = [end.direction_jump_deg, end.acceleration_jump_mm_per_s2];
        assert_eq!(direction.measured, joint.direction_jump_deg);
        assert_eq!(direction.expected, report.direction_jump.to_degrees());
        assert_eq!(acceleration.measured, joint.acceleration_jump_mm_per_s2);
        assert_eq!(acceleration.expected, report.acceleration_jump);
    }
    let [begin, end] = [arc.ends[0], arc.ends[1]];
    let off = begin.off_arc_um.unwrap();
    assert_eq!(off.measured, measured.blends[0].off_path_um);
    assert_eq!(off.expected, report.blend_distance * 1e3);
    assert_eq!((end.off_arc_um, end.off_arc_estimate_um), (None, None));
    let lines: Vec<_> = measured
        .lines
        .iter()
        .map(|line| (line.piece, line.length_mm))
        .collect();
    assert_eq!(lines, [(1, 30.0), (2, 40.0)]);
    // 4.8 mm/100 over 40 mm, and v²/R.
    assert!((report.direction_jump - 0.024).abs() < 1e-3);
    assert!((report.acceleration_jump - 45.0).abs() < 0.5);
}

#[test]
fn speeds_and_distances_are_measured() {
    let path = path();
    let commands = played(&path);
    let measured = Measured::of(&path, &settings(), &commands).unwrap();
    let seen = samples(&path, &commands);
    let speeds: Vec<_> = seen.iter().filter_map(|sample| sample.speed).collect();
    assert_eq!(speeds.len(), commands.len() - 1);
    let [before, arc] = [path.segments[0], path.segments[1]];
    // A count a millisecond is 60 mm/min; each end of a step is off by √3/2 at most.
    for (sample, speed) in speeds.iter().enumerate() {
        assert!(*speed < 40.0 + 3f64.sqrt(), "{sample}: {speed}");
    }
    let own = &speeds[arc.first_sample as usize..arc.end() as usize];
    assert!(
        own.iter()
            .all(|speed| (speed - 30.0).abs() < 0.1 + 3f64.sqrt())
    );
    let [round] = &measured.arcs[..] else {
        panic!("one arc")
    };
    assert_eq!(round.segment, 1);
    let most = command_error(20_000.0, arc.samples, &Widths::FULL, Rounding::Nearest);
    let [least, largest] = round.radius_error_um;
    assert!(-most <= least && largest <= most);
    assert!(least < -0.3 && largest > 0.3);
    assert!(round.off_plane_um < most && round.off_plane_um > 0.3 && round.end_error_um < most);
    assert!((round.speed_mm_per_s.measured / path.pieces[0].speed - 1.0).abs() < 0.01);
    assert!(measured.error_max_um < most && measured.error_max_um > 0.5);
    // A count is a micrometre. The arc's bound is larger than that of lines and blends.
    assert!((round.bound_um - most).abs() < 1e-12, "{round:?}");
    assert_eq!(measured.error_bound_um, round.bound_um);
    let straight = Measured::planned(&two_lines(), &settings()).error_bound_um;
    assert!((straight - 0.75f64.sqrt()).abs() < 1e-4 && straight > 0.75f64.sqrt());
    // Blends: from rest on the chord.
    let report = path.pieces[0].arc.unwrap();
    assert_eq!(measured.blends.len(), 5);
    let first = measured.blends[0];
    assert!(
        (first.off_path_um - report.blend_distance * 1e3).abs() < 0.9,
        "{first:?}"
    );
    assert_eq!((first.kind, first.corner_distance_um), ("from rest", None));
    let peak = before.peak_acceleration(&path.timing).unwrap();
    // One second difference of counts may be off by 4·√3/2, their fit is not.
    assert!(
        (first.peak_acceleration_mm_per_s2.measured / peak - 1.0).abs() < 0.005,
        "{first:?} {peak}"
    );
    assert_eq!(first.peak_acceleration_mm_per_s2.expected, peak);
    // The stop is no joint; the blend from arc to line passes its corner as its points do.
    assert_eq!(
        (measured.blends[2].kind, measured.blends[2].turn_deg),
        ("to rest", None)
    );
    let points = (0..=64).map(|step| path.segments[2].point(step));
    let nearest = points
        .map(|p| length(minus(p, path.pieces[0].to)))
        .fold(1.0, f64::min);
    let corner = measured.blends[1];
    let distance = corner.corner_distance_um.unwrap();
    assert!(
        (distance.measured / 1e3 - nearest).abs() < 0.001 && nearest < 0.02,
        "{corner:?}"
    );
    let half_way = path.segments[2].corner_distance().unwrap();
    assert_eq!(distance.expected, half_way * 1e3);
    assert_eq!((corner.kind, corner.piece), ("joint", 0));
    assert!(corner.turn_deg.unwrap().abs() < 1e-6, "{corner:?}");
}

#[test]
fn a_wrong_sample_is_found() {
    let path = path();
    let mut commands = played(&path);
    let arc = path.segments[1];
    let sample = (arc.first_sample + 100) as usize;
    commands[sample][0] += 50;
    let measured = Measured::of(&path, &settings(), &commands).unwrap();
    assert!(measured.error_max_um > 49.0);
    let seen = samples(&path, &commands);
    let accelerations = seen.iter().filter_map(|sample| sample.acceleration);
    assert!(accelerations.max_by(f64::total_cmp) > Some(90_000.0));
    assert!(seen[sample + 1].acceleration > Some(90_000.0));
    commands.pop();
    assert_eq!(Measured::of(&path, &settings(), &commands), None);
}

/// Every measure as it is defined, from all samples at once.
#[test]
fn measures_are_those_of_all_samples_at_once() {
    let path = path();
    let mut commands = played(&path);
    // Something to measure in each kind of segment, at its first and last sample too.
    for segment in &path.segments {
        for (place, sample) in [
            segment.first_sample,
            segment.first_sample + 5,
            segment.end(),
        ]
        .into_iter()
        .enumerate()
        {
            commands[sample as usize][place] += 3 * (place as i64 - 2) + 1;
        }
    }
    let points: Vec<_> = commands
        .iter()
        .map(|c| c.map(|counts| counts as f64 / COUNTS))
        .collect();
    let (ts, largest) = (path.timing.sample_s, |all: &[f64]| {
        all.iter().copied().fold(f64::NEG_INFINITY, f64::max)
    });
    let seen = samples(&path, &commands);
    for (k, sample) in seen.iter().enumerate() {
        let segment = path
            .segments
            .iter()
            .position(|segment| k as u64 <= segment.end());
        assert_eq!((sample.sample, Some(sample.segment)), (k as u64, segment));
        assert_eq!(sample.point, points[k]);
        assert_eq!(
            sample.error,
            length(minus(path.point(k as u64).unwrap(), points[k]))
        );
        let speed = k
            .checked_sub(1)
            .map(|before| length(minus(points[k], points[before])) / ts);
        assert_eq!(sample.speed, speed);
        let second = |k: usize| {
            minus(
                minus(points[k], points[k - 1]),
                minus(points[k - 1], points[k - 2]),
            )
        };
        assert_eq!(
            sample.acceleration,
            (k > 1).then(|| length(second(k)) / (ts * ts))
        );
    }
    let measured = Measured::of(&path, &settings(), &commands).unwrap();
    assert_eq!(
        measured.error_max_um,
        1e3 * largest(&seen.iter().map(|sample| sample.error).collect::<Vec<_>>())
    );
    let own = |segment: usize| {
        &points
            [path.segments[segment].first_sample as usize..=path.segments[segment].end() as usize]
    };
    for blend in &measured.blends {
        let (segment, own) = (&path.segments[blend.segment], own(blend.segment));
        let Shape::Blend { corner, .. } = segment.shape else {
            panic!("another kind")
        };
        assert_eq!(
            blend.off_path_um,
            1e3 * largest(
                &own.iter()
                    .map(|p| path.distance(segment, *p))
                    .collect::<Vec<_>>()
            )
        );
        let nearest = own.iter().map(|p| length(minus(*p, corner)));
        let nearest = nearest.fold(f64::INFINITY, f64::min);
        let joint = segment.next_piece.is_some();
        let seen = blend.corner_distance_um.map(|pair| pair.measured);
        assert_eq!(seen, joint.then_some(nearest * 1e3));
        // The factor of least squares of the blend's shape in the second differences.
        let n = segment.samples as f64;
        let shape = |k: usize| 4.0 * (k as f64 / n) * (1.0 - k as f64 / n) - 2.0 / (3.0 * n * n);
        let seconds: Vec<_> = own
            .windows(3)
            .map(|p| minus(minus(p[2], p[1]), minus(p[1], p[0])))
            .collect();
        let square: f64 = (1..=seconds.len()).map(|k| shape(k).powi(2)).sum();
        let along = [0, 1, 2].map(|c| {
            seconds
                .iter()
                .zip(1..)
                .map(|(second, k)| second[c] * shape(k))
                .sum::<f64>()
        });
        let peak = length(along) / square / (ts * ts);
        assert!(
            (blend.peak_acceleration_mm_per_s2.measured / peak - 1.0).abs() < 1e-12,
            "{blend:?} {peak}"
        );
    }
    let [arc] = &measured.arcs[..] else {
        panic!("one arc")
    };
    let (segment, own) = (&path.segments[arc.segment], own(arc.segment));
    let Shape::Arc { circle, .. } = segment.shape else {
        panic!("another kind")
    };
    let off: Vec<_> = own.iter().map(|p| circle.off(*p)).collect();
    let outside: Vec<_> = off.iter().map(|off| off[0]).collect();
    let inwards: Vec<_> = outside.iter().map(|off| -off).collect();
    assert_eq!(
        arc.radius_error_um,
        [-largest(&inwards), largest(&outside)].map(|mm| mm * 1e3)
    );
    assert_eq!(
        arc.off_plane_um,
        1e3 * largest(&off.iter().map(|off| off[1].abs()).collect::<Vec<_>>())
    );
    assert_eq!(
        arc.end_error_um,
        1e3 * length(minus(own[own.len() - 1], segment.point(segment.samples)))
    );
    let rms = (outside.iter().map(|off| off * off).sum::<f64>() / own.len() as f64).sqrt();
    assert!((arc.radius_error_rms_um / 1e3 / rms - 1.0).abs() < 1e-12);
    let steps: Vec<_> = own.windows(2).map(|p| length(minus(p[1], p[0]))).collect();
    let mean = steps.iter().sum::<f64>() / (ts * segment.samples as f64);
    assert!((arc.speed_mm_per_s.measured / mean - 1.0).abs() < 1e-12);
    let wanted = path.pieces[segment.piece].speed;
    let deviations: Vec<_> = steps
        .iter()
        .map(|step| (step / ts - wanted).abs())
        .collect();
    assert_eq!(arc.speed_deviation_mm_per_s, largest(&deviations));
}

/// On either side as many samples as a blend has, and the joint itself.
#[test]
fn a_joint_is_measured_with_the_samples_next_to_it() {
    let path = path();
    let commands = played(&path);
    let joints = |commands: &[[i64; 3]]| Measured::of(&path, &settings(), commands).unwrap().joints;
    let (all, most) = (joints(&commands), path.timing.blend_samples);
    let arc = path.segments[1];
    // Into the arc and out of it, which is longer than a blend.
    for (joint, within, beyond) in [
        (0, arc.first_sample + most, arc.first_sample + most + 1),
        (1, arc.end() - most, arc.end() - most - 1),
    ] {
        for (sample, counts) in [(within, true), (beyond, false)] {
            let mut moved = commands.clone();
            moved[sample as usize][1] += 20;
            assert_eq!(joints(&moved)[joint] != all[joint], counts, "{sample}");
        }
    }
}
