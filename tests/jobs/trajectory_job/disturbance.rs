//! Two degrees of freedom (¶0029): commands are answered by the model's gains K1 and K2, torques from
//! outside by the position and speed controls 27 and 29. And what a wrong inertia does to that.

use super::*;
use motion_rtl::jobs::trajectory_controller::each_axis::EachAxis;
use motion_rtl::jobs::trajectory_controller::load_torque::{
    AxisName, LoadStep, LoadTorque, load_steps,
};
use std::f64::consts::TAU;

/// Inertia of the default axis, in kg·m².
const INERTIA: f64 = 3e-3;
/// Counts of a radian.
const RAD: f64 = 10_000.0 / TAU;
/// The torque from outside, in N·m, and when it comes.
const TORQUE: f64 = 0.5;
const FROM_S: f64 = 0.2;

/// Gains of models and loops.
#[derive(Clone, Copy)]
struct Gains {
    k1: f64,
    k2: f64,
    position: f64,
    speed_hz: f64,
    integral_ms: f64,
}

const USUAL: Gains = Gains {
    k1: 50.0,
    k2: 200.0,
    position: 30.0,
    speed_hz: 17.0,
    integral_ms: 40.0,
};

/// A line of 80 mm along x at 100 mm/s.
fn along_x(gains: Gains, change: impl FnOnce(&mut Settings)) -> Run {
    let mut settings = Settings {
        k1_per_s: gains.k1.into(),
        k2_per_s: gains.k2.into(),
        position_gain_per_s: gains.position,
        speed_hz: gains.speed_hz,
        integral_ms: gains.integral_ms,
        ..settings()
    };
    change(&mut settings);
    let machine = [TwoMassParameters::default(); 2];
    let pieces = [line([80.0, 0.0, 0.0], 100.0)];
    run([0.0; 3], &pieces, &settings, &machine, Correction::Vector)
}

fn pushed(settings: &mut Settings) {
    settings.load_torque = vec![LoadTorque {
        axis: AxisName::X,
        torque_nm: TORQUE,
        from_s: FROM_S,
        to_s: None,
    }];
}

/// Lead of the motor over its model, in counts, period by period.
fn ahead(run: &Run) -> Vec<f64> {
    let periods = run.played.periods.iter();
    periods
        .map(|period| period.motor[0] as f64 - period.model[0] as f64 / COUNT)
        .collect()
}

/// Effect of the torque on the motor: the run with it less the run without.
fn moved(gains: Gains) -> Vec<f64> {
    let [with, without] = [along_x(gains, pushed), along_x(gains, |_| ())];
    let pairs = with.played.periods.iter().zip(&without.played.periods);
    pairs
        .map(|(with, without)| {
            // The models know nothing of it.
            assert_eq!(with.model, without.model);
            assert_eq!(with.corrected, without.corrected);
            (with.motor[0] - without.motor[0]) as f64
        })
        .collect()
}

fn peak(of: &[f64]) -> f64 {
    of.iter().fold(
        0.0,
        |peak, &x| if x.abs() > f64::abs(peak) { x } else { peak },
    )
}

/// Position and speed control as the text has them, around one stiff inertia, in periods of 1 ms with
/// the torque a quarter of one late: how far the motor is ahead of its model, in counts, under this
/// torque.
fn stiff(gains: Gains, torque: impl Fn(usize) -> f64, periods: usize) -> Vec<f64> {
    let (t, kp) = (1e-3, INERTIA * TAU * gains.speed_hz);
    let ki = match gains.integral_ms > 0.0 {
        true => kp / (gains.integral_ms / 1e3),
        false => 0.0,
    };
    let (mut x, mut v, mut before, mut integral, mut drive) = (0.0, 0.0, 0.0, 0.0, 0.0);
    let mut seen = Vec::new();
    for n in 0..periods {
        seen.push(x * RAD);
        let error = -gains.position * x - (x - before) / t;
        before = x;
        integral += ki * t * error;
        let next = kp * error + integral;
        for (part, driven) in [(0.25 * t, drive), (0.75 * t, next)] {
            let a = (driven + torque(n)) / INERTIA;
            x += part * (v + 0.5 * part * a);
            v += part * a;
        }
        drive = next;
    }
    seen
}

#[test]
#[ignore = "takes long"]
fn a_torque_from_outside_is_answered_by_the_loops_alone() {
    let usual = moved(USUAL);
    let first = usual.iter().position(|&d| d != 0.0).unwrap();
    assert!((200..210).contains(&first), "{first}");
    // The models' gains do not matter.
    for (k1, k2) in [(25.0, 100.0), (30.0, 200.0), (80.0, 400.0)] {
        let other = moved(Gains { k1, k2, ..USUAL });
        for (n, (one, other)) in usual.iter().zip(&other).enumerate() {
            assert!((one - other).abs() <= 3.0, "{n}: {one} {other}");
        }
    }
    // The gains of the loops matter, by the expected factors.
    let mut peaks = Vec::new();
    for (position, speed_hz, integral_ms) in [
        (30.0, 17.0, 40.0),
        (30.0, 8.5, 40.0),
        (15.0, 17.0, 40.0),
        (30.0, 17.0, 80.0),
    ] {
        let gains = Gains {
            position,
            speed_hz,
            integral_ms,
            ..USUAL
        };
        let seen = moved(gains);
        let stiff = stiff(gains, |n| if n > 200 { TORQUE } else { 0.0 }, seen.len());
        let (own, expected) = (peak(&seen), peak(&stiff));
        println!("{position} {speed_hz} {integral_ms}: {own} {expected}");
        assert!((own / expected - 1.0).abs() < 0.1, "{own} {expected}");
        // In the end the integral has it: its way is the torque by its gain.
        let area: f64 = seen.iter().sum::<f64>() * 1e-3;
        let ki = INERTIA * TAU * speed_hz / (integral_ms / 1e3);
        let exact = TORQUE / (ki * position) * RAD;
        assert!((area / exact - 1.0).abs() < 0.05, "{area} {exact}");
        peaks.push(own);
    }
    assert!(peaks[1] > 1.4 * peaks[0], "{peaks:?}");
    assert!(peaks[2] > 1.1 * peaks[0], "{peaks:?}");
    assert!(peaks[3] > 1.05 * peaks[0], "{peaks:?}");
    // Without an integral it stays where the position control holds it.
    let none = Gains {
        integral_ms: 0.0,
        ..USUAL
    };
    let seen = moved(none);
    let exact = TORQUE / (INERTIA * TAU * 17.0 * 30.0) * RAD;
    let last = seen[seen.len() - 1];
    assert!((last - exact).abs() < 2.0, "{last} {exact}");
}

#[test]
#[ignore = "takes long"]
fn a_command_is_answered_by_the_model_alone() {
    // v/K1 less the period in which the model already moves.
    let lag = |run: &Run| {
        let period = &run.played.periods[400];
        (period.command[0] as f64 / COUNT - period.motor[0] as f64) / 1000.0
    };
    let usual = along_x(USUAL, |_| ());
    for (k1, k2) in [(50.0, 200.0), (25.0, 100.0), (25.0, 200.0)] {
        for (position, speed_hz, integral_ms) in [(30.0, 17.0, 40.0), (15.0, 8.5, 80.0)] {
            let run = along_x(
                Gains {
                    k1,
                    k2,
                    position,
                    speed_hz,
                    integral_ms,
                },
                |_| (),
            );
            let off = peak(&ahead(&run));
            println!("{k1} {position}: {off}");
            assert!(off.abs() < 25.0, "{off}");
            let (seen, exact) = (lag(&run), 100.0 * (1.0 / k1 - 1e-3));
            assert!((seen - exact).abs() < 0.005, "{seen} {exact}");
            if (k1, k2) == (50.0, 200.0) {
                let models = |run: &Run| {
                    run.played.periods[..700]
                        .iter()
                        .map(|p| p.model)
                        .collect::<Vec<_>>()
                };
                assert_eq!(models(&run), models(&usual));
            }
        }
    }
}

#[test]
#[ignore = "takes long"]
fn a_wrong_inertia_is_a_torque_from_outside() {
    let told = |factor: f64| {
        let run = along_x(USUAL, |settings| {
            settings.inertia_factor = EachAxis::All(factor)
        });
        let ahead = ahead(&run);
        (run, ahead)
    };
    let (run, none) = told(0.0);
    // The model's acceleration, in rad/s².
    let model: Vec<f64> = run
        .played
        .periods
        .iter()
        .map(|p| p.model[0] as f64 / COUNT / RAD)
        .collect();
    let missing = |n: usize| {
        let at = |n: usize| model.get(n).or(model.last()).copied().unwrap_or(0.0);
        -INERTIA * (at(n + 1) - 2.0 * at(n) + at(n.max(1) - 1)) / 1e-6
    };
    let expected = peak(&stiff(USUAL, missing, none.len())).abs();
    let own = peak(&none).abs();
    println!("without: {own} {expected}");
    assert!((own / expected - 1.0).abs() < 0.1, "{own} {expected}");
    // The effect of the shaft's compliance is there with the right inertia too.
    let (_, right) = told(1.0);
    for factor in [0.5, 1.5, 2.0] {
        let (_, seen) = told(factor);
        println!("{factor}: {}", peak(&seen));
        let parts = none.iter().zip(&right);
        let parts = parts.map(|(none, right)| (1.0 - factor) * none + factor * right);
        for (n, (one, part)) in seen.iter().zip(parts).enumerate() {
            assert!((one - part).abs() < 8.0, "{factor} {n}: {one} {part}");
        }
    }
}

#[test]
fn torques_of_one_axis_add_and_end() {
    let torque = |axis, torque_nm, from_s, to_s| LoadTorque {
        axis,
        torque_nm,
        from_s,
        to_s,
    };
    let torques = [
        torque(AxisName::X, 0.1, 0.0, Some(0.3)),
        torque(AxisName::X, 0.2, 0.1, None),
        torque(AxisName::Y, -3.0, 0.1, Some(0.10049)),
    ];
    let step = |tick, axis, torque_nm| LoadStep {
        tick,
        axis,
        torque_nm,
    };
    let (one, both, two) = (0.1, 0.1 + 0.2, 0.2);
    assert_eq!(
        load_steps(&torques[..2], 2, 1000).unwrap(),
        [
            step(0, 0, one),
            step(0, 1, 0.0),
            step(100, 0, both),
            step(100, 1, 0.0),
            step(300, 0, two),
            step(300, 1, 0.0),
        ]
    );
    // Shorter than a tick is none.
    let steps = load_steps(&torques[2..], 2, 1000).unwrap();
    assert_eq!(steps, [step(100, 0, 0.0), step(100, 1, 0.0)]);
    assert_eq!(load_steps(&[], 3, 1000).unwrap(), []);
}
