//! A circle at constant speed: contour errors against closed forms, and the loads against physics.

use super::*;
use motion_rtl::jobs::trajectory_controller::closed::{Steady, SteadySearch};
use motion_rtl::jobs::trajectory_controller::measure::Measured;
use std::f64::consts::TAU;

/// Contour errors of a circle of 10 mm by the models' recursion, run until it is steady: with a turn a
/// period and gains a period. Of radius, and of its size.
pub fn closed(correction: Correction, turn: f64, k1: f64, k2: f64) -> [f64; 2] {
    let (mut p, mut v) = ([[0.0; 2]; 2], [[0.0; 2]; 2]);
    let (mut s, mut w) = (0.0, 0.0);
    let widened = 1.0 + turn * turn / 2.0 * (1.0 / (k1 * k1) - 1.0 / k1 - 2.0 / (k1 * k2));
    let mut error = 0.0;
    for n in 0..20_000 {
        let angle = turn * f64::from(n);
        let pull = k2 * (k1 * (angle - s) - w);
        (s, w) = (s + w, w + pull);
        let point = |angle: f64, axis: usize| match axis {
            0 => 10.0 * angle.cos(),
            _ => 10.0 * angle.sin(),
        };
        for axis in 0..2 {
            let mut step = |model: usize, u: f64| {
                let pull = k2 * (k1 * (u - p[model][axis]) - v[model][axis]);
                p[model][axis] += v[model][axis];
                v[model][axis] += pull;
                p[model][axis]
            };
            let command = point(angle, axis);
            let response = step(0, command);
            step(
                1,
                match correction {
                    Correction::None => command,
                    Correction::Vector => command + point(s, axis) - response,
                    Correction::Steady => widened * command,
                    Correction::Feedback => unreachable!("it has a recursion of its own"),
                },
            );
        }
        error = 10.0 - p[1][0].hypot(p[1][1]);
    }
    [error, error.abs()]
}

#[track_caller]
fn close(seen: f64, expected: f64, part: f64) {
    assert!(
        (seen / expected - 1.0).abs() < part,
        "{seen}, not {expected}"
    );
}

#[test]
fn in_periods_of_a_millisecond() {
    for correction in ALL {
        let machine = [TwoMassParameters::default(); 2];
        let run = run(
            [0.0; 3],
            &[arc(10.0, TAU, 100.0)],
            &settings(),
            &machine,
            correction,
        );
        let (measured, steady) = (run.measured(), run.steady());
        let model = steady.model_mm;
        let forms = steady.forms;
        close(forms.radius_mm, 10.0, 1e-6);
        close(forms.speed_mm_per_s, 100.0, 1e-6);
        let [signed, size] = closed(correction, 0.01, 1638.0 / 32_768.0, 6554.0 / 32_768.0);
        let near = |seen: f64, exact: f64, part: f64| {
            assert!(
                (seen - exact).abs() < 1e-6 + part * exact.abs(),
                "{seen}, not {exact}"
            );
        };
        near(forms.sampled.of(correction), signed, 1e-6);
        near(model, size, 1e-3);
        let circle = steady.circle(correction);
        assert_eq!(
            (circle.radius_mm, circle.periods),
            (forms.radius_mm, steady.periods)
        );
        assert_eq!(circle.sampled_um, forms.sampled.of(correction) * 1e3);
        assert_eq!(circle.continuous_um, forms.continuous.of(correction) * 1e3);
        assert_eq!(
            (circle.model_um, circle.load_um),
            (model * 1e3, steady.load_mm * 1e3)
        );
        // The shaft gives way to the load: a·J/k, outwards.
        let axis = machine[0];
        let turn = 1000.0 * TAU / axis.mm_per_rev;
        let twist = turn * axis.load_inertia_kg_m2 / axis.stiffness_nm_per_rad;
        let load = (signed - twist * axis.mm_per_rev / TAU).abs();
        let (motors, loads) = (steady.motor_mm, steady.load_mm);
        assert!((motors - size).abs() < 7e-4, "{motors}, not {size}");
        assert!((loads - load).abs() < 7e-4, "{loads}, not {load}");
        // All the way the motors are within 10 counts of their models.
        let off = run.off_model();
        assert!(off[0] < 12.0 && off[1] < 28.0, "{off:?}");
        assert!(measured.axes.iter().all(|axis| axis.saturated_periods == 0));
        let last = [&measured.model, &measured.motor].map(|errors| errors.end_um / 1e3);
        match correction {
            // On the widened circle it ends beside the path, by c·v²/r.
            Correction::Steady => last.map(|mm| close(mm, 0.0901, 0.02)),
            _ => last.map(|mm| assert!(mm < 0.003, "{mm}")),
        };
    }
}

#[test]
#[ignore = "takes long"]
fn in_short_periods_as_the_continuous_forms_say() {
    let settings = Settings {
        clock_hz: 10_000 * LEAST_PERIOD_TICKS,
        period_ms: 0.1,
        // For 4·K1 <= K2 in words too.
        k2_per_s: 201.0.into(),
        acceleration_mm_per_s2: Some(10_000.0),
        ..settings()
    };
    // More torque than is needed: with less the inertia's gain has no word.
    let machine = [TwoMassParameters {
        max_torque_nm: 20.0,
        ..TwoMassParameters::default()
    }; 2];
    for correction in [Correction::None, Correction::Vector] {
        let run = run(
            [0.0; 3],
            &[arc(10.0, 2.8, 100.0)],
            &settings,
            &machine,
            correction,
        );
        let steady = run.steady();
        let (k1, k2) = (164.0 / 3.2768, 659.0 / 3.2768);
        let form = continuous(correction, 10.0, k1, k2);
        close(steady.forms.continuous.of(correction), form, 1e-6);
        let mean = steady.model_mm;
        close(mean, steady.forms.sampled.of(correction), 0.005);
        println!("{mean} {form}");
        close(mean, form, 0.02);
    }
}

/// r(1 − |G|) and r(1 − |G(1 + e^(−jω/K1) − G)|) of G = K1·K2/(K1·K2 − ω² + jωK2), in polar form.
fn continuous(correction: Correction, omega: f64, k1: f64, k2: f64) -> f64 {
    let size = k1 * k2 / (k1 * k2 - omega * omega).hypot(omega * k2);
    let angle = -(omega * k2).atan2(k1 * k2 - omega * omega);
    let re = 1.0 + (omega / k1).cos() - size * angle.cos();
    let im = -(omega / k1).sin() - size * angle.sin();
    match correction {
        Correction::None => 10.0 * (1.0 - size),
        _ => 10.0 * (1.0 - size * re.hypot(im)),
    }
}

impl Run {
    pub fn steady(&self) -> Steady {
        let mut search = SteadySearch::new(&self.program);
        let Measured {
            model, motor, load, ..
        } = self.measured();
        for (k, period) in self.played.periods.iter().enumerate() {
            let errors = [&model, &motor, &load].map(|errors| errors.deviations[k].contour_mm);
            search.take(period.length, errors);
        }
        search.finish().unwrap()
    }

    /// Largest distances of motors and loads from their models, in counts.
    pub fn off_model(&self) -> [f64; 2] {
        let mut worst = [0.0f64; 2];
        for period in &self.played.periods {
            for axis in 0..self.played.axes {
                let model = period.model[axis] as f64 / COUNT;
                worst[0] = worst[0].max((period.motor[axis] as f64 - model).abs());
                worst[1] = worst[1].max((period.load[axis] - model).abs());
            }
        }
        worst
    }
}
