//! Errors that are fed back: a circle by its closed form, the jump at a corner, the gains with which
//! the loop grows.

use super::*;
use motion_rtl::jobs::trajectory_controller::closed::Fed;
use motion_rtl::jobs::trajectory_controller::job::Period;
use motion_rtl::jobs::trajectory_controller::load_torque::{AxisName, LoadTorque};
use std::f64::consts::TAU;

fn fed(tangential_gain: f64, normal_gain: f64) -> Settings {
    Settings {
        tangential_gain,
        normal_gain,
        ..settings()
    }
}

/// Measured over the closed form in µm, outwards negative: equal gains, the normal one alone that
/// makes it worse, both, the tangential one alone.
#[test]
#[ignore = "takes long"]
fn a_circle_by_the_closed_form() {
    for (tangential, normal, um) in [
        (1.0, 1.0, -0.793),
        (0.0, 0.25, 35.529),
        (0.0, 1.0, -46.186),
        (2.0, 0.0, 8.711),
        (4.0, 4.0, -11.417),
    ] {
        let pieces = [arc(10.0, TAU, 100.0)];
        let machine = [TwoMassParameters::default(); 2];
        let settings = fed(tangential, normal);
        let run = run([0.0; 3], &pieces, &settings, &machine, Correction::Feedback);
        let steady = run.steady();
        let form = 1e3 * steady.forms.sampled.feedback;
        assert!((form - um).abs() < 0.001, "{form}, not {um}");
        let form = recursion(tangential, normal, Fed::of(&run.program).lead);
        assert!((form - um).abs() < 0.001, "{form}, not {um}");
        // The motors are off their models by what the period's torque is late.
        let mean = 1e3 * steady.model_mm;
        let off = mean - um.abs();
        assert!(off.abs() < 0.5 + 0.01 * um.abs(), "{mean}, not {um}");
    }
}

/// The circle step by step, motors on their models, sampled `lead` periods before the end of each.
fn recursion(tangential: f64, normal: f64, lead: f64) -> f64 {
    let [k1, k2] = [1638.0, 6554.0].map(|word| word / 32_768.0);
    let (mut p, mut v) = ([10.0, 0.0], [0.0; 2]);
    for n in 0..20_000 {
        let (sin, cos) = (0.01 * f64::from(n)).sin_cos();
        let seen = [0, 1].map(|axis| p[axis] + (1.0 - lead) * v[axis]);
        let error = [10.0 * cos - seen[0], 10.0 * sin - seen[1]];
        let across = error[0] * cos + error[1] * sin;
        let along = error[1] * cos - error[0] * sin;
        let (across, along) = (normal * across, tangential * along);
        let u = [
            10.0 * cos + across * cos - along * sin,
            10.0 * sin + across * sin + along * cos,
        ];
        for axis in 0..2 {
            let a = k2 * (k1 * (u[axis] - p[axis]) - v[axis]);
            p[axis] += v[axis];
            v[axis] += a;
        }
    }
    1e3 * (10.0 - p[0].hypot(p[1]))
}

/// Correction added to the commands, in mm.
fn added(run: &Run) -> Vec<[f64; 2]> {
    let periods = run.played.periods.iter();
    let of = |period: &Period| {
        [0, 1].map(|axis| (period.corrected[axis] - period.command[axis]) as f64 / MM)
    };
    periods.map(of).collect()
}

/// The largest change of it from a period to the next, and that period.
fn jump(added: &[[f64; 2]]) -> (f64, usize) {
    let steps = added.windows(2).enumerate().map(|(n, pair)| {
        let change = [0, 1].map(|axis| pair[1][axis] - pair[0][axis]);
        (change[0].hypot(change[1]), n + 1)
    });
    steps.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap()
}

/// Along a line all of the error is tangential; in the first period behind a corner of 90° the same
/// error is normal, and is fed back by the other gain (¶0010).
#[test]
fn at_a_corner_it_jumps() {
    let corner = [
        line([15.0, 0.0, 0.0], 100.0),
        line([15.0, 10.0, 0.0], 100.0),
    ];
    let machine = [TwoMassParameters::default(); 2];
    let seen = |correction, tangential, normal| {
        let settings = Settings {
            corner_mm_per_min: 12_000.0,
            ..fed(tangential, normal)
        };
        let run = run([0.0; 3], &corner, &settings, &machine, correction);
        let added = added(&run);
        let (size, at) = jump(&added);
        let periods = &run.played.periods;
        let behind = periods.iter().position(|period| period.command[1] > 0);
        let late = periods[at].command[0] as f64 / MM - periods[at].motor[0] as f64 / 1e3;
        let ticks = periods[..100].iter().map(|period| period.tick);
        let jumps = [size, late, added[at - 1][0].hypot(added[at - 1][1])];
        (jumps, behind == Some(at), ticks.collect::<Vec<_>>())
    };
    let ([size, late, before], at_corner, ticks) = seen(Correction::Feedback, 0.0, 4.0);
    println!("feedback 0, 4: {size} mm, {late} late");
    assert!(at_corner && before < 0.01, "{before}");
    // The motor is seen a little before it is compared with its model.
    let way = 100.0 * 63.0 / 400.0 * 1e-3;
    assert!((size / 4.0 - late - way).abs() < 0.01, "{size}, {late}");
    assert!((size - 7.272).abs() < 0.01, "{size}");
    // With equal gains there is no direction to jump.
    let ([even, ..], ..) = seen(Correction::Feedback, 1.0, 1.0);
    let ([vector, ..], _, as_vector) = seen(Correction::Vector, 0.0, 0.0);
    // Whatever is added, the motors are looked at in the same ticks.
    assert_eq!(ticks, as_vector);
    println!("feedback 1, 1: {even} mm; vector: {vector} mm");
    assert!(even < 0.2 && vector < 0.2, "{even}, {vector}");
}

/// The error across a line, or along it, a period after the other, from a millimetre on: model, motor
/// and its loops, with the torque of a period from `late` after the look at the motor on, and seen
/// `lead` before the next look.
fn loop_of(gain: f64, lead: f64, late: f64, loops: bool) -> f64 {
    let [k1, k2] = [1638.0, 6554.0].map(|word| word / 32_768.0);
    let [position, speed] = [0.030, TAU * 17.0 * 1e-3];
    let move_on = |x: &mut f64, w: &mut f64, a: f64, t: f64| {
        *x += *w * t + a * t * t / 2.0;
        *w += a * t;
    };
    let (mut p, mut v, mut x, mut w) = (1.0, 0.0, 1.0, 0.0);
    let (mut torque, mut integral, mut before, mut seen) = (0.0, 0.0, 1.0, 1.0);
    let mut sizes = [0.0f64; 2];
    for n in 0..2000 {
        let a = k2 * (k1 * (-gain * seen - p) - v);
        let way = v;
        p += v;
        v += a;
        let off = way + position * (p - x) - (x - before);
        before = x;
        integral += speed * off / 40.0;
        let wanted = a + if loops { speed * off + integral } else { 0.0 };
        move_on(&mut x, &mut w, torque, late);
        torque = wanted;
        move_on(&mut x, &mut w, torque, 1.0 - lead - late);
        seen = x;
        move_on(&mut x, &mut w, torque, lead);
        let half: f64 = sizes[n / 1000];
        sizes[n / 1000] = half.max(if n % 1000 > 700 { x.abs() } else { 0.0 });
    }
    sizes[1] / sizes[0]
}

/// The gain from which on it grows.
fn bound(of: impl Fn(f64) -> f64) -> f64 {
    let (mut decays, mut grows) = (1.0, 60.0);
    for _ in 0..30 {
        let gain = f64::midpoint(decays, grows);
        *(if of(gain) < 1.0 {
            &mut decays
        } else {
            &mut grows
        }) = gain;
    }
    decays
}

#[test]
#[ignore = "takes long"]
fn beyond_the_bound_the_loop_grows() {
    let ticks = |ticks: f64| ticks / LEAST_PERIOD_TICKS as f64;
    let (lead, late) = (ticks(63.0), ticks(102.0));
    // By Jury, of a motor that has the model's acceleration, but later.
    let jury = (32_768.0 / 1638.0 - 1.0) / (0.5 + lead + late);
    let open = bound(|gain| loop_of(gain, lead, late, false));
    assert!((open / jury - 1.0).abs() < 0.03, "{open}, not {jury}");
    let closed = bound(|gain| loop_of(gain, lead, late, true));
    println!("Jury {jury:.1}, without the loops {open:.1}, with them {closed:.1}");
    // A stiff shaft, and counts of 0.1 µm. It begins with a torque for ten periods.
    let machine = [TwoMassParameters {
        max_torque_nm: 20.0,
        stiffness_nm_per_rad: 100_000.0,
        damping_nm_s_per_rad: 1.0,
        counts_per_rev: 100_000.0,
        ..TwoMassParameters::default()
    }; 2];
    let errors = |tangential: f64, normal: f64, torque_nm: f64| {
        let settings = Settings {
            counts_per_mm: 10_000.0,
            // The path itself is no push.
            acceleration_mm_per_s2: Some(20.0),
            jerk_time_ms: 50.0,
            load_torque: vec![LoadTorque {
                axis: if normal > 0.0 {
                    AxisName::Y
                } else {
                    AxisName::X
                },
                torque_nm,
                from_s: 0.2,
                to_s: Some(0.21),
            }],
            ..fed(tangential, normal)
        };
        let pieces = [line([0.6, 0.0, 0.0], 1.0)];
        let program = Program::of([0.0; 3], &pieces, &settings, &machine, &Widths::FULL).unwrap();
        let circuit = controller(2, Correction::Feedback, settings.rounding);
        let plants = plants(&machine, 1.0 / settings.clock_hz as f64);
        // An unstable loop does not settle.
        let played = play(&circuit, &program, plants, &mut ()).unwrap();
        // Deviation from a steady run along x: the change of the lag, or y.
        let periods = &played.periods;
        let off = |n: usize| match normal > 0.0 {
            true => periods[n].motor[1] as f64,
            false => {
                let lag =
                    |n: usize| periods[n].command[0] as f64 / COUNT - periods[n].motor[0] as f64;
                lag(n) - lag(n - 1)
            }
        };
        let largest = |from: usize| {
            (from..from + 30)
                .map(off)
                .fold(0.0, |a: f64, b| a.max(b.abs()))
        };
        [largest(215), largest(450)]
    };
    for (part, torque_nm, grows) in [(0.93, 4.0, false), (1.07, 0.5, true)] {
        let gain = part * closed;
        let both = [errors(0.0, gain, torque_nm), errors(gain, 0.0, torque_nm)];
        for [early, late] in both {
            println!("{gain:.2}: {early} to {late} counts");
            assert!(early > 10.0);
            let right = match grows {
                true => late > 2.0 * early,
                false => late < 0.5 * early,
            };
            assert!(right, "{gain}: {early} to {late}");
        }
    }
}
