//! Everything at once, compared with small Runge-Kutta steps and with other ticks.

use super::*;

const ALL: TwoMassParameters = TwoMassParameters {
    damping_nm_s_per_rad: 0.04,
    backlash_rad: 0.004,
    motor_viscous_nm_s_per_rad: 0.002,
    load_viscous_nm_s_per_rad: 0.004,
    motor_friction_nm: 0.25,
    load_friction_nm: 0.5,
    motor_stiction_nm: 0.35,
    load_stiction_nm: 0.8,
    ..PARAMETERS
};

/// Torque for each millisecond: back and forth, with pauses in which the axis comes to rest.
fn torques() -> Vec<f64> {
    let parts = [
        (2.0, 12),
        (-0.6, 9),
        (-3.1, 11),
        (0.3, 30),
        (0.9, 14),
        (-1.7, 8),
        (0.0, 36),
    ];
    parts
        .iter()
        .flat_map(|&(torque, count)| std::iter::repeat_n(torque, count))
        .collect()
}

/// Integrates the equations of the note by Runge-Kutta steps. At rest, or when a step reverses the
/// speed, friction holds up to its limit.
fn small_steps(p: &TwoMassParameters, state: &mut [f64; 4], torques: [f64; 2], step: f64) {
    let shaft = |x: &[f64; 4]| {
        let (twist, half) = (x[0] - x[1], 0.5 * p.backlash_rad);
        let damped = p.damping_nm_s_per_rad * (x[2] - x[3]);
        if half == 0.0 {
            p.stiffness_nm_per_rad * twist + damped
        } else if twist > half {
            (p.stiffness_nm_per_rad * (twist - half) + damped).max(0.0)
        } else if twist < -half {
            (p.stiffness_nm_per_rad * (twist + half) + damped).min(0.0)
        } else {
            0.0
        }
    };
    let inertia = [p.motor_inertia_kg_m2, p.load_inertia_kg_m2];
    let viscous = [p.motor_viscous_nm_s_per_rad, p.load_viscous_nm_s_per_rad];
    let friction = [p.motor_friction_nm, p.load_friction_nm];
    let stiction = [p.motor_stiction_nm, p.load_stiction_nm];
    let on = |x: &[f64; 4]| [torques[0] - shaft(x), torques[1] + shaft(x)];
    // Sign of each motion, 0 if it is held.
    let at_start = on(state);
    let sign: [f64; 2] = std::array::from_fn(|body| {
        let most = friction[body].max(stiction[body]);
        match (state[2 + body] != 0.0, at_start[body].abs() > most) {
            (true, _) => state[2 + body].signum(),
            (false, true) => at_start[body].signum(),
            (false, false) => 0.0,
        }
    });
    let dry = friction[0].max(stiction[0]) > 0.0;
    let rates = |x: &[f64; 4]| {
        let on = on(x);
        let gained = |body: usize| match dry && sign[body] == 0.0 {
            true => 0.0,
            false => {
                let against = viscous[body] * x[2 + body] + sign[body] * friction[body];
                (on[body] - against) / inertia[body]
            }
        };
        [x[2], x[3], gained(0), gained(1)]
    };
    let ahead = |x: &[f64; 4], k: &[f64; 4], by: f64| -> [f64; 4] {
        std::array::from_fn(|row| x[row] + by * k[row])
    };
    let k1 = rates(state);
    let k2 = rates(&ahead(state, &k1, 0.5 * step));
    let k3 = rates(&ahead(state, &k2, 0.5 * step));
    let k4 = rates(&ahead(state, &k3, step));
    for row in 0..4 {
        state[row] += step / 6.0 * (k1[row] + 2.0 * (k2[row] + k3[row]) + k4[row]);
    }
    for body in 0..2 {
        if dry && state[2 + body] * sign[body] < 0.0 {
            state[2 + body] = 0.0;
        }
    }
}

#[test]
fn it_is_what_small_steps_come_to() {
    let linear = TwoMassParameters {
        backlash_rad: 0.0,
        motor_friction_nm: 0.0,
        load_friction_nm: 0.0,
        motor_stiction_nm: 0.0,
        load_stiction_nm: 0.0,
        ..ALL
    };
    let gap = TwoMassParameters {
        backlash_rad: 0.004,
        ..linear
    };
    let dry = TwoMassParameters {
        backlash_rad: 0.0,
        ..ALL
    };
    for (parameters, step, within, outside) in [
        (linear, 2e-6, 1e-9, 0.0),
        (linear, 2e-6, 1e-9, 0.7),
        (gap, 1e-7, 3e-6, 0.0),
        (dry, 1e-7, 3e-6, 0.0),
        (ALL, 1e-7, 3e-6, 0.0),
        (ALL, 1e-7, 3e-6, 0.7),
    ] {
        let mut axis = axis(&parameters, 1e-3);
        let mut state = [0.0; 4];
        let mut greatest = 0.0f64;
        for (ms, torque) in torques().into_iter().enumerate() {
            // External torque in half of the time, in alternating directions.
            let load = outside * [0.0, 1.0, 0.0, -1.0][ms / 10 % 4];
            axis.set_load_torque_nm(load);
            axis.drive(torque);
            for _ in 0..ticks(1e-3, step) {
                small_steps(&parameters, &mut state, [torque, load], step);
            }
            greatest = greatest.max(state[0].abs());
            near(axis.state[0], state[0], within);
            near(axis.state[1], state[1], within);
            near(axis.state[2], state[2], 1e3 * within);
            near(axis.state[3], state[3], 1e3 * within);
        }
        assert!(greatest > 0.02, "{greatest}");
    }
}

#[test]
fn the_tick_does_not_matter() {
    let undamped = TwoMassParameters {
        damping_nm_s_per_rad: 0.0,
        ..ALL
    };
    for parameters in [ALL, undamped] {
        let mut coarse = axis(&parameters, 1e-3);
        let mut fine = [1e-7, 1e-6, 1e-5, 1e-4, 2.5e-4].map(|tick_s| axis(&parameters, tick_s));
        let mut rested = false;
        for torque in torques() {
            run(&mut coarse, torque, 1e-3);
            rested |= coarse.grips == [Grip::Stuck; 2];
            for axis in &mut fine {
                run(axis, torque, 1e-3);
                for row in 0..4 {
                    near(axis.state[row], coarse.state[row], [1e-10, 1e-7][row / 2]);
                }
                assert_eq!(axis.grips, coarse.grips);
            }
        }
        assert!(rested);
    }
}

#[test]
fn the_other_way_is_the_mirror() {
    let mut one = axis(&ALL, 1e-4);
    let mut other = axis(&ALL, 1e-4);
    for torque in torques() {
        run(&mut one, torque, 1e-3);
        run(&mut other, -torque, 1e-3);
        assert_eq!(one.state.map(|x| -x), other.state);
    }
}
