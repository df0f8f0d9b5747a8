//! Models that differ between the axes (¶0030): a line is left, a circle slants, and how much of that
//! the correction vector takes back.

use super::*;
use motion_rtl::jobs::trajectory_controller::each_axis::EachAxis;
use std::f64::consts::TAU;

/// K1 and K2 of x and y.
const K1: [f64; 2] = [50.0, 40.0];
const K2: [f64; 2] = [200.0, 250.0];
/// F in mm/s, and the period in s.
const FEED: f64 = 100.0;
const PERIOD: f64 = 1e-3;

fn unequal() -> Settings {
    Settings {
        k1_per_s: EachAxis::Each(K1.to_vec()),
        k2_per_s: EachAxis::Each(K2.to_vec()),
        ..settings()
    }
}

fn runs(pieces: &[Piece], correction: Correction) -> Run {
    let machine = [TwoMassParameters::default(); 2];
    run([0.0; 3], pieces, &unequal(), &machine, correction)
}

/// The gains a period that the words come to.
fn gains(axis: usize) -> [f64; 2] {
    [K1, K2].map(|of| (of[axis] * PERIOD * 32_768.0).round() / 32_768.0)
}

/// Delay of an axis at constant speed, in s.
fn lag(axis: usize) -> f64 {
    (1.0 / gains(axis)[0] - 1.0) * PERIOD
}

/// Where the models and the loads of a period are, in mm.
fn places(run: &Run, n: usize) -> [[f64; 2]; 2] {
    let period = &run.played.periods[n];
    let model = [0, 1].map(|k| period.model[k] as f64 / MM);
    [model, [0, 1].map(|k| period.load[k] / 1000.0)]
}

#[test]
fn a_line_is_left_by_what_the_lags_differ_in() {
    let (cos, sin) = (0.8, 0.6);
    let pieces = [line([60.0 * cos, 60.0 * sin, 0.0], FEED)];
    // Beside the line, to the left.
    let beside = |[x, y]: [f64; 2]| y * cos - x * sin;
    let exact = FEED * sin * cos * (lag(0) - lag(1));
    assert!((exact + 0.240).abs() < 1e-3, "{exact}");
    let plain = runs(&pieces, Correction::None);
    let vector = runs(&pieces, Correction::Vector);
    // Ramps of 50 ms; what was before is forgotten in 20 times of the slowest decay.
    for n in 400..600 {
        let [model, load] = places(&plain, n).map(beside);
        assert!((model - exact).abs() < 5e-4, "{n}: {model} {exact}");
        assert!((load - exact).abs() < 5e-3, "{n}: {load} {exact}");
        let [model, load] = places(&vector, n).map(beside);
        assert!(model.abs() < 5e-4, "{n}: {model}");
        assert!(load.abs() < 5e-3, "{n}: {load}");
    }
    // While the speed changes, the vector does not have it all.
    let [plain, vector] = [&plain, &vector].map(|run| run.measured().model.contour_max_um / 1e3);
    println!("line: {plain} {vector}");
    assert!((plain + exact).abs() < 1e-3, "{plain}");
    assert!(vector > 0.01 && vector < 0.5 * plain, "{vector}");
}

type Complex = [f64; 2];

fn times([a, b]: Complex, [c, d]: Complex) -> Complex {
    [a * c - b * d, a * d + b * c]
}

/// e^(jφ).
fn turned(angle: f64) -> Complex {
    [angle.cos(), angle.sin()]
}

/// z·k1·k2 / ((z − 1)² + k2(z − 1) + k1·k2): a model behind its step.
fn response(axis: usize, turn: f64) -> Complex {
    let ([k1, k2], z) = (gains(axis), turned(turn));
    let step = [z[0] - 1.0, z[1]];
    let square = times(step, step);
    let below = [square[0] + k2 * step[0] + k1 * k2, square[1] + k2 * step[1]];
    let size = below[0] * below[0] + below[1] * below[1];
    let over = [k1 * k2 * below[0] / size, -k1 * k2 * below[1] / size];
    times(z, over)
}

/// Response of the axis to e^(jωt) with a correction; the tangential response is that of the
/// slower axis.
fn answer(axis: usize, turn: f64, correction: Correction) -> Complex {
    let own = response(axis, turn);
    match correction {
        Correction::Vector => {
            let late = turned(-turn * lag(1) / PERIOD);
            times(own, [1.0 + late[0] - own[0], late[1] - own[1]])
        }
        _ => own,
    }
}

#[test]
fn a_circle_slants() {
    let turn = FEED / 10.0 * PERIOD;
    let mut peaks = Vec::new();
    for correction in [Correction::None, Correction::Vector] {
        let run = runs(&[arc(10.0, TAU, FEED)], correction);
        let answers = [0, 1].map(|axis| answer(axis, turn, correction));
        let (mut most, mut least, mut at) = (0.0f64, f64::INFINITY, 0.0);
        for n in 300..600 {
            let angle = run.played.periods[n].length as f64 / MM / 10.0;
            let [x, y] = answers.map(|answer| times(answer, turned(angle)));
            // Around the centre, at −10 on x.
            let exact = [10.0 * x[0], 10.0 * y[1]];
            let [model, load] = places(&run, n).map(|[x, y]| [x + 10.0, y]);
            for k in 0..2 {
                assert!(
                    (model[k] - exact[k]).abs() < 1e-3,
                    "{n}: {model:?} {exact:?}"
                );
                assert!((load[k] - exact[k]).abs() < 2e-2, "{n}: {load:?} {exact:?}");
            }
            let radius = model[0].hypot(model[1]);
            if radius > most {
                (most, at) = (
                    radius,
                    model[1].atan2(model[0]).rem_euclid(TAU / 2.0).to_degrees(),
                );
            }
            least = least.min(radius);
        }
        println!(
            "{correction:?}: {} to {} at {at}",
            most - 10.0,
            least - 10.0
        );
        peaks.push([most, least, at]);
    }
    let [plain, vector] = [peaks[0], peaks[1]];
    // Half of what the lags differ in, to and fro, about what the mean of both models shrinks by.
    let slant = 0.5 * 10.0 * turn * (lag(0) - lag(1)).abs() / PERIOD;
    assert!(
        (0.5 * (plain[0] - plain[1]) / slant - 1.0).abs() < 0.1,
        "{plain:?} {slant}"
    );
    // The long axis of the ellipse lies near 135 degrees: y is late.
    assert!((plain[2] - 135.0).abs() < 15.0, "{plain:?}");
    assert!(
        vector[0] - vector[1] < 0.25 * (plain[0] - plain[1]),
        "{vector:?}"
    );
}
