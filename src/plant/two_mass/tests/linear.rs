//! Without dry friction and backlash.

use super::*;
use std::f64::consts::TAU;

/// Returns motor angle and twist, from rest under a torque, in closed form. Friction takes `beta`
/// per second of both bodies' speeds, so that the common and the relative motion do not mix.
fn closed_form(p: &TwoMassParameters, beta: f64, torque: f64, t: f64) -> [f64; 2] {
    let (motor, load) = (p.motor_inertia_kg_m2, p.load_inertia_kg_m2);
    let both = match beta == 0.0 {
        true => 0.5 * torque / (motor + load) * t * t,
        false => torque / (motor + load) / beta * (t + (-beta * t).exp_m1() / beta),
    };
    let compliance = 1.0 / motor + 1.0 / load;
    let natural = (p.stiffness_nm_per_rad * compliance).sqrt();
    let decay = 0.5 * (p.damping_nm_s_per_rad * compliance + beta);
    let omega = (natural * natural - decay * decay).sqrt();
    let swing = (omega * t).cos() + decay / omega * (omega * t).sin();
    let twist = torque / motor / natural.powi(2) * (1.0 - (-decay * t).exp() * swing);
    [both + load / (motor + load) * twist, twist]
}

#[test]
fn a_step_of_the_torque_is_that_of_the_closed_form() {
    for (stiffness, damping, beta) in [
        (430.0, 0.0, 0.0),
        (430.0, 0.03, 0.0),
        (430.0, 0.03, 20.0),
        (3e4, 0.02, 1.0),
    ] {
        let parameters = TwoMassParameters {
            stiffness_nm_per_rad: stiffness,
            damping_nm_s_per_rad: damping,
            motor_viscous_nm_s_per_rad: beta * PARAMETERS.motor_inertia_kg_m2,
            load_viscous_nm_s_per_rad: beta * PARAMETERS.load_inertia_kg_m2,
            ..PARAMETERS
        };
        for tick_s in TICKS_S {
            let mut axis = axis(&parameters, tick_s);
            let every = ticks(1e-3, tick_s);
            for tick in 1..=ticks(0.05, tick_s) {
                axis.drive(-3.0);
                if tick % every == 0 {
                    let t = tick as f64 * tick_s;
                    let [motor, twist] = closed_form(&parameters, beta, -3.0, t);
                    near(axis.state[0], motor, 1e-10);
                    near(axis.twist_rad(), twist, 1e-11);
                }
            }
        }
    }
}

#[test]
fn a_torque_on_the_load_is_that_of_a_motor_on_the_other_side() {
    let turned = TwoMassParameters {
        motor_inertia_kg_m2: PARAMETERS.load_inertia_kg_m2,
        load_inertia_kg_m2: PARAMETERS.motor_inertia_kg_m2,
        damping_nm_s_per_rad: 0.03,
        ..PARAMETERS
    };
    let parameters = TwoMassParameters {
        damping_nm_s_per_rad: 0.03,
        ..PARAMETERS
    };
    for tick_s in TICKS_S {
        let mut axis = axis(&parameters, tick_s);
        axis.set_load_torque_nm(-3.0);
        for tick in 1..=ticks(0.02, tick_s) {
            axis.drive(0.0);
            let [load, twist] = closed_form(&turned, 0.0, -3.0, tick as f64 * tick_s);
            near(axis.state[1], load, 1e-10);
            near(axis.twist_rad(), -twist, 1e-11);
        }
    }
}

#[test]
fn a_stiff_shaft_makes_it_one_inertia() {
    let parameters = TwoMassParameters {
        stiffness_nm_per_rad: 1e6,
        damping_nm_s_per_rad: 5.0,
        ..PARAMETERS
    };
    for tick_s in TICKS_S {
        let mut axis = axis(&parameters, tick_s);
        run(&mut axis, 4.0, 0.05);
        // 1000 rad/s²; the shaft carries the load's part of the torque.
        near(axis.shaft_torque_nm(), 3.0, 1e-6);
        for (body, ahead) in [(0, 0.75 * 3e-6), (1, -0.25 * 3e-6)] {
            near(axis.state[body], 1.25 + ahead, 1e-9);
            near(axis.state[2 + body], 50.0, 1e-7);
        }
    }
}

#[test]
fn a_twisted_shaft_swings_at_its_frequency() {
    let frequency = (430.0f64 / 1e-3 + 430.0 / 3e-3).sqrt() / TAU;
    for damping in [0.0, 0.03] {
        let parameters = TwoMassParameters {
            damping_nm_s_per_rad: damping,
            ..PARAMETERS
        };
        let mut axis = axis(&parameters, 1e-6);
        axis.state[0] = 0.01;
        let (mut crossings, mut peak, mut last) = (Vec::new(), [0.0f64; 2], 0.01);
        for tick in 1..=100_000 {
            axis.drive(0.0);
            let twist = axis.twist_rad();
            if twist <= 0.0 && last > 0.0 {
                crossings.push((f64::from(tick) + twist / (last - twist)) * 1e-6);
            }
            // Second and tenth oscillation.
            match crossings.len() {
                2 => peak[0] = peak[0].max(twist),
                10 => peak[1] = peak[1].max(twist),
                _ => {}
            }
            last = twist;
        }
        let seen = (crossings.len() - 1) as f64 / (crossings.last().unwrap() - crossings[0]);
        let decay = 0.5 * damping * (1.0 / 1e-3 + 1.0 / 3e-3);
        let damped = frequency * (1.0 - (decay / (TAU * frequency)).powi(2)).sqrt();
        near(seen, damped, 1e-4);
        near(peak[1] / peak[0], (-decay * 8.0 / damped).exp(), 1e-6);
    }
}

/// Returns the kinetic energy plus that of the shaft, in J.
pub(super) fn energy(axis: &TwoMassAxis) -> f64 {
    let p = &axis.parameters;
    let [_, _, motor, load] = axis.state;
    let over = (axis.twist_rad().abs() - 0.5 * p.backlash_rad).max(0.0);
    0.5 * (p.motor_inertia_kg_m2 * motor * motor
        + p.load_inertia_kg_m2 * load * load
        + p.stiffness_nm_per_rad * over * over)
}

#[test]
fn energy_is_what_the_torque_has_done_less_what_damping_has_taken() {
    let damped = TwoMassParameters {
        damping_nm_s_per_rad: 0.05,
        motor_viscous_nm_s_per_rad: 0.01,
        load_viscous_nm_s_per_rad: 0.02,
        ..PARAMETERS
    };
    for (parameters, tick_s) in [(PARAMETERS, 1e-3), (PARAMETERS, 1e-6), (damped, 2e-6)] {
        let mut axis = axis(&parameters, tick_s);
        let (mut done, mut taken) = (0.0, 0.0);
        let power = |axis: &TwoMassAxis| {
            let [_, _, motor, load] = axis.state;
            parameters.damping_nm_s_per_rad * (motor - load).powi(2)
                + parameters.motor_viscous_nm_s_per_rad * motor * motor
                + parameters.load_viscous_nm_s_per_rad * load * load
        };
        for tick in 0..ticks(0.2, tick_s) {
            let torque = 1.0 + 4.0 * (tick as f64 * tick_s * 311.0).sin();
            let (motor, before) = (axis.state[0], power(&axis));
            axis.drive(torque);
            done += torque * (axis.state[0] - motor);
            taken += 0.5 * (before + power(&axis)) * tick_s;
        }
        assert!(done > 0.5);
        near(energy(&axis) + taken, done, 1e-7);
    }
}
